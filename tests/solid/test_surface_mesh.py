"""Surface meshes of every example's members: closed, outward, as near to the exact surfaces as asked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
import pytest
import trimesh

import hypoid
from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.flank import Side
from hypoid.geometry import DesignError
from hypoid.io import example_files
from hypoid.pair import GearPair, Member
from hypoid.solid import SurfaceMesh, body, mass_properties, surface_mesh

COARSE = 0.05  # mm
SIDES: tuple[Side, Side] = ("concave", "convex")
FILES = {file.stem: file for file in example_files()}
MEMBERS = [(name, member) for name in FILES for member in ("pinion", "wheel")]
Meshed = Callable[[str, str, int | None], SurfaceMesh]


@lru_cache
def pair_of(name: str) -> GearPair:
    return hypoid.read(FILES[name])


def member_of(name: str, member: str) -> Member:
    return getattr(pair_of(name), member)


@lru_cache
def meshed(name: str, member: str, teeth: int | None) -> SurfaceMesh:
    return surface_mesh(member_of(name, member), teeth=teeth, chord_error=COARSE)


def read_by_trimesh(mesh: SurfaceMesh) -> Any:
    return trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)


@pytest.mark.parametrize("teeth", [1, None])
@pytest.mark.parametrize(("name", "member"), MEMBERS)
def test_encloses_a_solid(name: str, member: str, teeth: int | None) -> None:
    mesh = meshed(name, member, teeth)
    seen = read_by_trimesh(mesh)
    assert mesh.watertight
    assert seen.is_watertight
    assert seen.is_winding_consistent
    assert seen.is_volume
    assert seen.volume == pytest.approx(mesh.volume, rel=1e-12)
    assert len(np.unique(mesh.triangles)) == len(mesh.vertices)
    height = 2.0 * seen.area_faces / np.ptp(seen.triangles, axis=1).max(axis=1)
    assert height.min() > 1e-5  # mm: a needle is none in single precision
    assert 0.0 < mesh.chord_error <= COARSE


@pytest.mark.parametrize(("name", "member"), MEMBERS)
def test_teeth_add_up_to_the_gear(name: str, member: str) -> None:
    one, gear = meshed(name, member, 1), meshed(name, member, None)
    count = member_of(name, member).teeth
    assert (one.teeth, one.whole, gear.teeth, gear.whole) == (1, False, count, True)
    assert count * one.volume == pytest.approx(gear.volume, rel=1e-9)
    sides = len(one.groups["start"]) + len(one.groups["end"])
    assert count * (len(one.triangles) - sides) == len(gear.triangles)


@pytest.mark.parametrize(("name", "member"), MEMBERS)
def test_surfaces_do_not_pass_through_each_other(name: str, member: str) -> None:
    assert crossings(meshed(name, member, 1)) == 0


def crossings(mesh: SurfaceMesh) -> int:
    """Pairs of triangles without a common vertex of which an edge of one pierces the other."""
    corners = mesh.vertices[mesh.triangles]
    order = np.argsort(corners[..., 2].min(axis=1))
    corners, triangles = corners[order], mesh.triangles[order]
    low, high = corners.min(axis=1), corners.max(axis=1)
    pairs = []
    for k, end in enumerate(np.searchsorted(low[:, 2], high[:, 2], side="right")):
        near = slice(k + 1, end)
        meet = ((low[near] <= high[k]) & (high[near] >= low[k])).all(axis=1)
        other = k + 1 + np.flatnonzero(meet)
        pairs.append(np.column_stack([np.full(len(other), k), other]))
    both = np.concatenate(pairs)
    joined = (triangles[both[:, 0]][:, :, None] == triangles[both[:, 1]][:, None, :]).any((1, 2))
    both = both[~joined]
    hit = np.zeros(len(both), bool)
    for one, two in ((0, 1), (1, 0)):
        edges, faces = corners[both[:, one]], corners[both[:, two]]
        for k in range(3):
            hit |= pierced(edges[:, k], edges[:, k - 1], faces)
    return int(hit.sum())


def pierced(start: Any, end: Any, faces: Any) -> Any:
    """Whether segments pass through triangles (Moeller & Trumbore)."""
    along, e, f = end - start, faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0]
    h = np.cross(along, f)
    det = (e * h).sum(axis=1)
    safe = np.where(np.abs(det) > 1e-14, det, np.inf)
    s = start - faces[:, 0]
    q = np.cross(s, e)
    u, v, t = ((a * b).sum(axis=1) / safe for a, b in ((s, h), (along, q), (f, q)))
    return np.isfinite(safe) & (u > 0) & (v > 0) & (u + v < 1) & (t > 0) & (t < 1)


@pytest.mark.parametrize(("name", "member"), MEMBERS)
def test_groups_cover_each_triangle_once(name: str, member: str) -> None:
    mesh = meshed(name, member, 1)
    together = np.sort(np.concatenate(list(mesh.groups.values())))
    assert (together == np.arange(len(mesh.triangles))).all()
    named = {
        "concave",
        "convex",
        "top_land",
        "bottom",
        "toe",
        "heel",
        "rim",
        "back",
        "bore",
        "front",
    }
    own = member_of(name, member)
    filleted = any("fillet" in own.flank(side).cut_pieces for side in SIDES)
    assert set(mesh.groups) == named | {"start", "end"} | ({"fillets"} if filleted else set())
    assert set(meshed(name, member, None).groups) == set(mesh.groups) - {"start", "end"}
    ring, cone = body(own), own.concave.cone
    for group, found in mesh.groups.items():
        x, y, z = mesh.vertices[mesh.triangles[found]].reshape(-1, 3).T
        rho = np.hypot(x, y)
        value, wanted = {
            "bore": (rho, ring.bore),
            "front": (z, ring.front),
            "back": (z, ring.back),
            "rim": (rho, ring.heel_base[1]),
            "toe": (cone.cone_distance_height(z, rho)[0], own.concave.toe),
            "heel": (cone.cone_distance_height(z, rho)[0], own.concave.heel),
        }.get(group, (0.0, 0.0))
        assert value == pytest.approx(wanted, abs=1e-9), group


def exact_at(own: Member, side: Side, points: Any) -> tuple[Any, Any, Any]:
    """How far points lie outside the exact flank, its normals there, and where it could be asked."""
    flank, turn = own.flank(side), own.tooth.turn if side == "convex" else 0.0
    hand = -1.0 if flank.mirrored else 1.0
    x, y, z = points.T
    rho = np.hypot(x, y)
    exact = flank.at(z, rho)
    (u, v, _), n = exact.position.T, exact.normal
    turned_by = np.arctan2(y, x) - np.arctan2(v, u)
    ahead = hand * turned_by - turn
    ahead -= own.tooth.pitch * np.round(ahead / own.tooth.pitch)  # of whichever slot
    around = (u * n[:, 1] - v * n[:, 0]) / rho
    c, s = np.cos(turned_by), np.sin(turned_by)
    normal = np.stack([c * n[:, 0] - s * n[:, 1], s * n[:, 0] + c * n[:, 1], n[:, 2]], axis=-1)
    return hand * ahead * rho * around, normal, np.isfinite(u)


@pytest.mark.parametrize(("name", "member"), MEMBERS)
@pytest.mark.parametrize("side", SIDES)
def test_vertices_and_normals_of_flanks_are_exact(name: str, member: str, side: Side) -> None:
    mesh, own = meshed(name, member, 1), member_of(name, member)
    triangles = mesh.triangles[mesh.groups[side]]
    used = np.unique(triangles)
    off, normal, ok = exact_at(own, side, mesh.vertices[used])
    assert ok.all()
    assert np.abs(off).max() < 1e-8
    assert np.abs(np.linalg.norm(mesh.normals, axis=1) - 1.0).max() < 1e-12
    same = (normal * mesh.normals[used]).sum(axis=1)
    if own.flank(side).generated:
        assert same.min() > 1.0 - 1e-10
    else:  # on the edge that an undercut leaves there are two
        assert (same > 1.0 - 1e-10).mean() > 0.8
    a, b, c = np.moveaxis(mesh.vertices[triangles], 1, 0)
    face = np.cross(b - a, c - a)
    assert ((face[:, None] * mesh.normals[triangles]).sum(axis=-1) > 0.0).all()


@pytest.mark.parametrize(("name", "member"), MEMBERS)
@pytest.mark.parametrize("side", SIDES)
def test_triangles_stand_off_the_flanks_by_less_than_measured(
    name: str, member: str, side: Side
) -> None:
    """At random places of the flank's triangles, by the exact flank itself."""
    mesh, own = meshed(name, member, 1), member_of(name, member)
    rng = np.random.default_rng(1)
    corners = mesh.vertices[mesh.triangles[mesh.groups[side]]]
    share = rng.dirichlet((1.0, 1.0, 1.0), (20, len(corners)))
    off, _, ok = exact_at(own, side, (share[..., None] * corners).sum(axis=2).reshape(-1, 3))
    assert ok.mean() > 0.9
    assert np.abs(off[ok]).max() <= 1.02 * mesh.chord_error


