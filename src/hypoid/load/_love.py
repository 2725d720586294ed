"""Half-space under cells of even pressure: Love's closed form [Love 1929, Phil. Trans. A 228; Johnson, sec. 3.6].

Everything is per unit of (1 - nu**2)/(pi E): the normal displacement of a half-space's surface under an
even pressure p is p times these lengths (mm) times that factor.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
NEAR = 5.0  # cells this many sizes apart see each other as points, within 0.2 %


def _corner(x: Array, y: Array) -> Array:
    """Integral of 1/r over the rectangle between the origin and (x, y), signed; mm."""
    ax, ay = np.abs(x), np.abs(y)
    tiny = np.finfo(float).tiny
    return x * np.arcsinh(y / np.maximum(ax, tiny)) + y * np.arcsinh(x / np.maximum(ay, tiny))


def rectangle(x: Array, y: Array, width: float, height: float) -> Array:
    """Integral of 1/r (mm) over a rectangle about the origin, seen from (x, y); broadcasts."""
    a, b = 0.5 * width, 0.5 * height
    return (
        _corner(x + a, y + b)
        - _corner(x - a, y + b)
        - _corner(x + a, y - b)
        + _corner(x - a, y - b)
    )


def regular_grid(columns: int, rows: int, width: float, height: float) -> Array:
    """Integrals of 1/r (mm) between all cells of a grid, (n, n) with n = columns rows, rows running fastest.

    Cells are `width` by `height`; entry (i, j) is the middle of cell i under an even pressure on cell j.
    """
    x, y = np.arange(columns) * width, np.arange(rows) * height
    return rectangle(x[:, None], y[None, :], width, height).ravel()[_apart(columns, rows)]


@lru_cache(maxsize=4)
def _apart(columns: int, rows: int) -> Array:
    """Index (n, n) into the table of a grid: how many columns and rows two cells are apart."""
    i, j = (v.ravel() for v in np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij"))
    return np.abs(i[:, None] - i) * rows + np.abs(j[:, None] - j)


def mirrored_grid(x: Array, y: Array, line: Array, width: float, height: float) -> Array:
    """Integrals of 1/r (mm) at cells' middles (n,) of all cells' images beyond a straight line, symmetric (n, n).

    The line is c0 + c1 x + c2 y = 0, positive on the cells' side.
    """
    slope = line[1:] / np.hypot(*line[1:])
    apart = 2.0 * (line[0] + line[1] * x + line[2] * y) / np.hypot(*line[1:])
    there_x, there_y = x - apart * slope[0], y - apart * slope[1]
    # seen from an eye's image the cell itself is what its image is to the eye
    dx, dy = there_x[:, None] - x, there_y[:, None] - y
    away = dx * dx + dy * dy
    near = np.nonzero(away < (NEAR * max(width, height)) ** 2)
    away[near] = 1.0
    seen = width * height / np.sqrt(away)
    seen[near] = rectangle(dx[near], dy[near], width, height)
    return 0.5 * (seen + seen.T)


def parallelogram(offset: Array, first: Array, second: Array) -> Array:
    """Integral of 1/r (mm) over flat parallelograms with these edges, seen from their middles plus `offset`.

    All (..., 2), in the parallelogram's plane, mm. A sum over the edges: h (asinh(s2/|h|) - asinh(s1/|h|))
    with h the distance from an edge's line and s the places of its ends along it.
    """
    total = np.zeros(np.broadcast_shapes(offset.shape, first.shape)[:-1])
    half = (0.5 * (-first - second), 0.5 * (first - second), 0.5 * (first + second))
    corners = [half[0], half[1], half[2], -half[1]]
    turn = np.sign(first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0])
    for k in range(4):
        start, end = corners[k] - offset, corners[(k + 1) % 4] - offset
        edge = end - start
        length = np.sqrt((edge * edge).sum(axis=-1))
        along = (start * edge).sum(axis=-1) / length
        apart = turn * (start[..., 0] * edge[..., 1] - start[..., 1] * edge[..., 0]) / length
        size = np.maximum(np.abs(apart), np.finfo(float).tiny)
        total += apart * (np.arcsinh((along + length) / size) - np.arcsinh(along / size))
    return total
