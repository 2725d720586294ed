"""Load hats on a flank: bilinear over the element faces, one at each corner node; their loads and half-space.

A hat's load is a pressure along the inward normal, of unit force in all; the displacement that belongs to it
is the mean inward displacement under the hat. So compliance between hats is symmetric, mm/N.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse
from scipy.spatial.distance import cdist

from hypoid.flank import PitchCone

from ._love import parallelogram

Array = np.ndarray[Any, Any]
SPLIT = 4  # sub-cells of a face each way, for the half-space
NEAR = 4.0  # sub-cells this many sizes apart see each other as points
IMAGE = 1.0  # weight of what lies mirrored beyond an edge: a half-space is too stiff there
CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
MIDDLES = np.array([[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]])


@dataclass(frozen=True, eq=False)
class Hats:
    """Where the hats of a flank stand: columns of knots from toe to heel, rows from fillet to tip."""

    distance: Array  # (columns,) S, mm, rising evenly
    height: Array  # (columns, rows) H, mm, rising

    @property
    def count(self) -> int:
        return self.height.size

    def weights(self, distance: Array, height: Array) -> Any:
        """Weights (n, hats), sparse, of the hats at (S, H), mm; rows add up to one."""
        at, values = self._corners(distance, height)
        ends = 4 * np.arange(len(at) + 1)
        return sparse.csr_array((values.ravel(), at.ravel(), ends), shape=(len(at), self.count))

    def over(self, distance: Array, height: Array) -> tuple[Array, Array]:
        """The hats (m,) that lie over (S, H), mm, and their weights (n, m) there."""
        at, values = self._corners(distance, height)
        which, column = np.unique(at, return_inverse=True)
        made = np.zeros((len(at), len(which)))
        np.put_along_axis(made, column.reshape(at.shape), values, axis=1)
        return which, made

    def _corners(self, distance: Array, height: Array) -> tuple[Array, Array]:
        """The four hats (n, 4) about each place, and their weights (n, 4)."""
        columns, rows = self.height.shape
        u = np.interp(distance, self.distance, np.arange(columns))
        i = np.minimum(u.astype(int), columns - 2)
        u = u - i
        line = (1.0 - u)[:, None] * self.height[i] + u[:, None] * self.height[i + 1]
        j = np.clip((line < height[:, None]).sum(axis=1) - 1, 0, rows - 2)
        k = np.arange(len(j))
        v = np.clip((height - line[k, j]) / (line[k, j + 1] - line[k, j]), 0.0, 1.0)
        knot = i * rows + j
        at = np.stack([knot, knot + 1, knot + rows, knot + rows + 1], axis=1)
        values = np.stack([(1 - u) * (1 - v), (1 - u) * v, u * (1 - v), u * v], axis=1)
        return at, values


@dataclass(frozen=True, eq=False)
class HatLoads:
    """Hats with what the finite elements and the half-space make of them."""

    hats: Hats
    load: Any  # (3 nodes, hats) sparse, N for a unit force
    half_space: (
        Array  # (hats, hats), 1/mm: times (1 - nu**2)/(pi E) the mean displacement under a hat
    )


def shapes(at: Array) -> tuple[Array, Array, Array]:
    """Shape functions (q, 8) of a quadratic face at (q, 2), and their two derivatives."""
    x, y = at[:, :1], at[:, 1:]
    cx, cy = CORNERS.T
    a, b = 1.0 + x * cx, 1.0 + y * cy
    corner = 0.25 * a * b * (x * cx + y * cy - 1.0)
    by_x = 0.25 * cx * b * (2.0 * x * cx + y * cy)
    by_y = 0.25 * cy * a * (x * cx + 2.0 * y * cy)
    mx, my = MIDDLES.T
    on_x = mx == 0.0  # middles of the edges along x
    middle = np.where(on_x, 0.5 * (1 - x * x) * (1 + y * my), 0.5 * (1 + x * mx) * (1 - y * y))
    middle_x = np.where(on_x, -x * (1 + y * my), 0.5 * mx * (1 - y * y))
    middle_y = np.where(on_x, 0.5 * my * (1 - x * x), -y * (1 + x * mx))
    pairs = ((corner, middle), (by_x, middle_x), (by_y, middle_y))
    return tuple(np.concatenate(v, axis=1) for v in pairs)  # pyright: ignore[reportReturnType]


def bilinear(at: Array) -> Array:
    """Shape functions (q, 4) of a face's corners."""
    return (0.25 * (1.0 + at[:, None, :] * CORNERS)).prod(axis=-1) * 4.0


def hat_loads(nodes: Array, faces: Array, cone: PitchCone, outward: float) -> HatLoads:
    """Hats on the faces (k, 8) of one flank; `nodes` (n, 3) mm, `outward` -1 where they are mirrored."""
    hats, number = _knots(nodes, faces[:, :4], cone)
    load, area = _loads(nodes, faces, number, hats.count, outward)
    knot = np.zeros((hats.count, 3))
    knot[number] = nodes[faces[:, :4]]
    knot = knot.reshape(*hats.height.shape, 3)
    edges = (knot[:, -1], knot[0], knot[-1])  # tip, toe, heel
    return HatLoads(hats, load / area, _half_space(nodes, faces, number, hats.count, edges))


