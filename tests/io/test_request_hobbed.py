"""Files that ask for a face-hobbed pair by its blank: what they say, and every fault at its own key."""

from __future__ import annotations

import tomllib
from copy import deepcopy
from math import radians
from pathlib import Path
from typing import Any

import pytest
import tomlkit

from hypoid.design import ExactFaceHobbedSpec, HobbedRequest, MotionTarget
from hypoid.geometry import DesignError
from hypoid.io import parse_spec

BLANKS = Path(__file__).parents[2] / "examples" / "blanks"
FILES: dict[str, dict[str, Any]] = {
    name: tomllib.loads((BLANKS / f"{name}.toml").read_text(encoding="utf-8"))
    for name in ("vimercati-piazza-2005", "gonzalez-fuentes-2022", "hypoid-13x42")
}
TRI_AC, EXACT, MILLED = FILES


def parsed(name: str, **changes: Any) -> Any:
    """An example with keys set by dotted path (a double underscore for the dot); None takes one away."""
    document = deepcopy(FILES[name])
    for path, value in changes.items():
        *tables, key = path.split("__")
        table = document
        for part in tables:
            table = table.setdefault(part, {})
        if value is None:
            table.pop(key)
        else:
            table[key] = value
    return parse_spec(tomlkit.dumps(document))


def test_tri_ac_file_is_a_hobbed_request() -> None:
    request = parsed(TRI_AC)
    assert isinstance(request, HobbedRequest)
    assert request.blank.blade_groups == 13
    assert request.blank.pressure_angles == pytest.approx((radians(17.0), radians(23.0)))
    assert request.grind.pinion_curve_radius == request.grind.wheel_curve_radius == 762.0
    assert request.grind.pinion_toprem == pytest.approx((radians(2.5), 1.6))
    assert isinstance(request.drive, MotionTarget)
    assert (request.drive.transmission_error, request.drive.path_tilt) == (
        pytest.approx(54e-6),
        -1.0,
    )
    assert request.equal_spacing
    assert {a.value for a in request.assumed} >= {"cutting.hook_angle", "cutting.equal_spacing"}


def test_what_a_file_leaves_out_is_free_or_usual() -> None:
    request = parsed(TRI_AC, pinion__curve_radius=None, pinion__toprem=None)
    assert request.grind.pinion_curve_radius is None
    assert request.grind.pinion_toprem is None
    free = parsed(TRI_AC, cutting__equal_spacing=False, cutting__hook_angle="5 deg")
    assert not free.equal_spacing
    assert free.grind.hook_angle == pytest.approx(radians(5.0))


def test_limits_of_a_hobbed_pinion_are_those_of_a_milled_one() -> None:
    request = parsed(
        TRI_AC,
        pinion__range={"tilt_angle": ["0 deg", "25 deg"], "blade_radius": ["75 mm", "77 mm"]},
        pinion__fixed={"blank_offset": "-23 mm"},
        pinion__free=["modified_roll_2"],
    )
    limits = request.limits
    assert limits.ranges["tilt_angle"] == pytest.approx((0.0, radians(25.0)))
    assert limits.ranges["blade_radius"] == (75.0, 77.0)
    assert dict(limits.fixed) == {"blank_offset": -23.0}
    assert limits.free == ("modified_roll_2",)
    assert request.problems() == []
    reversed_ends = parsed(TRI_AC, pinion__range={"tilt_angle": ["25 deg", "0 deg"]})
    assert [p.path for p in reversed_ends.problems()] == ["pinion.range.tilt_angle"]


def test_exact_file_is_table_1_of_2022() -> None:
    spec = parsed(EXACT)
    assert isinstance(spec, ExactFaceHobbedSpec)
    assert (spec.wheel_mean_radius, spec.offset, spec.blade_groups) == (130.0, 55.0, 5)
    assert spec.tip_edge_radius_factor == 0.38
    assert not {a.value for a in spec.assumed} & {"contact.tolerance", "pinion.method"}


@pytest.mark.parametrize(
    ("name", "changes", "path", "words"),
    [
        (TRI_AC, {"cutting__blade_groups": None}, "cutting.blade_groups", "groups of the"),
        (TRI_AC, {"cutting__cutter_radius": None}, "cutting.cutter_radius", "a length"),
        (TRI_AC, {"cutting__blade_groups": 90}, "cutting.blade_groups", "at most"),
        (TRI_AC, {"pinion__machine": "gleason-122"}, "pinion.machine", "slot by slot"),
        (TRI_AC, {"pinion__free": ["magic"]}, "pinion.free", "names among"),
        (TRI_AC, {"pinion__free": ["blade_curvature"]}, "pinion.free", "curve_radius"),
        (
            TRI_AC,
            {"pinion__range": {"point_width": ["1 mm", "2 mm"]}},
            "pinion.range.point_width",
            "blade_radius",
        ),
        (
            TRI_AC,
            {"pinion__fixed": {"point_radius": "76 mm"}},
            "pinion.fixed.point_radius",
            "blade_radius",
        ),
        (TRI_AC, {"pinion__range": {"magic": ["1 mm", "2 mm"]}}, "pinion.range.magic", ""),
        (TRI_AC, {"pinion__range": {"tilt_angle": ["1 deg"]}}, "pinion.range.tilt_angle", "two"),
        (
            MILLED,
            {"pinion__range": {"blade_radius": ["1 mm", "2 mm"]}},
            "pinion.range.blade_radius",
            "point_radius",
        ),
        (
            EXACT,
            {"pinion__range": {"tilt_angle": ["0 deg", "1 deg"]}},
            "pinion.range",
            "exact system",
        ),
        (TRI_AC, {"pinion__method": "magic"}, "pinion.method", "tilt"),
        (TRI_AC, {"cutting__tip_edge_radius_factor": 0.3}, "cutting.tip_edge_radius_factor", "edge_radius"),
        (TRI_AC, {"wheel__curve_radius": "0 mm"}, "wheel.curve_radius", "other than 0"),
        (TRI_AC, {"wheel__outer_pitch_diameter": "200 mm"}, "wheel.mean_pitch_diameter", "once"),
        (TRI_AC, {"contact__drive__bias": "3 um"}, "contact.drive.pattern_length", "or a motion"),
        (EXACT, {"contact__drive": {"bias": "3 um"}}, "contact.drive", "tri-ac"),
        (EXACT, {"blank__method": 1}, "blank.method", "one crown gear"),
        (EXACT, {"blank__taper": "standard"}, "blank.taper", "uniform"),
        (EXACT, {"pinion__mean_spiral_angle": None}, "pinion.mean_spiral_angle", "spiral angle"),
        (EXACT, {"pinion__method": "tilt"}, "pinion.method", "exact system has no"),
        (EXACT, {"cutting__hook_angle": "4 deg"}, "cutting.hook_angle", "exact system has no"),
        (MILLED, {"cutting__blade_groups": 13}, "cutting.blade_groups", "face-hobbed"),
        (MILLED, {"pinion__curve_radius": "762 mm"}, "pinion.curve_radius", "face-mill blades"),
    ],
)  # fmt: skip
def test_faults_are_told_at_their_keys(
    name: str, changes: dict[str, Any], path: str, words: str
) -> None:
    with pytest.raises(DesignError) as caught:
        parsed(name, **changes)
    found = {problem.path: problem for problem in caught.value.problems}
    assert path in found
    assert words in found[path].expected
