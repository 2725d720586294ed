"""Dense symmetric positive matrices at BLAS's speed."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg import cholesky
from scipy.linalg.blas import dtrsm  # pyright: ignore[reportAttributeAccessIssue]

Array = np.ndarray[Any, Any]


def factored(matrix: Array) -> Array:
    """Lower Cholesky factor L (n, n); `matrix` may be overwritten. Raises LinAlgError where it is not positive."""
    return cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)


def lower_solved(factor: Array, right: Array, turned: bool = False) -> Array:
    """L^-1 of columns (n, r), or L^-T where `turned`."""
    columns = np.array(right, order="F")
    made: Any = dtrsm(1.0, factor, columns, lower=1, trans_a=int(turned), overwrite_b=1)
    return made
