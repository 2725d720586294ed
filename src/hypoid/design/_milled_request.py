"""What a designer asks of a face-milled pair: its blank, how each member is cut, and its contact."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import degrees
from typing import Literal

from hypoid.blank import BlankRequest
from hypoid.geometry import Problem

from ._spec import Assumption
from ._target import EaseOffTarget, Target

WheelMethod = Literal["formate", "generated"]
PinionMethod = Literal[
    "tilt", "modified-roll", "generated", "fixed-setting", "helical", "universal", "completing",
    "duplex-helical",
]  # fmt: skip
FREE = (
    "tilt_angle", "swivel_angle", "helical_motion", "blade_curvature",
    *(f"modified_roll_{order}" for order in range(2, 7)),
    *(
        f"{axis}_{order}"
        for axis in (
            "radial_distance", "tilt_angle", "swivel_angle", "blank_offset", "machine_root_angle",
            "machine_center_to_back",
        )
        for order in (1, 2)
    ),
)  # fmt: skip
TOGETHER: tuple[PinionMethod, ...] = (
    "completing",
    "duplex-helical",
)  # one setting cuts both flanks


@dataclass(frozen=True)
class PinionLimits:
    """Which settings of the pinion a fit may move, and how far; sheet's signs, mm and rad.

    ``free`` adds to what the method moves, ``fixed`` takes away and gives the value, ``ranges`` bound;
    ``machine`` is a cradle machine whose dials bound the settings.
    """

    machine: str = ""
    free: tuple[str, ...] = ()
    fixed: Mapping[str, float] = field(default_factory=dict[str, float])
    ranges: Mapping[str, tuple[float, float]] = field(
        default_factory=dict[str, tuple[float, float]]
    )

    def problems(self) -> list[Problem]:
        """What contradicts itself."""
        found: list[Problem] = []
        for name in self.free:
            if name in self.fixed:
                expected = f"free or fixed: pinion.fixed gives {name} a value"
                found.append(Problem("pinion.free", f'"{name}"', expected, f"# {name}"))
        for name, (low, high) in self.ranges.items():
            if low > high:
                given = f"{_worded(name, low)} to {_worded(name, high)}"
                expected = "the least first, then the greatest"
                example = f"[{_worded(name, high)!r}, {_worded(name, low)!r}]".replace("'", '"')
                found.append(
                    Problem(f"pinion.range.{name}", given, expected, f"{name} = {example}")
                )
            elif name in self.fixed and not low <= self.fixed[name] <= high:
                ends = f"{_worded(name, low)} to {_worded(name, high)}"
                expected = f"a value within pinion.range, {ends}, or no such range"
                given = _worded(name, self.fixed[name])
                example = f'{name} = "{_worded(name, low)}"'
                found.append(Problem(f"pinion.fixed.{name}", given, expected, example))
        return found


def _worded(name: str, value: float) -> str:
    """A setting's value with its unit."""
    if name.endswith("angle"):
        return f"{degrees(value):.6g} deg"
    unit = {"ratio_of_roll": "", "helical_motion": " mm/rad"}.get(name, " mm")
    return f"{value:.6g}{unit}"


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
        found += self.limits.problems()
        if self.blank.blade_groups:
            given = f"{self.blank.blade_groups}"
            expected = "0: face milling cuts slot by slot"
            found.append(Problem("cutting.blade_groups", given, expected, "blade_groups = 0"))
        if not self.tolerance > 0.0:
            given, expected = f"{1e3 * self.tolerance:g} um", "a length above 0"
            found.append(Problem("contact.tolerance", given, expected, 'tolerance = "5 um"'))
        return found
