"""A design file with corrected settings: the user's own text, comments and all, with new values at its keys."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import tomlkit

from hypoid.flank import SIDES
from hypoid.geometry import DesignError, Problem
from hypoid.inspect import Correction
from hypoid.machine import MACHINES

ROLLED = {"ratio_of_roll": "ratio_gears", "helical_motion": "helical_gears"}


def corrected_design(path: str | Path, corrections: Sequence[Correction]) -> str:
    """The text of a design file with corrected settings; a dial stands where it stood, new ones at flank or member.

    Raises
    ------
    DesignError
        Where the machine cannot be set so, or is not the file's own.
    """
    document = tomlkit.parse(Path(path).read_text(encoding="utf-8"))
    for found in corrections:
        setup = found.setup
        member: Any = document[setup.member.name]
        own = _machine(member, setup.sides[0])
        if own != setup.machine:
            expected = f"dials of {own}, on which the file has the {setup.name}"
            raise DesignError([Problem("--output", setup.machine, expected, f"--machine {own}")])
        dials = setup.dials_after(found.total)
        moved = [n for n in found.total if found.total[n] and not n.startswith(SIDES)]
        for key in dict.fromkeys(
            ROLLED.get(n, n) if setup.machine != "basic" else n.split(".")[0] for n in moved
        ):
            text = _written(setup.machine, key, getattr(dials, key))
            one = len(setup.sides) == 1
            for side in setup.sides if one or _apart(member, key) else ("",):
                _set(_table(member, side, "settings"), key, text)
        _blades(member, found)
    return tomlkit.dumps(document)


def _blades(member: Any, found: Correction) -> None:
    """Blade angles and point diameters; those of a spread-blade head as its diameter and point width."""
    setup, moved = found.setup, {n: s for n, s in found.total.items() if s and n.startswith(SIDES)}
    after = {n: setup.adjustments[n].value + s for n, s in moved.items()}
    for name, value in after.items():
        side, key = name.split(".")
        if key == "blade_angle":
            _set(_table(member, side, "blade"), "angle", _quantity(value, "angle"))
        elif key == "blade_radius":
            _set(_table(member, side, "blade"), key, _quantity(value, "length"))
        elif "point_width" not in member.get("cutter", {}):
            _set(_table(member, side, "blade"), "point_diameter", _quantity(2.0 * value, "length"))
    if "point_width" in member.get("cutter", {}) and any(n.endswith("point_radius") for n in after):
        radii = [f"{s}.point_radius" for s in SIDES]
        outer, inner = (after.get(n, setup.adjustments[n].value) for n in radii)
        _set(_table(member, "", "cutter"), "diameter", _quantity(outer + inner, "length"))
        _set(_table(member, "", "cutter"), "point_width", _quantity(outer - inner, "length"))


def _machine(member: Any, side: str) -> str:
    """The machine that a file has a flank on."""
    for table in (member.get(side, {}).get("settings", {}), member.get("settings", {})):
        if "machine" in table:
            return str(table["machine"])
    return "basic"


def _apart(member: Any, key: str) -> bool:
    """Whether the file gives a dial at the flanks, not at their member."""
    return any(key in member.get(side, {}).get("settings", {}) for side in ("concave", "convex"))


def _table(member: Any, side: str, name: str) -> Any:
    at = member
    if side:
        at = at.setdefault(side, tomlkit.table(is_super_table=True))
    return at.setdefault(name, tomlkit.table())


def _set(table: Any, key: str, value: Any) -> None:
    """Put a value at its key, keeping the comment that stands behind it."""
    old = table.get(key)
    item = tomlkit.item(value)
    comment = getattr(getattr(old, "trivia", None), "comment", "")
    if comment:
        item.comment(comment.lstrip("# "))
    table[key] = item


def _written(machine: str, key: str, value: Any) -> Any:
    if isinstance(value, tuple | list):
        return list(value)
    if machine == "basic":
        if key.endswith("angle"):
            return _quantity(value, "angle")
        if key == "helical_motion":
            return f"{value:.10g} mm/rad"
        return float(f"{value:.12g}") if key == "ratio_of_roll" else _quantity(value, "length")
    return _quantity(value, MACHINES[machine].table[key].kind)


def _quantity(value: float, kind: str) -> Any:
    """A quantity as an engineer writes it: whole minutes as such, else decimals."""
    if kind == "length":
        return f"{value:.9g} mm"
    if kind != "angle":
        return value
    minutes = math.degrees(abs(value)) * 60.0
    if abs(minutes - round(minutes)) < 1e-7:
        whole, rest = divmod(round(minutes), 60)
        sign = "-" if value < 0.0 and minutes else ""
        return f"{sign}{whole} deg" + (f" {rest} min" if rest else "")
    return f"{math.degrees(value):.12g} deg"
