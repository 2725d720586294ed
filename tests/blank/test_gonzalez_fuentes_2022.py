"""Gonzalez-Perez & Fuentes-Aznar 2022, doi 10.1016/j.mechmachtheory.2022.105115: Tables 2 and 3,
and section 6.1.

Tolerance: half a unit of the last printed digit.
"""

from __future__ import annotations

from math import degrees, sin

import pytest

from hypoid.blank import PairBlank


def printed(value: float, text: str) -> bool:
    """The value rounds to what is printed."""
    digits = len(text.partition(".")[2])
    return f"{value:.{digits}f}" == text


def test_table_2_pitch_cones(paper: PairBlank) -> None:
    assert printed(degrees(paper.pinion.pitch_angle), "10.791")
    assert printed(degrees(paper.wheel.pitch_angle), "78.152")
    assert printed(degrees(paper.wheel.mean_spiral_angle), "40.308")
    assert printed(paper.pinion.mean_pitch_diameter / 2, "19.280")
    assert printed(paper.mean_normal_module, "2.716")
    assert printed(paper.pinion.mean_pitch_diameter, "38.56")
    assert printed(paper.wheel.mean_pitch_diameter, "260.0")
    assert printed(paper.pinion.mean_cone_distance, "102.974")
    assert printed(paper.wheel.mean_cone_distance, "132.830")
    assert printed(paper.pinion.pitch_apex_beyond_crossing_point, "-17.397")
    assert printed(paper.wheel.pitch_apex_beyond_crossing_point, "8.063")


def test_table_2_outer_values(paper: PairBlank) -> None:
    assert printed(paper.pinion.face_width, "43.0")
    assert printed(paper.wheel.outer_pitch_diameter, "294.254")
    assert printed(paper.outer_transverse_module, "4.031")
    assert printed(paper.wheel.outer_cone_distance, "150.330")
    for member in (paper.pinion, paper.wheel):
        assert printed(member.outer_addendum, "2.377")
        assert printed(member.outer_dedendum, "2.971")


def test_table_2_outer_pinion_values_follow_with_a_for_a_p(paper: PairBlank) -> None:
    """ERRATUM: R_e1 = 124.205 and d_e1 = 46.510 need the offset a where the standard has a_p."""
    as_printed = paper.outer_pinion_readings.printed_2022
    assert as_printed.pitch_plane_offset == 55.0
    assert printed(as_printed.outer_cone_distance, "124.205")
    assert printed(as_printed.outer_pitch_diameter, "46.510")
    conforming = paper.outer_pinion_readings.conforming
    assert printed(conforming.pitch_plane_offset, "55.489")
    assert printed(conforming.outer_cone_distance, "124.1983")
    assert printed(conforming.outer_pitch_diameter, "46.5080")
    assert paper.pinion.outer_cone_distance == conforming.outer_cone_distance
    assert paper.pinion.outer_pitch_diameter == conforming.outer_pitch_diameter


def test_table_3_head_cutters(paper: PairBlank) -> None:
    assert printed(paper.cones.mean_normal_module, "2.716")  # blade module m_b
    assert printed(degrees(paper.slope_angle), "3.893")
    assert printed(paper.pinion.mean_dedendum, "2.971")  # reference height h_r
    assert printed(0.38 * paper.mean_normal_module, "1.032")  # tip edge radius r_t


def test_section_6_1_offset_angles_and_limit_pressure_angle(paper: PairBlank) -> None:
    """Printed 0.649 deg without a sign; ISO 23509 (32) gives it as -0.6494 deg."""
    assert printed(degrees(paper.cones.pinion_offset_angle_axial), "24.227")
    assert printed(degrees(paper.cones.wheel_offset_angle_axial), "4.920")
    assert printed(degrees(paper.limit_pressure_angle), "-0.6494")


def test_more_digits_of_a_30_digit_calculation(paper: PairBlank) -> None:
    cones = paper.cones
    angles = {
        cones.wheel_azimuth: 24.2272356,
        cones.pinion_azimuth: 4.9202810,
        cones.pinion_pitch_angle: 10.7913438,
        cones.wheel_pitch_angle: 78.1519966,
        cones.wheel_spiral_angle: 40.3077527,
        cones.slope_angle: 3.8934382,
    }
    for value, expected in angles.items():
        assert degrees(value) == pytest.approx(expected, abs=6e-8)
    assert cones.pinion_mean_radius == pytest.approx(19.2801032, abs=6e-8)
    assert cones.mean_normal_module == pytest.approx(2.71604123, abs=6e-9)
    assert cones.pinion_apex_beyond_crossing == pytest.approx(-17.3974057, abs=6e-8)
    assert cones.wheel_apex_beyond_crossing == pytest.approx(8.0630487, abs=6e-8)
    # blank offset of Table 5, and the radial distance of Table 4 seen from the tooth line
    assert cones.pitch_plane_offset == pytest.approx(55.4888893, abs=6e-8)


def test_hands_and_counts(paper: PairBlank) -> None:
    assert (paper.pinion.hand, paper.wheel.hand) == ("left", "right")
    assert (paper.pinion.teeth, paper.wheel.teeth) == (6, 73)
    assert paper.faults == ()
    assert abs(paper.ratio_residual) < 1e-13
    assert abs(paper.alignment_residual) < 1e-14


def test_uniform_depth_keeps_the_cones_parallel(paper: PairBlank) -> None:
    for member in (paper.pinion, paper.wheel):
        assert member.face_angle == pytest.approx(member.pitch_angle, abs=1e-13)
        assert member.root_angle == pytest.approx(member.pitch_angle, abs=1e-13)
        shift = member.face_apex_beyond_crossing_point - member.pitch_apex_beyond_crossing_point
        assert shift == pytest.approx(member.mean_addendum / sin(member.pitch_angle), abs=1e-9)
