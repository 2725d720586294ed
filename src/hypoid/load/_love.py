"""Half-space under cells of even pressure: Love's closed form [Love 1929, Phil. Trans. A 228; Johnson, sec. 3.6].

Everything is per unit of (1 - nu**2)/(pi E): the normal displacement of a half-space's surface under an
even pressure p is p times these lengths (mm) times that factor.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import jax.numpy as jnp
import numpy as np
from scipy.spatial.distance import cdist

from hypoid.geometry import Batch, compiled_fused

Array = np.ndarray[Any, Any]
CELLS = 275  # that are computed together: as many as a patch has
NEAR = 5.0  # cells this many lengths apart see each other as points, within 0.34 %


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


def mirrored(place: Array, line: Array) -> Array:
    """Places (n, 2) reflected in a straight line c0 + c1 x + c2 y = 0."""
    square = line[1:] / np.hypot(*line[1:])
    apart = (line[0] + place @ line[1:]) / np.hypot(*line[1:])
    return place - 2.0 * apart[:, None] * square


def mirrored_grid(place: Array, lines: Array, weights: Array, width: float, height: float) -> Array:
    """Weighted integrals of 1/r (mm) at cells' middles (n, 2) of their images beyond straight lines, symmetric (n, n).

    The lines (k, 3) are c0 + c1 x + c2 y = 0, positive on the cells' side, and count with the weights (k,); one
    without a direction is none.
    """
    n, size, (x, y) = len(place), np.hypot(lines[:, 1], lines[:, 2]), place.T
    weights = np.where(size > 0.0, weights, 0.0)
    lines = lines / np.where(size > 0.0, size, 1.0)[:, None]
    apart = lines[:, :1] + lines[:, 1:] @ place.T
    reach = (NEAR * max(width, height)) ** 2
    room = -(-n // CELLS) * CELLS - n
    whole = (np.pad(v, [(0, 0)] * (v.ndim - 1) + [(0, room)]) for v in (x, y, apart))
    points = _as_points(*whole, weights * width * height, np.array(reach))  # goes on by itself
    near: list[tuple[Array, Array, Array]] = []
    own = (x[:, None] - x) ** 2 + (y[:, None] - y) ** 2
    for line, weight, off in zip(lines, weights, apart, strict=True):
        if weight and 4.0 * np.abs(off).min(initial=np.inf) ** 2 < reach:
            i, j = np.nonzero(np.multiply.outer(4.0 * off, off) < reach - own)
            # seen from an eye's image the cell itself is what its image is to the eye
            there_x, there_y = mirrored(place, line).T
            way = (there_x[i] - x[j], there_y[i] - y[j]), (there_x[j] - x[i], there_y[j] - y[i])
            exact = 0.5 * sum(rectangle(*d, width, height) for d in way)
            near.append((i, j, weight * (exact - width * height / np.sqrt(reach))))
    found = np.asarray(points)[:n, :n].copy()
    for i, j, more in near:
        found[i, j] += more
    return found


@compiled_fused
def _as_points(x: Batch, y: Batch, apart: Batch, weights: Batch, reach: Batch) -> Batch:
    """Sum (n, n) of weights (k,) over the distances of places (n,) from images, `apart` (k, n) from their lines.

    No distance counts as shorter than the root of `reach`.
    """
    own = (x[:, None] - x) ** 2 + (y[:, None] - y) ** 2
    total = jnp.zeros_like(own)
    for off, weight in zip(apart, weights, strict=True):
        total += weight / jnp.sqrt(jnp.maximum(own + 4.0 * off[:, None] * off, reach))
    return total


def polygon(eye: Array, corners: Array) -> Array:
    """Integral of 1/r (mm) over flat polygons (..., k, 2), seen from points (..., 2) of their plane, mm.

    A sum over the edges: h (asinh(s2/|h|) - asinh(s1/|h|)) with h the distance from an edge's line and s the
    places of its ends along it. Corners go round either way; one that is given twice counts once.
    """
    tiny = np.finfo(float).tiny
    (x, y), (away_x, away_y) = np.moveaxis(corners, -1, 0), np.moveaxis(eye, -1, 0)
    next_x, next_y = np.roll(x, -1, axis=-1), np.roll(y, -1, axis=-1)
    turn = np.sign((x * next_y - next_x * y).sum(axis=-1))
    total = np.zeros(np.broadcast_shapes(away_x.shape, x.shape[:-1]))
    for k in range(x.shape[-1]):
        start_x, start_y = x[..., k] - away_x, y[..., k] - away_y
        edge_x, edge_y = next_x[..., k] - x[..., k], next_y[..., k] - y[..., k]
        length = np.maximum(np.hypot(edge_x, edge_y), tiny)
        along = (start_x * edge_x + start_y * edge_y) / length
        apart = turn * (start_x * edge_y - start_y * edge_x) / length
        size = np.maximum(np.abs(apart), tiny)
        total += apart * (np.arcsinh((along + length) / size) - np.arcsinh(along / size))
    return total


def unlike(eye: Array, place: Array, corners: Array, area: Array, first: int) -> Array:
    """Mean integral of 1/r between cells of any size for an even load of one in all, 1/mm: (n, n - first).

    Of all cells (n) and those from `first` on, with middles `place` (n, 2), corners (n, k, 2) and areas (n,). The
    larger of two is seen from the smaller's middle, which is nearly the mean over both; `eye` (n, 2) are the
    middles, or what they look like in a mirror.
    """
    extent = NEAR * np.ptp(corners, axis=1).max(axis=1)
    larger = area[:, None] > area[first:]
    seen = cdist(eye, place[first:])
    near = seen < np.where(larger, extent[:, None], extent[first:])
    seen[near] = 1.0
    np.divide(1.0, seen, out=seen)
    near[first:] = np.triu(near[first:])  # each two once
    i, j = np.nonzero(near)
    large, small = np.where(larger[i, j], (i, j + first), (j + first, i))
    four = (corners[:, 4:] == corners[:, 3:4]).all(axis=(1, 2))[large]
    for which, count in ((four, 4), (~four, corners.shape[1])):
        at = large[which]
        exact = polygon(eye[small[which]], corners[at, :count]) / area[at]
        seen[i[which], j[which]] = exact
    below = np.tril_indices(len(area) - first, -1)
    seen[first:][below] = seen[first:].T[below]
    return seen


def parallelogram(offset: Array, first: Array, second: Array) -> Array:
    """Integral of 1/r (mm) over flat parallelograms with these edges, seen from their middles plus `offset`.

    All (..., 2), in the parallelogram's plane, mm.
    """
    one, other = 0.5 * (first + second), 0.5 * (first - second)
    return polygon(offset, np.stack([-one, other, one, -other], axis=-2))
