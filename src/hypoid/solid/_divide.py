"""Dividing a pitch until its triangles are as near to the exact surfaces as asked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import ceil
from typing import Any

import numpy as np

from hypoid.flank import SIDES, Side, Tooth
from hypoid.geometry import DesignError, Problem

from ._body import Body
from ._cell import Cell, cell
from ._chords import Chords, chords
from ._division import Division, doubled_grid, evened, spread, spread_rows
from ._joints import Joints, joints_of
from ._request import tooth_problems
from ._topology import cartesian

Array = np.ndarray[Any, Any]
ROUNDS = 9
MARGIN = 0.92  # share of the chord error that a division aims at
WASTEFUL = 0.6  # a division that errs by less than this share is made anew
SETTLED = 3  # rounds after which it no longer is, and after which the aim is lowered
LOWERED = 0.75
LEAST_COLUMNS, LEAST_ROWS, LEAST_ACROSS = 6, 6, 2
MOST = 400_000  # quadrangles along a pitch's profile


@dataclass(frozen=True, eq=False)
class Divided:
    """A cell, and what its patches were seen to err by (mm)."""

    cell: Cell
    seen: Mapping[str, Chords]

    @cached_property
    def flank_error(self) -> float:
        """Greatest distance of a triangle of the flanks from its surface, mm."""
        return float(self.seen["teeth"].error[:, _on_flanks(self.cell.division)].max())

    @cached_property
    def across_error(self) -> float:
        """The same of all other surfaces, which the segments around the axis decide."""
        teeth = self.seen["teeth"].error[:, ~_on_flanks(self.cell.division)]
        others = (c.error for name, c in self.seen.items() if name != "teeth")
        return max(float(e.max()) for e in (teeth, *others))

    @property
    def error(self) -> float:
        return max(self.flank_error, self.across_error)


def divided(tooth: Tooth, ring: Body, chord_error: float, name: str) -> Divided:
    """The cell of a tooth whose triangles stand off the exact surfaces by less than a chord error, mm."""
    grid = tooth.grid(33, 33)
    joints: dict[Side, Joints] = {side: joints_of(tooth.flank(side), grid) for side in SIDES}
    division = _first_division(tooth, joints)
    best: Divided | None = None
    reached = np.inf
    for turn in range(ROUNDS):
        grid = doubled_grid(tooth, joints, division, grid)
        problems = tooth_problems(grid, tooth.pitch, ring, name)
        if problems:
            raise DesignError(problems)
        made = cell(tooth, grid, division, ring)
        now = Divided(made, {n: chords(cartesian(p)) for n, p in made.patches.items()})
        if turn and now.error <= chord_error:
            best = now
            wasteful = min(now.flank_error, now.across_error) < WASTEFUL * chord_error
            if not wasteful or turn >= SETTLED:
                break
        reached = min(reached, now.error)
        goal = MARGIN * chord_error * LOWERED ** max(0, turn - SETTLED)
        division = _next_division(now, joints, goal)
        if division.columns * (2 * division.height_rows + division.bottom + division.land) > MOST:
            break
    if best is None:
        given = f"{chord_error * 1e3:g} um, finer than a mesh can follow the {name}'s tooth"
        example = f'"{np.ceil(2e3 * reached):g} um"'
        raise DesignError([Problem("chord_error", given, "a greater length", example)])
    return best


def _first_division(tooth: Tooth, joints: Mapping[Side, Joints]) -> Division:
    distance = np.linspace(tooth.concave.toe, tooth.concave.heel, 2 * LEAST_COLUMNS + 1)
    parts: dict[Side, int] = {side: joints[side].parts for side in SIDES}
    places: dict[Side, Array] = {
        side: np.linspace(0.0, parts[side], 4 * parts[side] + 1) for side in SIDES
    }
    weight: dict[Side, Array] = {side: np.full(4 * parts[side], 0.5) for side in SIDES}
    rows = spread_rows(places, weight, parts, 2 * LEAST_ROWS)
    return Division(distance, rows, 2 * LEAST_ACROSS, 2 * LEAST_ACROSS)


def _next_division(now: Divided, joints: Mapping[Side, Joints], goal: float) -> Division:
    """The division that would err by the goal, mm, by what was seen of the last one."""
    division, teeth, bore = now.cell.division, now.seen["teeth"], now.seen["bore"]
    flanks = _on_flanks(division)
    # both directions and the twist between them add up: half of what is left to each
    both = float(teeth.along_p[:, flanks].max() + teeth.along_q[:, flanks].max())
    allowed = 0.5 * goal * min(max(both / now.flank_error, 0.3), 1.5)
    columns = np.sqrt(
        np.maximum(teeth.along_p.max(axis=1), bore.along_p.max(axis=1)[::-1]) / allowed
    )
    first, rows = division.bottom, division.height_rows
    sagitta = np.sqrt(teeth.along_q.max(axis=0) / allowed)
    weight: dict[Side, Array] = {
        "concave": sagitta[first : first + rows],
        "convex": sagitta[: -rows - 1 : -1],
    }
    parts: dict[Side, int] = {side: joints[side].parts for side in SIDES}
    bottom, land = _around(now)
    allowed = goal * min(max(max(bottom, land) / now.across_error, 0.3), 1.0)
    return Division(
        distance=spread(
            division.distance, columns, max(LEAST_COLUMNS, ceil(evened(columns).sum()))
        ),
        rows=spread_rows(division.rows, weight, parts, LEAST_ROWS),
        bottom=max(LEAST_ACROSS, ceil(division.bottom * np.sqrt(bottom / allowed))),
        land=max(LEAST_ACROSS, ceil(division.land * np.sqrt(land / allowed))),
    )


def _around(now: Divided) -> tuple[float, float]:
    """Greatest sagittas around the axis, mm, over the slot's bottom and over the tooth."""
    division, level = now.cell.division, now.cell.level
    bottom, land = division.bottom, division.land
    flanks = 2 * division.height_rows
    over_bottom, over_land = [0.0], [0.0]
    for name, patch in now.seen.items():
        sagitta = patch.along_q.max(axis=0)
        if name.endswith("above"):
            over_land.append(sagitta.max())
            continue
        start = bottom + (flanks // 2 if name == "teeth" else level)
        over_bottom.append(sagitta[:bottom].max())
        over_land.append(sagitta[start : start + land].max())
    return float(max(over_bottom)), float(max(over_land))


def _on_flanks(division: Division) -> Array:
    """Which segments (of the profile) are the flanks'."""
    bottom, rows, land = division.bottom, division.height_rows, division.land
    return np.repeat([False, True, False, True], [bottom, rows, land, rows])
