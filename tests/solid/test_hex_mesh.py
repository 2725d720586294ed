"""Hexahedra of teeth: nowhere folded, nowhere open, on the exact flanks, and read by others' programs."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise, product
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from scipy.spatial import cKDTree

import hypoid
from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.geometry import DesignError
from hypoid.io import example_files, write_hex
from hypoid.pair import GearPair, Member
from hypoid.solid import HexMesh, body, hex_mesh
from hypoid.solid._smooth import edge_vectors, energy, smooth

Array = np.ndarray[Any, Any]
COARSE = {"along": 6, "profile": 3, "fillet": 6, "through": 3, "below": 2, "rim": 2}
MEMBERS = [
    ("gonzalez-fuentes-2022", "pinion"),  # six teeth, 65 deg
    ("gonzalez-fuentes-2022", "wheel"),
    ("lin-tsay-fong-1996", "pinion"),
    ("lin-tsay-fong-1996", "wheel"),
    ("tsay-lin-1993", "pinion"),
    ("tsay-lin-1993", "wheel"),  # Formate, no fillet
    ("tsay-lin-1993-as-printed", "pinion"),  # undercut and pointed
    ("vimercati-piazza-2005", "pinion"),  # Toprem cut away at the toe
    ("vimercati-piazza-2005", "wheel"),  # fillets that nearly meet
]
# C3D20 as Abaqus and CalculiX number it: bottom, top, edges of the bottom, of the top, upright ones
NODES = np.array(
    [
        [-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1],
        [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1],
        [0, -1, -1], [1, 0, -1], [0, 1, -1], [-1, 0, -1],
        [0, -1, 1], [1, 0, 1], [0, 1, 1], [-1, 0, 1],
        [-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0],
    ],
    dtype=float,
)  # fmt: skip
FACES = {0: (2, -1), 1: (2, 1), 2: (1, -1), 3: (0, 1), 4: (1, 1), 5: (0, -1)}  # S1 to S6
GAUSS = np.sqrt(0.6) * np.array([-1.0, 0.0, 1.0])
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9.0


@cache
def example(name: str) -> GearPair:
    return hypoid.read(next(file for file in example_files() if file.stem == name))


@cache
def usual(name: str, member: str) -> HexMesh:
    return hex_mesh(getattr(example(name), member))


@cache
def gradient(count: int, points: tuple[tuple[float, ...], ...]) -> Array:
    """Gradients (points, nodes, 3) of the shape functions, from the monomials they are made of."""
    powers = [
        p
        for p in product(range(3), repeat=3)
        if (max(p) < 2 if count == 8 else sum(k for k in p if k > 1) < 3)
    ]
    coefficients = np.linalg.inv(_monomials(NODES[:count], powers))
    x = np.array(points)
    made = np.zeros((len(x), count, 3))
    for d in range(3):
        lowered = [tuple(k - (i == d) for i, k in enumerate(p)) for p in powers]
        slope = np.array([p[d] for p in powers], dtype=float)
        made[..., d] = (_monomials(x, lowered) * slope) @ coefficients
    return made


def _monomials(x: Array, powers: Any) -> Array:
    return np.stack([np.prod(x ** np.maximum(p, 0), axis=1) for p in powers], axis=1)


def jacobians(mesh: HexMesh, points: Array) -> Array:
    """Matrices (elements, points, 3, 3): columns are derivatives by the element's own coordinates."""
    count = mesh.elements.shape[1]
    slopes = gradient(count, tuple(map(tuple, points.tolist())))
    return np.einsum("enx,pnd->epxd", mesh.nodes[mesh.elements], slopes, optimize=True)


def everywhere(mesh: HexMesh) -> Array:
    return np.concatenate([list(product(GAUSS, repeat=3)), NODES[: mesh.elements.shape[1]]])


def volume(mesh: HexMesh) -> float:
    """By the Gauss points that are exact for 20-node bricks."""
    weight = np.prod(list(product(WEIGHTS, repeat=3)), axis=1)
    made = np.linalg.det(jacobians(mesh, np.array(list(product(GAUSS, repeat=3)))))
    return float((made @ weight).sum())


