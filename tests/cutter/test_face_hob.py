"""The head of Gonzalez-Perez & Fuentes-Aznar 2022: Table 3, Fig. A.15 and the notes' items 6, 8, 9."""

from __future__ import annotations

import itertools
from dataclasses import replace
from math import cos, degrees, pi, radians, sin, tan
from typing import Any

import numpy as np
import pytest
from independent import blade_outline

from hypoid.cutter import Blade, BladeRelief, EdgePiece, FaceHobHead, edge_point
from hypoid.geometry import DesignError
from hypoid.pair import GearPair

PIECES = ("land", "fillet", "flank")


def end(piece: EdgePiece, s: float) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    point, along = edge_point(piece, np.array(float(s)))
    return np.array(point), np.array(along)


@pytest.fixture
def head(paper_pair: GearPair) -> FaceHobHead:
    return paper_pair.pinion.head


def test_table_3(paper_pair: GearPair) -> None:
    for member in (paper_pair.pinion, paper_pair.wheel):
        assert f"{degrees(member.head.slope_angle):.3f}" == "3.893"
        assert f"{2.0 * member.head.radius * sin(member.head.slope_angle) / 5:.3f}" == "2.716"
        for blade in (member.head.outer, member.head.inner):
            assert f"{blade.reference_height:.3f}" == "2.971"
            assert f"{blade.edge_radius:.3f}" == "1.032"
            assert degrees(blade.pressure_angle) == pytest.approx(20.0, abs=1e-12)


def test_edge_arc_begins_below_the_mating_addendum(paper_pair: GearPair) -> None:
    """Notes, item 9: 2.2916 < 2.3765, which is why the mating tip cuts into the fillet."""
    assert paper_pair.pinion.head.outer.arc_height == pytest.approx(2.2916, abs=5e-5)
    assert paper_pair.wheel.blank.mean_addendum == pytest.approx(2.3765, abs=5e-5)


@pytest.mark.parametrize("name", ["outer", "inner"])
def test_pieces_join_with_one_tangent(head: FaceHobHead, name: Any) -> None:
    pieces = head.pieces(name)
    for first, second in itertools.pairwise(PIECES):
        point, along = end(pieces[first], pieces[first].high)
        next_point, next_along = end(pieces[second], pieces[second].low)
        assert next_point == pytest.approx(point, abs=1e-13)
        assert next_along == pytest.approx(along, abs=1e-14)


@pytest.mark.parametrize("relief", [None, BladeRelief(0.004, 0.93)])
@pytest.mark.parametrize("name", ["outer", "inner"])
def test_pieces_follow_the_outline_drawn_apart(
    head: FaceHobHead, name: Any, relief: BladeRelief | None
) -> None:
    head = replace(head, **{name: replace(getattr(head, name), relief=relief)})
    blade: Blade = getattr(head, name)
    straight = blade.arc_height / cos(blade.pressure_angle)
    arc = blade.edge_radius * (pi / 2 - blade.pressure_angle)
    starts = {"land": -straight - arc, "fillet": -straight - arc, "flank": 0.0}
    side, turn = (1.0, 0.0) if name == "outer" else (-1.0, -pi / head.blade_groups)
    for key, piece in head.pieces(name).items():
        s = np.linspace(piece.low, piece.high, 20)
        x, z = blade_outline(blade, starts[key] + s)
        plane = head.radius + side * x * np.exp(-1j * head.slope_angle)
        expected = plane * np.exp(1j * turn)
        point, _ = edge_point(piece, s)
        assert np.array(point[0]) == pytest.approx(expected.real, abs=1e-12)
        assert np.array(point[1]) == pytest.approx(expected.imag, abs=1e-12)
        assert np.array(point[2]) == pytest.approx(z, abs=1e-13)


def test_front_plane_passes_the_axis_at_the_base_radius(head: FaceHobHead) -> None:
    """(A.1): r_b = r_c0 sin(nu), and no rake: the edge stays in a plane along the cutter axis."""
    piece = head.pieces("outer")["flank"]
    start, tangent = np.array(piece.start), np.array(piece.tangent)
    assert start == pytest.approx([100.0, 0.0, 0.0], abs=1e-13)
    in_plane = tangent[:2] / np.hypot(*tangent[:2])
    lever = abs(start[0] * in_plane[1] - start[1] * in_plane[0])
    assert lever == pytest.approx(100.0 * sin(head.slope_angle), abs=1e-12)
    assert np.arccos(-tangent[2]) == pytest.approx(radians(20.0), abs=1e-14)


def test_inner_blade_follows_half_a_group_later(head: FaceHobHead) -> None:
    """Notes, item 6: one zero of the cutter's turn for both blades."""
    start = np.array(head.pieces("inner")["flank"].start)
    assert start == pytest.approx([100.0 * cos(pi / 5), -100.0 * sin(pi / 5), 0.0], abs=1e-12)


def test_land_ends_in_the_middle_of_the_slot(head: FaceHobHead, paper_pair: GearPair) -> None:
    """At the pitch plane the slot is pi m_mn/2 wide, so half of it lies behind each blade's edge."""
    blade = head.outer
    reach = blade.arc_height * tan(blade.pressure_angle)
    reach += blade.edge_radius * cos(blade.pressure_angle) + blade.land
    assert reach == pytest.approx(pi * paper_pair.blank.mean_normal_module / 4.0, abs=1e-12)


def test_slope_angle_needs_a_cutter_above_its_base_circle() -> None:
    from hypoid.cutter._face_hob import slope_angle

    assert degrees(slope_angle(2.71604123, 5, 100.0)) == pytest.approx(3.8934382, abs=1e-6)
    with pytest.raises(DesignError) as caught:
        slope_angle(2.716, 5, 6.0)
    (problem,) = caught.value.problems
    assert problem.path == "cutting.cutter_radius"
    assert "6.79 mm" in problem.expected
