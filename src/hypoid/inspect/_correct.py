"""Corrections: steps of dials and blades that bring a cut flank to its target, by exact re-cutting.

Gauss-Newton on the exact flanks: to what was measured is added what the steps change (cut anew, less as it is cut now),
until the part that can be decided is gone. The part's turn about its axis is free: one for each flank cut by itself,
whose thickness is the index's affair; one for both flanks cut together, whose thickness then counts.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from hypoid.flank import Side
from hypoid.geometry import DesignError, Problem

from ._response import Response
from ._round import on_increments
from ._setup import Setup, chosen
from ._solve import Directions, NullDirection, directions, null_directions, without

Array = np.ndarray[Any, Any]
ROUNDS = 12
TINY = 1e-12  # mm, rad: what rounding leaves of no step
CONVERGED = 1e-6  # mm rms that a further step would change


@dataclass(frozen=True)
class Wish:
    """What a correction may do, and how well the flank is known."""

    free: tuple[str, ...] = ()  # adjustments; none: the dials that usually move
    noise: float = 0.0015  # mm, standard deviation of one measured point (mean over teeth)
    rank: int | None = None  # directions to correct; None: by the noise
    rounded: bool = True  # steps on the dials' increments
    increments: Mapping[str, float] = field(default_factory=dict[str, float])
    bounds: Mapping[str, tuple[float, float]] = field(
        default_factory=dict[str, tuple[float, float]]
    )
    on_machine: Mapping[str, float] = field(default_factory=dict[str, float])  # steps taken before
    # Deviations (rows, columns) mm of the part that so many earlier measurements predict: they still count.
    earlier: Mapping[Side, Array] = field(default_factory=dict[Side, Array])
    measurements: int = 0
    weights: Mapping[Side, Array] = field(default_factory=dict[Side, Array])
    target: Mapping[Side, Array] = field(default_factory=dict[Side, Array])  # (n,) mm, 0 by default


@dataclass(frozen=True, eq=False)
class Correction:
    """Steps for one setup, and the deviations they leave (mm; maps (rows, columns), NaN where not measured)."""

    setup: Setup
    free: tuple[str, ...]
    steps: Mapping[str, float]  # to dial now; mm, rad or plain
    exact: Mapping[str, float]  # before rounding to increments
    total: Mapping[str, float]  # from the design's settings: those taken before and these
    target: Mapping[Side, Array]  # deviation from the nominal that is wanted
    before: Mapping[Side, Array]  # deviation from the target
    predicted: Mapping[Side, Array]  # of the flank that the steps cut, exactly; part turned to fit
    uncertainty: Mapping[
        Side, Array
    ]  # standard deviation of the predicted map from measuring noise
    directions: Directions
    rank: int
    kept: Array  # (k,) bool, directions corrected along
    null: tuple[NullDirection, ...]
    converged: bool
    at_bounds: tuple[str, ...]

    @property
    def deviations_after(self) -> dict[Side, Array]:
        """Predicted deviations from the nominal flank, (rows, columns) mm."""
        return {side: left + self.target[side] for side, left in self.predicted.items()}

    @property
    def rms_before(self) -> float:
        return rms(self.before.values())

    @property
    def rms_predicted(self) -> float:
        return rms(self.predicted.values())


def rms(maps: Any) -> float:
    """Root mean square (mm) over maps, of what is there."""
    values = np.concatenate([np.asarray(m).ravel() for m in maps])
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if values.size else float("nan")


@dataclass(frozen=True, eq=False)
class _Problem:
    """One setup's least squares over the points that are there."""

    response: Response
    sides: tuple[Side, ...]
    there: Array  # (m,) indices into both flanks' points, one after the other
    root: Array  # (m,) square roots of weights
    taken_out: Array  # (m, m)
    turns: Array  # (m, t) columns of the part's turns, weighted
    asked: Array  # (m,) weighted deviation from the target
    base: Array  # (m,) where the flank stands as it is cut now
    on_machine: Mapping[str, float]

    def at(self, steps: Mapping[str, float]) -> Array:
        """(m,) weighted deviation after steps, exactly; NaN where it cannot be cut."""
        moved = self.response.cut(added(self.on_machine, steps))
        off = np.concatenate([moved[side] for side in self.sides])[self.there]
        return self.asked + self.root * (off - self.base)


