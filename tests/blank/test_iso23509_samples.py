"""ISO 23509:2016, annex F, sample calculations F.2 (method 0) and F.4 (method 2).

The printed digits reach us through the self-test of a public transcription (repository
afuentesaz/AGMAStandards). The published cone data go in, the values that follow are compared.
Inputs carry three decimals, so the values that follow may be off by two units of the third.
"""

from __future__ import annotations

from math import asin, atan2, cos, degrees, radians

import pytest

from hypoid.blank import (
    DepthFactors,
    EqualFaceWidth,
    MemberBlank,
    OerlikonFaceWidth,
    PairBlank,
    blank_of_cones,
    crown_gear_tooth,
    depth_factors,
    face_and_root_cones,
    mean_normal_thickness,
    pitch_cones,
    tooth_thickness,
)

TOLERANCE = 2.1e-3

F2_DEPTHS = {"hmw": 6.427, "c": 0.803, "ham": (4.836, 1.591), "hfm": (2.394, 5.639)}
F2_ENDS = {
    "outer_addendum": (6.281, 2.064),
    "outer_dedendum": (2.867, 7.085),
    "inner_addendum": (3.391, 1.117),
    "inner_dedendum": (1.921, 4.194),
    "outer_cone_distance": (93.973, 93.973),
    "inner_cone_distance": (68.573, 68.573),
    "outer_pitch_diameter": (63.5, 176.893),
    "inner_pitch_diameter": (46.337, 129.08),
    "outer_tip_diameter": (75.324, 178.288),
    "outer_root_diameter": (58.102, 172.106),
    "inner_tip_diameter": (52.719, 129.835),
    "inner_root_diameter": (42.721, 126.246),
    "outer_crown_position": (86.324, 29.808),
    "inner_crown_position": (63.395, 22.117),
    "mean_point_position": (76.493, 27.459),
    "face_apex_beyond_crossing_point": (-9.931, -1.508),
    "root_apex_beyond_crossing_point": (2.094, 3.999),
    "pitch_apex_beyond_crossing_point": (0.0, 0.0),
}
F2_ANGLES = {
    "face_angle": (26.24, 72.387),
    "root_angle": (17.613, 63.76),
    "addendum_angle": (6.493, 2.134),
    "dedendum_angle": (2.134, 6.493),
    "outer_spiral_angle": (36.846, 36.846),
    "inner_spiral_angle": (33.946, 33.946),
}
F4_DEPTHS = {"hmw": 8.056, "c": 1.007, "ham": (5.84, 2.215), "hfm": (3.222, 6.847)}
F4_ENDS = {
    "outer_addendum": (5.841, 2.215),
    "outer_dedendum": (3.222, 6.847),
    "inner_addendum": (5.84, 2.215),
    "inner_dedendum": (3.223, 6.847),
    "face_width": (31.139, 26.0),
    "outer_face_width": (15.569, 13.0),
    "inner_face_width": (15.569, 13.0),
    "outer_cone_distance": (76.755, 95.168),
    "inner_cone_distance": (45.617, 69.168),
    "outer_pitch_diameter": (64.301, 169.91),
    "inner_pitch_diameter": (38.215, 123.49),
    "outer_tip_diameter": (74.909, 171.907),
    "outer_root_diameter": (58.45, 163.738),
    "inner_tip_diameter": (48.821, 125.487),
    "inner_root_diameter": (32.362, 117.318),
    "outer_crown_position": (79.869, 29.077),
    "inner_crown_position": (51.594, 17.359),
    "mean_point_position": (68.178, 25.195),
    "pitch_apex_beyond_crossing_point": (-12.618, 11.836),
}
F4_ANGLES = {
    "face_angle": (24.765, 63.212),
    "root_angle": (24.765, 63.212),
    "outer_spiral_angle": (52.576, 31.334),
    "inner_spiral_angle": (36.388, 8.159),
}


