"""Gonzalez-Perez & Fuentes-Aznar, Mech. Mach. Theory 179 (2023) 105115: Tables 4 and 5.

Printed digits first, then those of the notes' 30-digit calculation. Erratum: (19) as printed gives
S_r = 208.36; its last term must be negative. (25) has the other sign than Table 5.
"""

from __future__ import annotations

from math import degrees, pi, sin
from typing import Any, Literal

import numpy as np
import pytest

from hypoid.machine import SummarySheet
from hypoid.pair import GearPair

TABLE_4 = {
    "machine_center_to_back": "0.0",
    "sliding_base": "0.0",
    "blank_offset": "0.0",
    "machine_root_angle": "78.152",
    "ratio_of_roll": "1.021768",
    "roll_to_blade_ratio": "0.068493",
    "radial_distance": "108.966",
    "cradle_angle": "47.606",
}
TABLE_5 = {
    "machine_center_to_back": "18.029",
    "sliding_base": "-3.376",
    "blank_offset": "-55.489",
    "machine_root_angle": "10.791",
    "ratio_of_roll": "12.431511",
    "roll_to_blade_ratio": "0.833333",
    "radial_distance": "108.966",
    "cradle_angle": "72.298",
}
ANGLES = ("machine_root_angle", "cradle_angle")


def printed(sheet: SummarySheet, name: str, text: str) -> bool:
    value = getattr(sheet, name)
    value = degrees(value) if name in ANGLES else value
    return f"{value + 0.0:.{len(text.partition('.')[2])}f}" == text


@pytest.mark.parametrize("side", ["concave", "convex"])
@pytest.mark.parametrize("name", TABLE_4)
def test_table_4_wheel(paper_pair: GearPair, name: str, side: Literal["concave", "convex"]) -> None:
    assert printed(paper_pair.wheel.sheet(side), name, TABLE_4[name])


@pytest.mark.parametrize("side", ["concave", "convex"])
@pytest.mark.parametrize("name", TABLE_5)
def test_table_5_pinion(
    paper_pair: GearPair, name: str, side: Literal["concave", "convex"]
) -> None:
    assert printed(paper_pair.pinion.sheet(side), name, TABLE_5[name])


def test_both_sides_share_settings_without_tilt(paper_pair: GearPair) -> None:
    """One head cuts both sides (Cyclo-Cut), no crowning asked for."""
    for member in (paper_pair.pinion, paper_pair.wheel):
        sheet = member.sheet("concave")
        assert sheet == member.sheet("convex")
        assert sheet.tilt_angle == sheet.swivel_angle == sheet.helical_motion == 0.0
        assert not any(sheet.modified_roll)


def test_more_digits_of_a_30_digit_calculation(paper_pair: GearPair) -> None:
    pinion, wheel = paper_pair.pinion.sheet("concave"), paper_pair.wheel.sheet("concave")
    assert wheel.radial_distance == pytest.approx(108.966409, abs=6e-7)
    assert pinion.radial_distance == pytest.approx(wheel.radial_distance, abs=1e-12)
    assert degrees(wheel.cradle_angle) == pytest.approx(47.6060241, abs=6e-8)
    assert degrees(pinion.cradle_angle) == pytest.approx(72.2982714, abs=6e-8)
    assert pinion.ratio_of_roll == pytest.approx(12.4315111, abs=6e-8)
    assert pinion.machine_center_to_back == pytest.approx(18.0294490, abs=6e-8)
    assert pinion.sliding_base == pytest.approx(-3.3757062, abs=6e-8)
    assert pinion.blank_offset == pytest.approx(-55.4888893, abs=6e-8)


def test_blade_at_the_pitch_point_from_the_line_of_centres(paper_pair: GearPair) -> None:
    """Notes, item 6: 101.1917 deg, for both blades of both members."""
    for member in (paper_pair.pinion, paper_pair.wheel):
        for flank, lag in ((member.concave, 0.0), (member.convex, -pi / 5)):
            x, y, _ = (np.asarray(c) for c in flank.pieces["flank"].start)
            # the cutter's x axis stands at 90 deg from the line of centres
            turn = degrees(np.arctan2(y, x) - lag) + 90.0
            assert turn == pytest.approx(101.1917, abs=5e-5)
            assert flank.theta_start == lag


def test_printed_19_has_the_wrong_sign(paper_pair: GearPair) -> None:
    """As printed (19) gives 208.36; it is what a test of Table 4 must not accept."""
    cones = paper_pair.blank.cones
    r, distance = 100.0, cones.wheel_mean_cone_distance
    beta = cones.wheel_spiral_angle - cones.slope_angle

    def radial(sign: Any) -> float:
        return (distance**2 + r**2 + sign * 2.0 * distance * r * sin(beta)) ** 0.5

    assert radial(+1) == pytest.approx(208.36, abs=5e-3)
    assert radial(-1) == pytest.approx(paper_pair.wheel.sheet("convex").radial_distance, abs=1e-12)
