"""What each pinion method may move, and in which stages a fit goes from the conjugate start to it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from hypoid.blank import PairBlank

from ._pinion_model import Wish
from ._settings_model import ANGLES, INDEX, MOTIONS, ROLL

BASE = (
    "radial_distance", "blank_offset", "machine_root_angle", "machine_center_to_back",
    "sliding_base", "ratio_of_roll", "point_radius", "blade_angle",
)  # fmt: skip
HEAD = ("tilt_angle", "swivel_angle")


@dataclass(frozen=True)
class Freedom:
    """Entries that a method moves, and what holds others in place."""

    free: tuple[str, ...]
    rest: tuple[str, ...] = ()  # led to zero and then kept there
    spreads: Mapping[str, float] = field(default_factory=dict[str, float])  # about zero


METHODS: dict[str, Freedom] = {
    "tilt": Freedom((*BASE, *HEAD)),
    "modified-roll": Freedom((*BASE, *ROLL[:3]), HEAD),
    "generated": Freedom(BASE, HEAD),
    "helical": Freedom((*BASE, *HEAD, "helical_motion", ROLL[0]), (), {"helical_motion": 10.0}),
    "universal": Freedom(
        (*BASE, *HEAD, "helical_motion", *ROLL, *MOTIONS),
        (),
        {"helical_motion": 10.0},
    ),
}


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


def blade_wish(angle: float) -> dict[str, Wish]:
    """Blades near their pressure angle: 3 deg away weighs as 1 um all over the flank."""
    return {"blade_angle": Wish(angle, math.radians(0.5))}
