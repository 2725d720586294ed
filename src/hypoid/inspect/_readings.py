"""What to dial after a correction: steps and new readings, and change gears where a roll asks for them."""

from __future__ import annotations

from dataclasses import dataclass

from ._correct import Correction
from ._setup import ROLLS, Adjustment
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


def gears_after(found: Correction) -> dict[str, tuple[int, ...]]:
    """Change gears that the new rolls ask for, the nearest there are, by the dial's name."""
    if found.setup.machine == "basic" or not any(found.total.get(n) for n in ROLLS):
        return {}
    dials = found.setup.dials_after(found.total)
    return {gears: tuple(getattr(dials, gears)) for n, gears in ROLLS.items() if found.total.get(n)}
