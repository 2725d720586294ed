"""`hypoid check`."""

from __future__ import annotations

from dataclasses import asdict
from typing import Literal

from ._options import AsJson, DesignPath
from ._output import report_faults, say, write_json

DIRECTIONS: tuple[Literal["drive", "coast"], ...] = ("drive", "coast")


def check(file: DesignPath, /, *, json: AsJson = False) -> int:
    """Whether a design is sound, what it assumes, and every fault of blank, flanks and contact."""
    from hypoid import read
    from hypoid.contact import faults, tip_interference, unloaded_contact

    pair = read(file)
    named = [*pair.faults]
    for direction in DIRECTIONS:
        result = unloaded_contact(pair, direction)
        named += faults(result, tip_interference(result))
    if json:
        assumed = [asdict(assumption) for assumption in pair.assumed]
        write_json({"title": pair.title, "assumed": assumed, "faults": named})
    else:
        for assumption in pair.assumed:
            print(f"Assumed {assumption.value}: {assumption.reason}")
    if not named:
        say(f"{file}: no fault found.")
    return report_faults(named)
