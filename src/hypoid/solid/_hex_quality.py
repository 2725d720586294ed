"""Shape functions of 8- and 20-node bricks, and from them how good a mesh is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
# places of the nodes in Abaqus' and VTK's order
CORNERS = np.array(
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]
)  # fmt: skip
EDGES = np.array(
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]]
)
# corners of faces S1 to S6, anticlockwise from outside, and the edges between them
FACES = np.array(
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
)
FACE_EDGES = np.array(
    [[11, 10, 9, 8], [12, 13, 14, 15], [8, 17, 12, 16], [9, 18, 13, 17], [10, 19, 14, 18], [11, 16, 15, 19]]
)  # fmt: skip
CHUNK = 4096  # elements that are looked at together
SHORTEST = 1e-12  # mm, an edge that has shrunk to a point


@dataclass(frozen=True)
class Quality:
    """Worst elements: Jacobian over the product of its rows' lengths, at Gauss points and nodes; aspect.

    Places are centres of elements (mm, member's frame); parts are tooth, root and rim.
    """

    scaled_jacobian: float
    scaled_jacobian_place: tuple[float, float, float]
    scaled_jacobian_part: str
    aspect: float  # longest to shortest edge
    aspect_place: tuple[float, float, float]
    aspect_part: str


@lru_cache
def _gradients(nodes: int) -> Array:
    """Gradients of the shape functions (points, 3, nodes) at 27 Gauss points and at the nodes."""
    gauss = np.array(list(product(np.sqrt(0.6) * np.array([-1.0, 0.0, 1.0]), repeat=3)))
    return shape_gradients(np.concatenate([gauss, node_places(nodes)]), nodes)


def node_places(nodes: int) -> Array:
    """Places (nodes, 3) of an element's nodes in [-1, 1]."""
    places = CORNERS.astype(float)
    return places if nodes == 8 else np.concatenate([places, places[EDGES].mean(axis=1)])


def shape_values(points: Array) -> Array:
    """Values (points, 20) of a 20-node brick's shape functions at places (points, 3) in [-1, 1]."""
    places = node_places(20)
    factor = np.where(places == 0.0, 1.0 - points[:, None] ** 2, 1.0 + points[:, None] * places)
    made = factor.prod(axis=-1)
    made[:, :8] *= 0.125 * (points @ CORNERS.T - 2.0)
    made[:, 8:] *= 0.25
    return made


def shape_gradients(points: Array, nodes: int = 20) -> Array:
    """Gradients (points, 3, nodes) of a brick's shape functions at places (points, 3) in [-1, 1]."""
    places = node_places(nodes)
    made = np.zeros((len(points), 3, nodes))
    for k, place in enumerate(places):
        factor = 1.0 + points * place  # (points, 3)
        middle = place == 0.0
        factor[:, middle] = 1.0 - points[:, middle] ** 2
        slope = np.where(middle, -2.0 * points, place)
        scale = 1.0 / 8.0 if not middle.any() else 1.0 / 4.0
        others = [factor[:, [(d + 1) % 3, (d + 2) % 3]].prod(axis=1) for d in range(3)]
        for d in range(3):
            made[:, d, k] = scale * slope[:, d] * others[d]
        if nodes == 20 and not middle.any():  # corners: times (sum of place * point - 2)
            less = points @ place - 2.0
            made[:, :, k] = made[:, :, k] * less[:, None]
            made[:, :, k] += scale * factor.prod(axis=1)[:, None] * place
    return made


def scaled_jacobians(nodes: Array, elements: Array) -> Array:
    """Least scaled Jacobian (m,) of each element over its Gauss points and nodes."""
    gradient = _gradients(elements.shape[1])
    least = np.zeros(len(elements))
    for start in range(0, len(elements), CHUNK):
        part = slice(start, start + CHUNK)
        rows = np.moveaxis(np.tensordot(gradient, nodes[elements[part]], axes=(2, 1)), 2, 0)
        det = (np.cross(rows[..., 0, :], rows[..., 1, :]) * rows[..., 2, :]).sum(axis=-1)
        lengths = np.sqrt((rows**2).sum(axis=-1)).prod(axis=-1)
        there = lengths > 0.0  # an edge without length counts as folded
        least[part] = np.where(there, det / np.where(there, lengths, 1.0), 0.0).min(axis=1)
    return least


def quality(nodes: Array, elements: Array, parts: Array) -> Quality:
    """Quality of a mesh; parts (m,) are names."""
    scaled = scaled_jacobians(nodes, elements)
    corners = nodes[elements[:, :8]]
    lengths = np.linalg.norm(corners[:, EDGES[:, 0]] - corners[:, EDGES[:, 1]], axis=-1)
    aspect = lengths.max(axis=1) / np.maximum(lengths.min(axis=1), SHORTEST)
    worst, longest = int(scaled.argmin()), int(aspect.argmax())

    def centre(k: int) -> tuple[float, float, float]:
        x, y, z = (float(v) for v in corners[k].mean(axis=0))
        return x, y, z

    return Quality(
        float(scaled[worst]),
        centre(worst),
        str(parts[worst]),
        float(aspect[longest]),
        centre(longest),
        str(parts[longest]),
    )