def face_integral(mesh: HexMesh, faces: Array, what: Callable[[Array, Array], Array]) -> Array:
    """Sum over faces (k, 2) of what(points, outward area vectors)."""
    count = mesh.elements.shape[1]
    total: Any = 0.0
    weight = np.prod(list(product(WEIGHTS, repeat=2)), axis=1)
    for face, (axis, sign) in FACES.items():
        own = faces[faces[:, 1] == face, 0]
        if not len(own):
            continue
        points = np.insert(np.array(list(product(GAUSS, repeat=2))), axis, sign, axis=1)
        slopes = gradient(count, tuple(map(tuple, points.tolist())))
        corners = mesh.nodes[mesh.elements[own]]
        jacobian = np.einsum("enx,pnd->epxd", corners, slopes)
        a, b = (k for k in ((1, 2), (2, 0), (0, 1))[axis])
        area = sign * np.cross(jacobian[..., a], jacobian[..., b])
        powers = [
            p
            for p in product(range(3), repeat=3)
            if (max(p) < 2 if count == 8 else sum(k for k in p if k > 1) < 3)
        ]
        shape = _monomials(points, powers) @ np.linalg.inv(_monomials(NODES[:count], powers))
        place = np.einsum("enx,pn->epx", corners, shape)
        total = total + np.einsum("ep...,p->...", what(place, area), weight)
    return np.asarray(total)


def boundary(mesh: HexMesh) -> Array:
    return np.concatenate(list(mesh.face_sets.values()))


def dot(place: Array, area: Array) -> Array:
    return (place * area).sum(axis=-1)


# --- shape --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "member"), MEMBERS)
def test_no_element_is_folded_at_any_gauss_point_or_node(name: str, member: str) -> None:
    mesh = usual(name, member)
    made = jacobians(mesh, everywhere(mesh))
    determinant = np.linalg.det(made)
    assert determinant.min() > 0.0
    scaled = determinant / np.linalg.norm(made, axis=-2).prod(axis=-1)
    assert mesh.quality.scaled_jacobian == pytest.approx(scaled.min(), rel=1e-9)
    worst = np.unravel_index(scaled.argmin(), scaled.shape)[0]
    centre = mesh.nodes[mesh.elements[worst, :8]].mean(axis=0)
    assert mesh.quality.scaled_jacobian_place == pytest.approx(centre, abs=1e-9)
    assert scaled.min() > (0.17 if (name, member) == MEMBERS[0] else 0.33)
    assert 1.0 < mesh.quality.aspect < 120.0


@pytest.mark.parametrize(
    "counts",
    [
        {},
        {"along": 8},
        {"fillet": 2},
        {"through": 1, "profile": 1, "below": 1},
        {"through": 12, "profile": 16, "fillet": 14, "below": 7},
        {"rim": 1, "teeth": 2},
    ],
    ids=str,
)
@pytest.mark.parametrize("quadratic", [True, False])
def test_few_elements_and_many_do_not_fold(
    paper_pair: GearPair, counts: dict[str, int], quadratic: bool
) -> None:
    for member in (paper_pair.pinion, paper_pair.wheel):
        mesh = hex_mesh(member, **{**COARSE, **counts}, quadratic=quadratic)
        assert np.linalg.det(jacobians(mesh, everywhere(mesh))).min() > 0.0


@pytest.mark.parametrize(("name", "member"), MEMBERS)
def test_volume_is_that_within_the_named_surfaces(name: str, member: str) -> None:
    mesh = usual(name, member)
    faces = boundary(mesh)
    enclosed = face_integral(mesh, faces, dot) / 3.0
    assert volume(mesh) == pytest.approx(float(enclosed), rel=1e-11)
    whole = face_integral(mesh, faces, lambda _, area: area)
    assert np.abs(whole).max() < 1e-9 * np.sqrt(float(enclosed))


