"""A cutting edge: plane pieces, each a line, an arc or a parabola, placed in the cutter.

One form holds every edge of the four papers (edge arc, flat land, straight and curved blade,
Toprem, tip relief): with f and g the run along a start tangent and the rise towards the metal,

    f = sin(k s)/k,   g = (1 - cos(k s))/k + p s**2 + c max(s - b, 0)**2,

a line for k = p = c = 0, an arc of curvature k, a parabola of coefficient p about s = 0, and a relief
of parabola coefficient c from s = b on. So one compiled function serves every edge. Pieces run from
the blade's tip to its shank.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.geometry import Batch, Scalar, Vector, once, polynomial


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class EdgePiece:
    """One piece of an edge, in the cutter frame (mm).

    Every field may be traced: nothing is recompiled for another blade.
    """

    start: Vector  # point at s = 0
    tangent: Vector  # towards the shank, at s = 0; unit, unless the blade is raked
    metal: Vector  # in the rake plane, out of the blade; unit, square to the tangent unless raked
    curvature: Scalar  # k, 1/mm, positive where the edge bends towards the metal
    relief: Scalar  # c, 1/mm
    relief_from: Scalar  # b, mm
    low: Scalar  # s at the tip end, mm
    high: Scalar  # s at the shank end, mm
    parabola: Scalar = 0.0  # p, 1/mm, positive where the edge bends towards the metal

    def turned(self, angle: float) -> EdgePiece:
        """The same piece turned about the cutter axis, rad."""
        c, s = np.cos(angle), np.sin(angle)

        def turn(v: Vector) -> Vector:
            return (c * v[0] - s * v[1], s * v[0] + c * v[1], v[2])

        return replace(
            self, start=turn(self.start), tangent=turn(self.tangent), metal=turn(self.metal)
        )


# sin(x)/x and (1 - cos(x))/x**2 as powers of x**2: to 1e-16 for |x| up to pi.
_ORDERS = range(14)
_SINE = tuple((-1) ** k / math.factorial(2 * k + 1) for k in _ORDERS)
_VERSINE = tuple((-1) ** k / math.factorial(2 * k + 2) for k in _ORDERS)


def _sine_and_versine(square: Batch) -> tuple[Batch, Batch]:
    """sin(x)/x and (1 - cos(x))/x**2 from x**2: smooth through zero, so a line is an arc, too."""
    return polynomial(_SINE, square), polynomial(_VERSINE, square)


def edge_point(piece: EdgePiece, s: Batch) -> tuple[Vector, Vector]:
    """Point (mm) and derivative by s of an edge piece, in the cutter frame."""
    turn = piece.curvature * s
    straight, bent = once(_sine_and_versine(turn * turn))
    beyond = jnp.maximum(s - piece.relief_from, 0.0)
    bow, lift = piece.parabola * s, piece.relief * beyond
    along, rise = s * straight, s * (turn * bent + bow) + lift * beyond
    along_s, rise_s = 1.0 - turn * turn * bent, turn * straight + 2.0 * (bow + lift)
    along, rise, along_s, rise_s = once((along, rise, along_s, rise_s))
    point = tuple(
        p + along * t + rise * m
        for p, t, m in zip(piece.start, piece.tangent, piece.metal, strict=True)
    )
    derivative = tuple(
        along_s * t + rise_s * m for t, m in zip(piece.tangent, piece.metal, strict=True)
    )
    return point, derivative  # pyright: ignore[reportReturnType]
