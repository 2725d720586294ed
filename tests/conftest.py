"""Pairs that many tests look at, built once, and the plain chain they are compared with."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import lru_cache
from math import radians
from pathlib import Path
from typing import Any

import mpmath
import pytest
from hypothesis import settings

from hypoid.design import ExactFaceHobbedSpec, TipRelief, build
from hypoid.flank import Flank
from hypoid.pair import GearPair

sys.path.insert(0, str(Path(__file__).parent))  # `independent` is shared by several rooms' tests

# The same examples at every run: a suite that says yes today says yes tomorrow.
settings.register_profile("house", derandomize=True)
settings.load_profile("house")

TABLE_1 = ExactFaceHobbedSpec(
    title="High-reduction hypoid 6 x 73",
    source="Gonzalez-Perez & Fuentes-Aznar 2022, Table 1",
    assumed=(),
    shaft_angle=radians(90.0),
    offset=55.0,
    pinion_teeth=6,
    wheel_teeth=73,
    pinion_hand="left",
    pinion_spiral_angle=radians(65.0),
    wheel_mean_radius=130.0,
    wheel_face_width=35.0,
    mean_addendum_factor=0.5,
    depth_factor=1.75,
    clearance_factor=0.125,
    cutter_radius=100.0,
    blade_groups=5,
    pressure_angle=radians(20.0),
    tip_edge_radius_factor=0.38,
    tip_relief=None,
    marking_thickness=0.0065,
)
RELIEF = TipRelief(coefficient=0.004, height=1.5, measured_from="tip", flanks="both")
TILTED = {"tilt_angle": radians(0.3), "swivel_angle": radians(-35.0)}
MOVING = {"helical_motion": 0.3, "modified_roll": (0.01, -0.02, 0.03)}
SIDES = ("pinion.concave", "pinion.convex", "wheel.concave", "wheel.convex")
VARIANTS: dict[str, dict[str, Any]] = {
    "plain": {},
    "relief": {"tip_relief": RELIEF},
    "right-hand": {"pinion_hand": "right"},
    "tilted": {"setting_changes": dict.fromkeys(SIDES, TILTED)},
    "moving": {"setting_changes": dict.fromkeys(SIDES, MOVING)},
}


@pytest.fixture(scope="session")
def table_1_spec() -> ExactFaceHobbedSpec:
    """Table 1 of Gonzalez-Perez & Fuentes-Aznar 2022, 20 deg blades, as a design."""
    return TABLE_1


@pytest.fixture(scope="session")
def variant() -> Callable[[str], GearPair]:
    """The paper's pair in one of the ways it can be cut, by name (see `VARIANTS`)."""

    @lru_cache
    def built(name: str) -> GearPair:
        return build(replace(TABLE_1, **VARIANTS[name]))

    return built


@pytest.fixture(scope="session")
def paper_pair(variant: Callable[[str], GearPair]) -> GearPair:
    return variant("plain")


@pytest.fixture(scope="session")
def relief_pair(variant: Callable[[str], GearPair]) -> GearPair:
    """With the relief of the second example: 0.004/mm over 1.5 mm from the tip."""
    return variant("relief")


@pytest.fixture(scope="session")
def flank_of(variant: Callable[[str], GearPair]) -> Callable[[str, str], Flank]:
    """A flank by variant and name ("pinion concave")."""

    def chosen(name: str, flank: str) -> Flank:
        return next(f for f in variant(name).flanks() if f.name == flank)

    return chosen


@pytest.fixture
def forty_digits() -> Iterator[None]:
    with mpmath.workdps(40):
        yield
