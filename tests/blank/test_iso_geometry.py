"""Blanks of all four methods against space geometry and against each method's own meaning."""

from __future__ import annotations

from dataclasses import replace
from math import atan, cos, degrees, pi, radians, sin
from typing import Any

import numpy as np
import pytest
from in_space import laid_out

from hypoid.blank import (
    BlankRequest,
    DepthFactors,
    TypeI,
    crown_gear_tooth,
    iso_blank,
    mean_addendum_factor,
    thickness_factor,
    undercut_limits,
)
from hypoid.geometry import DesignError

TAPERS: tuple[Any, ...] = ("standard", "uniform", "duplex", "modified")
CASES = [
    (method, sigma, offset, groups)
    for method in (1, 2, 3)
    for sigma in (60.0, 75.0, 90.0, 105.0, 120.0)
    for offset in (0.0, 8.0, 20.0)
    for groups in (0, 11)
]


def request_of(method: Any, sigma: float, offset: float, groups: int) -> BlankRequest:
    return BlankRequest(
        method, 21, 37, radians(sigma), offset, 28.0, 95.0, radians(33.0),
        wheel_outer_diameter=210.0, blade_groups=groups,
        taper="uniform" if groups else "standard",
    )  # fmt: skip


@pytest.mark.parametrize(("method", "sigma", "offset", "groups"), CASES)
def test_cones_share_a_plane_along_the_pitch_line(
    method: int, sigma: float, offset: float, groups: int
) -> None:
    cones = iso_blank(request_of(method, sigma, offset, groups)).cones
    pinion, wheel = laid_out(cones)
    assert np.abs(pinion.point - wheel.point).max() < 1e-9
    assert np.abs(pinion.normal + wheel.normal).max() < 1e-12
    # (113) from the radii gives the same azimuth as the cones were found with
    assert cones.wheel_spiral_angle == pytest.approx(radians(33.0), abs=1e-12)
    turn = cones.pinion_spiral_angle - cones.wheel_spiral_angle
    assert turn == pytest.approx(cones.offset_angle_pitch_plane, abs=1e-10)
    # the tooth ratio: what both pitch velocities have across the tooth
    across = [
        teeth * radius * cos(beta)
        for teeth, radius, beta in (
            (37, cones.pinion_mean_radius, cones.pinion_spiral_angle),
            (21, cones.wheel_mean_radius, cones.wheel_spiral_angle),
        )
    ]
    assert across[0] == pytest.approx(across[1], abs=1e-9)


@pytest.mark.parametrize("sigma", [60.0, 90.0, 112.0])
@pytest.mark.parametrize("groups", [0, 11])
def test_without_offset_every_method_is_method_0(sigma: float, groups: int) -> None:
    """Only method 1 keeps the wheel's mean radius of its first guess, so its P is not mid-face."""
    bevel = iso_blank(replace(request_of(0, sigma, 0.0, groups)))
    for method in (2, 3):
        other = iso_blank(request_of(method, sigma, 0.0, groups))
        assert other.wheel.pitch_angle == pytest.approx(bevel.wheel.pitch_angle, abs=1e-12)
        assert other.pinion.outer_tip_diameter == pytest.approx(
            bevel.pinion.outer_tip_diameter, abs=1e-9
        )
    one = iso_blank(request_of(1, sigma, 0.0, groups))
    assert one.wheel.pitch_angle == pytest.approx(bevel.wheel.pitch_angle, abs=1e-12)
    assert one.wheel.outer_pitch_diameter == pytest.approx(210.0, abs=1e-9)


@pytest.mark.parametrize("offset", [8.0, 20.0])
def test_method_1_has_no_second_order_sliding(offset: float) -> None:
    """Limit pressure angle and limit curvature from velocities alone.

    Along a tooth line of that curvature, and on a flank of that pressure angle, the normal part of the
    relative velocity stays zero to second order. (33) has a factor sec(alpha_lim): its radius stands
    square to the flank, the tooth line's own is shorter by cos(alpha_lim).
    """
    cones = iso_blank(request_of(1, 90.0, offset, 0)).cones
    pinion, wheel = laid_out(cones)
    radius = 95.0 * cos(cones.limit_pressure_angle)
    beta, e1, n = cones.pinion_spiral_angle, pinion.generatrix, wheel.normal
    side = np.cross(n, e1)
    along = cos(beta) * e1 - sin(beta) * side
    across = -sin(beta) * e1 - cos(beta) * side

    def sliding(step: float, alpha: float) -> float:
        """Relative velocity along the flank's normal at a point of the tooth line, step mm on."""
        turn = step / radius
        point = pinion.point + radius * (sin(turn) * along + (1.0 - cos(turn)) * across)
        square = cos(turn) * across - sin(turn) * along
        normal = cos(alpha) * square + sin(alpha) * n
        v1 = 37 * np.cross(pinion.axis, point - pinion.apex)
        v2 = -21 * np.cross(wheel.axis, point - wheel.apex)
        return float((v1 - v2) @ normal)

    # at the limit pressure angle, and only there, the normal speed is stationary along the tooth
    limit = -cones.limit_pressure_angle
    speeds = np.array([[sliding(s, a) for s in (-0.01, 0.01)] for a in (limit, -limit)])
    rates = np.abs(speeds[:, 1] - speeds[:, 0]) / 0.02
    assert rates.min() < 1e-6 * rates.max()


