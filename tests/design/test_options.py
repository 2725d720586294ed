"""What a design file may add: relief in both readings, settings of its own, edges that do not fit."""

from __future__ import annotations

from dataclasses import replace
from math import cos, radians
from typing import Any

import pytest

from hypoid.design import ExactFaceHobbedSpec, TipRelief, build, spec_blank
from hypoid.geometry import DesignError


@pytest.mark.parametrize(
    ("reading", "at_tip"), [("pitch", 3.5), ("tip", 10.2)], ids=["from pitch", "from tip"]
)
def test_relief_at_the_tip_in_both_readings(
    table_1_spec: ExactFaceHobbedSpec, reading: Any, at_tip: float
) -> None:
    """Notes, item 8: 3.5 um or 10.2 um at the tip for a = 0.004/mm, h_tr = 1.5 mm."""
    pair = build(replace(table_1_spec, tip_relief=TipRelief(0.004, 1.5, reading, "both")))
    for member in (pair.pinion, pair.wheel):
        for blade in (member.head.outer, member.head.inner):
            assert blade.relief is not None
            tip = member.blank.mean_addendum / cos(radians(20.0))
            depth = blade.relief.coefficient * (tip - blade.relief.start) ** 2
            assert 1e3 * depth == pytest.approx(at_tip, abs=0.05)


@pytest.mark.parametrize(
    ("flanks", "relieved"),
    [
        ("drive", {"pinion outer", "wheel inner"}),
        ("coast", {"pinion inner", "wheel outer"}),
        ("both", {"pinion outer", "pinion inner", "wheel outer", "wheel inner"}),
    ],
)
def test_relief_by_flanks_in_use(
    table_1_spec: ExactFaceHobbedSpec, flanks: Any, relieved: set[str]
) -> None:
    """Drive = pinion concave (outer blades) with wheel convex (inner blades)."""
    pair = build(replace(table_1_spec, tip_relief=TipRelief(0.004, 1.5, "tip", flanks)))
    found = {
        f"{member.name} {blade.name}"
        for member in (pair.pinion, pair.wheel)
        for blade in (member.head.outer, member.head.inner)
        if blade.relief is not None
    }
    assert found == relieved


def test_settings_of_the_file_replace_those_of_one_flank(table_1_spec: ExactFaceHobbedSpec) -> None:
    changes = {"pinion.convex": {"radial_distance": 110.0, "modified_roll": (0.01,)}}
    plain = build(table_1_spec)
    pair = build(replace(table_1_spec, setting_changes=changes))
    changed, before = pair.pinion.sheet("convex"), plain.pinion.sheet("convex")
    expected = replace(before, radial_distance=110.0, modified_roll=(0.01,))
    assert changed.machine_center_to_back == pytest.approx(before.machine_center_to_back, abs=1e-13)
    assert replace(changed, machine_center_to_back=before.machine_center_to_back) == expected
    assert not pair.pinion.convex.settings.plain_roll
    for name in ("pinion concave", "wheel concave", "wheel convex"):
        same = [next(f for f in p.flanks() if f.name == name).settings for p in (plain, pair)]
        assert same[0] == same[1]


def test_an_edge_too_round_for_the_slot_names_the_greatest_that_fits(
    table_1_spec: ExactFaceHobbedSpec,
) -> None:
    with pytest.raises(DesignError) as caught:
        build(replace(table_1_spec, tip_edge_radius_factor=0.9))
    (problem,) = caught.value.problems
    assert problem.path == "cutting.tip_edge_radius_factor"
    fits = float(problem.expected.rsplit(maxsplit=1)[1])
    build(replace(table_1_spec, tip_edge_radius_factor=fits - 1e-3))
    with pytest.raises(DesignError):
        build(replace(table_1_spec, tip_edge_radius_factor=fits + 1e-3))


def test_no_pitch_cones_no_pair(table_1_spec: ExactFaceHobbedSpec) -> None:
    spec = replace(table_1_spec, offset=400.0)
    for make in (spec_blank, build):
        with pytest.raises(DesignError) as caught:
            make(spec)
        assert any("offset" in p.path or "offset" in p.expected for p in caught.value.problems)
