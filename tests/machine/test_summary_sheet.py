"""The sheet of the 2022 paper as a rigid motion: frames laid by hand against the basic chain."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin
from typing import Any

import numpy as np
import pytest

from hypoid.machine import MachineSettings, SummarySheet, chain, from_sheet, to_sheet
from hypoid.pair import GearPair, Member

Array = np.ndarray[Any, Any]


def by_sheet(
    sheet: SummarySheet, apex_beyond: float, point: Array, theta: float, phi: float
) -> Any:
    """A cutter point in the member's frame, laid out as Figs. 3-5 and A.16 do (left hand, no tilt).

    Machine plane as complex numbers; z_m1 points to the work (notes of 2022, item 2).
    """
    assert sheet.tilt_angle == sheet.swivel_angle == 0.0
    in_cutter = complex(point[0], point[1]) * np.exp(-1j * theta)
    centre = sheet.radial_distance * np.exp(-1j * sheet.cradle_angle)
    in_cradle = centre + 1j * np.exp(-1j * sheet.cradle_angle) * in_cutter
    in_plane = in_cradle * np.exp(1j * phi)
    at = np.array([in_plane.real, in_plane.imag, point[2]])
    gamma = sheet.machine_root_angle
    axis = np.array([cos(gamma), 0.0, sin(gamma)])  # of the work, apex to heel
    across = np.array([0.0, 1.0, 0.0])
    apex = np.array([0.0, sheet.blank_offset, sheet.sliding_base])
    apex = apex + sheet.machine_center_to_back * axis
    arm = at - apex
    around = complex(arm @ np.cross(across, axis), arm @ across)
    around *= np.exp(-1j * (sheet.ratio_of_roll * phi + sheet.roll_to_blade_ratio * theta))
    return np.array([around.real, around.imag, arm @ axis - apex_beyond])


@pytest.mark.parametrize("choose", [lambda p: p.pinion, lambda p: p.wheel], ids=["pinion", "wheel"])
def test_sheet_and_basic_settings_are_one_rigid_motion(
    paper_pair: GearPair, choose: Callable[[GearPair], Member]
) -> None:
    member, rng = choose(paper_pair), np.random.default_rng(1)
    sheet, apex = member.sheet("concave"), member.blank.pitch_apex_beyond_crossing_point
    for theta, phi in rng.uniform(-0.4, 0.4, (20, 2)):
        point = rng.uniform([90, -9, -3], [105, 9, 3])
        expected = chain(member.concave.settings, theta, phi) @ np.append(point, 1.0)
        assert by_sheet(sheet, apex, point, theta, phi) == pytest.approx(
            expected[:3], abs=1e-12, rel=0
        )


def test_sheet_and_settings_translate_back_and_forth() -> None:
    settings = MachineSettings(
        radial_distance=112.0,
        cradle_angle=0.9,
        machine_root_angle=0.1,
        ratio_of_roll=2.9,
        roll_to_blade_ratio=13 / 15,
        tilt_angle=0.4,
        swivel_angle=-pi / 4,
        blank_offset=24.0,
        machine_center_to_back=-0.1,
        sliding_base=28.0,
        helical_motion=0.2,
        modified_roll=(0.01, 0.02),
    )
    sheet = to_sheet(settings, -17.4)
    assert sheet.blank_offset == -24.0  # the sheet's own sign
    assert sheet.machine_center_to_back == pytest.approx(17.3)  # counts to the pitch apex
    again = from_sheet(sheet, -17.4)
    assert again.machine_center_to_back == pytest.approx(-0.1, abs=1e-14)
    assert to_sheet(again, -17.4) == sheet
