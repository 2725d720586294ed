"""Into how many columns, rows and segments a pitch is divided, and where: by the curvature that is seen.

A chord's sagitta grows with the square of its length, so a direction wants places at equal steps of the
integral of the root of its sagittas.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.flank import SIDES, Side, Tooth, ToothGrid

from ._joints import Joints

Array = np.ndarray[Any, Any]
LEAST = 0.2  # of the mean density of places: the least that a direction keeps anywhere


@dataclass(frozen=True, eq=False)
class Division:
    """Where the mesh of a pitch has its lines."""

    distance: Array  # (columns + 1,) mm
    rows: Mapping[Side, Array]  # (rows + 1,) places along each flank, see Joints.shares
    bottom: int  # segments across the slot's bottom
    land: int  # segments across the top land

    @property
    def columns(self) -> int:
        return len(self.distance) - 1

    @property
    def height_rows(self) -> int:
        return len(self.rows["concave"]) - 1


def doubled(values: Array) -> Array:
    """Values (n,) with their means in between, (2 n - 1,)."""
    both = np.repeat(values, 2)[:-1]
    both[1::2] = 0.5 * (values[:-1] + values[1:])
    return both


def doubled_grid(
    tooth: Tooth, joints: Mapping[Side, Joints], division: Division, last: ToothGrid
) -> ToothGrid:
    """The exact tooth at the division's lines and half-way between them; ``last`` is any grid of it."""
    distance = doubled(division.distance)
    rows: dict[Side, Array] = {
        s: joints[s].shares(doubled(division.rows[s]), distance, last) for s in SIDES
    }
    return tooth.grid(distance, rows, 2 * division.bottom + 1)


def spread(places: Array, weight: Array, count: int) -> Array:
    """Places (count + 1,) from the first to the last, at equal steps of the sum of weights."""
    total = np.concatenate([[0.0], np.cumsum(evened(weight))])
    return np.interp(np.linspace(0.0, total[-1], count + 1), total, places)


def evened(weight: Array) -> Array:
    """Weights (segments) none of which is far below their mean."""
    return np.maximum(weight, LEAST * weight.mean())


def spread_rows(
    places: Mapping[Side, Array],
    weight: Mapping[Side, Array],
    parts: Mapping[Side, int],
    least: int,
) -> dict[Side, Array]:
    """Rows of both flanks, as many on one as on the other, each with a line on every joint."""
    wanted: dict[Side, list[float]] = {}
    for side in SIDES:
        part = _part(places[side])
        wanted[side] = [float(evened(weight[side])[part == k].sum()) for k in range(parts[side])]
    count = max(least, *(sum(int(np.ceil(w)) for w in wanted[side]) for side in SIDES))
    made: dict[Side, Array] = {}
    for side in SIDES:
        part, own = _part(places[side]), evened(weight[side])
        numbers = _apportioned(wanted[side], count)
        runs = [
            spread(np.append(places[side][:-1][part == k], k + 1.0), own[part == k], numbers[k])
            for k in range(parts[side])
        ]
        made[side] = np.concatenate([*(run[:-1] for run in runs), [float(parts[side])]])
    return made


def _part(places: Array) -> Array:
    """Part (segments,) that each segment between places lies in."""
    return (0.5 * (places[1:] + places[:-1])).astype(int)


def _apportioned(wanted: Sequence[float], count: int) -> list[int]:
    """Whole numbers, one a part and no less than wanted, that add up to the count."""
    numbers = [max(1, int(np.ceil(w))) for w in wanted]
    while sum(numbers) < count:
        shortest = int(np.argmax([w / n for w, n in zip(wanted, numbers, strict=True)]))
        numbers[shortest] += 1
    return numbers
