"""The design files that ship with the package."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).parents[1]


def example_files() -> list[Path]:
    """Paths of the design files; a checkout keeps them beside `src`, an installation within it."""
    folders = (_PACKAGE / "examples", _PACKAGE.parents[1] / "examples")
    return sorted(next(folder for folder in folders if folder.is_dir()).glob("*.toml"))
