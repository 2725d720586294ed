"""Smoothing meshes of quadrilaterals in the plane: shapes near their targets, none folded.

The energy of Garanzha et al. (Foldover-free maps in 50 lines of code, ACM TOG 40, 2021): at each corner, by its
target rectangle, of the Jacobian T: |T|^2 / 2 det T + weight (1 + det^2 T) / 2 det T, the divisor kept positive by
(det + sqrt(eps^2 + det^2)) / 2 until nothing is folded. Many meshes of one topology are smoothed at once, by
L-BFGS that starts from the Laplacian of the targets. Arrays run over (node or edge, coordinate, mesh).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from scipy.sparse import csr_array

Array = np.ndarray[Any, Any]
Place: TypeAlias = Callable[[Array], tuple[Array, Callable[[Array], Array]]]
AREA = 0.3  # weight of sizes against shapes
ROUNDS, STEPS, MEMORY, SHORTENINGS = 8, 30, 8, 9
SETTLED = 1e-6  # relative decrease of the energy
SAFE = 1e-3  # eps where nothing is folded


def edge_vectors(quads: Array, nodes: int) -> csr_array:
    """Matrix (4 q, n) that gives the edges below, above, left and right of every quadrilateral."""
    a, b, c, d = quads.T
    start, end = np.concatenate([a, d, a, b]), np.concatenate([b, c, d, c])
    row, one = np.arange(len(start)), np.ones(len(start))
    place = np.concatenate([row, row]), np.concatenate([start, end])
    return csr_array((np.concatenate([-one, one]), place), shape=(len(start), nodes))


def energy(edges: Array, size: Array, epsilon: Array) -> tuple[Array, Array, Array]:
    """Energies (m,), gradients by the edges (4, q, 2, m) and least determinants (m,).

    Targets are right-angled, with edges as long as size (4, q, m); epsilon is (m,).
    """
    size = size[:, :, None]
    relative = edges / size
    across, up = relative[[0, 0, 1, 1]], relative[[2, 3, 2, 3]]
    det = across[:, :, 0] * up[:, :, 1] - across[:, :, 1] * up[:, :, 0]
    root = np.sqrt(epsilon * epsilon + det * det)
    folded = det < 0.0  # the same without loss of digits
    kept = 0.5 * np.where(folded, epsilon**2 / (root - np.minimum(det, 0.0)), det + root)
    total = 0.5 * ((across**2).sum(2) + (up**2).sum(2) + AREA * (1.0 + det * det))
    by_det = ((AREA * det - total / root) / kept)[:, :, None]
    by_across = across / kept[:, :, None] + by_det * np.stack([up[:, :, 1], -up[:, :, 0]], 2)
    by_up = up / kept[:, :, None] + by_det * np.stack([-across[:, :, 1], across[:, :, 0]], 2)
    gradient = np.stack(
        [
            by_across[0] + by_across[1],
            by_across[2] + by_across[3],
            by_up[0] + by_up[2],
            by_up[1] + by_up[3],
        ]
    )
    return (total / kept).sum((0, 1)), gradient / size, det.min((0, 1))


def smooth(
    place: Place,
    start: Array,
    edge_of: csr_array,
    size: Array,
    precondition: Callable[[Array], Array],
) -> Array:
    """Unknowns (n, m) of least energy.

    `place` gives points (nodes, 2, m) and a way to take their gradient back to the unknowns.
    """
    x, meshes = start, start.shape[1]
    epsilon = np.full(meshes, SAFE)

    def value(x: Array) -> tuple[Array, Array, Array]:
        points, back = place(x)
        edges = (edge_of @ points.reshape(len(points), -1)).reshape(4, -1, 2, meshes)
        total, by_edges, least = energy(edges, size, epsilon)
        by_points = edge_of.T @ by_edges.reshape(4 * by_edges.shape[1], -1)
        return total, back(by_points.reshape(points.shape)), least

    for _ in range(ROUNDS):
        least = value(x)[2]
        epsilon = np.maximum(SAFE, -0.5 * least)
        x, settled = _descend(value, x, precondition)
        if settled and (least > 0.0).all():
            break
    return x


def _descend(
    value: Callable[[Array], tuple[Array, Array, Array]],
    x: Array,
    precondition: Callable[[Array], Array],
) -> tuple[Array, bool]:
    """L-BFGS of every column of x for itself, and whether all have settled."""
    total, gradient, _ = value(x)
    pairs: list[tuple[Array, Array, Array]] = []
    for _ in range(STEPS):
        step = -_two_loops(gradient, pairs, precondition)
        slope = (step * gradient).sum(0)
        step = np.where(slope < 0.0, step, -precondition(gradient))
        slope = (step * gradient).sum(0)
        length, new = _search(value, x, step, total, slope)
        moved, change = length * step, new[1] - gradient
        curved = (moved * change).sum(0)
        inverse = np.where(curved > 0.0, 1.0 / np.where(curved > 0.0, curved, 1.0), 0.0)
        pairs = [*pairs, (moved, change, inverse)][-MEMORY:]
        gain = (total - new[0]) / total
        x, total, gradient = x + moved, new[0], new[1]
        if (gain < SETTLED).all():
            return x, True
    return x, False


def _search(
    value: Callable[[Array], tuple[Array, Array, Array]],
    x: Array,
    step: Array,
    total: Array,
    slope: Array,
) -> tuple[Array, tuple[Array, Array, Array]]:
    """Shares (m,) of the steps that lower the energies enough, zero where none does; and what is there."""
    length = np.ones(len(slope))
    for tried in range(SHORTENINGS + 1):
        new = value(x + length * step)
        good = new[0] <= total + 1e-4 * length * slope
        if good.all():
            return length, new
        length = np.where(good, length, 0.3 * length if tried < SHORTENINGS else 0.0)
    return length, value(x + length * step)


def _two_loops(
    gradient: Array, pairs: list[tuple[Array, Array, Array]], precondition: Callable[[Array], Array]
) -> Array:
    q, shares = gradient, list[Array]()
    for s, y, inverse in reversed(pairs):
        shares.append(inverse * (s * q).sum(0))
        q = q - shares[-1] * y
    q = precondition(q)
    if pairs:
        s, y, inverse = pairs[-1]
        scale = (y * precondition(y)).sum(0) * inverse
        q = np.where(scale > 0.0, q / np.where(scale > 0.0, scale, 1.0), q)
    for (s, y, inverse), share in zip(pairs, reversed(shares), strict=True):
        q = q + s * (share - inverse * (y * q).sum(0))
    return q
