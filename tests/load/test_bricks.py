"""20-node bricks against an exact solution of elasticity: the orders at which they come near to it."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from scipy.sparse.linalg import spsolve

from hypoid.load import STEEL
from hypoid.load._bricks import nodal_stress, stiffness
from hypoid.solid._split import _lattice

Array = np.ndarray[Any, Any]
RATES = np.array([np.sqrt(2.0), 1.0, 1.0])  # of sin, exp, exp: a harmonic function of x, y and z


def exact(at: Array) -> Array:
    """Displacement (n, 3), mm: the gradient of a harmonic function, which is in equilibrium without a load."""
    x, y, z = at.T
    rise = 1e-3 * np.exp(y + z)
    sine, cosine = np.sin(RATES[0] * x), np.cos(RATES[0] * x)
    return np.stack([RATES[0] * cosine * rise, sine * rise, sine * rise], axis=1)


def exact_stress(at: Array) -> Array:
    """Stress (n, 6), MPa: 2 mu times the function's second derivatives, in the order of `nodal_stress`."""
    x, y, z = at.T
    _, mu = STEEL.lame
    rise = 2e-3 * mu * np.exp(y + z)
    sine, cosine = np.sin(RATES[0] * x), RATES[0] * np.cos(RATES[0] * x)
    rows = (-2.0 * sine, sine, sine, cosine, sine, cosine)
    return np.stack([row * rise for row in rows], axis=1)


def block(n: int) -> tuple[Array, Array]:
    """Nodes (m, 3) and elements (n**3, 20) of a cube of 1 mm, its inside sheared and bent."""
    grid, elements = _lattice([np.linspace(0.0, 1.0, n + 1)] * 3)
    bump = 0.15 * np.prod(np.sin(np.pi * grid), axis=1)
    return grid + bump[:, None] * [1.0, -0.7, 0.4], elements


def solved(n: int) -> tuple[float, float, float]:
    """Error of displacement, the energy (N mm), and error of stress at corners within; errors as parts."""
    nodes, elements = block(n)
    border = ((nodes < 1e-9) | (nodes > 1.0 - 1e-9)).any(axis=1)
    matrix = stiffness(nodes, elements, STEEL)
    moved = exact(nodes).ravel()
    held = np.repeat(border, 3)
    inner = np.flatnonzero(~held)
    known = exact(nodes).ravel()
    moved[inner] = spsolve(
        matrix[inner][:, inner].tocsc(), -(matrix[inner][:, np.flatnonzero(held)] @ known[held])
    )
    away = (moved - known).reshape(-1, 3)
    energy = 0.5 * float(moved @ (matrix @ moved))
    corners = np.setdiff1d(np.unique(elements[:, :8]), np.flatnonzero(border))
    stress = (nodal_stress(nodes, elements, corners, STEEL) @ moved).reshape(-1, 6)
    right = exact_stress(nodes[corners])
    return (
        float(np.sqrt((away**2).mean()) / np.abs(known).max()),
        energy,
        float(np.abs(stress - right).max() / np.abs(right).max()),
    )


def exact_energy() -> float:
    """mu times the integral of the second derivatives' squares over the cube, N mm."""
    x, w = np.polynomial.legendre.leggauss(12)
    at = np.array(list(product(0.5 * (x + 1.0), repeat=3)))
    weight = np.array([np.prod(v) for v in product(0.5 * w, repeat=3)])
    stress = exact_stress(at)
    _, mu = STEEL.lame
    squares = (stress[:, :3] ** 2).sum(axis=1) + 2.0 * (stress[:, 3:] ** 2).sum(axis=1)
    return float(weight @ squares / (4.0 * mu))


def test_bricks_converge_at_their_orders() -> None:
    """Of second degree: displacement by the third power of their size, energy by the fourth, stress by the second."""
    found = [solved(n) for n in (3, 6)]
    energy = exact_energy()
    moved, stress = ((found[0][k] / found[1][k]) for k in (0, 2))
    high = [one[1] - energy for one in found]  # held borders: elements are too stiff
    assert found[1][0] < 1e-4
    assert np.log2(moved) > 2.8
    assert high[0] > high[1] > 0.0
    assert np.log2(high[0] / high[1]) > 3.6
    assert np.log2(stress) > 1.8
