"""The cones laid out in space, in the mounting frame of `_pitch_cones`, against the formulas."""

from __future__ import annotations

from math import atan2, cos, degrees, radians, sin

import numpy as np
import pytest
from in_space import Member, Vec, laid_out, pinion_axes

from hypoid.blank import (
    FaceHobbedInputs,
    GleasonFaceWidth,
    PitchCones,
    depth_factors,
    face_and_root_cones,
    mean_depths,
    pitch_cones,
    solve_aligned_cones,
    split_face_width,
)

CUTTER = 95.0
CASES = [
    (sigma, offset, z1)
    for sigma in (60.0, 75.0, 90.0, 100.0, 120.0)
    for offset in (-10.0, 0.0, 12.5, 30.0, 45.0)
    for z1 in (9, 27)
    # those wheels would be internal gears
    if not (sigma == 120.0 and z1 == 9) and not (sigma > 90.0 and offset < 0.0 and z1 == 9)
]


def solved(sigma: float, offset: float, z1: int) -> PitchCones:
    cones = solve_aligned_cones(
        FaceHobbedInputs(
            z1=z1,
            z2=41,
            shaft_angle=radians(sigma),
            offset=offset,
            wheel_mean_radius=100.0,
            pinion_spiral_angle=radians(46.0),
            cutter_radius=CUTTER,
            blade_groups=7,
        )
    )
    assert cones is not None
    return cones


def tooth_direction(cones: PitchCones, pinion: Member, wheel: Member) -> tuple[Vec, Vec]:
    """Unit tooth direction at P towards the heel, and the unit vector across it to the cutter."""
    e1, n = pinion.generatrix, wheel.normal
    side = np.cross(n, e1)  # where the wheel apex lies with a > 0, seen from the pinion generatrix
    beta = cones.pinion_spiral_angle
    return cos(beta) * e1 - sin(beta) * side, -sin(beta) * e1 - cos(beta) * side


@pytest.mark.parametrize(("sigma", "offset", "z1"), CASES)
def test_both_cones_share_p_and_its_plane(sigma: float, offset: float, z1: int) -> None:
    cones = solved(sigma, offset, z1)
    pinion, wheel = laid_out(cones)
    assert np.abs(pinion.point - wheel.point).max() < 1e-9
    assert np.abs(pinion.normal + wheel.normal).max() < 1e-12
    assert np.abs(np.array(cones.pitch_point) - wheel.point).max() < 1e-12
    assert np.abs(np.array(cones.pitch_plane_normal) - wheel.normal).max() < 1e-15


@pytest.mark.parametrize(("sigma", "offset", "z1"), CASES)
def test_generatrices_enclose_beta_m12(sigma: float, offset: float, z1: int) -> None:
    cones = solved(sigma, offset, z1)
    pinion, wheel = laid_out(cones)
    turn = atan2(
        float(np.cross(wheel.generatrix, pinion.generatrix) @ wheel.normal),
        float(pinion.generatrix @ wheel.generatrix),
    )
    assert turn == pytest.approx(cones.offset_angle_pitch_plane, abs=1e-12)
    difference = cones.pinion_spiral_angle - cones.wheel_spiral_angle
    assert difference == pytest.approx(turn, abs=1e-12)
    assert np.sign(turn) == pytest.approx(np.sign(offset))


@pytest.mark.parametrize(("sigma", "offset", "z1"), CASES)
def test_sliding_at_p_runs_along_the_tooth(sigma: float, offset: float, z1: int) -> None:
    """Condition (1), from velocities: turned by z2 : z1, both members part along the tooth only."""
    cones = solved(sigma, offset, z1)
    pinion, wheel = laid_out(cones)
    along, _ = tooth_direction(cones, pinion, wheel)
    v_pinion = 41 * np.cross(pinion.axis, pinion.point - pinion.apex)
    v_wheel = -z1 * np.cross(wheel.axis, wheel.point - wheel.apex)
    sliding = v_pinion - v_wheel
    across = sliding - (sliding @ along) * along
    assert np.abs(across).max() < 1e-9 * np.abs(v_pinion).max()


