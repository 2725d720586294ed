"""A flank's deviation in the shop's words: angles, crowning, bias, and what they leave."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.contact import six_terms

from ._grid import FlankNodes

Array = np.ndarray[Any, Any]
LEAST = 6  # points that six terms need


@dataclass(frozen=True)
class Topography:
    """Second-order parts of a deviation map over its grid, at the grid's middle; NaN where points are too few.

    The part is turned so that the smooth map is zero there.
    Angles are changes of the flank's own, rad: positive where the pressure or spiral angle is too large.
    Crownings are mm at the grid's border: positive where the ends (tip and root, toe and heel) fall back.
    Bias is mm at the corners: positive where heel-tip and toe-root stand out.
    """

    pressure_angle: float
    spiral_angle: float
    profile_crowning: float
    lengthwise_crowning: float
    bias: float
    residual: float  # mm rms that the six terms leave


def topography(nodes: FlankNodes, deviation: Array) -> Topography:
    """Parts of a deviation (rows, columns), mm along nominal normals."""
    value = np.asarray(deviation, float).reshape(nodes.shape)
    if np.isfinite(value).sum() < LEAST:
        return Topography(*(float("nan"),) * 6)
    x, y = coordinates(nodes)
    lever = nodes.lever.reshape(nodes.shape)
    fit, left = six_terms(value, x, y)
    for _ in range(2):  # a turn of the part is no error of form
        value = value - lever * fit[0] / lever[nodes.reference]
        fit, left = six_terms(value, x, y)
    half_face, half_depth = half_sizes(nodes)
    pressure, spiral = _angles(nodes, fit[1] / half_face, fit[2] / half_depth)
    return Topography(
        pressure_angle=pressure,
        spiral_angle=spiral,
        profile_crowning=float(-fit[4]),
        lengthwise_crowning=float(-fit[3]),
        bias=float(fit[5]),
        residual=float(np.sqrt(np.nanmean(left**2))),
    )


def half_sizes(nodes: FlankNodes) -> tuple[float, float]:
    """Half the grid's length and mean depth, mm."""
    depth = nodes.height[-1] - nodes.height[0]
    return 0.5 * float(nodes.distance[0, -1] - nodes.distance[0, 0]), 0.5 * float(depth.mean())


def coordinates(nodes: FlankNodes) -> tuple[Array, Array]:
    """Grid coordinates (rows, columns) in [-1, 1], toe to heel and root to tip, straight in S and H."""
    half_face, half_depth = half_sizes(nodes)
    middle = 0.5 * (nodes.height[0] + nodes.height[-1])
    x = (nodes.distance - nodes.distance[0].mean()) / half_face
    return x, (nodes.height - middle) / half_depth


def _angles(nodes: FlankNodes, by_distance: float, by_height: float) -> tuple[float, float]:
    """Changes of pressure and spiral angle, rad, at the reference point, of slopes along S and H."""
    point, normal = (v.reshape(*nodes.shape, 3) for v in nodes.own)
    row, column = nodes.reference
    r, n = point[row, column], normal[row, column]
    cone = nodes.flank.cone
    sine, cosine = float(cone.sine), float(cone.cosine)
    out = np.array([r[0], r[1], 0.0]) / math.hypot(r[0], r[1])
    axis, around = np.array([0.0, 0.0, 1.0]), np.array([-out[1], out[0], 0.0])
    along, up = sine * out + cosine * axis, cosine * out - sine * axis

    def tangent(direction: Array) -> Array:
        """Of the flank, going on by one along S or H alone."""
        return direction - around * (n @ direction) / (n @ around)

    t = np.array([tangent(along), tangent(up), n])
    slope = np.linalg.solve(t, [by_distance, by_height, 0.0])

    def angles(normal: Array) -> Array:
        normal = normal / np.linalg.norm(normal)
        spiral = math.atan2(abs(normal @ along), abs(normal @ around))
        return np.array([math.asin(normal @ up), spiral])

    h = 1e-4 / max(1e-12, float(np.linalg.norm(slope)))
    pressure, spiral = (angles(n - h * slope) - angles(n + h * slope)) / (2.0 * h)
    return float(pressure), float(spiral)
