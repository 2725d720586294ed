"""How far flat triangles stand off the surface they stand for, measured at exact points half-way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Chords:
    """Sagittas of a patch of p x q quadrangles, mm."""

    along_p: Array  # (p, q) the greater of a quadrangle's two edges in this direction
    along_q: Array
    error: Array  # (p, q) greatest distance of its two triangles from the surface
    other: Array  # (p, q) bool: its diagonal runs from (p + 1, q) to (p, q + 1)


def chords(points: Array) -> Chords:
    """Measured on exact points (2 p + 1, 2 q + 1, 3): corners at even places, mid-points at odd ones."""
    a, b = points[:-2:2, :-2:2], points[:-2:2, 2::2]
    d, c = points[2::2, :-2:2], points[2::2, 2::2]  # around the quadrangle: a, b, c, d
    normal = np.cross(c - a, d - b)
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    normal = normal / np.where(length > 0.0, length, 1.0)

    def sagitta(middle: Array, one: Array, two: Array) -> Array:
        return ((middle - 0.5 * (one + two)) * normal).sum(axis=-1)

    ab, dc = sagitta(points[:-2:2, 1::2], a, b), sagitta(points[2::2, 1::2], d, c)
    ad, bc = sagitta(points[1::2, :-2:2], a, d), sagitta(points[1::2, 2::2], b, c)
    centre = points[1::2, 1::2]
    ac, bd = sagitta(centre, a, c), sagitta(centre, b, d)
    one = np.maximum(_farthest(ab, bc, ac), _farthest(dc, ad, ac))
    two = np.maximum(_farthest(ab, ad, bd), _farthest(dc, bc, bd))
    other = two < one
    return Chords(
        along_p=np.maximum(np.abs(ad), np.abs(bc)),
        along_q=np.maximum(np.abs(ab), np.abs(dc)),
        error=np.where(other, two, one),
        other=other,
    )


def _farthest(x: Array, y: Array, z: Array) -> Array:
    """Greatest distance of a triangle from a surface of the second order, from its edges' sagittas.

    With barycentric l it is 4 (x l1 l2 + y l2 l3 + z l3 l1), greatest on an edge or at its own extremum.
    """
    edges = np.maximum(np.abs(x), np.maximum(np.abs(y), np.abs(z)))
    weights = y * (x + z - y), z * (x + y - z), x * (y + z - x)
    total = weights[0] + weights[1] + weights[2]
    inside = (weights[0] > 0.0) & (weights[1] > 0.0) & (weights[2] > 0.0)
    middle = 4.0 * x * y * z / np.where(inside, total, 1.0)
    return np.where(inside, np.maximum(edges, np.abs(middle)), edges)