@pytest.mark.parametrize(("sigma", "offset", "z1"), CASES)
def test_cutter_centre_is_in_line_with_both_apexes(sigma: float, offset: float, z1: int) -> None:
    """Condition (2), in space: the cutter axis meets the line of the apexes."""
    cones = solved(sigma, offset, z1)
    pinion, wheel = laid_out(cones)
    along, across = tooth_direction(cones, pinion, wheel)
    nu = cones.slope_angle
    centre = pinion.point + CUTTER * (cos(nu) * across + sin(nu) * along)
    gap = np.cross(pinion.apex - wheel.apex, centre - wheel.apex)
    assert np.abs(gap).max() < 1e-9 * CUTTER**2
    # the crown gear's instant centre: the blade's normal at P passes through it
    reach = np.linalg.norm(centre - wheel.apex)
    fixed = reach / (1.0 + 7 * sin(cones.wheel_pitch_angle) / 41)
    instant = wheel.apex + fixed * (centre - wheel.apex) / reach
    assert abs(float((instant - pinion.point) @ along)) < 1e-9 * CUTTER


@pytest.mark.parametrize(("sigma", "offset", "z1"), CASES)
def test_the_canonical_pinion_is_left_handed(sigma: float, offset: float, z1: int) -> None:
    """Seen from the apex, the heel of a left-hand tooth leans counterclockwise."""
    cones = solved(sigma, offset, z1)
    pinion, wheel = laid_out(cones)
    along, _ = tooth_direction(cones, pinion, wheel)

    def lean(member: Member) -> float:
        """Turn about the axis, towards the heel, rad per mm: clockwise from the apex above zero."""
        return float(np.cross(member.axis, member.point - member.apex) @ along)

    assert lean(pinion) < 0.0
    assert lean(wheel) > 0.0


@pytest.mark.parametrize("sigma", [70.0, 90.0, 100.0])
@pytest.mark.parametrize("offset", [-6.0, 0.0, 28.0])
@pytest.mark.parametrize("taper", [(0.0, 0.0), (0.9, 2.6)])
def test_face_and_root_cones_keep_the_clearance(
    sigma: float, offset: float, taper: tuple[float, float]
) -> None:
    """Each pinion cone touches the wheel cone that lies the clearance outside the mating one."""
    cones = solved(sigma, offset, 12)
    depths = mean_depths(
        cones.mean_normal_module,
        depth_factors(mean_addendum_factor=0.35, depth_factor=2.0, clearance_factor=0.125),
    )
    found = face_and_root_cones(
        cones,
        depths,
        wheel_addendum_angle=radians(taper[0]),
        wheel_dedendum_angle=radians(taper[1]),
    )
    _, _, axis1 = pinion_axes(cones)
    crossing1 = np.array([0.0, offset, 0.0])
    s, c = sin(cones.shaft_angle), cos(cones.shaft_angle)

    def distance(pinion_angle: float, t1: float, wheel_angle: float, t2: float) -> float:
        """Gap of the two parallel tangent planes, mm, from the wheel cone to the pinion cone."""
        cos_turn = (sin(pinion_angle) + c * sin(wheel_angle)) / (s * cos(wheel_angle))
        sin_turn = np.sign(offset) * np.sqrt(max(0.0, 1.0 - min(cos_turn, 1.0) ** 2))
        normal = np.array(
            [cos(wheel_angle) * cos_turn, cos(wheel_angle) * sin_turn, -sin(wheel_angle)]
        )
        apex1, apex2 = crossing1 - t1 * axis1, np.array([0.0, 0.0, -t2])
        return float((apex1 - apex2) @ normal)

    tip, root = found.face_apex_beyond_crossing, found.root_apex_beyond_crossing
    face_to_root = distance(found.face_angle[0], tip[0], found.root_angle[1], root[1])
    root_to_face = distance(found.root_angle[0], root[0], found.face_angle[1], tip[1])
    assert face_to_root == pytest.approx(depths.clearance, abs=1e-9)
    assert root_to_face == pytest.approx(depths.clearance, abs=1e-9)


