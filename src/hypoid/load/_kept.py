"""Compliance kept on disk: its key is the mesh, what it is made of and how it is held, and this room's source."""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from platformdirs import user_cache_dir

Array = np.ndarray[Any, Any]
MODULES = (
    "_bricks",
    "_compliance",
    "_dense",
    "_hats",
    "_layers",
    "_love",
    "_material",
    "_superelement",
)
SOURCE = b"".join(Path(__file__).with_name(f"{name}.py").read_bytes() for name in MODULES)


def kept(
    contents: tuple[Any, ...], make: Callable[[], Mapping[str, Array]], folder: Path | None = None
) -> Mapping[str, Array]:
    """Arrays by name: read back if these contents were computed before, else made and kept."""
    digest = hashlib.sha256(SOURCE)
    for value in contents:
        digest.update(value.tobytes() if isinstance(value, np.ndarray) else repr(value).encode())
        digest.update(b";")
    folder = folder or Path(user_cache_dir("hypoid", appauthor=False)) / "compliance"
    path = folder / f"{digest.hexdigest()}.npz"
    with suppress(Exception), np.load(path, allow_pickle=False) as found:
        return {name: found[name] for name in found.files}
    made = make()
    with suppress(OSError):  # a cache that cannot be written costs time, nothing else
        folder.mkdir(parents=True, exist_ok=True)
        handle, part = tempfile.mkstemp(dir=folder)
        try:
            with os.fdopen(handle, "wb") as file:
                np.savez(file, **made)  # pyright: ignore[reportArgumentType]
            Path(part).replace(path)
        except BaseException:
            Path(part).unlink(missing_ok=True)
            raise
    return made
