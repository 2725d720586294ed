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
from hypoid.geometry import Batch, Batched, Scalar, Vector, cross, dot, sine_cosine, turn_z, unit
from hypoid.machine import Generator, generator, meshing_function, place, sweep

from ._settings_model import BLADE, INDEX, settings_of

STEPS = 40
LIMITS = (1.0, 0.03, 0.03)  # of one step: mm, rad, rad
ARRIVED = 1e-11  # mm and rad
FIXED = 10  # rows before those of n . dr/dp
Unknowns = tuple[Batch, Batch, Batch]


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


def _newton(function: Any, start: Unknowns) -> tuple[Unknowns, tuple[Batch, ...], Any]:
    """Newton in three unknowns with limited steps towards the zero of a function's first three values.

    Returns where it ended, all values there, and their rows of the Jacobian. All points side by side,
    as long as one of them still moves.
    """

    def look(at: Unknowns) -> tuple[tuple[Batch, ...], Any]:
        one, zero = jnp.ones_like(at[0]), jnp.zeros_like(at[0])
        ways = tuple(jnp.stack([one if k == j else zero for k in range(3)]) for j in range(3))

        def push(*direction: Batch) -> Any:
            return jax.jvp(function, at, direction)

        values, slopes = jax.vmap(push, out_axes=(None, 0))(*ways)
        return values, slopes  # slopes[i][k]: value i by unknown k

    def go_on(state: Any) -> Any:
        count, _, move, *_ = state
        still = sum(jnp.abs(d) for d in move) > ARRIVED
        return (count == 0) | ((count < STEPS) & jnp.any(still))

    def step(state: Any) -> Any:
        count, at, move, *_ = state
        at = tuple(a - d for a, d in zip(at, move, strict=True))
        values, j = look(at)
        move = _solved(j, values[:3])
        reach = [jnp.abs(d) / limit for d, limit in zip(move, LIMITS, strict=True)]
        k = 1.0 / jnp.maximum(1.0, jnp.maximum(reach[0], jnp.maximum(reach[1], reach[2])))
        k = jnp.where(jnp.isfinite(k), k, 0.0)
        return count + 1, at, tuple(k * jnp.nan_to_num(d) for d in move), values, j

    # Each turn moves first and looks then, so that what is seen last needs no compiling of its own.
    zero = jnp.zeros_like(start[0])
    seen = (zero,) * len(jax.eval_shape(function, *start))
    rows = (jnp.zeros((3, *zero.shape)),) * len(seen)
    _, at, _, values, j = jax.lax.while_loop(go_on, step, (0, start, (zero,) * 3, seen, rows))
    return at, values, j


def _determinant(j: Any) -> Batch:
    return dot(tuple(j[0]), cross(tuple(j[1]), tuple(j[2])))


def _solved(j: Any, values: Any) -> Unknowns:
    """Solve a batch of 3 x 3 systems: rows j, right-hand side values."""
    rows = [tuple(row) for row in j]
    first, second, third = cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])
    share = 1.0 / dot(rows[0], first)
    return tuple(  # pyright: ignore[reportReturnType]
        share * (values[0] * a + values[1] * b + values[2] * c)
        for a, b, c in zip(first, second, third, strict=True)
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


def _slopes(vector: Any, stick: Stick, which: int, at: Unknowns, normal: Vector) -> Batch:
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


def _turned_normal(vector: Any, stick: Stick, which: int, at: Unknowns) -> tuple[Vector, Vector]:
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

        at, (f, g, h, angle), j = _newton(off, (s, turn, phi))
        position, normal = _turned_normal(vector, stick, 0, at)
        lever = position[0] * normal[1] - position[1] * normal[0]
        slopes = _slopes(vector, stick, 0, at, normal)
        left = jnp.sqrt(f * f + g * g + h * h)
        sense = _determinant(j) / j[0][2]  # of (z, rho) over (s, turn), meshing kept
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
    at, (f, _, g, height), j = _newton(lambda *x: off(vector, *x), start)

    def along(direction: Any) -> Batch:
        moved = jax.jvp(lambda p: off(p, *at), (vector,), (direction,))[1]
        follow = _solved(j, moved[:3])
        return moved[3] - dot(tuple(j[3]), follow)

    slopes = jax.vmap(along)(jnp.eye(vector.shape[0]))
    return at[1], at[2], height, jnp.hypot(f, g), *slopes


# s, turn, phi, angle, left, lever, sense, radial, around, axial (FIXED rows), then n . dr/dp
ROLLED_AT = Batched(_flank_by(True), parameters=2, block=96, most=96)
FORMED_AT = Batched(_flank_by(False), parameters=2, block=8, most=8)
ROOT_AT = Batched(_root, parameters=3, block=4, most=4)