def exact_volume(member: Member) -> float:
    """One tooth with its part of the ring, by the sections of a fine grid and Pappus' rule, mm3."""
    tooth, ring = member.tooth, body(member)
    grid = tooth.grid(81, 321, 33)
    cone, s = member.concave.cone, grid.distance
    base = np.interp(s, s[[0, -1]], ring.base_height)
    middle = grid.bottom_angle.shape[1] // 2
    angle = np.concatenate(
        [
            grid.bottom_angle[:, middle:-1],
            grid.concave.angle,
            grid.convex.angle[:, ::-1],
            grid.bottom_angle[:, 1 : middle + 1] + tooth.pitch,
        ],
        axis=1,
    )
    height = np.concatenate(
        [
            grid.bottom_height[:, middle:-1],
            grid.concave.height,
            grid.convex.height[:, ::-1],
            grid.bottom_height[:, 1 : middle + 1],
        ],
        axis=1,
    )
    # rho dH from the base line up: rho = S sine + H cosine
    sine, cosine = float(cone.sine), float(cone.cosine)
    up = s[:, None] * sine * (height - base[:, None])
    up = up + 0.5 * cosine * (height**2 - base[:, None] ** 2)
    area = (0.5 * (up[:, 1:] + up[:, :-1]) * np.diff(angle, axis=1)).sum(axis=1)
    simpson = np.ones(len(s))
    simpson[1:-1:2], simpson[2:-1:2] = 4.0, 2.0
    teeth = float(area @ simpson) * (s[1] - s[0]) / 3.0
    z, r = np.array(ring.outline).T
    z1, r1 = np.roll(z, -1), np.roll(r, -1)
    moment = float(((z * r1 - z1 * r) * (r + r1)).sum()) / 6.0
    return teeth + abs(moment) * tooth.pitch


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_volume_converges_to_the_exact_one(paper_pair: GearPair, member: str) -> None:
    chosen: Member = getattr(paper_pair, member)
    exact = exact_volume(chosen)
    errors = [
        abs(volume(hex_mesh(chosen, along=n, through=4, profile=4)) / exact - 1.0) for n in (6, 12)
    ]
    fine = abs(volume(hex_mesh(chosen, fillet=8, profile=10)) / exact - 1.0)
    assert fine < 2e-5
    assert errors[0] < 1e-3
    assert errors[1] < errors[0]


# --- place --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "member"), MEMBERS)
@pytest.mark.parametrize("side", ["concave", "convex"])
def test_flank_and_fillet_lie_on_the_exact_surface(name: str, member: str, side: Any) -> None:
    mesh = usual(name, member)
    chosen: Member = getattr(example(name), member)
    flank = chosen.flank(side)
    nodes = mesh.node_sets[f"{side}_flank"]
    assert (f"{side}_fillet" in mesh.node_sets) == (flank.cut_pieces[-1] == "fillet")
    nodes = np.union1d(nodes, mesh.node_sets.get(f"{side}_fillet", nodes))
    # the lowest line has no angle over (z, rho) on either side of it
    nodes = np.setdiff1d(nodes, mesh.node_sets["slot_bottom"])
    assert len(nodes) > 500
    x, y, z = mesh.nodes[nodes].T
    exact = flank.at(z, np.hypot(x, y)).position
    hand = -1.0 if flank.mirrored else 1.0
    stock = 0.0 if side == "concave" else hand * chosen.stock_turn
    off = np.arctan2(y, x) - np.arctan2(exact[:, 1], exact[:, 0]) - stock
    off = np.mod(off + 0.5 * mesh.pitch, mesh.pitch) - 0.5 * mesh.pitch
    assert np.abs(off * np.hypot(x, y)).max() < 1e-7
    assert np.abs(exact[:, 2] - z).max() < 1e-7


def test_the_middle_tooth_stands_where_the_concave_flank_does(paper_pair: GearPair) -> None:
    mesh = hex_mesh(paper_pair.wheel, **COARSE, teeth=3)
    faces = mesh.face_sets["concave_flank"]
    own = faces[mesh.tooth[faces[:, 0]] == 1]
    x, y, z = mesh.nodes[mesh.elements[own[:, 0]]].reshape(-1, 3).T
    turns = np.arctan2(y, x)
    angles = [np.median(turns) + k * mesh.pitch for k in (-1.0, 1.0)]
    place = paper_pair.wheel.concave.at(np.median(z), np.median(np.hypot(x, y))).position[0]
    assert angles[0] < np.arctan2(place[1], place[0]) < angles[1]


