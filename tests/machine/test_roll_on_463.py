"""A modified roll on the No. 463: which cam and seat, how far it rolls, and constants from a design file."""

from __future__ import annotations

from dataclasses import replace
from math import radians
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hypoid.geometry import DesignError
from hypoid.machine import MACHINES, Cam, MachineSettings, Workpiece, constants_of, roll_series
from hypoid.machine._cam import check_roll, cradle_limits
from hypoid.machine._gleason_463 import Cam463, Gleason463Constants, Gleason463Dials, roll_limits

NO_463 = MACHINES["gleason-463"]
HANDS = pytest.mark.parametrize("hand", ["left", "right"])
SHOP = Gleason463Constants(381.0, {23: Cam463(70.302, 101.6, 55.0), 29: Cam463(56.439, 76.2)})
ROLLING = MachineSettings(
    radial_distance=114.8,
    cradle_angle=0.9,
    machine_root_angle=0.35,
    ratio_of_roll=2.5,
    roll_to_blade_ratio=0.0,
    modified_roll=(0.02,),
)
DIALS = Gleason463Dials(
    eccentric_angle=radians(32.0),
    cradle_angle=radians(67.0),
    machine_root_angle=radians(20.0),
    cam_number=23,
    cam_setting=103.6,
    cam_guide_angle=radians(5.0),
    index_gears=(48, 80, 50, 81),
    index_interval=10,
)


@HANDS
@settings(max_examples=40, deadline=None)
@given(
    ratio=st.floats(1.2, 4.5), c2=st.floats(-0.05, 0.05), teeth=st.sampled_from([17, 27, 28, 41])
)
def test_series_is_met_in_ratio_and_second_order(
    hand: Any, ratio: float, c2: float, teeth: int
) -> None:
    """By one of the machine's cams, off its seat as little as any index interval of up to 39 lets it."""
    work = Workpiece(teeth, hand, SHOP)
    wanted = replace(ROLLING, ratio_of_roll=ratio, modified_roll=(c2,))
    dials = NO_463.from_basic(wanted, work)
    got = NO_463.to_basic(dials, work)
    assert got.cam is not None
    series = roll_series(got.cam)
    assert series.ratio_of_roll == pytest.approx(ratio, rel=1e-12)
    assert series.modified_roll[0] == pytest.approx(c2, abs=1e-12)
    assert got.ratio_of_roll == pytest.approx(ratio, rel=1e-12)
    off = abs(dials.cam_setting - SHOP.cams[dials.cam_number].nominal_setting)
    for interval in (n for n in range(5, 40) if np.gcd(n, teeth) == 1 and n / teeth < ratio):
        for (
            cam
        ) in SHOP.cams.values():  # k cos(phi) = R - 1, k sin(phi) = 2 c2 R, k = C/(r_u + delta)
            rate = ratio * teeth / interval
            k = np.hypot(rate - 1.0, 2.0 * c2 * rate)
            assert abs(SHOP.swivel_offset / k - cam.pitch_radius) >= off - 1e-9


def test_ratio_below_every_index_is_named() -> None:
    with pytest.raises(DesignError, match="a ratio of roll above the least index ratio") as caught:
        NO_463.from_basic(replace(ROLLING, ratio_of_roll=0.1), Workpiece(27, "right", SHOP))
    assert [p.path for p in caught.value.problems] == ["settings.ratio_of_roll"]


def test_index_that_is_no_whole_interval_is_named() -> None:
    cam = Cam(381.0, 70.302, 0.0, 0.0, 10.3 / 27)
    with pytest.raises(DesignError, match="a whole number of slots") as caught:
        NO_463.from_basic(replace(ROLLING, cam=cam), Workpiece(27, "right", SHOP))
    assert [p.path for p in caught.value.problems] == ["settings.index_interval"]


@pytest.mark.parametrize("setting", [31.2, 172.0, 350.0])
def test_cam_off_its_seat_by_more_than_its_radius(setting: float) -> None:
    """Then the shaft could turn back under it."""
    told = "a setting between 31.298 mm and 171.902 mm"
    with pytest.raises(DesignError, match=told) as caught:
        NO_463.to_basic(replace(DIALS, cam_setting=setting), Workpiece(27, "right", SHOP))
    assert [p.path for p in caught.value.problems] == ["settings.cam_setting"]


@HANDS
@pytest.mark.parametrize("number", [23, 29])
def test_limits_of_the_roll_are_those_of_the_chain_s_cam(hand: Any, number: int) -> None:
    """In phi of the chain, with the half breadth where it is known; `check_roll` names a roll beyond them."""
    work = Workpiece(27, hand, SHOP)
    dials = replace(DIALS, cam_number=number, cam_setting=78.0 if number == 29 else 103.6)
    cam, breadth = NO_463.to_basic(dials, work).cam, SHOP.cams[number].half_breadth
    assert cam is not None
    low, high = roll_limits(dials, work)
    assert (low, high) == pytest.approx(cradle_limits(cam, breadth), abs=1e-15)
    check_roll(cam, breadth, low, high)
    with pytest.raises(DesignError, match="within the uniform motion of the cam"):
        check_roll(cam, breadth, low, high + 1e-3)


def test_constants_of_a_design_file() -> None:
    """As the file names them (mm), else a stand-in that a design file may not rely on."""
    given_ = {
        "swivel_offset": 400.0,
        "cams": {"23": {"pitch_radius": 71.0, "nominal_setting": 100.0}},
    }
    constants = constants_of("gleason-463", given_)
    assert constants == Gleason463Constants(400.0, {23: Cam463(71.0, 100.0, None)})
    assert constants_of("gleason-463", None) is NO_463.constants
    assert constants_of("gleason-106", given_) is MACHINES["gleason-106"].constants
    basic = NO_463.to_basic(replace(DIALS, cam_setting=102.0), Workpiece(27, "right", constants))
    assert basic.cam == Cam(400.0, 71.0, 2.0, DIALS.cam_guide_angle, 10 / 27)
