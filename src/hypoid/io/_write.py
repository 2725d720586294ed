"""Writing files whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from hypoid.geometry import DesignError, Problem


def write_text(path: str | Path, text: str) -> Path:
    """Write a text beside its place, then rename: a reader never sees half a file."""
    return write_bytes(path, text.encode("utf-8", "backslashreplace"))


def write_bytes(path: str | Path, content: bytes, example: str = "-o report.html") -> Path:
    """The same for what is no text."""
    target = Path(path)
    try:
        handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name[:80]}.")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(content)
            mask = os.umask(0)
            os.umask(mask)
            os.chmod(name, 0o666 & ~mask)
            os.replace(name, target)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        given = f"a place that cannot be written ({reason})"
        expected = "a file in a folder that exists"
        raise DesignError([Problem(str(path), given, expected, example)]) from None
    return target
