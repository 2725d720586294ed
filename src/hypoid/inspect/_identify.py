"""Settings and blade of an unknown gear from its measured points, a tooth count and a rough guess.

The guess is a design with an uncertainty: what the points cannot decide stays where it was guessed, and is told.
Gauss-Newton on the exact flanks, which are cut anew at every step and asked at the measured places themselves.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.flank import Flank, Side
from hypoid.geometry import DesignError, Problem

from ._compare import alignment
from ._correct import added
from ._grid import FlankNodes, MeasuringGrid
from ._measured import Measured
from ._response import Response
from ._robust import robust, smooth_terms
from ._setup import Setup, chosen
from ._solve import NullDirection, directions, null_directions, without
from ._topography import coordinates

Array = np.ndarray[Any, Any]
ROUGH = 15.0  # times an adjustment's reach: standard deviation of a guess (3 mm, 2.25 deg)
ROUNDS = 40
DONE = 1e-2  # of the standard errors: a step this small is none
SHORTER = 8
LEAST = 12  # points


@dataclass(frozen=True, eq=False)
class Identification:
    """Settings found for one setup; steps are from the guess, mm, rad or plain."""

    setup: Setup
    steps: Mapping[str, float]
    standard_error: Mapping[
        str, float
    ]  # of each, the guess's own uncertainty where nothing is decided
    flanks: Mapping[Side, Flank]  # as these settings cut them
    deviation: Mapping[
        Side, Array
    ]  # (t, n) mm, of the measured points from these flanks, turned to fit
    rms: float  # mm
    undecided: tuple[NullDirection, ...]
    converged: bool

    def value(self, name: str) -> float:
        """Reading found, mm, rad or plain."""
        return self.setup.adjustments[name].value + self.steps[name]


def identify(
    grid: MeasuringGrid,
    setup: Setup,
    measured: Measured,
    *,
    free: Sequence[str] = (),
    noise: float = 0.0015,
    rough: float = ROUGH,
) -> Identification:
    """Find the settings (the usual dials, or those named ``free``) that cut measured points (first tooth, mm).

    ``noise`` is a point's standard deviation, ``rough`` that of the guess in units of each adjustment's reach.

    Raises
    ------
    DesignError
        For too few points, deviations instead of points, or a guess whose flank cannot be cut.
    """
    names = chosen(setup, free)
    places = _places(grid, setup, measured)
    reach = np.array([setup.adjustments[n].reach for n in names])
    spread = rough * reach
    at = np.zeros(len(names))
    state = _State.of(grid, setup, places, names, at)
    if state is None:
        given = f"the {setup.name} of the guess"
        raise DesignError(
            [
                Problem(
                    "measured",
                    given,
                    "a guess whose flank passes near the points",
                    "a nearer guess",
                )
            ]
        )
    if _outliers_out(
        state, places, smooth=True
    ):  # off a smooth map, before a bad guess can hide them
        state = _State.of(grid, setup, places, names, at) or state
    converged, swept, covariance = False, False, np.diag(spread**2)
    for _ in range(ROUNDS):
        jacobian = state.taken_out @ state.response.sensitivity(names)[state.there]
        scaled = jacobian * spread / noise
        normal = scaled.T @ scaled + np.eye(len(names))
        covariance = np.linalg.inv(normal) * np.outer(spread, spread)
        # what is measured less what is cut, against the guess's own pull
        step = spread * np.linalg.solve(normal, scaled.T @ (state.left / noise) - at / spread)
        near = np.abs(step) < DONE * np.sqrt(np.diag(covariance))
        if near.all():
            if swept or not _outliers_out(state, places, smooth=False):
                converged = True
                break
            swept = True
            state = _State.of(grid, setup, places, names, at) or state
            continue
        here = state.cost(noise) + float(((at / spread) ** 2).sum())
        tried = None
        for _ in range(SHORTER):
            tried = _State.of(grid, setup, places, names, at + step)
            if tried is not None:
                cost = tried.cost(noise) + float((((at + step) / spread) ** 2).sum())
                if cost < here * (1.0 + 1e-12):
                    break
            tried, step = None, 0.5 * step
        if tried is None:
            break
        at, state = at + step, tried
    found = directions(
        names, spread, state.response.sensitivity(names)[state.there], state.taken_out, noise
    )
    steps = {n: float(s) for n, s in zip(names, at, strict=True)}
    errors = np.sqrt(np.diag(covariance))
    flanks: dict[Side, Flank] = {side: state.nodes[side].flank for side in setup.sides}
    return Identification(
        setup,
        steps,
        {n: float(e) for n, e in zip(names, errors, strict=True)},
        flanks,
        state.maps(),
        float(np.sqrt(np.mean(state.left**2))),
        null_directions(found, setup, len(state.there)),
        converged,
    )


def _outliers_out(state: _State, places: dict[Side, Array], smooth: bool) -> bool:
    """Take points out that lie far off the flanks, or off a smooth map over them; whether there were any."""
    start, any_out = 0, False
    every = np.full(sum(n.lever.size for n in state.nodes.values()), np.nan)
    every[state.there] = state.left
    for side, nodes in state.nodes.items():
        value = every[start : start + nodes.lever.size]
        start += nodes.lever.size
        columns = (nodes.lever / nodes.radius)[:, None]
        if smooth:
            x, y = (c.ravel() for c in coordinates(nodes))
            count = int(np.isfinite(value).sum())
            columns = np.column_stack([columns, smooth_terms(x, y, count)])
        _, out = robust(np.where(np.isfinite(value)[:, None], columns, 0.0), value)
        places[side][out] = np.nan
        any_out |= bool(out.any())
    return any_out


def _places(grid: MeasuringGrid, setup: Setup, measured: Measured) -> dict[Side, Array]:
    """Measured points (n, 3) of each flank, first tooth, in the flank's own place; left hand."""
    problems: list[Problem] = []
    found: dict[Side, Array] = {}
    for side in setup.sides:
        one = measured.sides.get(side)
        if one is None or one.position is None or one.count < LEAST:
            given = (
                "none"
                if one is None
                else "deviations"
                if one.position is None
                else f"{one.count} points"
            )
            problems.append(
                Problem(
                    f"measured: {side}", given, f"coordinates of at least {LEAST} points", "5 x 9"
                )
            )
            continue
        found[side] = grid.flanks[side].taken_back(one.position[0]).copy()
    if problems:
        raise DesignError(problems)
    return found


