"""Shaft angle, offset and crossing points recovered from the machine settings alone.

Both cradles share their axis (z_m1 and z_m2 opposite) and both cutters share theirs; the wheel's
hand is the other one, so its machine is the mirror image [gonzalez2022, section 3].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import cos, degrees, radians, sin
from typing import Any

import numpy as np
import pytest

from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.machine import MachineSettings
from hypoid.pair import GearPair

Array = np.ndarray[Any, Any]
Change = Callable[[ExactFaceHobbedSpec], ExactFaceHobbedSpec]


@dataclass(frozen=True)
class WorkAxis:
    """The axis of a work in the pinion machine's frame: unit, apex to heel, and its crossing point."""

    direction: Array
    crossing: Array


def work_axis(settings: MachineSettings) -> WorkAxis:
    gamma = settings.machine_root_angle
    direction = np.array([cos(gamma), 0.0, sin(gamma)])
    foot = np.array([0.0, -settings.blank_offset, settings.sliding_base])
    return WorkAxis(direction, foot + settings.machine_center_to_back * direction)


def assembled(pair: GearPair) -> tuple[WorkAxis, WorkAxis, float]:
    """Both axes in one frame and what is left between the two cutter axes, mm."""
    ours, theirs = pair.pinion.concave.settings, pair.wheel.concave.settings
    turn = ours.cradle_angle - theirs.cradle_angle

    def cutter(s: MachineSettings, mirror: float) -> Array:
        q = s.cradle_angle
        return s.radial_distance * np.array([cos(q), -mirror * sin(q), 0.0])

    def from_wheel_machine(v: Array) -> Array:
        x, y, z = v[0], -v[1], -v[2]  # half a turn about x_m: z_m2 against z_m1
        return np.array([cos(turn) * x + sin(turn) * y, cos(turn) * y - sin(turn) * x, z])

    mirror = np.array([1.0, -1.0, 1.0])  # the wheel has the other hand
    axis = work_axis(theirs)
    wheel = WorkAxis(*(from_wheel_machine(mirror * v) for v in (axis.direction, axis.crossing)))
    apart = cutter(ours, 1.0) - from_wheel_machine(cutter(theirs, -1.0))
    return work_axis(ours), wheel, float(np.linalg.norm(apart))


CASES: dict[str, dict[str, Any]] = {
    "Table 1": {},
    "right-hand pinion": {"pinion_hand": "right"},
    "70 deg": {"shaft_angle": radians(70.0), "offset": 30.0, "pinion_teeth": 12},
    "110 deg": {
        "shaft_angle": radians(110.0),
        "offset": 30.0,
        "pinion_teeth": 20,
        "wheel_teeth": 45,
        "pinion_spiral_angle": radians(45.0),
    },
}


@pytest.mark.parametrize("case", CASES)
def test_offset_and_shaft_angle_from_the_settings(
    table_1_spec: ExactFaceHobbedSpec, case: str
) -> None:
    spec = replace(table_1_spec, **CASES[case])
    pair = build(spec)
    pinion, wheel, apart = assembled(pair)
    assert apart < 1e-11  # one cutter axis
    cosine = float(pinion.direction @ wheel.direction)
    assert degrees(np.arccos(cosine)) == pytest.approx(degrees(spec.shaft_angle), abs=1e-9)
    common = np.cross(pinion.direction, wheel.direction)
    common /= np.linalg.norm(common)
    between = pinion.crossing - wheel.crossing
    assert abs(between @ common) == pytest.approx(spec.offset, abs=1e-9)
    # both crossing points are the feet of the common perpendicular
    assert np.cross(between, common) == pytest.approx(np.zeros(3), abs=1e-9)
    ours, theirs = pair.pinion.concave.settings, pair.wheel.concave.settings
    ratio = spec.wheel_teeth / spec.pinion_teeth  # both roll with one crown gear
    assert ours.ratio_of_roll / theirs.ratio_of_roll == pytest.approx(ratio, rel=1e-14)
    assert ours.roll_to_blade_ratio / theirs.roll_to_blade_ratio == pytest.approx(ratio, rel=1e-14)


def test_either_hand_has_the_same_settings(table_1_spec: ExactFaceHobbedSpec) -> None:
    left, right = build(table_1_spec), build(replace(table_1_spec, pinion_hand="right"))
    assert (right.pinion.blank.hand, right.wheel.blank.hand) == ("right", "left")
    for a, b in zip(left.flanks(), right.flanks(), strict=True):
        assert a.settings == b.settings
        assert a.mirrored != b.mirrored
