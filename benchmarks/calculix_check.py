"""Loaded contact against CalculiX, for docs/validation/loaded-contact.md; run by hand.

    python benchmarks/calculix_check.py --folder OUT --torque "30 N m" --elements 12,6,2,4,2,1 --teeth 5

OUT keeps CalculiX's files: where it holds a finished run of the same input, that is read instead of another run.
`--keep tests/load/calculix_contact.json` writes the answer that tests compare with where CalculiX is not installed, and
with `--finer 6` that of `tests/load/calculix_finer.json`, which takes ten minutes of processor time.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import time
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import numpy as np

import hypoid
from hypoid.io import contact_text, parse, read_contact
from hypoid.load import (
    ContactAnswer,
    ContactModel,
    Elements,
    LoadedPosition,
    contact_model,
    hat_widths,
    loaded_contact,
    tooth_compliance,
)
from hypoid.pair import GearPair

EXAMPLE = Path(__file__).parent.parent / "examples" / "gonzalez-fuentes-2022-relief.toml"


def overlap(position: LoadedPosition, stiffness: float, torque: float) -> float:
    """What a pressure per overlap (N/mm3) adds to a rotation, rad: its work under the pressures found here."""
    return sum(float(p.pressure**2 @ p.area) for p in position.pairs) / (stiffness * torque)


def solved(model: ContactModel, folder: Path, stiffness: float) -> float:
    """CalculiX on a model in `folder`, unless it was there already; its CPU time, s, as far as that is known."""
    folder.mkdir(parents=True, exist_ok=True)
    text, job = contact_text(model, stiffness), folder / "contact.inp"
    taken = folder / "cpu-seconds"
    if not (taken.exists() and job.exists() and job.read_text() == text):
        job.write_text(text)
        start = os.times()
        subprocess.run(["ccx", "contact"], cwd=folder, check=True, capture_output=True)
        end = os.times()
        spent = (
            end.children_user + end.children_system - start.children_user - start.children_system
        )
        taken.write_text(f"{spent:.1f}")
    return float(taken.read_text())


def ours(pair: GearPair, model: ContactModel) -> tuple[LoadedPosition, float, float]:
    """`loaded_contact` with the same elements at pinion angle zero; CPU time of compliance, and of a position."""
    start = time.process_time()
    members = [
        tooth_compliance(member, flank.side, elements=sizes)
        for member, flank, sizes in zip(
            (pair.pinion, pair.wheel), pair.mates(model.direction), model.elements, strict=True
        )
    ]
    made = time.process_time() - start
    loaded_contact(pair, model.direction, [model.torque], *members, positions=5)  # compiles
    start = time.process_time()
    found = loaded_contact(pair, model.direction, [model.torque], *members, positions=5)
    return found.cases[0].positions[2], made, 0.5 * (time.process_time() - start)


def kept(model: ContactModel, answer: ContactAnswer, finer: int) -> dict[str, Any]:
    """An answer as JSON, with what tells its model from others."""

    def plain(value: Any) -> Any:
        return value.tolist() if isinstance(value, np.ndarray) else value

    told = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout
    own = {f.name: plain(getattr(answer, f.name)) for f in fields(answer) if f.name != "pairs"}
    pairs = [{f.name: plain(getattr(p, f.name)) for f in fields(p)} for p in answer.pairs]
    sizes = [asdict(e) for e in model.elements]
    return {"by": " ".join(told.split()), "elements": sizes, "finer": finer, **own, "pairs": pairs}


def main() -> None:
    """Print the tables of one case."""
    given = argparse.ArgumentParser(description=__doc__)
    given.add_argument("--folder", type=Path, required=True)
    given.add_argument("--torque", default="30 N m")
    given.add_argument("--elements", default="8,5,2,2,1,1", help="as the fields of Elements")
    given.add_argument("--design", type=Path, default=EXAMPLE)
    given.add_argument("--finer", type=int, default=1, help="elements for one where pairs bear")
    given.add_argument("--stiffness", type=float, default=1e7, help="pressure per overlap, N/mm3")
    given.add_argument("--teeth", type=int, default=5)
    given.add_argument("--keep", type=Path, help="a JSON file for the answer")
    asked = given.parse_args()
    pair = hypoid.read(asked.design)
    sizes = Elements(*map(int, asked.elements.split(",")))
    torque = parse(asked.torque, "torque")
    model = contact_model(
        pair, "drive", torque, teeth=asked.teeth, elements=sizes, finer=asked.finer
    )
    spent = solved(model, asked.folder, asked.stiffness)
    theirs = read_contact(asked.folder / "contact.dat", model)
    if asked.keep is not None:
        asked.keep.write_text(json.dumps(kept(model, theirs, asked.finer), indent=1) + "\n")
    position, made, one = ours(pair, model)
    nodes = len(model.pinion.nodes), len(model.wheel.nodes)
    print(
        f"elements {model.elements}\nnodes {nodes[0]} + {nodes[1]}, teeth {model.pinion.teeth} + {model.wheel.teeth}"
    )
    print(f"faces off the flank by {1e3 * max(model.surface_error):.2f} um")
    more = overlap(position, asked.stiffness, torque)
    print(
        f"rotation: CalculiX {1e6 * theirs.rotation:.1f} urad, here {1e6 * position.rotation:.1f}, "
        f"with as much overlap {1e6 * (position.rotation + more):.1f}"
    )
    print(f"moments of the contact miss the torque by {1e2 * theirs.balance:.3f} %")
    print(f"CPU s: CalculiX {spent:.0f}, compliance {made:.1f}, one position here {one:.2f}")
    width = hat_widths(theirs.distance)
    by_pair = {p.pair: p for p in theirs.pairs}
    for load in position.pairs:
        columns = load.wheel_hats.reshape(len(width), -1).sum(axis=1)
        found = by_pair.get(load.pair)
        if found is None:
            print(f"pair {load.pair:+d}: share here {load.share:.4f}, no contact in CalculiX")
            continue
        print(
            f"pair {load.pair:+d}: share CalculiX {found.share:.4f}, here {load.share:.4f}; force {found.force:.0f}, "
            f"{load.force:.0f} N; greatest pressure {found.max_pressure:.0f}, {load.max_pressure:.0f} MPa; middle of "
            f"the load at S = {theirs.distance @ found.column_force / found.column_force.sum():.2f}, "
            f"{theirs.distance @ columns / columns.sum():.2f} mm"
        )
        some = np.flatnonzero((columns > 1.0) | (found.column_force > 1.0))
        for i in some:
            print(
                f"    S = {theirs.distance[i]:.2f} mm: {found.column_force[i] / width[i]:.1f}, "
                f"{columns[i] / width[i]:.1f} N/mm"
            )


if __name__ == "__main__":
    main()
