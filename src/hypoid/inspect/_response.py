"""How both flanks of a setup answer to steps: exactly, by cutting anew; and to first order, n . dr/dp."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from hypoid.flank import Side

from ._cutting import Cutting, combined, cutting, normal_move, on_lines
from ._grid import FlankNodes, MeasuringGrid, PointGroup, way_of
from ._setup import Setup

Array = np.ndarray[Any, Any]
STEP = 0.05  # of an adjustment's reach, in differences of what turns dials into basic settings
# Weights of differences of the fourth order: central, and from a dial's end of travel.
CENTRAL = {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}
FORWARD = {0: -25 / 12, 1: 4.0, 2: -3.0, 3: 4 / 3, 4: -1 / 4}
BACKWARD = {-k: -w for k, w in FORWARD.items()}


@dataclass(frozen=True, eq=False)
class Response:
    """A setup over a measuring grid, whose nodes are those of the flanks cut at steps ``base`` (none: the nominal)."""

    setup: Setup
    grid: MeasuringGrid
    base: Mapping[str, float] = field(default_factory=dict[str, float])

    def nodes(self, side: Side) -> FlankNodes:
        return self.grid.flanks[side]

    def cut(self, steps: Mapping[str, float]) -> dict[Side, Array]:
        """Where the flanks cut after steps stand off the nominal, (n,) mm along nominal normals, exactly.

        Nothing is turned. NaN where the grid has no point.
        """
        settings = self.setup.settings(steps)
        found: dict[Side, Array] = {}
        for side in self.setup.sides:
            nodes, pieces = self.nodes(side), self.setup.pieces(side, steps)
            value = np.full(nodes.lever.size, np.nan)
            way = way_of(nodes.flank, settings)
            for group in nodes.groups:
                piece = pieces[_name(nodes, group)]
                cut = cutting(settings, piece, nodes.flank.surface, way)
                value[group.index] = _off(nodes, group, cut)
            found[side] = value
        return found

    def sensitivity(self, names: Sequence[str]) -> Array:
        """N . dr/dp (sides x n, names), mm per mm, rad or unit; rows without a point are zero.

        By JAX from basic settings, motions and the edge to the point; from dials and blade measures to these by
        fourth-order differences of their closed forms.
        """
        for name in names:
            if name not in self._columns:
                self._columns[name] = self._column(name)
        return np.stack([self._columns[name] for name in names], axis=1)

    @cached_property
    def _columns(self) -> dict[str, Array]:
        return {}

    def _column(self, name: str) -> Array:
        dial = self.setup.adjustments[name]
        h, start = STEP * dial.reach, self.base.get(name, 0.0)
        now = dial.value + start
        weights = CENTRAL
        if not dial.low <= now - 2.0 * h:
            weights = FORWARD
        elif not now + 2.0 * h <= dial.high:
            weights = BACKWARD
        weights = {k: w / h for k, w in weights.items()}
        where = {k: {**self.base, name: start + k * h} for k in weights}
        settings = {k: self.setup.settings(steps) for k, steps in where.items()}
        parts: list[Array] = []
        for side in self.setup.sides:
            nodes = self.nodes(side)
            value = np.zeros(nodes.lever.size)
            pieces = {k: self.setup.pieces(side, steps) for k, steps in where.items()}
            for group in nodes.groups:
                piece = _name(nodes, group)
                tree = {
                    k: cutting(settings[k], pieces[k][piece], nodes.flank.surface, group.cut.way)
                    for k in where
                }
                by = combined(tree, weights)
                normal = nodes.own[1][group.index]
                s = nodes.points.s[group.index]
                value[group.index] = normal_move(group.cut, by, s, group.theta, group.phi, normal)
            parts.append(value)
        return np.concatenate(parts)


def _name(nodes: FlankNodes, group: PointGroup) -> str:
    return nodes.flank.cut_pieces[int(nodes.points.piece[group.index[0]])]


def _off(nodes: FlankNodes, group: PointGroup, cut: Cutting) -> Array:
    s, turn = nodes.points.s[group.index], nodes.points.theta[group.index]
    point, normal = (v[group.index] for v in nodes.own)
    return on_lines(cut, s, turn, point, normal)


def nominal_distance(nodes: FlankNodes, point: Array) -> Array:
    """Distance (n,), mm, of points (n, 3; own place, left hand) from the nominal flank along its grid's normals.

    Positive where a point stands out of the flank; NaN where there is none.
    """
    value = np.full(nodes.lever.size, np.nan)
    for group in nodes.groups:
        mine = group.index[np.isfinite(point[group.index]).all(axis=1)]
        if len(mine):
            s, turn = nodes.points.s[mine], nodes.points.theta[mine]
            value[mine] = -on_lines(group.cut, s, turn, point[mine], nodes.own[1][mine])
    return value
