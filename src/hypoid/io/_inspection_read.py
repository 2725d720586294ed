"""Measured files in: any layout, or JSON; every fault with its line, nothing guessed in silence."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hypoid.flank import SIDES, Side
from hypoid.geometry import DesignError, Problem
from hypoid.inspect import Measured, MeasuredSide, MeasuringGrid

from ._inspection_layout import LENGTHS, Layout, read_layout
from ._inspection_write import ordered

Array = np.ndarray[Any, Any]
Place = tuple[int, Side, int, int]  # tooth, side, row, column
MANY = 20  # faults are told, then the reading ends
MISSING = ("", "nan", "na", "-", "null", "****")
POINT = re.compile(r"([A-Za-z]{1,2})(\d{1,2})")
COMMAS = re.compile(r"-?\d+,\d+")
NUMERIC = frozenset({"x", "y", "z", "nx", "ny", "nz", "deviation"})


@dataclass
class _Collected:
    """What has been read so far."""

    problems: list[Problem] = field(default_factory=list[Problem])
    facts: dict[str, str] = field(default_factory=dict[str, str])
    rows: dict[tuple[int, Side], Array] = field(default_factory=dict[tuple[int, Side], Array])


def read_inspection(
    path: str | Path, grid: MeasuringGrid, layout: str | Layout | None = None
) -> Measured:
    """A measurement over a grid from a file; the layout is the one that the file names, else ``hypoid``.

    Raises
    ------
    DesignError
        With every line that cannot be read (twenty at most), and what does not belong to this grid.
    """
    where = Path(path)
    try:
        with where.open(encoding="utf-8-sig", errors="replace") as file:
            if where.suffix == ".json":
                return _from_json(json.load(file), grid, str(where))
            return _from_lines(file, grid, layout, str(where))
    except OSError as error:
        given = f"a file that cannot be read ({error.strerror})"
        raise DesignError(
            [Problem(str(where), given, "a file of measured points", "-m measured.csv")]
        ) from None
    except json.JSONDecodeError as error:
        given = f"no JSON ({error.msg}, line {error.lineno})"
        raise DesignError(
            [Problem(str(where), given, "JSON as --nominal OUT.json writes it", "{...}")]
        ) from None


def _from_lines(
    lines: Iterator[str] | Any, grid: MeasuringGrid, layout: str | Layout | None, path: str
) -> Measured:
    found = _Collected()
    how = layout if isinstance(layout, Layout) else read_layout(layout) if layout else None
    order: list[tuple[int, int]] = []
    blocks: list[tuple[int, Side]] = []
    count = 0
    for number, line in enumerate(lines, start=1):
        text = line.strip()
        mark = how.comment if how else "#"
        if not text:
            continue
        if mark and text.startswith(mark):
            key, _, value = text[len(mark) :].partition(":")
            found.facts[key.strip()] = value.strip()
            continue
        if how is None:
            how = _named_layout(found.facts)
        if not order:
            order = list(ordered(grid.rows, grid.columns, how))
            blocks = _blocks(found.facts, grid)
            if how.heading and _is_heading(text, how):
                continue
        _one(text, number, _here(count, order, blocks), grid, how, found, path)
        count += 1
        if len(found.problems) >= MANY:
            break
    found.problems += _facts_faults(found.facts, grid, path)
    if found.problems:
        raise DesignError(found.problems)
    return _measured(found, grid, how or Layout("", ()))


def _blocks(facts: Mapping[str, str], grid: MeasuringGrid) -> list[tuple[int, Side]]:
    """Teeth and flanks in the order of a file that does not number them: as it says, or every one."""
    sides: list[Side] = [s for s in SIDES if s in facts.get("flanks", ", ".join(SIDES))]
    numbers = [int(n) for n in re.findall(r"\d+", facts.get("measured_teeth", ""))]
    return [(t, s) for t in numbers or range(1, grid.member.teeth + 1) for s in sides]


def _here(count: int, order: list[tuple[int, int]], blocks: list[tuple[int, Side]]) -> Place | None:
    """Tooth, side, row and column of a line by its number alone."""
    block, line = divmod(count, len(order))
    return (*blocks[block], *order[line]) if block < len(blocks) else None


def _named_layout(facts: Mapping[str, str]) -> Layout:
    name = facts.get("layout", "hypoid")
    return read_layout(name)


def _is_heading(text: str, layout: Layout) -> bool:
    cells = _cells(text, layout)
    return not any(re.search(r"\d", c) for c in cells if c not in layout.columns) and len(cells) > 1


def _cells(text: str, layout: Layout) -> list[str]:
    if not layout.delimiter:
        return text.split()
    return [c.strip().strip('"') for c in text.split(layout.delimiter)]


def _one(
    text: str,
    number: int,
    here: Place | None,
    grid: MeasuringGrid,
    layout: Layout,
    found: _Collected,
    path: str,
) -> None:
    where = f"{path}, line {number}"
    cells = _cells(text, layout)
    if len(cells) != len(layout.columns):
        given = f"{len(cells)} values: {text[:60]!r}"
        expected = f"{len(layout.columns)} values: {', '.join(layout.columns)}"
        if layout.delimiter == "," and layout.decimal == "." and len(cells) > len(layout.columns):
            expected += (
                ' (decimal commas? they need a layout with decimal = "," and another delimiter)'
            )
        found.problems.append(Problem(where, given, expected, "--layout points"))
        return
    by = dict(zip(layout.columns, cells, strict=True))
    values = np.full(7, np.nan)
    for k, name in enumerate(("x", "y", "z", "nx", "ny", "nz", "deviation")):
        if name in by:
            value = _number(by[name], layout)
            if value is None:
                commas = bool(COMMAS.fullmatch(by[name]))
                more = ' (a decimal comma: say decimal = "," in the layout)' if commas else ""
                found.problems.append(
                    Problem(where, f"{name} = {by[name]!r}", f"a number{more}", "12.345")
                )
                return
            values[k] = value
    place = _place(by, here, grid, layout)
    if isinstance(place, str):
        found.problems.append(Problem(where, text[:60], place, "a line of --nominal"))
        return
    tooth, side, index = place
    table = found.rows.setdefault((tooth, side), np.full((grid.rows * grid.columns, 7), np.nan))
    if np.isfinite(table[index]).any():
        name = grid.flanks[side].name(*divmod(index, grid.columns))
        found.problems.append(
            Problem(
                where,
                f"point {name} of tooth {tooth} a second time",
                "each point once",
                "tooth = 2",
            )
        )
        return
    table[index] = values


def _number(text: str, layout: Layout) -> float | None:
    if text.lower() in MISSING:
        return float("nan")
    if layout.decimal == ",":
        text = text.replace(".", "x").replace(",", ".")
    try:
        value = float(text)
    except ValueError:
        return None
    return value if np.isfinite(value) else None


def _place(
    by: Mapping[str, str],
    here: Place | None,
    grid: MeasuringGrid,
    layout: Layout,
) -> tuple[int, Side, int] | str:
    """Tooth, side and index of a line, or what is wrong with them."""
    if here is None:
        if not {"side", "tooth"} <= set(by) or not (
            {"point"} <= set(by) or {"row", "column"} <= set(by)
        ):
            return "no more lines than the grid has points, on the flanks and teeth that the file names"
        here = 1, "concave", 0, 0
    tooth, side, row, column = here
    if "side" in by:
        sides: dict[str, Side] = {layout.sides[s].lower(): s for s in SIDES}
        if by["side"].lower() not in sides:
            return f"a side, {' or '.join(sides)}, not {by['side']!r}"
        side = sides[by["side"].lower()]
    if "tooth" in by:
        if not by["tooth"].isdigit() or not 1 <= int(by["tooth"]) <= grid.member.teeth:
            return f"a tooth from 1 to {grid.member.teeth}, not {by['tooth']!r}"
        tooth = int(by["tooth"])
    if "point" in by and "row" not in by:
        named = POINT.fullmatch(by["point"])
        if named is None:
            return f"a point's name such as E3, not {by['point']!r}"
        column = -1
        for letter in named[1].upper():
            column = (column + 1) * 26 + ord(letter) - 65
        row = int(named[2]) - 1
    if "row" in by or "column" in by:
        turned = {
            "row": layout.rows == "tip-to-root",
            "column": layout.columns_order == "heel-to-toe",
        }
        for key, most in (("row", grid.rows), ("column", grid.columns)):
            if key in by:
                if not by[key].lstrip("-").isdigit():
                    return f"a whole number as {key}, not {by[key]!r}"
                k = int(by[key]) - layout.first
                k = most - 1 - k if turned[key] else k
                row, column = (k, column) if key == "row" else (row, k)
    if not (0 <= row < grid.rows and 0 <= column < grid.columns):
        return f"a point of this grid of {grid.rows} rows and {grid.columns} columns"
    return tooth, side, row * grid.columns + column


def _facts_faults(facts: Mapping[str, str], grid: MeasuringGrid, path: str) -> list[Problem]:
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


def _measured(found: _Collected, grid: MeasuringGrid, layout: Layout) -> Measured:
    places, sign = layout.turn
    turn = np.array([1.0, sign, sign])
    out = 1.0 if layout.normals == "out-of-tooth" else -1.0
    dev = (1.0 if layout.deviation_sign == "material" else -1.0) * LENGTHS[layout.deviation_unit]
    sides: dict[Side, MeasuredSide] = {}
    for side in SIDES:
        teeth = tuple(sorted(t for t, s in found.rows if s == side))
        if not teeth:
            continue
        values = np.array([found.rows[t, side] for t in teeth])
        if "x" in layout.columns:
            position = values[..., list(places)] * turn * LENGTHS[layout.length]
            normal = None
            if "nx" in layout.columns:
                normal = values[..., [3 + k for k in places]] * turn * out
            sides[side] = MeasuredSide(teeth, position=position, normal=normal)
        else:
            sides[side] = MeasuredSide(teeth, deviation=values[..., 6] * dev)
    given = found.facts.get("thickness_deviation_mm")
    return Measured(grid.member.name, sides, None if given is None else float(given))


def _from_json(given: Any, grid: MeasuringGrid, path: str) -> Measured:
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
    problems += _facts_faults({k: str(v) for k, v in given.items()}, grid, path)
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
