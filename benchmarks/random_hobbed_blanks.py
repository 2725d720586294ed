"""Random face-hobbed blanks, each designed on Tri-Ac heads and looked at: the table of the docs.

    python benchmarks/random_hobbed_blanks.py 60 docs/validation/random-hobbed-blanks.csv

The blanks are those of `random_blanks.py`, of uniform depth as face hobbing has it, with a head whose
blades lean by 12 to 22 deg. Without tilt the blade radii must crown, so that their spacing is free. A
pair counts as sound where its flanks meet inside at the middle of the mesh, both pinion flanks, cut in
one setting-up, are within the tolerance of their targets, and undercut, if there is any, is reported.
Every other one ends with a reason. The draw is seeded.
"""

from __future__ import annotations

import csv
import sys
import time
from dataclasses import replace
from math import cos, degrees, radians, sin
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from random_blanks import LOOK, SEED, Draw, draw

from hypoid.blank import BlankRequest, TypeII
from hypoid.contact import unloaded_contact
from hypoid.design import EaseOffTarget, HobbedRequest, StickGrind, build, design_hobbed
from hypoid.geometry import DesignError
from hypoid.pair import GearPair

PINIONS = ("tilt", "tilt", "helical", "universal", "modified-roll", "generated")
WITHOUT_TILT = ("modified-roll", "generated")
COLUMNS = (
    "number", "wheel", "pinion", "method", "teeth", "module_mm", "shaft_angle_deg", "offset_share",
    "spiral_deg", "cutter_radius_mm", "blade_groups", "residual_um", "tolerance_um", "outcome", "seconds",
)  # fmt: skip


def request_of(one: Draw, random: np.random.Generator) -> HobbedRequest:
    """The request of a draw; crownings grow with the module, undercut leaves few teeth less depth."""
    size, ratio = (one.module / 4.0) ** 0.5, one.z2 / one.z1
    depth = float(np.interp(ratio, [4.0, 10.0], [2.0, 1.7]))
    target = EaseOffTarget(0.015 * size, 0.010 * size)
    wheel: Any = one.wheel
    pinion: Any = str(random.choice(PINIONS))
    if pinion in WITHOUT_TILT and wheel == "formate":
        pinion = "tilt"  # without tilt a rolled pinion is no match for a form-cut wheel
    normal = 0.85 * one.module * cos(one.spiral)
    lean = random.uniform(radians(12.0), radians(22.0))
    groups = max(round(2.0 * one.cutter * sin(lean) / normal), 3)
    method: Any = one.method
    blank = BlankRequest(
        method, one.z1, one.z2, one.shaft_angle, one.offset, one.face, one.cutter, one.spiral,
        wheel_outer_diameter=one.module * one.z2, taper="uniform", tooth=TypeII(depth_factor=depth),
        blade_groups=groups,
    )  # fmt: skip
    grind = StickGrind(pinion_curve_radius=None)
    return HobbedRequest(
        f"random {one.number}", "", (), blank, wheel, pinion, grind, drive=target, coast=target,
        tolerance=0.008 * max(size, 0.5), equal_spacing=pinion not in WITHOUT_TILT,
    )  # fmt: skip


def judged(pair: GearPair) -> str:
    """Whether the flanks meet inside at the middle of the mesh, both ways, and what is reported."""
    for direction in ("drive", "coast"):
        contact = unloaded_contact(pair, direction, sampling=LOOK)
        n, middle = LOOK.positions_per_pitch, len(contact.phi) // 2
        if not contact.interior[middle - n // 4 : middle + n // 4 + 1].any():
            words = "; ".join(pair.faults) or "no reason found"
            return f"{direction}: no contact inside at the middle ({words})"
    return "sound" if not pair.faults else f"sound; reported: {pair.faults[0]}"


def outcome(request: HobbedRequest) -> tuple[str, float]:
    """What became of a request in words, and its greatest residual, um."""
    try:
        made = design_hobbed(request)
        residual = 1e3 * made.fit.largest
        if made.fit.largest > request.tolerance:
            told = [fault for fault in made.faults if "target ease-off" in fault]
            return f"residual above the tolerance: {told[0]}", residual
        words = judged(build(made.spec))
    except DesignError as error:
        first = error.problems[0]
        return f"refused: {first.path}: {first.given}; expected {first.expected}", float("nan")
    if words == "sound" and made.faults:
        words = f"sound; reported: {made.faults[0]}"
    return words, residual


def main(count: int, target: Path) -> None:
    """Design so many blanks and write the table."""
    random, more = np.random.default_rng(SEED), np.random.default_rng(SEED + 1)
    sound = 0
    with target.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        for number in range(1, count + 1):
            one = replace(draw(number, random), number=number)
            request = request_of(one, more)
            start = time.perf_counter()
            words, residual = outcome(request)
            sound += words.startswith("sound")
            table.writerow(
                [
                    number, request.wheel_method, request.pinion_method, one.method,
                    f"{one.z1}/{one.z2}", f"{one.module:.2f}", f"{degrees(one.shaft_angle):.1f}",
                    f"{one.offset / (0.5 * one.module * one.z2):.3f}", f"{degrees(one.spiral):.1f}",
                    f"{one.cutter:.1f}", request.blank.blade_groups, f"{residual:.2f}",
                    f"{1e3 * request.tolerance:.2f}", words, f"{time.perf_counter() - start:.1f}",
                ]
            )  # fmt: skip
            file.flush()
    print(f"{sound} of {count} sound ({100.0 * sound / count:.1f} %)")


if __name__ == "__main__":
    main(int(sys.argv[1]), Path(sys.argv[2]))
