"""Which settings of a pinion a fit may move, and how far; face milled and face hobbed alike."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import degrees

from hypoid.geometry import Problem

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
SETTINGS = (
    "radial_distance", "tilt_angle", "swivel_angle", "blank_offset", "machine_root_angle",
    "machine_center_to_back", "sliding_base", "ratio_of_roll", "helical_motion", "blade_angle",
)  # fmt: skip
# Where blades stand: what says it, and why, by how a pinion is cut
BLADES_APART = ("point_radius",), "each flank has its own cutter with this method"
BLADES_TOGETHER = ("cutter_radius", "point_width"), "one cutter cuts both flanks"
BLADES_HOBBED = ("blade_radius",), "each flank has its own blades in one head"
Blades = tuple[tuple[str, ...], str]


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

    def problems(self, blades: Blades) -> list[Problem]:
        """What contradicts itself, or names no setting of a pinion whose blades are placed so."""
        found: list[Problem] = []
        for name in self.free:
            if name not in FREE:
                expected = "names among " + ", ".join(FREE)
                found.append(
                    Problem("pinion.free", f'"{name}"', expected, 'free = ["blade_curvature"]')
                )
            if name in self.fixed:
                expected = f"free or fixed: pinion.fixed gives {name} a value"
                found.append(Problem("pinion.free", f'"{name}"', expected, f"# {name}"))
        for table, given in (("fixed", self.fixed), ("range", self.ranges)):
            known = dict.fromkeys((*SETTINGS, *blades[0], *FREE))
            for name in given:
                if name not in known:
                    expected = "names among " + ", ".join(known)
                    path = f"pinion.{table}.{name}"
                    found.append(Problem(path, f'"{name}"', expected, f"# {name}"))
        for name, (low, high) in self.ranges.items():
            if low > high:
                given = f"{worded(name, low)} to {worded(name, high)}"
                expected = "the least first, then the greatest"
                example = f"[{worded(name, high)!r}, {worded(name, low)!r}]".replace("'", '"')
                found.append(
                    Problem(f"pinion.range.{name}", given, expected, f"{name} = {example}")
                )
            elif name in self.fixed and not low <= self.fixed[name] <= high:
                ends = f"{worded(name, low)} to {worded(name, high)}"
                expected = f"a value within pinion.range, {ends}, or no such range"
                given = worded(name, self.fixed[name])
                example = f'{name} = "{worded(name, low)}"'
                found.append(Problem(f"pinion.fixed.{name}", given, expected, example))
        return found


def worded(name: str, value: float) -> str:
    """A setting's value with its unit, as a person writes it; of one flank's own, too."""
    plain = name.rpartition(".")[2]
    if "angle" in plain:
        return f"{degrees(value):.6g} deg"
    if plain == "ratio_of_roll" or plain.startswith("modified_roll"):
        return f"{value:.6g}"
    units = {"helical_motion": "mm/rad", "blade_curvature": "1/mm"}
    return f"{value:.6g} {units.get(plain, 'mm')}"
