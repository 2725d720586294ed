"""Two pitch cones that touch at the pitch point P: space geometry for any shaft angle.

Frame G (canonical pair: left-hand pinion, right-hand wheel). Origin: foot of the common
perpendicular on the wheel axis. z_G: wheel axis, apex to heel. The pinion axis passes through
(0, a, 0) with direction d1 = (sin Sigma, 0, cos Sigma), apex to heel. Pinion axes in G:
x1 = (-cos Sigma, 0, sin Sigma), z1 = d1, y1 = z1 x x1 = (0, -1, 0); its origin is (0, a, 0).

P lies at azimuth xi from x_G about z_G, and at azimuth eta from x1 about z1. Both cones share the
pitch plane there. With n the unit normal of that plane, pointing out of the wheel cone and into
the pinion cone, n = (cos d2 cos xi, cos d2 sin xi, -sin d2), and its parts along x1, y1, z1 give

    cos d1 cos eta = cos Sigma cos d2 cos xi + sin Sigma sin d2
    cos d1 sin eta = cos d2 sin xi
    sin d1         = sin Sigma cos d2 cos xi - cos Sigma sin d2              (ISO 23509, (90))

P itself, seen from either axis, gives a = r_m1 sin eta + r_m2 sin xi (ISO 23509, (113)) and both
axial positions. At 90 deg these are (8)-(11) of Gonzalez-Perez & Fuentes-Aznar 2022.
The mirror pair (right-hand pinion) is the image of the canonical one in the plane y = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, atan, atan2, copysign, cos, pi, sin, tan

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Tangency:
    """How two tangent cones lie to each other; rad."""

    pinion_pitch_angle: float  # delta1
    pinion_azimuth: float  # eta, of P about the pinion axis, from x1
    offset_angle_pitch_plane: float  # beta_m12 = zeta_mp, signed as the offset


@dataclass(frozen=True)
class PitchCones:
    """Pitch cones of a pair in contact at P; mm and rad, canonical pair (left-hand pinion)."""

    shaft_angle: float  # Sigma
    offset: float  # a, positive when beta_m1 > beta_m2
    teeth: tuple[int, int]  # z1, z2
    pinion_offset_angle_axial: float  # xi = zeta_m, azimuth of P about the wheel axis
    wheel_offset_angle_axial: float  # eta, azimuth of P about the pinion axis
    pinion_pitch_angle: float  # delta1
    wheel_pitch_angle: float  # delta2
    pinion_spiral_angle: float  # beta_m1
    wheel_spiral_angle: float  # beta_m2
    offset_angle_pitch_plane: float  # beta_m12 = zeta_mp
    pinion_mean_radius: float  # r_m1
    wheel_mean_radius: float  # r_m2
    pinion_mean_cone_distance: float  # R_m1
    wheel_mean_cone_distance: float  # R_m2
    mean_normal_module: float  # m_mn
    slope_angle: float  # nu of the face-hob head, 0 for face milling
    pinion_apex_beyond_crossing: float  # t_z1; the apex lies at z = -t_z1 on the pinion axis
    wheel_apex_beyond_crossing: float  # t_z2
    limit_pressure_angle: float  # alpha_lim, ISO sign

    @property
    def gear_ratio(self) -> float:
        """Tooth ratio u = z2 / z1."""
        return self.teeth[1] / self.teeth[0]

    @property
    def wheel_azimuth(self) -> float:
        """Azimuth of P about the wheel axis in frame G, rad, from x_G towards y_G."""
        return self.pinion_offset_angle_axial

    @property
    def pinion_azimuth(self) -> float:
        """Azimuth of P about the pinion axis, rad, from x1 towards y1."""
        return self.wheel_offset_angle_axial

    @property
    def pitch_plane_offset(self) -> float:
        """Offset of the two pitch apexes in the pitch plane, a_p = R_m2 sin zeta_mp, mm."""
        return self.wheel_mean_cone_distance * sin(self.offset_angle_pitch_plane)

    @property
    def pitch_point(self) -> Vector:
        """P in frame G, mm, from the wheel cone."""
        rho, xi = self.wheel_mean_radius, self.wheel_azimuth
        return rho * cos(xi), rho * sin(xi), self.wheel_mean_point_position

    @property
    def pitch_plane_normal(self) -> Vector:
        """Unit normal of the pitch plane at P in frame G, out of the wheel cone."""
        delta, xi = self.wheel_pitch_angle, self.wheel_azimuth
        return cos(delta) * cos(xi), cos(delta) * sin(xi), -sin(delta)

    @property
    def pinion_mean_point_position(self) -> float:
        """Axial position t_zm1 of P from the crossing point on the pinion axis, mm."""
        axial = self.pinion_mean_cone_distance * cos(self.pinion_pitch_angle)
        return axial - self.pinion_apex_beyond_crossing

    @property
    def wheel_mean_point_position(self) -> float:
        """Axial position t_zm2 of P from the crossing point on the wheel axis, mm."""
        axial = self.wheel_mean_cone_distance * cos(self.wheel_pitch_angle)
        return axial - self.wheel_apex_beyond_crossing


def tangency(shaft_angle: float, wheel_pitch_angle: float, wheel_azimuth: float) -> Tangency:
    """Pinion cone that touches a wheel cone along its pitch plane; rad in, rad out.

    Parameters
    ----------
    shaft_angle, wheel_pitch_angle, wheel_azimuth
        Sigma, delta2, xi. The module's docstring has the frame.
    """
    sin_sigma, cos_sigma = sin(shaft_angle), cos(shaft_angle)
    sin_delta2, cos_delta2 = sin(wheel_pitch_angle), cos(wheel_pitch_angle)
    radial_x = cos_sigma * cos_delta2 * cos(wheel_azimuth) + sin_sigma * sin_delta2
    radial_y = cos_delta2 * sin(wheel_azimuth)
    axial = sin_sigma * cos_delta2 * cos(wheel_azimuth) - cos_sigma * sin_delta2
    delta1 = atan2(axial, (radial_x**2 + radial_y**2) ** 0.5)
    eta = atan2(radial_y, radial_x)
    # both axes in the basis (wheel generatrix, n): their product is cos Sigma, their triple
    # product with n is sin Sigma sin xi cos delta2; the common factor cos d1 cos d2 drops out
    beta_m12 = atan2(sin_sigma * sin(wheel_azimuth) * cos_delta2, cos_sigma + axial * sin_delta2)
    return Tangency(delta1, eta, beta_m12)


def wheel_azimuth_of_radii(
    offset: float,
    pinion_mean_radius: float,
    wheel_mean_radius: float,
    pinion_pitch_angle: float,
    wheel_pitch_angle: float,
) -> float:
    """Azimuth xi = zeta_m of P about the wheel axis, rad, from both cones (ISO 23509, (113))."""
    reach = wheel_mean_radius + pinion_mean_radius * cos(wheel_pitch_angle) / cos(
        pinion_pitch_angle
    )
    return asin(offset / reach)


def pitch_cones(
    *,
    shaft_angle: float,
    offset: float,
    teeth: tuple[int, int],
    pinion_pitch_angle: float,
    wheel_pitch_angle: float,
    pinion_spiral_angle: float,
    wheel_spiral_angle: float,
    pinion_mean_radius: float,
    wheel_mean_radius: float,
    slope_angle: float = 0.0,
) -> PitchCones:
    """Complete a pair of tangent cones: ISO 23509, clause 7.2, (110)-(116), (129)-(131), (32).

    Any way of finding cones (methods 0 to 3, or the two conditions of the 2022 paper) ends here.
    The formulas take the cones as given, so cones of a chain that stops early stay as printed.
    """
    delta1, delta2 = pinion_pitch_angle, wheel_pitch_angle
    r_m1, r_m2 = pinion_mean_radius, wheel_mean_radius
    xi = wheel_azimuth_of_radii(offset, r_m1, r_m2, delta1, delta2)
    sin_sigma, cos_sigma = sin(shaft_angle), cos(shaft_angle)
    eta = atan2(cos(delta2) * sin(xi), cos_sigma * cos(delta2) * cos(xi) + sin_sigma * sin(delta2))
    beta_m12 = asin(sin_sigma * sin(xi) / cos(delta1))  # (114)
    if cos_sigma + sin(delta1) * sin(delta2) < 0.0:
        beta_m12 = copysign(pi, beta_m12) - beta_m12
    reach = r_m2 + r_m1 * cos(delta2) / cos(delta1)
    t_zm2 = r_m1 * sin(delta2) / cos(delta1) + cos_sigma / sin_sigma * cos(xi) * reach  # (129)
    t_zm1 = r_m2 * cos(xi) * sin_sigma + t_zm2 * cos_sigma  # (130)
    big_r_m1, big_r_m2 = r_m1 / sin(delta1), r_m2 / sin(delta2)
    return PitchCones(
        shaft_angle=shaft_angle,
        offset=offset,
        teeth=teeth,
        pinion_offset_angle_axial=xi,
        wheel_offset_angle_axial=eta,
        pinion_pitch_angle=delta1,
        wheel_pitch_angle=delta2,
        pinion_spiral_angle=pinion_spiral_angle,
        wheel_spiral_angle=wheel_spiral_angle,
        offset_angle_pitch_plane=beta_m12,
        pinion_mean_radius=r_m1,
        wheel_mean_radius=r_m2,
        pinion_mean_cone_distance=big_r_m1,
        wheel_mean_cone_distance=big_r_m2,
        mean_normal_module=2.0 * r_m2 * cos(wheel_spiral_angle) / teeth[1],
        slope_angle=slope_angle,
        pinion_apex_beyond_crossing=big_r_m1 * cos(delta1) - t_zm1,
        wheel_apex_beyond_crossing=big_r_m2 * cos(delta2) - t_zm2,
        limit_pressure_angle=limit_pressure_angle(
            (delta1, delta2),
            (big_r_m1, big_r_m2),
            (pinion_spiral_angle, wheel_spiral_angle),
            beta_m12,
        ),
    )


def limit_pressure_angle(
    pitch_angles: tuple[float, float],
    cone_distances: tuple[float, float],
    spiral_angles: tuple[float, float],
    offset_angle_pitch_plane: float,
) -> float:
    """Limit pressure angle alpha_lim, rad, in ISO's sign (ISO 23509, (32)); zero without offset.

    Each pair is (pinion, wheel): pitch angles rad, mean cone distances mm, spiral angles rad.
    """
    tan1, tan2 = tan(pitch_angles[0]), tan(pitch_angles[1])
    r1, r2 = cone_distances
    spiral = r1 * sin(spiral_angles[0]) - r2 * sin(spiral_angles[1])
    scale = tan1 * tan2 / (cos(offset_angle_pitch_plane) * (r1 * tan1 + r2 * tan2))
    return atan(-scale * spiral)
