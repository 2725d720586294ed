"""Layouts of inspection files: which columns, in which order, units, numbering and signs; named TOML files.

A layout says how a line of text becomes a point, either way. Those of the package stand in ``io/layouts``; a shop puts
its own beside them in the user's folder, or names a file.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from platformdirs import user_config_dir

from hypoid.geometry import DesignError, Problem

COLUMNS = (
    "tooth",
    "side",
    "row",
    "column",
    "point",
    "x",
    "y",
    "z",
    "nx",
    "ny",
    "nz",
    "deviation",
    "-",
)
LENGTHS = {"mm": 1.0, "um": 1e-3, "in": 25.4, "m": 1e3}
AXES = ("x", "y", "z", "-x", "-y", "-z")
CHOICES: dict[str, tuple[str, ...]] = {
    "length": tuple(LENGTHS),
    "deviation_unit": tuple(LENGTHS),
    "axis": AXES,
    "rows": ("root-to-tip", "tip-to-root"),
    "columns_order": ("toe-to-heel", "heel-to-toe"),
    "sequence": ("rows", "columns"),
    "normals": ("out-of-tooth", "into-tooth"),
    "deviation_sign": ("material", "lack"),
    "decimal": (".", ","),
}


@dataclass(frozen=True)
class Layout:
    """How a measuring machine's text file is written; see ``docs/inspection.md`` for each key."""

    name: str
    columns: tuple[str, ...]
    description: str = ""
    comment: str = "#"  # begins lines of words and of "key: value"
    delimiter: str = ","  # "" is any white space
    decimal: str = "."
    heading: bool = True  # a line of column names before the points
    length: str = "mm"
    deviation_unit: str = "um"
    axis: str = "z"  # which of the file's axes is the member's, apex to heel
    rows: str = "root-to-tip"
    columns_order: str = "toe-to-heel"
    sequence: str = "rows"  # order of lines: row after row, or column after column
    first: int = 1  # number of the first row and column
    normals: str = "out-of-tooth"
    deviation_sign: str = "material"  # positive where material stands out, or where it lacks
    sides: dict[str, str] = field(
        default_factory=lambda: {"concave": "concave", "convex": "convex"}
    )
    digits: int = 7  # after the point, of lengths; normals have two more

    @property
    def has_deviation(self) -> bool:
        return "deviation" in self.columns and "x" not in self.columns

    @property
    def turn(self) -> tuple[tuple[int, int, int], float]:
        """Places of the file's coordinates that are the member's x, y, z (a right-handed turn), and the axis' sign."""
        last = "xyz".index(self.axis[-1])
        return ((last + 1) % 3, (last + 2) % 3, last), -1.0 if self.axis[0] == "-" else 1.0


def user_layouts() -> Path:
    """Where a user's own layouts lie: NAME.toml each."""
    return Path(user_config_dir("hypoid", appauthor=False)) / "layouts"


def layouts() -> dict[str, Path]:
    """Layout files by name, the user's own before the package's."""
    own = Path(__file__).parent / "layouts"
    found = {path.stem: path for path in sorted(own.glob("*.toml"))}
    found |= {path.stem: path for path in sorted(user_layouts().glob("*.toml"))}
    return found


def read_layout(name: str) -> Layout:
    """A layout by its name, or by the path of a TOML file.

    Raises
    ------
    DesignError
        With every key that is wrong.
    """
    path = Path(name) if name.endswith(".toml") else layouts().get(name)
    if path is None or not path.is_file():
        known = ", ".join(layouts())
        raise DesignError(
            [Problem("--layout", name, f"one of {known}, or a TOML file", "--layout points")]
        )
    try:
        given = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise DesignError(
            [
                Problem(
                    str(path),
                    f"a file that is no TOML ({error})",
                    "a layout",
                    'columns = ["x", "y", "z"]',
                )
            ]
        ) from None
    found = _faults(given, path)
    if found:
        raise DesignError(found)
    keys: dict[str, Any] = {"name": path.stem, **given, "columns": tuple(given["columns"])}
    return Layout(**keys)


def _faults(given: dict[str, Any], path: Path) -> list[Problem]:
    known = {f.name: f for f in fields(Layout)}
    found: list[Problem] = []
    for key, value in given.items():
        where = f"{path.name}: {key}"
        if key not in known:
            found.append(
                Problem(where, repr(value), f"one of {', '.join(known)}", 'delimiter = ","')
            )
        elif key in CHOICES and value not in CHOICES[key]:
            found.append(
                Problem(
                    where,
                    repr(value),
                    f"one of {', '.join(CHOICES[key])}",
                    f'{key} = "{CHOICES[key][0]}"',
                )
            )
        elif key in ("first", "digits") and not (isinstance(value, int) and 0 <= value <= 15):
            found.append(Problem(where, repr(value), "a whole number from 0 to 15", f"{key} = 1"))
    columns = given.get("columns", ())
    wrong = [c for c in columns if c not in COLUMNS] if isinstance(columns, list) else [columns]
    where = f"{path.name}: columns"
    if wrong or not columns:
        expected = f"names from {', '.join(COLUMNS)}"
        found.append(
            Problem(
                where,
                repr(wrong or columns),
                expected,
                'columns = ["row", "column", "x", "y", "z"]',
            )
        )
    elif not ({"x", "y", "z"} <= set(columns) or "deviation" in columns):
        found.append(
            Problem(where, repr(columns), "x, y and z, or deviation", 'columns = ["x", "y", "z"]')
        )
    sides = given.get("sides", {})
    if sides and (not isinstance(sides, dict) or set(sides) != {"concave", "convex"}):
        found.append(
            Problem(
                f"{path.name}: sides",
                repr(sides),
                "a word for concave and one for convex",
                'sides = {concave = "L", convex = "R"}',
            )
        )
    return found
