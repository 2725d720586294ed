"""Compiled functions kept on disk: the second start of a command neither traces nor compiles.

JAX's own cache keeps what XLA made, but Python still traces every function to find it. Here the key
is the package's source text, the function's name and the shapes it is called with.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import platform
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, Generic, TypeVar

import jax
import numpy as np
from jax.experimental import serialize_executable
from platformdirs import user_cache_dir

R = TypeVar("R")


@cache
def _everything_else() -> bytes:
    """Digest of all that an executable depends on besides its function and shapes."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.parent.rglob("*.py")):
        digest.update(path.read_bytes())
    device = jax.devices()[0]
    digest.update(f"{jax.__version__} {device.platform} {device.device_kind}".encode())
    cpu = Path("/proc/cpuinfo")
    lines = cpu.read_text().splitlines() if cpu.exists() else []
    flags = [line for line in lines if line.startswith("flags")][:1]
    digest.update(f"{platform.machine()} {platform.processor()} {flags}".encode())
    return digest.digest()


class Stored(Generic[R]):
    """A function compiled for the top level once a shape and kept on disk; arguments are trees."""

    def __init__(
        self,
        function: Callable[..., R],
        options: Callable[[], dict[str, Any] | None],
        name: str = "",
    ) -> None:
        self._function = function
        self._name = name or f"{function.__module__}.{function.__qualname__}"
        self._options = options
        self._ready: dict[Any, Callable[..., R]] = {}

    def __call__(self, *arguments: Any) -> R:
        leaves, tree = jax.tree_util.tree_flatten(arguments)
        leaves = [np.asarray(leaf) for leaf in leaves]
        shapes = tuple((leaf.shape, leaf.dtype.str) for leaf in leaves)
        ready = self._ready.get((tree, shapes))
        if ready is None:
            ready = self._ready[tree, shapes] = self._load_or_compile(tree, shapes, leaves)
        return ready(*leaves)

    def _load_or_compile(self, tree: Any, shapes: Any, leaves: list[Any]) -> Callable[..., R]:
        asked = f"{self._name} {tree} {shapes}".encode()
        key = hashlib.sha256(_everything_else() + asked).hexdigest()
        folder = Path(user_cache_dir("hypoid", appauthor=False)) / "executables"
        path = folder / key
        with suppress(Exception):  # not there, half there, or of another build: compile
            kept = serialize_executable.deserialize_and_load(*pickle.loads(path.read_bytes()))
            jax.block_until_ready(kept(*leaves))  # what cannot run shows itself here
            return kept

        def flat(*values: Any) -> R:
            return self._function(*jax.tree_util.tree_unflatten(tree, values))

        # Never through JAX's own cache: what was read back from there cannot be kept again.
        made = jax.jit(flat, compiler_options=self._options()).lower(*leaves).compile()
        with suppress(Exception):  # a cache that cannot be written costs time, nothing else
            folder.mkdir(parents=True, exist_ok=True)
            handle, part = tempfile.mkstemp(dir=folder)
            with os.fdopen(handle, "wb") as file:
                pickle.dump(serialize_executable.serialize(made), file)
            Path(part).replace(path)
        return made  # pyright: ignore[reportReturnType]
