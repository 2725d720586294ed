"""What an inspection file says of itself, and whether that is the grid it is read for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hypoid.flank import SIDES
from hypoid.geometry import Problem
from hypoid.inspect import MeasuringGrid

from ._inspection_layout import Layout

FORMAT = "hypoid inspection 1"


def facts(grid: MeasuringGrid, layout: Layout) -> dict[str, Any]:
    """What a reader must know of a file, by key."""
    blank, free = grid.member.blank, grid.borders
    row, column = grid.reference
    positive = "stands out" if layout.deviation_sign == "material" else "lacks"
    nodes = grid.flanks["concave"]
    return {
        "format": FORMAT,
        "layout": layout.name,
        "member": grid.member.name,
        "hand": blank.hand,
        "teeth": grid.member.teeth,
        "sides": ", ".join(f"{s} = {layout.sides[s]}" for s in SIDES),
        "rows": f"{grid.rows}, {layout.rows}",
        "columns": f"{grid.columns}, {layout.columns_order}",
        "lines": "row after row" if layout.sequence == "rows" else "column after column",
        "borders": f"toe {free.toe:g} %, heel {free.heel:g} % of the face; "
        f"root {free.root:g} %, tip {free.tip:g} % of the depth",
        "reference_point": nodes.name(row, column),
        "axis": f"{layout.axis}, apex to heel; origin at the crossing point",
        "length": layout.length,
        "normals": layout.normals,
        "deviation": f"{layout.deviation_unit}, positive where material {positive}",
        "tooth_thickness_mm": f"{grid.thickness:.6f}",
        "pitch_deg": f"{np.degrees(grid.pitch):.9f}",
    }


def facts_faults(facts: Mapping[str, str], grid: MeasuringGrid, path: str) -> list[Problem]:
    """What the file says of itself against the grid that it is read for."""
    expected = {
        "member": grid.member.name,
        "hand": grid.member.blank.hand,
        "teeth": str(grid.member.teeth),
        "rows": str(grid.rows),
        "columns": str(grid.columns),
    }
    design = "the design file of what was measured"
    options = ("member", "rows", "columns")
    return [
        Problem(
            f"{path}: {key}",
            facts[key],
            f"{value}, as asked for",
            f"--{key} {facts[key].split(',')[0]}" if key in options else design,
        )
        for key, value in expected.items()
        if key in facts and facts[key].split(",")[0].strip() != value
    ]
