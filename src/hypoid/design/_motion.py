"""The unloaded motion that an ease-off makes, without cutting a flank: contact line by contact line.

At each wheel angle the conjugate flanks touch along a line, and the ease-off over its lever is how much
the wheel must turn for a place of that line to touch. The least along the line is in contact, and of
neighbouring pairs the one that leads.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._conjugate import COLUMNS, ROWS
from ._target import TargetPlaces

Array = np.ndarray[Any, Any]
LINES, PITCHES = 81, 5  # contact lines looked at over a pitch, and over how many pitches
FEWEST = 4  # rows of a column that say how the ease-off runs along it
ORDER = 4


@dataclass(frozen=True)
class Motion:
    """One pair's motion over a pitch; rad of the wheel."""

    peak_to_peak: float
    interior: float  # share of the pitch over which the contact lies inside the flank

    def off(self, asked: float) -> float:
        """How far the peak to peak is from what was asked, relative."""
        return abs(self.peak_to_peak - asked) / max(asked, 1e-9)


def motion_of(places: TargetPlaces, ease_off: Array) -> Motion | None:
    """Motion of an ease-off (n,) mm over the conjugate's grid; None where it does not last a pitch.

    The grid's outline, toe to heel and wheel's tip to pinion's tip, counts as the flank's edges.
    """
    pitch = float(np.mean(places.wheel_pitch))
    turns = np.linspace(-0.5 * PITCHES, 0.5 * PITCHES, PITCHES * LINES, endpoint=False)
    shape = (ROWS, COLUMNS)
    turn = (places.turn / pitch).reshape(shape)
    lag = (ease_off / places.wheel_lever).reshape(shape)
    value = np.stack([_along(turn[:, k], lag[:, k], turns) for k in range(COLUMNS)], axis=1)
    least, inside = _least(value)
    pairs, inner = least.reshape(PITCHES, LINES), inside.reshape(PITCHES, LINES)
    leading, curve = pairs.argmin(axis=0), pairs.min(axis=0)
    if not np.isfinite(curve).all():
        return None
    sound = inner[leading, np.arange(LINES)]
    return Motion(float(np.ptp(curve)), float(sound.mean()))


def _along(turn: Array, lag: Array, turns: Array) -> Array:
    """Lag (rad) of one column of the grid where contact lines cross it; infinite where they do not."""
    there = np.isfinite(turn) & np.isfinite(lag)
    if there.sum() < FEWEST:
        return np.full(len(turns), np.inf)
    t = turn[there]
    low, high = float(t.min()), float(t.max())
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    fit = np.polynomial.chebyshev.chebfit((t - middle) / half, lag[there], min(ORDER, len(t) - 1))
    crossed = (turns >= low) & (turns <= high)
    value = np.polynomial.chebyshev.chebval((turns - middle) / half, fit)
    return np.where(crossed, value, np.inf)


def _least(value: Array) -> tuple[Array, Array]:
    """The least along each line (rows), by parabolas through three columns, and whether it is no end."""
    rows = np.arange(len(value))
    at = value.argmin(axis=1)
    k = np.clip(at, 1, value.shape[1] - 2)
    left, here, right = value[rows, k - 1], value[rows, k], value[rows, k + 1]
    inside = (at == k) & np.isfinite(left) & np.isfinite(right)
    with np.errstate(invalid="ignore", divide="ignore"):
        bend = left - 2.0 * here + right
        vertex = here - (right - left) ** 2 / (8.0 * bend)
    least = np.where(inside & (bend > 0.0), vertex, value[rows, at])
    return least, inside
