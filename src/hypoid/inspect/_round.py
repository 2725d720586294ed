"""Steps on the dials' increments, chosen together: what rounding one dial spoils another makes good."""

from __future__ import annotations

from itertools import combinations, product
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
TOGETHER = 3  # dials that are moved by an increment at once
MOST = 12  # dials that are searched so; more are moved two at once
ROUNDS = 200
DRIFT = (
    1e-3  # mm: what a change by the reach costs, so that no dial runs off along an empty direction
)
GAIN = 1e-16  # mm**2, of the sum of squares


def on_increments(
    steps: Array, grain: Array, now: Array, effect: Array, limits: Array, reach: Array
) -> Array:
    """Steps (k,) whose readings ``now`` + step stand on multiples of ``grain`` (0: on none), within limits (k, 2).

    Least squares of what rounding does to the flank, ``effect`` (m, k) times the change: from the nearest increments
    and from no step at all, by moves of up to three dials while they help. Dials without increments follow.
    """
    on = grain > 0.0
    if not on.any():
        return steps
    gram = effect.T @ effect + np.diag((DRIFT / reach) ** 2)
    loose = np.flatnonzero(~on)
    follow = np.zeros((len(loose), int(on.sum())))
    if len(loose):
        inner = gram[np.ix_(loose, loose)]
        follow = (
            np.linalg.pinv(inner, rcond=1e-10, hermitian=True)
            @ gram[np.ix_(loose, np.flatnonzero(on))]
        )
        gram = gram[np.ix_(on, on)] - gram[np.ix_(on, ~on)] @ follow
    own, size = grain[on], steps[on]
    moves = _moves(len(own)) * own
    cost = np.einsum("ij,jk,ik->i", moves, gram, moves)
    low, high = limits[on].T
    best, least = None, np.inf
    for start in (size, np.zeros_like(size)):
        at = np.round((now[on] + start) / own) * own - now[on]
        for _ in range(ROUNDS):
            gain = cost + 2.0 * moves @ (gram @ (at - size))
            inside = ((at + moves >= low - 1e-12) & (at + moves <= high + 1e-12)).all(axis=1)
            k = int(np.argmin(np.where(inside, gain, np.inf)))
            if not (inside[k] and gain[k] < -GAIN):
                break
            at = at + moves[k]
        value = float((at - size) @ gram @ (at - size))
        if value < least:
            best, least = at, value
    made = steps.copy()
    made[on] = best
    made[loose] = np.clip(steps[loose] - follow @ (made[on] - size), *limits[loose].T)
    return made


def _moves(count: int) -> Array:
    """All moves (n, count) of one to three dials by one increment either way."""
    rows: list[Array] = []
    for size in range(1, (TOGETHER if count <= MOST else 2) + 1):
        for where in combinations(range(count), min(size, count)):
            for signs in product((-1.0, 1.0), repeat=len(where)):
                row = np.zeros(count)
                row[list(where)] = signs
                rows.append(row)
    return np.array(rows)
