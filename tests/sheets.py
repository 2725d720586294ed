"""A spiral bevel pair 27 x 28 as the text of a summary sheet, and changed ones, for several rooms' tests."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from copy import deepcopy
from typing import Any

import tomlkit

from hypoid.design import SummarySheetSpec, build
from hypoid.geometry import DesignError, Problem
from hypoid.io import parse_spec
from hypoid.pair import GearPair

Changes = Mapping[str, Any]  # by dotted path; None takes the key away


def _member(teeth: int, hand: str, pitch: str, face: str, root: str, ratio: float) -> Any:
    return {
        "teeth": teeth,
        "hand": hand,
        "blank": {
            "pitch_angle": pitch,
            "face_width": "25 mm",
            "mean_spiral_angle": "35 deg",
            "face_angle": face,
            "outer_cone_distance": "161.69 mm",
            "outer_addendum": "3.8 mm",
        },
        "cutter": {"type": "face-mill", "diameter": "250 mm", "point_width": "2.4 mm"},
        "settings": {
            "method": "generated",
            "radial_distance": "128.41 mm",
            "cradle_angle": "52 deg 53 min",
            "machine_root_angle": root,
            "ratio_of_roll": ratio,
        },
        "blade": {"edge_radius": "0.6 mm"},
        "concave": {"blade": {"angle": "19 deg"}},
        "convex": {"blade": {"angle": "21 deg"}},
    }


SHEET: dict[str, Any] = {
    "schema": 1,
    "title": "Spiral bevel 27 x 28",
    "pair": {"shaft_angle": "45 deg", "offset": "0 mm"},
    "pinion": _member(27, "right", "22 deg 4 min", "23 deg 42 min", "20 deg 26 min", 2.66),
    "wheel": _member(28, "left", "22 deg 56 min", "24 deg 34 min", "21 deg 18 min", 2.5656),
}
TILT_122 = {
    "machine": "gleason-122",
    "eccentric_angle": "62 deg 28 min",
    "cradle_angle": "5 deg 53 min",
    "swivel_angle": "58 deg 46 min",
    "cutter_spindle_rotation_angle": "0 deg",
    "machine_root_angle": "20 deg 26 min",
    "ratio_gears": [85, 67, 94, 83],
}
TILT_106 = {
    "machine": "gleason-106",
    "eccentric_angle": "114 deg 50 min",
    "cradle_angle": "85 deg 28 min",
    "swivel_angle": "212 deg 35 min",
    "cutter_spindle_rotation_angle": "0 deg",
    "machine_root_angle": "21 deg 18 min",
    "ratio_gears": [50, 37, 84, 79],
}
CAM_463 = {
    "machine": "gleason-463",
    "eccentric_angle": "36 deg 50 min",
    "cradle_angle": "71 deg 18 min",
    "machine_root_angle": "20 deg 26 min",
    "cam_number": 23,
    "cam_setting": "100.21 mm",
    "cam_guide_angle": "2 deg",
    "index_gears": [44, 72, 50, 75],
    "index_interval": 11,
}
GRINDER = {
    "swivel_offset": "381 mm",
    "cams": {
        "23": {"pitch_radius": "70.302 mm", "nominal_setting": "101.6 mm"},
        "29": {"pitch_radius": "56.439 mm", "nominal_setting": "76.2 mm"},
    },
}
ON_463: Changes = {
    "pinion.settings": {"method": "modified-roll", **CAM_463},
    "machine.gleason-463": GRINDER,
}
ON_122: Changes = {"pinion.settings": {"method": "generated", **TILT_122}}


def sheet(*changes: Changes) -> dict[str, Any]:
    """The sheet with keys set; a later change goes before an earlier one."""
    return changed(SHEET, *changes)


def changed(document: dict[str, Any], *changes: Changes) -> dict[str, Any]:
    """A document with keys set, or taken away."""
    document = deepcopy(document)
    for path, value in (item for change in changes for item in change.items()):
        *tables, key = path.split(".")
        table = document
        for name in tables:
            table = table.setdefault(name, {})
        if value is None:
            del table[key]
        else:
            table[key] = deepcopy(value)
    return document


def text(*changes: Changes) -> str:
    return tomlkit.dumps(sheet(*changes))


def parsed(*changes: Changes) -> SummarySheetSpec:
    spec = parse_spec(text(*changes))
    assert isinstance(spec, SummarySheetSpec)
    return spec


def built(*changes: Changes) -> GearPair:
    return build(parsed(*changes))


def problems(document: dict[str, Any], *, building: bool = False) -> list[Problem]:
    """What is wrong with a sheet when it is read, or read and built; nothing for a good one."""
    try:
        spec = parse_spec(tomlkit.dumps(document))
        if building:
            build(spec)
    except DesignError as error:
        return list(error.problems)
    return []


def repaired(document: dict[str, Any], problem: Problem) -> dict[str, Any]:
    """The document with a problem's example in place; an example that is a comment takes the key away."""
    *tables, key = problem.path.split("[")[0].split(".")
    document = deepcopy(document)
    table = document
    for name in tables:
        table = table.setdefault(name, {})
    table.pop(key, None)
    table.update(tomllib.loads(problem.example))
    return document