@pytest.mark.parametrize("taper", TAPERS)
@pytest.mark.parametrize("sigma", [75.0, 90.0, 110.0])
def test_tapers(taper: Any, sigma: float) -> None:
    blank = iso_blank(replace(request_of(0, sigma, 0.0, 0), taper=taper))
    wheel, pinion = blank.wheel, blank.pinion
    total = wheel.dedendum_angle + pinion.dedendum_angle
    if taper == "uniform":
        assert total == pytest.approx(0.0, abs=1e-12)
        assert wheel.outer_dedendum == pytest.approx(wheel.inner_dedendum, abs=1e-12)
    if taper == "standard":  # both root lines run to the pitch apex
        for member in (wheel, pinion):
            root = atan(member.mean_dedendum / member.mean_cone_distance)
            assert member.dedendum_angle == pytest.approx(root, abs=1e-12)
    if taper == "duplex":  # slots of constant width at the roots: AGMA 929's, from other formulas
        from hypoid.blank import slot_geometry

        slots = slot_geometry(blank, crown_gear_tooth(blank.cones, 95.0, 0)).slots
        mean = [widths[1] for widths in slots]
        # (C.5) is the tangent at the mean point of what the cutter does along the face
        ends = [0.5 * (widths[0] + widths[2]) for widths in slots]
        assert ends == pytest.approx(mean, rel=0.12)
    if taper == "modified":
        standard = iso_blank(replace(request_of(0, sigma, 0.0, 0), taper="standard"))
        duplex = iso_blank(replace(request_of(0, sigma, 0.0, 0), taper="duplex"))
        sums = [b.wheel.dedendum_angle + b.pinion.dedendum_angle for b in (standard, duplex)]
        assert total == pytest.approx(min(1.3 * sums[0], sums[1]), abs=1e-12)


def test_duplex_angles_of_sample_f2() -> None:
    """ISO 23509, F.2: theta_a2 = 2.1342, theta_f2 = 6.4934 deg, from the guide values."""
    blank = iso_blank(
        BlankRequest(
            0, 14, 39, pi / 2, 0.0, 25.4, 114.3, radians(35.0),
            wheel_outer_diameter=176.893, taper="duplex",
        )
    )  # fmt: skip
    wheel = blank.wheel
    found = degrees(wheel.addendum_angle), degrees(wheel.dedendum_angle)
    assert found == pytest.approx((2.1342, 6.4934), abs=1e-4)


def test_guide_values_of_sample_f2() -> None:
    """ISO 23509, F.2: c_ham = 0.24737, k_t = 0.0915."""
    delta1 = atan(14 / 39)
    assert mean_addendum_factor((14, 39), (delta1, pi / 2 - delta1)) == pytest.approx(
        0.24737, abs=5e-6
    )
    assert thickness_factor((14, 39)) == pytest.approx(0.0915, abs=5e-5)


def test_undercut_limit_of_a_straight_bevel_pinion_is_the_spur_gears() -> None:
    """Without spiral and taper the bound is 1.1 k_hap - z_v sin^2(alpha)/2, z_v the virtual teeth."""
    factors = DepthFactors(1.0, 1.25, 0.2)
    request = replace(
        request_of(0, 90.0, 0.0, 0), spiral_angle=0.0, taper="uniform", tooth=TypeI(factors), z1=9
    )
    blank = iso_blank(request)
    limits = undercut_limits(blank, factors, crown_gear_tooth(blank.cones, 1e7, 0))
    delta1 = blank.pinion.pitch_angle
    virtual = 9 / cos(delta1)
    for limit in limits[:2]:
        share = limit.cone_distance / blank.pinion.mean_cone_distance
        expected = 1.1 - virtual * share * sin(radians(20.0)) ** 2 / 2.0
        assert limit.limit == pytest.approx(expected, abs=1e-4)
    assert [limit.kept for limit in limits] == [False, limits[1].limit <= 0.2, True, True]


def test_a_form_cut_wheel_has_no_undercut_limit() -> None:
    blank = iso_blank(request_of(1, 90.0, 15.0, 0))
    tooth = crown_gear_tooth(blank.cones, 95.0, 0)
    limits = undercut_limits(blank, DepthFactors(1.0, 1.25, 0.3), tooth, wheel_generated=False)
    assert {limit.member for limit in limits} == {"pinion"}


@pytest.mark.parametrize(
    ("change", "path"),
    [
        ({"wheel_mean_diameter": 180.0}, "wheel.outer_pitch_diameter"),
        ({"wheel_outer_diameter": None}, "wheel.outer_pitch_diameter"),
        ({"method": 0}, "pair.offset"),
        ({"offset": 130.0}, "pair.offset"),
        ({"shaft_angle": radians(150.0)}, "pair.shaft_angle"),
        ({"cutter_radius": 20.0, "method": 2}, "cutting.cutter_radius"),
        ({"spiral_angle": radians(85.0)}, "wheel.mean_spiral_angle"),
        ({"z2": 11}, "wheel.teeth"),
    ],
)
def test_impossible_requests_name_the_number(change: dict[str, Any], path: str) -> None:
    with pytest.raises(DesignError) as caught:
        iso_blank(replace(request_of(1, 90.0, 15.0, 0), **change))
    assert caught.value.problems[0].path == path


def test_every_bad_number_of_a_request_is_told_at_once() -> None:
    bad = replace(
        request_of(1, 90.0, 15.0, 0), z1=0, shaft_angle=4.0, wheel_face_width=-1.0, blade_groups=-2,
        pressure_angles=(1.0, 0.3), cutter_radius=float("nan"),
    )  # fmt: skip
    with pytest.raises(DesignError) as caught:
        iso_blank(bad)
    assert len(caught.value.problems) == 6