@pytest.mark.parametrize("name", ["pinion", "wheel"])
def test_the_other_hand_is_the_mirror_image(table_1_spec: ExactFaceHobbedSpec, name: str) -> None:
    left, right = (
        surface_mesh(
            getattr(build(replace(table_1_spec, pinion_hand=h)), name), teeth=2, chord_error=0.1
        )
        for h in ("left", "right")
    )
    assert left.vertices * [1.0, -1.0, 1.0] == pytest.approx(right.vertices, abs=1e-8)
    assert left.normals * [1.0, -1.0, 1.0] == pytest.approx(right.normals, abs=1e-8)
    assert (left.triangles[:, ::-1] == right.triangles).all()
    assert left.volume == pytest.approx(right.volume, rel=1e-11)
    assert right.volume > 0.0


@pytest.mark.parametrize("teeth", [1, 3, 5])
def test_one_end_is_the_other_turned(paper_pair: GearPair, teeth: int) -> None:
    mesh = surface_mesh(paper_pair.pinion, teeth=teeth, chord_error=0.2)
    start, end = (mesh.vertices[mesh.triangles[mesh.groups[g]]] for g in ("start", "end"))
    turn = teeth * paper_pair.pinion.tooth.pitch
    c, s = np.cos(turn), np.sin(turn)
    turned = start @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    assert turned[:, ::-1] == pytest.approx(end, abs=1e-9)
    assert mesh.watertight
    assert len(mesh.groups["top_land"]) % teeth == 0


