"""Kinematics of generation: where an edge point goes, and when it meshes, from screw velocities.

The condition of meshing n . dr/dphi = 0 is written with velocities in the machine frame (design,
section 5): with every axis at rest but a plain roll it reads A cos(phi) + B sin(phi) + C = 0, since
then edge and cutter turn sweep one surface fixed to the cradle (the crown gear, notes of 2022).
Anything else is left to Newton, started from that root.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import jax
import jax.numpy as jnp

from hypoid.cutter import EdgePiece, edge_point
from hypoid.geometry import Batch, Vector, add, cross, dot, once, scale, turn_z

from ._settings import Generator


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class SweptEdge:
    """Edge points turned by theta, in the cradle frame (mm), with what meshing needs of them."""

    point: Vector
    along: Vector  # dr/ds
    swing: Vector  # dr/dtheta from the cutter's own turn, work at rest


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Meshing:
    """Root of the meshing condition: the cradle angle by cosine and sine, and dF/dphi there."""

    cosine: Batch
    sine: Batch
    slope: Batch  # Q = dF/dphi: its sign is the branch, zero the undercut limit
    discriminant: Batch  # Q**2 as computed; negative where the edge never meshes


def sweep(gen: Generator, piece: EdgePiece, s: Batch, theta: Batch) -> SweptEdge:
    """Turn edge points with the cutter by -theta and carry them into the cradle frame."""
    point, tangent = edge_point(piece, s)
    cosine, sine = once((jnp.cos(theta), jnp.sin(theta)))

    def to_cradle(v: Vector) -> Vector:
        x, y, z = turn_z(cosine, -sine, v)
        return tuple(row[0] * x + row[1] * y + row[2] * z for row in gen.head)  # type: ignore[return-value]

    arm, along = once((to_cradle(point), to_cradle(tangent)))
    axis: Vector = (gen.head[0][2], gen.head[1][2], gen.head[2][2])
    return SweptEdge(add(gen.centre, arm), along, cross(arm, axis))


def _crown_normal(gen: Generator, edge: SweptEdge) -> Vector:
    """Normal (not unit) of the surface that edge and cutter turn sweep in the cradle frame.

    Plain roll only: the work's share of the cutter's turn is one of the cradle's, k = R_b/R_a.
    """
    k = gen.blade_ratio / gen.roll[0]
    x, y, _ = edge.point
    swing = (edge.swing[0] + k * y, edge.swing[1] - k * x, edge.swing[2])
    return cross(edge.along, swing)


def mesh_closed(gen: Generator, edge: SweptEdge, branch: Batch | float) -> Meshing:
    """Cradle angle where an edge point meshes, closed in phi (plain roll) [notes of 2022]."""
    n = once(_crown_normal(gen, edge))
    m = cross(edge.point, n)
    ratio, c, s = gen.roll[0], gen.root_cosine, gen.root_sine
    offset, base = gen.blank_offset, gen.sliding_base
    a = -ratio * (c * (m[0] + base * n[1]) - s * offset * n[0])
    b = -ratio * (c * (base * n[0] - m[1]) + s * offset * n[1])
    const = m[2] - ratio * (s * m[2] + c * offset * n[2])
    a, b, const = once((a, b, const))
    square = a * a + b * b
    discriminant = square - const * const
    slope = branch * jnp.sqrt(jnp.maximum(discriminant, 1e-30 * square))
    slope, share = once((slope, 1.0 / square))
    cosine, sine = once(((b * slope - a * const) * share, -(a * slope + b * const) * share))
    return Meshing(cosine, sine, slope, discriminant)


def _roll(gen: Generator, phi: Batch) -> tuple[Batch, Batch]:
    """Work roll W(phi) and dW/dphi, rad."""
    value, slope = gen.roll[-1] + 0.0 * phi, 0.0 * phi
    for k in range(gen.roll.shape[0] - 2, -1, -1):
        slope = slope * phi + value
        value = value * phi + gen.roll[k]
    return value * phi, slope * phi + value


def meshing_function(gen: Generator, edge: SweptEdge, phi: Batch) -> tuple[Batch, Vector]:
    """F = n . dr/dphi for any motions, and the normal n (not unit) in the machine frame."""
    cosine, sine = jnp.cos(phi), jnp.sin(phi)
    r = turn_z(cosine, sine, edge.point)
    base = gen.sliding_base + gen.helical_motion * phi
    arm = (r[0], r[1] + gen.blank_offset, r[2] - base)
    axis: Vector = (gen.root_cosine, 0.0 * phi, gen.root_sine)
    work = cross(axis, arm)  # velocity of a point turning with the work, per rad
    _, ratio = _roll(gen, phi)
    swing = add(turn_z(cosine, sine, edge.swing), scale(-gen.blade_ratio, work))
    normal = cross(turn_z(cosine, sine, edge.along), swing)
    x, y, z = scale(-ratio, work)
    velocity = (x - r[1], y + r[0], z - gen.helical_motion)
    return dot(normal, velocity), normal


def mesh_newton(gen: Generator, edge: SweptEdge, branch: Batch | float, steps: int = 8) -> Meshing:
    """Cradle angle where an edge point meshes, by Newton for any motions, from the closed root.

    The last step is taken outside the loop with its slope held: it carries the derivatives.
    """
    start = mesh_closed(gen, edge, branch)

    def slope_at(phi: Batch) -> tuple[Batch, Batch]:
        def f(angle: Batch) -> Batch:
            return meshing_function(gen, edge, angle)[0]

        return jax.jvp(f, (phi,), (jnp.ones_like(phi),))

    def step(_: int, phi: Batch) -> Batch:
        value, slope = slope_at(phi)
        return phi - jnp.clip(value / slope, -0.2, 0.2)

    phi = jnp.arctan2(start.sine, start.cosine)
    phi = jax.lax.stop_gradient(jax.lax.fori_loop(0, steps, step, phi))
    value, slope = slope_at(phi)
    phi = phi - meshing_function(gen, edge, phi)[0] / jax.lax.stop_gradient(slope)
    left = jnp.abs(value / slope)
    discriminant = jnp.where(left < 1e-9, slope * slope, -1.0)  # not met: as never meshing
    return Meshing(jnp.cos(phi), jnp.sin(phi), slope, discriminant)


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Placed:
    """Meshed points before the work's own turn: the member's axis is z, left hand, mm."""

    point: Vector
    normal: Vector  # not unit
    turn: Batch  # R_b theta + W(phi), by which the member turns back, rad
    phi: Batch


def place(gen: Generator, edge: SweptEdge, theta: Batch, mesh: Meshing, plain: bool) -> Placed:
    """Carry meshed points and their normals into the member's frame, up to its own turn."""
    phi = jnp.arctan2(mesh.sine, mesh.cosine)
    r = turn_z(mesh.cosine, mesh.sine, edge.point)
    if plain:
        roll, base = gen.roll[0] * phi, gen.sliding_base
        normal = turn_z(mesh.cosine, mesh.sine, _crown_normal(gen, edge))
    else:
        roll, base = _roll(gen, phi)[0], gen.sliding_base + gen.helical_motion * phi
        normal = meshing_function(gen, edge, phi)[1]

    def to_work(v: Vector) -> Vector:
        return (
            gen.root_sine * v[0] - gen.root_cosine * v[2],
            v[1],
            gen.root_cosine * v[0] + gen.root_sine * v[2],
        )

    x, y, z = to_work((r[0], r[1] + gen.blank_offset, r[2] - base))
    point = (x, y, z - gen.machine_center_to_back)
    point, normal, turn = once((point, to_work(normal), gen.blade_ratio * theta + roll))
    return Placed(point, normal, turn, phi)


def solve_meshing(gen: Generator, edge: SweptEdge, branch: Any, plain: bool) -> Meshing:
    """The meshing root by the best way there is: closed for a plain roll, else Newton."""
    return mesh_closed(gen, edge, branch) if plain else mesh_newton(gen, edge, branch)
