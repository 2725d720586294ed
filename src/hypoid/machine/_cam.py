"""The cam of the No. 463 grinder as a motion: work roll against cradle angle, closed but for one root.

A constant-breadth cam on the input shaft drives a swivel on the cradle; the swivel's guide angle
modifies the roll [lin1996, section 2.2, (18), (19), (24), (25), with the notes' corrections].
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import jax
import numpy as np

from hypoid.geometry import (
    Batch,
    DesignError,
    Problem,
    Scalar,
    namespace,
    once,
    sine_cosine,
    unit_angle,
)

STEPS = 5  # of third order, from the root for small alpha


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Cam:
    """Cam and index train of one flank; mm, rad, signs of the generator chain (`_gleason_463`)."""

    swivel_offset: Scalar  # C
    pitch_radius: Scalar  # r_u
    setting: Scalar  # delta: seat of the cam off its nominal place
    guide_angle: Scalar  # phi
    index_ratio: Scalar  # n_i/n_p, work turn per turn of the input shaft


def cam_roll(cam: Cam, angle: Batch, *, seated: bool = False) -> tuple[Batch, Batch]:
    """Work roll W, rad, from the centre of roll, and dW/d(angle) at cradle angles [lin1996, (24), (25)].

    In JAX both carry exact derivatives of any order. ``seated`` says that delta is zero, for which
    (24) is closed.
    """
    xp = namespace(angle, cam)
    turn = cam.swivel_offset / cam.pitch_radius
    sine, cosine = _sine_cosine(angle - cam.guide_angle)
    target = sine + _sine_cosine(cam.guide_angle)[0]
    if seated:  # sin(alpha) = target
        slope = xp.sqrt(1.0 - target * target)
        alpha = xp.arcsin(target) if xp is np else unit_angle(slope, target)
        by_angle = cosine / slope
        return cam.index_ratio * (turn * alpha + angle), cam.index_ratio * (1.0 + turn * by_angle)
    share = cam.setting / cam.swivel_offset
    alpha = _newton(turn, share, target) if xp is np else _parameter(turn, share, target)
    by_angle = cosine / _rise(turn, share, alpha)[1]
    return cam.index_ratio * (turn * alpha + angle), cam.index_ratio * (1.0 + turn * by_angle)


def uniform_limit(cam: Cam, half_breadth: float | None = None) -> float:
    """Cam parameter |alpha|, rad, up to which both flanks of the cam are its own profile.

    Further out one has a cusp [lin1996, (9), notes item 4], or they have met: x_e = 0 in (7). Cams of
    any breadth meet before their normal has turned by a quarter, C |alpha|/r_u = 90 deg.
    """
    c, r = float(cam.swivel_offset), float(cam.pitch_radius)
    quarter = 0.5 * math.pi * min(1.0, r / c)
    if half_breadth is None:
        return quarter
    sine, room = half_breadth * c, abs(r * r - c * c)
    limit = min(quarter, math.asin(sine / room)) if sine < room else quarter

    def across(alpha: float) -> float:
        turned = c * alpha / r
        wide = (half_breadth + c * math.sin(alpha)) * math.cos(turned)
        return r * math.cos(alpha) * math.sin(turned) - wide

    return limit if across(limit) <= 0.0 else rising_root(across, 0.0, limit)


def cradle_limits(cam: Cam, half_breadth: float | None = None) -> tuple[float, float]:
    """Cradle angles, rad, between which the cam rolls uniformly [lin1996, (24) at `uniform_limit`].

    Without a half breadth they are those of a cam as wide as can be: no cam rolls further.
    """
    guide, reach = float(cam.guide_angle), float(cam.setting) / float(cam.pitch_radius)
    limit = uniform_limit(cam, half_breadth)
    limit = min(limit, math.acos(min(1.0, abs(reach))))  # beyond, the shaft may turn back
    turn, share = (
        float(cam.swivel_offset / cam.pitch_radius),
        float(cam.setting / cam.swivel_offset),
    )
    rise = share * math.sin(turn * limit) + math.sin(limit)
    low, high = (max(-1.0, min(1.0, side * rise - math.sin(guide))) for side in (-1.0, 1.0))
    return guide + math.asin(low), guide + math.asin(high)


def check_roll(
    cam: Cam, half_breadth: float | None, low: float, high: float, path: str = "settings.cam"
) -> None:
    """Raise a `DesignError` if cradle angles from low to high (rad) leave the cam's uniform motion."""
    least, most = cradle_limits(cam, half_breadth)
    if low >= least and high <= most:
        return
    given = f"a roll from {math.degrees(low):.2f} deg to {math.degrees(high):.2f} deg"
    expected = "a roll within the uniform motion of the cam, from "
    expected += f"{math.degrees(least):.2f} deg to {math.degrees(most):.2f} deg of the cradle"
    raise DesignError([Problem(path, given, expected, "a cam of larger pitch radius or breadth")])


def rising_root(of: Callable[[float], float], low: float, high: float) -> float:
    """Where a rising function is zero between low and high, by halving down to rounding."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if of(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)


def _sine_cosine(angle: Batch) -> tuple[Batch, Batch]:
    return (np.sin(angle), np.cos(angle)) if namespace(angle) is np else sine_cosine(angle)


def _rise(turn: Batch, share: Batch, alpha: Batch) -> tuple[Batch, Batch, Batch]:
    """The cam's share sin(turn alpha) + sin(alpha), and its first two derivatives by alpha."""
    (wide, wide_by), (sine, cosine) = once((_sine_cosine(turn * alpha), _sine_cosine(alpha)))
    return (
        share * wide + sine,
        share * turn * wide_by + cosine,
        -share * turn * turn * wide - sine,
    )


def _newton(turn: Batch, share: Batch, target: Batch) -> Batch:
    """Cam parameter alpha of share sin(turn alpha) + sin(alpha) = target, the root next to zero.

    Halley's steps from the tangent at zero, but not from beyond a quarter turn of the cam
    (`uniform_limit`): up to there the left side bends one way, and no start overshoots.
    """
    xp = namespace(turn, share, target)
    quarter = 0.5 * math.pi / turn
    x = xp.clip(target / (1.0 + share * turn), -0.99, 0.99)
    square = x * x
    alpha = once(xp.clip(x * (1.0 + square * (1 / 6 + square * 3 / 40)), -quarter, quarter))
    for _ in range(STEPS):
        value, slope, bend = _rise(turn, share, alpha)
        value = value - target
        alpha = once(alpha - value / (slope - 0.5 * value * bend / slope))
    return alpha


@jax.custom_jvp
def _parameter(turn: Batch, share: Batch, target: Batch) -> Batch:
    """`_newton` with the derivatives of the root itself, not of the search for it."""
    return _newton(turn, share, target)


@_parameter.defjvp
def _parameter_jvp(at: tuple[Any, ...], by: tuple[Any, ...]) -> tuple[Batch, Batch]:
    (turn, share, target), (turn_by, share_by, target_by) = at, by
    alpha = _parameter(turn, share, target)
    wide, wide_by = sine_cosine(turn * alpha)
    moved = target_by - share_by * wide - share * alpha * wide_by * turn_by
    return alpha, moved / _rise(turn, share, alpha)[1]