def pappus(own: Member) -> float:
    """Volume, mm3, by radius times angle over the axial section: no mesh; slot bottoms at one height."""
    tooth, ring, cone = own.tooth, body(own), own.concave.cone
    x, weight = np.polynomial.legendre.leggauss(20)
    half = 0.5 * (own.concave.heel - own.concave.toe)
    distance, along = own.concave.toe + half * (1.0 + x), half * weight
    v = 0.5 * (1.0 + x)
    low = tooth.grid(distance, dict.fromkeys(SIDES, np.array([[0.0, 1.0]]))).concave.height[:, 0]
    total = 0.0
    for side, sign in (("concave", -1.0), ("convex", 1.0)):
        flank = own.flank(side)
        rise = np.asarray(flank.tip.at(distance)) - low
        joint = ((np.asarray(flank.charts["flank"].bounds(distance)[0]) - low) / rise)[:, None]
        for share, step in (
            (joint * v**2, joint * v),
            (joint + (1 - joint) * v, 0.5 * (1 - joint)),
        ):
            rows = np.hstack([0.0 * joint, share, 0.0 * joint + 1.0])
            profile = tooth.grid(distance, dict.fromkeys(SIDES, rows)).side(side)
            height, angle = profile.height[:, 1:-1], profile.angle[:, 1:-1]
            radius = cone.axial_radial(distance[:, None], height)[1]
            total += sign * float(along @ (rise[:, None] * step * radius * angle) @ weight)
    base = ring.base_height[0]
    middle = cone.axial_radial(distance, 0.5 * (low + base))[1]
    total += tooth.pitch * float(along @ ((low - base) * middle))
    z, r = np.array([ring.toe_base, *ring.outline[1:]]).T
    z_next, r_next = np.roll(z, -1), np.roll(r, -1)
    section = abs(float(((z * r_next - z_next * r) * (r + r_next)).sum())) / 6.0
    return own.teeth * (total + tooth.pitch * section)