@pytest.mark.parametrize(("name", "member"), MEMBERS)
def test_surfaces_are_what_their_names_say(name: str, member: str) -> None:
    mesh = usual(name, member)
    chosen: Member = getattr(example(name), member)
    ring, cone = body(chosen), chosen.concave.cone
    x, y, z = mesh.nodes.T
    rho = np.hypot(x, y)
    distance, height = (np.asarray(v) for v in cone.cone_distance_height(z, rho))
    sets = mesh.node_sets
    assert rho[sets["bore"]] == pytest.approx(ring.bore, abs=1e-9)
    assert z[sets["back_face"]] == pytest.approx(ring.back, abs=1e-9)
    assert z[sets["front_face"]] == pytest.approx(ring.front, abs=1e-9)
    assert rho[sets["rim"]] == pytest.approx(ring.heel_base[1], abs=1e-9)
    assert distance[sets["toe"]] == pytest.approx(chosen.concave.toe, abs=1e-8)
    assert distance[sets["heel"]] == pytest.approx(chosen.concave.heel, abs=1e-8)
    land = sets["top_land"]
    tip = np.asarray(chosen.concave.tip.at(distance[land]))
    if "as-printed" in name:
        assert (height[land] < tip + 1e-8).all()
    else:
        assert height[land] == pytest.approx(tip, abs=1e-8)
    bottom, grid = sets["slot_bottom"], chosen.tooth.grid(49, 11, 33)
    low, high = grid.bottom_height.min(axis=1), grid.bottom_height.max(axis=1)
    assert (height[bottom] > np.interp(distance[bottom], grid.distance, low) - 1e-3).all()
    assert (height[bottom] < np.interp(distance[bottom], grid.distance, high) + 1e-3).all()


def test_middle_nodes_stand_between_their_corners(paper_pair: GearPair) -> None:
    """Within the middle third of the edge's length, so that no quarter-point singularity comes near."""
    mesh = usual("gonzalez-fuentes-2022", "pinion")
    pairs = [np.flatnonzero(np.abs(NODES[:8] - NODES[k]).sum(axis=1) == 1) for k in range(8, 20)]
    for k, (a, b) in enumerate(pairs, start=8):
        start, middle, end = (mesh.nodes[mesh.elements[:, n]] for n in (a, k, b))
        along = end - start
        share = ((middle - start) * along).sum(axis=1) / (along**2).sum(axis=1)
        assert 0.4 < share.min() <= share.max() < 0.6


# --- joints -------------------------------------------------------------------------------------


@pytest.mark.parametrize("teeth", [1, 3, None])
@pytest.mark.parametrize("quadratic", [True, False])
def test_inner_faces_join_two_elements_and_outer_ones_have_one_name(
    paper_pair: GearPair, teeth: int | None, quadratic: bool
) -> None:
    mesh = hex_mesh(paper_pair.pinion, **COARSE, teeth=teeth, quadratic=quadratic)
    count = mesh.elements.shape[1]
    keys, owners = [], []
    for face, (axis, sign) in FACES.items():
        columns = np.flatnonzero(NODES[:count, axis] == sign)
        keys.append(np.sort(mesh.elements[:, columns], axis=1))
        owners.append(
            np.stack([np.arange(len(mesh.elements)), np.full(len(mesh.elements), face)], axis=1)
        )
    _, inverse, counts = np.unique(
        np.concatenate(keys), axis=0, return_inverse=True, return_counts=True
    )
    assert counts.max() == 2
    outer = np.concatenate(owners)[counts[inverse] == 1]
    named = boundary(mesh)
    assert len(named) == len(np.unique(named, axis=0)) == len(outer)
    assert (np.unique(named, axis=0) == np.unique(outer, axis=0)).all()
    assert (
        ("side_minus" in mesh.face_sets) == ("side_plus" in mesh.face_sets) == (teeth is not None)
    )
    assert mesh.teeth == (teeth or 6)
    assert not cKDTree(mesh.nodes).query_pairs(1e-6)  # neighbours share their nodes
    assert (np.unique(mesh.elements) == np.arange(len(mesh.nodes))).all()
    for name, faces in mesh.face_sets.items():
        nodes = mesh.face_nodes(name)
        assert nodes.shape == (len(faces), 8 if quadratic else 4)
        assert (np.unique(nodes) == mesh.node_sets[name]).all()


def test_face_nodes_run_anticlockwise_from_outside(paper_pair: GearPair) -> None:
    mesh = hex_mesh(paper_pair.pinion, **COARSE)
    for name, faces in mesh.face_sets.items():
        a, b, c, d, ab, bc, cd, da = np.moveaxis(mesh.nodes[mesh.face_nodes(name)], 1, 0)
        area = np.cross(c - a, d - b)
        inside = mesh.nodes[mesh.elements[faces[:, 0], :8]].mean(axis=1)
        assert (((a + b + c + d) / 4.0 - inside) * area).sum(axis=1).min() > 0.0
        for middle, ends in ((ab, (a, b)), (bc, (b, c)), (cd, (c, d)), (da, (d, a))):
            length = np.linalg.norm(ends[1] - ends[0], axis=1)
            assert (np.linalg.norm(middle - 0.5 * (ends[0] + ends[1]), axis=1) < length / 4).all()


