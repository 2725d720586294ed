"""Stiffness and stress of 20-node bricks, all elements at once [Zienkiewicz, Taylor: The FEM, vol. 1]."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from scipy import sparse

from hypoid.solid import shape_gradients

from ._material import Material

Array = np.ndarray[Any, Any]
CHUNK = 512
VOIGT = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))  # order of stress components


def gauss(count: int) -> tuple[Array, Array]:
    """Points (count**3, 3) in [-1, 1] and weights of a brick."""
    x, w = np.polynomial.legendre.leggauss(count)
    points = np.array(list(product(x, repeat=3)))
    return points, np.array([np.prod(v) for v in product(w, repeat=3)])


def gradients(places: Array, local: Array) -> tuple[Array, Array]:
    """Gradients (m, points, 3, 20), 1/mm, and volumes (m, points) of nodes at places (m, 20, 3)."""
    slopes = np.einsum("qdk,mkx->mqdx", local, places, optimize=True)  # dx / d(local)
    return np.linalg.solve(slopes, np.broadcast_to(local, (len(places), *local.shape))), np.abs(
        np.linalg.det(slopes)
    )


def stiffness(nodes: Array, elements: Array, made_of: Material) -> Any:
    """Stiffness (3n, 3n), N/mm, sparse and symmetric; degree of freedom 3 node + direction."""
    points, weights = gauss(3)
    local = shape_gradients(points)
    lam, mu = made_of.lame
    size = 3 * elements.shape[1]
    total: Any = sparse.csc_array((3 * len(nodes), 3 * len(nodes)))
    for start in range(0, len(elements), CHUNK):
        part = elements[start : start + CHUNK]
        m = len(part)
        slope, volume = gradients(nodes[part], local)
        row = slope.transpose(0, 1, 3, 2).reshape(m, len(points), size)
        row *= np.sqrt(volume * weights)[..., None]
        outer = (row.transpose(0, 2, 1) @ row).reshape(m, -1, 3, size // 3, 3)
        turned = outer.transpose(0, 1, 4, 3, 2)
        own = lam * outer + mu * turned
        trace = mu * np.trace(outer, axis1=2, axis2=4)
        for d in range(3):
            own[:, :, d, :, d] += trace
        dof = (3 * part[..., None] + np.arange(3)).reshape(m, size)
        ij = (np.repeat(dof, size, axis=1).ravel(), np.tile(dof, (1, size)).ravel())
        total = total + sparse.coo_array((own.ravel(), ij), shape=total.shape).tocsc()
    return 0.5 * (total + total.T)


def nodal_stress(nodes: Array, elements: Array, at: Array, made_of: Material) -> Any:
    """Operator (6p, 3n), MPa/mm, from displacements to stress (VOIGT) at corner nodes `at` (p,).

    Stress at 2 x 2 x 2 Gauss points, where it is best, carried on to the corners and averaged over all
    elements that share the node.
    """
    number = np.full(len(nodes), -1)
    number[at] = np.arange(len(at))
    own = elements[(number[elements[:, :8]] >= 0).any(axis=1)]
    points, _ = gauss(2)
    slope, _ = gradients(nodes[own], shape_gradients(points))
    lam, mu = made_of.lame
    m, size = len(own), 3 * elements.shape[1]
    stress = np.zeros((m, 8, 6, elements.shape[1], 3))
    for v, (i, j) in enumerate(VOIGT):
        stress[:, :, v, :, i] += mu * slope[:, :, j]
        stress[:, :, v, :, j] += mu * slope[:, :, i]
        if i == j:
            stress[:, :, v] += lam * slope.transpose(0, 1, 3, 2)
    corners = np.array(
        [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]
    )  # fmt: skip
    # trilinear through the Gauss points, read at the corners
    carried = (0.5 * (1.0 + 3.0 * corners[:, None, :] * points[None])).prod(axis=-1)
    stress = np.einsum("cq,mqvx->mcvx", carried, stress.reshape(m, 8, 6, size), optimize=True)
    element, corner = np.nonzero(number[own[:, :8]] >= 0)
    node = number[own[element, corner]]
    share = 1.0 / np.bincount(node, minlength=len(at))[node]
    values = stress[element, corner] * share[:, None, None]
    dof = (3 * own[element][..., None] + np.arange(3)).reshape(len(element), 1, size)
    rows = np.broadcast_to((6 * node[:, None] + np.arange(6))[..., None], values.shape)
    columns = np.broadcast_to(dof, values.shape)
    shape = (6 * len(at), 3 * len(nodes))
    return sparse.coo_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=shape).tocsr()