@pytest.fixture(scope="module")
def sample_f2() -> PairBlank:
    """F.2: spiral bevel 14/39, face milled, duplex taper. The sample goes on with x_hm1 = 0.505."""
    delta1 = atan2(14.0, 39.0)
    delta2 = radians(90.0) - delta1
    wheel_mean_radius = 176.893 / 2 - 12.7 * cos(delta1)
    cones = pitch_cones(
        shaft_angle=radians(90.0),
        offset=0.0,
        teeth=(14, 39),
        pinion_pitch_angle=delta1,
        wheel_pitch_angle=delta2,
        pinion_spiral_angle=radians(35.0),
        wheel_spiral_angle=radians(35.0),
        pinion_mean_radius=wheel_mean_radius * 14 / 39,
        wheel_mean_radius=wheel_mean_radius,
    )
    return blank_of_cones(
        cones,
        wheel_face_width=25.4,
        cutter_radius=114.3,
        blade_groups=0,
        factors=DepthFactors(addendum=1.0, dedendum=1.25, profile_shift=0.505),
        pinion_hand="left",
        pressure_angle=radians(20.0),
        wheel_addendum_angle=radians(2.1342),
        wheel_dedendum_angle=radians(6.4934),
        pinion_width=EqualFaceWidth(),
    )


@pytest.fixture(scope="module")
def sample_f4() -> PairBlank:
    """F.4: hypoid 9/34, a = 31.75, face hobbed, uniform depth."""
    cones = pitch_cones(
        shaft_angle=radians(90.0),
        offset=31.75,
        teeth=(9, 34),
        pinion_pitch_angle=asin(51.258 / 2 / 61.186),
        wheel_pitch_angle=asin(146.7 / 2 / 82.168),
        pinion_spiral_angle=radians(44.99),
        wheel_spiral_angle=radians(21.009),
        pinion_mean_radius=51.258 / 2,
        wheel_mean_radius=146.7 / 2,
        slope_angle=radians(20.151),
    )
    return blank_of_cones(
        cones,
        wheel_face_width=26.0,
        cutter_radius=76.0,
        blade_groups=13,
        factors=depth_factors(mean_addendum_factor=0.275, depth_factor=2.0, clearance_factor=0.125),
        pinion_hand="left",
        pressure_angle=radians(20.0),
        pinion_width=OerlikonFaceWidth(),
    )


def members(blank: PairBlank) -> tuple[MemberBlank, MemberBlank]:
    return blank.pinion, blank.wheel


def check(
    blank: PairBlank,
    depths: dict[str, object],
    lengths: dict[str, tuple[float, float]],
    angles: dict[str, tuple[float, float]],
) -> None:
    assert blank.depths.working_depth == pytest.approx(depths["hmw"], abs=TOLERANCE)
    assert blank.clearance == pytest.approx(depths["c"], abs=TOLERANCE)
    assert blank.depths.addendum == pytest.approx(depths["ham"], abs=TOLERANCE)
    assert blank.depths.dedendum == pytest.approx(depths["hfm"], abs=TOLERANCE)
    for i, member in enumerate(members(blank)):
        for name, pair in lengths.items():
            assert getattr(member, name) == pytest.approx(pair[i], abs=TOLERANCE), name
        for name, pair in angles.items():
            assert degrees(getattr(member, name)) == pytest.approx(pair[i], abs=TOLERANCE), name


def test_type_2_tooth_data_of_sample_f2() -> None:
    """Table 4: c_ham = 0.24737, k_d = 2, k_c = 0.125."""
    factors = depth_factors(mean_addendum_factor=0.24737, depth_factor=2.0, clearance_factor=0.125)
    assert (factors.addendum, factors.dedendum) == (1.0, 1.25)
    assert factors.profile_shift == pytest.approx(0.505, abs=5e-4)


def test_sample_f2(sample_f2: PairBlank) -> None:
    assert sample_f2.limit_pressure_angle == pytest.approx(0.0, abs=1e-15)
    assert sample_f2.mean_normal_module == pytest.approx(3.213, abs=5e-4)
    assert sample_f2.outer_transverse_module == pytest.approx(4.536, abs=5e-4)
    check(sample_f2, F2_DEPTHS, F2_ENDS, F2_ANGLES)


