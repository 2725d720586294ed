"""What cuts a flank as one tree of numbers, and how a flank's points answer to it.

A point of a flank moves with a setting by n . dr/dp at fixed (s, theta, phi): what its parameters
would do besides lies in the surface (envelope; notes on lin1996, inspection). So no meshing condition
is solved again, and one compiled function serves every method, motion and blade.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.cutter import EdgePiece
from hypoid.flank import (
    FlankParameters,
    Surface,
    carried_point,
    cutter_and_cradle,
    newton_pair,
    position_and_normal,
)
from hypoid.geometry import Batch, Batched, Rows, Scalar, Vector, compiled, dot
from hypoid.machine import Generator, MachineSettings, Way

Array = np.ndarray[Any, Any]
STEPS = 4  # of Newton, from a flank that is near
LIMIT = (0.5, 0.02)  # mm, rad: its greatest step
FEW = 64  # points that go through at once
LEFT = 1e-8  # mm, what it may leave


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Cutting:
    """What cuts one piece of a flank, and how it meshes; the tree's leaves are all that can be changed."""

    parameters: FlankParameters
    branch: Scalar
    outward: Scalar
    way: Way = field(metadata={"static": True})

    @property
    def piece(self) -> EdgePiece:
        return self.parameters.edge

    @property
    def generator(self) -> Generator:
        return self.parameters.generator

    @property
    def surface(self) -> Surface:
        return Surface(self.generator, self.branch, self.outward, self.way)


def cutting(settings: MachineSettings, piece: EdgePiece, surface: Surface, way: Way) -> Cutting:
    """What these settings and this piece cut, on the given surface's root."""
    return Cutting(FlankParameters.of(settings, piece), surface.branch, surface.outward, way)


def _moved(cut: Cutting, by: Cutting, s: Batch, theta: Batch, phi: Batch) -> tuple[Batch, ...]:
    """dr/dp (left hand, mm) of rigidly carried points along a direction ``by`` of the tree."""

    def point(at: Cutting) -> Vector:
        return carried_point(at.parameters, s, theta, phi)

    return jax.jvp(point, (cut,), (by,))[1]


def _along(cut: Cutting, s: Batch, turn: Batch, *line: Batch) -> tuple[Batch, ...]:
    """Where a flank passes lines p + d n: d (mm), s, turn, and what is left (mm)."""
    p, n = line[:3], line[3:]
    # two directions square to n: the axes that are least along it, made square
    flat = jnp.abs(n[2]) < 0.9
    aside = (jnp.where(flat, -n[1], 0.0), jnp.where(flat, n[0], -n[2]), jnp.where(flat, 0.0, n[1]))
    size = jnp.sqrt(dot(aside, aside))
    a: Vector = (aside[0] / size, aside[1] / size, aside[2] / size)
    b = (n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0])
    surface = cut.surface

    def miss(u: Batch, v: Batch) -> tuple[Batch, ...]:
        r, _ = position_and_normal(surface, cut.piece, u, v)
        off: Vector = (r[0] - p[0], r[1] - p[1], r[2] - p[2])
        return dot(off, a), dot(off, b), dot(off, n)

    (s, turn), (f, g, d), _ = newton_pair(miss, (s, turn), LIMIT, STEPS)
    return d, s, turn, jnp.hypot(f, g)


_moved_by = Batched(_moved, parameters=2, block=256)
_on_lines = Batched(_along, parameters=1, block=256)
_on_few_lines = compiled(_along)  # a whole batch's arrays take longer than its few points


def angles_of(cut: Cutting, s: Array, turn: Array) -> Rows:
    """Cutter's turn and cradle angle (2, n) of points at edge parameters s (mm) and turns, rad."""
    return cutter_and_cradle(cut.surface, cut.piece, s, turn)


def normal_move(
    cut: Cutting, by: Cutting, s: Array, theta: Array, phi: Array, normal: Array
) -> Array:
    """N . dr/dp (n,): how far the flank moves along unit normals (n, 3; left hand) along ``by``."""
    return (_moved_by(cut, by, s, theta, phi).T * normal).sum(axis=1)


def on_lines(cut: Cutting, s: Array, turn: Array, point: Array, normal: Array) -> Array:
    """Distance (n,), mm, from points (n, 3) along unit normals (n, 3) to the flank; left hand.

    Newton from (s, turn) of a flank near by; NaN where it does not arrive.
    """
    arrays = (s, turn, *point.T, *normal.T)
    if len(s) > FEW:
        distance, _, _, left = _on_lines(cut, *arrays)
    else:
        filled = (np.concatenate([a, np.full(FEW - len(a), a[-1])]) for a in arrays)
        distance, _, _, left = (np.asarray(v)[: len(s)] for v in _on_few_lines(cut, *filled))
    return np.where(left < LEFT, distance, np.nan)


def combined(trees: Mapping[int, Cutting], weights: Mapping[int, float]) -> Cutting:
    """Sum of trees by weights."""
    keys = list(weights)
    return jax.tree_util.tree_map(
        lambda *leaves: sum(weights[k] * leaf for k, leaf in zip(keys, leaves, strict=True)),
        *(trees[k] for k in keys),
    )
