"""The envelope of a swept edge piece in the member's frame, and its Newton solves (left hand).

Its parameters are the edge parameter s and a turn: the cutter's theta, or the cradle's angle where
the meshing condition is closed in theta (``machine.Way``). The code calls either one theta.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import jax
import jax.numpy as jnp

from hypoid.cutter import EdgePiece
from hypoid.geometry import Batch, Scalar, Vector, once, scale, sine_cosine, turn_z, unit
from hypoid.machine import Generator, Placed, Way, meshed

from ._departure import Departure, departed


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Surface:
    """A generated surface up to the edge piece that makes it: generator and which root is meant."""

    generator: Generator
    branch: Scalar  # sign of the meshing condition's slope on the tooth
    outward: Scalar  # sign that turns the generator's normal out of the tooth
    way: Way = field(metadata={"static": True})  # how the meshing condition is met
    departure: Departure | None = None  # of the flank as it is from the one that is generated


def placed(surface: Surface, piece: EdgePiece, s: Batch, theta: Batch) -> tuple[Placed, Batch]:
    """Meshed points before the work's turn, and the discriminant of the meshing condition."""
    at, discriminant = meshed(surface.generator, piece, s, theta, surface.branch, surface.way)
    if surface.departure is not None:
        at = departed(at, surface.departure)
    return at, discriminant


def position_and_normal(
    surface: Surface, piece: EdgePiece, s: Batch, theta: Batch
) -> tuple[Vector, Vector]:
    """Points (mm) and unit normals out of the tooth, left-hand member's frame."""
    at, _ = placed(surface, piece, s, theta)
    sine, cosine = once(sine_cosine(-at.turn))
    normal = once(scale(surface.outward, unit(at.normal)))
    return turn_z(cosine, sine, at.point), turn_z(cosine, sine, normal)


def axial_radial_angle(
    surface: Surface, piece: EdgePiece, s: Batch, theta: Batch
) -> tuple[Batch, Batch, Batch]:
    """Axial position z, radius rho (mm) and angle about the axis (rad) of surface points.

    The angle is a small arctangent less the work's turn, so it never wraps.
    """
    at, _ = placed(surface, piece, s, theta)
    x, y, z = at.point
    return z, jnp.sqrt(x * x + y * y), jnp.arctan2(y, x) - at.turn


Jacobian = tuple[Batch, Batch, Batch, Batch]


def newton_pair(
    function: Callable[[Batch, Batch], tuple[Batch, ...]],
    start: tuple[Batch, Batch],
    limit: tuple[Scalar, Scalar],
    steps: int,
) -> tuple[tuple[Batch, Batch], tuple[Batch, ...], Jacobian]:
    """Newton in two unknowns with limited steps towards the zero of a function's first two values.

    All points side by side. Returns where it ended, with all values and the Jacobian there.
    """

    def step(_count: int, state: Any) -> Any:
        (a, b), (da, db), *_ = state
        at = a - da, b - db
        values, jacobian = value_and_jacobian(function, *at)
        da, db = solve_pair(jacobian, values[0], values[1])
        # one factor for both, so that a limited step keeps its direction
        k = 1.0 / jnp.maximum(1.0, jnp.maximum(jnp.abs(da) / limit[0], jnp.abs(db) / limit[1]))
        k = jnp.where(jnp.isfinite(k), k, 0.0)
        return at, (k * jnp.nan_to_num(da), k * jnp.nan_to_num(db)), values, jacobian

    # Each turn moves first and looks then, so that what is seen last needs no compiling of its own.
    zero = jnp.zeros_like(start[0])
    seen = (zero,) * len(jax.eval_shape(function, *start))
    state = (start, (zero, zero), seen, (zero,) * 4)
    at, _, values, jacobian = jax.lax.fori_loop(0, steps + 1, step, state)
    return at, values, jacobian


def value_and_jacobian(
    function: Callable[[Batch, Batch], tuple[Batch, ...]], a: Batch, b: Batch
) -> tuple[tuple[Batch, ...], Jacobian]:
    """Values of an elementwise function of two batches, and its first two rows' derivatives."""
    one, zero = jnp.ones_like(a), jnp.zeros_like(a)

    def push(da: Batch, db: Batch) -> tuple[tuple[Batch, ...], tuple[Batch, ...]]:
        return jax.jvp(function, (a, b), (da, db))

    # both directions side by side: half as much to trace and to compile
    ways = jnp.stack([one, zero]), jnp.stack([zero, one])
    value, slopes = jax.vmap(push, out_axes=(None, 0))(*ways)
    f, g = once((slopes[0], slopes[1]))
    return value, (f[0], f[1], g[0], g[1])


def solve_pair(j: Jacobian, f: Batch, g: Batch) -> tuple[Batch, Batch]:
    """Solve a batch of 2 x 2 systems (f_a, f_b; g_a, g_b) x = (f, g)."""
    determinant = j[0] * j[3] - j[1] * j[2]
    return (j[3] * f - j[1] * g) / determinant, (j[0] * g - j[2] * f) / determinant
