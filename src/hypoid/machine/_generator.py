"""Kinematics of generation: where an edge point goes, and when it meshes, from screw velocities.

The condition of meshing n . dr/dphi = 0 is written with velocities in the machine frame (design,
section 5). There are four ways to meet it, and a flank takes the best that it has:

* ``cradle``: at fixed (s, theta) it reads A cos(phi) + B sin(phi) + C = 0 for a plain roll, since
  then edge and cutter turn sweep one surface fixed to the cradle (the crown gear, notes of 2022);
* ``cutter``: at fixed (s, phi) it is closed in theta for any motions, if the tool is a surface of
  revolution (face milling; `_revolution.py`);
* ``newton``: at fixed (s, theta), any cutter and any motions, from the first way's root;
* ``form``: nothing rolls (Formate, Helixform): the swept surface is the flank.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import jax
import jax.numpy as jnp

from hypoid.cutter import EdgePiece, edge_point
from hypoid.geometry import (
    Batch,
    Vector,
    add,
    cross,
    dot,
    once,
    scale,
    sine_cosine,
    turn_z,
    unit_angle,
)

from ._pose import Generator, Pose, pose, rotated, to_work

Way = Literal["cradle", "cutter", "newton", "form"]


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class SweptEdge:
    """Edge points turned by theta, in one frame (mm), with what meshing needs of them."""

    point: Vector
    along: Vector  # dr/ds
    swing: Vector  # dr/dtheta from the cutter's own turn, work at rest


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Meshing:
    """Root of the meshing condition: the angle sought by cosine and sine, and dF/d(angle) there."""

    cosine: Batch
    sine: Batch
    slope: Batch  # its sign is the branch, zero the undercut limit
    discriminant: Batch  # slope**2 as computed; negative where the edge never meshes


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Placed:
    """Meshed points before the work's own turn: the member's axis is z, left hand, mm."""

    point: Vector
    normal: Vector  # not unit
    turn: Batch  # R_b theta + W(phi), by which the member turns back, rad
    phi: Batch


def sweep(gen: Generator, piece: EdgePiece, s: Batch, theta: Batch) -> SweptEdge:
    """Edge points turned with the cutter by -theta, cutter frame (not turning)."""
    point, tangent = edge_point(piece, s)
    sine, cosine = once(sine_cosine(theta))
    x, y, z = turn_z(cosine, -sine, point)
    along = turn_z(cosine, -sine, tangent)
    lead = gen.cutter_lead
    return SweptEdge((x, y, z + lead * theta), along, (y, -x, lead + 0.0 * theta))


def to_cradle(gen: Generator, edge: SweptEdge) -> SweptEdge:
    """The same in the cradle frame, where its axes rest."""
    arm, along = once((rotated(gen.head, edge.point), rotated(gen.head, edge.along)))
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
    """Cradle angle where an edge point (cradle frame) meshes, closed for a plain roll [notes of 2022]."""
    n = once(_crown_normal(gen, edge))
    m = cross(edge.point, n)
    ratio, c, s = gen.roll[0], gen.root_cosine, gen.root_sine
    offset, base = gen.blank_offset, gen.sliding_base[0]
    a = -ratio * (c * (m[0] + base * n[1]) - s * offset * n[0])
    b = -ratio * (c * (base * n[0] - m[1]) + s * offset * n[1])
    const = m[2] - ratio * (s * m[2] + c * offset * n[2])
    return solve_trigonometric(a, b, const, branch)


def solve_trigonometric(a: Batch, b: Batch, const: Batch, branch: Batch | float) -> Meshing:
    """The root of a cos(x) + b sin(x) + const = 0 whose slope has the branch's sign."""
    a, b, const = once((a, b, const))
    square = a * a + b * b
    discriminant = square - const * const
    slope = branch * jnp.sqrt(jnp.maximum(discriminant, 1e-30 * square))
    slope, share = once((slope, 1.0 / square))
    cosine, sine = once(((b * slope - a * const) * share, -(a * slope + b * const) * share))
    return Meshing(cosine, sine, slope, discriminant)


def velocity(at: Pose, r: Vector, q: Vector, drift: Vector | None = None) -> Vector:
    """dr/dphi relative to the work of points r (machine frame) that stand at q from the work's axis.

    ``drift`` is their velocity on the cradle, machine frame, where its axes move.
    """
    axis: Vector = (at.root_cosine, 0.0, at.root_sine)
    x, y, z = scale(-at.roll_rate, cross(axis, q))
    x, y, z = x - r[1], y + r[0], z - at.base_rate
    if at.rates is None or drift is None:
        return x, y, z
    turn, back = at.rates.machine_root_angle, at.rates.machine_center_to_back
    return (
        x + drift[0] + turn * q[2] - back * axis[0],
        y + drift[1] + at.rates.blank_offset,
        z + drift[2] - turn * q[0] - back * axis[2],
    )


