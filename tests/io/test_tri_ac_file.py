"""Tri-Ac heads in the design file: what their keys mean, and every fault of a bad one with an example."""

from __future__ import annotations

import re
import tomllib
from math import pi, radians
from typing import Any

import pytest
import tomlkit
from sheets import Changes, changed, problems, repaired

from hypoid.cutter import BladeToprem, TriAcHead
from hypoid.design import StickBladeSpec, SummarySheetSpec, build
from hypoid.io import example_files, parse_spec
from hypoid.solid import ring_problems

TEXT = next(f for f in example_files() if f.stem == "vimercati-piazza-2005").read_text()
FILE: dict[str, Any] = {**tomllib.loads(TEXT), "assumed": []}


def parsed(changes: Changes | None = None) -> SummarySheetSpec:
    spec = parse_spec(tomlkit.dumps(changed(FILE, changes or {})))
    assert isinstance(spec, SummarySheetSpec)
    return spec


def test_measures_of_a_stick_blade() -> None:
    blade = parsed().pinion.concave.blade
    assert isinstance(blade, StickBladeSpec)
    assert (blade.radius, blade.reference_height) == (76.80715, 3.91)
    assert (blade.curve_radius, blade.edge_radius) == (762.0, 0.9)
    degrees = blade.angle, blade.eccentric_angle, blade.hook_angle, blade.side_rake_angle
    assert degrees == pytest.approx([radians(v) for v in (16.13598, 18.85, 4.42, 12.0)])
    assert blade.toprem == (pytest.approx(radians(2.5)), 1.6, "along-flank")
    head = build(parsed()).pinion.head
    assert isinstance(head, TriAcHead)
    assert head.spacing == pytest.approx(radians(9.84))
    assert head.outer.toprem == BladeToprem(1.6, blade.toprem[0], "along-flank")


@pytest.mark.parametrize(
    ("toprem", "read"),
    [
        ({"length": "1.6 mm", "angle": "2 deg"}, (1.6, "along-flank")),
        (
            {"length": "1.6 mm", "angle": "2 deg", "measured": "straight-part"},
            (1.6, "straight-part"),
        ),
        ({"height": "1.5 mm", "angle": "2 deg"}, (1.5, "axial")),
    ],
)
def test_toprem_is_read_three_ways(toprem: dict[str, str], read: tuple[float, str]) -> None:
    blade = parsed({"pinion.blade.toprem": toprem}).pinion.convex.blade
    assert isinstance(blade, StickBladeSpec)
    assert blade.toprem is not None
    assert blade.toprem[1:] == read


def test_work_turns_on_by_a_tooth_a_group() -> None:
    pair = build(parsed())
    for member in (pair.pinion, pair.wheel):
        for flank in (member.concave, member.convex):
            assert flank.settings.roll_to_blade_ratio == 13 / member.teeth


def test_what_the_program_puts_in_is_told() -> None:
    """Even spacing and a plain blade; nothing of that where the file says it."""
    changes: Changes = {
        "wheel.cutter.spacing": None,
        "wheel.blade.hook_angle": None,
        "wheel.blade.edge_radius": None,
    }
    own = {"wheel.cutter.spacing", "wheel.blade.hook_angle", "wheel.blade.edge_radius"}
    told = {a.value for a in parsed(changes).assumed}
    assert own <= told
    assert not own & {a.value for a in parsed().assumed}
    head = build(parsed({"wheel.cutter.spacing": None})).wheel.head
    assert isinstance(head, TriAcHead)
    assert head.following == pi / 13


