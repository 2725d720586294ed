"""Newton on the exact surfaces: where two flanks have one point and one normal.

Unknown are edge parameter and cutter turn on both members. Seen about the wheel axis, the two
points must share z and rho and their normals must be opposite; the wheel's angle then follows, and
with it the transmission error. The straight edge counts as extended: fillet and tip are clipped
afterwards (notes of 2022, pitfalls).
"""

from __future__ import annotations

from dataclasses import dataclass

import jax
import jax.numpy as jnp
import numpy as np

from ..cutter import EdgePiece
from ..flank import Surface, placed, position_and_normal, solve_pair
from ..geometry import Batch, Batched, dot
from ._mounting import Mounting, to_wheel

STEPS = 6
LIMIT_S, LIMIT_THETA = 0.5, 0.03  # mm, rad: greatest Newton step


def _pinion_seen(
    mount: Mounting, surface: Surface, piece: EdgePiece, phi: Batch, s: Batch, theta: Batch
) -> tuple[Batch, ...]:
    """z, rho, normal (radial, axial, tangential) and angle of pinion points about the wheel axis."""
    point, normal = position_and_normal(surface, piece, s, theta)
    x, y, z = to_wheel(mount, phi, point)
    nx, ny, nz = to_wheel(mount, phi, normal, free=True)
    rho = jnp.sqrt(x * x + y * y)
    return z, rho, (x * nx + y * ny) / rho, nz, (x * ny - y * nx) / rho, jnp.arctan2(y, x)


def _wheel_seen(surface: Surface, piece: EdgePiece, s: Batch, theta: Batch) -> tuple[Batch, ...]:
    at, _ = placed(surface, piece, s, theta)
    x, y, z = at.point
    nx, ny, nz = at.normal
    size = surface.outward / jnp.sqrt(dot(at.normal, at.normal))
    rho = jnp.sqrt(x * x + y * y)
    radial, tangential = (x * nx + y * ny) / rho, (x * ny - y * nx) / rho
    return z, rho, size * radial, size * nz, size * tangential, jnp.arctan2(y, x) - at.turn


def _with_derivatives(function, a: Batch, b: Batch):  # pyright: ignore
    one, zero = jnp.ones_like(a), jnp.zeros_like(a)
    value, by_a = jax.jvp(function, (a, b), (one, zero))
    _, by_b = jax.jvp(function, (a, b), (zero, one))
    return value, by_a, by_b


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
        return _pinion_seen(mount, surfaces[0], pieces[0], phi, a, b)

    def wheel(a: Batch, b: Batch) -> tuple[Batch, ...]:
        return _wheel_seen(surfaces[1], pieces[1], a, b)

    def system(at: tuple[Batch, ...]):  # pyright: ignore
        p, pa, pb = _with_derivatives(pinion, at[0], at[1])
        w, wc, wd = _with_derivatives(wheel, at[2], at[3])
        places = (p[0] - w[0], p[1] - w[1])
        normals = (p[2] + w[2], p[3] + w[3])
        # follow each pinion parameter at equal (z, rho): how the wheel parameters move with it
        to_match = (wc[0], wd[0], wc[1], wd[1])
        by_a = solve_pair(to_match, pa[0], pa[1])
        by_b = solve_pair(to_match, pb[0], pb[1])
        by_f = solve_pair(to_match, *places)

        def follow(k: int, move: tuple[Batch, Batch]) -> Batch:
            return wc[k] * move[0] + wd[k] * move[1]

        reduced = (
            pa[2] + follow(2, by_a),
            pb[2] + follow(2, by_b),
            pa[3] + follow(3, by_a),
            pb[3] + follow(3, by_b),
        )
        rest = (normals[0] + follow(2, by_f), normals[1] + follow(3, by_f))
        return p, pa, pb, w, places, normals, by_a, by_b, by_f, reduced, rest

    def step(_: int, at: tuple[Batch, ...]) -> tuple[Batch, ...]:
        *_, by_a, by_b, by_f, reduced, rest = system(at)
        da, db = solve_pair(reduced, -rest[0], -rest[1])
        k = 1.0 / jnp.maximum(
            1.0, jnp.maximum(jnp.abs(da) / LIMIT_S, jnp.abs(db) / LIMIT_THETA)
        )
        da, db = jnp.nan_to_num(k * da), jnp.nan_to_num(k * db)
        dc = by_a[0] * da + by_b[0] * db + by_f[0]
        dd = by_a[1] * da + by_b[1] * db + by_f[1]
        return at[0] + da, at[1] + db, at[2] + jnp.nan_to_num(dc), at[3] + jnp.nan_to_num(dd)

    at = jax.lax.fori_loop(0, STEPS, step, (s1, theta1, s2, theta2))
    p, pa, pb, w, places, normals, *_, reduced, _ = system(at)
    lead = mount.sense * (w[5] - p[5]) - mount.wheel_zero - mount.ratio * phi
    left = jnp.abs(places[0]) + jnp.abs(places[1]) + 10.0 * (jnp.abs(normals[0]) + jnp.abs(normals[1]))
    # Hessian of the lead over the pinion's parameters: -sense/(rho m_t) t_i . d(n1 + n2)/dp_j
    scale = mount.sense / (p[1] * p[4])

    def entry(t: tuple[Batch, ...], radial: Batch, axial: Batch) -> Batch:
        tangential = -(p[2] * radial + p[3] * axial) / p[4]
        return scale * (t[1] * radial + t[0] * axial + p[1] * t[5] * tangential)

    h_aa = entry(pa, reduced[0], reduced[2])
    h_ab = entry(pa, reduced[1], reduced[3])
    h_bb = entry(pb, reduced[1], reduced[3])
    left = jnp.where(jnp.isfinite(left), left, jnp.inf)
    return *at, lead, left, h_aa, h_aa * h_bb - h_ab * h_ab, w[0], w[1], p[0]


refine = Batched(_refine, parameters=3)


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

    @property
    def met(self) -> np.ndarray:
        return (self.left < 1e-9) & self.extreme