@pytest.mark.parametrize("member", ["pinion", "wheel"])
@pytest.mark.parametrize("teeth", [1, 2])
def test_one_side_is_the_other_turned(paper_pair: GearPair, member: str, teeth: int) -> None:
    mesh = hex_mesh(getattr(paper_pair, member), **COARSE, teeth=teeth)
    x, y, z = mesh.nodes[mesh.node_sets["side_minus"]].T
    c, s = np.cos(teeth * mesh.pitch), np.sin(teeth * mesh.pitch)
    turned = np.stack([c * x - s * y, s * x + c * y, z], axis=1)
    plus = mesh.nodes[mesh.node_sets["side_plus"]]
    away, which = cKDTree(plus).query(turned)
    assert away.max() < 1e-9
    assert len(np.unique(which)) == len(plus)


def test_teeth_count_by_rising_angle(paper_pair: GearPair) -> None:
    for member in (paper_pair.pinion, paper_pair.wheel):  # of either hand
        mesh = hex_mesh(member, **COARSE, teeth=3)
        assert (np.bincount(mesh.tooth) == len(mesh.elements) // 3).all()
        centres = [mesh.nodes[mesh.elements[mesh.tooth == k]].mean(axis=(0, 1)) for k in range(3)]
        steps = [np.cross(a, b)[2] for a, b in pairwise(centres)]
        assert min(steps) > 0.0


def test_the_other_hand_is_the_mirror_image(table_1_spec: ExactFaceHobbedSpec) -> None:
    left, right = (
        hex_mesh(build(replace(table_1_spec, pinion_hand=hand)).pinion, **COARSE)
        for hand in ("left", "right")
    )
    away, which = cKDTree(right.nodes).query(left.nodes * [1.0, -1.0, 1.0])
    assert away.max() < 1e-8
    assert len(np.unique(which)) == len(left.nodes)
    assert volume(left) == pytest.approx(volume(right), rel=1e-10)
    for name, nodes in left.node_sets.items():
        other = {"side_minus": "side_plus", "side_plus": "side_minus"}.get(name, name)
        assert (np.sort(which[nodes]) == right.node_sets[other]).all()


# --- ring, limits and faults ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("member", "bore", "back"),
    [
        ("pinion", 1.0, 200.0),
        ("pinion", 11.0, 140.5),
        ("wheel", 40.0, 60.0),
        ("wheel", 112.0, 27.5),
    ],
)
def test_any_bore_and_back_face(
    paper_pair: GearPair, member: str, bore: float, back: float
) -> None:
    chosen: Member = getattr(paper_pair, member)
    mesh = hex_mesh(chosen, **{**COARSE, "rim": None}, bore=bore, back=back)
    assert np.linalg.det(jacobians(mesh, everywhere(mesh))).min() > 0.0
    assert np.hypot(*mesh.nodes[mesh.node_sets["bore"], :2].T) == pytest.approx(bore, abs=1e-9)
    assert mesh.nodes[mesh.node_sets["back_face"], 2] == pytest.approx(back, abs=1e-9)
    enclosed = face_integral(mesh, boundary(mesh), dot) / 3.0
    assert volume(mesh) == pytest.approx(float(enclosed), rel=1e-10)


def test_a_pointed_tooth_gets_a_narrow_land(paper_pair: GearPair) -> None:
    pinion = paper_pair.pinion
    whole = pinion.tooth.grid(9, 21)
    land = (whole.convex.angle - whole.concave.angle)[:, -1]
    mesh = hex_mesh(replace(pinion, stock_turn=-0.5 * (land.min() + land.max())), **COARSE)
    assert np.linalg.det(jacobians(mesh, everywhere(mesh))).min() > 0.0
    corners = mesh.nodes[mesh.face_nodes("top_land")[:, :4]]
    sides = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
    depth = pinion.blank.outer_addendum + pinion.blank.outer_dedendum
    assert sides.min() * 8.0 > 0.019 * depth  # outer ones of three are an eighth of the land each


