"""Spiral angle along the tooth and at its ends: ISO 23509, clause 7.6, (174)-(194)."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, asin, atan2, cos, sin, sqrt

from ._face_width import FaceWidth
from ._pitch_cones import PitchCones


@dataclass(frozen=True)
class EndSpiralAngles:
    """Spiral angles at heel and toe, rad; pairs are (pinion, wheel)."""

    outer: tuple[float, float]  # beta_e1, beta_e2
    inner: tuple[float, float]  # beta_i1, beta_i2
    pinion_outer_boundary: float  # R_e21: wheel cone distance of the pinion's heel, mm
    pinion_inner_boundary: float  # R_i21: wheel cone distance of the pinion's toe, mm


@dataclass(frozen=True)
class CrownGearTooth:
    """Lengthwise tooth line in the pitch plane: an epicycloid, or a circle with z0 = 0.

    Lengths in mm, angles in rad; `blade_groups` 0 means face milling (single indexing).
    """

    mean_cone_distance: float  # R_m2
    mean_spiral_angle: float  # beta_m2
    wheel_pitch_angle: float  # delta2
    wheel_teeth: int  # z2
    cutter_radius: float  # r_c0
    blade_groups: int  # z0
    slope_angle: float  # nu

    @property
    def centre_distance(self) -> float:
        """Distance of crown gear centre and cutter centre, rho_P0 (S_r), mm (175)."""
        big_r, r_c0 = self.mean_cone_distance, self.cutter_radius
        cross = 2.0 * big_r * r_c0 * sin(self.mean_spiral_angle - self.slope_angle)
        return sqrt(big_r**2 + r_c0**2 - cross)

    @property
    def base_radius(self) -> float:
        """Radius rho_b of the fixed circle of the epicycloid, mm (176)."""
        groups = self.blade_groups * sin(self.wheel_pitch_angle) / self.wheel_teeth
        return self.centre_distance / (1.0 + groups)

    @property
    def reach(self) -> tuple[float, float]:
        """Least and greatest cone distance that the cutter reaches, mm (both excluded)."""
        rho = self.centre_distance
        return abs(rho - self.cutter_radius), rho + self.cutter_radius

    def spiral_angle(self, cone_distance: float) -> float:
        """Spiral angle beta at a wheel cone distance R within `reach`, rad (177)-(180)."""
        big_r, rho, r_c0 = cone_distance, self.centre_distance, self.cutter_radius
        phi = acos((big_r**2 + rho**2 - r_c0**2) / (2.0 * big_r * rho))
        base = self.base_radius
        return atan2(big_r - base * cos(phi), base * sin(phi))


def crown_gear_tooth(cones: PitchCones, cutter_radius: float, blade_groups: int) -> CrownGearTooth:
    """Tooth line of a pair's crown gear for a cutter of radius r_c0, mm."""
    return CrownGearTooth(
        mean_cone_distance=cones.wheel_mean_cone_distance,
        mean_spiral_angle=cones.wheel_spiral_angle,
        wheel_pitch_angle=cones.wheel_pitch_angle,
        wheel_teeth=cones.teeth[1],
        cutter_radius=cutter_radius,
        blade_groups=blade_groups,
        slope_angle=cones.slope_angle,
    )


def pinion_boundaries(cones: PitchCones, pinion: FaceWidth) -> tuple[float, float]:
    """Wheel cone distances R_e21, R_i21 of the pinion's heel and toe, mm (174)."""
    big_r, turn = cones.wheel_mean_cone_distance, cos(cones.offset_angle_pitch_plane)
    outer = sqrt(big_r**2 + pinion.outer**2 + 2.0 * big_r * pinion.outer * turn)
    inner = sqrt(big_r**2 + pinion.inner**2 - 2.0 * big_r * pinion.inner * turn)
    return outer, inner


def end_spiral_angles(
    cones: PitchCones, tooth: CrownGearTooth, pinion: FaceWidth, wheel: FaceWidth
) -> EndSpiralAngles:
    """Spiral angles at both ends of both members, rad."""
    a_p = cones.pitch_plane_offset
    outer_boundary, inner_boundary = pinion_boundaries(cones, pinion)
    middle = cones.wheel_mean_cone_distance
    return EndSpiralAngles(
        outer=(
            tooth.spiral_angle(outer_boundary) + asin(a_p / outer_boundary),
            tooth.spiral_angle(middle + wheel.outer),
        ),
        inner=(
            tooth.spiral_angle(inner_boundary) + asin(a_p / inner_boundary),
            tooth.spiral_angle(middle - wheel.inner),
        ),
        pinion_outer_boundary=outer_boundary,
        pinion_inner_boundary=inner_boundary,
    )
