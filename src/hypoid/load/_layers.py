"""A tooth's stiffness eliminated section by section along the face: dense blocks, which BLAS does at full speed.

Elements stand in columns along the face. Nodes within a column meet but the sections on both its sides, so they go
first; what is left is a block tridiagonal chain of sections, from both ends to one in the middle: S0 = A0 and
S = A - V' V for each next block, V = L^-1 C'. The blocks' Cholesky factors L are those of the whole. Loads that nothing
so far bears are zero there and left out, and a' K^-1 b is the sum of (L^-1 a)' (L^-1 b) over all blocks: nothing is
carried back.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import CancelledError
from dataclasses import dataclass
from itertools import count
from threading import Event
from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

from ._dense import factored, lower_solved, side_by_side

Array = np.ndarray[Any, Any]
Progress = Callable[[str, int, int], None]
SIDES = np.array([[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])  # corners of S3 to S6


def node_places(count: int, elements: Array) -> Array:
    """Place (count,) of every node along the face: 2 c within the column c of elements, 2 c + 1 between two.

    Elements are of one column where faces other than S1 and S2 join them.
    """
    corners = np.sort(elements[:, SIDES].reshape(-1, 4), axis=1)
    _, face = np.unique(corners, axis=0, return_inverse=True)
    element = np.repeat(np.arange(len(elements)), 4)
    order = np.argsort(face, kind="stable")
    twin = np.flatnonzero(np.diff(face[order]) == 0)
    ends = (element[order[twin]], element[order[twin + 1]])
    joined = coo_array((np.ones(len(twin)), ends), shape=(len(elements),) * 2)
    columns, column = connected_components(joined, directed=False)
    low, high = np.full(count, columns), np.full(count, -1)
    np.minimum.at(low, elements, column[:, None])
    np.maximum.at(high, elements, column[:, None])
    between = low < high
    next_to = coo_array(
        (np.ones(between.sum()), (low[between], high[between])), shape=(columns,) * 2
    ).tocsr()
    next_to = next_to + next_to.T
    ends = np.flatnonzero(np.diff(next_to.indptr) < 2)
    chain = breadth_first_order(next_to, ends[0], directed=False, return_predecessors=False)
    if len(chain) < columns or len(ends) > 2:
        raise ValueError("the columns of this mesh's elements do not stand one behind the other")
    rank = np.zeros(columns, dtype=int)
    rank[chain] = np.arange(columns)
    return rank[low] + rank[high]


@dataclass(frozen=True, eq=False)
class Columns:
    """Sparse columns, those that begin first in front."""

    matrix: Any  # (n, r) csr
    order: Array  # (r,) which column each was
    begun: Array  # (steps,) how many have begun up to each step

    @classmethod
    def of(cls, matrix: Any, steps: list[Array]) -> Columns:
        """Columns of `matrix` in the order in which the steps, unknowns each, bear them."""
        number = np.full(matrix.shape[0], len(steps))
        for k, unknowns in enumerate(steps):
            number[unknowns] = k
        entries = matrix.tocoo()
        first = np.full(matrix.shape[1], len(steps))
        np.minimum.at(first, entries.coords[1], number[entries.coords[0]])
        order = np.argsort(first, kind="stable")
        begun = np.searchsorted(first[order], np.arange(len(steps)), side="right")
        return cls(matrix.tocsc()[:, order].tocsr(), order, begun)

    def on(self, unknowns: Array, k: int) -> Array:
        """What the columns begun up to step k put on its unknowns."""
        return self.matrix[unknowns][:, : self.begun[k]].toarray(order="F")

    def some(self, unknowns: Array) -> tuple[Array, Array]:
        """The columns that put anything on these unknowns, and what they put."""
        rows = self.matrix[unknowns]
        which = np.unique(rows.indices)
        return which, rows[:, which].toarray()


def through(
    matrix: Any, place: Array, load: Any, sight: Any, progress: Progress = lambda *_: None
) -> tuple[Array, Array]:
    """`load`' K^-1 `load` (r, r) and `sight`' K^-1 `load` (s, r) of a sparse symmetric K (n, n) > 0.

    `place` (n,) tells where each unknown stands, see `node_places`; `load` (n, r) and `sight` (n, s) are sparse.
    """
    matrix, load, sight = matrix.tocsr(), load.tocsr(), sight.tocsr()
    last = int(place.max()) // 2
    inner = [np.flatnonzero(place == 2 * c) for c in range(last + 1)]
    sections = [np.flatnonzero(place == 2 * c + 1) for c in range(last)]
    sections = sections or [np.zeros(0, dtype=int)]  # one column has none
    middle = len(sections) // 2
    passed = count(1)

    def step() -> None:
        progress("compliance", next(passed), last + 1)

    def towards(columns: list[Array], chain: list[Array]) -> Callable[[Event], _Eliminated]:
        return lambda stop: _eliminated(matrix, columns, chain, (load, sight), step, stop)

    ways = [towards(inner[: middle + 1], sections[: middle + 1])]
    if last:
        ways.append(towards(inner[:middle:-1], sections[: middle - 1 if middle else None : -1]))
    core = sections[middle]
    own = matrix[core][:, core].toarray()
    right = [v[core].toarray(order="F") for v in (load, sight)]
    found = [np.zeros((v.shape[1], load.shape[1])) for v in (load, sight)]
    for end in side_by_side(ways):
        own -= end.off_own
        for k in (0, 1):
            right[k][:, end.order[k]] -= end.off_right[k]
            found[k][np.ix_(end.order[k], end.order[0])] += end.product[k]
    factor = factored(own)
    loads, sights = (lower_solved(factor, v) for v in right)
    return found[0] + loads.T @ loads, found[1] + sights.T @ loads


@dataclass(frozen=True, eq=False)
class _Eliminated:
    """A chain up to its last section: products of what is eliminated, and what that takes off the section.

    Pairs are of loads and of sights, those alone that bear on the chain before that section.
    """

    order: tuple[Array, Array]  # (r,), (s,): which load and which sight each is
    product: tuple[Array, Array]  # (r, r), (s, r)
    off_own: Array  # (n, n)
    off_right: tuple[Array, Array]  # (n, r), (n, s)


def _eliminated(
    matrix: Any,
    inner: list[Array],
    chain: list[Array],
    sides: tuple[Any, Any],
    step: Callable[[], None],
    stop: Event,
) -> _Eliminated:
    """Elimination of a chain up to its last section; of `inner` unknowns each is before the section of its number."""
    steps = [np.concatenate(v) for v in zip(inner, [inner[0][:0], *chain[:-1]], strict=True)]
    kinds = [Columns.of(side, steps) for side in sides]
    product = [np.zeros((kind.begun[-1], kinds[0].begun[-1])) for kind in kinds]
    off_own = np.zeros((0, 0))
    off_right = [np.zeros((0, 0))] * 2
    for k, (column, here) in enumerate(zip(inner, chain, strict=True)):
        if stop.is_set():
            raise CancelledError
        rows = matrix[column]
        factor = factored(rows[:, column].toarray())
        ahead = lower_solved(factor, rows[:, here].toarray())
        which, some = zip(*(kind.some(column) for kind in kinds), strict=True)
        borne = [lower_solved(factor, v) for v in some]
        for i in (0, 1):
            product[i][np.ix_(which[i], which[0])] += borne[i].T @ borne[0]
        next_own = ahead.T @ ahead
        if k == 0:
            next_right = [np.zeros((len(here), kind.begun[0])) for kind in kinds]
        else:
            before = chain[k - 1]
            behind = lower_solved(factor, rows[:, before].toarray())
            rows = matrix[before]
            own = rows[:, before].toarray() - off_own - behind.T @ behind
            factor = factored(own)
            link = lower_solved(factor, rows[:, here].toarray() - behind.T @ ahead)
            answer: list[Array] = []
            for i, kind in enumerate(kinds):
                right = kind.on(before, k)
                right[:, : off_right[i].shape[1]] -= off_right[i]
                right[:, which[i]] -= behind.T @ borne[i]
                answer.append(lower_solved(factor, right, overwrite=True))
            a, b = (kind.begun[k] for kind in kinds)
            product[0][:a, :a] += answer[0].T @ answer[0]
            product[1][:b, :a] += answer[1].T @ answer[0]
            next_own += link.T @ link
            next_right = [(v.T @ link).T for v in answer]
        for i in (0, 1):
            next_right[i][:, which[i]] += ahead.T @ borne[i]
        off_own, off_right = next_own, next_right
        step()
    first, second = (kind.order[: kind.begun[-1]] for kind in kinds)
    return _Eliminated(
        (first, second), (product[0], product[1]), off_own, (off_right[0], off_right[1])
    )
