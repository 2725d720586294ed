"""Frictionless contact of elastic cells under a given moment: primal-dual active set.

Known are gaps g (mm), the compliance C per unit force (mm/N), levers l (mm) and the moment T (N mm). With
forces f and the member's rotation phi as unknowns,

    w = g + C f - l phi >= 0,   f >= 0,   f w = 0,   l . f = T.

On a set of touching cells this is linear; cells that pull leave the set and cells that cut each other join it
[Hintermueller, Ito, Kunisch 2002, SIAM J. Optim. 13].
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve

Array = np.ndarray[Any, Any]
ROUNDS = 60
OVERLAP = 1e-9  # mm: cells that cut each other by less do not touch


class Outcome(Enum):
    """How a contact problem ended; the value says what to do."""

    OK = ""
    NOT_CONVERGED = (
        "The set of touching cells did not settle: use more cells or a smaller step of torque."
    )
    NOT_POSITIVE = (
        "The compliance is not positive: the tooth's mesh is too coarse for the cells' spacing."
    )
    MORE_PAIRS = "The last of the pairs looked at carries load: look at two more pairs."
    NO_CONTACT = "No cell can carry the moment: the flanks do not meet here."


@dataclass(frozen=True)
class ContactSolution:
    """Forces of cells and the member's rotation."""

    force: Array  # (n,) N, none negative
    rotation: float  # rad
    gap: Array  # (n,) mm under load, zero where cells touch
    rounds: int
    outcome: Outcome
    stiffness: float = 0.0  # dT/dphi of the cells that touch, N mm/rad

    @property
    def touching(self) -> Array:
        return self.force > 0.0


def solve_contact(
    compliance: Array, gap: Array, lever: Array, moment: float, start: Array | None = None
) -> ContactSolution:
    """Forces (n,) N on cells with compliance (n, n) mm/N, gaps and levers (n,) mm under a moment > 0, N mm.

    `start` (n,) tells which cells are thought to touch. The outcome says whether the answer holds.
    """
    n = len(gap)
    able = lever > 0.0
    active = able.copy() if start is None or not (start & able).any() else start & able
    seen: set[bytes] = set()
    shrink = False
    force, phi, under = np.zeros(n), 0.0, gap
    if not able.any():
        return ContactSolution(force, phi, gap, 0, Outcome.NO_CONTACT)
    for count in range(1, ROUNDS + 1):
        on = np.flatnonzero(active)
        try:
            factor = cho_factor(compliance[np.ix_(on, on)], lower=True, check_finite=False)
        except LinAlgError:
            return ContactSolution(np.zeros(n), phi, gap, count, Outcome.NOT_POSITIVE)
        by_lever, by_gap = cho_solve(factor, np.stack([lever[on], gap[on]], axis=1)).T
        phi = float((moment + lever[on] @ by_gap) / (lever[on] @ by_lever))
        trial = phi * by_lever - by_gap
        force = np.zeros(n)
        force[on] = trial
        under = gap + compliance[:, on] @ trial - lever * phi
        under[on] = 0.0
        pulls = active & (force <= 0.0)
        cuts = ~active & able & (under < -OVERLAP)
        if not pulls.any() and not cuts.any():
            slope = float(lever[on] @ by_lever)
            return ContactSolution(force, phi, under, count, Outcome.OK, slope)
        # the same set again is a cycle: from there on cells only leave, until those that cut join once more
        after = (active & ~pulls) if shrink and pulls.any() else (active & ~pulls) | cuts
        key = np.packbits(after).tobytes()
        shrink = shrink or key in seen
        seen.add(key)
        if not after.any():
            after[np.argmin(np.where(able, gap / np.where(able, lever, 1.0), np.inf))] = True
        active = after
    return ContactSolution(np.maximum(force, 0.0), phi, under, ROUNDS, Outcome.NOT_CONVERGED)
