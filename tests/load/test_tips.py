"""Rounded tips: where the arc begins and ends, and what it does to the gap and to the load at the tip."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from hypoid.contact import angle_field
from hypoid.load import LoadedContact, Outcome, ToothCompliance, loaded_contact
from hypoid.load._cells import Cells, compliance
from hypoid.load._meeting import Meeting, meeting
from hypoid.load._patch import Patch, Window, greatest, patch
from hypoid.load._position import position_contact
from hypoid.load._tips import active_field, falls_away, land_angle
from hypoid.pair import GearPair

RADIUS = 0.2
ALONE = 40e3  # N mm on one pair


@pytest.mark.parametrize("angle", [0.9, 1.2])
def test_the_arc_is_tangent_to_flank_and_land(angle: float) -> None:
    """In the flank's plane x runs out of the tooth past the sharp edge; the land falls away from it by the angle."""
    start = RADIUS * np.tan(0.5 * angle)
    assert falls_away(np.array([start, 2.0 * start, 1.0]), angle, RADIUS).max() < 1e-15
    end = start - RADIUS * np.sin(angle)  # inside the sharp edge, so negative: beyond it
    depth = falls_away(np.array([end * (1.0 - 1e-9)]), angle, RADIUS)[0]
    # the land's line through the sharp edge: depth = tan(angle) x
    assert depth == pytest.approx(-end * np.tan(angle), rel=1e-6)
    step = 1e-7
    slope = (falls_away(np.array([end + 2 * step]), angle, RADIUS)[0] - depth) / (-2 * step)
    assert slope == pytest.approx(np.tan(angle), rel=1e-3)
    assert falls_away(np.array([end - 1e-6]), angle, RADIUS)[0] == np.inf


def test_the_land_stands_square_to_the_axis_of_a_straight_tooth(relief_pair: GearPair) -> None:
    """A normal along the land's own is at no angle to it, one around the axis at a right one."""
    flank = relief_pair.pinion.concave
    slope, sine, cosine = (float(v) for v in (flank.tip.slope, flank.cone.sine, flank.cone.cosine))
    radial, axial = cosine - slope * sine, -sine - slope * cosine
    land = np.array([[radial, 0.0, axial]]) / np.hypot(1.0, slope)
    point = np.array([[20.0, 0.0, 60.0]])
    assert land_angle(flank, land, point)[0] == pytest.approx(0.0, abs=1e-7)
    around = land_angle(flank, np.array([[0.0, 1.0, 0.0]]), point)[0]
    assert around == pytest.approx(0.5 * np.pi)


