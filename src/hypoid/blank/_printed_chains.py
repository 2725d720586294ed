"""Methods 1, 2 and 3 as ISO 23509 iterates them, with its stop rule: for digits that were printed so.

The cones of a chain that stops early are not quite tangent nor quite on the condition; the blank of a
design comes from the converged cones (`_cone_solver`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import acos, asin, atan, atan2, cos, pi, sin, sqrt, tan

from ._cone_solver import ConeInputs, Trial
from ._methods import crossing_distance, first_wheel_angle, limit_radius, tooth_radius

STOP = 0.01  # of the radii that are compared, (40) and (83)
STOP_3 = 1.0e-4  # (106)
TRIALS = 60


def printed_method_1(given: ConeInputs, cutter_radius: float, blade_groups: int) -> Trial | None:
    """Cones of method 1 within the standard's 1 % (11)-(40); None where it does not arrive."""
    head = given.z2, cutter_radius, blade_groups
    u, excess = given.z2 / given.z1, given.shaft_angle - 0.5 * pi
    wished, a = given.spiral_angle, given.offset
    first = first_wheel_angle(given.z1, given.z2, given.shaft_angle)
    r2 = given.wheel_mean_radius(first)
    e_i = asin(a * sin(first) / r2)
    k1 = tan(wished) * sin(e_i) + cos(e_i)
    r_n1 = r2 * k1 / u

    def at(tan_eta: float) -> Trial:
        eta = atan(tan_eta)
        e2 = asin((a - r_n1 * sin(eta)) / r2)
        d1i = atan(sin(eta) / (tan(e2) * cos(excess)) + tan(excess) * cos(eta))
        e2p = asin(sin(e2) * cos(excess) / cos(d1i))
        change = sin(e2p) * (tan(wished) - (k1 - cos(e2p)) / sin(e2p))
        dr = r2 * change / u
        e1 = asin(sin(e2) - dr / r2 * sin(eta))
        d1 = atan(sin(eta) / (tan(e1) * cos(excess)) + tan(excess) * cos(eta))
        e1p = asin(sin(e1) * cos(excess) / cos(d1))
        b1 = atan((k1 + change - cos(e1p)) / sin(e1p))
        d2 = atan(sin(e1) / (tan_eta * cos(excess)) + cos(e1) * tan(excess))
        return Trial(d1, d2, e1, e1p, b1, b1 - e1p, r_n1 + dr, r2)

    def miss(trial: Trial) -> float:
        over, under = limit_radius(trial)
        return tooth_radius(trial, *head) * under / over - 1.0

    start = a / (r2 * (tan(first) * cos(excess) - sin(excess)) + r_n1)
    return _secant(at, miss, start, 1.1 * start)


