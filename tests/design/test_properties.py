"""Any face-hobbed design that has a blank: the exact system cuts its pitch point on both members."""

from __future__ import annotations

from math import degrees, radians

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.flank import PointStatus
from hypoid.geometry import DesignError
from hypoid.pair import GearPair


@st.composite
def designs(draw: st.DrawFn) -> ExactFaceHobbedSpec:
    """Shaft angle 60 to 110 deg, ratio 3 to 12, offset up to 0.3 of the wheel's radius."""
    ratio = draw(st.floats(3.0, 12.0))
    teeth = draw(st.integers(max(5, round(40 / ratio)), 16))
    radius = draw(st.floats(50.0, 200.0))
    return ExactFaceHobbedSpec(
        title="any",
        source="hypothesis",
        assumed=(),
        shaft_angle=radians(draw(st.floats(60.0, 110.0))),
        offset=radius * draw(st.floats(0.0, 0.3)),
        pinion_teeth=teeth,
        wheel_teeth=round(ratio * teeth),
        pinion_hand=draw(st.sampled_from(["left", "right"])),
        pinion_spiral_angle=radians(draw(st.floats(30.0, 60.0))),
        wheel_mean_radius=radius,
        wheel_face_width=0.25 * radius,
        mean_addendum_factor=draw(st.floats(0.3, 0.5)),
        depth_factor=1.75,
        clearance_factor=0.125,
        cutter_radius=radius * draw(st.floats(0.6, 1.2)),
        blade_groups=draw(st.sampled_from([5, 7, 11, 13])),
        pressure_angle=radians(20.0),
        tip_edge_radius_factor=0.2,
        tip_relief=None,
        marking_thickness=0.0065,
    )


def build_or_pass(spec: ExactFaceHobbedSpec) -> GearPair:
    try:
        return build(spec)
    except DesignError as error:
        assume(not error.problems)
        raise


@settings(max_examples=8, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(designs())
def test_both_members_are_cut_at_the_pitch_point(spec: ExactFaceHobbedSpec) -> None:
    pair = build_or_pass(spec)
    for member in (pair.pinion, pair.wheel):
        distance = member.blank.mean_cone_distance
        z, rho = (float(v) for v in member.concave.cone.axial_radial(distance, 0.0))
        assert rho == pytest.approx(member.blank.mean_pitch_diameter / 2.0, rel=1e-12)
        for flank in (member.concave, member.convex):
            points = flank.at_cone(distance, 0.0)
            assert points.status.tolist() == [PointStatus.OK]
        concave = member.concave.at_cone(distance, 0.0)
        assert concave.position[0] == pytest.approx([rho, 0.0, z], abs=1e-8)


@settings(max_examples=25, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(designs())
def test_pressure_and_spiral_angles_at_the_pitch_point(spec: ExactFaceHobbedSpec) -> None:
    """20 deg in the normal section and the blank's spiral angle: the slope angle's sign is right."""
    pair = build_or_pass(spec)
    for member in (pair.pinion, pair.wheel):
        delta = member.blank.pitch_angle
        up = np.array([np.cos(delta), 0.0, -np.sin(delta)])  # out of the pitch cone at P
        along = np.array([np.sin(delta), 0.0, np.cos(delta)])
        _, normal = member.concave.at_cutter([0.0], [member.concave.theta_start])
        assert degrees(np.arcsin(normal[0] @ up)) == pytest.approx(20.0, abs=1e-7)
        line = np.cross(normal[0], up)
        spiral = np.arccos(abs(line @ along) / np.linalg.norm(line))
        assert spiral == pytest.approx(member.blank.mean_spiral_angle, abs=1e-9)
        leans = np.sign((line @ along) * line[1])  # from apex to heel, to -y on a left-hand member
        assert leans == (-1.0 if member.blank.hand == "left" else 1.0)
