"""Face and root cones of both members: ISO 23509, clause 7.4, (140)-(153).

Each pinion cone is laid against a wheel cone in space: the pinion face cone touches the wheel
root cone drawn in by the clearance, the pinion root cone touches the wheel face cone likewise.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, atan2, cos, pi, sin, tan

from ._depths import MeanDepths
from ._pitch_cones import PitchCones


@dataclass(frozen=True)
class FaceAndRootCones:
    """Angles (rad) and apex positions (mm) of the four cones; pairs are (pinion, wheel)."""

    face_angle: tuple[float, float]  # delta_a
    root_angle: tuple[float, float]  # delta_f
    addendum_angle: tuple[float, float]  # theta_a
    dedendum_angle: tuple[float, float]  # theta_f
    face_apex_beyond_crossing: tuple[float, float]  # t_zF1, t_zF2
    root_apex_beyond_crossing: tuple[float, float]  # t_zR1, t_zR2
    root_plane_offset_angle: float  # zeta_R, pinion offset angle in the wheel root plane
    face_plane_offset_angle: float  # zeta_o, pinion offset angle in the wheel face plane


def face_and_root_cones(
    cones: PitchCones,
    depths: MeanDepths,
    *,
    wheel_addendum_angle: float = 0.0,
    wheel_dedendum_angle: float = 0.0,
) -> FaceAndRootCones:
    """Face and root cones from the pitch cones and the wheel's own taper.

    theta_a2 = theta_f2 = 0 is uniform depth, the face-hobbed case; rad.
    """
    delta1, delta2 = cones.pinion_pitch_angle, cones.wheel_pitch_angle
    theta_a2, theta_f2 = wheel_addendum_angle, wheel_dedendum_angle
    delta_a2, delta_f2 = delta2 + theta_a2, delta2 - theta_f2
    big_r, t_z2, a = (
        cones.wheel_mean_cone_distance,
        cones.wheel_apex_beyond_crossing,
        cones.offset,
    )
    h_am2, h_fm2, c = depths.addendum[1], depths.dedendum[1], depths.clearance

    # wheel cones first: (148), (149)
    t_zf2 = t_z2 - (big_r * sin(theta_a2) - h_am2 * cos(theta_a2)) / sin(delta_a2)
    t_zr2 = t_z2 + (big_r * sin(theta_f2) - h_fm2 * cos(theta_f2)) / sin(delta_f2)

    zeta_r = _offset_angle(cones.shaft_angle, a, delta_f2, big_r * cos(theta_f2), t_z2)
    zeta_o = _offset_angle(cones.shaft_angle, a, delta_a2, big_r * cos(theta_a2), t_z2)
    delta_a1 = _mating_angle(cones.shaft_angle, delta_f2, zeta_r)
    delta_f1 = _mating_angle(cones.shaft_angle, delta_a2, zeta_o)
    # (150), (151)
    t_zf1 = (a * sin(zeta_r) * cos(delta_f2) - t_zr2 * sin(delta_f2) - c) / sin(delta_a1)
    t_zr1 = (a * sin(zeta_o) * cos(delta_a2) - t_zf2 * sin(delta_a2) - c) / sin(delta_f1)
    return FaceAndRootCones(
        face_angle=(delta_a1, delta_a2),
        root_angle=(delta_f1, delta_f2),
        addendum_angle=(delta_a1 - delta1, theta_a2),
        dedendum_angle=(delta1 - delta_f1, theta_f2),
        face_apex_beyond_crossing=(t_zf1, t_zf2),
        root_apex_beyond_crossing=(t_zr1, t_zr2),
        root_plane_offset_angle=zeta_r,
        face_plane_offset_angle=zeta_o,
    )


def _offset_angle(
    shaft_angle: float, offset: float, cone_angle: float, reach: float, t_z2: float
) -> float:
    """Offset angle zeta of the pinion axis in the plane of a wheel cone, rad: (141)-(144)."""
    distance = reach - t_z2 * cos(cone_angle)
    phi = atan2(offset * tan(shaft_angle - 0.5 * pi) * cos(cone_angle), distance)
    return asin(offset * cos(phi) * sin(cone_angle) / distance) - phi


def _mating_angle(shaft_angle: float, cone_angle: float, zeta: float) -> float:
    """Angle of the pinion cone that touches a wheel cone at offset angle zeta, rad: (145, 146)."""
    excess = shaft_angle - 0.5 * pi
    return asin(sin(excess) * sin(cone_angle) + cos(excess) * cos(cone_angle) * cos(zeta))
