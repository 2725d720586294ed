"""Polynomials in one variable by Estrin's scheme: short chains of arithmetic keep a CPU's pipes full."""

from __future__ import annotations

from collections.abc import Sequence

from ._jax import Batch, Scalar


def polynomial(coefficients: Sequence[Scalar], x: Batch) -> Batch:
    """c0 + c1 x + c2 x**2 + ...; coefficients from the constant up."""
    terms = list(coefficients)
    while len(terms) > 1:
        pairs = [
            terms[k] + terms[k + 1] * x if k + 1 < len(terms) else terms[k]
            for k in range(0, len(terms), 2)
        ]
        terms, x = pairs, x * x
    return terms[0]
