"""The logical mesh of a section: a strip under slot and tooth, a tower in the middle, a ring below.

Columns i run around the axis from one slot's middle to the next, rows j outwards from the bore:

                    +--through--+             top land
                    |           |
     concave flank  |   tower   |  convex flank
                    |           |
    +-bottom+fillet-+           +-fillet+bottom-+   slot
    |                 strip                     |
    +-------------------------------------------+   base line
    |                 ring                      |
    +-------------------------------------------+   bore, or back face

Where tower and strip meet, in the middle of a fillet, three elements share the smooth surface; every inner node has
four neighbours. The lower part of a fillet lies on the strip, the upper part on the tower.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Root:
    """Elements of one root, from the slot's middle to the tower: its half of the bottom, its fillet."""

    bottom: int
    fillet: int

    @property
    def lower(self) -> int:
        """Elements of the fillet on the strip."""
        return self.fillet // 2

    @property
    def upper(self) -> int:
        """Elements of the fillet on the tower."""
        return self.fillet - self.lower

    @property
    def columns(self) -> int:
        return self.bottom + self.lower


@dataclass(frozen=True)
class Layout:
    """Numbers of elements of a section, and its nodes, quadrilaterals and edges."""

    concave: Root  # at the low angles of a left-hand member
    convex: Root
    through: int
    profile: int
    below: int
    rim: int

    @property
    def columns(self) -> int:
        return self.concave.columns + self.through + self.convex.columns

    @property
    def height(self) -> int:
        """Rows of the tower."""
        return max(self.concave.upper, self.convex.upper) + self.profile

    @property
    def base(self) -> int:
        """Row of the base line."""
        return self.rim

    @property
    def surface(self) -> int:
        """Row of the slot's surface."""
        return self.rim + self.below

    @cached_property
    def tower(self) -> slice:
        """Columns of nodes of the tower."""
        return slice(self.concave.columns, self.concave.columns + self.through + 1)

    @cached_property
    def number(self) -> Array:
        """Node at (i, j); -1 beside the tower."""
        there = np.zeros((self.columns + 1, self.surface + self.height + 1), dtype=bool)
        there[:, : self.surface + 1] = True
        there[self.tower] = True
        number = np.full(there.shape, -1)
        number[there] = np.arange(there.sum())
        return number

    @property
    def nodes(self) -> int:
        return int(self.number.max()) + 1

    @cached_property
    def cells(self) -> Array:
        """(i, j) of every quadrilateral (q, 2), the ring's first."""
        n = self.number
        full = (n[:-1, :-1] >= 0) & (n[1:, :-1] >= 0) & (n[1:, 1:] >= 0) & (n[:-1, 1:] >= 0)
        i, j = np.nonzero(full)
        order = np.lexsort((i, j, j >= self.base))
        return np.stack([i, j], axis=1)[order]

    @property
    def ring_cells(self) -> int:
        """How many of the cells lie in the ring."""
        return self.columns * self.rim

    @cached_property
    def quads(self) -> Array:
        """Nodes (q, 4) counter-clockwise over (angle, height)."""
        i, j = self.cells.T
        n = self.number
        return np.stack([n[i, j], n[i + 1, j], n[i + 1, j + 1], n[i, j + 1]], axis=1)

    @cached_property
    def _edges(self) -> tuple[Array, Array]:
        sides = np.stack([self.quads, np.roll(self.quads, -1, axis=1)], axis=-1).reshape(-1, 2)
        edges, place = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
        return edges, place.reshape(-1, 4)

    @property
    def edges(self) -> Array:
        """Two nodes (e, 2) of every edge."""
        return self._edges[0]

    @property
    def quad_edges(self) -> Array:
        """Edges (q, 4): below, right, above, left."""
        return self._edges[1]

    def edge(self, a: Array, b: Array) -> Array:
        """Edges between pairs of nodes."""
        pairs = np.sort(np.stack([a, b], axis=-1), axis=-1)
        key = self.edges[:, 0] * self.nodes + self.edges[:, 1]
        return np.searchsorted(key, pairs[..., 0] * self.nodes + pairs[..., 1])

    @cached_property
    def borders(self) -> dict[str, tuple[Array, int]]:
        """Cells and their side (0 below, 1 right, 2 above, 3 left) along each border of the section."""
        index = np.full((self.columns, self.surface + self.height), -1)
        index[tuple(self.cells.T)] = np.arange(len(self.cells))
        a, b = self.concave.columns, self.concave.columns + self.through
        strip, left, right = (
            index[:, self.surface - 1],
            index[a, self.surface :],
            index[b - 1, self.surface :],
        )
        ends = self.columns - self.convex.bottom
        return {
            "slot_bottom": (np.append(strip[: self.concave.bottom], strip[ends:]), 2),
            "concave_lower": (strip[self.concave.bottom : a], 2),
            "convex_lower": (strip[b:ends], 2),
            "concave_upper": (left[: self.concave.upper], 3),
            "convex_upper": (right[: self.convex.upper], 1),
            "concave_flank": (left[self.concave.upper :], 3),
            "convex_flank": (right[self.convex.upper :], 1),
            "top_land": (index[a:b, -1], 2),
            "low_side": (index[0, : self.surface], 3),
            "high_side": (index[-1, : self.surface], 1),
            "ring_below": (index[:, 0], 0),
            "ring_above": (index[:, self.base - 1], 2),
        }