@pytest.mark.parametrize(
    ("given", "path"),
    [
        ({"teeth": 0}, "teeth"),
        ({"teeth": 7}, "teeth"),
        ({"along": 0}, "along"),
        ({"fillet": 1}, "fillet"),
        ({"rim": 0}, "rim"),
        ({"bore": 30.0}, "bore"),
        ({"bore": 0.0}, "bore"),
        ({"back": 100.0}, "back"),
    ],
    ids=str,
)
def test_what_cannot_be_meshed_is_said(paper_pair: GearPair, given: Any, path: str) -> None:
    with pytest.raises(DesignError) as raised:
        hex_mesh(paper_pair.pinion, **given)
    assert [problem.path for problem in raised.value.problems] == [path]


def test_every_fault_is_told_at_once(paper_pair: GearPair) -> None:
    with pytest.raises(DesignError) as raised:
        hex_mesh(paper_pair.pinion, teeth=0, along=0, through=-1, bore=-1.0)
    found = [problem.path for problem in raised.value.problems]
    assert found == ["along", "through", "teeth", "bore"]


def test_a_tooth_cut_away_is_no_solid(paper_pair: GearPair) -> None:
    gone = replace(paper_pair.pinion, stock_turn=-0.9)
    with pytest.raises(DesignError, match="pinion tooth"):
        hex_mesh(gone, **COARSE)


def test_elements_that_turn_too_far_are_told(paper_pair: GearPair) -> None:
    with pytest.raises(DesignError, match=r"along: got 2; .*along = \d"):
        hex_mesh(paper_pair.pinion, along=2)


def test_a_folded_element_is_told_with_its_place(
    paper_pair: GearPair, monkeypatch: pytest.MonkeyPatch
) -> None:
    def thrown(_place: Any, start: Array, *_: Any) -> Array:
        return start[::-1]

    monkeypatch.setattr("hypoid.solid._hex_section.smooth", thrown)
    with pytest.raises(DesignError, match=r"pinion mesh.*inside out near S = .*along = 12"):
        hex_mesh(paper_pair.pinion, **COARSE)


# --- smoothing ------------------------------------------------------------------------------------


