"""What holds for every pair: one sentence of theory each."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from math import atan2, cos, degrees, pi, radians, sin
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from hypoid.blank import FaceHobbedInputs, PairBlank, pair_blank, solve_aligned_cones
from hypoid.blank._cone_solver import bracketed_root
from hypoid.geometry import DesignError

QUICK = settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.filter_too_much]
)


@st.composite
def designs(draw: st.DrawFn) -> dict[str, Any]:
    radius = draw(st.floats(20.0, 400.0))
    z1 = draw(st.integers(5, 17))
    z2 = draw(st.integers(int(1.5 * z1), 9 * z1))
    sigma = draw(st.floats(60.0, 120.0))
    assume(z1 / z2 + cos(radians(sigma)) > 0.05)
    return {
        "z1": z1,
        "z2": z2,
        "shaft_angle": radians(sigma),
        "offset": radius * draw(st.floats(-0.15, 0.4)),
        "wheel_mean_radius": radius,
        "wheel_face_width": 0.25 * radius,
        "pinion_spiral_angle": radians(draw(st.floats(30.0, 55.0))),
        "cutter_radius": radius * draw(st.floats(0.6, 1.4)),
        "blade_groups": draw(st.integers(1, 13)),
    }


def blank_or_skip(design: dict[str, Any]) -> PairBlank:
    """The blank; a design without one is passed over, any other exception is a failure."""
    blank: PairBlank | None = None
    with suppress(DesignError):
        blank = pair_blank(**design)
    assume(blank is not None)
    assert blank is not None
    return blank


@QUICK
@given(designs())
def test_both_conditions_hold(design: dict[str, Any]) -> None:
    blank = blank_or_skip(design)
    assert abs(blank.ratio_residual) < 1e-12 * design["wheel_mean_radius"]
    assert abs(blank.alignment_residual) < 1e-12


@QUICK
@given(designs())
def test_cones_touch(design: dict[str, Any]) -> None:
    """At P both axes and the pitch plane give back the shaft angle and the offset."""
    blank = blank_or_skip(design)
    cones = blank.cones
    d1, d2, b12 = (
        cones.pinion_pitch_angle,
        cones.wheel_pitch_angle,
        cones.offset_angle_pitch_plane,
    )
    opened = cos(d1) * cos(d2) * cos(b12) - sin(d1) * sin(d2)
    assert opened == pytest.approx(cos(cones.shaft_angle), abs=1e-12)
    offset = cones.pinion_mean_radius * sin(cones.pinion_azimuth)
    offset += cones.wheel_mean_radius * sin(cones.wheel_azimuth)
    assert offset == pytest.approx(cones.offset, abs=1e-10)


@QUICK
@given(designs())
def test_the_mirror_pair_differs_in_its_hands_only(design: dict[str, Any]) -> None:
    left = blank_or_skip(design)
    right = pair_blank(**design, pinion_hand="right")
    assert (right.pinion.hand, right.wheel.hand) == ("right", "left")
    swapped = replace(
        right,
        pinion=replace(right.pinion, hand="left"),
        wheel=replace(right.wheel, hand="right"),
    )
    assert swapped == left


@QUICK
@given(designs(), st.floats(0.1, 10.0))
def test_lengths_scale_and_angles_stay(design: dict[str, Any], scale: float) -> None:
    first = solve_aligned_cones(inputs(design))
    assume(first is not None)
    assert first is not None
    lengths = ("offset", "wheel_mean_radius", "cutter_radius")
    second = solve_aligned_cones(inputs({**design, **{k: scale * design[k] for k in lengths}}))
    assert second is not None
    assert second.wheel_pitch_angle == pytest.approx(first.wheel_pitch_angle, abs=1e-10)
    assert second.wheel_azimuth == pytest.approx(first.wheel_azimuth, abs=1e-10)
    assert second.pinion_mean_radius == pytest.approx(scale * first.pinion_mean_radius, rel=1e-10)


@settings(QUICK, max_examples=15)
@given(designs())
def test_cones_follow_the_offset_from_the_bevel_pair(design: dict[str, Any]) -> None:
    """The branch is the one that a = 0 starts from: no jump of delta2 on the way."""
    z1, z2, sigma = design["z1"], design["z2"], design["shaft_angle"]
    previous = atan2(sin(sigma), z1 / z2 + cos(sigma))
    for step in range(1, 9):
        cones = solve_aligned_cones(inputs({**design, "offset": design["offset"] * step / 8}))
        assume(cones is not None)
        assert cones is not None
        assert degrees(abs(cones.wheel_pitch_angle - previous)) < 15.0
        previous = cones.wheel_pitch_angle


def inputs(design: dict[str, Any]) -> FaceHobbedInputs:
    return FaceHobbedInputs(**{k: v for k, v in design.items() if k != "wheel_face_width"})


def test_bracketed_root_meets_its_tolerance() -> None:
    assert bracketed_root(cos, 0.0, pi) == pytest.approx(pi / 2, abs=1e-15)
    assert bracketed_root(lambda x: x**3 - 2.0, 0.0, 2.0) == pytest.approx(2 ** (1 / 3), abs=1e-15)
    assert bracketed_root(lambda x: x, 0.0, 1.0) == 0.0
    assert bracketed_root(lambda x: -1.0 if x < 0.3 else 1.0, 0.0, 1.0) == pytest.approx(0.3)
