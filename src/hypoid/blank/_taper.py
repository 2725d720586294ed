"""Depthwise tapers: the wheel's addendum and dedendum angles (ISO 23509, annex C, (C.3)-(C.11))."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, cos, pi, sin, tan
from typing import Literal

from ._depths import MeanDepths
from ._pitch_cones import PitchCones

Taper = Literal["standard", "uniform", "duplex", "modified"]


@dataclass(frozen=True)
class TaperAngles:
    """Addendum and dedendum angle of the wheel, rad."""

    addendum: float  # theta_a2
    dedendum: float  # theta_f2

    @property
    def total(self) -> float:
        """Sum of both, rad: the sum of the pair's dedendum angles."""
        return self.addendum + self.dedendum


def standard_sum(cones: PitchCones, depths: MeanDepths) -> float:
    """Sum of the dedendum angles whose root lines meet at the pitch apex, rad (C.3)."""
    distance = cones.wheel_mean_cone_distance
    return sum(atan(depth / distance) for depth in depths.dedendum)


def duplex_sum(
    cones: PitchCones,
    *,
    outer_transverse_module: float,
    outer_cone_distance: float,
    pressure_angle: float,
    cutter_radius: float,
) -> float:
    """Sum of the dedendum angles that gives both members slots of constant width, rad (C.5).

    Negative where the cutter is smaller than R_m2 sin(beta_m2): the teeth then deepen to the toe.
    """
    beta, distance = cones.wheel_spiral_angle, cones.wheel_mean_cone_distance
    size = 0.5 * pi * outer_transverse_module / outer_cone_distance
    return size / (tan(pressure_angle) * cos(beta)) * (1.0 - distance * sin(beta) / cutter_radius)


def taper_angles(
    taper: Taper,
    cones: PitchCones,
    depths: MeanDepths,
    *,
    outer_transverse_module: float,
    outer_cone_distance: float,
    pressure_angle: float,
    cutter_radius: float,
) -> TaperAngles:
    """Angles of a taper: standard, uniform, duplex (constant slot width), or modified slot width.

    Lengths mm, angles rad. Modified is the lesser of duplex and 1.3 times standard: the root line is
    tilted as far as tip and root allow.
    """
    if taper == "uniform":
        return TaperAngles(0.0, 0.0)
    standard = standard_sum(cones, depths)
    if taper == "standard":
        addendum = atan(depths.dedendum[0] / cones.wheel_mean_cone_distance)
        return TaperAngles(addendum, standard - addendum)
    total = duplex_sum(
        cones,
        outer_transverse_module=outer_transverse_module,
        outer_cone_distance=outer_cone_distance,
        pressure_angle=pressure_angle,
        cutter_radius=cutter_radius,
    )
    if taper == "modified":
        total = min(total, 1.3 * standard)
    addendum = total * depths.addendum[1] / depths.working_depth
    return TaperAngles(addendum, total - addendum)
