"""Modified roll as a series: plain coefficients, the field's 2C, 6D, 24E, 120F, and a cam's own.

Plain: W = R_a (phi + c2 phi**2 + ... ). The field writes work = c1 (q - C q**2 - D q**3 - E q**4 - F q**5)
and gives C ... F with the factorial that the derivative leaves: 2C = -2! c2, 6D = -3! c3, 24E = -4! c4, 120F = -5! c5.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ._cam import Cam

FIELD_NAMES = ("2C", "6D", "24E", "120F", "720G")


@dataclass(frozen=True)
class RollSeries:
    """W = R_a (phi + c2 phi**2 + ...) at the centre of roll."""

    ratio_of_roll: float  # R_a
    modified_roll: tuple[float, ...]  # c2, c3, ...

    @property
    def field(self) -> tuple[float, ...]:
        """2C, 6D, 24E, 120F, ... (see `FIELD_NAMES`)."""
        return to_field(self.modified_roll)


def to_field(modified_roll: Sequence[float]) -> tuple[float, ...]:
    """2C, 6D, 24E, 120F, ... of c2, c3, c4, c5, ..."""
    return tuple(-math.factorial(n) * c for n, c in enumerate(modified_roll, start=2))


def from_field(field: Sequence[float]) -> tuple[float, ...]:
    """c2, c3, c4, c5, ... of 2C, 6D, 24E, 120F, ..."""
    return tuple(-f / math.factorial(n) for n, f in enumerate(field, start=2))


def roll_series(cam: Cam, orders: int = 6) -> RollSeries:
    """R_a and c2 ... c_orders of a cam at the centre of roll: its Taylor series, exact to rounding.

    The cam's condition is solved in powers of the cradle angle, one order after the other.
    """
    turn = float(cam.swivel_offset) / float(cam.pitch_radius)
    share = float(cam.setting) / float(cam.swivel_offset)
    guide = float(cam.guide_angle)
    angle = np.zeros(orders + 1)
    angle[:2] = -guide, 1.0
    target, _ = _sine_cosine(angle)
    target[0] += math.sin(guide)
    alpha = np.zeros(orders + 1)
    for n in range(1, orders + 1):  # alpha_n enters order n of the condition by its slope alone
        value = share * _sine_cosine(turn * alpha)[0] + _sine_cosine(alpha)[0] - target
        alpha[n] = -value[n] / (share * turn + 1.0)
    work = turn * alpha
    work[1] += 1.0
    ratio = float(work[1])
    return RollSeries(ratio * float(cam.index_ratio), tuple(float(w) / ratio for w in work[2:]))


def centre_rates(cam: Cam) -> tuple[float, float, float]:
    """R, R', R'' of shaft against cradle at the centre of roll, closed [notes on lin1996]."""
    c, r, delta = float(cam.swivel_offset), float(cam.pitch_radius), float(cam.setting)
    cosine, sine = math.cos(float(cam.guide_angle)), math.sin(float(cam.guide_angle))
    k = c / (r + delta)
    bend = cosine**2 * (delta * c * c + r**3) / (r + delta) ** 3
    return 1.0 + k * cosine, k * sine, k * cosine * (bend - 1.0)


def cam_of_roll(
    swivel_offset: float, pitch_radius: float, index_ratio: float, ratio: float, c2: float
) -> Cam:
    """The seat and guide angle with which a cam gives R_a and c2 (its higher orders then follow)."""
    rate = ratio / index_ratio
    across, along = 2.0 * c2 * rate, rate - 1.0  # k sin(phi), k cos(phi)
    k, guide = math.hypot(across, along), math.atan2(across, along)
    return Cam(swivel_offset, pitch_radius, swivel_offset / k - pitch_radius, guide, index_ratio)


def _sine_cosine(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sine and cosine of a truncated power series."""
    s, c = np.zeros_like(a), np.zeros_like(a)
    s[0], c[0] = math.sin(a[0]), math.cos(a[0])
    rate = np.arange(len(a)) * a
    for n in range(1, len(a)):
        s[n] = rate[1 : n + 1] @ c[n - 1 :: -1][:n] / n
        c[n] = -(rate[1 : n + 1] @ s[n - 1 :: -1][:n]) / n
    return s, c
