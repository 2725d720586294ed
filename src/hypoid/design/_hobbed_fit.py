"""Settings of a face-hobbed pinion: one setting-up for both flanks, from a start to a method's closest."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import SIDES, Side
from hypoid.machine import MachineSettings

from ._conjugate import Conjugate, conjugate
from ._fit import Fit, promised
from ._flank_fit import MOST_ADVICE, plain_settings
from ._hobbed_joint import (
    COLUMNS,
    JOINT,
    PLACE,
    JointModel,
    JointSeen,
    joint_model,
)
from ._hobbed_request import HobbedRequest
from ._hobbed_start import Start, conjugate_start, pinion_thickness, plain_start
from ._hobbed_wheel import HobbedWheel, head_plan
from ._hobbed_work import BENDS, FEWEST, Stage, begun, evened_out, work_of
from ._joint_fit import Wish
from ._milled_wheel import pitch_cone
from ._motion import motion_of
from ._pinion_methods import HEAD, held_words
from ._pinion_model import UM, target_places
from ._settings_model import BLADE, MOTIONS, NAMES, ROLL
from ._target import MotionTarget, Target

Array = np.ndarray[Any, Any]
MOTION_PASSES, MOTION_MET = 3, 0.004  # of the depth asked for
ADVICE = (
    *HEAD,
    *ROLL[:3],
    "helical_motion",
    *BENDS,
    *MOTIONS,
)


@dataclass(frozen=True)
class SideFit:
    """How near a flank came to its target; mm."""

    side: Side
    distance: Array  # (n,) S of the residual map
    height: Array  # (n,) H
    residual: Array  # (n,) ease-off less its target; NaN where nothing counts
    wanted: Array  # (n,) the target ease-off
    root_error: Array  # (3,) height of the root as cut less the blank's, toe to heel

    @property
    def rms(self) -> float:
        """Root mean square of the residual map."""
        return float(np.sqrt(np.nanmean(self.residual**2)))

    @property
    def largest(self) -> float:
        """Greatest residual either way."""
        return float(np.nanmax(np.abs(self.residual)))


@dataclass(frozen=True)
class HobbedFit:
    """A face-hobbed pinion as fitted; mm and rad."""

    settings: MachineSettings
    radii: tuple[float, float]  # of P, outer and inner blade
    angles: tuple[float, float]
    curvatures: tuple[float, float]  # 1/mm
    height: float  # of P above the tips
    spacing: float | None  # rad; None: even
    thickness: float  # normal, at the mean point
    vector: Array  # all entries, as `_hobbed_joint.JOINT`
    free: tuple[str, ...]
    sides: Mapping[Side, SideFit]
    fit: Fit
    held: tuple[str, ...]  # entries that stand at a bound and want out, in words
    helpful: tuple[tuple[str, float], ...]  # entries not free, and the rms in mm that they promise

    @property
    def largest(self) -> float:
        """Greatest residual of both flanks, mm."""
        return max(side.largest for side in self.sides.values())

    @property
    def rms(self) -> float:
        """Root mean square of both residual maps, mm."""
        return math.sqrt(sum(side.rms**2 for side in self.sides.values()) / len(self.sides))

    @property
    def undetermined(self) -> tuple[str, ...]:
        """Directions that the target does not determine, and which were left alone, in words."""
        return self.fit.undetermined(self.free)


def fit_hobbed(
    request: HobbedRequest, blank: PairBlank, wheel: HobbedWheel, targets: Mapping[Side, Target]
) -> HobbedFit | None:
    """Settings and blades of a pinion for a request; None where there is nothing to start from.

    From the plain start for a generated wheel, from the wheel's conjugate for a form-cut one; where
    that does not reach the targets, from the other, too, and then from both once more with patience.
    """
    cone = pitch_cone(blank, "pinion")
    mates: dict[Side, Side] = {"concave": "convex", "convex": "concave"}
    found: dict[Side, Conjugate] = {
        side: conjugate(blank, wheel.flank(mates[side]), cone) for side in SIDES
    }
    if min(c.there.sum() for c in found.values()) < FEWEST:
        return None
    thickness = pinion_thickness(blank, request.normal_backlash)
    plan = head_plan(request, blank, request.grind.pinion_curve_radius or 0.0)
    generated = request.wheel_method == "generated"
    starts: list[Callable[[], Start | None]] = [
        lambda: plain_start(plan, blank, thickness),
        lambda: conjugate_start(plan, blank, wheel),
    ]
    order = starts if generated else starts[::-1]
    best: HobbedFit | None = None
    for patient, begin in product((False, True), order):
        start, fit = begin(), None
        if start is not None:
            fit = _fitted(request, blank, start, found, targets, thickness, patient=patient)
        if best is None or (fit is not None and fit.largest < best.largest):
            best = fit
        if best is not None and best.largest <= request.tolerance:
            break
    return best


def _fitted(
    request: HobbedRequest,
    blank: PairBlank,
    start: Start,
    found: Mapping[Side, Conjugate],
    targets: Mapping[Side, Target],
    thickness: float,
    *,
    patient: bool,
) -> HobbedFit | None:
    model = joint_model(
        start,
        found,
        targets,
        blank,
        pitch_cone(blank, "pinion"),
        thickness,
        equal_spacing=request.equal_spacing,
    )
    if model is None or min(side.there.sum() for side in model.sides.values()) < FEWEST:
        return None
    work = work_of(model, request, start, blank, patient=patient)
    stage = begun(work)
    if stage is None:
        return None
    free, freedom = work.free, work.method
    more = {n: Wish(0.0, spread) for n, spread in freedom.spreads.items() if n in free}
    if set(free) != set(work.first):
        stage = stage.run(free, more) or stage
    aimed = dict(targets)
    for _ in range(MOTION_PASSES):
        next_aim = _aimed_again(stage, targets, aimed, blank)
        if next_aim is None:
            break
        aimed = next_aim
        last = stage.asked(_with_targets(stage.work.model, aimed, blank)).run(free, more)
        if last is None:
            break
        stage = last.asked(_with_targets(last.work.model, targets, blank))
    return _result(evened_out(stage, more))


def _with_targets(
    model: JointModel, targets: Mapping[Side, Target], blank: PairBlank
) -> JointModel:
    """The model with other targets."""
    sides = {
        side: replace(own, wanted=targets[side].at(target_places(own.conjugate, blank)))
        for side, own in model.sides.items()
    }
    return replace(model, sides=sides)


def _aimed_again(
    stage: Stage,
    targets: Mapping[Side, Target],
    aimed: Mapping[Side, Target],
    blank: PairBlank,
) -> dict[Side, Target] | None:
    """Targets whose motion is asked deeper or shallower by what the fit missed; None where none is off.

    The fit is to an ease-off: what it leaves changes the motion that was asked for.
    """
    seen = stage.look()
    if seen is None:
        return None
    off, again = False, dict(aimed)
    for side, own in stage.work.model.sides.items():
        target, now = targets[side], aimed[side]
        if not (isinstance(target, MotionTarget) and isinstance(now, MotionTarget)):
            continue
        places = target_places(own.conjugate, blank)
        got = motion_of(places, np.where(own.there, seen.misfit[side] + own.wanted, np.nan))
        if got is None:
            continue
        share = target.transmission_error / got.peak_to_peak
        if not (0.5 < share < 2.0):
            continue
        off |= abs(share - 1.0) > MOTION_MET
        again[side] = replace(now, transmission_error=now.transmission_error * share)
    return again if off else None


def _result(stage: Stage) -> HobbedFit | None:
    work, vector, fit = stage.work, stage.vector, stage.fit
    model, free, seen = work.model, work.free, stage.look()
    if seen is None:
        return None
    sides: dict[Side, SideFit] = {}
    for side, own in model.sides.items():
        residual = np.where(own.there, seen.misfit[side], np.nan)
        c = own.conjugate
        sides[side] = SideFit(
            side, c.distance, c.height, residual, own.wanted, seen.root_error[side]
        )
    plan, spacing, thickness = work.start.plan, None, seen.thickness
    ratio = plan.groups / model.teeth
    if not model.weigh_thickness:  # a later inner blade turns its flank back by R_b
        spacing = plan.spacing - (model.thickness - thickness) / (model.across * ratio)
        thickness = model.thickness
    blades = vector[len(NAMES) - len(BLADE) :].reshape(2, len(BLADE))
    settings = replace(plain_settings(vector[COLUMNS["concave"]]), roll_to_blade_ratio=ratio)
    return HobbedFit(
        settings=settings,
        radii=(float(blades[0, 0]), float(blades[1, 0])),
        angles=(float(blades[0, 1]), float(blades[1, 1])),
        curvatures=(float(blades[0, 2]), float(blades[1, 2])),
        height=work.start.cut.height,
        spacing=spacing,
        thickness=thickness,
        vector=vector,
        free=free,
        sides=sides,
        fit=fit,
        held=held_words(((n, *work.ends(n)) for n in free), fit.held, work.blank),
        helpful=_helpful(model, seen, free, fit.held, work.limits),
    )


def _helpful(
    model: JointModel,
    seen: JointSeen,
    free: tuple[str, ...],
    held: Array,
    limits: Mapping[str, float],
) -> tuple[tuple[str, float], ...]:
    """What one more free entry would leave of the residual, by one linear step, the best first.

    Entries that do not move, and those that a bound holds.
    """
    scale = np.array([limits[name] for name in JOINT])
    mine: list[int] = []
    at = 0
    for own in model.sides.values():
        count = int(own.there.sum())
        mine += range(at, at + count)
        at += count + len(model.root_distance)
    names = [*free, *(name for name in ADVICE if name not in free)]
    moving = np.zeros(len(names), bool)
    moving[: len(free)] = held == 0.0
    columns = (seen.jacobian * scale)[:, [PLACE[name] for name in names]]
    found = promised(columns, seen.residual, moving, mine)
    best = sorted(found.items(), key=lambda entry: entry[1])[:MOST_ADVICE]
    return tuple((names[k], UM * rms) for k, rms in best)
