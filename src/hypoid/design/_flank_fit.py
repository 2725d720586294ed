"""What a fit found of a pinion flank: settings, blade, residual map, and what would help where it falls short."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.flank import Side
from hypoid.machine import MachineSettings

from ._fit import Fit, promised
from ._joint_fit import JointFit, Unknowns
from ._pinion_methods import HEAD, held_words
from ._pinion_model import ROOT_PLACES, UM, PinionModel
from ._pinion_task import PinionTask, Stage
from ._settings_model import INDEX, MOTIONS, ROLL, settings_of

Array = np.ndarray[Any, Any]
ADVICE = (*HEAD, *ROLL[:3], "helical_motion", "blade_curvature", *MOTIONS)
MOST_ADVICE = 3


@dataclass(frozen=True)
class FlankFit:
    """One pinion flank as fitted; mm and rad."""

    side: Side
    settings: MachineSettings
    point_radius: float
    blade_angle: float
    blade_curvature: float  # 1/mm, positive crowns the tooth; the blade has its angle at the tips
    vector: Array  # all entries, as `_settings_model.NAMES`
    free: tuple[str, ...]  # unknowns of the fit
    distance: Array  # (n,) S of the residual map
    height: Array  # (n,) H
    residual: Array  # (n,) mm, ease-off less its target; NaN where nothing counts
    wanted: Array  # (n,) mm, the target ease-off
    ease_off: Array  # (n,) mm; NaN where nothing counts
    least_edge: (
        float  # mm along the blade from its tips, above which all of the active flank is cut
    )
    root_error: Array  # (3,) mm, height of the root as cut less the blank's, toe to heel
    fit: Fit
    held: tuple[str, ...]  # unknowns that stand at a bound and want out, in words
    helpful: tuple[tuple[str, float], ...]  # what more freedom, and the rms in mm that it promises

    @property
    def rms(self) -> float:
        """Root mean square of the residual map, mm."""
        return float(np.sqrt(np.nanmean(self.residual**2)))

    @property
    def largest(self) -> float:
        """Greatest residual either way, mm."""
        return float(np.nanmax(np.abs(self.residual)))

    @property
    def undetermined(self) -> tuple[str, ...]:
        """Directions that the target does not determine, and which were left alone, in words."""
        return self.fit.undetermined(self.free)


def flank_fits(task: PinionTask, stage: Stage) -> dict[Side, FlankFit]:
    """Fits of the flanks of a finished stage."""
    joint = stage.fit
    assert joint is not None
    held = held_words(((e.name, e.low, e.high) for e in joint.entries), joint.fit.held, task.blank)
    found: dict[Side, FlankFit] = {}
    for model, vector, look in zip(stage.models, stage.vectors, joint.looks, strict=True):
        count = model.count
        residual, ease_off = (np.full(len(model.there), np.nan) for _ in range(2))
        residual[model.there] = model.off(look)
        ease_off[model.there] = look.ease_off[model.there]
        found[model.side] = FlankFit(
            side=model.side,
            settings=plain_settings(vector),
            point_radius=float(vector[INDEX["point_radius"]]),
            blade_angle=float(vector[INDEX["blade_angle"]]),
            blade_curvature=float(vector[INDEX["blade_curvature"]]),
            vector=vector,
            free=joint.names,
            distance=model.conjugate.distance,
            height=model.conjugate.height,
            residual=residual,
            wanted=model.wanted - model.wanted[model.conjugate.middle],
            ease_off=ease_off,
            least_edge=float(look.memory[0][model.there].min()),
            root_error=look.residual[count : count + ROOT_PLACES] * model.root_spread,
            fit=joint.fit,
            held=held,
            helpful=_helpful(task, stage, joint, model),
        )
    return found


def _helpful(
    task: PinionTask, stage: Stage, joint: JointFit, model: PinionModel
) -> tuple[tuple[str, float], ...]:
    """What one more freedom would leave of a flank's residual, by one linear step, the best first.

    Entries that do not move, and those that a bound holds.
    """
    looks = joint.looks
    more = [name for name in ADVICE if name not in task.free and name not in joint.names]
    entries = [e for name in more for e in task.entries((name,), len(looks) > 1, False)]
    every = Unknowns((*joint.entries, *entries), stage.vectors, INDEX)
    limits = np.array([entry.limit for entry in every.entries])
    jacobian = every.joined([look.jacobian for look in looks]) * limits
    residual = np.concatenate([look.residual for look in looks])
    first = sum(
        len(k.residual)
        for k, m in zip(looks, stage.models, strict=True)
        if m.side == "concave" and model.side == "convex"
    )
    moving = np.zeros(len(limits), bool)
    moving[: len(joint.entries)] = joint.fit.held == 0.0
    rest = promised(jacobian, residual, moving, slice(first, first + model.count))
    found = {every.entries[k].name: UM * rms for k, rms in rest.items()}
    return tuple(sorted(found.items(), key=lambda entry: entry[1])[:MOST_ADVICE])


def plain_settings(vector: Array) -> MachineSettings:
    """The settings of a vector as plain numbers, with no motion where there is none."""
    held = settings_of([float(v) for v in vector])
    moved = held.motions
    names = type(moved).__dataclass_fields__
    kept = {n: getattr(moved, n) if any(getattr(moved, n)) else () for n in names}
    roll = tuple(held.modified_roll)
    while roll and not roll[-1]:
        roll = roll[:-1]
    return replace(held, modified_roll=roll, motions=replace(moved, **kept))
