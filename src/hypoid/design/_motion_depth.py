"""Depth of the motion curve that an ease-off makes, read off its grid: no contact is searched.

Teeth touch where the ease-off, as an angle of the wheel, is least along a line of contact; lines of
contact are lines of one turn of the wheel. Neighbours take over a pitch on.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.polynomial import polynomial

Array = np.ndarray[Any, Any]
DEGREE = 4  # of the surfaces through ease-off and turn
ALONG, ACROSS = 241, 121  # places that are looked at
LINES = 160  # of contact, over one pitch
FAR = 1.0  # rad: no contact
PAIRS = 2  # neighbours either way


def motion_depth(
    shape: tuple[int, int], there: Array, lead: Array, turn: Array, pitch: float
) -> float:
    """Peak to peak transmission error, rad of the wheel; NaN where the grid does not cover a pitch.

    Parameters
    ----------
    shape
        Rows and columns of the grid, which the arrays run over.
    there
        Points that count, (n,) bool.
    lead, turn
        Ease-off over the wheel's lever (rad), and the wheel's turn at which each point meshes (rad).
    """
    rows, columns = shape
    v, u = (g.ravel() for g in np.meshgrid(
        np.linspace(-1, 1, rows), np.linspace(-1, 1, columns), indexing="ij"
    ))  # fmt: skip
    powers = [(i, j) for i in range(DEGREE + 1) for j in range(DEGREE + 1 - i)]
    basis = np.stack([u[there] ** i * v[there] ** j for i, j in powers], axis=1)

    def fine(values: Array) -> Array:
        c = np.zeros((DEGREE + 1, DEGREE + 1))
        for (i, j), value in zip(powers, np.linalg.lstsq(basis, values[there])[0], strict=True):
            c[i, j] = value
        return polynomial.polygrid2d(np.linspace(-1, 1, ALONG), np.linspace(-1, 1, ACROSS), c)

    angle, gap = fine(turn).T, fine(lead).T  # rows of v, columns of u
    row = np.rint(np.linspace(0, rows - 1, ACROSS)).astype(int)
    column = np.rint(np.linspace(0, columns - 1, ALONG)).astype(int)
    gap = np.where(there.reshape(shape)[np.ix_(row, column)], gap, FAR)
    low, high = float(turn[there].min()), float(turn[there].max())
    at = np.arange(low, high, pitch / LINES)
    if len(at) < LINES:
        return float("nan")
    curve = np.full(len(at), FAR)
    for angles, gaps in zip(angle, gap, strict=True):  # the line of contact crosses every row once
        if np.all(np.diff(angles) < 0.0):
            angles, gaps = angles[::-1], gaps[::-1]
        if np.all(np.diff(angles) > 0.0):
            curve = np.minimum(curve, np.interp(at, angles, gaps, left=FAR, right=FAR))
    middle = int(np.argmin(curve))
    at = np.arange(middle - LINES // 2, middle + LINES // 2)
    best = np.full(LINES, FAR)
    for k in range(-PAIRS, PAIRS + 1):
        shifted = at + k * LINES
        mine = (shifted >= 0) & (shifted < len(curve))
        best[mine] = np.minimum(best[mine], curve[shifted[mine]])
    return float(best.max() - best.min())
