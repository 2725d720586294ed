"""JAX as the package uses it: float64, a persistent compilation cache, and compiled batches.

Two facts of XLA on the CPU decide how batches run here (measured, see docs/architecture.md):
its fusion recomputes shared subexpressions once for every output, so these functions are compiled
without it; and without fusion every operation passes over memory, so batches go through in pieces
that stay in the cache, one thread a core.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any, ParamSpec, TypeAlias, TypeVar

import jax
import numpy as np
from jaxtyping import Float
from platformdirs import user_cache_dir

jax.config.update("jax_enable_x64", True)
if jax.config.jax_compilation_cache_dir is None:
    jax.config.update(
        "jax_compilation_cache_dir", os.path.join(user_cache_dir("hypoid", appauthor=False), "xla")
    )
    jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.0)
    jax.config.update("jax_persistent_cache_min_entry_size_bytes", 0)

Scalar: TypeAlias = Float[jax.Array, ""] | float
Batch: TypeAlias = Float[jax.Array, "*n"]
Vector: TypeAlias = tuple[Batch, Batch, Batch]  # a batch of vectors, component by component

# The batch sizes that are ever compiled: a batch is padded to the next, or cut into the last.
SIZES = (64, 2048, 32768)
WORKERS = os.cpu_count() or 1


P = ParamSpec("P")
R = TypeVar("R")


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Compile for the top level, without fusion on the CPU (see the module's first lines)."""
    if jax.default_backend() != "cpu":
        return jax.jit(function)
    return jax.jit(function, compiler_options={"xla_disable_hlo_passes": "fusion,cpu-fusion"})


class Batched:
    """A compiled function of (parameters, arrays) that takes arrays of any one length.

    Compiled on first use, so that importing a module compiles nothing. The function gets
    ``(*parameters, *arrays)`` and returns a tuple of arrays of the same length; the answer is one
    NumPy array a component.
    """

    def __init__(self, function: Callable[..., tuple[Batch, ...]], parameters: int) -> None:
        self._function = function
        self._parameters = parameters
        self._compiled: Callable[..., tuple[Batch, ...]] | None = None

    def __call__(self, *arguments: Any) -> tuple[np.ndarray[Any, Any], ...]:
        if self._compiled is None:
            self._compiled = compiled(self._function)
        parameters = arguments[: self._parameters]
        arrays = [np.asarray(a).ravel() for a in arguments[self._parameters :]]
        length = len(arrays[0])
        size = next((s for s in SIZES if s >= length), SIZES[-1])
        if length <= size:
            padded = [np.resize(a, size) if length else np.zeros(size) for a in arrays]
            return tuple(
                np.asarray(component)[:length] for component in self._compiled(*parameters, *padded)
            )
        return self._in_pieces(partial(self._compiled, *parameters), arrays, length, size)

    @staticmethod
    def _in_pieces(
        call: Callable[..., tuple[Batch, ...]],
        arrays: list[np.ndarray[Any, Any]],
        length: int,
        size: int,
    ) -> tuple[np.ndarray[Any, Any], ...]:
        first = call(*(a[:size] for a in arrays))
        out = tuple(np.zeros(length, dtype=component.dtype) for component in first)

        def piece(start: int) -> None:
            start = min(start, length - size)  # the last piece overlaps its neighbour
            part = slice(start, start + size)
            answer = call(*(a[part] for a in arrays)) if start else first
            for target, component in zip(out, answer, strict=True):
                target[part] = component

        with ThreadPoolExecutor(WORKERS) as pool:
            list(pool.map(piece, range(0, length, size)))
        return out
