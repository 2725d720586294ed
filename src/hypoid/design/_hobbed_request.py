"""What a designer asks of a face-hobbed pair on Tri-Ac heads: its blank, how it is cut, its contact."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import asin, isfinite, radians
from typing import Literal, get_args

from hypoid.blank import BlankRequest
from hypoid.geometry import Problem

from ._milled_request import WheelMethod
from ._pinion_limits import BLADES_HOBBED, PinionLimits
from ._spec import Assumption
from ._target import EaseOffTarget, Target

HobbedMethod = Literal["tilt", "modified-roll", "generated", "helical", "universal"]
NO_HOBBER = "these machines cut slot by slot; pinion.range bounds settings here"
CURVED = "pinion.curve_radius gives the blades their curve"


@dataclass(frozen=True)
class StickGrind:
    """How stick blades stand in a head and are ground, both members' alike; mm and rad."""

    hook_angle: float = radians(4.42)
    side_rake_angle: float = radians(12.0)
    eccentric_angle: float | None = None  # None: the slope angle of the blank's module
    wheel_curve_radius: float = 0.0  # positive crowns the tooth; 0: straight
    pinion_curve_radius: float | None = 0.0  # None: free, either flank its own
    pinion_toprem: tuple[float, float] | None = None  # angle, and length along the flank

    def eccentric(self, module: float, groups: int, radius: float) -> float:
        """The eccentric angle, rad: blades square to the tooth where none is given."""
        if self.eccentric_angle is not None:
            return self.eccentric_angle
        return asin(min(0.5 * groups * module / radius, 0.8))


@dataclass(frozen=True)
class HobbedRequest:
    """A face-hobbed pair from its blank; mm and rad.

    Each member is cut in one setting-up, both flanks at once: settings and head are one, blade radii
    and blade angles are each flank's own. With ``equal_spacing`` the pinion's inner blades stand midway
    between outer ones, and the slot is made by the blade radii; else the spacing makes it.
    """

    title: str
    source: str
    assumed: tuple[Assumption, ...]
    blank: BlankRequest
    wheel_method: WheelMethod = "formate"
    pinion_method: HobbedMethod = "tilt"
    grind: StickGrind = StickGrind()
    equal_spacing: bool = True
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
        found += self.limits.problems(BLADES_HOBBED)
        if self.limits.machine:
            given, expected = f'"{self.limits.machine}"', f"nothing: {NO_HOBBER}"
            found.append(Problem("pinion.machine", given, expected, f"# machine = {given}"))
        if "blade_curvature" in self.limits.free and self.grind.pinion_curve_radius:
            expected = f"no blade_curvature: {CURVED}"
            found.append(Problem("pinion.free", '"blade_curvature"', expected, "# free"))
        methods = get_args(HobbedMethod)
        if self.pinion_method not in methods:
            expected = (
                f"one of {', '.join(methods)}: a face-hob head cuts both flanks in one setting-up"
            )
            given, example = f'"{self.pinion_method}"', 'method = "tilt"'
            found.append(Problem("pinion.method", given, expected, example))
        if self.blank.blade_groups < 1:
            given, expected = f"{self.blank.blade_groups}", "at least 1 blade group"
            found.append(Problem("cutting.blade_groups", given, expected, "blade_groups = 13"))
        if not (self.tolerance > 0.0 and isfinite(self.tolerance)):
            given, expected = f"{1e3 * self.tolerance:g} um", "a length above 0"
            found.append(Problem("contact.tolerance", given, expected, 'tolerance = "5 um"'))
        return found
