"""The envelope is the boundary of what is cut: a sweep of the whole blade, with no meshing condition."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import pytest
from independent import Sweep, sweep_of

from hypoid.flank import Flank, PointStatus
from hypoid.pair import GearPair, Member

Array = np.ndarray[Any, Any]
NAMES = [(m, s) for m in ("pinion", "wheel") for s in ("concave", "convex")]
AGREEMENT = 1e-6  # mm, along the normal; reached: 1e-8


def flank_angle(flank: Flank, distance: Array, height: Array) -> tuple[Array, Array]:
    """Angle of the flank there (left hand, rad) and the lever that turns angles to normal distance."""
    points = flank.at_cone(distance, height)
    assert (points.status == PointStatus.OK).all()
    hand = np.array([1.0, -1.0 if flank.mirrored else 1.0, 1.0])
    position, normal = points.position * hand, points.normal * hand
    around = np.stack([-position[:, 1], position[:, 0], 0.0 * position[:, 0]], axis=1)
    return np.arctan2(position[:, 1], position[:, 0]), (around * normal).sum(axis=1)


def wrapped(angle: Array) -> Array:
    return np.angle(np.exp(1j * angle))


@pytest.mark.parametrize("relief", [False, True], ids=["straight", "relief"])
@pytest.mark.parametrize(("name", "side"), NAMES)
def test_the_flank_is_the_boundary_of_what_is_cut(
    paper_pair: GearPair,
    relief_pair: GearPair,
    name: str,
    side: Literal["concave", "convex"],
    relief: bool,
) -> None:
    """Toe, mean, heel by root to tip, fillet and relief included."""
    member: Member = getattr(relief_pair if relief else paper_pair, name)
    flank = member.flank(side)
    sweep = sweep_of(member, flank)
    heights = np.linspace(flank.root.at(0.0) + 0.02, flank.tip.at(0.0), 7)
    for distance in (flank.toe, member.blank.mean_cone_distance, flank.heel):
        cut = sweep.boundary(distance, heights, side)
        angle, lever = flank_angle(flank, np.full(7, distance), heights)
        apart = wrapped(cut - angle) * lever
        assert np.abs(apart).max() < AGREEMENT


def inside_the_blank(flank: Flank, place: tuple[Array, Array, Array]) -> tuple[Array, ...]:
    distance, height, angle = place
    inside = (distance > flank.toe) & (distance < flank.heel)
    inside &= (height > flank.root.at(0.0)) & (height < flank.tip.at(0.0))
    return distance[inside], height[inside], angle[inside]


@pytest.mark.parametrize(("name", "side"), NAMES)
def test_no_swept_point_lies_inside_the_finished_tooth(
    relief_pair: GearPair, name: str, side: Literal["concave", "convex"]
) -> None:
    """Neither the blade that cuts the flank nor, a pitch on, the one that cuts the slot's other side."""
    member: Member = getattr(relief_pair, name)
    flank, rng, n = member.flank(side), np.random.default_rng(5), 400_000
    other = member.convex if side == "concave" else member.concave
    pitch = 2.0 * np.pi / member.teeth
    seen = 0
    for cutting, shift in ((flank, 0.0), (other, -pitch if side == "concave" else pitch)):
        sweep: Sweep = sweep_of(member, cutting)
        lengths = rng.uniform(*sweep.ends, n)
        theta = sweep.theta_start + rng.uniform(-0.4, 0.4, n)
        place = sweep.place(lengths, theta, rng.uniform(-0.35, 0.35, n))
        distance, height, angle = inside_the_blank(flank, place)
        distance, height, angle = (v[:20_000] for v in (distance, height, angle))
        surface, lever = flank_angle(flank, distance, height)
        # the normal points out of the tooth, so a swept point is outside where this is positive
        outside = wrapped(angle + shift - surface) * lever
        assert outside.min() > -1e-5
        if cutting is flank:
            assert outside.min() < 0.02  # and some come close
        seen += len(outside)
    assert seen > 5_000


@pytest.mark.parametrize(("name", "side"), NAMES)
def test_points_swept_next_to_the_envelope_stay_outside(
    paper_pair: GearPair, name: str, side: Literal["concave", "convex"]
) -> None:
    """The blade on its way past each flank point: it touches, and cuts no deeper."""
    member: Member = getattr(paper_pair, name)
    flank, sweep = member.flank(side), sweep_of(member, member.flank(side))
    middle = np.linspace(flank.toe, flank.heel, 9)[1:-1]
    points = flank.at_cone(*(g.ravel() for g in np.meshgrid(middle, [-1.0, 0.0, 1.0])))
    on_blade = points.piece == 0
    lengths, theta = points.s[on_blade, None], points.theta[on_blade, None]
    phi = np.linspace(-0.25, 0.25, 2001)[None, :]
    distance, height, angle = inside_the_blank(flank, sweep.place(lengths, theta, phi))
    surface, lever = flank_angle(flank, distance, height)
    outside = wrapped(angle - surface) * lever
    assert outside.min() > -1e-5
    assert np.sort(outside)[: on_blade.sum() // 2].max() < 1e-4
