"""From a place (z, rho) to the surface: chart start, chord Newton, and the exact point there."""

from __future__ import annotations

import jax
import jax.numpy as jnp

from ..cutter import EdgePiece
from ..geometry import Batch, Batched, horner
from ._chart import Chart, PitchCone
from ._envelope import (
    Surface,
    axial_radial_angle,
    newton_pair,
    placed,
    position_and_normal,
    solve_pair,
    value_and_jacobian,
)


def _start(chart: Chart, cone: PitchCone, z: Batch, rho: Batch) -> tuple[Batch, Batch]:
    x, y = chart.coordinates(*cone.cone_distance_height(z, rho))
    x, y = jnp.clip(x, -1.05, 1.05), jnp.clip(y, -1.05, 1.05)
    return horner(chart.s, x, y), horner(chart.theta, x, y)


def _finish(
    surface: Surface, piece: EdgePiece, z: Batch, rho: Batch, s: Batch, theta: Batch, sense: Batch
) -> tuple[Batch, ...]:
    position, normal = position_and_normal(surface, piece, s, theta)
    radius = jnp.sqrt(position[0] ** 2 + position[1] ** 2)
    left = jnp.abs(position[2] - z) + jnp.abs(radius - rho)
    return *position, *normal, s, theta, jnp.where(jnp.isfinite(left), left, jnp.inf), sense


def _locate(
    surface: Surface, piece: EdgePiece, chart: Chart, cone: PitchCone, z: Batch, rho: Batch
) -> tuple[Batch, ...]:
    """Position, normal, s, theta, what is left (mm) and Jacobian sense at (z, rho): the quick way.

    The chart is good to a micrometre or far better, so the Jacobian at its start serves both steps.
    """
    s, theta = _start(chart, cone, z, rho)

    def residual(a: Batch, b: Batch) -> tuple[Batch, Batch]:
        reached, radius, _ = axial_radial_angle(surface, piece, a, b)
        return reached - z, radius - rho

    (f, g), jacobian = value_and_jacobian(residual, s, theta)
    ds, dt = solve_pair(jacobian, f, g)
    s, theta = s - ds, theta - dt
    ds, dt = solve_pair(jacobian, *residual(s, theta))
    sense = jacobian[0] * jacobian[3] - jacobian[1] * jacobian[2]
    return _finish(surface, piece, z, rho, s - ds, theta - dt, sense)


def _locate_slowly(
    surface: Surface, piece: EdgePiece, chart: Chart, cone: PitchCone, z: Batch, rho: Batch
) -> tuple[Batch, ...]:
    """The same by full Newton with limited steps, where the quick way did not arrive."""

    def residual(a: Batch, b: Batch) -> tuple[Batch, Batch]:
        reached, radius, _ = axial_radial_angle(surface, piece, a, b)
        return reached - z, radius - rho

    s, theta = newton_pair(residual, _start(chart, cone, z, rho), (0.2, 0.02), 25)
    _, j = value_and_jacobian(residual, s, theta)
    return _finish(surface, piece, z, rho, s, theta, j[0] * j[3] - j[1] * j[2])


def _from_cutter(
    surface: Surface, piece: EdgePiece, s: Batch, theta: Batch
) -> tuple[Batch, ...]:
    position, normal = position_and_normal(surface, piece, s, theta)
    return *position, *normal


def _roots_near(
    surface: Surface, piece: EdgePiece, s: Batch, theta: Batch
) -> tuple[Batch, ...]:
    at, discriminant = placed(surface, piece, s, theta)
    return at.phi, discriminant, *at.normal


def _curvatures(
    surface: Surface, piece: EdgePiece, s: Batch, theta: Batch
) -> tuple[Batch, ...]:
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
locate_slowly = Batched(_locate_slowly, parameters=4)
from_cutter = Batched(_from_cutter, parameters=2)
roots_near = Batched(_roots_near, parameters=2)
curvatures = Batched(_curvatures, parameters=2)