def correction(
    response: Response,
    deviations: Mapping[Side, Array],
    wish: Wish | None = None,
    thickness: float | None = None,
) -> Correction:
    """Correction of one setup from deviations (n,) or (rows, columns), mm, along nominal normals.

    ``thickness`` (mm, measured less nominal, along the arc about the axis) counts where one setup cuts both
    flanks; there None means that it is as it should be.

    Raises
    ------
    DesignError
        For adjustments that there are not, and too few points to decide anything.
    """
    how, setup = wish or Wish(), response.setup
    if how.earlier:
        how = replace(how, noise=how.noise / math.sqrt(1.0 + how.measurements))
    names = chosen(setup, how.free)
    problem = _problem(response, deviations, how, thickness)
    jacobian = problem.root[:, None] * response.sensitivity(names)[problem.there]
    limits = _limits(setup, names, how)
    steps, found, kept, converged, held = _gauss_newton(problem, names, jacobian, limits, how)
    exact = dict(zip(names, steps, strict=True))
    if how.rounded:
        grain = [how.increments.get(n, setup.adjustments[n].increment) for n in names]
        now = [setup.adjustments[n].value + how.on_machine.get(n, 0.0) for n in names]
        effect = problem.taken_out @ jacobian
        reach = np.array([setup.adjustments[n].reach for n in names])
        steps = on_increments(steps, np.array(grain), np.array(now), effect, limits, reach)
        total = added(how.on_machine, dict(zip(names, steps, strict=True)))
        for name, step in setup.on_gears(total).items():
            if name in names:
                steps[names.index(name)] = step - how.on_machine.get(name, 0.0)
    final = {n: float(s) if abs(s) > TINY else 0.0 for n, s in zip(names, steps, strict=True)}
    left = problem.at(final)
    shape = (response.grid.rows, response.grid.columns)

    def maps(values: Array) -> dict[Side, Array]:
        every = np.full(len(setup.sides) * shape[0] * shape[1], np.nan)
        every[problem.there] = values
        parts = np.split(every, len(setup.sides))
        return {s: p.reshape(shape) for s, p in zip(setup.sides, parts, strict=True)}

    spread = np.sqrt(_variance(found, kept, problem)) * how.noise
    return Correction(
        setup,
        names,
        final,
        {n: float(s) for n, s in exact.items()},
        added(how.on_machine, final),
        {s: np.broadcast_to(how.target.get(s, 0.0), shape) for s in setup.sides},
        maps(problem.taken_out @ problem.asked / problem.root),
        maps(problem.taken_out @ left / problem.root),
        maps(spread / problem.root),
        found,
        int(kept.sum()),
        kept,
        null_directions(found, setup, len(problem.there)),
        converged,
        held,
    )


def _problem(
    response: Response, deviations: Mapping[Side, Array], how: Wish, thickness: float | None
) -> _Problem:
    sides = response.setup.sides
    values: list[Array] = []
    weights: list[Array] = []
    levers: list[Array] = []
    together = len(sides) == 2
    for side in sides:
        nodes = response.nodes(side)
        missing = np.full(nodes.lever.size, np.nan)
        value = np.asarray(deviations.get(side, missing), float).ravel()
        value = value - np.asarray(how.target.get(side, 0.0), float).ravel()
        if together and side == "convex" and thickness:
            value = value + nodes.lever * thickness / nodes.radius
        if side in how.earlier:
            before = np.asarray(how.earlier[side] - how.target.get(side, 0.0), float).ravel()
            known, n = np.isfinite(before), how.measurements
            value = np.where(known, (value + n * before) / (1.0 + n), value)
        values.append(np.where(nodes.there, value, np.nan))
        weights.append(np.broadcast_to(how.weights.get(side, 1.0), nodes.shape).ravel())
        levers.append(nodes.lever)
    d, w = np.concatenate(values), np.concatenate(weights).astype(float)
    there = np.flatnonzero(np.isfinite(d) & (w > 0.0))
    least = 6
    if len(there) < least:
        given = f"{len(there)} points of the {response.setup.name}"
        raise DesignError([Problem("measured", given, f"at least {least}", "a grid of 5 x 9")])
    of = np.repeat(np.arange(len(sides)), [v.size for v in values])
    lever = np.concatenate(levers)
    both = [lever] if together else [np.where(of == k, lever, 0.0) for k in range(len(sides))]
    root = np.sqrt(w[there])
    turns = root[:, None] * np.stack(both, axis=1)[there]
    now = response.cut(how.on_machine)
    base = np.concatenate([now[side] for side in sides])[there]
    return _Problem(
        response, sides, there, root, without(turns), turns, root * d[there], base, how.on_machine
    )


