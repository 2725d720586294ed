"""Pitch cones of a face-hobbed pair by two conditions [gonzalez-fuentes-2022, (1) and (2)].

The pair turns with its tooth ratio at P, and the cutter centre stands in line with both pitch
apexes, so that one crown gear cuts both members. Solved by `_cone_solver`.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin

from ._cone_solver import (
    LAST_WHEEL_ANGLE,
    WHEEL_ANGLE_STEPS,
    ConeInputs,
    Trial,
    solve_cones,
    trial_at,
)
from ._pitch_cones import PitchCones


@dataclass(frozen=True)
class FaceHobbedInputs:
    """What the two conditions need; mm and rad. Canonical pair, offset signed."""

    z1: int
    z2: int
    shaft_angle: float
    offset: float
    wheel_mean_radius: float
    pinion_spiral_angle: float
    cutter_radius: float
    blade_groups: int

    @property
    def cone_inputs(self) -> ConeInputs:
        """What the solver of cones takes of it."""
        return ConeInputs(
            self.z1,
            self.z2,
            self.shaft_angle,
            self.offset,
            lambda _: self.wheel_mean_radius,
            self.pinion_spiral_angle,
            "pinion",
        )


def alignment(trial: Trial, z2: int, cutter_radius: float, blade_groups: int) -> float:
    """Left side of [gonzalez-fuentes-2022, (2)] over R_m1 R_m2: zero with the centres in line."""
    direction = trial.beta_m1 - trial.slope_angle(z2, cutter_radius, blade_groups)
    return _alignment((trial.big_r_m1, trial.big_r_m2), trial.beta_m12, direction, cutter_radius)


def solve_aligned_cones(given: FaceHobbedInputs) -> PitchCones | None:
    """Pitch cones that meet both conditions, or None where there are none.

    The result may still be useless (wheel spiral below zero, cutter too small for its slope
    angle, taken as 90 deg then): `_limits.check_solution` says so.
    """
    head = given.z2, given.cutter_radius, given.blade_groups
    trial = solve_cones(given.cone_inputs, lambda trial: alignment(trial, *head))
    return None if trial is None else trial.cones(given.cone_inputs, trial.slope_angle(*head))


def nearest_blade_slope(given: FaceHobbedInputs) -> tuple[float, float]:
    """(sin nu, blade module mm) where the cutter centre comes closest to the line of the apexes.

    For a set of numbers without a solution: sin nu above 1 lays it to a cutter too small for its
    slope angle. Zeros where not even the tooth ratio and the offset can be had.
    """
    head = given.z2, given.cutter_radius, given.blade_groups
    ends = (0.5 * pi * i / WHEEL_ANGLE_STEPS for i in range(1, WHEEL_ANGLE_STEPS))
    trials = [t for delta2 in ends if (t := trial_at(given.cone_inputs, delta2)) is not None]
    best = min(trials, key=lambda trial: abs(alignment(trial, *head)), default=None)
    if best is None:
        return 0.0, 0.0
    m_b = 2.0 * best.r_m2 * cos(best.beta_m2) / given.z2
    return 0.5 * m_b * given.blade_groups / given.cutter_radius, m_b


def wants_internal_wheel(given: FaceHobbedInputs) -> bool:
    """Whether the alignment is still to come at delta2 = 90 deg, where the wheel turns internal."""
    flat = trial_at(given.cone_inputs, LAST_WHEEL_ANGLE)
    if flat is None:
        return False
    return alignment(flat, given.z2, given.cutter_radius, given.blade_groups) < 0.0


def ratio_residual(cones: PitchCones) -> float:
    """Left side of [gonzalez-fuentes-2022, (1)] over z1 + z2, mm: zero when the ratio holds."""
    z1, z2 = cones.teeth
    pinion = cones.pinion_mean_radius * z2 * cos(cones.pinion_spiral_angle)
    wheel = cones.wheel_mean_radius * z1 * cos(cones.wheel_spiral_angle)
    return (pinion - wheel) / (z1 + z2)


def alignment_residual(cones: PitchCones, cutter_radius: float) -> float:
    """Left side of [gonzalez-fuentes-2022, (2)] over R_m1 R_m2: zero with the centres in line."""
    return _alignment(
        (cones.pinion_mean_cone_distance, cones.wheel_mean_cone_distance),
        cones.offset_angle_pitch_plane,
        cones.pinion_spiral_angle - cones.slope_angle,
        cutter_radius,
    )


def _alignment(
    distances: tuple[float, float], beta_m12: float, direction: float, cutter_radius: float
) -> float:
    big_r1, big_r2 = distances
    wheel_side = big_r2 * sin(beta_m12)  # (3)
    pinion_gap = big_r1 - cutter_radius * sin(direction)  # (4)
    apex_gap = big_r2 * cos(beta_m12) - big_r1  # (5)
    cutter_side = cutter_radius * cos(direction)  # (6)
    return (wheel_side * pinion_gap - apex_gap * cutter_side) / (big_r1 * big_r2)
