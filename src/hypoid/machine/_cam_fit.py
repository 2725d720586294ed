"""An unknown cam from the angles a flank was designed for, and those angles of any face-milled flank.

The spiral and pressure angle of a ground flank at its mean point depend on the ratio of roll, so the
design's angles tell C/r_u of the cam that ground it [notes on lin1996, machine constants].
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from hypoid.geometry import DesignError, Problem

from ._settings import MachineSettings, chain

STEP = 1e-5  # rad, of central differences in the cradle angle
SCAN = 31  # ratios tried first, 4.7 % apart: from farther off than 8 % the search loses its flank


@dataclass(frozen=True)
class StraightBlade:
    """One straight side of a face mill or cup wheel; mm, rad."""

    side: Literal["inside", "outside"]
    point_radius: float  # where the flank meets the plane of the tips
    angle: float  # against the cutter axis


@dataclass(frozen=True)
class DesignAngles:
    """Angles on the pitch cone, rad: spiral positive in the member's own hand, pressure positive."""

    spiral: float
    pressure: float


@dataclass(frozen=True)
class MeanPoint:
    """Where on the member: axial place z and radius (mm) on a pitch cone of that angle (rad)."""

    z: float
    radius: float
    pitch_angle: float


@dataclass(frozen=True)
class DesignFlank:
    """One flank ground with the unknown cam, and the angles it was designed for."""

    settings: MachineSettings  # with a cam: its pitch radius is the unknown
    blade: StraightBlade
    at: MeanPoint
    angles: DesignAngles


@dataclass(frozen=True)
class CamFit:
    """The cam that suits the design angles best, with what is left of each angle (rad)."""

    offset_to_radius: float  # C/r_u
    pitch_radius: float  # mm, at the C of the settings
    left: tuple[DesignAngles, ...]


def mean_point_angles(
    settings: MachineSettings, blade: StraightBlade, at: MeanPoint
) -> DesignAngles:
    """Spiral and pressure angle of a face-milled flank at one place, from the plain matrices.

    Solves the meshing condition and the place for (u, theta, phi), or for (u, theta) if nothing
    rolls; a place that the flank does not reach is a `DesignError`.
    """
    q, s_r = settings.cradle_angle, settings.radial_distance
    toward = math.atan2(s_r * math.sin(q), at.z / math.cos(at.pitch_angle) - s_r * math.cos(q))
    start = [0.0, math.pi / 2 - q + settings.swivel_angle - toward, 0.0]
    free = 3 if settings.generated else 2

    def off(unknown: np.ndarray[Any, Any]) -> list[float]:
        u, theta, phi = [*unknown, 0.0][:3]
        point, normal, rate = _flank(settings, blade, 100.0 * u, theta, phi)
        place = [point[2] - at.z, math.hypot(point[0], point[1]) - at.radius]
        meshing = [float(normal @ rate)] if settings.generated else []
        return [*place, *meshing]

    from scipy.optimize import fsolve  # late: a command that fits nothing starts without it

    unknown, _, status, _ = fsolve(off, start[:free], xtol=1e-13, full_output=True)
    if status != 1 and max(abs(value) for value in off(unknown)) > 1e-6:
        given = f"z = {at.z:.6g} mm, radius = {at.radius:.6g} mm"
        raise DesignError([Problem("mean point", given, "a point of the flank", "mid-face")])
    u, theta, phi = [*unknown, 0.0][:3]
    point, normal, _ = _flank(settings, blade, 100.0 * u, theta, phi)
    return _angles(point, normal, at.pitch_angle)


def fit_cam(flanks: Sequence[DesignFlank]) -> CamFit:
    """C/r_u of the one cam that ground all these flanks, by least squares over their angles.

    The cam in the settings is a guess; what comes out lies between half and twice its C/r_u.
    """
    cams = [flank.settings.cam for flank in flanks]
    if not cams or any(cam is None for cam in cams):
        found = Problem("fit_cam", "a flank without a cam", "flanks ground with a cam", "No. 463")
        raise DesignError([found])
    cam = next(cam for cam in cams if cam is not None)
    offset, first = float(cam.swivel_offset), float(cam.swivel_offset) / float(cam.pitch_radius)

    def left(ratio: float) -> list[DesignAngles]:
        angles: list[DesignAngles] = []
        for flank in flanks:
            assert flank.settings.cam is not None
            ground = replace(flank.settings.cam, pitch_radius=offset / ratio)
            settings = replace(flank.settings, cam=ground)
            got = mean_point_angles(settings, flank.blade, flank.at)
            spiral = got.spiral - flank.angles.spiral
            angles.append(DesignAngles(spiral, got.pressure - flank.angles.pressure))
        return angles

    def residuals(ratio: np.ndarray[Any, Any]) -> list[float]:
        try:
            return [value for a in left(float(ratio[0])) for value in (a.spiral, a.pressure)]
        except DesignError:  # no such place on a flank: farther off than any angle
            return [1.0] * (2 * len(flanks))

    starts = first * np.geomspace(0.5, 2.0, SCAN)
    start = min(starts, key=lambda ratio: float(np.square(residuals(np.array([ratio]))).sum()))
    from scipy.optimize import least_squares

    best = float(least_squares(residuals, [start], x_scale=first, diff_step=1e-5).x[0])
    return CamFit(best, offset / best, tuple(left(best)))


def _flank(
    settings: MachineSettings, blade: StraightBlade, u: float, theta: float, phi: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Point, unit normal (out of the tooth) and dr/dphi in the left-hand member's frame."""
    side, sine, cosine = _signs(blade)
    edge = np.array([blade.point_radius + side * u * sine, 0.0, -u * cosine, 1.0])
    normal = np.array([-side * cosine, 0.0, -sine])
    at = chain(settings, theta, phi)
    ahead, behind = (chain(settings, theta, phi + d) @ edge for d in (STEP, -STEP))
    return (at @ edge)[:3], at[:3, :3] @ normal, ((ahead - behind) / (2.0 * STEP))[:3]


def _signs(blade: StraightBlade) -> tuple[float, float, float]:
    return 1.0 if blade.side == "outside" else -1.0, math.sin(blade.angle), math.cos(blade.angle)


def _angles(
    point: np.ndarray[Any, Any], normal: np.ndarray[Any, Any], pitch_angle: float
) -> DesignAngles:
    c, s, radius = math.cos(pitch_angle), math.sin(pitch_angle), math.hypot(point[0], point[1])
    outward = np.array([point[0] / radius, point[1] / radius, 0.0])
    around = np.array([-outward[1], outward[0], 0.0])
    up = c * outward - s * np.array([0.0, 0.0, 1.0])
    along = s * outward + c * np.array([0.0, 0.0, 1.0])
    trace = np.cross(normal, up)
    trace = trace if trace @ along > 0.0 else -trace
    # left hand: towards the heel the tooth falls back against the turn about +z
    spiral = -math.atan2(float(trace @ around), float(trace @ along))
    return DesignAngles(spiral, math.asin(float(normal @ up)))
