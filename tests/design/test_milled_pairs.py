"""The face-milled pairs of both papers, from their example files: what comes out, and what does not."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import degrees, pi, radians, sin
from typing import Any

import numpy as np
import pytest

from hypoid.contact import pattern, unloaded_contact
from hypoid.design import SummarySheetSpec, build
from hypoid.flank import deviation, flank_angles, recut
from hypoid.geometry import DesignError
from hypoid.io import example_files, read_spec
from hypoid.pair import GearPair

ARCSEC = 3600 * 180 / pi
SIDES = ("concave", "convex")


@cache
def spec_of(name: str) -> SummarySheetSpec:
    spec = read_spec(next(f for f in example_files() if f.stem == name))
    assert isinstance(spec, SummarySheetSpec)
    return spec


@cache
def pair_of(name: str) -> GearPair:
    return build(spec_of(name))


def test_lin_1996_angles_at_the_mean_point() -> None:
    """20 and 35 deg on all four flanks, to 0.09 deg (notes: machine constants)."""
    for flank in pair_of("lin-tsay-fong-1996").flanks():
        found = flank_angles(flank)
        assert degrees(found.pressure) == pytest.approx(20.0, abs=0.09)
        assert degrees(found.spiral) == pytest.approx(35.0, abs=0.09)


def test_lin_1996_root_apexes_lie_at_the_crossing_point() -> None:
    """Within 0.03 mm, with the corrected sign of M53(3, 4) (notes, item 7)."""
    pair = pair_of("lin-tsay-fong-1996")
    for member, root in ((pair.pinion, "20 26"), (pair.wheel, "21 15")):
        assert abs(member.blank.root_apex_beyond_crossing_point) < 0.03
        d, m = map(float, root.split())
        assert degrees(member.blank.root_angle) == pytest.approx(d + m / 60, abs=1e-6)


@pytest.mark.parametrize("direction", ["drive", "coast"])
def test_lin_1996_contact(direction: Any) -> None:
    """Centred, parabolic, without edges; the printed 9.49 and 9.91 arcsec do not come out (notes: 28)."""
    pair = pair_of("lin-tsay-fong-1996")
    contact = unloaded_contact(pair, direction)
    middle = pair.pinion.blank.mean_cone_distance
    assert contact.contact_point[0] == pytest.approx(middle, abs=0.5)
    assert not contact.edge_contact
    assert contact.peak_to_peak * ARCSEC == pytest.approx(28.0, abs=2.0)
    angle, lead = contact.phi[contact.on_path], contact.points.lead[contact.on_path]
    parabola = np.polynomial.Polynomial.fit(angle, lead, 2)
    assert np.abs(parabola(angle) - lead).max() < 0.06 * np.ptp(lead)
    assert 0.2 < pattern(contact).share < 0.5


def test_tsay_1993_helical_sign_decides_the_root_cone() -> None:
    """8.2 deg with E_s = X_b + h zeta, 2.5 deg as printed (notes, item 5)."""
    corrected, printed = (
        pair_of(name).pinion.blank.root_angle
        for name in ("tsay-lin-1993", "tsay-lin-1993-as-printed")
    )
    assert degrees(corrected) == pytest.approx(8.2, abs=0.05)
    assert degrees(printed) == pytest.approx(2.5, abs=0.1)


def test_tsay_1993_spiral_angles() -> None:
    """Pinion 36.2 deg at radius 22.40 mm, gear 27.7 to 27.8 deg (notes: sanity), by another pitch plane."""
    pair = pair_of("tsay-lin-1993")
    distance = 22.40 / sin(pair.pinion.blank.pitch_angle)
    pinion = [degrees(flank_angles(pair.pinion.flank(s), distance).spiral) for s in SIDES]
    wheel = [degrees(flank_angles(pair.wheel.flank(s)).spiral) for s in SIDES]
    assert np.mean(pinion) == pytest.approx(36.2, abs=0.3)
    assert np.mean(wheel) == pytest.approx(27.8, abs=0.1)


def test_tsay_1993_meshes_only_when_corrected() -> None:
    """Corrected, the drive flanks touch and the motion is that of a gear; as printed it is edges' alone."""
    corrected = unloaded_contact(pair_of("tsay-lin-1993"), "drive")
    assert len(corrected.on_path) > 20
    assert corrected.peak_to_peak * ARCSEC < 60.0
    for direction, least in (("drive", 250.0), ("coast", 1000.0)):
        contact = unloaded_contact(pair_of("tsay-lin-1993-as-printed"), direction)  # type: ignore[arg-type]
        assert contact.edge_contact
        assert contact.peak_to_peak * ARCSEC > least


def test_formate_root_angle_is_not_the_machine_root_angle() -> None:
    """76 deg 26 min against 73 deg 26 min (notes, item 6): software must not take one for the other."""
    wheel = pair_of("tsay-lin-1993").wheel
    assert degrees(wheel.blank.root_angle) == pytest.approx(76 + 26 / 60, abs=1e-9)
    assert degrees(wheel.concave.settings.machine_root_angle) == pytest.approx(
        73 + 26 / 60, abs=1e-9
    )


def test_duplex_cuts_both_flanks_from_one_setting() -> None:
    wheel = pair_of("lin-tsay-fong-1996").wheel
    assert wheel.concave.settings == wheel.convex.settings
    assert wheel.heads["concave"] is wheel.heads["convex"]
    pinion = pair_of("lin-tsay-fong-1996").pinion
    assert pinion.concave.settings != pinion.convex.settings


def test_deviation_of_a_flank_from_itself_and_of_a_larger_cutter_swing() -> None:
    """Nothing, and for a cradle angle a pure index error, which the turn takes out (notes: null directions)."""
    flank = pair_of("lin-tsay-fong-1996").wheel.concave
    assert deviation(flank, recut(flank, flank.settings)).largest < 1e-9
    swung = replace(flank.settings, cradle_angle=flank.settings.cradle_angle + radians(0.05))
    moved = recut(flank, swung)
    base = replace(flank.settings, sliding_base=flank.settings.sliding_base + 0.05)
    assert deviation(flank, moved).largest < 0.2 * abs(deviation(flank, moved).turn) * 60.0
    assert deviation(flank, recut(flank, base)).largest > 1e-4


def test_every_dial_out_of_range_is_named_at_once() -> None:
    """Where the file has its key: at the flank, or at the member for both."""
    spec = spec_of("tsay-lin-1993")
    wrong = dict(
        spec.pinion.concave.dials, cutter_spindle_rotation_angle=radians(200.0), sliding_base=1e4
    )
    at_flank = frozenset({"settings.sliding_base"})
    flank = replace(spec.pinion.concave, dials=wrong, at_flank=at_flank)
    with pytest.raises(DesignError) as caught:
        build(replace(spec, pinion=replace(spec.pinion, concave=flank)))
    assert [problem.path for problem in caught.value.problems] == [
        "pinion.settings.cutter_spindle_rotation_angle",
        "pinion.concave.settings.sliding_base",
    ]


def test_an_edge_that_does_not_fit_the_point_width_is_named() -> None:
    spec = spec_of("tsay-lin-1993")
    blade = replace(spec.pinion.concave.blade, edge_radius=8.0)
    flank = replace(spec.pinion.concave, blade=blade)
    with pytest.raises(DesignError, match="edge_radius"):
        build(replace(spec, pinion=replace(spec.pinion, concave=flank)))