def printed_method_2(given: ConeInputs, cutter_radius: float, blade_groups: int) -> Trial | None:
    """Cones of method 2 within the standard's 1 % (42)-(83); None where it does not arrive."""
    u, sigma, b2 = given.z2 / given.z1, given.shaft_angle, given.spiral_angle
    half = given.wheel_mean_radius(0.5 * pi)  # d_m2 / 2, whatever the wheel angle
    dm2, twice = 2.0 * half, 2.0 * given.offset
    nu = asin(0.5 * blade_groups * dm2 * cos(b2) / (given.z2 * cutter_radius))
    between = 0.5 * pi - b2 + nu
    d1a = atan(sin(sigma) / (u + cos(sigma)))
    d2a = sigma - d1a
    za = asin(twice / dm2 / (1.0 + cos(d2a) / (u * cos(d1a))))
    fa = cos(b2) / cos(b2 + za)
    dm1a = fa * dm2 / u
    ph2 = atan(u * cos(za) / (u / tan(d2a) + (fa - 1.0) * sin(sigma)))
    r_a = dm2 / (2.0 * sin(ph2))
    et1 = atan(
        (cutter_radius * cos(nu) - r_a * sin(b2)) / (cutter_radius * sin(nu) + r_a * cos(b2))
    )
    ph3 = atan(tan(b2 + et1) / sin(ph2))
    d1ii = atan(dm1a * sin(sigma) / (dm2 * cos(za) + dm1a * cos(sigma) - twice / tan(ph3 + za)))

    def at(tan_d2i: float) -> Trial:
        d2i = atan(tan_d2i)
        ep = atan(sin(za) * cos(d2i) / cos(sigma - d2i))
        ea = atan(twice / (dm2 * tan(d2i) + dm1a * cos(ep) * sin(b2 + et1) / cos(sigma - d2i)))
        zi = asin(twice / dm2 - fa * tan(ea) * sin(d2i) * cos(ep) / (u * cos(sigma - d2i)))
        zpi = atan(tan(zi) * sin(sigma) / cos(sigma - d2i))
        dm1 = cos(b2) / cos(b2 + zpi) * dm2 / u
        ph4 = atan(
            sin(between) * sin(sigma) / (dm2 / (2.0 * cutter_radius) - cos(between) * sin(d2i))
        )
        d1i = atan(
            dm1 * sin(sigma) / (dm2 * cos(zi) + dm1 * cos(sigma) * cos(ep) - twice / tan(ph4 + zi))
        )
        d2 = atan(tan(sigma - d1i) * cos(zpi))
        ph5 = atan(tan(d2) / cos(zi))
        epi = atan(tan(ea) * sin(ph5) / cos(sigma - ph5))
        eta = atan(twice / (dm2 * tan(d2) + dm1 * cos(epi) * sin(ph5) / cos(sigma - ph5)))
        zm = asin(tan(d2) * tan(eta))
        zmp = atan(tan(zm) * sin(sigma) / cos(sigma - d2))
        b1 = b2 + zmp
        straight = abs(sigma - 0.5 * pi) < 1e-12
        xi = 0.5 * pi - d2 if straight else atan(tan(sigma) * cos(zm)) % pi - d2
        d1 = atan(tan(xi) * cos(zmp))
        return Trial(d1, d2, zm, zmp, b1, b2, half * cos(b2) / (u * cos(b1)), half)

    def miss(trial: Trial) -> float:
        big = trial.big_r_m2
        centres = sqrt(big**2 + cutter_radius**2 - 2.0 * big * cutter_radius * cos(between))
        ph6 = asin(cutter_radius * sin(between) / centres)
        check = big * sin(ph6) / sin(pi - trial.beta_m12 - ph6)
        return trial.big_r_m1 / check - 1.0

    start = tan(sigma - d1ii) * cos(za)
    return _secant(at, miss, start, 1.01 * start)


def printed_method_3(given: ConeInputs, cutter_radius: float, blade_groups: int) -> Trial | None:
    """Cones of method 3 within the standard's 1e-4 (84)-(109); None where it does not arrive."""
    u, sigma, b2, a = given.z2 / given.z1, given.shaft_angle, given.spiral_angle, given.offset
    share = 1.0
    d2 = atan2(sin(sigma), share / u + cos(sigma))
    d1 = sigma - d2
    try:
        for _ in range(TRIALS):
            half = given.wheel_mean_radius(d2)
            zm = asin(a / (half * (1.0 + share * cos(d2) / (u * cos(d1)))))
            d1 = asin(cos(zm) * sin(sigma) * cos(d2) - cos(sigma) * sin(d2))
            zmp = asin(sin(zm) * sin(sigma) / cos(d1))
            share = cos(b2) / cos(b2 + zmp)
            trial = Trial(d1, d2, zm, zmp, b2 + zmp, b2, share * half / u, half)
            over, under = crossing_distance(trial, given.z2, cutter_radius, blade_groups)
            distance = over / under
            sine = trial.r_m1 / distance
            d1 = asin(sine)
            across = sine * cos(zm) * sin(sigma) + cos(d1) * cos(zmp) * cos(sigma)
            d2 = acos(across / (1.0 - (sin(sigma) * sin(zm)) ** 2))
            if abs(distance - trial.big_r_m1) <= STOP_3 * trial.big_r_m1:
                # sample F.5 goes on with the cone distances of this pass and the angles of the next
                r1, r2 = trial.big_r_m1 * sin(d1), trial.big_r_m2 * sin(d2)
                return replace(trial, delta1=d1, delta2=d2, r_m1=r1, r_m2=r2)
    except (ValueError, ZeroDivisionError):
        return None
    return None


def _secant(
    at: Callable[[float], Trial], miss: Callable[[Trial], float], first: float, second: float
) -> Trial | None:
    """First trial within `STOP`; later ones by linear interpolation."""
    before = before_miss = None
    x = first
    try:
        for _ in range(TRIALS):
            trial = at(x)
            here = miss(trial)
            if abs(here) <= STOP:
                return trial
            if before is None or before_miss is None:
                following = second
            else:
                following = x - here * (x - before) / (here - before_miss)
            before, before_miss, x = x, here, following
    except (ValueError, ZeroDivisionError):  # outside what the formulas can take
        return None
    return None
