"""How near a designed pinion came to its target: residual maps, and what the target left undetermined."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from matplotlib.figure import Figure

from hypoid.flank import SIDES, Side
from hypoid.pair import GearPair

from ._figures_contact import flank_frame
from ._page import drawing, note
from ._style import MAP, figure, to_svg

Array = np.ndarray[Any, Any]
LEVELS = 13
FEWEST = 4  # points of a map


class Fitted(Protocol):
    """A pinion flank as fitted to its target, mm."""

    @property
    def distance(self) -> Array: ...  # (n,) S
    @property
    def height(self) -> Array: ...  # (n,) H
    @property
    def wanted(self) -> Array: ...  # (n,) the target ease-off
    @property
    def residual(self) -> Array: ...  # (n,) ease-off less its target; NaN where nothing counts


@dataclass(frozen=True)
class FittedPinion:
    """Both pinion flanks as fitted, and by name of a fit the directions that its target left undetermined, in words."""

    sides: Mapping[Side, Fitted]
    undetermined: Mapping[str, tuple[str, ...]]


def fit_figure(pair: GearPair, fits: Mapping[Side, Fitted]) -> Figure:
    """Target ease-off and what the fit leaves of it, over both pinion flanks."""
    drawn = figure(6.4)
    axes = drawn.subplots(2, 2)
    flanks = {"concave": pair.pinion.concave, "convex": pair.pinion.convex}
    for column, side in enumerate(SIDES):
        fit = fits[side]
        there = np.isfinite(fit.residual)
        for row, (name, value) in enumerate((("target", fit.wanted), ("residual", fit.residual))):
            ax, um = axes[row, column], 1e3 * value[there]
            flank_frame(ax, flanks[side])
            if len(um) < FEWEST or np.ptp(um) == 0.0:
                continue
            largest = float(np.abs(um).max())
            ends = (-largest, largest) if name == "residual" else (float(um.min()), float(um.max()))
            filled = ax.tricontourf(
                fit.distance[there],
                fit.height[there],
                um,
                levels=np.linspace(*ends, LEVELS),
                cmap="PuOr" if name == "residual" else MAP,
            )
            drawn.colorbar(filled, ax=ax, label=f"{name} [um]", format="%.3g")
            rms = float(np.sqrt(np.mean(um**2)))
            words = f", rms {rms:.2g}, largest {largest:.2g} um" if name == "residual" else ""
            ax.set_title(f"pinion {side}: {name}{words}")
    return drawn


def fit_section(pair: GearPair, fitted: FittedPinion) -> str:
    """The report's section on the fit: maps, and singular directions in words."""
    words = [
        f"Undetermined by the target and left alone ({name}): {direction}."
        for name, directions in fitted.undetermined.items()
        for direction in directions
    ]
    shown = drawing(
        to_svg(fit_figure(pair, fitted.sides)),
        "Above, the ease-off that was asked for; below, what the fit leaves of it: positive where the pinion lacks "
        "more than asked.",
    )
    return shown + "".join(note(w) for w in words or ["The target determines every free setting."])
