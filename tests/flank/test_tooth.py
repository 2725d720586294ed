"""The tooth between two slots: thickness, tips, bottoms, and the flanks it is made of."""

from __future__ import annotations

from dataclasses import replace
from math import pi
from typing import Any

import numpy as np
import pytest
from independent import sweep_of

from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.flank import Tooth, ToothGrid
from hypoid.pair import GearPair, Member

MEMBERS = ("pinion", "wheel")


def made(member: Member, columns: int = 9, rows: int = 21) -> ToothGrid:
    return member.tooth.grid(columns, rows)


def places(tooth: Tooth, grid: ToothGrid, side: Any) -> Any:
    """Points (n, rows, 3) of a grid's flank, left-hand member."""
    profile = grid.side(side)
    z, rho = tooth.concave.cone.axial_radial(grid.distance[:, None], profile.height)
    return np.stack([rho * np.cos(profile.angle), rho * np.sin(profile.angle), z], axis=-1)


@pytest.mark.parametrize("name", MEMBERS)
def test_exact_face_hobbing_halves_the_pitch_at_the_mean_point(
    paper_pair: GearPair, name: str
) -> None:
    """Gonzalez-Perez & Fuentes-Aznar 2022, Table 3: blades lie flank to flank at P."""
    member: Member = getattr(paper_pair, name)
    distance = member.blank.mean_cone_distance
    _, radius = member.concave.cone.axial_radial(distance, 0.0)
    half = pi * float(radius) / member.teeth
    assert member.tooth.thickness([distance])[0] == pytest.approx(half, abs=1e-8)
    assert member.tooth.slot_width([distance])[0] == pytest.approx(half, abs=1e-8)


@pytest.mark.parametrize("name", MEMBERS)
@pytest.mark.parametrize("side", ["concave", "convex"])
def test_rows_lie_on_the_flank(paper_pair: GearPair, name: str, side: Any) -> None:
    member: Member = getattr(paper_pair, name)
    flank, grid = member.flank(side), made(member)
    hand = np.array([1.0, -1.0 if flank.mirrored else 1.0, 1.0])
    x, y, z = np.moveaxis(places(member.tooth, grid, side)[:, 1:], -1, 0)
    exact = flank.at(z, np.hypot(x, y))
    assert exact.ok.all()
    for k in range(member.teeth):  # the convex flank may be that of another slot
        turn = 2.0 * pi * k / member.teeth
        turned = np.stack(
            [np.cos(turn) * x - np.sin(turn) * y, np.sin(turn) * x + np.cos(turn) * y, z]
        )
        if np.abs(turned.reshape(3, -1).T - exact.position * hand).max() < 1e-8:
            return
    raise AssertionError(side)


@pytest.mark.parametrize("side", ["concave", "convex"])
def test_normals_point_out_of_the_tooth_and_square_to_it(paper_pair: GearPair, side: Any) -> None:
    tooth = paper_pair.pinion.tooth
    grid = tooth.grid(41, 41)
    point = places(tooth, grid, side)
    angle = grid.side(side).angle
    n = grid.side(side).normal
    c, s = np.cos(angle), np.sin(angle)
    normal = np.stack([c * n[..., 0] - s * n[..., 1], s * n[..., 0] + c * n[..., 1], n[..., 2]], -1)
    assert np.abs(np.linalg.norm(normal, axis=-1) - 1.0).max() < 1e-12
    for axis in (0, 1):
        along = np.gradient(point, axis=axis, edge_order=2)
        along /= np.linalg.norm(along, axis=-1, keepdims=True)
        off = np.abs((along * normal).sum(axis=-1))
        assert off[:, 3:].max() < 0.02
        assert off.max() < 0.06  # one-sided differences where rows are far apart along the fillet
    across = -1.0 if side == "concave" else 1.0  # from the tooth's middle to the slot
    around = np.stack([-point[..., 1], point[..., 0], 0.0 * angle], axis=-1)
    assert ((around * normal).sum(axis=-1)[:, 5:] * across > 0.0).all()


def test_the_other_hand_has_the_same_tooth(table_1_spec: ExactFaceHobbedSpec) -> None:
    left, right = (build(replace(table_1_spec, pinion_hand=h)).pinion for h in ("left", "right"))
    one, other = made(left), made(right)
    for side in ("concave", "convex"):
        assert one.side(side).angle == pytest.approx(other.side(side).angle, abs=1e-12)
        assert one.side(side).height == pytest.approx(other.side(side).height, abs=1e-9)


def test_stock_turn_thins_the_tooth_by_its_own_angle(paper_pair: GearPair) -> None:
    pinion = paper_pair.pinion
    thin = replace(pinion, stock_turn=-0.01)
    for distance in (pinion.concave.toe, pinion.concave.heel):
        _, radius = pinion.concave.cone.axial_radial(distance, 0.0)
        less = pinion.tooth.thickness([distance]) - thin.tooth.thickness([distance])
        assert less[0] == pytest.approx(0.01 * float(radius), abs=1e-9)
    difference = made(pinion).convex.angle - made(thin).convex.angle
    assert difference == pytest.approx(0.01, abs=1e-9)


def test_a_pointed_tooth_ends_where_its_flanks_cross(paper_pair: GearPair) -> None:
    """Stock taken off until the toe has no top land, and the heel still has."""
    pinion = paper_pair.pinion
    whole = made(pinion)
    land = (whole.convex.angle - whole.concave.angle)[:, -1]
    thin = replace(pinion, stock_turn=-0.5 * (land.min() + land.max()))
    grid = made(thin)
    thickness = grid.convex.angle - grid.concave.angle
    assert 0 < grid.pointed.sum() < len(grid.pointed)
    assert (thickness > 0.0).all()
    assert (thickness[grid.pointed, -1] < 2e-3).all()
    nominal = pinion.concave.tip.at(grid.distance)
    assert (grid.tip[grid.pointed] < nominal[grid.pointed]).all()
    assert grid.tip[~grid.pointed] == pytest.approx(nominal[~grid.pointed])


@pytest.mark.parametrize("name", MEMBERS)
def test_the_bottom_is_what_the_lands_sweep(paper_pair: GearPair, name: str) -> None:
    """Brute force: no point of either blade comes below the bottom by more than 0.1 um, some reach it."""
    member: Member = getattr(paper_pair, name)
    grid, tooth = made(member), member.tooth
    rng, n = np.random.default_rng(2), 300_000
    closest = np.inf
    for flank in (member.concave, member.convex):
        sweep = sweep_of(member, flank)
        start = sweep.ends[0]
        lengths = rng.uniform(start, start + sweep.blade.land, n)
        place = (lengths, sweep.theta_start + rng.uniform(-0.3, 0.3, n), rng.uniform(-0.3, 0.3, n))
        distance, height, _ = sweep.place(*place)
        here = np.abs(distance - 0.5 * (flank.toe + flank.heel)) < 5.0
        low = np.interp(distance[here], grid.distance, grid.bottom_height.min(axis=1))
        assert (height[here] - low).min() > -1e-4
        closest = min(closest, float(np.abs(height[here] - low).min()))
    assert closest < 1e-2
    assert tooth.pitch > (grid.bottom_angle[:, -1] - grid.bottom_angle[:, 0]).max() > 0.0
