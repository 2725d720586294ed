"""Options that commands share, and options that carry a unit."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from hypoid.geometry import DesignError, Problem
from hypoid.io import Kind, QuantityError, parse

DesignPath = Annotated[Path, Parameter(help="The design file (TOML).")]
AsJson = Annotated[
    bool, Parameter(name="--json", negative=(), help="Write the result as JSON to standard output.")
]
Output = Annotated[Path, Parameter(name=["--output", "-o"], help="The file to write.")]


def quantities(given: Mapping[str, tuple[str, Kind]]) -> dict[str, float]:
    """Values of options in mm and rad, by option; one error for all that cannot be read."""
    values: dict[str, float] = {}
    problems: list[Problem] = []
    for option, (text, kind) in given.items():
        try:
            values[option] = parse(text, kind)
        except QuantityError as error:
            problems.append(
                Problem(option, error.given, error.expected, f'{option} "{error.example}"')
            )
    if problems:
        raise DesignError(problems)
    return values
