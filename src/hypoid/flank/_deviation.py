"""How one flank differs from another: along the normal, with the part turned to meet at the mean point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._flank import Flank

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Deviation:
    """Deviation of a flank from a nominal one over a grid, toe to heel and root to tip."""

    distance: Array  # (rows, columns) S, mm
    height: Array  # (rows, columns) H, mm
    normal: Array  # (rows, columns) mm, positive where the flank stands out of the nominal one
    turn: float  # rad that the part was turned by, to meet the nominal at the mean point

    @property
    def largest(self) -> float:
        """Greatest deviation either way, mm; NaN if there is none to see."""
        there = self.normal[np.isfinite(self.normal)]
        return float(np.abs(there).max()) if there.size else float("nan")


def deviation(nominal: Flank, flank: Flank, rows: int = 5, columns: int = 9) -> Deviation:
    """Deviation of ``flank`` from ``nominal`` over the active flank, NaN where either is missing."""
    distance = np.linspace(nominal.toe, nominal.heel, columns)
    low = np.asarray(nominal.charts["flank"].bounds(distance)[0])
    high = np.minimum(
        nominal.tip.at(distance), np.asarray(nominal.charts["flank"].bounds(distance)[1])
    )
    share = np.linspace(0.02, 0.98, rows)
    height = low + np.outer(share, high - low)
    places = np.broadcast_to(distance, height.shape).ravel(), height.ravel()
    middle = 0.5 * (nominal.toe + nominal.heel)
    turn = float((_angle(flank, [middle], [0.0]) - _angle(nominal, [middle], [0.0]))[0])
    points = nominal.at_cone(*places)
    apart = _angle(flank, *places) - _angle(nominal, *places) - turn
    apart = np.remainder(apart + np.pi, 2.0 * np.pi) - np.pi
    x, y, _ = points.position.T
    lever = x * points.normal[:, 1] - y * points.normal[:, 0]
    return Deviation(
        np.broadcast_to(distance, height.shape),
        height,
        (apart * lever).reshape(height.shape),
        turn,
    )


def _angle(flank: Flank, distance: Any, height: Any) -> Array:
    position = flank.at_cone(distance, height).position
    return np.arctan2(position[:, 1], position[:, 0])
