"""What a designer asks of a face-milled pair: its blank, how each member is cut, and its contact."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from hypoid.blank import BlankRequest
from hypoid.geometry import Problem

from ._pinion_limits import BLADES_APART, BLADES_TOGETHER, PinionLimits
from ._spec import Assumption
from ._target import EaseOffTarget, Target

WheelMethod = Literal["formate", "generated"]
PinionMethod = Literal[
    "tilt", "modified-roll", "generated", "fixed-setting", "helical", "universal", "completing",
    "duplex-helical",
]  # fmt: skip
TOGETHER: tuple[PinionMethod, ...] = (
    "completing",
    "duplex-helical",
)  # one setting cuts both flanks


@dataclass(frozen=True)
class MilledRequest:
    """A face-milled pair from its blank; mm and rad.

    The wheel is cut by spread blades, the pinion side by side or, with the methods of ``TOGETHER``, by
    spread blades, too. ``tolerance`` is the greatest distance that a pinion flank may keep from the target
    ease-off.
    """

    title: str
    source: str
    assumed: tuple[Assumption, ...]
    blank: BlankRequest
    wheel_method: WheelMethod = "formate"
    pinion_method: PinionMethod = "tilt"
    drive: Target = field(default_factory=EaseOffTarget)
    coast: Target = field(default_factory=EaseOffTarget)
    tolerance: float = 0.005
    wheel_edge_radius: float | None = None  # None: what AGMA 929 leaves, up to 0.3 modules
    pinion_edge_radius: float | None = None
    limits: PinionLimits = field(default_factory=PinionLimits)
    normal_backlash: float = 0.15
    marking_thickness: float = 0.00635

    def problems(self) -> list[Problem]:
        """What makes no sense beside the blank's numbers."""
        found = [*self.drive.problems("contact.drive"), *self.coast.problems("contact.coast")]
        together = self.pinion_method in TOGETHER
        found += self.limits.problems(BLADES_TOGETHER if together else BLADES_APART)
        if self.blank.blade_groups:
            given = f"{self.blank.blade_groups}"
            expected = "0: face milling cuts slot by slot"
            found.append(Problem("cutting.blade_groups", given, expected, "blade_groups = 0"))
        if not self.tolerance > 0.0:
            given, expected = f"{1e3 * self.tolerance:g} um", "a length above 0"
            found.append(Problem("contact.tolerance", given, expected, 'tolerance = "5 um"'))
        return found
