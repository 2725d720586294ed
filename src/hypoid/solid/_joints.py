"""Lines along which the pieces of a flank meet: a mesh follows them, since curvature, or more, jumps there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from hypoid.flank import Flank, FlankPoints, Side, ToothGrid, first_of

Array = np.ndarray[Any, Any]
NEAR_END = 0.03  # a joint nearer to root or tip than this share of the height is not followed


@dataclass(frozen=True, eq=False)
class Joints:
    """Joint lines of one flank, root to tip: height (mm) by cone distance."""

    side: Side
    lines: tuple[Callable[[Array], Array], ...]

    @property
    def parts(self) -> int:
        return len(self.lines) + 1

    def shares(self, place: Array, distance: Array, grid: ToothGrid) -> Array:
        """Shares (n, rows) of the height at places (rows,), whose whole numbers are joints.

        Above its lowest point a flank rises with the square of the way along it. The grid says where
        the tooth's root and tip are.
        """
        low = np.interp(distance, grid.distance, grid.side(self.side).height[:, 0])
        tip = np.interp(distance, grid.distance, grid.tip)
        lines = [(line(distance) - low) / (tip - low) for line in self.lines]
        joint = np.stack([np.zeros(len(low)), *lines, np.ones(len(low))])
        part = np.minimum(place.astype(int), self.parts - 1)
        way = place - part
        way = np.where(part == 0, way * way, way)
        below, above = joint[part].T, joint[part + 1].T
        return below + (above - below) * way


def joints_of(flank: Flank, grid: ToothGrid) -> Joints:
    """The joints that can be followed from toe to heel, by a coarse grid."""
    low, tip = grid.side(flank.side).height[:, 0], grid.tip
    kept: list[Callable[[Array], Array]] = []
    last = np.zeros(len(low))
    for line in _charted(flank) if flank.generated else _undercut(flank, grid):
        share = (line(grid.distance) - low) / (tip - low)
        if (share > last + NEAR_END).all() and (share < 1.0 - NEAR_END).all():
            kept.append(line)
            last = share
    return Joints(flank.side, tuple(kept))


def _charted(flank: Flank) -> list[Callable[[Array], Array]]:
    charts = [flank.charts[name] for name in reversed(flank.cut_pieces[:-1])]
    return [lambda distance, c=chart: np.asarray(c.bounds(distance)[0]) for chart in charts]


def _undercut(flank: Flank, grid: ToothGrid) -> list[Callable[[Array], Array]]:
    """The edges of an undercut flank: where along each column another piece removes most."""
    profile = grid.side(flank.side)
    changes = np.diff(profile.piece, axis=1) != 0
    counts = changes.sum(axis=1)
    if (counts != counts[0]).any():
        return []
    lines: list[Callable[[Array], Array]] = []
    rows = np.nonzero(changes)[1].reshape(len(counts), -1)
    every = np.arange(len(counts))
    for row in rows.T:
        low, high = profile.height[every, row], profile.height[every, row + 1]
        below = profile.piece[every, row]

        def above(points: FlankPoints, below: Array = below) -> Array:
            return points.piece.reshape(len(below), -1) != below[:, None]

        low, high = first_of(flank, grid.distance, low, high, above)
        lines.append(CubicSpline(grid.distance, 0.5 * (low + high)))
    return lines
