"""What commands say: JSON and tables on standard output, words and problems on standard error."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from typing import Any

from hypoid.geometry import Problem

DONE, FAULTY, BAD_INPUT = 0, 1, 2
WIDE = 240  # columns: a number cut short is worse than a line too long


def say(words: str) -> None:
    """Words for a person: progress, faults, advice."""
    print(words, file=sys.stderr, flush=True)


def write_json(value: Any) -> None:
    """A result for a program; a number that is none is null."""
    print(json.dumps(_plain(value), indent=2, ensure_ascii=False, allow_nan=False))


def report_problems(problems: Sequence[Problem], as_json: bool) -> None:
    """Everything that is wrong with an input, for a person and, if asked, for a program."""
    for problem in problems:
        say(
            f"{problem.path}\n  given:    {problem.given}\n"
            f"  expected: {problem.expected}\n  example:  {problem.example}"
        )
    count = len(problems)
    say(f"{count} problem{'s' if count > 1 else ''}; nothing was computed.")
    if as_json:
        write_json({"problems": [vars(problem) for problem in problems]})


def report_faults(faults: Iterable[str]) -> int:
    """Exit status of a command that has computed a design with these faults."""
    messages = list(faults)
    for message in messages:
        say(f"Fault: {message}")
    return FAULTY if messages else DONE


def write_table(
    title: str, columns: Sequence[str], rows: Iterable[tuple[str, Sequence[float | int | str]]]
) -> None:
    """A table for a person, one named quantity a row."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    table = Table(title=title, title_justify="left", box=SIMPLE_HEAD, pad_edge=False)
    table.show_header = any(columns)
    table.add_column("", no_wrap=True)
    for column in columns:
        table.add_column(column.replace(" ", "\n"), justify="right", no_wrap=True)
    for name, values in rows:
        table.add_row(name, *(_text(v) for v in values))
    console = Console(file=sys.stdout, highlight=False, markup=False, soft_wrap=True, width=WIDE)
    with console.capture() as text:  # printed by us: rich has its own way with a broken pipe
        console.print(table)
    print(text.get(), end="")


def _text(value: float | int | str) -> str:
    """Six digits; what rounding leaves of nothing (a billionth of a mm or deg) is nothing."""
    if not isinstance(value, float):
        return str(value)
    return f"{0.0 if abs(value) < 1e-9 else value:.6g}"


def write_members(title: str, results: Mapping[str, Mapping[str, Any]]) -> None:
    """A table with a column for each of `results`, which share their keys."""
    keys = list(next(iter(results.values())))
    rows = ((key, [_cell(result[key]) for result in results.values()]) for key in keys)
    write_table(title, list(results), rows)


def _cell(value: Any) -> float | int | str:
    if isinstance(value, list | tuple):
        return "\n".join(f"{x + 0.0:.5g}" for x in value) or "none"
    return value


def _plain(value: Any) -> Any:
    """The value in JSON's own types."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if hasattr(value, "tolist"):  # an array, or an array's number
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value
