"""What ISO 23509's four methods ask of the pitch cones besides tangency, tooth ratio and offset.

Each is a smooth function of a `Trial` that is zero at the method's cones, so that one solver serves
all of them, fully converged. `_printed_chains` has the standard's own iterations with their stop rules.
"""

from __future__ import annotations

from math import acos, atan, atan2, cos, pi, sin, sqrt, tan

from ._alignment import alignment
from ._cone_solver import Condition, Trial
from ._pitch_cones import limit_pressure_angle


def condition(method: int, z2: int, cutter_radius: float, blade_groups: int) -> Condition:
    """The condition of a method (0 to 3) for a cutter of radius r_c0, mm; z0 = 0 is face milling."""
    head = z2, cutter_radius, blade_groups
    if method == 0:
        return lambda trial: trial.big_r_m1 / trial.big_r_m2 - 1.0
    if method == 1:
        return lambda trial: _limit_curvature(trial, tooth_radius(trial, *head))
    if method == 2:
        return lambda trial: alignment(trial, *head)
    return lambda trial: _klingelnberg(trial, *head)


def tooth_radius(trial: Trial, z2: int, cutter_radius: float, blade_groups: int) -> float:
    """Lengthwise radius of curvature rho_mb of the crown gear's tooth at P, mm (34)-(40)."""
    if not blade_groups:
        return cutter_radius
    distance, beta = trial.big_r_m2, trial.beta_m2
    nu = trial.slope_angle(z2, cutter_radius, blade_groups)
    between = 0.5 * pi - beta + nu
    centres = sqrt(distance**2 + cutter_radius**2 - 2.0 * distance * cutter_radius * cos(between))
    z_p = z2 / sin(trial.delta2)
    share = distance * cos(beta) * (z_p + blade_groups) / (centres * z_p)
    turn = tan(beta) + tan(acos(min(share, 1.0)))
    return distance * cos(beta) * (tan(beta) + (turn - tan(beta)) / (1.0 + tan(nu) * turn))


def limit_radius(trial: Trial) -> tuple[float, float]:
    """Numerator and denominator of the limit radius of curvature rho_lim, mm (33)."""
    r1, r2, b1, b2 = trial.big_r_m1, trial.big_r_m2, trial.beta_m1, trial.beta_m2
    limit = limit_pressure_angle((trial.delta1, trial.delta2), (r1, r2), (b1, b2), trial.beta_m12)
    over = (tan(b1) - tan(b2)) / cos(limit)
    sliding = tan(b1) / (r1 * tan(trial.delta1)) + tan(b2) / (r2 * tan(trial.delta2))
    under = 1.0 / (r1 * cos(b1)) - 1.0 / (r2 * cos(b2)) - tan(limit) * sliding
    return over, under


def _limit_curvature(trial: Trial, radius: float) -> float:
    """rho_mb = rho_lim, written without a pole; zero offset leaves R_m1 = R_m2."""
    over, under = limit_radius(trial)
    return radius * under - over


def _klingelnberg(trial: Trial, z2: int, cutter_radius: float, blade_groups: int) -> float:
    """R_int = R_m1 (99)-(105), times the denominator of R_int."""
    over, under = crossing_distance(trial, z2, cutter_radius, blade_groups)
    return (over - trial.big_r_m1 * under) / (cutter_radius * trial.big_r_m2)


def crossing_distance(
    trial: Trial, z2: int, cutter_radius: float, blade_groups: int
) -> tuple[float, float]:
    """Numerator and denominator of method 3's R_int, mm (99)-(105)."""
    b1, b2, apart = trial.beta_m1, trial.beta_m2, trial.beta_m12
    nu = trial.slope_angle(z2, cutter_radius, blade_groups)
    theta = atan(sin(trial.delta2) * tan(trial.xi))
    a3 = cutter_radius * cos(b2 - nu) ** 2
    a4 = trial.big_r_m2 * cos(b2 + theta) * cos(b2)
    a5 = sin(apart) * cos(theta) * cos(nu)
    a6 = trial.big_r_m2 * cos(b2) + cutter_radius * sin(nu)
    a7 = cos(b1) * cos(b2 + theta) - sin(b2 + theta - nu) * sin(apart) / cos(b2 - nu)
    return a3 * a4, a5 * a6 + a3 * a7


def first_wheel_angle(z1: int, z2: int, shaft_angle: float) -> float:
    """delta_2i from which method 1 takes the wheel's mean radius, rad (11)."""
    u, excess = z2 / z1, shaft_angle - 0.5 * pi
    return atan2(u * cos(excess), 1.2 * (1.0 - u * sin(excess)))
