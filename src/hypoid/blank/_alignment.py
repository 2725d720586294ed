"""Pitch cones of a face-hobbed pair by two conditions [gonzalez-fuentes-2022, (1) and (2)].

The pair turns with its tooth ratio at P, and the cutter centre stands in line with both pitch
apexes, so that one crown gear cuts both members. The unknowns here are the wheel pitch angle
delta2 and the azimuth xi of P, rather than the paper's xi and eta: they stay well conditioned as
the offset vanishes, where eta and xi go to zero together and a spiral bevel pair remains.

The ratio condition is built in (r_m1 follows from it). What is left is solved inside out: for
each delta2 the offset gives xi, and the alignment then gives delta2. Both are bracketed, so
nothing depends on a lucky start.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import acos, asin, cos, isfinite, pi, sin

from ._pitch_cones import PitchCones, pitch_cones, tangency

WHEEL_ANGLE_STEPS = 90
AZIMUTH_STEPS = 24
ALIGNED = 1.0e-9
LAST_WHEEL_ANGLE = 0.5 * pi * (1.0 - 1.0e-9)


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


@dataclass(frozen=True)
class _Trial:
    """One pair of tangent cones with the right ratio and offset; alignment not yet met."""

    delta1: float
    delta2: float
    beta_m12: float
    beta_m2: float
    r_m1: float
    blade_slope: float  # m_b z0 / (2 r_c0) = sin nu, above 1 when the cutter is too small
    alignment: float  # (2) / (R_m1 R_m2): zero in line


def solve_aligned_cones(given: FaceHobbedInputs) -> PitchCones | None:
    """Pitch cones that meet both conditions, or None where there are none.

    The result may still be useless (wheel spiral below zero, cutter too small for its slope
    angle, taken as 90 deg then): `_limits.check_solution` says so.
    """
    trial = _aligned_trial(given)
    if trial is None:
        return None
    return pitch_cones(
        shaft_angle=given.shaft_angle,
        offset=given.offset,
        teeth=(given.z1, given.z2),
        pinion_pitch_angle=trial.delta1,
        wheel_pitch_angle=trial.delta2,
        pinion_spiral_angle=given.pinion_spiral_angle,
        wheel_spiral_angle=trial.beta_m2,
        pinion_mean_radius=trial.r_m1,
        wheel_mean_radius=given.wheel_mean_radius,
        slope_angle=asin(min(trial.blade_slope, 1.0)),
    )


def nearest_blade_slope(given: FaceHobbedInputs) -> tuple[float, float]:
    """(sin nu, blade module mm) where the cutter centre comes closest to the line of the apexes.

    For a set of numbers without a solution: sin nu above 1 lays it to a cutter too small for its
    slope angle. Zeros where not even the tooth ratio and the offset can be had.
    """
    ends = (0.5 * pi * i / WHEEL_ANGLE_STEPS for i in range(1, WHEEL_ANGLE_STEPS))
    trials = [trial for delta2 in ends if (trial := _trial_at(given, delta2)) is not None]
    best = min(trials, key=lambda trial: abs(trial.alignment), default=None)
    if best is None:
        return 0.0, 0.0
    m_b = 2.0 * given.wheel_mean_radius * cos(best.beta_m2) / given.z2
    return best.blade_slope, m_b


def wants_internal_wheel(given: FaceHobbedInputs) -> bool:
    """Whether the alignment is still to come at delta2 = 90 deg, where the wheel turns internal."""
    flat = _trial_at(given, LAST_WHEEL_ANGLE)
    return flat is not None and flat.alignment < 0.0


def ratio_residual(cones: PitchCones) -> float:
    """Left side of [gonzalez-fuentes-2022, (1)] over z1 + z2, mm: zero when the ratio holds."""
    z1, z2 = cones.teeth
    pinion = cones.pinion_mean_radius * z2 * cos(cones.pinion_spiral_angle)
    wheel = cones.wheel_mean_radius * z1 * cos(cones.wheel_spiral_angle)
    return (pinion - wheel) / (z1 + z2)


def alignment_residual(cones: PitchCones, cutter_radius: float) -> float:
    """Left side of [gonzalez-fuentes-2022, (2)] over R_m1 R_m2: zero with the centres in line."""
    big_r1, big_r2 = cones.pinion_mean_cone_distance, cones.wheel_mean_cone_distance
    direction = cones.pinion_spiral_angle - cones.slope_angle
    beta_m12 = cones.offset_angle_pitch_plane
    wheel_side = big_r2 * sin(beta_m12)  # (3)
    pinion_gap = big_r1 - cutter_radius * sin(direction)  # (4)
    apex_gap = big_r2 * cos(beta_m12) - big_r1  # (5)
    cutter_side = cutter_radius * cos(direction)  # (6)
    return (wheel_side * pinion_gap - apex_gap * cutter_side) / (big_r1 * big_r2)


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


def _aligned_trial(given: FaceHobbedInputs) -> _Trial | None:
    """Scan delta2 for a change of sign of the alignment and close in on it."""

    def alignment(delta2: float) -> float:
        trial = _trial_at(given, delta2)
        return trial.alignment if trial is not None else float("nan")

    previous = previous_value = float("nan")
    roots: list[float] = []
    for i in range(1, WHEEL_ANGLE_STEPS + 1):
        delta2 = LAST_WHEEL_ANGLE * i / WHEEL_ANGLE_STEPS
        value = alignment(delta2)
        if isfinite(value) != isfinite(previous_value) and i > 1:
            edge = _edge_of_validity(alignment, previous, delta2)
            if isfinite(previous_value):
                low, low_value, high, high_value = previous, previous_value, edge, alignment(edge)
            else:
                low, low_value, high, high_value = edge, alignment(edge), delta2, value
        else:
            low, low_value, high, high_value = previous, previous_value, delta2, value
        if low_value <= 0.0 < high_value or high_value <= 0.0 < low_value:
            roots.append(bracketed_root(alignment, low, high))
        previous, previous_value = delta2, value
    trials = [trial for root in roots if (trial := _trial_at(given, root)) is not None]
    trials = [trial for trial in trials if abs(trial.alignment) < ALIGNED]  # not a jump
    # some shaft angles above 100 deg have a second pair of cones with delta2 near 20 deg; the least
    # offset angle is on the branch that a = 0 starts from
    return min(trials, key=lambda trial: abs(trial.beta_m12), default=None)


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


def _trial_at(given: FaceHobbedInputs, delta2: float) -> _Trial | None:
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
        reach = given.wheel_mean_radius + trial.r_m1 * cos(delta2) / cos(trial.delta1)
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


def _trial(given: FaceHobbedInputs, delta2: float, xi: float) -> _Trial | None:
    """Cones with the tooth ratio at given delta2 and xi; None where a spiral or cone fails."""
    tangent = tangency(given.shaft_angle, delta2, xi)
    delta1 = tangent.pinion_pitch_angle
    beta_m12 = tangent.offset_angle_pitch_plane
    beta_m2 = given.pinion_spiral_angle - beta_m12
    if delta1 <= 0.0 or abs(beta_m2) >= 0.5 * pi:
        return None
    r_m2, r_c0 = given.wheel_mean_radius, given.cutter_radius
    r_m1 = r_m2 * given.z1 / given.z2 * cos(beta_m2) / cos(given.pinion_spiral_angle)  # (1)
    big_r1, big_r2 = r_m1 / sin(delta1), r_m2 / sin(delta2)
    blade_slope = r_m2 * cos(beta_m2) / given.z2 * given.blade_groups / r_c0  # (7)
    direction = given.pinion_spiral_angle - asin(min(blade_slope, 1.0))
    alignment = (
        big_r2 * sin(beta_m12) * (big_r1 - r_c0 * sin(direction))
        - (big_r2 * cos(beta_m12) - big_r1) * r_c0 * cos(direction)
    ) / (big_r1 * big_r2)
    return _Trial(delta1, delta2, beta_m12, beta_m2, r_m1, blade_slope, alignment)
