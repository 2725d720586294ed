"""Pitch cones laid out in space, each from its own angles alone, in the mounting frame."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from hypoid.blank import PitchCones

Vec = NDArray[np.float64]


@dataclass(frozen=True)
class Member:
    """One pitch cone in frame G, mm."""

    axis: Vec
    apex: Vec
    point: Vec
    generatrix: Vec
    normal: Vec


def pinion_axes(cones: PitchCones) -> tuple[Vec, Vec, Vec]:
    s, c = sin(cones.shaft_angle), cos(cones.shaft_angle)
    x1, z1 = np.array([-c, 0.0, s]), np.array([s, 0.0, c])
    return x1, np.cross(z1, x1), z1


def laid_out(cones: PitchCones) -> tuple[Member, Member]:
    """Both members, each from its own angles alone."""

    def member(
        x: Vec, y: Vec, z: Vec, origin: Vec, cone: tuple[float, float, float, float]
    ) -> Member:
        delta, azimuth, distance, beyond = cone
        radial = cos(azimuth) * x + sin(azimuth) * y
        generatrix = sin(delta) * radial + cos(delta) * z
        apex = origin - beyond * z
        normal = cos(delta) * radial - sin(delta) * z
        return Member(z, apex, apex + distance * generatrix, generatrix, normal)

    x1, y1, z1 = pinion_axes(cones)
    pinion = member(
        x1,
        y1,
        z1,
        np.array([0.0, cones.offset, 0.0]),
        (
            cones.pinion_pitch_angle,
            cones.pinion_azimuth,
            cones.pinion_mean_cone_distance,
            cones.pinion_apex_beyond_crossing,
        ),
    )
    x2, y2, z2 = np.eye(3)
    wheel = member(
        x2,
        y2,
        z2,
        np.zeros(3),
        (
            cones.wheel_pitch_angle,
            cones.wheel_azimuth,
            cones.wheel_mean_cone_distance,
            cones.wheel_apex_beyond_crossing,
        ),
    )
    return pinion, wheel
