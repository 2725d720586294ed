"""A tooth's stiffness eliminated layer by layer along the face: dense blocks, which BLAS does at full speed.

Elements stand in columns along the face, so their nodes in that order make the stiffness block tridiagonal. From both
ends to a layer in the middle, S0 = A0 and S = A - V' V for each next block, V = L^-1 C' over the nodes that both
share: the blocks' Cholesky factors L are those of the whole. Loads that no layer so far bears are zero there and left
out, and a' K^-1 b is the sum of (L^-1 a)' (L^-1 b) over the layers: nothing is carried back.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

from ._dense import factored, lower_solved

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
    begun: Array  # (layers,) how many have begun up to each layer

    @classmethod
    def of(cls, matrix: Any, layers: list[Array]) -> Columns:
        """Columns of `matrix` in the order in which the layers, unknowns each, bear them."""
        number = np.full(matrix.shape[0], len(layers))
        for k, unknowns in enumerate(layers):
            number[unknowns] = k
        entries = matrix.tocoo()
        first = np.full(matrix.shape[1], len(layers))
        np.minimum.at(first, entries.coords[1], number[entries.coords[0]])
        order = np.argsort(first, kind="stable")
        begun = np.searchsorted(first[order], np.arange(len(layers)), side="right")
        return cls(matrix.tocsc()[:, order].tocsr(), order, begun)

    def on(self, unknowns: Array, k: int) -> Array:
        """What the columns begun up to layer k put on its unknowns."""
        return self.matrix[unknowns][:, : self.begun[k]].toarray()


def through(
    matrix: Any, place: Array, load: Any, sight: Any, progress: Progress = lambda *_: None
) -> tuple[Array, Array]:
    """`load`' K^-1 `load` (r, r) and `sight`' K^-1 `load` (s, r) of a sparse symmetric K (n, n) > 0.

    `place` (n,) tells where each unknown stands, see `node_places`; `load` (n, r) and `sight` (n, s) are sparse.
    """
    matrix, load, sight = matrix.tocsr(), load.tocsr(), sight.tocsr()
    r, s = load.shape[1], sight.shape[1]
    last = int(place.max()) // 2
    middle = last // 2
    column, between = np.divmod(place, 2)
    core = np.flatnonzero(np.abs(place - (2 * middle - 1)) <= 1)  # a section and its neighbours
    rising = [np.flatnonzero(column == k) for k in range(middle - 1)]
    falling = [np.flatnonzero(column + between == k) for k in range(last, middle, -1)]
    whole = np.zeros((r + s, r))
    own = matrix[core][:, core].toarray()
    right = np.hstack([load[core].toarray(), sight[core].toarray()])
    done = 0

    def step() -> None:
        nonlocal done
        done += 1
        progress("compliance", done, last + 1)

    for layers in (rising, falling):
        if layers:
            columns = Columns.of(load, [*layers, core]), Columns.of(sight, [*layers, core])
            product, off_own, off_right = _eliminated(matrix, [*layers, core], *columns, step)
            order = np.concatenate([columns[0].order, r + columns[1].order])
            whole[np.ix_(order, columns[0].order)] += product
            own -= off_own
            right[:, order] -= off_right
    answer = lower_solved(factored(own), right)
    step()
    whole += answer.T @ answer[:, :r]
    return whole[:r], whole[r:]


def _eliminated(
    matrix: Any, layers: list[Array], load: Columns, sight: Columns, step: Callable[[], None]
) -> tuple[Array, Array, Array]:
    """Products over all layers but the last, (r + s, r), and what these take off the last one's own and loads."""
    r, s = len(load.order), len(sight.order)
    product = np.zeros((r + s, r))
    off_own, off_right, had = np.zeros(()), np.zeros((0, 0)), (0, 0)
    unknowns = layers[0]
    for k in range(len(layers) - 1):
        meets = np.diff(matrix[unknowns][:, layers[k + 1]].indptr) > 0
        turn = np.concatenate([np.flatnonzero(~meets), np.flatnonzero(meets)])
        front = int(meets.sum())
        a, b = load.begun[k], sight.begun[k]
        right = np.hstack([load.on(unknowns, k), sight.on(unknowns, k)])
        if k:
            right[:, : had[0]] -= off_right[:, : had[0]]
            right[:, a : a + had[1]] -= off_right[:, had[0] :]
        own = matrix[unknowns][:, unknowns].toarray() - off_own
        factor = factored(own[np.ix_(turn, turn)])
        answer = lower_solved(factor, right[turn])
        link = lower_solved(
            factor[-front:, -front:], matrix[unknowns[meets]][:, layers[k + 1]].toarray()
        )
        off_own, off_right, had = link.T @ link, link.T @ answer[-front:], (a, b)
        part = answer.T @ answer[:, :a]
        product[:a, :a] += part[:a]
        product[r : r + b, :a] += part[a:]
        unknowns = layers[k + 1]
        step()
    all_right = np.zeros((len(unknowns), r + s))
    all_right[:, : had[0]] = off_right[:, : had[0]]
    all_right[:, r : r + had[1]] = off_right[:, had[0] :]
    return product, off_own, all_right
