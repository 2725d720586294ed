"""Frictionless contact of elastic cells under a given moment: primal-dual active set.

Known are gaps g (mm), the compliance C per unit force (mm/N), levers l (mm) and the moment T (N mm). With
forces f and the member's rotation phi as unknowns,

    w = g + C f - l phi >= 0,   f >= 0,   f w = 0,   l . f = T.

On a set of touching cells this is linear; cells that pull leave the set and cells that cut each other join it
[Hintermueller, Ito, Kunisch 2002, SIAM J. Optim. 13], all at once until a set comes back, one by one from there on
[Murty 1974, Linear Algebra Appl. 9].
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
from scipy.linalg import LinAlgError

from ._dense import factored, lower_solved

Array = np.ndarray[Any, Any]
ROUNDS = 400
BORDER = 0.3  # of the cells that touch: where more change, the set is factorised anew
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
    MORE_PAIRS = "The last of the pairs looked at carries load: look at more pairs."
    LEFT_FLANKS = "The contact has left the flanks: edges bound more than half of it."
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
    slowly = False
    force, phi, under = np.zeros(n), 0.0, gap
    if not able.any():
        return ContactSolution(force, phi, gap, 0, Outcome.NO_CONTACT)
    sides = np.stack([lever, gap], axis=1)
    solver: _Solver | None = None
    for count in range(1, ROUNDS + 1):
        try:
            if solver is None or not solver.near(active):
                solver = _Solver(compliance, sides, active)
            by_lever, by_gap = solver.on(active)
        except LinAlgError:
            return ContactSolution(np.zeros(n), phi, gap, count, Outcome.NOT_POSITIVE)
        phi = float((moment + lever @ by_gap) / (lever @ by_lever))
        force = phi * by_lever - by_gap
        under = gap + compliance @ force - lever * phi
        under[active] = 0.0
        pulls = active & (force <= 0.0)
        cuts = ~active & able & (under < -OVERLAP)
        if not pulls.any() and not cuts.any():
            slope = float(lever @ by_lever)
            return ContactSolution(force, phi, under, count, Outcome.OK, slope)
        wrong = pulls | cuts
        if slowly:  # the first of them alone, which comes to an end [Murty 1974]
            wrong[np.flatnonzero(wrong)[1:]] = False
        after = active ^ wrong
        key = np.packbits(after).tobytes()
        slowly = slowly or key in seen  # the same set again is a cycle
        seen.add(key)
        if not after.any():
            after[np.argmin(np.where(able, gap / np.where(able, lever, 1.0), np.inf))] = True
        active = after
    return ContactSolution(np.maximum(force, 0.0), phi, under, ROUNDS, Outcome.NOT_CONVERGED)


class _Solver:
    """Solutions for right-hand sides on sets of cells that differ little from one that is factorised.

    Cells that have left are held to no force by a gap of their own, those that have joined border the factor.
    """

    def __init__(self, compliance: Array, sides: Array, active: Array) -> None:
        self.compliance, self.sides, self.active = compliance, sides, active
        self.base = np.flatnonzero(active)
        self.factor = factored(compliance[np.ix_(self.base, self.base)])
        self.answer = lower_solved(self.factor, lower_solved(self.factor, sides[self.base]), True)

    def near(self, active: Array) -> bool:
        """Whether bordering is cheaper than a factor of this set's own."""
        return bool(np.count_nonzero(active != self.active) < BORDER * len(self.base))

    def on(self, active: Array) -> Array:
        """Solutions (2, n) for both sides, zero off the set."""
        made = np.zeros((len(active), self.sides.shape[1]))
        left, joined = (
            np.flatnonzero(self.active[self.base] & ~active[self.base]),
            active & ~self.active,
        )
        joined = np.flatnonzero(joined)
        made[self.base] = self.answer
        if len(left) + len(joined):
            hold = np.zeros((len(self.base), len(left)), order="F")
            hold[left, np.arange(len(left))] = 1.0
            border = np.concatenate([self.compliance[np.ix_(self.base, joined)], hold], axis=1)
            half = lower_solved(self.factor, border)
            small = -(half.T @ half)
            j = len(joined)
            small[:j, :j] += self.compliance[np.ix_(joined, joined)]
            right = np.concatenate([self.sides[joined], np.zeros((len(left), 2))])
            share = np.linalg.solve(small, right - border.T @ self.answer)
            made[self.base] -= lower_solved(self.factor, half @ share, True)
            made[self.base[left]] = 0.0
            made[joined] = share[:j]
        return made.T
