"""Gauss-Newton for settings: truncated where nothing is determined, and within a trust region.

Columns are scaled by the step that an entry may take, so that mm and rad compare; singular directions
below the cut are left alone, and shown. A step that is too long is tried in two ways, shortened as a whole
and damped where little is determined (Levenberg and Marquardt): the first goes far along a valley, the
second down its side. Entries may have bounds: one that stands at its bound and wants out is held
there, and the rest are solved for again, until none wants out (an active set). Plain NumPy.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
CUT = 1e-5  # of the greatest singular value, below which a direction counts as undetermined
SPOKEN, LEAST_SPOKEN = 4, 0.1  # entries of a direction that are named, and their least share
NOTHING = 1e-12  # square of a scaled column's rest
SHRINK, LEAST_REACH = 0.3, 1e-5  # of the trust region, where no step gains
GROWTH = 2.5  # of the damping, from try to try


@dataclass(frozen=True)
class Look:
    """Residuals and Jacobian at one x, and what the next look may start from."""

    residual: Array
    jacobian: Array
    memory: Any


@dataclass(frozen=True)
class Fit:
    """Where Gauss-Newton ended."""

    x: Array
    look: Look
    singular_values: Array  # of the scaled Jacobian, the greatest first
    directions: (
        Array  # (k, n) rows: right singular vectors in steps of ``limits``, beside those values
    )
    steps: int
    settled: bool
    held: Array  # (n,) +1 or -1 where an entry stands at its upper or lower bound and wants out

    @property
    def cost(self) -> float:
        """Sum of squares."""
        return float(self.look.residual @ self.look.residual)

    def undetermined(self, names: Sequence[str]) -> tuple[str, ...]:
        """Directions of the entries so named that nothing determines, and which were left alone, in words."""
        return tuple(
            ", ".join(
                f"{names[k]} {row[k]:+.2f}"
                for k in np.argsort(-np.abs(row))[:SPOKEN]
                if abs(row[k]) > LEAST_SPOKEN
            )
            for value, row in zip(self.singular_values, self.directions, strict=True)
            if value <= CUT * self.singular_values[0]
        )


EVENED = 10  # runs that lead from least squares towards the least greatest residual
FLOOR = 0.05  # of the greatest residual, that every row counts with at least


def evened(weight: Array, left: Array, greatest: float) -> Array:
    """Weights (n,) of rows for another run, from what they left in the last [C. L. Lawson, 1961]."""
    made = weight * np.sqrt(np.abs(left) / greatest + FLOOR)
    return made / np.sqrt(np.mean(made**2))


Model = Callable[[Array, Any], Look | None]


def promised(jacobian: Array, residual: Array, moving: Array, rows: Any) -> dict[int, float]:
    """What one more column would leave, by one linear step: root mean square of ``rows`` by column.

    ``jacobian`` is scaled by the limits, ``moving`` (n,) bool says which columns move already. Columns that
    do nothing which those do not are left out.
    """
    basis, values, _ = np.linalg.svd(jacobian[:, moving], full_matrices=False)
    basis = basis[:, values > CUT * values[0]]

    def off(v: Array) -> Array:
        return v - basis @ (basis.T @ v)

    left = off(residual)
    found: dict[int, float] = {}
    for k in np.flatnonzero(~moving):
        column = off(jacobian[:, k])
        size = float(column @ column)
        if size >= NOTHING:
            rest = (left - column * (column @ left) / size)[rows]
            found[int(k)] = float(np.sqrt(np.mean(rest**2)))
    return found


def gauss_newton(
    model: Model,
    start: Array,
    memory: Any,
    limits: Array,
    *,
    low: Array | None = None,
    high: Array | None = None,
    steps: int = 40,
    cut: float = CUT,
    tolerance: float = 1e-6,
) -> Fit | None:
    """Least squares by truncated Gauss-Newton; None where not even the start can be computed.

    Parameters
    ----------
    model
        Gives a look, or None where there is none, from what an accepted look remembers.
    limits
        The greatest change of each entry in one step, which is its scale, too.
    low, high
        Bounds of each entry; the start is put between them. None: no bounds.
    """
    low = np.full(len(start), -np.inf) if low is None else low
    high = np.full(len(start), np.inf) if high is None else high
    x = np.clip(start, low, high)
    seen = model(x, memory)
    if seen is None:
        return None
    settled, taken = False, 0
    best, nearest = x, seen
    while taken < steps and not settled:
        taken += 1
        room = (low - x) / limits, (high - x) / limits
        problem = _Linear(seen.jacobian * limits, seen.residual, *room, cut)
        cost, gain, reach = float(seen.residual @ seen.residual), 0.0, 1.0
        while reach > LEAST_REACH:
            for kind in (_scaled, _damped):
                trial = np.clip(x + limits * problem.step(kind, reach), low, high)
                look = model(trial, seen.memory)
                left = np.inf if look is None else float(look.residual @ look.residual)
                if look is not None and left < cost - gain:
                    gain, best, nearest = cost - left, trial, look
            if gain > 0.0:
                x, seen = best, nearest
                break
            reach *= SHRINK
        settled = gain <= tolerance * cost
    _, values, rows = np.linalg.svd(seen.jacobian * limits, full_matrices=False)
    held = _held(seen.jacobian * limits, seen.residual, (low - x) / limits, (high - x) / limits)
    return Fit(x, seen, values, rows, taken, settled, held)


Kind = Callable[[Array, Array, Array, float], Array]


class _Linear:
    """The linear problem of one step, between bounds; all in units of the limits."""

    def __init__(
        self, jacobian: Array, residual: Array, low: Array, high: Array, cut: float
    ) -> None:
        self._jacobian, self._residual, self._cut = jacobian, residual, cut
        self._low, self._high = low, high
        self._out = _held(jacobian, residual, low, high) != 0.0
        self._first = self._resolved(~self._out, residual)

    def step(self, kind: Kind, reach: float) -> Array:
        """The step of a kind within reach and bounds."""
        out, step = self._out.copy(), np.zeros(len(self._low))
        parts = self._first
        while True:
            step[~out] = kind(*parts, reach)
            beyond = ~out & ((step < self._low) | (step > self._high))
            if not beyond.any():
                return step
            step = np.clip(step, self._low, self._high)
            out |= beyond
            if out.all():
                return step
            rest = self._residual + self._jacobian[:, out] @ step[out]
            parts = self._resolved(~out, rest)

    def _resolved(self, free: Array, residual: Array) -> tuple[Array, Array, Array]:
        """Singular values, right vectors and the residual along the left ones, where determined."""
        u, values, rows = np.linalg.svd(self._jacobian[:, free], full_matrices=False)
        kept = values > self._cut * values[0] if len(values) else np.zeros(0, bool)
        return values[kept], rows[kept], (u.T @ residual)[kept]


AT_BOUND = 1e-9  # of a step limit


def _held(jacobian: Array, residual: Array, low: Array, high: Array) -> Array:
    """+1 or -1 where an entry at its upper or lower bound would gain by leaving it, else 0."""
    gradient = jacobian.T @ residual
    upper = (high < AT_BOUND) & (gradient < 0.0)
    lower = (low > -AT_BOUND) & (gradient > 0.0)
    return upper.astype(float) - lower.astype(float)


def _scaled(values: Array, rows: Array, wanted: Array, reach: float) -> Array:
    """The Gauss-Newton step, shortened to the trust region; in units of the limits."""
    step = -(rows.T @ (wanted / values))
    return step / max(1.0, float(np.abs(step).max(initial=0.0)) / reach)


def _damped(values: Array, rows: Array, wanted: Array, reach: float) -> Array:
    """The step that is damped as little as keeps it in the trust region."""
    damping = 0.0
    while True:
        step = -(rows.T @ (wanted * values / (values**2 + damping**2)))
        if np.abs(step).max(initial=0.0) <= reach:
            return step
        damping = max(GROWTH * damping, float(values[-1]))
