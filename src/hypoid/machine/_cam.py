"""The cam of the No. 463 grinder as a motion: work roll against cradle angle, closed but for one root.

A constant-breadth cam on the input shaft drives a swivel on the cradle; the swivel's guide angle
modifies the roll [lin1996, section 2.2, (18), (19), (24), (25), with the notes' corrections].
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.geometry import Batch, DesignError, Problem, Scalar, namespace

STEPS = 7  # Newton, from the root for small alpha


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Cam:
    """Cam and index train of one flank; mm, rad, signs of the generator chain (`_gleason_463`)."""

    swivel_offset: Scalar  # C
    pitch_radius: Scalar  # r_u
    setting: Scalar  # delta: seat of the cam off its nominal place
    guide_angle: Scalar  # phi
    index_ratio: Scalar  # n_i/n_p, work turn per turn of the input shaft


def cam_roll(cam: Cam, angle: Batch) -> tuple[Batch, Batch]:
    """Work roll W, rad, from the centre of roll, and dW/d(angle) at cradle angles [lin1996, (24), (25)].

    In JAX both carry exact derivatives of any order.
    """
    xp = namespace(angle, cam.guide_angle, cam.setting)
    turn, share = cam.swivel_offset / cam.pitch_radius, cam.setting / cam.swivel_offset
    target = xp.sin(angle - cam.guide_angle) + xp.sin(cam.guide_angle)
    alpha = _newton(turn, share, target, np) if xp is np else _parameter(turn, share, target)
    by_angle = xp.cos(angle - cam.guide_angle) / _slope(turn, share, alpha, xp)
    return cam.index_ratio * (turn * alpha + angle), cam.index_ratio * (1.0 + turn * by_angle)


def uniform_limit(cam: Cam, half_breadth: float) -> float:
    """Cam parameter |alpha|, rad, up to which the cam's profile has no cusp [lin1996, (9), notes item 4]."""
    c, r = float(cam.swivel_offset), float(cam.pitch_radius)
    sine, room = half_breadth * c, abs(r * r - c * c)
    return math.asin(sine / room) if sine < room else math.pi / 2


def cradle_limits(cam: Cam, half_breadth: float | None = None) -> tuple[float, float]:
    """Cradle angles, rad, between which the cam rolls uniformly [lin1996, (24) at the limit of (9)].

    Without a half breadth only the swivel's own limit counts, where the guide stands across.
    """
    guide, reach = float(cam.guide_angle), float(cam.setting) / float(cam.pitch_radius)
    limit = math.pi / 2 if half_breadth is None else uniform_limit(cam, half_breadth)
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


def _slope(turn: Batch, share: Batch, alpha: Batch, xp: Any) -> Batch:
    return share * turn * xp.cos(turn * alpha) + xp.cos(alpha)


def _newton(turn: Batch, share: Batch, target: Batch, xp: Any) -> Batch:
    """Cam parameter alpha of share sin(turn alpha) + sin(alpha) = target, the root next to zero."""
    alpha = xp.arcsin(xp.clip(target / (1.0 + share * turn), -0.99, 0.99))
    for _ in range(STEPS):
        value = share * xp.sin(turn * alpha) + xp.sin(alpha) - target
        alpha = alpha - value / _slope(turn, share, alpha, xp)
    return alpha


@jax.custom_jvp
def _parameter(turn: Batch, share: Batch, target: Batch) -> Batch:
    """`_newton` with the derivatives of the root itself, not of the search for it."""
    return _newton(turn, share, target, jnp)


@_parameter.defjvp
def _parameter_jvp(at: tuple[Any, ...], by: tuple[Any, ...]) -> tuple[Batch, Batch]:
    (turn, share, target), (turn_by, share_by, target_by) = at, by
    alpha = _parameter(turn, share, target)
    moved = target_by - share_by * jnp.sin(turn * alpha)
    moved = moved - share * alpha * jnp.cos(turn * alpha) * turn_by
    return alpha, moved / _slope(turn, share, alpha, jnp)
