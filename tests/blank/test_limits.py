"""Numbers that cannot become a blank: every problem names its path and an example that works."""

from __future__ import annotations

import re
from math import degrees, inf, nan, pi, radians
from typing import Any

import pytest

from hypoid.blank import BlankFault, PitchConeFault, pair_blank, top_land
from hypoid.geometry import DesignError

KEYS = {
    "pair.offset": ("offset", 1.0),
    "pair.shaft_angle": ("shaft_angle", pi / 180),
    "cutting.cutter_radius": ("cutter_radius", 1.0),
    "pinion.mean_spiral_angle": ("pinion_spiral_angle", pi / 180),
    "wheel.face_width": ("wheel_face_width", 1.0),
}


@pytest.mark.parametrize(
    ("change", "path", "expected"),
    [
        ({"offset": 200.0}, "pair.offset", "beyond the wheel"),
        ({"offset": -140.0}, "pair.offset", "beyond the wheel"),
        ({"cutter_radius": 5.0}, "cutting.cutter_radius", "slope angle"),
        ({"blade_groups": 100}, "cutting.cutter_radius", "m_b z0/2"),
        ({"cutter_radius": 20.0}, "cutting.cutter_radius", "reaches from"),
        ({"pinion_spiral_angle": radians(15.0)}, "pinion.mean_spiral_angle", "offset angle"),
        ({"pinion_spiral_angle": radians(88.0)}, "pinion.mean_spiral_angle", "no pitch cones"),
        ({"shaft_angle": radians(120.0)}, "pair.shaft_angle", "internal gear"),
        ({"wheel_face_width": 200.0}, "wheel.face_width", "toe"),
    ],
)
def test_impossible_geometry_names_the_limit_and_an_example_that_works(
    table_1: dict[str, Any], change: dict[str, Any], path: str, expected: str
) -> None:
    with pytest.raises(DesignError) as caught:
        pair_blank(**{**table_1, **change})
    (problem,) = caught.value.problems
    assert problem.path == path
    assert expected in problem.expected
    key, unit = KEYS[path]
    found = re.fullmatch(r'"(-?[\d.]+) (mm|deg)"', problem.example)
    assert found is not None
    pair_blank(**{**table_1, **change, key: float(found.group(1)) * unit})


def test_every_bad_number_is_reported_at_once(table_1: dict[str, Any]) -> None:
    bad: dict[str, Any] = {
        "z1": 0,
        "z2": -73,
        "shaft_angle": radians(180.0),
        "offset": nan,
        "wheel_mean_radius": 0.0,
        "wheel_face_width": inf,
        "pinion_spiral_angle": radians(95.0),
        "cutter_radius": -1.0,
        "blade_groups": 0,
        "mean_addendum_factor": 1.5,
        "depth_factor": 0.0,
        "clearance_factor": -0.1,
        "pinion_hand": "up",
        "pressure_angle": radians(60.0),
    }
    with pytest.raises(DesignError) as caught:
        pair_blank(**bad)
    paths = [problem.path for problem in caught.value.problems]
    assert len(paths) == len(set(paths)) == len(bad)
    given = {problem.path: problem.given for problem in caught.value.problems}
    assert given["pinion.mean_spiral_angle"] == "95 deg"
    assert given["pair.offset"] == "nan"
    assert given["cutting.cutter_radius"] == "-1 mm"


def test_an_offset_pair_may_pass_the_bevel_limit_of_the_shaft_angle(
    table_1: dict[str, Any],
) -> None:
    """Without offset 6/73 is an internal wheel above 94.7 deg; an offset tilts it back."""
    blank = pair_blank(**{**table_1, "shaft_angle": radians(97.0)})
    assert degrees(blank.wheel.pitch_angle) < 90.0


def test_pointed_teeth_are_a_fault_not_an_error(table_1: dict[str, Any]) -> None:
    blank = pair_blank(**{**table_1, "depth_factor": 4.0})
    assert BlankFault.POINTED_PINION in blank.faults
    assert blank.pinion.top_land.least < 0.0


def test_pressure_angle_near_its_limit_is_a_fault(table_1: dict[str, Any]) -> None:
    blank = pair_blank(**{**table_1, "pressure_angle": radians(5.0), "depth_factor": 1.0})
    assert BlankFault.NEAR_LIMIT_PRESSURE_ANGLE in blank.faults


def test_faults_say_what_to_do() -> None:
    assert all("lower" in fault.value or "change" in fault.value for fault in BlankFault)
    assert all(
        any(verb in fault.value for verb in ("lower", "change", "take", "raise"))
        for fault in PitchConeFault
    )


@pytest.mark.parametrize(
    ("thickness", "radius", "pitch_angle", "addendum", "published"),
    [
        (6.2788, 27.459235, 19.7468, 4.83648, 1.83117),
        (3.67226, 76.49373, 70.2532, 1.58937, 2.50681),
    ],
)
def test_agma_929_annex_c_mean_top_land(
    thickness: float, radius: float, pitch_angle: float, addendum: float, published: float
) -> None:
    """AGMA 929-B22, annex C, 14/39: the estimate holds to 1 %."""
    found = top_land(
        thickness,
        pitch_radius=radius,
        pitch_angle=radians(pitch_angle),
        spiral_angle=radians(35.0),
        addendum=addendum,
        pressure_angle=radians(20.0),
    )
    assert found == pytest.approx(published, rel=0.01)
