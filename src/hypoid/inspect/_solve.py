"""Least squares of a correction: the part's turn taken out, small directions left out by the noise.

Columns are scaled by each adjustment's reach, so a singular value is what a plausible change along that direction
does to the flank (mm, root of the sum of squares). Where that is within the measuring noise the data cannot decide,
and what noise then asks for would make the cut worse (notes on lin1996: rank 8 against rank 3).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.machine import shown

from ._setup import Adjustment, Setup

Array = np.ndarray[Any, Any]
ABOVE_NOISE = 3.0  # times the noise: what a plausible change along a direction must do to the flank
ASKED = (
    2.0**0.5
)  # times the noise: what must be asked along it (Mallows: less costs more than it gains)
NOTHING = 1e-9  # mm, singular values of exact null directions
EXACT = 1e-6  # mm, singular values of directions that do nothing at all, as far as it matters
SHOWN = 0.05  # share of the largest part below which an adjustment is not named
# Why some directions are empty (notes on lin1996, inspection).
REASONS: dict[frozenset[str], str] = {
    frozenset(
        {"sliding_base", "point_radius"}
    ): "a straight blade moved along its axis and as much wider cuts the same flank",
    frozenset({"cradle_angle"}): "turning the cradle turns the part: index",
    frozenset(
        {"blank_offset", "machine_center_to_back", "machine_root_angle"}
    ): "a nearly rigid motion of the work",
}


@dataclass(frozen=True)
class NullDirection:
    """A combination of adjustments that the measurement cannot decide."""

    steps: Mapping[str, float]  # mm, rad; the largest part at its reach
    effect: float  # mm rms on the flanks
    words: str


@dataclass(frozen=True, eq=False)
class Directions:
    """Singular directions of the free adjustments, strongest first.

    ``left`` (m, k) are unit patterns on the flank, ``right`` (names, k) in units of the reach.
    """

    names: tuple[str, ...]
    reach: Array
    left: Array
    values: Array
    right: Array
    noise: float

    @property
    def decidable(self) -> int:
        """How many directions a plausible change of which stands clear of the noise."""
        return int((self.values > max(ABOVE_NOISE * self.noise, NOTHING)).sum())

    def kept(self, asked: Array, rank: int | None) -> Array:
        """Directions (bool, k) to correct along, for what is asked (m,): by hand, or by the noise."""
        if rank is not None:
            return np.arange(len(self.values)) < min(rank, int((self.values > NOTHING).sum()))
        clear = np.arange(len(self.values)) < self.decidable
        return clear & (np.abs(self.left.T @ asked) > ASKED * self.noise)

    def step(self, asked: Array, kept: Array) -> Array:
        """Changes (names,), mm and rad, that take the asked (m,) off along the kept directions."""
        along = np.where(kept, self.left.T @ asked, 0.0)
        scaled = np.divide(along, self.values, out=np.zeros_like(along), where=kept)
        return -self.reach * (self.right @ scaled)


def directions(
    names: Sequence[str], reach: Array, jacobian: Array, taken_out: Array, noise: float
) -> Directions:
    """Directions of a weighted Jacobian (m, names), what is ``taken_out`` (m, m) applied."""
    left, values, right = np.linalg.svd(taken_out @ jacobian * reach, full_matrices=False)
    return Directions(tuple(names), reach, left, values, right.T, noise)


def without(columns: Array) -> Array:
    """Projector (m, m) onto what is square to columns (m, k)."""
    q, r = np.linalg.qr(columns)
    q = q[:, np.abs(np.diag(r)) > 1e-12]
    return np.eye(len(columns)) - q @ q.T


def null_directions(found: Directions, setup: Setup, points: int) -> tuple[NullDirection, ...]:
    """What cannot be decided, in words; each as few adjustments as there are."""
    if not points:
        return ()
    first = found.decidable
    exact = max(first, int((found.values > EXACT).sum()))
    made: list[NullDirection] = []
    for row in (*_sparse(found.right[:, exact:].T), *_sparse(found.right[:, first:exact].T)):
        row = row / np.abs(row).max()
        effect = found.values * (found.right.T @ row)
        rms = float(np.sqrt((effect**2).sum() / points))
        there = np.abs(row) > SHOWN
        steps = {
            n: float(v)
            for n, v, on in zip(found.names, row * found.reach, there, strict=True)
            if on
        }
        made.append(NullDirection(steps, rms, _words(steps, rms, setup)))
    return tuple(made)


def _sparse(rows: Array) -> Array:
    """The rows' space by rows with as few entries as elimination with pivots leaves."""
    rows = rows.copy()
    for k in range(len(rows)):
        free = np.abs(rows[k:])
        i, j = divmod(int(free.argmax()), free.shape[1])
        rows[[k, k + i]] = rows[[k + i, k]]
        rows[k] /= rows[k, j]
        for other in range(len(rows)):
            if other != k:
                rows[other] -= rows[other, j] * rows[k]
    return rows


def _words(steps: Mapping[str, float], rms: float, setup: Setup) -> str:
    parts = [f"{n} {shown_step(setup.adjustments[n], s)}" for n, s in steps.items()]
    bare = frozenset(n.split(".")[-1] for n in steps)
    reason = REASONS.get(bare, "")
    effect = (
        f"changes the flanks by {rms * 1e3:.2g} um rms"
        if rms > 5e-6
        else "leaves the flanks as they are"
    )
    return f"{' with '.join(parts)} {effect}{f' ({reason})' if reason else ''}"


def shown_step(adjustment: Adjustment, step: float) -> str:
    """A step as a person writes it, with its sign."""
    if adjustment.kind == "angle":
        return f"{np.degrees(step) * 60.0:+.4g} min"
    if adjustment.kind == "length":
        return f"{step:+.4g} mm"
    return f"{step:+.4g}"


def shown_reading(adjustment: Adjustment, value: float) -> str:
    """A reading as a person writes it."""
    if adjustment.kind == "angle":
        return shown(value, "angle")
    return f"{value:.7g} mm" if adjustment.kind == "length" else f"{value:.8g}"