def test_wheel_face_cone_stands_the_addendum_above_p() -> None:
    cones = solved(80.0, 25.0, 12)
    depths = mean_depths(
        cones.mean_normal_module,
        depth_factors(mean_addendum_factor=0.35, depth_factor=2.0, clearance_factor=0.125),
    )
    found = face_and_root_cones(
        cones, depths, wheel_addendum_angle=radians(1.2), wheel_dedendum_angle=radians(2.0)
    )
    delta, big_r = cones.wheel_pitch_angle, cones.wheel_mean_cone_distance
    for height, angle, beyond in (
        (depths.addendum[1], found.face_angle[1], found.face_apex_beyond_crossing[1]),
        (-depths.dedendum[1], found.root_angle[1], found.root_apex_beyond_crossing[1]),
    ):
        z = big_r * cos(delta) - height * sin(delta) - cones.wheel_apex_beyond_crossing
        rho = big_r * sin(delta) + height * cos(delta)
        assert rho * cos(angle) - (z + beyond) * sin(angle) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("sigma", [65.0, 90.0, 100.0])
def test_without_offset_the_cones_are_a_spiral_bevel_pair(sigma: float) -> None:
    """ISO 23509, method 0; and the offset pair runs into it."""
    bevel = solved(sigma, 0.0, 11)
    delta1 = atan2(sin(radians(sigma)), 41 / 11 + cos(radians(sigma)))
    assert bevel.pinion_pitch_angle == pytest.approx(delta1, abs=1e-13)
    assert bevel.wheel_azimuth == bevel.pinion_azimuth == 0.0
    assert bevel.wheel_spiral_angle == bevel.pinion_spiral_angle
    assert bevel.pinion_apex_beyond_crossing == pytest.approx(0.0, abs=1e-10)
    assert bevel.wheel_apex_beyond_crossing == pytest.approx(0.0, abs=1e-10)
    assert bevel.limit_pressure_angle == pytest.approx(0.0, abs=1e-13)
    near = solved(sigma, 1e-6, 11)
    assert near.wheel_pitch_angle == pytest.approx(bevel.wheel_pitch_angle, abs=1e-7)
    assert near.pinion_mean_radius == pytest.approx(bevel.pinion_mean_radius, abs=1e-6)
    # a = r_m1 eta + r_m2 xi to first order
    assert near.wheel_azimuth * 100.0 + near.pinion_azimuth * near.pinion_mean_radius == (
        pytest.approx(1e-6, rel=1e-9)
    )


def test_method_1_face_width_is_the_wheels_without_offset() -> None:
    """(159)-(167) fall back on b1 = b2 for a bevel pair, tapered or not."""
    cones = solved(90.0, 0.0, 11)
    depths = mean_depths(
        cones.mean_normal_module,
        depth_factors(mean_addendum_factor=0.3, depth_factor=2.0, clearance_factor=0.125),
    )
    found = face_and_root_cones(
        cones, depths, wheel_addendum_angle=radians(1.0), wheel_dedendum_angle=radians(3.0)
    )
    wheel = split_face_width(28.0, 0.47)
    pinion = GleasonFaceWidth(depths, found).widths(cones, wheel)
    assert pinion.outer == pytest.approx(wheel.outer, abs=1e-9)
    assert pinion.inner == pytest.approx(wheel.inner, abs=1e-9)


def test_pitch_cones_from_angles_agree_with_the_solver() -> None:
    """Clause 7.2 fed with solved cones gives them back, below and above 90 deg."""
    for sigma in (70.0, 110.0):
        cones = solved(sigma, 22.0, 21)
        again = pitch_cones(
            shaft_angle=cones.shaft_angle,
            offset=cones.offset,
            teeth=cones.teeth,
            pinion_pitch_angle=cones.pinion_pitch_angle,
            wheel_pitch_angle=cones.wheel_pitch_angle,
            pinion_spiral_angle=cones.pinion_spiral_angle,
            wheel_spiral_angle=cones.wheel_spiral_angle,
            pinion_mean_radius=cones.pinion_mean_radius,
            wheel_mean_radius=cones.wheel_mean_radius,
            slope_angle=cones.slope_angle,
        )
        assert again == cones
        assert 0.0 < degrees(again.wheel_azimuth) < 45.0
