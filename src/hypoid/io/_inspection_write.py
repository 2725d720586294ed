"""Nominal grids and measurements as text in any layout, and as JSON, with all that a reader must know."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from hypoid.flank import SIDES, Side
from hypoid.inspect import Measured, MeasuringGrid

from ._inspection_layout import LENGTHS, Layout

Array = np.ndarray[Any, Any]
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


def inspection_text(grid: MeasuringGrid, layout: Layout, measured: Measured | None = None) -> str:
    """A grid's nominal points, or a measurement over it, as text in a layout."""
    teeth = sorted({t for s in measured.sides.values() for t in s.teeth}) if measured else [1]
    told = facts(grid, layout) | {
        "flanks": ", ".join(s for s in SIDES if measured is None or s in measured.sides),
        "measured_teeth": ", ".join(str(t) for t in teeth),
    }
    lines = [f"{layout.comment} {key}: {value}" for key, value in told.items()]
    if measured is not None and measured.thickness is not None:
        lines.append(f"{layout.comment} thickness_deviation_mm: {measured.thickness:.6f}")
    between = layout.delimiter or " "
    if layout.heading:
        lines.append(between.join(layout.columns))
    lines += [between.join(cells) for cells in _lines(grid, layout, measured)]
    return "\n".join(lines) + "\n"


def _lines(grid: MeasuringGrid, layout: Layout, measured: Measured | None) -> Iterator[list[str]]:
    places, sign = layout.turn
    unit = 1.0 / LENGTHS[layout.length]
    out = 1.0 if layout.normals == "out-of-tooth" else -1.0
    dev = (1.0 if layout.deviation_sign == "material" else -1.0) / LENGTHS[layout.deviation_unit]
    values = list(_values(grid, measured))
    blocks = sorted((tooth, n, t) for n, v in enumerate(values) for t, tooth in enumerate(v[1]))
    for tooth, n, t in blocks:  # tooth after tooth, its concave flank first
        side, _, position, normal, deviation = values[n]
        nodes = grid.flanks[side]
        for row, column in ordered(grid.rows, grid.columns, layout):
            k = row * grid.columns + column
            cells = {
                "tooth": str(tooth),
                "side": layout.sides[side],
                "row": str(_number(row, grid.rows, layout.rows == "tip-to-root", layout)),
                "column": str(
                    _number(column, grid.columns, layout.columns_order == "heel-to-toe", layout)
                ),
                "point": nodes.name(row, column),
                "-": "0",
            }
            p = _to_file(position[t, k], places, sign) * unit
            n = _to_file(normal[t, k], places, sign) * out
            cells |= {a: _shown(v, layout.digits, layout) for a, v in zip("xyz", p, strict=True)}
            cells |= {
                f"n{a}": _shown(v, layout.digits + 2, layout) for a, v in zip("xyz", n, strict=True)
            }
            cells["deviation"] = _shown(deviation[t, k] * dev, layout.digits, layout)
            yield [cells[c] for c in layout.columns]


def _values(
    grid: MeasuringGrid, measured: Measured | None
) -> Iterator[tuple[Side, tuple[int, ...], Array, Array, Array]]:
    for side in SIDES:
        nodes = grid.flanks[side]
        position, normal = nodes.position[None], nodes.normal[None]
        nothing = np.full((1, nodes.lever.size), np.nan)
        if measured is None:
            yield side, (1,), position, normal, np.where(nodes.there, 0.0, np.nan)[None]
        elif side in measured.sides:
            one = measured.sides[side]
            shape = (len(one.teeth), *position.shape[1:])
            points = np.broadcast_to(position, shape) if one.position is None else one.position
            normals = np.broadcast_to(normal, shape) if one.normal is None else one.normal
            empty = np.broadcast_to(nothing, shape[:2])
            yield (
                side,
                one.teeth,
                points,
                normals,
                empty if one.deviation is None else one.deviation,
            )


def ordered(rows: int, columns: int, layout: Layout) -> Iterator[tuple[int, int]]:
    """Rows (from the root) and columns (from the toe) in the order of a layout's lines."""
    along = range(columns) if layout.columns_order == "toe-to-heel" else range(columns)[::-1]
    up = range(rows) if layout.rows == "root-to-tip" else range(rows)[::-1]
    if layout.sequence == "rows":
        yield from ((r, c) for r in up for c in along)
    else:
        yield from ((r, c) for c in along for r in up)


def _number(index: int, count: int, turned: bool, layout: Layout) -> int:
    return (count - 1 - index if turned else index) + layout.first


def _to_file(vector: Array, places: tuple[int, int, int], sign: float) -> Array:
    """A vector of the member's frame in the file's axes: right-handed either way."""
    made = np.zeros(3)
    made[list(places)] = vector * np.array([1.0, sign, sign])
    return made


def _shown(value: float, digits: int, layout: Layout) -> str:
    if not np.isfinite(value):
        return "nan"
    text = f"{value + 0.0:.{digits}f}"
    if float(text) == 0.0:
        text = text.lstrip("-")
    return text.replace(".", layout.decimal)


def inspection_json(grid: MeasuringGrid, measured: Measured | None = None) -> str:
    """The same as JSON: facts, and points by side and tooth; NaN is null."""
    layout = Layout("json", ("x", "y", "z"))
    sides: dict[str, Any] = {}
    for side, teeth, position, normal, deviation in _values(grid, measured):
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
