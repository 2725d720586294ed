"""What to dial after a correction: steps and new readings, and change gears where a roll asks for them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from hypoid.design import machine_named

from ._correct import Correction
from ._setup import ROLLS, Adjustment, Setup, moved_sheet
from ._solve import shown_reading, shown_step


@dataclass(frozen=True)
class Reading:
    """One adjustment: step to dial now and reading after all steps; mm, rad or a plain number."""

    adjustment: Adjustment
    step: float
    value: float

    @property
    def words(self) -> tuple[str, str]:
        """Step and reading as a person writes them."""
        return shown_step(self.adjustment, self.step), shown_reading(self.adjustment, self.value)


def readings(found: Correction) -> tuple[Reading, ...]:
    """Readings of what is stepped now or was before."""
    own, steps = found.setup.adjustments, found.steps
    return tuple(
        Reading(own[n], steps.get(n, 0.0), own[n].value + found.total.get(n, 0.0))
        for n in {**found.total, **steps}
    )


def dials_after(setup: Setup, total: Mapping[str, float]) -> Any:
    """The machine's dials after all steps (its own dataclass, or a sheet); gears are the nearest there are.

    Raises
    ------
    DesignError
        Where the machine cannot be set so.
    """
    if setup.machine == "basic":
        own = {n: s for n, s in total.items() if n.split(".")[0] not in setup.sides}
        return moved_sheet(setup.dials, own)
    own = {n: s for n, s in total.items() if "." not in n and n not in ROLLS}
    dials = replace(setup.dials, **{n: getattr(setup.dials, n) + s for n, s in own.items()})
    wanted = [gears for n, gears in ROLLS.items() if total.get(n)]
    if not wanted:
        return dials
    new = machine_named(setup.machine).from_basic(setup.settings(total), setup.work)
    return replace(dials, **{gears: getattr(new, gears) for gears in wanted})


def gears_after(found: Correction) -> dict[str, tuple[int, ...]]:
    """Change gears that the new rolls ask for, the nearest there are, by the dial's name."""
    if found.setup.machine == "basic" or not any(found.total.get(n) for n in ROLLS):
        return {}
    dials = dials_after(found.setup, found.total)
    return {gears: tuple(getattr(dials, gears)) for n, gears in ROLLS.items() if found.total.get(n)}
