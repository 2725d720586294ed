"""One face-hobbed flank as a function of a vector: the settings of `_settings_model` and a stick blade.

The last three entries are the blade radius at the pitch point P, the blade angle and the edge's
curvature. What the shop does not move between tries (groups, hook, rake, eccentric angle, height of P)
goes beside it as a `Stick`.

As for a face-milled flank, a change of any entry moves the flank by n . dr/dp at fixed parameters of
the surface, the cradle angle among them: so one rigidly carried point gives the derivatives by every
setting and motion. Edge parameter, turn and cradle angle are sought together, by Newton in three
unknowns with limited steps, from where the last look ended: every motion is free, and one compiled
function serves every method.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import jax
import jax.numpy as jnp

from hypoid.cutter import EdgePiece, stick_edges
from hypoid.flank import PitchCone
from hypoid.geometry import Batch, Batched, Scalar, Vector, dot, sine_cosine, turn_z, unit
from hypoid.machine import Generator, generator, meshing_function, place, sweep

from ._newton_sweep import Turns, determinant, newton_sweep, solved
from ._settings_model import BLADE, INDEX, settings_of

LIMITS = (1.0, 0.03, 0.03)  # of one step: mm, rad, rad
FIXED = 10  # rows before those of n . dr/dp


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Stick:
    """What stands fixed of a stick blade and its head; mm and rad."""

    ratio: Scalar  # R_b = N_b/z
    height: Scalar  # h_f, of P above the tips
    eccentric_angle: Scalar
    hook_angle: Scalar
    rake_angle: Scalar
    side: Scalar  # +1 outer blade, -1 inner blade
    phase: Scalar  # turn of the blade about the cutter's axis


def _generator(vector: Any, stick: Stick) -> Generator:
    settings = replace(settings_of(vector), roll_to_blade_ratio=stick.ratio)
    return generator(settings, axes_move=True)


def stick_pieces(vector: Any, stick: Stick) -> tuple[EdgePiece, EdgePiece]:
    """Flank and flat of the blade of a vector."""
    radius, angle, bend = (vector[INDEX[name]] for name in BLADE)
    return stick_edges(
        radius,
        angle,
        bend,
        height=stick.height,
        eccentric_angle=stick.eccentric_angle,
        hook_angle=stick.hook_angle,
        rake_angle=stick.rake_angle,
        side=stick.side,
        phase=stick.phase,
    )


def _carried(
    vector: Any, stick: Stick, which: int, s: Batch, turn: Batch, phi: Batch
) -> tuple[Vector, Vector, Batch]:
    """Points and normals (not unit) of the blade's flank (0) or flat (1), and the member's own turn.

    Before that turn, in the member's frame.
    """
    gen = _generator(vector, stick)
    at = place(gen, sweep(gen, stick_pieces(vector, stick)[which], s, turn), turn, phi)
    return at.point, at.normal, at.turn


def _slopes(vector: Any, stick: Stick, which: int, at: Turns, normal: Vector) -> Batch:
    """N . dr/dp of points, one row for each entry of the vector."""

    def point(p: Any) -> Vector:
        r, _, own = _carried(p, stick, which, *at)
        sine, cosine = sine_cosine(-own)
        return turn_z(cosine, sine, r)

    def along(direction: Any) -> Batch:
        return dot(jax.jvp(point, (vector,), (direction,))[1], normal)

    return jax.vmap(along)(jnp.eye(vector.shape[0]))


def _sought(vector: Any, stick: Stick, which: int, rolled: bool) -> Any:
    """Function of (s, turn, phi): what meshing leaves (mm), z, rho and angle of the blade's point."""

    def at(s: Batch, turn: Batch, phi: Batch) -> tuple[Batch, ...]:
        point, _, own = _carried(vector, stick, which, s, turn, phi)
        x, y, z = point
        left = phi
        if rolled:
            gen = _generator(vector, stick)
            edge = sweep(gen, stick_pieces(vector, stick)[which], s, turn)
            value, normal = meshing_function(gen, edge, phi)
            left = value / jnp.sqrt(dot(normal, normal))
        return left, z, jnp.hypot(x, y), jnp.arctan2(y, x) - own

    return at


def _turned_normal(vector: Any, stick: Stick, which: int, at: Turns) -> tuple[Vector, Vector]:
    """Points and unit normals in the member's frame."""
    point, normal, own = _carried(vector, stick, which, *at)
    sine, cosine = sine_cosine(-own)
    return turn_z(cosine, sine, point), turn_z(cosine, sine, unit(normal))


def _flank_by(rolled: bool) -> Any:
    def flank(
        vector: Any,
        stick: Stick,
        z: Batch,
        rho: Batch,
        s: Batch,
        turn: Batch,
        phi: Batch,
    ) -> tuple[Batch, ...]:
        """The flank at places (z, rho), from where Newton starts: FIXED rows, then n . dr/dp."""
        sought = _sought(vector, stick, 0, rolled)

        def off(*at: Batch) -> tuple[Batch, ...]:
            left, at_z, at_rho, angle = sought(*at)
            return left, at_z - z, at_rho - rho, angle

        at, (f, g, h, angle), j = newton_sweep(off, (s, turn, phi), LIMITS)
        position, normal = _turned_normal(vector, stick, 0, at)
        lever = position[0] * normal[1] - position[1] * normal[0]
        slopes = _slopes(vector, stick, 0, at, normal)
        left = jnp.sqrt(f * f + g * g + h * h)
        sense = determinant(j) / j[0][2]  # of (z, rho) over (s, turn), meshing kept
        return *at, angle, left, lever, sense, *_around(position, normal), *slopes

    flank.__qualname__ = f"hobbed flank, {'rolled' if rolled else 'form cut'}"
    return flank


def _around(position: Vector, normal: Vector) -> Vector:
    """The normal's radial, tangential and axial parts."""
    rho = jnp.hypot(position[0], position[1])
    radial = (position[0] * normal[0] + position[1] * normal[1]) / rho
    around = (position[0] * normal[1] - position[1] * normal[0]) / rho
    return radial, around, normal[2]


def _root(
    vector: Any, stick: Stick, cone: PitchCone, distance: Batch, turn: Batch, phi: Batch
) -> tuple[Batch, ...]:
    """Turn, phi, height and what is left at cone distances S, then dH/dp: the path of the sharp corner.

    A curve, not a surface: its height at S changes by the implicit function theorem.
    """

    def off(p: Any, s: Batch, theta: Batch, roll: Batch) -> tuple[Batch, ...]:
        left, z, rho, _ = _sought(p, stick, 1, rolled=True)(s, theta, roll)
        reached, height = cone.cone_distance_height(z, rho)
        return left, s, reached - distance, height

    start = (jnp.zeros_like(distance), turn, phi)
    at, (f, _, g, height), j = newton_sweep(lambda *x: off(vector, *x), start, LIMITS)

    def along(direction: Any) -> Batch:
        moved = jax.jvp(lambda p: off(p, *at), (vector,), (direction,))[1]
        follow = solved(j, moved[:3])
        return moved[3] - dot(tuple(j[3]), follow)

    slopes = jax.vmap(along)(jnp.eye(vector.shape[0]))
    return at[1], at[2], height, jnp.hypot(f, g), *slopes


# s, turn, phi, angle, left, lever, sense, radial, around, axial (FIXED rows), then n . dr/dp
ROLLED_AT = Batched(_flank_by(True), parameters=2, block=96, most=96)
FORMED_AT = Batched(_flank_by(False), parameters=2, block=8, most=8)
ROOT_AT = Batched(_root, parameters=3, block=4, most=4)
