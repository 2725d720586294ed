"""What is said of a tooth: sections, necks and points, each where it is."""

from __future__ import annotations

from dataclasses import replace
from math import degrees, radians

import pytest

from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.flank import tooth_facts
from hypoid.pair import GearPair


def test_a_sound_tooth(paper_pair: GearPair) -> None:
    """Gonzalez-Perez & Fuentes-Aznar 2022: uniform depth 5.347 mm, no neck, no point."""
    for member in (paper_pair.pinion, paper_pair.wheel):
        facts = tooth_facts(member.tooth)
        assert (facts.necks, facts.pointed, facts.secondary_face_angle) == ((), None, None)
        assert [s.place for s in facts.sections] == ["toe", "mean", "heel"]
        for s in facts.sections:
            assert s.whole_depth == pytest.approx(s.nominal_depth, abs=1e-6)
            assert s.nominal_depth == pytest.approx(5.347, abs=5e-4)
            assert 0.0 < s.top_land < s.thickness
            assert 0.0 < s.slot_bottom < s.slot_width


def test_a_neck_is_found_where_an_undercut_flank_overhangs(
    table_1_spec: ExactFaceHobbedSpec,
) -> None:
    spec = replace(
        table_1_spec, pressure_angle=radians(5.0), depth_factor=2.2, tip_edge_radius_factor=0.2
    )
    facts = tooth_facts(build(spec).pinion.tooth)
    assert facts.necks
    assert all(-60.0 < degrees(neck.pressure_angle) < 0.0 for neck in facts.necks)


def test_a_pointed_toe_asks_for_a_secondary_face_angle(paper_pair: GearPair) -> None:
    pinion = paper_pair.pinion
    whole = pinion.tooth.grid(9, 9)
    land = (whole.convex.angle - whole.concave.angle)[:, -1]
    thin = replace(pinion, stock_turn=-0.5 * (land.min() + land.max()))
    facts = tooth_facts(thin.tooth)
    assert facts.pointed is not None
    start, end = facts.pointed
    assert start == pytest.approx(pinion.concave.toe)
    assert end < pinion.concave.heel
    assert facts.secondary_face_angle is not None
    assert facts.secondary_face_angle > pinion.blank.face_angle
