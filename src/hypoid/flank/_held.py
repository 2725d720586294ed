"""Points of a flank held to the cutter turn and cradle angle that make them, as functions of what makes the flank.

Held so, a point is one rigid motion of a point of the edge: no meshing condition is solved, whatever
the method. What the point's parameters would do besides is linear, and its slopes are here, too.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.cutter import EdgePiece
from hypoid.geometry import Batch, Batched, Rows, Scalar, Vector, dot, sine_cosine, turn_z
from hypoid.machine import carried, mesh_cutter, meshed, sweep

from ._envelope import Surface
from ._flank import Flank
from ._traced import FlankParameters, flank_parameters

Array = np.ndarray[Any, Any]


def _angles(surface: Surface, piece: EdgePiece, s: Batch, turn: Batch) -> tuple[Batch, ...]:
    if surface.way == "cutter":
        _, mesh = mesh_cutter(surface.generator, piece, s, turn, surface.branch)
        return -jnp.arctan2(mesh.sine, mesh.cosine), turn
    at, _ = meshed(surface.generator, piece, s, turn, surface.branch, surface.way)
    return turn, at.phi


_angles_of = Batched(_angles, parameters=2, block=256)


def cutter_and_cradle(surface: Surface, piece: EdgePiece, s: Any, turn: Any) -> Rows:
    """Cutter's turn and cradle angle (2, n), rad, of points at edge parameters s (mm) and turns (rad)."""
    return _angles_of(surface, piece, s, turn)


def _there(
    parameters: FlankParameters, s: Batch, theta: Batch, phi: Batch
) -> tuple[Vector, Vector, Batch]:
    generator = parameters.generator
    at, left = carried(generator, sweep(generator, parameters.edge, s, theta), theta, phi)
    sine, cosine = sine_cosine(-at.turn)
    return turn_z(cosine, sine, at.point), turn_z(cosine, sine, at.normal), left


def carried_point(parameters: FlankParameters, s: Batch, theta: Batch, phi: Batch) -> Vector:
    """Points of the edge, mm, where cutter turn and cradle angle carry them; left-hand member's frame."""
    return _there(parameters, s, theta, phi)[0]


def _seen(
    parameters: FlankParameters,
    outward: Scalar,
    rolls: Scalar,
    s: Batch,
    theta: Batch,
    phi: Batch,
) -> tuple[Batch, ...]:
    """Point (3, mm), unit normal out of the tooth (3) and what the meshing condition leaves, left hand."""
    point, normal, left = _there(parameters, s, theta, phi)
    size = outward / jnp.sqrt(dot(normal, normal))
    left = rolls * left + (1.0 - rolls) * phi  # a form cut's cradle stands still
    return *point, *(size * n for n in normal), left


def _slopes(
    parameters: FlankParameters,
    outward: Scalar,
    rolls: Scalar,
    s: Batch,
    theta: Batch,
    phi: Batch,
) -> tuple[Batch, ...]:
    """Derivatives of all seven by s, then by theta, then by phi."""
    tangents = [tuple(jnp.full_like(s, 1.0 if k == i else 0.0) for k in range(3)) for i in range(3)]
    ways = tuple(jnp.stack(column) for column in zip(*tangents, strict=True))

    def push(*way: Batch) -> tuple[Batch, ...]:
        def seen(*at: Batch) -> tuple[Batch, ...]:
            return _seen(parameters, outward, rolls, *at)

        return jax.jvp(seen, (s, theta, phi), way)[1]

    found = jax.vmap(push)(*ways)
    return tuple(row[k] for k in range(3) for row in found)


_seen_of = Batched(_seen, parameters=3, block=256)
_slopes_of = Batched(_slopes, parameters=3, block=256)


@dataclass(frozen=True, eq=False)
class HeldPoints:
    """Points of one flank (left hand), each at its edge parameter s (mm), cutter turn and cradle angle (rad)."""

    parameters: FlankParameters  # those of the flank itself
    outward: float  # sign that turns the generator's normal out of the tooth
    rolls: float  # 1, or 0 for a form cut
    s: Array  # (n,)
    theta: Array
    phi: Array

    def seen(self, parameters: FlankParameters) -> Batch:
        """(7, n): the points that parameters make, mm, their normals, and what meshing leaves; may be traced."""
        return jnp.stack(_seen(parameters, self.outward, self.rolls, self.s, self.theta, self.phi))

    def distance(self, parameters: FlankParameters) -> Batch:
        """(n,) mm by which the flank that parameters make stands off, along the normals out of the tooth.

        To first order: N . dr/dp is the whole of it, since whatever else moves stays in the surface.
        """
        moved = self.seen(parameters)[:3] - self.own[:3]
        return (moved * self.own[3:6]).sum(axis=0)

    @cached_property
    def own(self) -> Array:
        """(7, n): what is seen of the flank itself."""
        return _seen_of(*self._arguments)

    @cached_property
    def slopes(self) -> Array:
        """(3, 7, n): derivatives of what is seen by s, theta and phi."""
        return _slopes_of(*self._arguments).reshape(3, 7, -1)

    @property
    def _arguments(self) -> tuple[Any, ...]:
        return self.parameters, self.outward, self.rolls, self.s, self.theta, self.phi


def held_points(flank: Flank, s: Any, turn: Any) -> HeldPoints:
    """Points of a flank at edge parameters s (n,), mm, and turns (n,), rad, of its flank piece.

    ``Flank.parameters`` gives both at places (S, H); `hypoid.flank.FlankPoints` has them, too.
    """
    s, turn = np.asarray(s, float), np.asarray(turn, float)
    surface, piece = flank.surface, flank.pieces["flank"]
    theta, phi = cutter_and_cradle(surface, piece, s, turn)
    rolls = 0.0 if surface.way == "form" else 1.0
    held = HeldPoints(flank_parameters(flank), 1.0, rolls, s, theta, phi)
    normal = flank.at_cutter(s[:1], turn[:1])[1][0] * flank.hand
    return replace(held, outward=float(np.sign(held.own[3:6, 0] @ normal)))
