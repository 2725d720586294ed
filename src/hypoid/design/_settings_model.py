"""One face-milled flank as a function of a vector: settings, motions and blade, all traced by JAX.

The vector holds what `NAMES` says, in mm and rad and the signs of the generator chain. Which of its
entries are free is the caller's affair: the compiled function is one and the same for every method.

A place (z, rho) on the flank is found by Newton in all three parameters of the sweep, edge, cutter's turn
and cradle's turn, with the meshing condition among the equations: it is singular where the flank
itself is (undercut), and nowhere else, however the lines of contact run.

A change of any entry moves the flank by n . dr/dp at fixed parameters of the sweep, since every one of
them moves the point within the surface [notes on lin1996: sensitivity is n . dr/dp]: so derivatives are
exact and need no second solve. How the edge parameter at a place moves follows from the implicit function.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.cutter import EdgePiece, mill_edge
from hypoid.flank import PitchCone
from hypoid.geometry import (
    Batch,
    Batched,
    Scalar,
    Vector,
    dot,
    once,
    sine_cosine,
    turn_z,
    unit,
)
from hypoid.machine import (
    MachineSettings,
    Motions,
    Placed,
    generator,
    meshing_function,
    place,
    sweep,
)

from ._newton_sweep import Turns, determinant, newton_sweep, solved

SETTINGS = (
    "radial_distance", "cradle_angle", "tilt_angle", "swivel_angle", "blank_offset",
    "machine_root_angle", "machine_center_to_back", "sliding_base", "ratio_of_roll", "helical_motion",
)  # fmt: skip
ROLL = tuple(f"modified_roll_{order}" for order in range(2, 7))  # c2 ... c6
MOVED = (
    "radial_distance", "tilt_angle", "swivel_angle", "blank_offset", "machine_root_angle",
    "machine_center_to_back",
)  # fmt: skip
MOTION_ORDERS = 2
MOTIONS = tuple(f"{name}_{order}" for name in MOVED for order in range(1, MOTION_ORDERS + 1))
BASE = ("sliding_base_2", "sliding_base_3")  # beside the helical motion
BLADE = ("point_radius", "blade_angle", "blade_curvature")
NAMES = (*SETTINGS, *ROLL, *MOTIONS, *BASE, *BLADE)
INDEX = {name: k for k, name in enumerate(NAMES)}
ANGLES = frozenset(
    name for name in NAMES if name.rsplit("_", 1)[0] in ("tilt_angle", "swivel_angle", "machine_root_angle")
) | {"cradle_angle", "tilt_angle", "swivel_angle", "machine_root_angle", "blade_angle"}  # fmt: skip
LIMITS = (1.0, 0.05, 0.05)  # of one Newton step in edge (mm), cutter's and cradle's turn (rad)


def vector_of(settings: MachineSettings, blade: dict[str, float]) -> np.ndarray:
    """The vector of a flank's settings and its blade (``BLADE`` by name; mm, rad, 1/mm)."""
    values = (
        dict.fromkeys(NAMES, 0.0) | {name: getattr(settings, name) for name in SETTINGS} | blade
    )
    values |= dict(zip(ROLL, settings.modified_roll, strict=False))
    for name in MOVED:
        for order, value in enumerate(getattr(settings.motions, name)[:MOTION_ORDERS], start=1):
            values[f"{name}_{order}"] = value
    first, *more = [*settings.motions.sliding_base, 0.0, 0.0, 0.0][:3]
    values["helical_motion"] += first
    values |= dict(zip(BASE, more, strict=True))
    return np.array([float(values[name]) for name in NAMES])


def settings_of(vector: Any) -> MachineSettings:
    """Settings of a vector; its entries may be traced."""
    values = {name: vector[INDEX[name]] for name in SETTINGS}

    def powers(name: str) -> tuple[Any, ...]:
        return tuple(vector[INDEX[f"{name}_{k}"]] for k in range(1, MOTION_ORDERS + 1))

    base = (0.0, *(vector[INDEX[name]] for name in BASE))
    return MachineSettings(
        **values,
        roll_to_blade_ratio=0.0,
        modified_roll=tuple(vector[INDEX[name]] for name in ROLL),
        motions=Motions(**{name: powers(name) for name in MOVED}, sliding_base=base),
    )


def edge_of(vector: Any, side: Scalar, reference: Scalar) -> EdgePiece:
    """The cutting edge of a vector; ``side`` +1 for the outside blade, -1 for the inside blade.

    ``reference`` is the height, mm, above the tips where a curved blade has its angle; s = 0 is there.
    """
    radius, angle, bend = (vector[INDEX[name]] for name in BLADE)
    return mill_edge(radius, angle, bend, side=side, reference_height=reference)


def _placed(vector: Any, edge: EdgePiece, at: Turns) -> Placed:
    """Points of the sweep before the work's own turn."""
    gen = generator(settings_of(vector), axes_move=True)
    s, theta, phi = at
    return place(gen, sweep(gen, edge, s, theta), theta, phi)


