"""How a pair is mounted: one rigid motion from the pinion's frame to the wheel's, and its errors.

Everything is computed for the canonical pair (left-hand pinion, right-hand wheel); a pair of the
other hand is its mirror image and has the same numbers. The wheel, too, is read as a left-hand
member (y -> -y), so that both flanks come from the generator unmirrored. Frame G is that of
hypoid.blank: z along the wheel axis, x so that the pinion axis lies parallel to the x-z plane.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import jax
import numpy as np

from hypoid.flank import Flank
from hypoid.geometry import Batch, Scalar, Vector, namespace
from hypoid.pair import Direction, GearPair


@dataclass(frozen=True)
class Misalignment:
    """Errors of mounting; mm and rad [gonzalez2022, Fig. 6; design, section 3]."""

    offset: float = 0.0  # dE, positive increases the offset
    pinion_axial: float = 0.0  # dP, positive withdraws the pinion
    wheel_axial: float = 0.0  # dG, positive withdraws the wheel
    shaft_angle: float = 0.0  # dSigma, positive opens the shaft angle


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Mounting:
    """Pinion frame to wheel frame, and the turns that bring both pitch points together.

    ``sense`` is +1 for drive and -1 for coast: the canonical pinion drives by turning backwards
    about its axis. Pinion and wheel angles count in the direction of travel.
    """

    axes: tuple[Vector, Vector, Vector]  # rows: rotation from the pinion frame (left-hand wheel)
    shift: Vector  # pinion crossing point in the wheel frame, mm
    sense: Scalar
    pinion_zero: Scalar  # turn of the pinion at pinion angle zero, rad
    wheel_zero: Scalar  # lead of the wheel when both pitch points meet, rad
    ratio: Scalar  # z1/z2
    half_pitch: Scalar  # of the wheel, rad: a lead beyond it belongs to another tooth


@lru_cache(maxsize=64)
def _pitch_point_angle(flank: Flank, distance: float) -> float:
    """Angle of the mean point about its own axis, read as a left-hand member, rad."""
    _, _, angle = flank.parameters([distance], [0.0])
    return float(angle[0])


def mounting(
    pair: GearPair, direction: Direction, misalignment: Misalignment | None = None
) -> Mounting:
    """The mounting of a pair for one direction of travel, with its errors if any."""
    error = misalignment or Misalignment()
    cones = pair.blank.cones
    sigma = cones.shaft_angle + error.shaft_angle
    c, s = math.cos(sigma), math.sin(sigma)
    sense = 1.0 if direction == "drive" else -1.0
    pinion, wheel = pair.mates(direction)

    pinion_angle = _pitch_point_angle(pinion, cones.pinion_mean_cone_distance)
    wheel_angle = _pitch_point_angle(wheel, cones.wheel_mean_cone_distance)
    out = error.pinion_axial
    return Mounting(
        axes=((-c, 0.0, s), (0.0, 1.0, 0.0), (s, 0.0, c)),  # pyright: ignore
        shift=(  # pyright: ignore
            out * s,
            -(cones.offset + error.offset),
            out * c - error.wheel_axial,
        ),
        sense=sense,
        pinion_zero=cones.pinion_azimuth - pinion_angle,
        wheel_zero=sense * (cones.wheel_azimuth + wheel_angle),
        ratio=pair.ratio,
        half_pitch=math.pi / pair.wheel.teeth,
    )


def to_wheel(mount: Mounting, phi: Batch, v: Vector, *, free: bool = False) -> Vector:
    """Carry a point (or, if free, a direction) of the pinion at pinion angle phi to the wheel frame."""
    xp = namespace(phi, v)
    turn = mount.pinion_zero - mount.sense * phi
    cosine, sine = xp.cos(turn), xp.sin(turn)
    x, y, z = cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1], v[2]
    turned = tuple(row[0] * x + row[1] * y + row[2] * z for row in mount.axes)
    if free:
        return turned  # pyright: ignore[reportReturnType]
    return tuple(a + b for a, b in zip(turned, mount.shift, strict=True))  # pyright: ignore


def to_pinion(mount: Mounting, phi: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Inverse of ``to_wheel`` for points (n, 3) at pinion angles (n,); left-hand frames, mm."""
    axes = np.array([[float(c) for c in row] for row in mount.axes])
    held = (v - np.array([float(c) for c in mount.shift])) @ axes
    turn = mount.pinion_zero - mount.sense * np.asarray(phi)
    c, s = np.cos(turn), np.sin(turn)
    x, y = held[..., 0], held[..., 1]
    return np.stack([c * x + s * y, c * y - s * x, held[..., 2]], axis=-1)