@dataclass(frozen=True, eq=False)
class _State:
    """Flanks cut at some steps, asked where the points were measured."""

    response: Response
    nodes: Mapping[Side, FlankNodes]
    there: Array
    left: Array  # (m,) mm, measured less cut along the normals, the turn taken out
    taken_out: Array

    @staticmethod
    def of(
        grid: MeasuringGrid,
        setup: Setup,
        places: Mapping[Side, Array],
        names: Sequence[str],
        at: Array,
    ) -> _State | None:
        steps = {n: float(s) for n, s in zip(names, at, strict=True)}
        nodes: dict[Side, FlankNodes] = {}
        off: list[Array] = []
        try:
            for side, points in places.items():
                flank = setup.recut(side, steps)
                radius = np.hypot(points[:, 0], points[:, 1])
                distance, height = flank.cone.cone_distance_height(points[:, 2], radius)
                base = grid.flanks[side]
                nodes[side] = replace(
                    base,
                    flank=flank,
                    distance=distance.reshape(base.shape),
                    height=height.reshape(base.shape),
                    points=flank.at(points[:, 2], radius),
                )
                own = nodes[side].own[0]
                turn = alignment(own, points)
                angle = np.arctan2(points[:, 1], points[:, 0]) - np.arctan2(own[:, 1], own[:, 0])
                near = np.angle(np.exp(1j * (angle - turn))) + turn
                off.append(near * nodes[side].lever)
        except DesignError:  # beyond what the machine can be set to
            return None
        value = np.concatenate(off)
        lever = np.concatenate([n.lever for n in nodes.values()])
        groups = np.concatenate([_grouped(n) for n in nodes.values()])
        there = np.flatnonzero(np.isfinite(value) & groups)
        wanted = sum(int(np.isfinite(p).all(axis=1).sum()) for p in places.values())
        if len(there) < max(LEAST, 0.9 * wanted):
            return None
        taken_out = without(lever[there, None])
        response = Response(setup, replace(grid, flanks={**grid.flanks, **nodes}), added({}, steps))
        return _State(response, nodes, there, taken_out @ value[there], taken_out)

    def cost(self, noise: float) -> float:
        return float((self.left**2).sum()) / noise**2

    def maps(self) -> dict[Side, Array]:
        size = [n.lever.size for n in self.nodes.values()]
        every = np.full(sum(size), np.nan)
        every[self.there] = self.left
        parts = np.split(every, np.cumsum(size)[:-1])
        made: dict[Side, Array] = {}
        for (side, nodes), part in zip(self.nodes.items(), parts, strict=True):
            made[side] = part.reshape(nodes.shape)
        return made


def _grouped(nodes: FlankNodes) -> Array:
    made = np.zeros(nodes.lever.size, dtype=bool)
    for group in nodes.groups:
        made[group.index] = True
    return made
