"""A measured flank as a flank: the nominal one and a smooth departure, fitted to a grid with its error known.

It answers as any flank does, so contact, sections and exports take it in place of the nominal one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.flank import Border, Departure, Flank, Side
from hypoid.geometry import DesignError, Problem
from hypoid.pair import GearPair

from ._grid import FlankNodes, MeasuringGrid

Array = np.ndarray[Any, Any]
ORDERS = range(1, 8)  # of the polynomial, in both directions together
SPARE = 1.5  # points a coefficient needs


@dataclass(frozen=True, eq=False)
class MeasuredFlank:
    """A flank with a smooth departure fitted to measured deviations; errors in mm along the normal.

    ``left_out`` is what each point is missed by when it takes no part in the fit: the error to expect in between.
    """

    flank: Flank
    order: int
    residual: float  # rms at the points
    left_out: float  # rms
    standard_error: Array  # (rows, columns) of the smooth map, from the scatter about it


def measured_flank(nodes: FlankNodes, deviation: Array, order: int | None = None) -> MeasuredFlank:
    """The flank of deviations (rows, columns), mm along nominal normals; NaN takes no part.

    ``order`` is the polynomial's, in S and H together; None: that which misses left-out points least.

    Raises
    ------
    DesignError
        For fewer than six points.
    """
    value = np.asarray(deviation, float).ravel()
    there = np.flatnonzero(np.isfinite(value) & nodes.there)
    if len(there) < 6:
        given = f"{len(there)} points of the {nodes.flank.name} flank"
        raise DesignError([Problem("measured", given, "at least 6", "a grid of 5 x 9 points")])
    point, normal = (v[there] for v in nodes.own)
    distance, height, added = _angles(nodes, point + value[there, None] * normal)
    toe, heel = nodes.distance[0, 0], nodes.distance[0, -1]
    low, high = (_line(nodes.distance[0], nodes.height[k]) for k in (0, -1))
    x = (2.0 * distance - toe - heel) / (heel - toe)
    bottom, top = low.at(distance), high.at(distance)
    y = (2.0 * height - bottom - top) / (top - bottom)
    lever = np.abs(nodes.lever[there])
    best = min(
        (_fit(x, y, added, lever, p) for p in _choices(nodes, len(there), order)),
        key=lambda f: f.left_out,
    )  # fmt: skip
    departure = Departure(best.powers, toe, heel, low, high, nodes.flank.cone)
    surface = replace(nodes.flank.surface, departure=departure)
    error = np.full(value.size, np.nan)
    error[there] = best.error
    flank = replace(nodes.flank, surface=surface)
    return MeasuredFlank(
        flank, best.order, best.residual, best.left_out, error.reshape(nodes.shape)
    )


def pair_as_measured(
    pair: GearPair, grid: MeasuringGrid, deviations: Mapping[Side, Array]
) -> tuple[GearPair, dict[Side, MeasuredFlank]]:
    """The pair with a member's flanks as deviations (rows, columns), mm, have them; nominal where none are."""
    made: dict[Side, MeasuredFlank] = {
        side: measured_flank(grid.flanks[side], value) for side, value in deviations.items()
    }
    name = grid.member.name
    flanks: dict[str, Any] = {side: one.flank for side, one in made.items()}
    return replace(pair, **{name: replace(getattr(pair, name), **flanks)}), made


@dataclass(frozen=True)
class _Fit:
    order: int
    powers: Array
    residual: float
    left_out: float
    error: Array


Powers = list[tuple[int, int]]


def _choices(nodes: FlankNodes, points: int, order: int | None) -> list[Powers]:
    """Powers of polynomials by total order, two below the grid's own counts in either direction."""
    most_y, most_x = max(1, nodes.shape[0] - 2), max(1, nodes.shape[1] - 2)
    choices = [
        [(i, j) for i in range(n + 1) for j in range(n + 1 - i) if i <= most_x and j <= most_y]
        for n in ([order] if order else ORDERS)
    ]
    return [p for p in choices if order or SPARE * len(p) <= points] or choices[:1]


def _fit(x: Array, y: Array, added: Array, lever: Array, powers: Powers) -> _Fit:
    """Polynomial through angles, weighted as normal distances; left-out errors by the hat matrix."""
    order = max(i + j for i, j in powers)
    terms = np.stack([x**i * y**j for i, j in powers], axis=1) * lever[:, None]
    q, _ = np.linalg.qr(terms)
    fit, *_ = np.linalg.lstsq(terms, added * lever, rcond=None)
    left = added * lever - terms @ fit
    hat = (q**2).sum(axis=1)
    free = max(1, len(x) - len(powers))
    spread = np.sqrt(float(left @ left) / free)
    table = np.zeros((ORDERS.stop, ORDERS.stop))  # one shape: compiled once
    for (i, j), c in zip(powers, fit, strict=True):
        table[i, j] = c
    out = left / np.maximum(1.0 - hat, 1e-6)
    return _Fit(
        order,
        table,
        float(np.sqrt(np.mean(left**2))),
        float(np.sqrt(np.mean(out**2))),
        spread * np.sqrt(hat),
    )


def _angles(nodes: FlankNodes, point: Array) -> tuple[Array, Array, Array]:
    """(S, H) of measured points (own place, left hand) and the angle by which they stand past the nominal there."""
    flank, radius = nodes.flank, np.hypot(point[:, 0], point[:, 1])
    distance, height = flank.cone.cone_distance_height(point[:, 2], radius)
    off = np.arctan2(point[:, 1], point[:, 0]) - flank.left_angle(distance, height)
    return distance, height, np.angle(np.exp(1j * off))


def _line(distance: Array, height: Array) -> Border:
    slope = (height[-1] - height[0]) / (distance[-1] - distance[0])
    return Border(float(height[0] - slope * distance[0]), float(slope))