def _knots(nodes: Array, corners: Array, cone: PitchCone) -> tuple[Hats, Array]:
    """The hats, and the number (faces, 4) of each corner's."""
    knots, inverse = np.unique(corners, return_inverse=True)
    x, y, z = nodes[knots].T
    distance, height = (np.asarray(v) for v in cone.cone_distance_height(z, np.hypot(x, y)))
    tolerance = 1e-3 * np.ptp(distance) / len(knots)
    order = np.argsort(distance)
    column = np.zeros(len(knots), dtype=int)
    column[order] = np.append(0, np.cumsum(np.diff(distance[order]) > tolerance))
    order = np.lexsort((height, column))
    columns = int(column.max()) + 1
    number = np.zeros(len(knots), dtype=int)
    number[order] = np.arange(len(knots))
    hats = Hats(
        distance[order].reshape(columns, -1).mean(axis=1), height[order].reshape(columns, -1)
    )
    return hats, number[inverse].reshape(corners.shape)


def _loads(
    nodes: Array, faces: Array, number: Array, count: int, outward: float
) -> tuple[Any, Array]:
    """Load (3 nodes, hats) of unit pressure under each hat, and the area of that pressure."""
    x, w = np.polynomial.legendre.leggauss(4)
    at = np.stack([v.ravel() for v in np.meshgrid(x, x, indexing="ij")], axis=1)
    weight = np.outer(w, w).ravel()
    value, by_x, by_y = shapes(at)
    place = nodes[faces]
    normal = np.cross(np.einsum("qk,fkd->fqd", by_x, place), np.einsum("qk,fkd->fqd", by_y, place))
    phi = bilinear(at)
    inward = np.einsum("q,qa,qk,fqd->fakd", weight, phi, value, -outward * normal, optimize=True)
    rows = np.broadcast_to((3 * faces[:, None, :, None] + np.arange(3)), inward.shape)
    columns = np.broadcast_to(number[:, :, None, None], inward.shape)
    shape = (3 * len(nodes), count)
    load = sparse.coo_array((inward.ravel(), (rows.ravel(), columns.ravel())), shape=shape).tocsc()
    size = np.einsum("q,qa,fq->fa", weight, phi, np.linalg.norm(normal, axis=-1))
    area = np.bincount(number.ravel(), size.ravel(), minlength=count)
    return load, area


def _half_space(
    nodes: Array, faces: Array, number: Array, count: int, edges: Sequence[Array]
) -> Array:
    """Mean of the integral of 1/r under hat a, of hat b's unit force (hats, hats), 1/mm.

    Distances are chords; sub-cells are flat parallelograms. Each has its image beyond each of the edges (k, 3).
    """
    x = (np.arange(SPLIT) + 0.5) * 2.0 / SPLIT - 1.0
    at = np.stack([v.ravel() for v in np.meshgrid(x, x, indexing="ij")], axis=1)
    value, by_x, by_y = shapes(at)
    place, first, second = (
        np.einsum("qk,fkd->fqd", s, nodes[faces]).reshape(-1, 3)
        for s in (value, by_x * 2.0 / SPLIT, by_y * 2.0 / SPLIT)
    )
    seen = _seen(place, place, first, second)
    for edge in edges:
        seen += IMAGE * _seen(2.0 * _nearest(place, edge) - place, place, first, second)
    hat = sparse.coo_array(
        (
            np.tile(bilinear(at).ravel(), len(faces)),
            (
                np.repeat(np.arange(len(place)), 4),
                np.repeat(number[:, None], len(at), axis=1).ravel(),
            ),
        ),
        shape=(len(place), count),
    ).tocsr()
    area = np.linalg.norm(np.cross(first, second), axis=1)
    # u at i of cell j under unit pressure is seen[i, j]; hat b at unit force has pressure hat / total
    total = hat.T @ area
    pressure = hat.multiply(area[:, None]).multiply(1.0 / total).tocsr()
    mean = pressure.T @ (seen @ hat.multiply(1.0 / total).tocsr())
    return 0.5 * (mean + mean.T)


def _seen(eye: Array, place: Array, first: Array, second: Array) -> Array:
    """Integral of 1/r (n, n), mm, over parallelograms at `place`, seen from each `eye`."""
    apart = cdist(eye, place)
    size = np.maximum(np.linalg.norm(first, axis=1), np.linalg.norm(second, axis=1))
    i, j = np.nonzero(apart < NEAR * size)
    chord = apart[i, j]
    apart[i, j] = 1.0
    seen = np.linalg.norm(np.cross(first, second), axis=1) / apart
    # the cell's own plane, with what lies off it laid down to the chord's length
    along = first[j] / np.linalg.norm(first[j], axis=1)[:, None]
    across = second[j] - (second[j] * along).sum(axis=1)[:, None] * along
    across /= np.linalg.norm(across, axis=1)[:, None]

    def flat(v: Array) -> Array:
        return np.stack([(v * along).sum(axis=1), (v * across).sum(axis=1)], axis=1)

    offset = flat(eye[i] - place[j])
    offset *= (chord / np.maximum(np.linalg.norm(offset, axis=1), 1e-300))[:, None]
    seen[i, j] = parallelogram(offset, flat(first[j]), flat(second[j]))
    return seen


def _nearest(place: Array, line: Array) -> Array:
    """Nearest points (n, 3) on a polyline (k, 3) whose ends go on straight."""
    start, way = line[:-1], np.diff(line, axis=0)
    share = np.einsum("nkd,kd->nk", place[:, None] - start, way) / (way * way).sum(axis=1)
    low, high = np.zeros(len(way)), np.ones(len(way))
    low[0], high[-1] = -np.inf, np.inf
    found = start + np.clip(share, low, high)[..., None] * way
    best = ((found - place[:, None]) ** 2).sum(axis=-1).argmin(axis=1)
    return found[np.arange(len(place)), best]
