"""A tooth's condensation with MUMPS beside our own, layer by layer; for docs/loaded-contact.md, run by hand.

    pip install python-mumps    # builds with Debian's libmumps-seq-dev
    OPENBLAS_NUM_THREADS=1 python benchmarks/with_mumps.py

Both answer the same: `load`' K^-1 `load` for all hats and both cuts of a tooth, on one thread.
"""

from __future__ import annotations

import time
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import mumps  # pyright: ignore[reportMissingImports]
import numpy as np

import hypoid
from hypoid.load import MESHES, tooth_compliance
from hypoid.load import _superelement as superelement
from hypoid.load._setup import elements_of

EXAMPLE = Path(__file__).parent.parent / "examples" / "gonzalez-fuentes-2022-relief.toml"
AT_ONCE = 256  # columns


def by_mumps(matrix: Any, place: Any, load: Any, sight: Any, progress: Any = None) -> Any:
    """As `_layers.through`."""
    context: Any = mumps.Context()
    context.set_matrix(matrix.tocoo(), symmetric=True)
    context.factor()
    load, sight = load.tocsc(), sight.tocsc()
    found, seen = [], []
    for start in range(0, load.shape[1], AT_ONCE):
        part = np.asfortranarray(load[:, start : start + AT_ONCE].toarray())
        moved = context.solve(part)
        found.append(load.T @ moved)
        seen.append(sight.T @ moved)
    return np.hstack(found), np.hstack(seen)


def main() -> None:
    """Print the times of both members by both ways, and how far their answers differ."""
    pair = hypoid.read(EXAMPLE)
    ours = superelement.through
    kept: list[Any] = []

    def both(matrix: Any, place: Any, load: Any, sight: Any, progress: Any = None) -> Any:
        start = time.perf_counter()
        first = ours(matrix, place, load, sight)
        middle = time.perf_counter()
        second = by_mumps(matrix, place, load, sight)
        end = time.perf_counter()
        away = np.abs(second[0] - first[0]).max() / np.abs(first[0]).max()
        kept.append((matrix.shape[0], load.shape[1], middle - start, end - middle, away))
        return first

    superelement.through = both
    for member, flank in zip((pair.pinion, pair.wheel), pair.mates("drive"), strict=True):
        kept.clear()
        sizes = elements_of(member, MESHES["usual"])
        with TemporaryDirectory() as nowhere:
            tooth_compliance(member, flank.side, elements=sizes, cache=Path(nowhere))
        unknowns, columns, sections, direct, away = kept[0]
        print(
            f"{member.name}: {unknowns} unknowns, {columns} columns; sections {sections:.1f} s, "
            f"MUMPS {direct:.1f} s, answers differ by {away:.1e}"
        )


if __name__ == "__main__":
    main()
