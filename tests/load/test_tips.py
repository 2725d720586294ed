"""Rounded tips: where the arc begins and ends, and what it does to the gap and to the load at the tip."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from hypoid.contact import angle_field
from hypoid.load import LoadedContact, Outcome, ToothCompliance, loaded_contact
from hypoid.load._patch import Meeting, Window, meeting, patch
from hypoid.load._tips import active_field, falls_away, land_angle
from hypoid.pair import GearPair

RADIUS = 0.2


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
    pair = met.contact.pair
    rounded_pair = replace(
        pair,
        pinion=replace(pair.pinion, tip_rounding=RADIUS),
        wheel=replace(pair.wheel, tip_rounding=RADIUS),
    )
    round_ = patch(replace(met, contact=replace(met.contact, pair=rounded_pair)), window)
    both = sharp.on & round_.on
    before, after = np.full((2, *sharp.on.shape), np.nan)
    before[sharp.on], after[round_.on] = sharp.gap, round_.gap
    apart = np.full(sharp.on.shape, np.nan)
    lines = [(t[0] + sharp.plane @ t[1:]) / np.hypot(*t[1:]) for t in sharp.tips]
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


def test_a_pair_with_rounded_tips(
    relief_pair: GearPair,
    drive_teeth: tuple[ToothCompliance, ToothCompliance],
    loaded: LoadedContact,
) -> None:
    """A round of 0.2 mm at both tips: pressure away from them and rotation hardly know of it."""
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
    assert found.max_pressure == pytest.approx(sharp.max_pressure, rel=0.02)
