"""Rounded tips: a flank ends on an arc that is tangent to it and to the top land.

With b the angle between the outward normals of flank and land and r the radius, the arc begins r tan(b/2) before the
sharp edge would stand, and falls away from the flank by r - sqrt(r^2 - d^2) at d beyond that. The strip in which a
loaded arc touches is narrower than usual cells are: it gets its own (see `_strips`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from hypoid.contact import AngleField, angle_field
from hypoid.flank import Border, Flank

Array = np.ndarray[Any, Any]
ASTRAY = 0.05  # mm: a tip may bend so far from the straight line that it is taken for
STEEPEST = np.radians(70.0)  # against the flank: where an arc is no longer looked at


@dataclass(frozen=True, eq=False)
class Arc:
    """A rounded tip in the tangent plane of a contact, straight there."""

    line: Array  # (3,) c0 + c1 along + c2 across: mm inside the sharp edge
    angle: float  # between the outward normals of flank and land, rad
    radius: float  # mm

    @property
    def start(self) -> float:
        """Where the arc begins, mm inside the sharp edge."""
        return self.radius * float(np.tan(0.5 * self.angle))

    def apart(self, plane: Array) -> Array:
        """How far (n,), mm, points (n, 2) of the plane lie inside the sharp edge."""
        return self.line[0] + plane @ self.line[1:]

    def falls_away(self, plane: Array) -> Array:
        """How far (n,), mm, the arc lies below the flank at points (n, 2) of the plane."""
        return falls_away(self.apart(plane), self.angle, self.radius)


@lru_cache(maxsize=64)
def active_field(flank: Flank, rounding: float) -> AngleField:
    """The angle field of a flank, going on beyond its tip as far as an arc of that radius can stand out."""
    field = angle_field(flank)
    if not rounding > 0.0:
        return field
    tip = field.tip
    beyond = rounding + ASTRAY
    return replace(field, tip=Border(float(tip.height) + beyond, float(tip.slope)))


def land_angle(flank: Flank, normal: Array, point: Array) -> Array:
    """Angle (n,), rad, between outward normals (n, 3) of a flank at points (n, 3) and its top land's; member frame."""
    slope, sine, cosine = (float(v) for v in (flank.tip.slope, flank.cone.sine, flank.cone.cosine))
    along = (-slope * cosine - sine) / np.hypot(1.0, slope)
    outward = (-slope * sine + cosine) / np.hypot(1.0, slope)
    radius = np.hypot(point[:, 0], point[:, 1])
    radial = (normal[:, 0] * point[:, 0] + normal[:, 1] * point[:, 1]) / radius
    return np.arccos(np.clip(along * normal[:, 2] + outward * radial, -1.0, 1.0))


def falls_away(apart: Array, angle: float, radius: float) -> Array:
    """How far (n,), mm, an arc lies below the flank `apart` (n,) inside the sharp edge; infinite beyond its end."""
    beyond = radius * np.tan(0.5 * angle) - apart
    most = radius * np.sin(min(angle, float(STEEPEST)))
    on_arc = np.clip(beyond, 0.0, most)
    return np.where(beyond > most, np.inf, radius - np.sqrt(radius**2 - on_arc**2))