def _carried(
    gen: Generator, at: Pose, edge: SweptEdge
) -> tuple[Vector, Vector, Vector, Vector | None]:
    """Points r and q, the normal (not unit) and the drift of an edge in the machine frame."""
    arm, along = rotated(at.head, edge.point), at.to_machine(edge.along)
    on_cradle = add(at.centre, arm)
    r = turn_z(at.cosine, at.sine, on_cradle)
    q = (r[0], r[1] + at.blank_offset, r[2] - at.sliding_base)
    axis: Vector = (at.root_cosine, 0.0, at.root_sine)
    swing = add(at.to_machine(edge.swing), scale(-gen.blade_ratio, cross(axis, q)))
    drift = None
    if at.rates is not None:
        moved = add(at.rates.centre, cross(at.rates.spin, arm))
        drift = turn_z(at.cosine, at.sine, moved)
    return r, q, cross(along, swing), drift


def meshing_function(gen: Generator, edge: SweptEdge, phi: Batch) -> tuple[Batch, Vector]:
    """F = n . dr/dphi for any motions, and the normal n (not unit) in the machine frame."""
    at = pose(gen, phi)
    r, q, normal, drift = _carried(gen, at, edge)
    return dot(normal, velocity(at, r, q, drift)), normal


def mesh_newton(gen: Generator, edge: SweptEdge, branch: Batch | float, steps: int = 8) -> Meshing:
    """Cradle angle where an edge point meshes, by Newton for any motions, from the closed root.

    The last step is taken outside the loop with its slope held: it carries the derivatives.
    """
    start = mesh_closed(gen, to_cradle(gen, edge), branch)

    def slope_at(phi: Batch) -> tuple[Batch, Batch]:
        def f(angle: Batch) -> Batch:
            return meshing_function(gen, edge, angle)[0]

        return jax.jvp(f, (phi,), (jnp.ones_like(phi),))

    def step(_: int, phi: Batch) -> Batch:
        value, slope = slope_at(phi)
        return phi - jnp.clip(value / slope, -0.2, 0.2)

    phi = unit_angle(start.cosine, start.sine)
    phi = jax.lax.stop_gradient(jax.lax.fori_loop(0, steps, step, phi))
    value, slope = slope_at(phi)
    phi = phi - meshing_function(gen, edge, phi)[0] / jax.lax.stop_gradient(slope)
    left = jnp.abs(value / slope)
    discriminant = jnp.where(left < 1e-9, slope * slope, -1.0)  # not met: as never meshing
    sine, cosine = sine_cosine(phi)
    return Meshing(cosine, sine, slope, discriminant)


def to_member(at: Generator | Pose, q: Vector, normal: Vector, turn: Batch, phi: Batch) -> Placed:
    """Points q and normals of the machine frame in the member's frame, up to its own turn."""
    x, y, z = to_work(at.root_sine, at.root_cosine, q)
    normal = to_work(at.root_sine, at.root_cosine, normal)
    point, normal, turn = once(((x, y, z - at.machine_center_to_back), normal, turn))
    return Placed(point, normal, turn, phi)


def place_plain(gen: Generator, edge: SweptEdge, theta: Batch, mesh: Meshing) -> Placed:
    """Meshed points (edge in the cradle frame) under a plain roll."""
    phi = unit_angle(mesh.cosine, mesh.sine)
    r = turn_z(mesh.cosine, mesh.sine, edge.point)
    q = (r[0], r[1] + gen.blank_offset, r[2] - gen.sliding_base[0])
    normal = turn_z(mesh.cosine, mesh.sine, _crown_normal(gen, edge))
    return to_member(gen, q, normal, gen.blade_ratio * theta + gen.roll[0] * phi, phi)


def carried(gen: Generator, edge: SweptEdge, theta: Batch, phi: Batch) -> tuple[Placed, Batch]:
    """Edge points (cutter frame) at cradle angles, any motions, meshing or not; and F = n . dr/dphi."""
    at = pose(gen, phi)
    r, q, normal, drift = _carried(gen, at, edge)
    there = to_member(at, q, normal, gen.blade_ratio * theta + at.roll, phi)
    return there, dot(normal, velocity(at, r, q, drift))


def place(gen: Generator, edge: SweptEdge, theta: Batch, phi: Batch) -> Placed:
    """Edge points (cutter frame) at cradle angles, any motions."""
    return carried(gen, edge, theta, phi)[0]
