"""Smooth functions over a rectangle as tensor polynomials: fitted at Chebyshev nodes, read by Horner.

The fit is done in the Chebyshev basis (well conditioned) and turned once into powers, which Horner
reads fastest; on [-1, 1] that is safe to about order 16 in float64 (measured, methods of contact).
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Float
from numpy.polynomial import chebyshev

from ._jax import Batch


def nodes(n: int) -> Float[np.ndarray[Any, Any], " n"]:
    """The n Chebyshev nodes of the first kind, ascending in (-1, 1)."""
    return -np.cos(np.pi * (np.arange(n) + 0.5) / n)


def _powers_from_values(n: int) -> Float[np.ndarray[Any, Any], "n n"]:
    """Matrix that takes values at the nodes to the coefficients of 1, x, x**2, ..."""
    to_powers = np.zeros((n, n))
    for k in range(n):
        power = chebyshev.cheb2poly(np.eye(n)[k])
        to_powers[: len(power), k] = power
    return to_powers @ np.linalg.inv(chebyshev.chebvander(nodes(n), n - 1))


def fit(values: Float[np.ndarray[Any, Any], "... i j"]) -> Float[np.ndarray[Any, Any], "... i j"]:
    """Power coefficients (..., i, j) of the tensor polynomials through values at the nodes."""
    rows, columns = values.shape[-2:]
    return _powers_from_values(rows) @ values @ _powers_from_values(columns).T


def fit_line(values: Float[np.ndarray[Any, Any], "... i"]) -> Float[np.ndarray[Any, Any], "... i"]:
    """Power coefficients (..., i) of the polynomials in one variable."""
    return values @ _powers_from_values(values.shape[-1]).T


def horner_line(coefficients: Any, x: Batch) -> Batch:
    """Value at x in [-1, 1] of a polynomial given by its powers (i,)."""
    if isinstance(x, np.ndarray) and isinstance(coefficients, np.ndarray) and x.ndim == 1:
        return coefficients @ _powers(x, coefficients.shape[0])
    total = coefficients[-1] + 0.0 * x
    for k in range(coefficients.shape[0] - 2, -1, -1):
        total = total * x + coefficients[k]
    return total


def horner(coefficients: Any, x: Batch, y: Batch) -> Batch:
    """Value at (x, y) in [-1, 1]**2 of a tensor polynomial given by its powers (i, j).

    All columns at once, then along the row: few operations to trace, and XLA fuses them anyway. Numbers in NumPy go
    through a table of powers, which is one small matrix product.
    """
    plain = all(isinstance(v, np.ndarray) for v in (coefficients, x, y))
    if plain and np.ndim(x) == np.ndim(y) == 1:
        by_x, by_y = (_powers(v, n) for v, n in zip((x, y), coefficients.shape, strict=True))
        return ((coefficients.T @ by_x) * by_y).sum(axis=0)
    spread = coefficients.reshape(*coefficients.shape, *(1,) * np.ndim(x))
    columns = spread[-1] + 0.0 * x
    for k in range(coefficients.shape[0] - 2, -1, -1):
        columns = columns * x + spread[k]
    total = columns[-1]
    for k in range(coefficients.shape[1] - 2, -1, -1):
        total = total * y + columns[k]
    return total


def _powers(x: Any, count: int) -> Any:
    """Powers (count, n) of x (n,), from 1 up; a pair of halves at a time."""
    made = np.ones((count, len(x)))
    if count > 1:
        made[1] = x
    for k in range(2, count):
        made[k] = made[k // 2] * made[k - k // 2]
    return made


def on_unit(low: Any, high: Any, value: Any) -> Any:
    """Map [low, high] to [-1, 1]."""
    return (2.0 * value - low - high) / (high - low)


def from_unit(low: Any, high: Any, unit: Any) -> Any:
    """Map [-1, 1] to [low, high]."""
    return 0.5 * ((high + low) + (high - low) * jnp.asarray(unit))
