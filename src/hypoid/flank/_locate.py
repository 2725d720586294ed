"""From a place (z, rho) to the surface: chart start, corrections, and the exact point there."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.cutter import EdgePiece
from hypoid.geometry import Batch, Batched, Rows, horner, once

from ._chart import Chart, PitchCone, height_at
from ._envelope import Surface, placed, position_and_normal

AIMS = 5  # tries of the quick way
ARRIVED = 2e-12  # mm, what rounding leaves


def _start(chart: Chart, cone: PitchCone, z: Any, rho: Any) -> tuple[Any, Any]:
    x, y = chart.coordinates(*cone.cone_distance_height(z, rho))
    x, y = once((x.clip(-1.05, 1.05), y.clip(-1.05, 1.05)))
    return once((horner(chart.s, x, y), horner(chart.theta, x, y)))


def _locate(
    surface: Surface, piece: EdgePiece, chart: Chart, cone: PitchCone, z: Batch, rho: Batch
) -> tuple[Batch, ...]:
    """Position, normal, s, theta and what is left (mm) at (z, rho): the quick way.

    The chart is read at a place moved by what it missed, so its own slope serves as the Jacobian:
    each try leaves the error times the chart's relative error in slope, 1e-3 or far less.
    """

    def look(aim: tuple[Batch, Batch]) -> tuple[tuple[Batch, Batch], tuple[Batch, ...]]:
        s, theta = _start(chart, cone, *aim)
        position, normal = once(position_and_normal(surface, piece, s, theta))
        miss_z = z - position[2]
        miss_rho = rho - jnp.sqrt(position[0] ** 2 + position[1] ** 2)
        left = jnp.abs(miss_z) + jnp.abs(miss_rho)
        left = jnp.where(jnp.isfinite(left), left, jnp.inf)
        return (aim[0] + miss_z, aim[1] + miss_rho), (*position, *normal, s, theta, left)

    def go_on(state: Any) -> Any:
        tries, _, found = state
        return (tries < AIMS) & jnp.any(found[-1] > ARRIVED)

    def again(state: Any) -> Any:
        return state[0] + 1, *look(state[1])

    nowhere = (jnp.full_like(z, jnp.inf),) * 9
    return jax.lax.while_loop(go_on, again, (0, (z, rho), nowhere))[2]


def locate_slowly(
    surface: Surface, piece: EdgePiece, chart: Chart, cone: PitchCone, z: Rows, rho: Rows
) -> Rows:
    """The same by full Newton with limited steps, and the Jacobian's sense: where charts fail."""
    place = cone.cone_distance_height(z, rho)
    start = _start(chart, cone, z, rho)
    s, theta, _, left, sense = height_at(surface, piece, cone, *place, *start)
    return np.vstack([from_cutter(surface, piece, s, theta), s, theta, left, sense])


def _from_cutter(surface: Surface, piece: EdgePiece, s: Batch, theta: Batch) -> tuple[Batch, ...]:
    position, normal = position_and_normal(surface, piece, s, theta)
    return *position, *normal


def _roots_near(surface: Surface, piece: EdgePiece, s: Batch, theta: Batch) -> tuple[Batch, ...]:
    at, discriminant = placed(surface, piece, s, theta)
    x, y, z = at.point
    rho = jnp.sqrt(x * x + y * y)
    tangential = (x * at.normal[1] - y * at.normal[0]) / rho
    return at.phi, discriminant, tangential, z, rho


def _curvatures(surface: Surface, piece: EdgePiece, s: Batch, theta: Batch) -> tuple[Batch, ...]:
    """Principal curvatures (1/mm, convex positive) and directions, by the first two forms."""

    def patch(a: Batch, b: Batch) -> tuple[Batch, ...]:
        position, normal = position_and_normal(surface, piece, a, b)
        return *position, *normal

    one, zero = jnp.ones_like(s), jnp.zeros_like(s)
    _, by_s = jax.jvp(patch, (s, theta), (one, zero))
    _, by_t = jax.jvp(patch, (s, theta), (zero, one))
    r_s, n_s, r_t, n_t = by_s[:3], by_s[3:], by_t[:3], by_t[3:]

    def inner(u: tuple[Batch, ...], v: tuple[Batch, ...]) -> Batch:
        return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]

    # an orthonormal tangent basis (a, b): r_s = e a, r_t = f a + g b; the shape operator in it
    e = jnp.sqrt(inner(r_s, r_s))
    a = tuple(c / e for c in r_s)
    f = inner(r_t, a)
    rest = tuple(t - f * c for t, c in zip(r_t, a, strict=True))
    g = jnp.sqrt(inner(rest, rest))
    b = tuple(c / g for c in rest)
    n_a = tuple(c / e for c in n_s)
    n_b = tuple((t - f * c) / g for t, c in zip(n_t, n_a, strict=True))
    aa, ab, bb = inner(n_a, a), 0.5 * (inner(n_a, b) + inner(n_b, a)), inner(n_b, b)
    mean, half = 0.5 * (aa + bb), 0.5 * (aa - bb)
    turn = 0.5 * jnp.arctan2(ab, half)
    spread = jnp.sqrt(half * half + ab * ab)
    c, d = jnp.cos(turn), jnp.sin(turn)
    first = tuple(c * p + d * q for p, q in zip(a, b, strict=True))
    second = tuple(c * q - d * p for p, q in zip(a, b, strict=True))
    return mean + spread, mean - spread, *first, *second


locate = Batched(_locate, parameters=4)
from_cutter = Batched(_from_cutter, parameters=2)
roots_near = Batched(_roots_near, parameters=2, block=128)
curvatures = Batched(_curvatures, parameters=2, block=512)
