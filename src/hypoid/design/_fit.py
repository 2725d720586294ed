"""Gauss-Newton for settings: truncated where nothing is determined, and within a trust region.

Columns are scaled by the step that an entry may take, so that mm and rad compare; singular directions
below the cut are left alone, and shown. A step that is too long is tried in two ways, shortened as a whole
and damped where little is determined (Levenberg and Marquardt): the first goes far along a valley, the
second down its side. Plain NumPy.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
CUT = 1e-5  # of the greatest singular value, below which a direction counts as undetermined
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

    @property
    def cost(self) -> float:
        """Sum of squares."""
        return float(self.look.residual @ self.look.residual)


Model = Callable[[Array, Any], Look | None]


def gauss_newton(
    model: Model,
    start: Array,
    memory: Any,
    limits: Array,
    *,
    steps: int = 40,
    cut: float = CUT,
    tolerance: float = 1e-6,
) -> Fit | None:
    """Least squares by truncated Gauss-Newton; None where not even the start can be computed.

    ``model`` gives a look, or None where there is none, from what an accepted look remembers;
    ``limits`` is the greatest change of each entry in one step, which is its scale, too.
    """
    seen = model(start, memory)
    if seen is None:
        return None
    x, settled, taken = start, False, 0
    best, nearest = x, seen
    while taken < steps and not settled:
        taken += 1
        u, values, rows = np.linalg.svd(seen.jacobian * limits, full_matrices=False)
        kept = values > cut * values[0]
        values, rows, wanted = values[kept], rows[kept], (u.T @ seen.residual)[kept]
        cost, gain, reach = float(seen.residual @ seen.residual), 0.0, 1.0
        while reach > LEAST_REACH:
            for step in (
                _scaled(values, rows, wanted, reach),
                _damped(values, rows, wanted, reach),
            ):
                trial = x + limits * step
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
    return Fit(x, seen, values, rows, taken, settled)


def _scaled(values: Array, rows: Array, wanted: Array, reach: float) -> Array:
    """The Gauss-Newton step, shortened to the trust region; in units of the limits."""
    step = -(rows.T @ (wanted / values))
    return step / max(1.0, float(np.abs(step).max()) / reach)


def _damped(values: Array, rows: Array, wanted: Array, reach: float) -> Array:
    """The step that is damped as little as keeps it in the trust region."""
    damping = 0.0
    while True:
        step = -(rows.T @ (wanted * values / (values**2 + damping**2)))
        if np.abs(step).max() <= reach:
            return step
        damping = max(GROWTH * damping, float(values[-1]))
