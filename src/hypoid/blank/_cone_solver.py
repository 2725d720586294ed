"""Tangent pitch cones with the tooth ratio, the offset and one condition more, for any shaft angle.

The unknowns are the wheel pitch angle delta2 and the azimuth xi of P: they stay well conditioned as
the offset vanishes, where the offset angles go to zero together and a spiral bevel pair remains. The
tooth ratio is built in (r_m1 follows from it). What is left is solved inside out: for each delta2 the
offset gives xi, and the condition then gives delta2. Both are bracketed, so nothing depends on a lucky
start. Methods 1, 2 and 3 of ISO 23509 and the 2022 paper's pair differ in the condition alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import acos, asin, cos, isfinite, pi, sin
from typing import Literal

from ._pitch_cones import PitchCones, pitch_cones, tangency

WHEEL_ANGLE_STEPS = 90
AZIMUTH_STEPS = 24
MET = 1.0e-9
LAST_WHEEL_ANGLE = 0.5 * pi * (1.0 - 1.0e-9)


@dataclass(frozen=True)
class ConeInputs:
    """What every pair of cones needs; mm and rad. Canonical pair, offset signed."""

    z1: int
    z2: int
    shaft_angle: float
    offset: float
    wheel_mean_radius: Callable[[float], float]  # r_m2 at a wheel pitch angle delta2
    spiral_angle: float
    spiral_of: Literal["pinion", "wheel"]  # the member that has it at P


@dataclass(frozen=True)
class Trial:
    """One pair of tangent cones with the right ratio and offset; mm and rad."""

    delta1: float
    delta2: float
    xi: float  # azimuth of P about the wheel axis, zeta_m
    beta_m12: float  # offset angle in the pitch plane, zeta_mp
    beta_m1: float
    beta_m2: float
    r_m1: float
    r_m2: float

    @property
    def big_r_m1(self) -> float:
        """Mean cone distance of the pinion, mm."""
        return self.r_m1 / sin(self.delta1)

    @property
    def big_r_m2(self) -> float:
        """Mean cone distance of the wheel, mm."""
        return self.r_m2 / sin(self.delta2)

    def slope_angle(self, z2: int, cutter_radius: float, blade_groups: int) -> float:
        """Slope angle nu of the head, rad: [gonzalez-fuentes-2022, (7)]; 90 deg for a head too small."""
        module = 2.0 * self.r_m2 * cos(self.beta_m2) / z2
        return asin(min(0.5 * blade_groups * module / cutter_radius, 1.0))

    def cones(self, given: ConeInputs, slope_angle: float = 0.0) -> PitchCones:
        """The same cones, completed."""
        return pitch_cones(
            shaft_angle=given.shaft_angle,
            offset=given.offset,
            teeth=(given.z1, given.z2),
            pinion_pitch_angle=self.delta1,
            wheel_pitch_angle=self.delta2,
            pinion_spiral_angle=self.beta_m1,
            wheel_spiral_angle=self.beta_m2,
            pinion_mean_radius=self.r_m1,
            wheel_mean_radius=self.r_m2,
            slope_angle=slope_angle,
        )


Condition = Callable[[Trial], float]  # smooth, zero at the cones that are sought, of order one


def solve_cones(given: ConeInputs, condition: Condition) -> Trial | None:
    """Tangent cones that meet a condition, or None where there are none.

    Some shaft angles above 100 deg have a second pair of cones with delta2 near 20 deg; the least
    offset angle is on the branch that a = 0 starts from.
    """

    def value(delta2: float) -> float:
        trial = trial_at(given, delta2)
        return condition(trial) if trial is not None else float("nan")

    previous = previous_value = float("nan")
    roots: list[float] = []
    for i in range(1, WHEEL_ANGLE_STEPS + 1):
        delta2 = LAST_WHEEL_ANGLE * i / WHEEL_ANGLE_STEPS
        here = value(delta2)
        low, low_value, high, high_value = previous, previous_value, delta2, here
        if isfinite(here) != isfinite(previous_value) and i > 1:
            edge = _edge_of_validity(value, previous, delta2)
            if isfinite(previous_value):
                high, high_value = edge, value(edge)
            else:
                low, low_value = edge, value(edge)
        if low_value <= 0.0 < high_value or high_value <= 0.0 < low_value:
            roots.append(bracketed_root(value, low, high))
        previous, previous_value = delta2, here
    trials = [trial for root in roots if (trial := trial_at(given, root)) is not None]
    trials = [trial for trial in trials if abs(condition(trial)) < MET]  # not a jump
    return min(trials, key=lambda trial: abs(trial.beta_m12), default=None)


def trial_at(given: ConeInputs, delta2: float) -> Trial | None:
    """Cones with the ratio and the offset of the pair at one wheel pitch angle, if any."""
    if given.offset == 0.0:
        return _trial(given, delta2, 0.0)
    # the pinion cone must open: sin delta1 > 0
    flat = cos(given.shaft_angle) * sin(delta2) / (sin(given.shaft_angle) * cos(delta2))
    if flat >= 1.0:
        return None
    widest = acos(max(flat, 0.0))
    sign = 1.0 if given.offset > 0.0 else -1.0

    def excess(xi: float) -> float:
        trial = _trial(given, delta2, sign * xi)
        if trial is None:
            return float("nan")
        reach = trial.r_m2 + trial.r_m1 * cos(delta2) / cos(trial.delta1)
        return reach * sin(xi) - abs(given.offset)

    low = 0.0
    for i in range(1, AZIMUTH_STEPS + 1):
        high = widest * (1.0 - 1.0e-12) * i / AZIMUTH_STEPS
        value = excess(high)
        if not isfinite(value):
            return None
        if value >= 0.0:
            return _trial(given, delta2, sign * bracketed_root(excess, low, high))
        low = high
    return None


def _trial(given: ConeInputs, delta2: float, xi: float) -> Trial | None:
    """Cones with the tooth ratio at given delta2 and xi; None where a spiral or cone fails."""
    tangent = tangency(given.shaft_angle, delta2, xi)
    delta1, apart = tangent.pinion_pitch_angle, tangent.offset_angle_pitch_plane
    of_pinion = given.spiral_of == "pinion"
    beta_m1 = given.spiral_angle if of_pinion else given.spiral_angle + apart
    beta_m2 = beta_m1 - apart
    r_m2 = given.wheel_mean_radius(delta2)
    if delta1 <= 0.0 or max(abs(beta_m1), abs(beta_m2)) >= 0.5 * pi or r_m2 <= 0.0:
        return None
    r_m1 = r_m2 * given.z1 / given.z2 * cos(beta_m2) / cos(beta_m1)  # [gonzalez-fuentes-2022, (1)]
    return Trial(delta1, delta2, xi, apart, beta_m1, beta_m2, r_m1, r_m2)


def _edge_of_validity(f: Callable[[float], float], one: float, other: float) -> float:
    """Last argument with a finite value between a finite and a failing one."""
    good, bad = (one, other) if isfinite(f(one)) else (other, one)
    for _ in range(40):
        middle = 0.5 * (good + bad)
        if isfinite(f(middle)):
            good = middle
        else:
            bad = middle
    return good


def bracketed_root(f: Callable[[float], float], low: float, high: float) -> float:
    """Root of f between two ends of opposite sign, to machine precision (Chandrupatla 1997)."""
    a, b = low, high
    fa, fb = f(a), f(b)
    if fa == 0.0:
        return a
    c, fc, t = a, fa, 0.5
    for _ in range(200):
        x = a + t * (b - a)
        fx = f(x)
        if (fx > 0.0) == (fa > 0.0):
            c, fc = a, fa
        else:
            c, fc, b, fb = b, fb, a, fa
        a, fa = x, fx
        best = a if abs(fa) < abs(fb) else b
        room = 2.0e-16 * abs(best) + 1.0e-300
        if fa == 0.0 or abs(b - a) <= 2.0 * room:
            return best
        edge = room / abs(b - a)
        ratio, slope = (a - b) / (c - b), (fa - fb) / (fc - fb)
        if slope**2 < ratio and (1.0 - slope) ** 2 < 1.0 - ratio:  # inverse quadratic is safe
            t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (
                fc - fb
            )
        else:
            t = 0.5
        t = min(max(t, edge), 1.0 - edge)
    return a if abs(fa) < abs(fb) else b
