"""The pinion that a wheel flank would generate: points of its conjugate, closed form for any wheel.

The wheel itself is the generating gear: its cradle turns about the wheel's axis and the pinion rolls
with it at the tooth ratio. In the chain's words that is a machine root angle of Sigma - 90 deg and a
blank offset of a, so that the generator's own meshing condition serves [notes on vimercati2005: the
pinion on a cradle along the gear's axis].
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Protocol

import jax.numpy as jnp
import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import Flank, PitchCone
from hypoid.geometry import Batch, Batched, Scalar
from hypoid.machine import (
    Generator,
    MachineSettings,
    SweptEdge,
    generator,
    mesh_closed,
    place_plain,
)

Array = np.ndarray[Any, Any]
COLUMNS, ROWS = 13, 7
FOLDING = 0.05  # of the grid's sense at the mean point: nearer to a fold nothing counts
INSET = 0.02  # of face width and depth: the grid stays off the wheel's outline


@dataclass(frozen=True)
class Conjugate:
    """Points of a pinion flank conjugate to a wheel's, left hand; mm and rad, (n,) each."""

    z: Array
    rho: Array
    angle: Array  # about the pinion axis
    lever: Array  # (r x n) . axis, which turns an angle into a normal distance
    distance: Array  # S on the pinion
    height: Array  # H on the pinion
    roll: Array  # cradle angle, which is the wheel's angle, at which the point meshes
    cradle_point: Array  # (n, 3) the wheel's point in the cradle frame
    there: Array  # bool: generated at all, and on the pinion's blank
    middle: int  # the point next to the mean point


class CutterPlace(Protocol):
    """Where a form-cut wheel's cutter stands; mm and rad, signs of the generator chain."""

    @property
    def radial_distance(self) -> float: ...
    @property
    def cradle_angle(self) -> float: ...
    @property
    def machine_root_angle(self) -> float: ...
    @property
    def machine_center_to_back(self) -> float: ...
    @property
    def sliding_base(self) -> float: ...


def facing_settings(
    cut: CutterPlace, blank: PairBlank, height: float, roll_to_blade_ratio: float = 0.0
) -> MachineSettings:
    """Settings of a pinion cutter that stands on a form-cut wheel's cutter axis and faces it.

    On a cradle along the wheel's axis; its plane lies ``height`` mm beyond the wheel cutter's [notes on
    vimercati2005, baseline pinion: blades of the opposite kind].
    """
    root = cut.machine_root_angle
    sine, cosine = math.sin(root), math.cos(root)
    along = cut.radial_distance * math.cos(cut.cradle_angle)
    x = sine * along + cosine * (cut.sliding_base + height)
    y = -cut.radial_distance * math.sin(cut.cradle_angle)
    z = sine * (height + cut.sliding_base) - cosine * along + cut.machine_center_to_back
    q = math.atan2(-y, x)
    return MachineSettings(
        radial_distance=math.hypot(x, y),
        cradle_angle=q,
        machine_root_angle=blank.shaft_angle - 0.5 * math.pi,
        ratio_of_roll=blank.wheel.teeth / blank.pinion.teeth,
        roll_to_blade_ratio=roll_to_blade_ratio,
        tilt_angle=0.5 * math.pi - root,
        swivel_angle=q - 0.5 * math.pi,
        blank_offset=blank.offset,
        sliding_base=-z,
    )


def wheel_as_cradle(blank: PairBlank) -> MachineSettings:
    """Settings under which a wheel's teeth, carried by the cradle, generate the pinion."""
    z1, z2 = blank.cones.teeth
    return MachineSettings(
        radial_distance=0.0,
        cradle_angle=0.0,
        machine_root_angle=blank.shaft_angle - 0.5 * math.pi,
        ratio_of_roll=z2 / z1,
        roll_to_blade_ratio=0.0,
        blank_offset=blank.offset,
    )


