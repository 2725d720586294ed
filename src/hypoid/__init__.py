"""Spiral bevel and hypoid gears, from the blank to the contact of the exact tooth surfaces.

>>> import hypoid
>>> pair = hypoid.read("examples/gonzalez-fuentes-2022.toml")  # doctest: +SKIP
>>> points = pair.pinion.concave.at(z, rho)  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathlib import Path

    from .pair import GearPair

__all__ = ["read", "__version__"]

__version__: str  # asked for rarely, so looked up late


def read(path: str | Path) -> GearPair:
    """The gear pair of a design file; a `DesignError` lists all that is wrong with the file."""
    from .design import build
    from .io import read_spec

    return build(read_spec(path))


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("hypoid")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
