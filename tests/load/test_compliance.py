"""Finite elements of a tooth: patch test, rigid motions, a ring against the whole gear, CalculiX on the same mesh."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.sparse.linalg import splu

from hypoid.io import write_hex
from hypoid.load import Elements, Material, Support, tooth_compliance
from hypoid.load._bricks import nodal_stress, stiffness
from hypoid.load._hats import bilinear, hat_loads, shapes
from hypoid.pair import GearPair
from hypoid.solid import HexMesh, hex_mesh

SOFT = Material(1000.0, 0.25)
COARSE = Elements(along=6, profile=3, fillet=2, through=2, below=1, rim=1)


@pytest.fixture(scope="module")
def tooth(relief_pair: GearPair) -> HexMesh:
    return hex_mesh(relief_pair.pinion, **COARSE.counts())


@pytest.fixture(scope="module")
def matrix(tooth: HexMesh) -> Any:
    return stiffness(tooth.nodes, tooth.elements, SOFT)


def gradient() -> np.ndarray:
    return np.array([[1.0, 0.2, -0.3], [0.5, -0.7, 0.1], [0.0, 0.4, 0.6]]) * 1e-3


def test_patch_test(tooth: HexMesh, matrix: Any) -> None:
    """A displacement linear in space leaves inner nodes without force and has the stress of Hooke's law."""
    slope = gradient()
    moved = (tooth.nodes @ slope.T).ravel()
    force = (matrix @ moved).reshape(-1, 3)
    outer = np.unique(np.concatenate(list(tooth.node_sets.values())))
    inner = np.setdiff1d(np.arange(len(tooth.nodes)), outer)
    assert np.abs(force[inner]).max() < 1e-10 * np.abs(force).max()
    at = np.unique(tooth.face_nodes("concave_fillet")[:, :4])
    stress = (nodal_stress(tooth.nodes, tooth.elements, at, SOFT) @ moved).reshape(-1, 6)
    strain = 0.5 * (slope + slope.T)
    lam, mu = SOFT.lame
    full = lam * np.trace(strain) * np.eye(3) + 2.0 * mu * strain
    expected = [full[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))]
    np.testing.assert_allclose(stress, np.tile(expected, (len(at), 1)), atol=1e-9)


def test_rigid_motions_cost_nothing(tooth: HexMesh, matrix: Any) -> None:
    x = tooth.nodes
    turns = [np.cross(axis, x).ravel() for axis in np.eye(3)]
    shifts = [np.tile(axis, len(x)) for axis in np.eye(3)]
    for motion in turns + shifts:
        assert np.abs(matrix @ motion).max() < 1e-9 * np.abs(motion).max() * abs(matrix).max()


def test_face_shapes_are_a_partition_of_unity() -> None:
    at = np.random.default_rng(1).uniform(-1.0, 1.0, (20, 2))
    value, by_x, by_y = shapes(at)
    np.testing.assert_allclose(value.sum(axis=1), 1.0)
    np.testing.assert_allclose(bilinear(at).sum(axis=1), 1.0)
    step = 1e-6
    for d, slope in enumerate((by_x, by_y)):
        shift = step * np.eye(2)[d]
        seen = (shapes(at + shift)[0] - shapes(at - shift)[0]) / (2.0 * step)
        np.testing.assert_allclose(slope, seen, atol=1e-9)


@pytest.fixture(scope="module")
def compliance(relief_pair: GearPair) -> Any:
    return tooth_compliance(relief_pair.pinion, "concave", SOFT, COARSE, Support(("bore",)))


def one_tooth_of_the_whole_gear(
    pair: GearPair, side: str
) -> tuple[Any, np.ndarray, list[Any], HexMesh]:
    """Stiffness, bore and the hats' loads on every tooth of the whole pinion, assembled directly."""
    mesh = hex_mesh(pair.pinion, teeth=None, **COARSE.counts())
    flank = pair.pinion.flank(side)  # pyright: ignore[reportArgumentType]
    nodes = mesh.nodes * flank.hand
    faces, set_of = mesh.face_nodes(f"{side}_flank"), mesh.face_sets[f"{side}_flank"]
    sign = -1.0 if flank.mirrored else 1.0
    loads = [
        hat_loads(nodes, faces[mesh.tooth[set_of[:, 0]] == t], flank.cone, sign)
        for t in range(mesh.teeth)
    ]
    return stiffness(nodes, mesh.elements, SOFT), mesh.node_sets["bore"], loads, mesh


@pytest.mark.parametrize("name", ["relief", "right-hand"])
def test_ring_is_the_whole_gear(name: str, variant: Callable[[str], GearPair]) -> None:
    """Copies of one condensed tooth answer as all six teeth assembled, on every tooth and in the fillets."""
    pair = variant(name)
    found = tooth_compliance(pair.pinion, "concave", SOFT, COARSE, Support(("bore",)))
    matrix, held, loads, mesh = one_tooth_of_the_whole_gear(pair, "concave")
    free = np.setdiff1d(np.arange(matrix.shape[0]), (3 * held[:, None] + np.arange(3)).ravel())
    middle = mesh.teeth // 2
    moved = np.zeros((matrix.shape[0], 5))
    some = np.linspace(0, found.hats.count - 1, 5).astype(int)
    right = loads[middle].load[:, some].toarray()
    moved[free] = splu(matrix[free][:, free]).solve(right[free])
    sense = -1 if pair.pinion.concave.mirrored else 1  # of left-hand angles against the mesh's own
    for n in range(mesh.teeth):
        expected = loads[n].load.T @ moved
        answer = found.elastic[sense * (n - middle) % mesh.teeth][:, some]
        np.testing.assert_allclose(answer, expected, atol=1e-9 * np.abs(found.elastic[0]).max())
    nodes = mesh.nodes * pair.pinion.concave.hand
    at = np.array([np.argmin(((nodes - p) ** 2).sum(axis=1)) for p in found.fillet_points])
    seen = nodal_stress(nodes, mesh.elements, at, SOFT) @ moved
    np.testing.assert_allclose(found.stress[0][:, some], seen, atol=1e-8 * np.abs(seen).max())


