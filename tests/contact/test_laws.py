"""What holds for every contact: conjugacy at any shaft angle, scaling, edges, V-H."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians
from typing import Any

import numpy as np
import pytest

from hypoid.contact import (
    Misalignment,
    Sampling,
    pattern,
    sensitivity,
    tip_interference,
    unloaded_contact,
    vh_check,
)
from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.pair import GearPair

ARCSEC = pi / 180 / 3600
QUICK = Sampling(positions_per_pitch=10)


@pytest.mark.parametrize("shaft_angle", [70.0, 93.0])
def test_exact_system_is_conjugate_at_any_shaft_angle(
    table_1_spec: ExactFaceHobbedSpec, shaft_angle: float
) -> None:
    pair = build(replace(table_1_spec, shaft_angle=radians(shaft_angle), offset=40.0))
    for direction in ("drive", "coast"):
        contact = unloaded_contact(pair, direction, None, QUICK)
        assert len(contact.leading)
        assert np.abs(contact.points.lead[contact.leading]).max() < 1e-6 * ARCSEC


def test_scaling_all_lengths_leaves_the_angles(table_1_spec: ExactFaceHobbedSpec) -> None:
    k = 1.7
    lengths = ("offset", "wheel_mean_radius", "wheel_face_width", "cutter_radius")
    scaled = replace(table_1_spec, **{name: k * getattr(table_1_spec, name) for name in lengths})
    # method 3 rounds the pinion face width to whole millimetres: compare where both have flanks
    small, large = (build(s) for s in (table_1_spec, scaled))
    error = Misalignment(offset=0.05)
    a = unloaded_contact(small, "drive", error, QUICK)
    b = unloaded_contact(large, "drive", replace(error, offset=k * 0.05), QUICK)
    both = a.interior & b.interior
    assert both.sum() > 10
    np.testing.assert_allclose(b.points.lead[both], a.points.lead[both], atol=1e-13)
    np.testing.assert_allclose(b.points.s1[both], k * a.points.s1[both], atol=1e-6)


def test_edge_contact_is_flagged_and_settles_with_the_grid(paper_pair: GearPair) -> None:
    """Withdrawn by 0.3 mm the pair runs on its edges; their lead does not depend on the grid."""
    error = Misalignment(pinion_axial=0.3)
    coarse, fine = (
        unloaded_contact(paper_pair, "drive", error, Sampling(10, columns=c, rows=r))
        for c, r in ((61, 31), (121, 61))
    )
    assert coarse.edge_contact
    assert fine.edge_contact
    assert not unloaded_contact(paper_pair, "drive", None, QUICK).edge_contact
    np.testing.assert_allclose(coarse.envelope, fine.envelope, atol=2e-3 * ARCSEC)


def test_no_point_leads_the_wheel(relief_pair: GearPair) -> None:
    """The wheel stands where nothing penetrates: no node asks for more lead than the contact."""
    for error in (Misalignment(), Misalignment(0.05, -0.05, 0.05, radians(0.03))):
        contact = unloaded_contact(relief_pair, "coast", error)
        met = np.isfinite(contact.curve)
        assert (contact.leads[met].max(axis=1) - contact.curve[met]).max() < 1e-12


def test_vh_check_puts_the_contact_where_it_was_asked(paper_pair: GearPair) -> None:
    """Under the errors found, a true contact lies at the target and the wheel keeps the ratio."""
    contact = unloaded_contact(paper_pair, "drive")
    for result in vh_check(contact):
        assert result.found
        moved = unloaded_contact(paper_pair, "drive", result.misalignment, Sampling(80))
        distance, height = moved.path
        nearest = int(np.hypot(distance - result.target[0], height - result.target[1]).argmin())
        apart = np.hypot(distance[nearest] - result.target[0], height[nearest] - result.target[1])
        step = np.hypot(np.diff(distance), np.diff(height)).max()
        assert apart < step
        lead = moved.points.lead[moved.on_path]
        rate = np.gradient(lead, moved.phi[moved.on_path])[nearest]
        assert abs(rate) < 1e-6  # of the mean ratio's 0.08: the motion curve has its vertex here


def test_sensitivity_moves_the_pattern_along_the_face(paper_pair: GearPair) -> None:
    aligned, *rows = sensitivity(paper_pair, "drive", sampling=Sampling(20))
    centres = [row.pattern_centre[0] - aligned.pattern_centre[0] for row in rows]
    for minus, plus in zip(centres[::2], centres[1::2], strict=True):
        assert minus * plus < 0.0 or max(abs(minus), abs(plus)) < 0.3
    assert aligned.peak_to_peak < 1e-6 * ARCSEC
    assert all(row.peak_to_peak < 5 * ARCSEC for row in rows)


def test_marking_thickness_grows_the_pattern(paper_pair: GearPair) -> None:
    contact = unloaded_contact(paper_pair, "drive")
    shares = [pattern(contact, t).share for t in (0.001, 0.003, 0.0065, 0.01)]
    assert shares == sorted(shares)
    assert shares[2] == pytest.approx(0.58, abs=0.01)


def test_no_contact_is_said_not_raised(paper_pair: GearPair) -> None:
    apart: Any = unloaded_contact(paper_pair, "drive", Misalignment(offset=60.0), QUICK)
    assert not apart.touched
    assert not any(cut.found for cut in tip_interference(apart))


def test_edges_that_trail_far_behind_do_not_move_the_wheel(paper_pair: GearPair) -> None:
    """A batch may leave them unrefined: the envelope is the same."""
    error = Misalignment(0.03, 0.08, -0.05, radians(0.04))
    every, few = (
        unloaded_contact(paper_pair, "coast", error, Sampling(10, every_edge=e))
        for e in (True, False)
    )
    np.testing.assert_allclose(few.envelope, every.envelope, rtol=0.0, atol=1e-15)
