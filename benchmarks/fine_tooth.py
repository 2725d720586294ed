"""A pinion tooth against fine elements: the table of docs/validation/loaded-contact.md.

    python benchmarks/fine_tooth.py docs/validation/pinion-tooth.csv

Three references of fine elements, and the method with more and fewer elements and cells; see `pinion_tooth` among the
tests.
"""

from __future__ import annotations

import csv
import sys
import time
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

import hypoid
from hypoid.load import MESHES, Elements
from hypoid.load import _patch as patches
from hypoid.load._meeting import Meeting
from hypoid.load._setup import elements_of
from hypoid.pair import GearPair

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from overlaid import (  # pyright: ignore[reportMissingImports]
    Overlaid,
    overlaid,
    tooth,
)
from pinion_tooth import (  # pyright: ignore[reportMissingImports]
    COARSE,
    FINE,
    RIDGE,
    Fineness,
    by_elements,
    by_method,
    drive_meeting,
    fine_block,
    fine_tooth,
    ours,
    reach,
)

Array = np.ndarray[Any, Any]
EXAMPLE = Path(__file__).parents[1] / "examples" / "gonzalez-fuentes-2022.toml"
TORQUES = (2.0, 4.0)  # N m
FINER_BLOCK = Fineness(12, 12, 6, 0.25, 0.022)
PARTS = 8  # of the contact's length, whose line loads are compared


def reference(pair: GearPair, met: Meeting, span: Array, fine: Fineness) -> Overlaid:
    """The reference's compliance."""
    start = time.process_time()
    whole = fine_tooth(pair, met, fine)
    made, on = fine_block(met, span, fine)
    found = overlaid(met, whole, made, on)
    softer = np.linalg.eigvalsh(found.compliance - found.whole)
    print(
        f"{len(whole.nodes)} + {len(made.nodes)} nodes, {len(on)} hats, least {found.least:.1e}, the block adds "
        f"{softer.min():.1e} to {softer.max():.1e} mm/N, {time.process_time() - start:.0f} s",
        flush=True,
    )
    return found


def main() -> None:
    """All references and the method, for each torque."""
    pair = hypoid.read(EXAMPLE)
    met = drive_meeting(pair)
    usual = replace(MESHES["usual"], rim=4)
    side = met.contact.pinion_flank.side
    meshes = {
        "here": elements_of(pair.pinion, usual),
        "here_twenty_along": usual,
        "here_finer": Elements(along=64, profile=10, fillet=6, through=4, below=2, rim=4),
    }
    teeth = {name: ours(met, tooth(pair.pinion, side, sizes)) for name, sizes in meshes.items()}
    spans = {t: reach(met, teeth["here"], 1e3 * t) for t in TORQUES}
    widest = max(spans.values(), key=np.ptp)
    references = {
        "reference": reference(pair, met, widest, FINE),
        "coarse_reference": reference(pair, met, widest, COARSE),
        "finer_block": reference(pair, met, widest, FINER_BLOCK),
    }
    made: list[dict[str, Any]] = []
    for torque, span in spans.items():
        ends = np.linspace(span[0, 0], span[1, 0], PARTS + 1)
        found = {"here": by_method(met, teeth["here"], 1e3 * torque, ends)}
        found |= {n: by_elements(r, 1e3 * torque, ends) for n, r in references.items()}
        found |= {n: by_method(met, t, 1e3 * torque, ends) for n, t in teeth.items()}
        before = patches.COLUMNS, patches.ROWS
        patches.COLUMNS, patches.ROWS = 2 * before[0], 2 * before[1]
        found["here_cells_x4"] = by_method(met, teeth["here"], 1e3 * torque, ends)
        patches.COLUMNS, patches.ROWS = before
        names = ["rotation [urad]", "greatest pressure [MPa]", f"over {RIDGE:g} mm [MPa]"]
        names += [f"{a:.2f} to {b:.2f} mm [N/mm]" for a, b in pairwise(ends)]
        values = {n: [1e6 * r.rotation, r.peak, r.ridge, *r.line] for n, r in found.items()}
        for k, name in enumerate(names):
            row: dict[str, Any] = {"torque_Nm": f"{torque:g}", "what": name}
            off = 100.0 * (values["here"][k] / values["reference"][k] - 1.0)
            row |= {"here_off_%": f"{off:+.1f}"} | {n: f"{v[k]:.1f}" for n, v in values.items()}
            made.append(row)
            print(row, flush=True)
    with Path(sys.argv[1]).open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(made[0]))
        writer.writeheader()
        writer.writerows(made)


if __name__ == "__main__":
    main()
