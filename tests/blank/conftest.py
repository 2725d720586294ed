from __future__ import annotations

from math import pi, radians
from typing import Any

import pytest

from hypoid.blank import PairBlank, pair_blank

TABLE_1: dict[str, Any] = {
    "z1": 6,
    "z2": 73,
    "shaft_angle": pi / 2,
    "offset": 55.0,
    "wheel_mean_radius": 130.0,
    "wheel_face_width": 35.0,
    "pinion_spiral_angle": radians(65.0),
    "cutter_radius": 100.0,
    "blade_groups": 5,
    "mean_addendum_factor": 0.5,
    "depth_factor": 1.75,
    "clearance_factor": 0.125,
    "pinion_hand": "left",
    "pressure_angle": radians(20.0),
}


@pytest.fixture(scope="session")
def table_1() -> dict[str, Any]:
    """Table 1 of Gonzalez-Perez & Fuentes-Aznar 2022, as `pair_blank` takes it."""
    return dict(TABLE_1)


@pytest.fixture(scope="session")
def paper() -> PairBlank:
    """The blank of the 2022 paper."""
    return pair_blank(**TABLE_1)
