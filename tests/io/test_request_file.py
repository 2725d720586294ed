"""Files that ask for a pair by its blank: what they say, and every fault at its own key."""

from __future__ import annotations

import tomllib
from copy import deepcopy
from math import radians
from pathlib import Path
from typing import Any

import pytest
import tomlkit

from hypoid.design import EaseOffTarget, MilledRequest, MotionTarget
from hypoid.geometry import DesignError, Problem
from hypoid.io import json_schema, parse_spec

EXAMPLE = Path(__file__).parents[2] / "examples" / "blanks" / "hypoid-13x42.toml"
FILE: dict[str, Any] = tomllib.loads(EXAMPLE.read_text(encoding="utf-8"))


def changed(**changes: Any) -> dict[str, Any]:
    """The example with keys set by dotted path (a double underscore for the dot); None takes one away."""
    document = deepcopy(FILE)
    for path, value in changes.items():
        *tables, key = path.split("__")
        table = document
        for name in tables:
            table = table.setdefault(name, {})
        if value is None:
            table.pop(key)
        else:
            table[key] = value
    return document


def parsed(**changes: Any) -> MilledRequest:
    spec = parse_spec(tomlkit.dumps(changed(**changes)))
    assert isinstance(spec, MilledRequest)
    return spec


def problems(**changes: Any) -> list[Problem]:
    with pytest.raises(DesignError) as caught:
        parsed(**changes)
    return list(caught.value.problems)


def test_the_example_says_sample_f3() -> None:
    request = parsed()
    blank = request.blank
    assert (blank.method, blank.z1, blank.z2, blank.offset) == (1, 13, 42, 15.0)
    assert blank.spiral_angle == pytest.approx(radians(50.0))
    assert (blank.spiral_of, blank.wheel_outer_diameter) == ("pinion", 170.0)
    assert request.drive == EaseOffTarget(0.015, 0.010)
    assert {a.value for a in request.assumed} >= {"pair.normal_backlash", "pinion.hand"}


def test_a_module_is_a_size_and_a_motion_a_target() -> None:
    request = parsed(
        wheel__outer_pitch_diameter=None,
        wheel__outer_transverse_module="4 mm",
        contact__drive={
            "transmission_error": "54 urad",
            "pattern_length": 0.6,
            "place": [0.1, 0.0],
        },
    )
    assert request.blank.wheel_outer_diameter == pytest.approx(168.0)
    assert isinstance(request.drive, MotionTarget)
    assert request.drive.transmission_error == pytest.approx(54e-6)
    assert request.drive.place == (0.1, 0.0)


@pytest.mark.parametrize(
    ("changes", "path", "words"),
    [
        (
            {"wheel__outer_transverse_module": "4 mm"},
            "wheel.outer_transverse_module",
            "with the teeth",
        ),
        ({"wheel__outer_pitch_diameter": None}, "wheel.outer_pitch_diameter", "one of"),
        ({"wheel__mean_spiral_angle": "35 deg"}, "wheel.mean_spiral_angle", "one of both"),
        ({"pinion__mean_spiral_angle": None}, "pinion.mean_spiral_angle", "of the pinion or"),
        ({"blank__method": 0}, "pair.offset", "method 0"),
        ({"blank__addendum_coefficient": 1.0}, "blank.depth_factor", "one type"),
        ({"blank__wheel_addendum_angle": None}, "blank.wheel_addendum_angle", "both angles"),
        ({"contact__drive__pattern_length": 0.5}, "contact.drive.pattern_length", "or a motion"),
        ({"wheel__teeth": 7}, "wheel.teeth", "as many teeth"),
        ({"pinion__method": "magic"}, "pinion.method", "tilt"),
    ],
)
def test_faults_are_told_at_their_keys(changes: dict[str, Any], path: str, words: str) -> None:
    found = {problem.path: problem for problem in problems(**changes)}
    assert path in found
    assert words in found[path].expected


def test_the_schema_knows_the_third_kind() -> None:
    assert "RequestFile" in json_schema()["$defs"]
