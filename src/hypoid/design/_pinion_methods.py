"""What each pinion method may move, and what a request lets it: free, fixed, and within which bounds."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from hypoid.blank import PairBlank
from hypoid.machine import MACHINES

from ._joint_fit import Entry, Wish, own, shared
from ._pinion_limits import PinionLimits, worded
from ._settings_model import ANGLES, INDEX, MOTIONS, ROLL

BASE = (
    "radial_distance", "blank_offset", "machine_root_angle", "machine_center_to_back",
    "sliding_base", "ratio_of_roll", "point_radius", "blade_angle",
)  # fmt: skip
HEAD = ("tilt_angle", "swivel_angle")
APART = ("blade_angle", "blade_curvature")  # what each blade of one cutter has of its own
CURVE = "blade_curvature"
BEND = 1.0 / 300.0  # 1/mm, about zero: blades of one cutter may be curved
BENT = math.radians(10.0)  # either way, from a curved blade's tips to a whole depth above them
BLADES = math.radians(1.0), math.radians(45.0)  # blade angles that cutters are ground to
LEADING = math.radians(0.02)  # how firmly an angle is led to a value
LED = 0.02  # of a step limit: the same for what is no angle
LEAST_POINT = 0.15  # of the mean normal module: a blade's point must stand
SIDES = ("concave", "convex")


@dataclass(frozen=True)
class Freedom:
    """Entries that a method moves, and what holds others in place."""

    free: tuple[str, ...]
    rest: tuple[str, ...] = ()  # led to zero and then kept there
    spreads: Mapping[str, float] = field(default_factory=dict[str, float])  # about zero
    root_plane: bool = False  # tips held in the blank's root plane
    joint: bool = False  # both flanks by one setting


METHODS: dict[str, Freedom] = {
    "tilt": Freedom((*BASE, *HEAD)),
    "modified-roll": Freedom((*BASE, *ROLL[:3]), HEAD),
    "generated": Freedom(BASE, HEAD),
    "fixed-setting": Freedom((*BASE, *ROLL[:2]), HEAD, root_plane=True),
    "helical": Freedom((*BASE, *HEAD, "helical_motion", ROLL[0]), (), {"helical_motion": 10.0}),
    "universal": Freedom(
        (*BASE, *HEAD, "helical_motion", *ROLL, *MOTIONS), (), {"helical_motion": 10.0}
    ),
    "completing": Freedom((*BASE, *HEAD, CURVE), (), {CURVE: BEND}, joint=True),
    "duplex-helical": Freedom(
        (*BASE, *HEAD, CURVE, "helical_motion", *ROLL[:2]),
        (),
        {"helical_motion": 10.0, CURVE: BEND},
        joint=True,
    ),
}
# What a flank alone is cut with where the method cuts both: a joint fit may start from there.
ALONE = {"completing": "tilt", "duplex-helical": "helical"}


def step_limits(blank: PairBlank, ratio: float) -> dict[str, float]:
    """Greatest change of each entry in one step: about 1 mm on the tooth, or what amounts to it."""
    mean = blank.pinion.mean_cone_distance
    size = 0.012 * mean
    limits: dict[str, float] = {}
    for name in INDEX:
        if name in ANGLES:
            limits[name] = size / mean
        elif name.startswith("modified_roll"):
            limits[name] = 0.02
        elif name == "ratio_of_roll":
            limits[name] = 0.02 * ratio
        elif name == "blade_curvature":
            limits[name] = 0.1 / mean
        else:
            limits[name] = size
    return limits


def blade_wish(angle: float) -> Wish:
    """Blades near their pressure angle: 3 deg away weighs as 1 um all over the flank."""
    return Wish(angle, math.radians(0.5))


Bounds = dict[str, tuple[float, float]]


def machine_bounds(name: str) -> Bounds:
    """Basic settings (chain's signs; mm, rad) within which a cradle machine's dials stay.

    Dials that go round (cradle, swivel) bound nothing; an eccentric bounds the radial distance, a tilted
    head's spindle the tilt.
    """
    machine = MACHINES[name]
    ranges = machine.ranges
    bounds: Bounds = {}
    low, high = ranges["eccentric_angle"]
    reach = 2.0 * machine.constants.eccentric
    bounds["radial_distance"] = reach * math.sin(0.5 * low), reach * math.sin(0.5 * high)
    for dial in ("machine_root_angle", "machine_center_to_back", "sliding_base", "blank_offset"):
        bounds[dial] = ranges[dial]
    if "cutter_spindle_rotation_angle" in ranges:
        low, high = (
            2.0 * math.asin(math.sin(machine.constants.wedge) * math.sin(0.5 * turn))
            for turn in (0.0, math.pi)
        )
        bounds["tilt_angle"] = low, high
    else:
        bounds["tilt_angle"] = 0.0, 0.0
        bounds["helical_motion"] = 0.0, 0.0
    return bounds


def chain_value(name: str, value: float, blank: PairBlank) -> float:
    """A setting of the summary sheet in the chain's signs: offset turned round, back from the crossing point."""
    if name == "blank_offset":
        return -value
    if name == "machine_center_to_back":
        return value + blank.pinion.pitch_apex_beyond_crossing_point
    return value


def sheet_value(name: str, value: float, blank: PairBlank) -> float:
    """A setting of the chain in the signs of the summary sheet."""
    if name == "machine_center_to_back":
        return value - blank.pinion.pitch_apex_beyond_crossing_point
    return chain_value(name, value, blank)


def bounds_of(limits: PinionLimits, blank: PairBlank) -> Bounds:
    """Bounds on entries, chain's signs: what blades can be, and the request's machine's and its own."""
    bounds = machine_bounds(limits.machine) if limits.machine else {}
    depth = blank.pinion.mean_addendum + blank.pinion.mean_dedendum
    bounds |= {"blade_angle": BLADES, CURVE: (-BENT / depth, BENT / depth)}
    for name, ends in limits.ranges.items():
        low, high = sorted(chain_value(name, v, blank) for v in ends)
        least, most = bounds.get(name, (-math.inf, math.inf))
        bounds[name] = max(low, least), min(high, most)
    bounds |= {name: (v, v) for name, v in limits.fixed.items() if name not in INDEX}
    return bounds


def goals(
    method: Freedom,
    fixed: Mapping[str, float],
    bounds: Bounds,
    values: Mapping[str, Sequence[float]],
) -> dict[str, float]:
    """Entries that a fit must be led to: what the method has not, what is fixed, and the nearest bound.

    ``values`` are what flanks have, one each, of every entry that may be led.
    """

    def within(name: str, value: float) -> float:
        low, high = _of(bounds, name)
        return min(max(value, low), high)

    found = {name: within(name, 0.0) for name in method.rest} | dict(fixed)
    for name, has in values.items():
        low, high = _of(bounds, name)
        if name not in found and (min(has) < low or max(has) > high):
            found[name] = within(name, sum(has) / len(has))
    return found


def lead(to: Mapping[str, float], limits: Mapping[str, float]) -> dict[str, Wish]:
    """Wishes that lead entries to values."""
    return {
        name: Wish(value, LEADING if "angle" in name else LED * limits[name])
        for name, value in to.items()
    }


def held_words(
    entries: Iterable[tuple[str, float, float]], held: Iterable[float], blank: PairBlank
) -> tuple[str, ...]:
    """Unknowns (name, low, high) at a bound that would gain by leaving it, in the sheet's signs."""
    words: list[str] = []
    for (name, low, high), sign in zip(entries, held, strict=True):
        if sign:
            upper = (sign > 0.0) != (name == "blank_offset")  # the sheet's sign is the other one
            bound = worded(name, sheet_value(name, high if sign > 0.0 else low, blank))
            words.append(f"{name} stands at its {'upper' if upper else 'lower'} bound, {bound}")
    return tuple(words)


def entries_of(
    names: tuple[str, ...],
    limits: Mapping[str, float],
    bounds: Bounds,
    blank: PairBlank,
    *,
    joint: bool,
    root_plane: bool = False,
) -> tuple[Entry, ...]:
    """The unknowns of a fit: one flank's entries, or what both flanks of a slot share and have apart.

    One cutter cuts both flanks of a slot: its mean radius and its point width make the point radii.
    """
    count = 2 if joint else 1
    found: list[Entry] = []
    for name in names:
        low, high = bounds.get(name, (-math.inf, math.inf))
        limit = limits[name]
        if root_plane and name in ("machine_root_angle", "sliding_base"):
            continue
        if root_plane and name == "machine_center_to_back":
            move = {name: 1.0, "sliding_base": -math.sin(blank.pinion.root_angle)}
            found.append(Entry(name, (move,) * count, limit, low, high, ({name: 1.0},) * count))
        elif joint and name == "point_radius":
            found.append(
                Entry("cutter_radius", ({name: 1.0},) * 2, limit, *_of(bounds, "cutter_radius"))
            )
            low, high = _of(bounds, "point_width")
            low = max(low, LEAST_POINT * blank.mean_normal_module)
            moves = {name: 0.5}, {name: -0.5}
            found.append(Entry("point_width", moves, limit, low, high))
        elif joint and name in APART:
            for n, side in enumerate(SIDES):
                found.append(own(f"{side}.{name}", name, n, count, limit, low, high))
        else:
            found.append(shared(name, count, limit, low, high))
    return tuple(found)


def _of(bounds: Bounds, name: str) -> tuple[float, float]:
    return bounds.get(name, (-math.inf, math.inf))