def square(count: int) -> tuple[Array, Array]:
    """Quadrilaterals of a unit square, and its nodes (n, 2)."""
    index = np.arange((count + 1) ** 2).reshape(count + 1, count + 1)
    quads = np.stack([index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1)
    x, y = np.meshgrid(*(2 * [np.linspace(0.0, 1.0, count + 1)]), indexing="ij")
    return quads.reshape(-1, 4), np.stack([x.ravel(), y.ravel()], axis=1)


def test_energy_has_its_own_gradient() -> None:
    rng = np.random.default_rng(3)
    edges = rng.normal(size=(4, 5, 2, 3))
    size, epsilon = rng.uniform(0.5, 2.0, (4, 5, 3)), np.array([0.1, 0.3, 1.0])
    direction = rng.normal(size=edges.shape)
    _, slopes, _ = energy(edges, size, epsilon)
    step = 1e-6
    ahead, behind = (energy(edges + k * step * direction, size, epsilon)[0] for k in (1.0, -1.0))
    expected = (slopes * direction).sum(axis=(0, 1, 2))
    assert (ahead - behind) / (2.0 * step) == pytest.approx(expected, rel=1e-6)


def test_a_folded_mesh_is_unfolded() -> None:
    """Inner nodes thrown about come back to the square's own grid, the least of the energy."""
    quads, nodes = square(6)
    inner = np.flatnonzero(((nodes > 0.01) & (nodes < 0.99)).all(axis=1))
    start = np.repeat(nodes[:, :, None], 2, axis=2)
    start[inner] += np.random.default_rng(1).normal(scale=0.3, size=(len(inner), 2, 2))
    edge_of = edge_vectors(quads, len(nodes))

    def place(x: Array) -> tuple[Array, Callable[[Array], Array]]:
        points = start.copy()
        points[inner] = x.reshape(len(inner), 2, 2)
        return points, lambda by_points: by_points[inner].reshape(-1, 2)

    def folded(points: Array) -> float:
        edges = (edge_of @ points.reshape(len(points), -1)).reshape(4, -1, 2, 2)
        return float(energy(edges, size, np.ones(2))[2].min())

    size = np.full((4, len(quads), 2), 1.0 / 6.0)
    assert folded(start) < 0.0
    found = smooth(place, start[inner].reshape(-1, 2), edge_of, size, lambda g: g / 1e3)
    points, _ = place(found)
    assert folded(points) > 0.9
    assert np.abs(points - nodes[:, :, None]).max() < 1e-2


# --- files ----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def two_teeth(paper_pair: GearPair) -> HexMesh:
    return hex_mesh(paper_pair.pinion, **COARSE, teeth=2)


def test_input_file_reads_back(two_teeth: HexMesh, tmp_path: Path) -> None:
    back = meshio.read(write_hex(two_teeth, tmp_path / "teeth.inp"))
    assert np.abs(back.points - two_teeth.nodes).max() < 1e-9
    assert {block.type for block in back.cells} == {"hexahedron20"}
    assert (np.concatenate([block.data for block in back.cells]) == two_teeth.elements).all()
    assert set(back.point_sets) == set(two_teeth.node_sets)
    for name, nodes in two_teeth.node_sets.items():
        assert (back.point_sets[name] == nodes).all()
    assert {"tooth_1", "tooth_2"} < set(back.cell_sets)


def test_input_file_has_every_surface(two_teeth: HexMesh, tmp_path: Path) -> None:
    lines = write_hex(two_teeth, tmp_path / "teeth.inp").read_text().splitlines()
    assert max(map(len, lines)) < 200
    for name, faces in two_teeth.face_sets.items():
        start = lines.index(f"*SURFACE, NAME={name}, TYPE=ELEMENT") + 1
        rows = [line.split(", S") for line in lines[start : start + len(faces)]]
        assert (np.array(rows, dtype=int) == faces + 1).all()


@pytest.mark.parametrize("quadratic", [True, False])
def test_vtu_reads_back(paper_pair: GearPair, tmp_path: Path, quadratic: bool) -> None:
    mesh = hex_mesh(paper_pair.wheel, **COARSE, quadratic=quadratic)
    back = meshio.read(write_hex(mesh, tmp_path / "tooth.vtu"))
    assert (back.points == mesh.nodes).all()
    (block,) = back.cells
    assert block.type == ("hexahedron20" if quadratic else "hexahedron")
    assert (block.data == mesh.elements).all()
    assert set(back.point_data) == set(mesh.node_sets)
    assert set(back.cell_data) == {"tooth", *mesh.face_sets}
    for name, faces in mesh.face_sets.items():
        assert (np.flatnonzero(back.point_data[name]) == mesh.node_sets[name]).all()
        (which,) = back.cell_data[name]
        assert (which[faces[:, 0]] == faces[:, 1] + 1).all()
        assert np.count_nonzero(which) == len(faces)


@pytest.mark.parametrize("name", ["tooth.stl", "tooth", "nowhere/tooth.inp", "nowhere/tooth.vtu"])
def test_a_file_is_written_whole_or_not_at_all(
    two_teeth: HexMesh, tmp_path: Path, name: str
) -> None:
    with pytest.raises(DesignError):
        write_hex(two_teeth, tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
@pytest.mark.parametrize("quadratic", [True, False])
def test_calculix_holds_the_load(paper_pair: GearPair, tmp_path: Path, quadratic: bool) -> None:
    """A pressure on a flank: the bore's reaction is its resultant, by the same surface here."""
    mesh = hex_mesh(paper_pair.pinion, **COARSE, quadratic=quadratic)
    write_hex(mesh, tmp_path / "tooth.inp")
    deck = """\
*INCLUDE, INPUT=tooth.inp
*MATERIAL, NAME=steel
*ELASTIC
206000., 0.3
*SOLID SECTION, ELSET=all_elements, MATERIAL=steel
*STEP
*STATIC
*BOUNDARY
bore, 1, 3
*DSLOAD
concave_flank, P, 1.0
*NODE PRINT, NSET=bore, TOTALS=ONLY
RF
*END STEP
"""
    (tmp_path / "job.inp").write_text(deck)
    done = subprocess.run(
        ["ccx", "-i", "job"], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False
    )
    assert "Job finished" in done.stdout, done.stdout[-2000:]
    assert "nonpositive jacobian" not in done.stdout
    reaction = np.array((tmp_path / "job.dat").read_text().split()[-3:], dtype=float)
    load = face_integral(mesh, mesh.face_sets["concave_flank"], lambda _, area: -area)
    assert reaction == pytest.approx(-load, rel=1e-4, abs=1e-3)
