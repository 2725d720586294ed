"""Cells of their own where a rounded tip bears: a strip along the arc's beginning, narrow rows on it.

Rows are even on the arc and grow from there towards the flank until they are as wide as the grid's cells. Cells of
the grid that reach into the strip are cut off along its border, so that no place is covered twice.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from ._patch import CORNERS, Patch, middles, recut
from ._tips import Arc

Array = np.ndarray[Any, Any]
ON_ARC, BESIDE = 8, 4  # even rows on the arc as deep as it is thought to bear, and before it begins
GROWTH = 1.4  # times, from row to row on the flank
STEPS = 1.0  # of the grid's cells' lengths along a tip
LEAST = 0.5  # of a cell: pieces of the grid's cells are joined to the next one below that
TOO_DEEP = 0.5  # of the depth: an arc that bears over less gets narrower rows


def bearing(p: Patch, pressure: Array, plane_modulus: float) -> dict[int, float]:
    """Rounded tips (0 pinion's, 1 wheel's) that bear, and how deep beyond the arc's beginning, mm.

    Of line contacts: an arc of radius r under pressure p touches over about 2 p r / E* either way.
    """
    found: dict[int, float] = {}
    for k, arc in enumerate(p.arcs):
        if arc is not None:
            step = float(np.abs(arc.line[1:] * p.size).max())
            near = (pressure > 0.0) & (arc.apart(p.plane) < arc.start + step)
            if near.any():
                half = 2.0 * float(pressure[near].max()) * arc.radius / plane_modulus
                found[k] = min(2.0 * half, arc.radius)
    return found


def with_strips(p: Patch, depths: Mapping[int, float]) -> Patch:
    """A patch whose cells beside these tips are strips', rows on the arc reaching that deep (mm)."""
    kept = np.ones(p.count, dtype=bool)
    cut: list[Array] = []
    borders: list[tuple[Arc, float]] = []
    for k, depth in depths.items():
        arc = p.arcs[k]
        assert arc is not None
        rows = arc.start + _rows(depth, min(p.size))
        strip = [
            c for c in _strip(p, arc, rows)
            if all(a.apart(c.mean(axis=0)) > least for a, least in borders)
        ]  # fmt: skip
        inner = float(rows[-1])
        gone, pieces = _cut_cells(p, kept, arc, inner)
        kept &= ~gone
        cut = [c for one in cut if len(c := _beyond(one, arc.apart(one) - inner))] + pieces + strip
        borders.append((arc, inner))
    # narrow cells that reach over an end would see each other in its mirror
    for _, *ends in p.lines:
        for end in ends:
            line = end / np.hypot(*end[1:])
            cut = [c for one in cut if len(c := _beyond(one, line[0] + one @ line[1:]))]
    return recut(p, kept, np.array([_padded(c) for c in cut]).reshape(-1, CORNERS, 2))


def deeper(p: Patch, force: Array, depths: Mapping[int, float]) -> dict[int, float]:
    """Depths (mm) that fit arcs better under these forces (n,); those that do not fit yet."""
    found: dict[int, float] = {}
    for k, depth in depths.items():
        arc = p.arcs[k]
        assert arc is not None
        apart = arc.start - arc.apart(p.plane)[force > 0.0]
        row = depth / ON_ARC
        reached = float(apart.max(initial=-np.inf)) + 0.5 * row
        if reached > depth - 0.5 * row:
            found[k] = 2.0 * depth
        elif 0.0 < reached < TOO_DEEP * depth:
            found[k] = reached + row
    return found


def _cut_cells(p: Patch, kept: Array, arc: Arc, inner: float) -> tuple[Array, list[Array]]:
    """Cells (n,) of the grid that a strip up to `inner` mm touches, and the polygons left of them.

    What is left of a row of the grid between strip and whole cells is one polygon; less than half a cell takes the
    next cell in, since pressure on a sliver is nothing but its neighbours' error.
    """
    corners, place = p.corners, np.argwhere(p.on)
    apart = arc.apart(corners)
    axis = int(
        np.abs(arc.line[1:] * p.size).argmax()
    )  # across rows the strip's border moves by less than a cell
    way = int(np.sign(arc.line[1 + axis]))
    gone, pieces = kept & (apart.min(axis=1) < inner), list[Array]()
    for row in np.unique(place[gone, 1 - axis]):
        mine = np.flatnonzero(kept & (place[:, 1 - axis] == row))
        mine = mine[np.argsort(way * place[mine, axis])]
        parts = [i for i in mine if gone[i] and apart[i].max() > inner]
        if not parts:
            continue
        around = _around(corners[parts])
        piece = _beyond(around, arc.apart(around) - inner)
        after = mine[mine.tolist().index(parts[-1]) + 1 :][:1]
        small = len(piece) == 0 or middles(piece[None])[1][0] < LEAST * p.size[0] * p.size[1]
        if small and len(after) and abs(place[after[0], axis] - place[parts[-1], axis]) == 1:
            gone[after[0]] = True
            around = _around(corners[[*parts, after[0]]])
            piece = _beyond(around, arc.apart(around) - inner)
        if len(piece):
            pieces.append(piece)
    return gone, pieces


def _around(corners: Array) -> Array:
    """The rectangle (4, 2) about cells (k, CORNERS, 2) of the grid."""
    (a, b), (c, d) = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    return np.array([(a, b), (c, b), (c, d), (a, d)])


def _rows(depth: float, most: float) -> Array:
    """Borders of rows, rising, mm inside the arc's beginning."""
    heights = [depth / ON_ARC] * (ON_ARC + BESIDE)
    while heights[-1] < most:
        heights.append(min(GROWTH * heights[-1], most))
    return np.cumsum([-depth, *heights])


def _strip(p: Patch, arc: Arc, rows: Array) -> list[Array]:
    """Cells (4, 2) along an arc, over the whole of its tip in the window."""
    square = arc.line[1:]
    way = np.array([-square[1], square[0]])
    step = min(size / max(abs(float(w)), 1e-12) for size, w in zip(p.size, way, strict=True))
    step *= STEPS
    window = np.array([p.window.along, p.window.across])
    corners = np.stack(np.meshgrid(*window, indexing="ij"), axis=-1).reshape(-1, 2)
    reach = corners @ way
    count = int(np.ceil(np.ptp(reach) / step))
    along = reach.min() + (np.arange(count) + 0.5) * step
    made: list[Array] = []
    for low, high in pairwise(rows):
        middle = (0.5 * (low + high) - arc.line[0]) * square + along[:, None] * way
        inside = ((middle > window[:, 0]) & (middle < window[:, 1])).all(axis=1)
        half, tall = 0.5 * step * way, 0.5 * (high - low) * square
        around = np.array([-half - tall, half - tall, half + tall, tall - half])
        made += list(middle[inside, None] + around)
    return made


def _beyond(corners: Array, apart: Array) -> Array:
    """What is left (m, 2) of a convex polygon (k, 2) where `apart` (k,) of a line is positive; nothing if no area."""
    if apart.min() >= 0.0:
        return corners
    made: list[Array] = []
    for k, (here, to) in enumerate(zip(apart, np.roll(apart, -1), strict=True)):
        if here >= 0.0:
            made.append(corners[k])
        if (here < 0.0) != (to < 0.0):
            share = here / (here - to)
            made.append(corners[k] + share * (corners[(k + 1) % len(corners)] - corners[k]))
    return np.array(made) if len(made) > 2 and apart.max() > 0.0 else np.zeros((0, 2))


def _padded(corners: Array) -> Array:
    return np.concatenate([corners, np.repeat(corners[-1:], CORNERS - len(corners), axis=0)])
