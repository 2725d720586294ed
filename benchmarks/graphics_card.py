"""The same flanks and contact on a graphics card and on the processor beside it, for docs/architecture.md; run by hand.

    python benchmarks/graphics_card.py

Needs JAX with a plugin for the card. Prints points a second by both ways, and by how much results differ.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

EXAMPLES = ("gonzalez-fuentes-2022", "tsay-lin-1993")
COUNT, KEPT = 1_000_000, 5000  # points of a flank, and every so manieth is compared


def measured() -> dict[str, Any]:
    """What this process's backend makes of both examples."""
    import jax

    import hypoid
    from hypoid.contact import unloaded_contact
    from hypoid.pair import Direction

    ways: tuple[Direction, Direction] = ("drive", "coast")

    def warm(work: Any) -> tuple[float, Any]:
        work()
        start = time.perf_counter()
        found = work()
        return time.perf_counter() - start, found

    made: dict[str, Any] = {"device": str(jax.devices()[0])}
    for name in EXAMPLES:
        pair = hypoid.read(Path(__file__).parent.parent / "examples" / f"{name}.toml")
        for flank in pair.flanks():
            random = np.random.default_rng(0)
            s = random.uniform(flank.toe, flank.heel, COUNT)
            h = random.uniform(flank.active_chart.bounds(s)[0], flank.tip.at(s))
            z, rho = flank.cone.axial_radial(s, h)
            at = flank.at(z[:1000], rho[:1000])
            given = np.resize(at.s, COUNT), np.resize(at.theta, COUNT)
            cutter, points = warm(lambda f=flank, g=given: f.at_cutter(*g))
            place, seen = warm(lambda f=flank, p=(z, rho): f.at(*p))
            made[f"{name}/{flank.name}"] = {
                "at cutter parameters": COUNT / cutter,
                "at (z, rho)": COUNT / place,
                "points": [points[0][::KEPT].tolist(), seen.position[::KEPT].tolist()],
            }
        for direction in ways:
            seconds, contact = warm(partial(unloaded_contact, pair, direction))
            made[f"{name}/{direction}"] = {"contact": 1.0 / seconds, "TE": contact.peak_to_peak}
    return made


def main() -> None:
    """Both backends, each in a process of its own."""
    found: list[dict[str, Any]] = []
    for platform in ("cpu", "cuda"):
        told = {**os.environ, "JAX_PLATFORMS": platform}
        got = subprocess.run(
            [sys.executable, __file__, "--measure"], env=told, stdout=subprocess.PIPE, check=True
        )
        found.append(json.loads(got.stdout))
    one, other = found
    print(one.pop("device"), "|", other.pop("device"))
    apart = 0.0
    for name, own in one.items():
        if "points" in own:
            apart = max(
                apart,
                *(
                    float(np.nanmax(np.abs(np.array(a) - np.array(b))))
                    for a, b in zip(own.pop("points"), other[name].pop("points"), strict=True)
                ),
            )
        print(name, *(f"{k}: {v:.4g} | {other[name][k]:.4g};" for k, v in own.items()))
    print(f"greatest difference of points: {apart:.1e} mm")


if __name__ == "__main__":
    if "--measure" in sys.argv:
        print(json.dumps(measured()))
    else:
        main()