def near_a_tip(loaded: LoadedContact) -> Meeting:
    found = meeting(loaded.unloaded, len(loaded.unloaded.phi) // 2 + 20, 1)
    assert found is not None
    return found


def test_gaps_open_at_rounded_tips_only(loaded: LoadedContact) -> None:
    met = near_a_tip(loaded)
    window = Window((-8.0, 8.0), (-2.0, 2.0))
    sharp = patch(met, window)
    round_ = patch(with_rounded_tips(met), window)
    both = sharp.on & round_.on
    before, after = np.full((2, *sharp.on.shape), np.nan)
    before[sharp.on], after[round_.on] = sharp.gap, round_.gap
    apart = np.full(sharp.on.shape, np.nan)
    lines = [arc.apart(sharp.plane) for arc in round_.arcs if arc is not None]
    apart[sharp.on] = np.min(lines, axis=0)
    far = both & (apart > RADIUS)
    assert far.sum() > 50
    np.testing.assert_allclose(after[far], before[far], atol=1e-12)
    close = both & (apart < 0.2 * RADIUS)
    assert close.any(), np.nanmin(apart)
    assert (after[close] > before[close] + 1e-3).all()


def test_a_field_that_goes_on_beyond_its_tip_is_the_same_below(relief_pair: GearPair) -> None:
    flank = relief_pair.wheel.convex
    field, further = angle_field(flank), active_field(flank, RADIUS)
    s = np.linspace(flank.toe, flank.heel, 7)
    h = np.asarray(flank.tip.at(s))
    np.testing.assert_array_equal(field.angle(s, h - 0.3), further.angle(s, h - 0.3))
    assert not np.asarray(field.holds(s, h + 0.5 * RADIUS)).any()
    assert np.asarray(further.holds(s, h + 0.5 * RADIUS)).all()
    assert active_field(flank, 0.0) is field


def with_rounded_tips(met: Meeting, radius: float = RADIUS) -> Meeting:
    pair = met.contact.pair
    rounded = replace(
        pair,
        pinion=replace(pair.pinion, tip_rounding=radius),
        wheel=replace(pair.wheel, tip_rounding=radius),
    )
    return replace(met, contact=replace(met.contact, pair=rounded))


@pytest.fixture(scope="module")
def across_a_tip(loaded: LoadedContact) -> Meeting:
    """A pair whose contact runs over the pinion's rounded tip, alone under `ALONE`."""
    found = meeting(loaded.unloaded, len(loaded.unloaded.phi) // 2 + 36, 0)
    assert found is not None
    return with_rounded_tips(found)


@pytest.fixture(scope="module")
def usual(across_a_tip: Meeting, loaded: LoadedContact) -> tuple[Patch, Any]:
    return alone(across_a_tip, loaded)


def alone(met: Meeting, loaded: LoadedContact) -> tuple[Patch, Any]:
    """The patch and its cells' forces."""
    found = position_contact([met], loaded.teeth, ALONE)
    assert found.outcome is Outcome.OK
    return found.patches[0], found.solution.force


def at_the_tip(p: Patch, force: Any) -> tuple[float, float, float]:
    """Greatest pressure on the pinion's arc, force on it, and greatest pressure well off it."""
    arc = p.arcs[0]
    assert arc is not None
    pressure, apart = force / p.area, arc.apart(p.plane) - arc.start
    return (
        float(pressure[apart < 0.0].max()),
        float(force[apart < 0.0].sum()),
        greatest(p, pressure, apart > 0.35),
    )


def test_strips_leave_no_place_out_and_count_none_twice(usual: tuple[Patch, Any]) -> None:
    p, _ = usual
    assert len(p.cut) > 100
    assert p.flat.min() > 0.0
    corners = p.corners
    low, high = np.array([p.window.along, p.window.across]).T
    place = low + (high - low) * np.random.default_rng(1).uniform(0.1, 0.9, (4000, 2))
    edge = np.roll(corners, -1, axis=1) - corners
    to = place[:, None, None] - corners
    side = edge[..., 0] * to[..., 1] - edge[..., 1] * to[..., 0]
    inside = (side >= 0.0).all(axis=2) | (side <= 0.0).all(axis=2)
    covered = inside.sum(axis=1)
    assert covered.max() == 1
    # beyond the arc's end, and off either flank, there is nothing
    arc = p.arcs[0]
    assert arc is not None
    on_flanks = p.edges[:, [1, 2, 3, 5, 6, 7]].min(axis=1) > 0.05
    reach = np.hypot(*p.size)
    near = np.hypot(*(place[:, None] - p.plane[on_flanks]).transpose(2, 0, 1)).min(axis=1) < reach
    bare = (covered == 0) & near & (arc.apart(place) > arc.start)
    assert bare.sum() < 0.02 * near.sum()


def test_compliance_with_strips_is_symmetric_and_positive(
    usual: tuple[Patch, Any], loaded: LoadedContact
) -> None:
    matrix = compliance([Cells(usual[0], loaded.teeth)])
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-12 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix)[0] > 0.0


def test_pressure_on_a_rounded_tip_has_settled(
    usual: tuple[Patch, Any],
    across_a_tip: Meeting,
    loaded: LoadedContact,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Twice the rows and columns of the strip, within 3 %; without one it is far off, but not well inside the tip."""
    peak, force, off = at_the_tip(*usual)
    with monkeypatch.context() as finer:
        for name, value in (("ON_ARC", 16), ("BESIDE", 8), ("GROWTH", 1.2), ("STEPS", 0.5)):
            finer.setattr(f"hypoid.load._strips.{name}", value)
        fine = at_the_tip(*alone(across_a_tip, loaded))
    assert peak == pytest.approx(fine[0], rel=0.03)
    assert force == pytest.approx(fine[1], rel=0.04)
    monkeypatch.setattr("hypoid.load._position.bearing", lambda *_: {})
    p, bare = alone(across_a_tip, loaded)
    arc = p.arcs[0]
    assert arc is not None
    pressure, apart = bare / p.area, arc.apart(p.plane) - arc.start
    assert pressure[apart < 0.1].max() < 0.5 * peak
    assert greatest(p, pressure, apart > 0.35) == pytest.approx(off, rel=2e-3)


@pytest.mark.parametrize("radius", [RADIUS, 2.0 * RADIUS])
def test_pressure_on_a_rounded_tip_against_a_punch_with_rounded_edges(
    across_a_tip: Meeting, loaded: LoadedContact, radius: float
) -> None:
    """A wide flat punch, its edge an arc: the line load on the arc alone says the peak, 0.677 sqrt(E* f / r).

    With d the depth of contact on the arc and u = y/d from the contact's end, the plane-strain integral equation with
    slope y/r on the arc and none beyond gives p = E* d/(2 pi r) (2 sqrt u + (1 - u) ln|(1 + sqrt u)/(1 - sqrt u)|);
    on the arc that is f = E* d^2/(pi r) in all. The flank is not flat and its end is near, so 5 %.
    """
    u = np.linspace(0.0, 1.0, 100001)[1:-1]
    shape = 2.0 * np.sqrt(u) + (1.0 - u) * np.log((1.0 + np.sqrt(u)) / (1.0 - np.sqrt(u)))
    assert shape.mean() == pytest.approx(2.0, rel=1e-4)
    p, force = alone(with_rounded_tips(across_a_tip, radius), loaded)
    arc = p.arcs[0]
    assert arc is not None
    pressure, apart = force / p.area, arc.apart(p.plane) - arc.start
    way = np.array([-arc.line[2], arc.line[1]])
    along = p.plane @ way
    most = np.where(apart < 0.0, pressure, 0.0).argmax()
    column = (np.abs(along - along[most]) < 1e-9) & (apart < 0.0)
    load = force[column].sum() / np.ptp(p.corners[most] @ way)
    law = shape.max() / (2.0 * np.sqrt(np.pi)) * np.sqrt(loaded.teeth.plane_modulus * load / radius)
    assert pressure[most] == pytest.approx(law, rel=0.05)


def test_a_pair_with_rounded_tips(
    relief_pair: GearPair,
    drive_teeth: tuple[ToothCompliance, ToothCompliance],
    loaded: LoadedContact,
) -> None:
    """A round of 0.2 mm at both tips: rotation hardly knows of it, the greatest pressure counts it."""
    pair = replace(
        relief_pair,
        pinion=replace(relief_pair.pinion, tip_rounding=RADIUS),
        wheel=replace(relief_pair.wheel, tip_rounding=RADIUS),
    )
    found = loaded_contact(pair, "drive", [11e4], *drive_teeth, positions=9).cases[0]
    sharp = loaded.cases[-1]

    assert all(at.outcome is Outcome.OK for at in found.pitch)
    for a, b in zip(found.pitch, sharp.pitch, strict=True):
        assert a.rotation == pytest.approx(b.rotation, rel=2e-3)
    tips = [at.tip_pressure for at in found.pitch]
    assert max(tips) > 1.2 * sharp.max_pressure  # relief is too little at this torque
    assert found.max_pressure == max(tips)
    assert all(at.tip_pressure == 0.0 for at in sharp.pitch)
    # a contact that ends before the mate's fillet limit does not meet an edge there
    assert any(at.tip_pressure > 0.0 and not at.edge_contact for at in found.pitch)