def _conjugate(gen: Generator, branch: Scalar, *rows: Batch) -> tuple[Batch, ...]:
    """z, rho, angle, lever and discriminant from cradle points and two tangents (nine rows)."""
    edge = SweptEdge(rows[0:3], rows[3:6], rows[6:9])  # pyright: ignore[reportArgumentType]
    mesh = mesh_closed(gen, edge, branch)
    at = place_plain(gen, edge, 0.0 * rows[0], mesh)
    x, y, z = at.point
    rho = jnp.hypot(x, y)
    length = jnp.sqrt(sum(n * n for n in at.normal))
    lever = (x * at.normal[1] - y * at.normal[0]) / length
    return z, rho, jnp.arctan2(y, x) - at.turn, lever, mesh.discriminant, at.phi


_conjugated = Batched(_conjugate, parameters=2, block=32, most=96)


def conjugate(blank: PairBlank, wheel: Flank, pinion_cone: PitchCone) -> Conjugate:
    """The conjugate of a wheel flank over a grid of its active part."""
    distance = np.linspace(wheel.toe, wheel.heel, COLUMNS)
    inset = INSET * (wheel.heel - wheel.toe)
    distance = np.clip(distance, wheel.toe + inset, wheel.heel - inset)
    high = wheel.tip.at(distance)
    along = distance - blank.wheel.mean_cone_distance
    mate = blank.pinion.mean_addendum + along * math.tan(blank.pinion.addendum_angle)
    share = np.linspace(INSET, 1.0 - INSET, ROWS)[:, None]
    height = -mate + share * (high + mate)
    points = wheel.at_cone(np.broadcast_to(distance, height.shape), height)
    flip = wheel.hand * np.array([1.0, 1.0, -1.0])  # to the cradle's frame: z against the wheel's
    position, normal = points.position * flip, -points.normal * flip
    along, swing = _tangents(normal)
    rows = [*position.T, *along.T, *swing.T]
    gen = generator(wheel_as_cradle(blank))
    # of both roots the one that meets the pinion's tooth, near the centre of roll
    found = [_conjugated(gen, branch, *rows) for branch in (1.0, -1.0)]
    scores = [_miss(values, pinion_cone, blank) for values in found]
    z, rho, angle, lever, discriminant, roll = found[int(np.argmin(scores))]
    cone_distance, cone_height = pinion_cone.cone_distance_height(z, rho)
    there = points.ok & (points.piece == wheel.cut_pieces.index("flank"))  # not its fillet
    there &= ~points.other
    there &= (discriminant > 0.0) & np.isfinite(z)
    own = blank.pinion
    there &= (cone_distance > own.inner_cone_distance) & (cone_distance < own.outer_cone_distance)
    tip = own.mean_addendum + (cone_distance - own.mean_cone_distance) * math.tan(
        own.addendum_angle
    )
    there &= cone_height < tip
    off = np.hypot(cone_distance - own.mean_cone_distance, cone_height)
    middle = int(np.argmin(np.where(there, off, np.inf)))
    there &= _unfolded(cone_distance, cone_height, middle)
    return Conjugate(
        z, rho, angle, lever, cone_distance, cone_height, roll, position, there, middle
    )


def _unfolded(distance: Array, height: Array, middle: int) -> Array:
    """Where the wheel's grid lies on the pinion in one sense: beyond, the conjugate is undercut."""
    shape = (ROWS, COLUMNS)
    along: list[Array] = [np.gradient(v.reshape(shape), axis=1) for v in (distance, height)]  # pyright: ignore
    across: list[Array] = [np.gradient(v.reshape(shape), axis=0) for v in (distance, height)]  # pyright: ignore
    sense = (along[0] * across[1] - along[1] * across[0]).ravel()
    return sense / sense[middle] > FOLDING


def _tangents(normal: Array) -> tuple[Array, Array]:
    """Two vectors whose product is the normal, at each point."""
    axis = np.where(np.abs(normal[:, 2:]) < 0.7, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
    along = np.cross(normal, axis)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    return along, np.cross(normal, along)


def _miss(values: Array, cone: PitchCone, blank: PairBlank) -> float:
    """How far from the pinion's mean point a root's points lie, mm, with the turn weighed in."""
    distance, height = cone.cone_distance_height(values[0], values[1])
    off = np.hypot(distance - blank.pinion.mean_cone_distance, height)
    off = np.where(values[4] > 0.0, off + 10.0 * np.abs(values[5]), np.nan)
    return float(np.nanmedian(off)) if np.isfinite(off).any() else np.inf
