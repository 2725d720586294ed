"""Undercut limits of the profile shift at toe and heel: ISO 23509, clause 8, (227)-(258)."""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, cos, sin, sqrt, tan
from typing import Literal

from ._blank import Name, PairBlank
from ._depths import DepthFactors
from ._pitch_cones import limit_pressure_angle
from ._spiral_angles import CrownGearTooth

Place = Literal["toe", "heel"]


@dataclass(frozen=True)
class UndercutLimit:
    """Bound of x_hm1 at one end of one member: a least value for the pinion, a greatest for the wheel."""

    member: Name
    place: Place
    cone_distance: float  # of the member, mm
    limit: float
    profile_shift: float  # x_hm1 of the blank

    @property
    def kept(self) -> bool:
        """Whether the blank keeps clear of undercut here."""
        spare = self.profile_shift - self.limit
        return spare >= 0.0 if self.member == "pinion" else spare <= 0.0


def undercut_limits(
    blank: PairBlank, factors: DepthFactors, tooth: CrownGearTooth, *, wheel_generated: bool = True
) -> tuple[UndercutLimit, ...]:
    """Limits at toe and heel of both members; a form-cut wheel cannot be undercut and has none."""
    found: list[UndercutLimit] = []
    members = (blank.pinion, blank.wheel) if wheel_generated else (blank.pinion,)
    for member in members:
        bound = _pinion if member.name == "pinion" else _wheel
        ends: tuple[tuple[Place, float], ...] = (
            ("toe", member.inner_cone_distance),
            ("heel", member.outer_cone_distance),
        )
        for place, distance in ends:
            limit = bound(blank, factors, tooth, distance)
            found.append(UndercutLimit(member.name, place, distance, limit, factors.profile_shift))
    return tuple(found)


def _angles(blank: PairBlank) -> tuple[float, float, float]:
    """alpha_nD, alpha_nC and their mean, rad."""
    own = blank.pressure_angles
    if own is None:
        angle = blank.pressure_angle or 0.0
        return angle, angle, angle
    return own.drive, own.coast, 0.5 * (own.drive + own.coast)


def _pinion(blank: PairBlank, factors: DepthFactors, tooth: CrownGearTooth, r_x1: float) -> float:
    """Least x_hm1 at a pinion cone distance (228)-(247)."""
    cones, (z1, z2) = blank.cones, blank.cones.teeth
    d1, d2, turn = cones.pinion_pitch_angle, cones.wheel_pitch_angle, cones.offset_angle_pitch_plane
    r_m2, gap = cones.wheel_mean_cone_distance, cones.pinion_mean_cone_distance - r_x1
    r_x2 = sqrt(r_m2**2 + gap**2 - 2.0 * r_m2 * gap * cos(turn))
    b2 = tooth.spiral_angle(r_x2)
    b1 = b2 + asin(cones.pitch_plane_offset / r_x2)
    d_x1, d_x2 = 2.0 * r_x1 * sin(d1), 2.0 * r_x2 * sin(d2)
    m_xn, m_mn = d_x2 / z2 * cos(b2), blank.mean_normal_module
    d_e = d_x2 * z1 * cos(b2) / (z2 * cos(b1))
    drive, coast, mean = _angles(blank)
    limit = limit_pressure_angle((d1, d2), (d_e / (2.0 * sin(d1)), r_x2), (b1, b2), turn)
    z_n = z1 / ((1.0 - (sin(b1) * cos(mean)) ** 2) * cos(b1) * cos(d1))
    least = min(drive - limit, coast + limit)
    k = factors.addendum + (r_x2 - r_m2) * tan(blank.wheel.addendum_angle) / m_mn
    shift = 1.1 * k - 0.5 * z_n * m_xn * sin(least) ** 2 / m_mn
    return shift + 0.5 * (d_e - d_x1) * cos(d1) / m_mn


def _wheel(blank: PairBlank, factors: DepthFactors, tooth: CrownGearTooth, r_x2: float) -> float:
    """Greatest x_hm1 at a wheel cone distance (249)-(258)."""
    cones, z2 = blank.cones, blank.cones.teeth[1]
    d2, b2 = cones.wheel_pitch_angle, tooth.spiral_angle(r_x2)
    m_xn, m_mn = 2.0 * r_x2 * sin(d2) / z2 * cos(b2), blank.mean_normal_module
    drive, coast, mean = _angles(blank)
    z_n = z2 / ((1.0 - (sin(b2) * cos(mean)) ** 2) * cos(b2) * cos(d2))
    k = factors.addendum
    k += (r_x2 - cones.wheel_mean_cone_distance) * tan(blank.wheel.dedendum_angle) / m_mn
    return 0.5 * z_n * m_xn * sin(min(drive, coast)) ** 2 / m_mn - 1.1 * k
