"""Pressure and spiral angle that a flank really has, from its normal."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ._flank import Flank


@dataclass(frozen=True)
class FlankAngles:
    """Pressure angle against the pitch cone's normal and spiral angle against its generatrix, rad.

    The spiral angle is positive where the tooth leans to its member's hand, as zerol teeth do on one flank alone.
    """

    pressure: float
    spiral: float


def flank_angles(flank: Flank, distance: float | None = None, height: float = 0.0) -> FlankAngles:
    """Angles at a place (S, H), mm; the mean point if none is given. NaN where there is no flank."""
    middle = 0.5 * (flank.toe + flank.heel) if distance is None else distance
    points = flank.at_cone([middle], [height])
    (x, y, _), (nx, ny, nz) = points.position[0], points.normal[0]
    rho = math.hypot(x, y)
    radial, around = (x * nx + y * ny) / rho, (x * ny - y * nx) / rho
    sine, cosine = float(flank.cone.sine), float(flank.cone.cosine)
    along, up = sine * radial + cosine * nz, cosine * radial - sine * nz
    turned = along * np.sign(around) * (-1.0 if flank.mirrored else 1.0)
    return FlankAngles(float(np.arcsin(up)), float(np.arctan2(turned, abs(around))))
