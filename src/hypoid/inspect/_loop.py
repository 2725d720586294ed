"""Simulated closed loops: wrong settings, a noisy measurement, a correction, the flank cut anew, and again.

The machine is the exact generator, off by errors that the correction does not know; it is judged by the flanks as they
are then cut, never by the settings that were found.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.flank import Side

from ._correct import Correction, Wish, added, correction, rms
from ._response import Response
from ._solve import without

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class LoopResult:
    """Deviations of the flanks really cut, without noise and with the part turned to fit; mm rms."""

    errors: Mapping[str, float]  # of the settings, mm and rad
    rms: tuple[float, ...]  # as first cut, after the first correction, after the second ...
    largest: float  # mm, as first cut
    corrections: tuple[Correction, ...]


def simulated_loop(
    response: Response,
    errors: Mapping[str, float],
    wish: Wish,
    random: np.random.Generator,
    corrections: int = 2,
) -> LoopResult:
    """Cut with errors (mm, rad), measure with the wish's noise, correct, cut anew; so many times."""
    steps: dict[str, float] = {}
    cut = true_deviation(response, errors)
    levels, largest = [rms(cut.values())], float(max(np.nanmax(np.abs(v)) for v in cut.values()))
    made: list[Correction] = []
    own = wish  # and all that was measured before
    for _ in range(corrections):
        measured: dict[Side, Array] = {
            s: v + random.normal(0.0, wish.noise, v.shape) for s, v in cut.items()
        }
        found = correction(response, measured, replace(own, on_machine=steps))
        made.append(found)
        own = replace(own, earlier=found.deviations_after, measurements=len(made))
        steps = dict(found.total)
        cut = true_deviation(response, added(errors, steps))
        levels.append(rms(cut.values()))
    return LoopResult(errors, tuple(levels), largest, tuple(made))


def true_deviation(response: Response, steps: Mapping[str, float]) -> dict[Side, Array]:
    """Deviation (n,), mm, of flanks cut with steps, the part turned to fit; both at once if cut together."""
    cut = response.cut(steps)
    sides = response.setup.sides
    value = np.concatenate([cut[s] for s in sides])
    lever = np.concatenate([response.nodes(s).lever for s in sides])
    there = np.isfinite(value)
    value[there] = without(lever[there, None]) @ value[there]
    return dict(zip(sides, np.split(value, len(sides)), strict=True))


def random_errors(
    response: Response, names: Sequence[str], random: np.random.Generator, share: float = 0.5
) -> dict[str, float]:
    """Errors of settings, evenly within a share of their reach either way: 0.1 mm, 4.5 min by default."""
    return {
        n: float(share * response.setup.adjustments[n].reach * random.uniform(-1.0, 1.0))
        for n in names
    }