BAD: dict[str, tuple[Changes, str]] = {
    "no groups": ({"pinion.cutter.blade_groups": None}, "pinion.cutter.blade_groups"),
    "a face mill's measure": ({"pinion.cutter.diameter": "9 in"}, "pinion.cutter.diameter"),
    "a face mill's blade": ({"wheel.blade.point_diameter": "9 in"}, "wheel.blade.point_diameter"),
    "a stick's measure on a face mill": (
        {"wheel.cutter": {"type": "face-mill", "diameter": "9 in", "point_width": "0.1 in"}},
        "wheel.blade.hook_angle",
    ),
    "no blade radius": ({"pinion.concave.blade.blade_radius": None}, "pinion.concave.blade.blade_radius"),
    "no pitch point": ({"pinion.blade.reference_height": None}, "pinion.blade.reference_height"),
    "a parabola": ({"pinion.blade.profile": "parabola"}, "pinion.blade.profile"),
    "a radius on a straight blade": ({"wheel.blade.profile": "straight"}, "wheel.blade.radius"),
    "a method of face milling": ({"wheel.settings.method": "duplex"}, "wheel.settings.method"),
    "a cradle machine": ({"pinion.settings.machine": "gleason-463"}, "pinion.settings.machine"),
    "spacing without a unit": ({"pinion.cutter.spacing": 9.84}, "pinion.cutter.spacing"),
    "no slot": ({"pinion.cutter.spacing": "2 deg"}, "pinion.cutter.spacing"),
    "no tooth": ({"pinion.cutter.spacing": "27 deg"}, "pinion.cutter.spacing"),
    "edge radius too large": ({"pinion.concave.blade.edge_radius": "3 mm"}, "pinion.concave.blade.edge_radius"),
    "Toprem longer than the blade": (
        {"pinion.blade.toprem": {"length": "6 mm", "angle": "2.5 deg"}},
        "pinion.blade.toprem.length",
    ),
    "Toprem higher than the blade": (
        {"pinion.blade.toprem": {"height": "6 mm", "angle": "2.5 deg"}},
        "pinion.blade.toprem.height",
    ),
    "Toprem by both": (
        {"pinion.blade.toprem": {"height": "1 mm", "length": "1 mm", "angle": "2.5 deg"}},
        "pinion.blade.toprem",
    ),
    "blade too steep for its curve": ({"pinion.concave.blade.angle": "59.9 deg"}, "pinion.blade.radius"),
    "bent too much": ({"pinion.blade.radius": "5 mm"}, "pinion.blade.radius"),
    "a blade that ends below its pitch point": ({"pinion.cutter.height": "3 mm"}, "pinion.cutter.height"),
    "a blade shorter than the tooth": ({"pinion.cutter.height": "6 mm"}, "pinion.cutter.height"),
    "blades that reach over the axis": (
        {"wheel.concave.blade.blade_radius": "2 mm", "wheel.convex.blade.blade_radius": "1.5 mm"},
        "wheel.concave.blade.blade_radius",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_told_at_its_key(name: str) -> None:
    """With what was given, what was expected, and a line of TOML for that key."""
    changes, path = BAD[name]
    document = changed(FILE, changes)
    told = {p.path: p for p in problems(document, building=True)}
    assert path in told, sorted(told)
    for where, problem in told.items():
        assert problem.given
        assert problem.expected
        last = where.split(".")[-1]
        assert re.match(rf"(# )?{last} = .+", problem.example), (where, problem.example)
    # the example mends its own key, whatever else is wrong
    mended = repaired(document, told[path])
    assert path not in {p.path for p in problems(mended, building=True)}


def test_bodies() -> None:
    """Bore and mounting distance reach the member; those that cannot be are told at their keys."""
    body = {"bore_diameter": "30 mm", "mounting_distance": "140 mm"}
    member = build(parsed({"pinion.body": body})).pinion
    assert (member.bore, member.mounting_distance) == (15.0, 140.0)
    assert ring_problems(member) == []
    body = {"bore_diameter": "300 mm", "mounting_distance": "14 mm"}
    wrong = ring_problems(build(parsed({"pinion.body": body})).pinion)
    assert [p.path for p in wrong] == ["pinion.body.bore_diameter", "pinion.body.mounting_distance"]
