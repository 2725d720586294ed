"""The cam of the No. 463 grinder as a motion: work roll against cradle angle, closed but for one root.

A constant-breadth cam on the input shaft drives a swivel on the cradle; the swivel's guide angle
modifies the roll [lin1996, section 2.2, (18), (19), (24), (25), with the notes' corrections].
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import jax
import numpy as np

from hypoid.geometry import Batch, Scalar, namespace

STEPS = 6  # Newton, from the root for delta = 0


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Cam:
    """Cam and index train of one flank; mm, rad. Signs as the 1996 paper's: see `gleason_463`."""

    swivel_offset: Scalar  # C
    pitch_radius: Scalar  # r_u
    setting: Scalar  # delta: seat of the cam off its nominal place
    guide_angle: Scalar  # phi
    index_ratio: Scalar  # n_i/n_p, work turn per turn of the input shaft


def cam_roll(cam: Cam, angle: Batch) -> tuple[Batch, Batch]:
    """Work roll W, rad, from the centre of roll, and dW/d(angle) at cradle angles [lin1996, (24), (25)].

    The last Newton step is taken with its slope held, so that it carries derivatives.
    """
    xp = namespace(angle, cam.guide_angle, cam.setting)
    turn, share = cam.swivel_offset / cam.pitch_radius, cam.setting / cam.swivel_offset
    target = xp.sin(angle - cam.guide_angle) + xp.sin(cam.guide_angle)
    hold: Any = jax.lax.stop_gradient if xp is not np else _as_is

    def step(alpha: Batch, slope_of: Any) -> Batch:
        value = share * xp.sin(turn * alpha) + xp.sin(alpha) - target
        slope = share * turn * xp.cos(turn * alpha) + xp.cos(alpha)
        return alpha - value / slope_of(slope)

    alpha = hold(xp.arcsin(xp.clip(target / (1.0 + share * turn), -0.99, 0.99)))
    for _ in range(STEPS):
        alpha = hold(step(alpha, _as_is))
    alpha = step(alpha, hold)
    by_angle = xp.cos(angle - cam.guide_angle) / (
        share * turn * xp.cos(turn * alpha) + xp.cos(alpha)
    )
    return cam.index_ratio * (turn * alpha + angle), cam.index_ratio * (1.0 + turn * by_angle)


def uniform_limit(cam: Cam, half_breadth: float) -> float:
    """Cam parameter |alpha|, rad, up to which the cam's profile has no cusp [lin1996, (9), notes item 4]."""
    c, r = float(cam.swivel_offset), float(cam.pitch_radius)
    sine = half_breadth * c / abs(r * r - c * c)
    return math.asin(sine) if sine < 1.0 else math.pi / 2


def _as_is(value: Batch) -> Batch:
    return value
