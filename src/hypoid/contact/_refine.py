"""Newton on the exact surfaces: where two flanks have one point and one normal.

Unknown are edge parameter and cutter turn on both members. Seen about the wheel axis, the two
points must share z and rho and their normals must be opposite; the wheel's angle then follows, and
with it the transmission error. The straight edge counts as extended: fillet and tip are clipped
afterwards (notes of 2022, pitfalls).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.cutter import EdgePiece
from hypoid.flank import Surface, placed, position_and_normal, solve_pair
from hypoid.geometry import Batch, Batched, dot

from ._mounting import Mounting, to_wheel

STEPS = 6
LIMIT_S, LIMIT_THETA = 0.5, 0.03  # mm, rad: greatest Newton step


def pinion_seen(
    mount: Mounting, surface: Surface, piece: EdgePiece, phi: Batch, s: Batch, theta: Batch
) -> tuple[Batch, ...]:
    """z, rho, normal (radial, axial, tangential) and angle of pinion points about the wheel axis."""
    point, normal = position_and_normal(surface, piece, s, theta)
    x, y, z = to_wheel(mount, phi, point)
    nx, ny, nz = to_wheel(mount, phi, normal, free=True)
    rho = jnp.sqrt(x * x + y * y)
    return z, rho, (x * nx + y * ny) / rho, nz, (x * ny - y * nx) / rho, jnp.arctan2(y, x)


def wheel_seen(surface: Surface, piece: EdgePiece, s: Batch, theta: Batch) -> tuple[Batch, ...]:
    at, _ = placed(surface, piece, s, theta)
    x, y, z = at.point
    nx, ny, nz = at.normal
    size = surface.outward / jnp.sqrt(dot(at.normal, at.normal))
    rho = jnp.sqrt(x * x + y * y)
    radial, tangential = (x * nx + y * ny) / rho, (x * ny - y * nx) / rho
    return z, rho, size * radial, size * nz, size * tangential, jnp.arctan2(y, x) - at.turn


Seen = tuple[Batch, ...]


def _with_derivatives(
    function: Callable[[Batch, Batch], Seen], a: Batch, b: Batch
) -> tuple[Seen, Seen, Seen]:
    """Values and their derivatives by a and by b: both tangents in one pass, to trace less."""
    one, zero = jnp.ones_like(a), jnp.zeros_like(a)

    def push(da: Batch, db: Batch) -> tuple[Seen, Seen]:
        return jax.jvp(function, (a, b), (da, db))

    tangents = (jnp.stack([one, zero]), jnp.stack([zero, one]))
    value, slopes = jax.vmap(push, out_axes=(None, 0))(*tangents)
    return value, tuple(d[0] for d in slopes), tuple(d[1] for d in slopes)


def _refine(
    mount: Mounting,
    surfaces: tuple[Surface, Surface],
    pieces: tuple[EdgePiece, EdgePiece],
    phi: Batch,
    s1: Batch,
    theta1: Batch,
    s2: Batch,
    theta2: Batch,
) -> tuple[Batch, ...]:
    """Parameters of both contact points, lead of the wheel, what is left, and the lead's Hessian."""

    def pinion(a: Batch, b: Batch) -> tuple[Batch, ...]:
        return pinion_seen(mount, surfaces[0], pieces[0], phi, a, b)

    def wheel(a: Batch, b: Batch) -> tuple[Batch, ...]:
        return wheel_seen(surfaces[1], pieces[1], a, b)

    def look(at: Seen) -> tuple[Seen, Seen]:
        """Newton's step at ``at``, and what there is to say of that place."""
        p, pa, pb = _with_derivatives(pinion, at[0], at[1])
        w, wc, wd = _with_derivatives(wheel, at[2], at[3])
        # how the wheel's parameters follow at equal (z, rho): each pinion parameter, and the rest
        match = (wc[0], wd[0], wc[1], wd[1])
        by_a, by_b = solve_pair(match, pa[0], pa[1]), solve_pair(match, pb[0], pb[1])
        by_rest = solve_pair(match, p[0] - w[0], p[1] - w[1])

        def follow(k: int, move: Seen) -> Batch:
            return wc[k] * move[0] + wd[k] * move[1]

        # the sum of both normals (radial, axial) over the pinion's parameters
        turn_a = (pa[2] + follow(2, by_a), pa[3] + follow(3, by_a))
        turn_b = (pb[2] + follow(2, by_b), pb[3] + follow(3, by_b))
        apart = (p[2] + w[2], p[3] + w[3])
        da, db = solve_pair(
            (turn_a[0], turn_b[0], turn_a[1], turn_b[1]),
            -apart[0] - follow(2, by_rest),
            -apart[1] - follow(3, by_rest),
        )
        k = 1.0 / jnp.maximum(1.0, jnp.maximum(jnp.abs(da) / LIMIT_S, jnp.abs(db) / LIMIT_THETA))
        da, db = jnp.nan_to_num(k * da), jnp.nan_to_num(k * db)
        dc = by_a[0] * da + by_b[0] * db + by_rest[0]
        dd = by_a[1] * da + by_b[1] * db + by_rest[1]
        step = (da, db, jnp.nan_to_num(dc), jnp.nan_to_num(dd))

        lead = mount.sense * (w[5] - p[5]) - mount.wheel_zero - mount.ratio * phi
        left = jnp.abs(p[0] - w[0]) + jnp.abs(p[1] - w[1])
        left = left + 10.0 * (jnp.abs(apart[0]) + jnp.abs(apart[1]))
        # Hessian of the lead over the pinion's parameters: sense/(rho n_t) t_i . d(n1 + n2)/dp_j
        scale = mount.sense / (p[1] * p[4])

        def entry(t: Seen, turn: Seen) -> Batch:
            tangential = -(p[2] * turn[0] + p[3] * turn[1]) / p[4]
            return scale * (t[1] * turn[0] + t[0] * turn[1] + p[1] * t[5] * tangential)

        first, mixed, second = entry(pa, turn_a), entry(pa, turn_b), entry(pb, turn_b)
        left = jnp.where(jnp.isfinite(left), left, jnp.inf)
        return step, (lead, left, first, first * second - mixed * mixed, w[0], w[1])

    def go(_count: int, state: tuple[Seen, Seen, Seen]) -> tuple[Seen, Seen, Seen]:
        at, step, _ = state
        at = tuple(x + d for x, d in zip(at, step, strict=True))
        return at, *look(at)

    nothing = jnp.zeros_like(phi)
    state = ((s1, theta1, s2, theta2), (nothing,) * 4, (nothing,) * 6)
    at, _, found = jax.lax.fori_loop(0, STEPS + 1, go, state)
    return *at, *found


refine = Batched(_refine, parameters=3, block=128)


@dataclass(frozen=True)
class ContactPoints:
    """Refined contact points, one a pinion angle; left-hand frames (mm, rad)."""

    s1: np.ndarray
    theta1: np.ndarray
    s2: np.ndarray
    theta2: np.ndarray
    lead: np.ndarray
    left: np.ndarray  # residual, mm
    curvature: np.ndarray  # determinant of the lead's Hessian; positive for a true extreme
    extreme: np.ndarray  # bool: the lead is greatest here, the surfaces do not cut each other
    wheel_z: np.ndarray
    wheel_rho: np.ndarray

    def changed(self, at: np.ndarray, other: ContactPoints, which: np.ndarray) -> ContactPoints:
        """These points with those `which` (k,) of others in the places `at`."""
        made = {f.name: getattr(self, f.name).copy() for f in fields(self)}
        for name, values in made.items():
            values[at] = getattr(other, name)[which]
        return ContactPoints(**made)

    @property
    def met(self) -> np.ndarray:
        return (self.left < 1e-9) & self.extreme
