"""Tooth thickness at the mean point and a first look at the top land: ISO 23509, clause 7.8."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, cos, pi, sin, tan

MIN_TOP_LAND = 0.25  # in mean normal modules, customary lower end for case-hardened teeth


@dataclass(frozen=True)
class ToothThickness:
    """Mean thicknesses of one member, mm."""

    mean_normal: float  # s_mn
    mean_transverse: float  # s_mt
    mean_normal_chordal: float  # s_mnc
    mean_chordal_addendum: float  # h_amc


@dataclass(frozen=True)
class TopLand:
    """Normal top land of one member, mm; a value below zero is a pointed tooth. An estimate."""

    outer: float
    mean: float
    inner: float

    @property
    def least(self) -> float:
        """Smallest of the three, mm."""
        return min(self.outer, self.mean, self.inner)


def mean_normal_thickness(
    mean_normal_module: float,
    *,
    thickness_factor: float = 0.0,
    profile_shift: float = 0.0,
    pressure_angle: float,
) -> float:
    """Normal thickness s_mn at the mean point, mm (ISO 23509, (209), (210)).

    x_sm and x_hm are the member's own: for the wheel, x_hm2 = -x_hm1. Half a pitch with both zero.
    """
    shift = thickness_factor + profile_shift * tan(pressure_angle)
    return mean_normal_module * (0.5 * pi + 2.0 * shift)


def tooth_thickness(
    mean_normal: float,
    *,
    pitch_angle: float,
    spiral_angle: float,
    mean_pitch_diameter: float,
    mean_addendum: float,
    pressure_angle: float,
) -> ToothThickness:
    """Transverse and chordal values of s_mn (ISO 23509, (211)-(215)); mm, rad."""
    ellipse = 1.0 - (sin(spiral_angle) * cos(pressure_angle)) ** 2
    d_mn = mean_pitch_diameter / (ellipse * cos(pitch_angle))
    half = mean_normal / d_mn
    return ToothThickness(
        mean_normal=mean_normal,
        mean_transverse=mean_normal / cos(spiral_angle),
        mean_normal_chordal=d_mn * sin(half),
        mean_chordal_addendum=mean_addendum + 0.5 * d_mn * cos(pitch_angle) * (1.0 - cos(half)),
    )


def top_land(
    normal_thickness: float,
    *,
    pitch_radius: float,
    pitch_angle: float,
    spiral_angle: float,
    addendum: float,
    pressure_angle: float,
) -> float:
    """Normal top land, mm, of the spur gear that stands for the normal section (mm, rad).

    The section has the pitch radius r / (cos delta cos^2 beta), as AGMA 929 takes it. It agrees
    with that standard's sample to 1 %; the exact flanks have the last word.
    """
    r_n = pitch_radius / (cos(pitch_angle) * cos(spiral_angle) ** 2)
    r_tip = r_n + addendum
    tip_angle = acos(min(1.0, r_n * cos(pressure_angle) / r_tip))  # rounding at 0 deg, no addendum
    flare = (tan(tip_angle) - tip_angle) - (tan(pressure_angle) - pressure_angle)
    return 2.0 * r_tip * (0.5 * normal_thickness / r_n - flare)
