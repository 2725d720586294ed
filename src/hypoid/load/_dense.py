"""Dense symmetric positive matrices at BLAS's speed."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import numpy as np
from scipy.linalg import cholesky
from scipy.linalg.blas import dtrsm  # pyright: ignore[reportAttributeAccessIssue]
from threadpoolctl import ThreadpoolController

Array = np.ndarray[Any, Any]
P = ParamSpec("P")
R = TypeVar("R")
LIBRARIES: Any = ThreadpoolController()


def on_one_thread(function: Callable[P, R]) -> Callable[P, R]:
    """The function with BLAS on one thread: among Python's own steps, small matrices wait for its threads too long."""

    @wraps(function)
    def alone(*args: P.args, **kwargs: P.kwargs) -> R:
        with LIBRARIES.limit(limits=1, user_api="blas"):
            return function(*args, **kwargs)

    return alone


def factored(matrix: Array) -> Array:
    """Lower Cholesky factor L (n, n); `matrix` may be overwritten. Raises LinAlgError where it is not positive."""
    return cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)


def lower_solved(factor: Array, right: Array, turned: bool = False) -> Array:
    """L^-1 of columns (n, r), or L^-T where `turned`."""
    columns = np.array(right, order="F")
    made: Any = dtrsm(1.0, factor, columns, lower=1, trans_a=int(turned), overwrite_b=1)
    return made
