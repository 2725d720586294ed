"""Dense symmetric positive matrices at BLAS's speed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from functools import wraps
from threading import Event
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


def side_by_side(jobs: Sequence[Callable[[Event], R]]) -> list[R]:
    """What jobs make that are BLAS's for the most part: as many at once as BLAS has threads, which they share.

    The event is set where one has failed or the user interrupts: the others are then to end.
    """
    stop = Event()
    most = max((library["num_threads"] for library in LIBRARIES.info()), default=1)
    at_once = max(1, min(most, len(jobs)))
    with (
        LIBRARIES.limit(limits=max(1, most // at_once), user_api="blas"),
        ThreadPoolExecutor(at_once) as pool,
    ):
        made = [pool.submit(job, stop) for job in jobs]
        try:
            for one in as_completed(made):
                one.result()
        except BaseException:
            stop.set()
            raise
        return [one.result() for one in made]


def factored(matrix: Array) -> Array:
    """Lower Cholesky factor L (n, n); `matrix` may be overwritten. Raises LinAlgError where it is not positive."""
    columns = matrix.T if matrix.flags.c_contiguous else matrix  # symmetric, so no copy is needed
    return cholesky(columns, lower=True, overwrite_a=True, check_finite=False)


def lower_solved(
    factor: Array, right: Array, turned: bool = False, overwrite: bool = False
) -> Array:
    """L^-1 of columns (n, r), or L^-T where `turned`; `overwrite` allows that in place of `right`."""
    columns = right if overwrite and right.flags.f_contiguous else np.array(right, order="F")
    made: Any = dtrsm(1.0, factor, columns, lower=1, trans_a=int(turned), overwrite_b=1)
    return made
