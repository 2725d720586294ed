"""Writing files whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from hypoid.geometry import DesignError, Problem


def write_text(path: str | Path, text: str) -> Path:
    """Write a text beside its place, then rename: a reader never sees half a file."""
    target = Path(path)
    try:
        handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name[:80]}.")
        try:
            with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
                file.write(text)
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
        raise DesignError([Problem(str(path), given, expected, "-o report.html")]) from None
    return target
