"""Nominal grids and measurements as JSON, both ways: facts, and points by side and tooth; NaN is null."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from hypoid.flank import SIDES, Side
from hypoid.geometry import DesignError, Problem
from hypoid.inspect import Measured, MeasuredSide, MeasuringGrid

from ._inspection_facts import facts, facts_faults
from ._inspection_layout import Layout
from ._inspection_write import values_of

Array = np.ndarray[Any, Any]


def inspection_json(grid: MeasuringGrid, measured: Measured | None = None) -> str:
    """The same as JSON: facts, and points by side and tooth; NaN is null."""
    layout = Layout("json", ("x", "y", "z"))
    sides: dict[str, Any] = {}
    for side, teeth, position, normal, deviation in values_of(grid, measured):
        by_points = measured is None or measured.sides[side].position is not None
        sides[side] = {
            "teeth": list(teeth),
            **({"position_mm": _plain(position), "normal": _plain(normal)} if by_points else {}),
            **({"deviation_um": _plain(deviation * 1e3)} if not by_points else {}),
        }
    shape: Mapping[str, Any] = {"row_count": grid.rows, "column_count": grid.columns}
    more = {}
    if measured is not None and measured.thickness is not None:
        more["thickness_deviation_mm"] = measured.thickness
    return json.dumps({**facts(grid, layout), **shape, **more, "flanks": sides}, indent=1) + "\n"


def _plain(values: Array) -> Any:
    if values.ndim > 1:
        return [_plain(v) for v in values]
    return [float(f"{v:.10g}") if np.isfinite(v) else None for v in values]


def measured_of_json(given: Any, grid: MeasuringGrid, path: str) -> Measured:
    size = grid.rows * grid.columns
    problems: list[Problem] = []
    if not isinstance(given, dict) or not isinstance(given.get("flanks"), dict):
        raise DesignError(
            [
                Problem(
                    path,
                    "no flanks",
                    "JSON as --nominal OUT.json writes it",
                    '{"flanks": {"concave": {...}}}',
                )
            ]
        )
    problems += facts_faults({k: str(v) for k, v in given.items()}, grid, path)
    sides: dict[Side, MeasuredSide] = {}
    for side, one in given["flanks"].items():
        where = f"{path}: flanks.{side}"
        if side not in SIDES:
            problems.append(Problem(where, side, "concave or convex", "concave"))
            continue
        try:
            teeth = tuple(int(t) for t in one.get("teeth", [1]))
            arrays = {
                key: np.array(one[name], dtype=float).reshape(len(teeth), size, *more)
                for key, name, more in (
                    ("position", "position_mm", (3,)),
                    ("normal", "normal", (3,)),
                    ("deviation", "deviation_um", ()),
                )
                if name in one
            }
        except (AttributeError, TypeError, ValueError) as error:
            expected = f"position_mm or deviation_um of {size} points a tooth"
            problems.append(
                Problem(where, f"values that do not fit ({error})", expected, "position_mm")
            )
            continue
        if "deviation" in arrays:
            arrays = {"deviation": arrays["deviation"] * 1e-3}
        if not arrays:
            problems.append(
                Problem(where, "no values", "position_mm or deviation_um", "position_mm")
            )
        sides[side] = MeasuredSide(teeth, **arrays)
    if problems:
        raise DesignError(problems)
    thickness = given.get("thickness_deviation_mm")
    return Measured(grid.member.name, sides, None if thickness is None else float(thickness))