def test_reciprocity_and_positive(compliance: Any) -> None:
    """Displacement at b by a force at a is that at a by the force at b, on any two teeth."""
    scale = np.abs(compliance.elastic[0]).max()
    for n, answer in compliance.elastic.items():
        other = compliance.elastic[-n % compliance.teeth]
        np.testing.assert_allclose(answer, other.T, atol=1e-10 * scale)
    every = np.block([[compliance.elastic[(i - j) % 6] for j in range(6)] for i in range(6)])
    assert np.linalg.eigvalsh(every)[0] > 0.0
    assert np.linalg.eigvalsh(compliance.half_space)[0] > 0.0


def test_scaling_with_the_modulus(relief_pair: GearPair, compliance: Any) -> None:
    """Twice as stiff a material moves half as far, under the same stress."""
    stiff = Material(2.0 * SOFT.youngs_modulus, SOFT.poissons_ratio)
    found = tooth_compliance(relief_pair.pinion, "concave", stiff, COARSE, Support(("bore",)))
    np.testing.assert_allclose(
        2.0 * found.difference(0), compliance.difference(0), rtol=1e-8, atol=1e-12
    )
    np.testing.assert_allclose(
        found.stress[0], compliance.stress[0], atol=1e-7 * np.abs(found.stress[0]).max()
    )


def test_hat_weights(compliance: Any) -> None:
    """At a knot its own hat alone; anywhere they add up to one, and a linear field comes out."""
    hats = compliance.hats
    distance = np.repeat(hats.distance, hats.height.shape[1])
    weights = hats.weights(distance, hats.height.ravel()).toarray()
    np.testing.assert_allclose(weights, np.eye(hats.count), atol=1e-9)
    at = np.random.default_rng(2).uniform(0.2, 0.8, (30, 2))
    s = hats.distance[0] + at[:, 0] * np.ptp(hats.distance)
    h = hats.height[:, 0].max() + at[:, 1] * (hats.height[:, -1].min() - hats.height[:, 0].max())
    weights = hats.weights(s, h)
    np.testing.assert_allclose(weights.sum(axis=1), 1.0)
    np.testing.assert_allclose(weights @ distance, s)
    np.testing.assert_allclose(weights @ hats.height.ravel(), h, atol=1e-9)


@pytest.mark.skipif(shutil.which("ccx") is None, reason="needs CalculiX")
def test_calculix_on_the_same_mesh(relief_pair: GearPair, tooth: HexMesh, tmp_path: Path) -> None:
    """Static displacements of a hat's load, node by node, on one tooth with free cuts: C3D20 of CalculiX."""
    member = relief_pair.pinion
    matrix = stiffness(tooth.nodes, tooth.elements, SOFT)
    sign, hand = (-1.0 if member.concave.mirrored else 1.0), member.concave.hand
    loads = hat_loads(
        tooth.nodes * hand, tooth.face_nodes("concave_flank"), member.concave.cone, sign
    )
    force = (loads.load[:, [loads.hats.count // 2]].toarray().reshape(-1, 3) * hand).ravel()
    held = tooth.node_sets["bore"]
    free = np.setdiff1d(np.arange(len(force)), (3 * held[:, None] + np.arange(3)).ravel())
    moved = np.zeros(len(force))
    moved[free] = splu(matrix[free][:, free]).solve(force[free])
    write_hex(tooth, tmp_path / "mesh.inp")
    cload = "\n".join(f"{i // 3 + 1}, {i % 3 + 1}, {force[i]:.12e}" for i in np.flatnonzero(force))
    (tmp_path / "job.inp").write_text(
        f"*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=m\n*ELASTIC\n{SOFT.youngs_modulus}, {SOFT.poissons_ratio}\n"
        "*SOLID SECTION, ELSET=all_elements, MATERIAL=m\n*BOUNDARY\nbore, 1, 3\n*STEP\n*STATIC\n"
        f"*CLOAD\n{cload}\n*NODE PRINT, NSET=all_nodes\nU\n*END STEP\n"
    )
    subprocess.run(["ccx", "job"], cwd=tmp_path, check=True, capture_output=True, timeout=120)
    lines = (tmp_path / "job.dat").read_text().splitlines()
    rows = [line.split() for line in lines if len(line.split()) == 4 and line.split()[0].isdigit()]
    theirs = np.array(rows, dtype=float)[:, 1:]
    assert len(theirs) == len(tooth.nodes)
    np.testing.assert_allclose(theirs, moved.reshape(-1, 3), atol=1e-5 * np.abs(moved).max())
