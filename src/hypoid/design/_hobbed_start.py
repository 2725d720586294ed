"""Where a face-hobbed pinion's fit begins: the wheel's exact conjugate, or a crown gear in its root plane."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import Flank, Side

from ._conjugate import facing_settings
from ._hobbed_cut import HeadPlan, HobbedCut, hobbed_cut
from ._hobbed_wheel import HobbedWheel, hobbed_flanks, planned_head, reach_of
from ._milled_wheel import pitch_cone


@dataclass(frozen=True)
class Start:
    """Head and settings to begin from, and the flanks that they cut."""

    cut: HobbedCut
    plan: HeadPlan
    flanks: dict[Side, Flank]


def pinion_thickness(blank: PairBlank, normal_backlash: float) -> float:
    """Normal thickness of the pinion's tooth at the mean point that leaves the backlash, mm."""
    thickness = blank.wheel.thickness
    assert thickness is not None
    return math.pi * blank.mean_normal_module - normal_backlash - thickness.mean_normal


def plain_start(plan: HeadPlan, blank: PairBlank, thickness: float) -> Start | None:
    """The pinion that a crown gear in its root plane generates, no tilt; None where there is none."""
    angles = blank.pressure_angles
    assert angles is not None
    cut = hobbed_cut(
        blank.pinion,
        plan,
        tooth_thickness=thickness,
        pressure_angles=(angles.drive, angles.coast),
        generated=True,
    )
    if cut is None:
        return None
    return _cut_start(cut, plan, blank, cut.turns)


def conjugate_start(plan: HeadPlan, blank: PairBlank, wheel: HobbedWheel) -> Start | None:
    """The pinion that a form-cut wheel generates, exactly so with straight, unraked blades.

    Its blades are the wheel's, of the opposite kind.
    """
    cut, depth = (
        wheel.cut,
        blank.pinion.mean_dedendum,
    )  # of the pinion's tips below the wheel blades' P
    ratio = plan.groups / blank.pinion.teeth
    made = facing_settings(cut.settings, blank, cut.height + depth, ratio)
    (outer, inner), (first, second) = cut.radii, cut.angles
    twin = HobbedCut(made, (inner, outer), (second, first), depth, (0.0, 0.0), 0.0)
    return _cut_start(twin, plan, blank, None)


def _cut_start(
    cut: HobbedCut, plan: HeadPlan, blank: PairBlank, starts: tuple[float, float] | None
) -> Start | None:
    """The start with its flanks; None where one of them is not there at the mean point."""
    reach = reach_of(blank)
    head = planned_head(plan, cut, 0.0, reach)
    if head.faults("pinion"):
        return None
    flanks = hobbed_flanks(
        blank.pinion, pitch_cone(blank, "pinion"), cut.settings, head, reach, starts=starts
    )
    mean = [blank.pinion.mean_cone_distance]
    there = [np.isfinite(flank.parameters(mean, [0.0])[0][0]) for flank in flanks.values()]
    return Start(cut, plan, flanks) if all(there) else None
