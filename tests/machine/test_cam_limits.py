"""How far a cam rolls uniformly: what the contact in `test_cam` shows, in numbers and in words."""

from __future__ import annotations

from dataclasses import replace
from math import degrees, radians

import numpy as np
import pytest

from hypoid.geometry import DesignError
from hypoid.machine import Cam
from hypoid.machine._cam import check_roll, cradle_limits

NO_23 = Cam(381.0, 70.302, 0.0, radians(5 + 10 / 60), 10 / 27)
NO_29 = Cam(381.0, 56.439, 0.0, radians(-40 / 60), 9 / 28)


def test_no_cam_rolls_further_than_a_quarter_turn() -> None:
    """C |alpha|/r_u < 90 deg: 16.6 deg of cradle for No. 23 and 13.3 for No. 29, guide straight; wider is more."""
    for own, degree in ((NO_23, 16.607), (NO_29, 13.332)):
        cam = replace(own, guide_angle=0.0)
        widest = cradle_limits(cam)
        assert np.degrees(widest) == pytest.approx([-degree, degree], abs=5e-4)
        narrower = [cradle_limits(cam, a)[1] for a in (20.0, 60.0, 200.0, 1e3, 1e7)]
        assert np.all(np.diff([*narrower, widest[1]]) > 0.0)
        assert narrower[-1] == pytest.approx(widest[1], rel=1e-5)


def test_limits_are_mirrored_with_the_guide() -> None:
    for cam in (NO_23, NO_29, replace(NO_23, setting=9.0), replace(NO_29, setting=-20.0)):
        for breadth in (None, 40.0):
            low, high = cradle_limits(cam, breadth)
            mirrored = replace(cam, guide_angle=-cam.guide_angle)
            assert cradle_limits(mirrored, breadth) == pytest.approx((-high, -low), abs=1e-15)
            assert low < 0.0 < high


def test_roll_beyond_the_uniform_motion_names_the_admissible_range() -> None:
    cam = NO_23
    low, high = cradle_limits(cam, 40.0)
    check_roll(cam, 40.0, low, high)
    check_roll(cam, None, radians(-16.0), radians(16.0))
    told = f"from {degrees(low):.2f} deg to {degrees(high):.2f} deg of the cradle"
    for roll in ((low - 1e-6, 0.0), (0.0, high + 1e-6)):
        with pytest.raises(DesignError, match=told) as caught:
            check_roll(cam, 40.0, *roll, path="pinion.convex.settings.cam_number")
        assert caught.value.problems[0].path == "pinion.convex.settings.cam_number"