def test_sample_f4(sample_f4: PairBlank) -> None:
    """F.4 stops its iteration at 1 %: the published cones are taken as they are."""
    cones = sample_f4.cones
    assert degrees(sample_f4.limit_pressure_angle) == pytest.approx(-4.132, abs=TOLERANCE)
    assert degrees(cones.pinion_offset_angle_axial) == pytest.approx(21.647, abs=TOLERANCE)
    assert degrees(cones.offset_angle_pitch_plane) == pytest.approx(23.969, abs=TOLERANCE)
    assert cones.pitch_plane_offset == pytest.approx(33.38, abs=TOLERANCE)
    assert cones.mean_normal_module == pytest.approx(4.028, abs=5e-4)
    assert sample_f4.outer_transverse_module == pytest.approx(4.997, abs=5e-4)
    zeta = sample_f4.face_and_root.root_plane_offset_angle
    assert degrees(zeta) == pytest.approx(21.647, abs=TOLERANCE)
    check(sample_f4, F4_DEPTHS, F4_ENDS, F4_ANGLES)


def test_sample_f4_epicycloid(sample_f4: PairBlank) -> None:
    tooth = crown_gear_tooth(sample_f4.cones, 76.0, 13)
    assert tooth.base_radius == pytest.approx(82.82, abs=TOLERANCE)
    assert degrees(tooth.spiral_angle(96.602)) == pytest.approx(32.362, abs=TOLERANCE)
    assert degrees(tooth.spiral_angle(68.235)) == pytest.approx(7.101, abs=TOLERANCE)
    assert tooth.spiral_angle(82.168) == pytest.approx(radians(21.009), abs=2e-5)


@pytest.mark.parametrize(
    ("fixture", "backlash", "x_smn", "x_hm", "published"),
    [
        (
            "sample_f2",
            ("normal", 0.127),
            0.04575,
            0.50526,
            [(6.465, 7.892, 6.458, 4.955), (3.511, 4.286, 3.511, 1.592)],
        ),
        (
            "sample_f4",
            ("transverse", 0.2),
            0.05,
            0.45,
            [(7.969, 11.267, 7.961, 5.982), (4.524, 4.846, 4.524, 2.221)],
        ),
    ],
)
def test_sample_thicknesses(
    request: pytest.FixtureRequest,
    fixture: str,
    backlash: tuple[str, float],
    x_smn: float,
    x_hm: float,
    published: list[tuple[float, float, float, float]],
) -> None:
    """Clause 7.8; the backlash enters by (206) or (207)."""
    blank: PairBlank = request.getfixturevalue(fixture)
    wheel, alpha = blank.wheel, radians(20.0)
    kind, j = backlash
    spread = j * wheel.mean_cone_distance * cos(wheel.mean_spiral_angle)
    q = spread / (4.0 * blank.mean_normal_module * wheel.outer_cone_distance)
    if kind == "normal":
        q /= cos(alpha) * cos(wheel.outer_spiral_angle)
    for member, sign, expected in zip(members(blank), (1.0, -1.0), published, strict=True):
        s_mn = mean_normal_thickness(
            blank.mean_normal_module,
            thickness_factor=sign * x_smn - q,
            profile_shift=sign * x_hm,
            pressure_angle=alpha,
        )
        thickness = tooth_thickness(
            s_mn,
            pitch_angle=member.pitch_angle,
            spiral_angle=member.mean_spiral_angle,
            mean_pitch_diameter=member.mean_pitch_diameter,
            mean_addendum=member.mean_addendum,
            pressure_angle=alpha,
        )
        found = (
            thickness.mean_normal,
            thickness.mean_transverse,
            thickness.mean_normal_chordal,
            thickness.mean_chordal_addendum,
        )
        assert found == pytest.approx(expected, abs=TOLERANCE)


def test_face_and_root_cones_of_a_bevel_pair_add_up_to_the_shaft_angle(
    sample_f2: PairBlank,
) -> None:
    found = face_and_root_cones(
        sample_f2.cones,
        sample_f2.depths,
        wheel_addendum_angle=radians(2.1342),
        wheel_dedendum_angle=radians(6.4934),
    )
    assert found.face_angle[0] + found.root_angle[1] == pytest.approx(radians(90.0), abs=1e-12)
    assert found.root_angle[0] + found.face_angle[1] == pytest.approx(radians(90.0), abs=1e-12)
