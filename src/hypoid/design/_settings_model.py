"""One face-milled flank as a function of a vector: settings, motions and blade, all traced by JAX.

The vector holds what `NAMES` says, in mm and rad and the signs of the generator chain. Which of its
entries are free is the caller's affair: the compiled function is one and the same for every method.

A change of any entry moves the flank by n . dr/dp at fixed parameters of the surface, since the
envelope's own shift is tangential [notes on lin1996: sensitivity is n . dr/dp]: so derivatives are
exact and need no second solve.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.cutter import EdgePiece, mill_edge
from hypoid.flank import PitchCone, Surface, axial_radial_angle, newton_pair, position_and_normal
from hypoid.geometry import Batch, Batched, Scalar, dot
from hypoid.machine import MachineSettings, Motions, Way, generator

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
NEWTON = 20


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


def _surface(vector: Any, branch: Scalar, outward: Scalar) -> Surface:
    way: Way = "cutter"
    return Surface(generator(settings_of(vector), axes_move=True), branch, outward, way)


def _slopes(point_of: Any, vector: Any, normal: Any) -> Any:
    """N . dr/dp of points, one row for each entry of the vector."""
    directions = jnp.eye(vector.shape[0])

    def along(direction: Any) -> Batch:
        moved = jax.jvp(point_of, (vector,), (direction,))[1]
        return dot(moved, normal)

    return jax.vmap(along)(directions)


def _flank(
    vector: Any,
    branch: Scalar,
    outward: Scalar,
    side: Scalar,
    reference: Scalar,
    z: Batch,
    rho: Batch,
    s: Batch,
    turn: Batch,
) -> tuple[Batch, ...]:
    """s, turn, angle, what is left (mm), lever, sense, and n . dr/dp of the flank at places (z, rho)."""

    def place(a: Batch, b: Batch) -> tuple[Batch, ...]:
        surface, edge = _surface(vector, branch, outward), edge_of(vector, side, reference)
        at_z, at_rho, angle = axial_radial_angle(surface, edge, a, b)
        return at_z - z, at_rho - rho, angle

    (s, turn), (f, g, angle), j = newton_pair(place, (s, turn), (1.0, 0.03), NEWTON)

    def point(p: Any) -> Any:
        surface, edge = _surface(p, branch, outward), edge_of(p, side, reference)
        return position_and_normal(surface, edge, s, turn)

    position, normal = point(vector)
    lever = position[0] * normal[1] - position[1] * normal[0]
    slopes = _slopes(lambda p: point(p)[0], vector, normal)
    return s, turn, angle, jnp.hypot(f, g), lever, j[0] * j[3] - j[1] * j[2], *slopes


def _root(
    vector: Any,
    branch: Scalar,
    cone: PitchCone,
    side: Scalar,
    distance: Batch,
    turn: Batch,
) -> tuple[Batch, ...]:
    """Height of the root that the blade's tips cut at cone distances S, mm, and dH/dp.

    The envelope of the plane of the tips along the circle of the sharp corner.
    """
    s = jnp.zeros_like(distance)

    def tip(p: Any) -> EdgePiece:
        radius = p[INDEX["point_radius"]]
        zero, one = 0.0 * radius, 1.0 + 0.0 * radius
        return EdgePiece(
            (radius, zero, zero),
            (side * one, zero, zero),
            (zero, zero, one),
            zero,
            zero,
            zero,
            zero,
            zero,
        )

    def place(a: Batch, b: Batch) -> tuple[Batch, ...]:
        surface = _surface(vector, branch, 1.0)
        z, rho, _ = axial_radial_angle(surface, tip(vector), a, b)
        reached, height = cone.cone_distance_height(z, rho)
        return a, reached - distance, height

    (s, turn), (_, left, height), _ = newton_pair(place, (s, turn), (1.0, 0.03), NEWTON)

    def point(p: Any) -> Any:
        return position_and_normal(_surface(p, branch, 1.0), tip(p), s, turn)

    position, normal = point(vector)
    rho = jnp.hypot(position[0], position[1])
    radial = (position[0] * normal[0] + position[1] * normal[1]) / rho
    up = radial * cone.cosine - normal[2] * cone.sine
    slopes = _slopes(lambda p: point(p)[0], vector, normal)
    return turn, height, jnp.abs(left), *(slope / up for slope in slopes)


flank_at = Batched(_flank, parameters=5, block=32, most=96)
root_at = Batched(_root, parameters=4, block=16, most=16)
