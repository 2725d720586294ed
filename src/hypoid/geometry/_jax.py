"""JAX as the package uses it: float64, executables kept on disk, and compiled batches.

XLA on the CPU fuses what feeds one output into one kernel, and computes whatever several outputs
share once for each of them. So the formulas mark what is worth computing once (``once``), kernels
end there, and batches go through in blocks that stay in the cache, one thread a core (measured,
see docs/architecture.md).
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from typing import Any, ParamSpec, TypeAlias, TypeVar

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from ._namespace import namespace
from ._stored import Stored

jax.config.update("jax_enable_x64", True)

# NumPy's arrays, JAX's and its tracers pass through the same formulas; no static type covers them.
Scalar: TypeAlias = Any  # one number
Batch: TypeAlias = Any  # (*n,) numbers
Vector: TypeAlias = tuple[Batch, Batch, Batch]  # a batch of vectors, component by component
Rows: TypeAlias = Float[np.ndarray[Any, Any], "m n"]  # an answer: one row a component

POINTS = 32768  # points that one compiled call takes at most
WORKERS = os.cpu_count() or 1

# Without these XLA drops the marks of ``once`` before it fuses; the older emitters compile kernels
# in half the time and run them as fast. A jaxlib that knows no such option gets none.
KEEP_MARKS: dict[str, Any] = {"xla_disable_hlo_passes": "cse_barrier_expander"}
QUICK_TO_COMPILE: dict[str, Any] = {**KEEP_MARKS, "xla_cpu_use_fusion_emitters": False}

P = ParamSpec("P")
R = TypeVar("R")
Tree = TypeVar("Tree")


def once(values: Tree) -> Tree:
    """The same values, kept in memory: whatever uses them reads them, nothing computes them again."""
    return values if namespace(values) is np else jax.lax.optimization_barrier(values)


@cache
def _options() -> dict[str, Any] | None:
    if jax.default_backend() != "cpu":
        return None
    for options in (QUICK_TO_COMPILE, KEEP_MARKS):
        try:
            jax.jit(lambda x: x, compiler_options=options).lower(0.0).compile()
        except jax.errors.JaxRuntimeError:
            continue
        return options
    return None


def compiled(function: Callable[..., R], name: str = "") -> Callable[..., R]:
    """Compile for the top level, with the marks of ``once`` kept on the CPU; kept on disk."""
    return Stored(function, _options, name)


def jitted(function: Callable[..., R]) -> Callable[..., R]:
    """``jax.jit`` with the marks of ``once`` kept on the CPU: for derivatives of what is computed here.

    Plain ``jax.jit`` gives the same numbers but may take minutes to compile them. Nothing is stored.
    """
    return jax.jit(function, compiler_options=_options())


def compiled_fused(function: Callable[..., R]) -> Callable[..., R]:
    """The same for functions of one output, which XLA's own fusion serves best."""
    return Stored(function, lambda: None)


class Batched:
    """A compiled function of (parameters, arrays) that takes arrays of any one length.

    The function gets ``(*parameters, *arrays)`` and returns a tuple of arrays of that length; the
    answer has one row a component. It is compiled once, on first use, for blocks of ``block``
    points and as many of them as a call has: importing a module compiles nothing, and neither does
    another length. Small blocks suit short batches, since one block is the least that is computed; ``most`` is
    what one call hands over, which costs as much for a short batch as for a full one.
    """

    def __init__(
        self,
        function: Callable[..., tuple[Batch, ...]],
        parameters: int,
        block: int = 2048,
        most: int = POINTS,
    ) -> None:
        self._function = function
        self._parameters = parameters
        self._most = most
        self._shape = (most // block, block)
        self._compiled: Callable[..., tuple[Batch, ...]] | None = None

    def __call__(self, *arguments: Any) -> Rows:
        if self._compiled is None:
            inner = self._function
            name = f"{inner.__module__}.{inner.__qualname__} in blocks of {self._shape}"
            self._compiled = compiled(self._blocks, name)
        # Numbers of one type in one vector: nothing compiles twice, and a call hands over little.
        parameters = Packed(arguments[: self._parameters])
        arrays = [np.asarray(a, float).ravel() for a in arguments[self._parameters :]]
        length = len(arrays[0])
        call = partial(self._compiled, parameters)
        first = self._piece(call, arrays, 0)
        answer = np.zeros((len(first), length))
        most = self._most
        answer[:, :most] = [row[:length] for row in first]

        def piece(start: int) -> None:
            part = slice(start, start + most)
            for target, row in zip(answer[:, part], self._piece(call, arrays, start), strict=True):
                target[:] = row[: len(target)]

        with ThreadPoolExecutor(WORKERS) as pool:
            list(pool.map(piece, range(most, length, most)))
        return answer

    def _piece(
        self, call: Callable[..., tuple[Batch, ...]], arrays: list[np.ndarray[Any, Any]], start: int
    ) -> list[np.ndarray[Any, Any]]:
        """One call's worth of points from ``start`` on; only what is asked for means anything."""
        parts = [a[start : start + self._most] for a in arrays]
        length = len(parts[0])
        if length < self._most:
            parts = [_padded(a, self._most) for a in parts]
        blocks = -(-length // self._shape[1])
        return [
            np.asarray(c).ravel() for c in call(blocks, *(a.reshape(self._shape) for a in parts))
        ]

    def _blocks(self, packed: Packed, count: int, *arrays: Batch) -> tuple[Batch, ...]:
        function = jax.jit(self._function)  # traced once, though its shape is asked for first
        parameters = packed.unpacked()

        def answer(index: Any) -> tuple[Batch, ...]:
            return once(function(*parameters, *(a[index] for a in arrays)))

        def step(index: Any, total: tuple[Batch, ...]) -> tuple[Batch, ...]:
            return tuple(t.at[index].set(a) for t, a in zip(total, answer(index), strict=True))

        rows = len(jax.eval_shape(answer, 0))
        return jax.lax.fori_loop(0, count, step, (jnp.zeros(self._shape),) * rows)


@jax.tree_util.register_pytree_node_class
class Packed:
    """A tree of numbers as one vector of float64, with what is needed to unpack it."""

    def __init__(self, tree: Any) -> None:
        leaves, structure = jax.tree_util.tree_flatten(tree)
        parts = [np.asarray(leaf, dtype=np.float64) for leaf in leaves]
        self._form = (structure, tuple(part.shape for part in parts))
        self._vector: Any = np.concatenate([[0.0], *(part.ravel() for part in parts)])

    def unpacked(self) -> Any:
        """The tree again, its leaves read from the vector."""
        structure, shapes = self._form
        leaves: list[Any] = []
        start = 1
        for shape in shapes:
            size = math.prod(shape)
            leaves.append(self._vector[start : start + size].reshape(shape))
            start += size
        return jax.tree_util.tree_unflatten(structure, leaves)

    def tree_flatten(self) -> tuple[tuple[Any], Any]:
        return (self._vector,), self._form

    @classmethod
    def tree_unflatten(cls, form: Any, vector: tuple[Any]) -> Packed:
        made = object.__new__(cls)
        made._form, (made._vector,) = form, vector
        return made


def _padded(part: np.ndarray[Any, Any], most: int) -> np.ndarray[Any, Any]:
    """Filled up to a whole call with copies of its last point, which is as harmless as the rest."""
    filled = np.full(most, part[-1] if len(part) else 0.0)
    filled[: len(part)] = part
    return filled
