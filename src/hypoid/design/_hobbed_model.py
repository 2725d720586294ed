"""One face-hobbed flank as a function of a vector: the settings of `_settings_model` and a stick blade.

The last three entries are the blade radius at the pitch point P, the blade angle and the edge's
curvature. What the shop does not move between tries (groups, hook, rake, eccentric angle, height of P)
goes beside it as a `Stick`.

As for a face-milled flank, a change of any entry moves the flank by n . dr/dp at fixed parameters of
the surface, the cradle angle among them: so one rigidly carried point gives the derivatives by every
setting and motion, whichever way its meshing condition was met.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import jax
import jax.numpy as jnp

from hypoid.cutter import EdgePiece, stick_edges
from hypoid.flank import PitchCone, Surface, axial_radial_angle, newton_pair, position_and_normal
from hypoid.flank import placed as placed_on
from hypoid.geometry import Batch, Batched, Scalar, Vector, dot, sine_cosine, turn_z
from hypoid.machine import Generator, Way, generator, place, sweep

from ._settings_model import BLADE, INDEX, settings_of

NEWTON = 20
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


def _generator(vector: Any, stick: Stick, *, moves: bool) -> Generator:
    settings = replace(settings_of(vector), roll_to_blade_ratio=stick.ratio)
    return generator(settings, axes_move=moves)


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


def _carried(vector: Any, stick: Stick, which: int, s: Batch, turn: Batch, phi: Batch) -> Vector:
    """Points of the blade's flank (0) or flat (1) in the member's frame, every axis free to move."""
    gen = _generator(vector, stick, moves=True)
    at = place(gen, sweep(gen, stick_pieces(vector, stick)[which], s, turn), turn, phi)
    sine, cosine = sine_cosine(-at.turn)
    return turn_z(cosine, sine, at.point)


def _slopes(
    vector: Any, stick: Stick, which: int, s: Batch, turn: Batch, phi: Batch, n: Vector
) -> Batch:
    """N . dr/dp of points, one row for each entry of the vector."""

    def along(direction: Any) -> Batch:
        def point(p: Any) -> Vector:
            return _carried(p, stick, which, s, turn, phi)

        return dot(jax.jvp(point, (vector,), (direction,))[1], n)

    return jax.vmap(along)(jnp.eye(vector.shape[0]))


def _flank_by(way: Way) -> Any:
    def flank(
        vector: Any,
        stick: Stick,
        branch: Scalar,
        outward: Scalar,
        z: Batch,
        rho: Batch,
        s: Batch,
        turn: Batch,
    ) -> tuple[Batch, ...]:
        surface = Surface(
            _generator(vector, stick, moves=way == "newton"), branch, outward, way
        )
        edge = stick_pieces(vector, stick)[0]

        def at(a: Batch, b: Batch) -> tuple[Batch, ...]:
            at_z, at_rho, angle = axial_radial_angle(surface, edge, a, b)
            return at_z - z, at_rho - rho, angle

        (s, turn), (f, g, angle), j = newton_pair(at, (s, turn), (1.0, 0.03), NEWTON)
        position, normal = position_and_normal(surface, edge, s, turn)
        phi = placed_on(surface, edge, s, turn)[0].phi
        lever = position[0] * normal[1] - position[1] * normal[0]
        slopes = _slopes(vector, stick, 0, s, turn, phi, normal)
        sense = j[0] * j[3] - j[1] * j[2]
        return s, turn, angle, jnp.hypot(f, g), lever, sense, phi, *_around(position, normal), *slopes

    flank.__qualname__ = f"hobbed flank by {way}"
    return flank


def _around(position: Vector, normal: Vector) -> Vector:
    """The normal's radial, tangential and axial parts."""
    rho = jnp.hypot(position[0], position[1])
    radial = (position[0] * normal[0] + position[1] * normal[1]) / rho
    around = (position[0] * normal[1] - position[1] * normal[0]) / rho
    return radial, around, normal[2]


def _root_by(way: Way) -> Any:
    def root(
        vector: Any, stick: Stick, branch: Scalar, cone: PitchCone, distance: Batch, turn: Batch
    ) -> tuple[Batch, ...]:
        """Turn, height and what is left at cone distances S, then dH/dp: the path of the sharp corner."""
        surface = Surface(_generator(vector, stick, moves=way == "newton"), branch, 1.0, way)
        edge = stick_pieces(vector, stick)[1]

        def at(a: Batch, b: Batch) -> tuple[Batch, ...]:
            z, rho, _ = axial_radial_angle(surface, edge, a, b)
            reached, height = cone.cone_distance_height(z, rho)
            return a, reached - distance, height

        start = (jnp.zeros_like(distance), turn)
        (s, turn), (_, left, height), _ = newton_pair(at, start, (1.0, 0.03), NEWTON)
        position, normal = position_and_normal(surface, edge, s, turn)
        phi = placed_on(surface, edge, s, turn)[0].phi
        radial, _, axial = _around(position, normal)
        up = radial * cone.cosine - axial * cone.sine
        slopes = _slopes(vector, stick, 1, s, turn, phi, normal)
        return turn, height, jnp.abs(left), *(slope / up for slope in slopes)

    root.__qualname__ = f"hobbed root by {way}"
    return root


_WAYS: tuple[Way, ...] = ("cradle", "newton", "form")
# s, turn, angle, left, lever, sense, phi, radial, around, axial (FIXED rows), then n . dr/dp
FLANK_AT = {way: Batched(_flank_by(way), parameters=4, block=256) for way in _WAYS}
ROOT_AT = {way: Batched(_root_by(way), parameters=4, block=16) for way in _WAYS[:2]}