def test_volume_converges_with_the_square_of_the_triangles_size(paper_pair: GearPair) -> None:
    pinion = paper_pair.pinion
    exact = pappus(pinion)
    meshes = [surface_mesh(pinion, teeth=1, chord_error=e) for e in (0.025, 0.006)]
    errors = [abs(pinion.teeth * mesh.volume / exact - 1.0) for mesh in meshes]
    sizes = [len(mesh.triangles) ** -0.5 for mesh in meshes]
    order = np.log(errors[0] / errors[1]) / np.log(sizes[0] / sizes[1])
    assert errors[1] < 3e-4
    assert order == pytest.approx(2.0, abs=0.1)


def test_mass_properties_are_those_of_the_solid() -> None:
    mesh = meshed("gonzalez-fuentes-2022", "pinion", 1)
    found, seen = mass_properties(mesh, density=7.85), read_by_trimesh(mesh)
    assert found.mass == pytest.approx(7.85e-6 * seen.volume, rel=1e-12)
    assert found.centre == pytest.approx(seen.center_mass, abs=1e-9)
    assert found.inertia == pytest.approx(7.85e-6 * seen.moment_inertia, rel=1e-9)
    gear = mass_properties(meshed("gonzalez-fuentes-2022", "pinion", None))
    assert gear.centre[:2] == pytest.approx((0.0, 0.0), abs=1e-9)
    across = gear.inertia - np.diag(np.diag(gear.inertia))
    assert np.abs(across).max() < 1e-9 * gear.inertia[2, 2]
    assert gear.inertia[0, 0] == pytest.approx(gear.inertia[1, 1], rel=1e-9)


def test_a_pointed_tooth_is_closed(paper_pair: GearPair) -> None:
    """Stock taken off until the toe has no top land, and the heel still has."""
    pinion = paper_pair.pinion
    land = np.ptp(
        [p.angle[:, -1] for p in (pinion.tooth.grid(9, 5).concave, pinion.tooth.grid(9, 5).convex)],
        axis=0,
    )
    thin = replace(pinion, stock_turn=-0.5 * (land.min() + land.max()))
    mesh = surface_mesh(thin, teeth=1, chord_error=COARSE)
    assert mesh.watertight
    assert read_by_trimesh(mesh).is_volume
    assert mesh.chord_error <= COARSE
    assert mesh.volume < meshed("gonzalez-fuentes-2022", "pinion", 1).volume


def test_bore_and_back_face_are_where_they_are_asked(paper_pair: GearPair) -> None:
    usual = body(paper_pair.wheel)
    mesh = surface_mesh(
        paper_pair.wheel, teeth=1, chord_error=0.1, bore=60.0, back=usual.back + 5.0
    )
    rho = np.hypot(*mesh.vertices[:, :2].T)
    assert rho.min() == pytest.approx(60.0)
    assert mesh.vertices[:, 2].max() == pytest.approx(usual.back + 5.0)
    assert read_by_trimesh(mesh).is_volume


def test_all_that_is_wrong_with_a_request_is_said_at_once(paper_pair: GearPair) -> None:
    with pytest.raises(DesignError) as error:
        surface_mesh(paper_pair.pinion, teeth=7, chord_error=0.0, bore=50.0, back=0.0)
    said = {p.path: p.expected for p in error.value.problems}
    assert set(said) == {"teeth", "chord_error", "bore", "back"}
    assert "1 to 6" in said["teeth"]
    assert f"{body(paper_pair.pinion).toe_base[1]:.4g} mm" in said["bore"]


@pytest.mark.parametrize("bad", [-1.0, 0.0, float("nan"), float("inf"), 1e-9])
def test_a_chord_error_that_is_none_is_refused(paper_pair: GearPair, bad: float) -> None:
    with pytest.raises(DesignError, match="chord_error"):
        surface_mesh(paper_pair.pinion, chord_error=bad)


def test_teeth_without_metal_are_refused(paper_pair: GearPair) -> None:
    gone = replace(paper_pair.pinion, stock_turn=-0.9)
    with pytest.raises(DesignError, match="pinion tooth"):
        surface_mesh(gone, teeth=1, chord_error=COARSE)