def _met(vector: Any, edge: EdgePiece, at: Turns) -> tuple[Batch, Batch, Batch, Batch]:
    """Meshing condition (mm per rad of the cradle, square to the flank), z, rho and angle."""
    gen = generator(settings_of(vector), axes_move=True)
    s, theta, phi = at
    swept = sweep(gen, edge, s, theta)
    rate, normal = meshing_function(gen, swept, phi)
    x, y, z = (there := place(gen, swept, theta, phi)).point
    rate = rate / jnp.sqrt(dot(normal, normal))
    return rate, z, jnp.sqrt(x * x + y * y), jnp.arctan2(y, x) - there.turn


def _position(vector: Any, edge: EdgePiece, at: Turns) -> Vector:
    there = _placed(vector, edge, at)
    sine, cosine = sine_cosine(-there.turn)
    return turn_z(cosine, sine, there.point)


def _position_and_normal(
    vector: Any, edge: EdgePiece, at: Turns, outward: Scalar
) -> tuple[Vector, Vector]:
    """Points (mm) and unit normals out of the tooth, left-hand member's frame."""
    there = _placed(vector, edge, at)
    sine, cosine = sine_cosine(-there.turn)
    x, y, z = unit(there.normal)
    normal = (outward * x, outward * y, outward * z)
    return turn_z(cosine, sine, there.point), turn_z(cosine, sine, normal)


def _slopes(point_of: Any, vector: Any, normal: Any) -> Any:
    """N . dr/dp of points, one row for each entry of the vector."""
    directions = jnp.eye(vector.shape[0])

    def along(direction: Any) -> Batch:
        moved = jax.jvp(point_of, (vector,), (direction,))[1]
        return dot(moved, normal)

    return jax.vmap(along)(directions)


def _flank(
    vector: Any,
    outward: Scalar,
    side: Scalar,
    reference: Scalar,
    z: Batch,
    rho: Batch,
    s: Batch,
    theta: Batch,
    phi: Batch,
) -> tuple[Batch, ...]:
    """s, both turns, angle, what is left (mm), lever and sense of the flank at (z, rho); by every entry
    n . dr/dp, and then ds/dp.
    """

    def place_at(*at: Batch) -> tuple[Batch, ...]:
        rate, at_z, at_rho, angle = _met(vector, edge_of(vector, side, reference), at)
        return at_z - z, at_rho - rho, rate, angle

    at, (f, g, rate, angle), rows = newton_sweep(place_at, (s, theta, phi), LIMITS)
    edge = edge_of(vector, side, reference)
    position, normal = once(_position_and_normal(vector, edge, at, outward))
    lever = position[0] * normal[1] - position[1] * normal[0]
    radial = (position[0] * normal[0] + position[1] * normal[1]) / rho

    def by(direction: Any) -> tuple[Batch, Batch]:
        def met(p: Any) -> tuple[Batch, ...]:
            return _met(p, edge_of(p, side, reference), at)

        rate, at_z, at_rho, angle = jax.jvp(met, (vector,), (direction,))[1]
        moved = normal[2] * at_z + radial * at_rho + lever * angle
        return moved, -solved(rows, (at_z, at_rho, rate))[0]

    slopes, along = jax.vmap(by)(jnp.eye(vector.shape[0]))
    left = jnp.sqrt(f * f + g * g + rate * rate)
    return *at, angle, left, lever, determinant(rows), *slopes, *along


def _root(
    vector: Any, cone: PitchCone, side: Scalar, distance: Batch, theta: Batch, phi: Batch
) -> tuple[Batch, ...]:
    """Both turns, height of the root that the blade's tips cut at cone distances S, mm, and dH/dp.

    The envelope of the plane of the tips along the circle of the sharp corner.
    """

    def tip(p: Any) -> EdgePiece:
        radius = p[INDEX["point_radius"]]
        zero, one = 0.0 * radius, 1.0 + 0.0 * radius
        along, metal = (side * one, zero, zero), (zero, zero, one)
        return EdgePiece((radius, zero, zero), along, metal, zero, zero, zero, zero, zero)

    def place_at(*at: Batch) -> tuple[Batch, ...]:
        rate, z, rho, _ = _met(vector, tip(vector), at)
        reached, height = cone.cone_distance_height(z, rho)
        return at[0], reached - distance, rate, height

    start = (jnp.zeros_like(distance), theta, phi)
    at, (_, left, rate, height), _ = newton_sweep(place_at, start, LIMITS)
    position, normal = _position_and_normal(vector, tip(vector), at, 1.0)
    radius = jnp.hypot(position[0], position[1])
    radial = (position[0] * normal[0] + position[1] * normal[1]) / radius
    up = radial * cone.cosine - normal[2] * cone.sine
    slopes = _slopes(lambda p: _position(p, tip(p), at), vector, normal)
    return at[1], at[2], height, jnp.hypot(left, rate), *(slope / up for slope in slopes)


flank_at = Batched(_flank, parameters=4, block=32, most=96)
root_at = Batched(_root, parameters=3, block=8, most=8)