def _limits(setup: Setup, names: Sequence[str], how: Wish) -> Array:
    """Least and greatest step (names, 2) by the dials' ends and the given bounds of readings."""
    rows: list[tuple[float, float]] = []
    for name in names:
        dial = setup.adjustments[name]
        now = dial.value + how.on_machine.get(name, 0.0)
        low, high = how.bounds.get(name, (dial.low, dial.high))
        rows.append((max(low, dial.low) - now, min(high, dial.high) - now))
    return np.array(rows)


def _gauss_newton(
    problem: _Problem, names: tuple[str, ...], jacobian: Array, limits: Array, how: Wish
) -> tuple[Array, Directions, Array, bool, tuple[str, ...]]:
    """Steps (names,) to where what can be decided is gone, directions, those kept, and who stands at a bound."""
    setup = problem.response.setup
    reach = np.array([setup.adjustments[n].reach for n in names])
    held = np.zeros(len(names), dtype=bool)
    full = directions(names, reach, jacobian, problem.taken_out, how.noise)
    total, kept, converged = np.zeros(len(names)), np.zeros(0, dtype=bool), False
    for _ in range(len(names) + 1):
        free = ~held
        if not free.any():
            break
        found = directions(
            [n for n, f in zip(names, free, strict=True) if f],
            reach[free],
            jacobian[:, free],
            problem.taken_out,
            how.noise,
        )
        start = np.where(held, total, 0.0)
        total, kept, converged = _descend(problem, names, found, free, start, how)
        outside = free & ((total < limits[:, 0]) | (total > limits[:, 1]))
        if not outside.any():
            full = found if not held.any() else full
            break
        total = np.clip(total, limits[:, 0], limits[:, 1])
        held |= outside
    mask = kept if kept.size == full.values.size else _padded(kept, full.values.size)
    return total, full, mask, converged, tuple(n for n, h in zip(names, held, strict=True) if h)


def _descend(
    problem: _Problem,
    names: tuple[str, ...],
    found: Directions,
    free: Array,
    start: Array,
    how: Wish,
) -> tuple[Array, Array, bool]:
    """Gauss-Newton along the kept directions from steps (names,) that can be cut."""
    total = start.copy()
    left = problem.taken_out @ problem.at(dict(zip(names, total, strict=True)))
    kept = found.kept(left, how.rank)
    for _ in range(ROUNDS):
        if np.sqrt(((found.left.T @ left)[kept] ** 2).sum() / len(left)) < CONVERGED:
            return total, kept, True
        step = found.step(left, kept)
        for shorter in (1.0, 0.5, 0.25, 0.125):  # where the flank cannot be cut
            tried = total.copy()
            tried[free] += shorter * step
            after = _tried(problem, names, tried)
            if after is not None:
                total, left = tried, problem.taken_out @ after
                break
        else:
            return total, kept, False
    return total, kept, False


def _tried(problem: _Problem, names: tuple[str, ...], steps: Array) -> Array | None:
    try:
        after = problem.at(dict(zip(names, steps, strict=True)))
    except DesignError:  # beyond a dial's travel: bounds are seen to afterwards
        return None
    return after if np.isfinite(after).all() else None


def _variance(found: Directions, kept: Array, problem: _Problem) -> Array:
    """(m,) variance of the predicted deviations for unit noise: kept directions and the part's turn."""
    q, _ = np.linalg.qr(problem.turns)
    return (found.left[:, kept] ** 2).sum(axis=1) + (q**2).sum(axis=1)


def _padded(kept: Array, size: int) -> Array:
    return np.concatenate([kept, np.zeros(size - len(kept), dtype=bool)])


def added(first: Mapping[str, float], second: Mapping[str, float]) -> dict[str, float]:
    """Steps one after the other."""
    return {n: first.get(n, 0.0) + second.get(n, 0.0) for n in {**first, **second}}
