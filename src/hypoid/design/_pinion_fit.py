"""Settings of a pinion's flanks: from the wheel's exact conjugate, or a bevel pinion, to the method's closest.

A flank alone, or both flanks of a slot by one setting; either is one joint fit, gone through in stages.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from hypoid.flank import SIDES, Side

from ._fit import EVENED, evened
from ._flank_fit import FlankFit, flank_fits
from ._joint_fit import Wish
from ._milled_wheel import pitch_cone
from ._motion import Motion, motion_of
from ._pinion_methods import APART, BASE, HEAD
from ._pinion_model import CORNER_SPREAD, ROOT_SPREAD, pinion_model, target_places
from ._pinion_start import conjugate_places, conjugate_start, plain_places, plain_start
from ._pinion_task import FEWEST, PinionTask, Stage, goals, in_root_plane, led, run
from ._settings_model import INDEX
from ._target import MotionTarget

CORRECTIONS = 4  # of a target's transmission error
MET = 0.005  # of the asked transmission error


def fit_pinion(task: PinionTask) -> dict[Side, FlankFit]:
    """Fits of both pinion flanks; one is missing where there is nothing to start from."""
    if task.method.joint:
        if any(c.there.sum() < FEWEST for c in task.conjugates.values()):
            return {}
        best = _best(task, [lambda: _from_plain(task, SIDES), lambda: _from_between(task)])
        return {} if best is None else flank_fits(task, _evened(task, _moved(task, best)))
    found: dict[Side, FlankFit] = {}
    for side in SIDES:
        best = _alone(task, side)
        if best is not None:
            found |= flank_fits(task, _evened(task, _moved(task, best)))
    return found


def _alone(task: PinionTask, side: Side) -> Stage | None:
    """One flank's fit; from the likelier start, and where that falls short from the other, too."""
    if task.conjugates[side].there.sum() < FEWEST:
        return None
    starts: list[Callable[[], Stage | None]] = [
        lambda: _from_plain(task, (side,)),
        lambda: _from_conjugate(task, side),
    ]
    return _best(task, starts if task.request.wheel_method == "generated" else starts[::-1])


def _best(task: PinionTask, starts: Sequence[Callable[[], Stage | None]]) -> Stage | None:
    """The first that reaches the tolerance, or the nearest of all."""
    best: Stage | None = None
    for begin in starts:
        stage = begin()
        if stage is not None and (best is None or stage.cost < best.cost):
            best = stage
        if best is not None and best.largest <= task.request.tolerance:
            break
    return best


def _evened(task: PinionTask, stage: Stage) -> Stage:
    """The stage, or one nearer to the least greatest residual if that meets the tolerance and least squares do not."""
    squares = stage
    for _ in range(EVENED):
        if stage.largest <= task.request.tolerance or stage.fit is None:
            break
        models = []
        for model, look in zip(stage.models, stage.fit.looks, strict=True):
            weight = model.weight.copy()
            weight[model.there] = evened(weight[model.there], model.off(look), stage.largest)
            models.append(replace(model, weight=weight))
        found = run(task, replace(stage, models=tuple(models), fit=None), task.free, _spread(task))
        if found is None:
            return squares
        stage = found
    if stage is squares or stage.largest > task.request.tolerance:
        return squares
    plain = tuple(replace(m, weight=np.ones(len(m.weight))) for m in stage.models)
    seen = run(task, replace(stage, models=plain, fit=None), task.free, _spread(task), steps=0)
    return squares if seen is None else seen


def _moved(task: PinionTask, stage: Stage) -> Stage:
    """The stage with the asked motion met: the target's amplitude corrected by what the fit's ease-off makes."""
    asked: dict[Side, MotionTarget] = {
        m.side: target
        for m in stage.models
        if isinstance(target := task.target(m.side), MotionTarget)
    }
    aims = dict(asked)
    sides: list[Side] = list(asked)
    best, least = stage, math.inf
    for _ in range(CORRECTIONS if asked else 0):
        seen: dict[Side, Motion | None] = {side: _motion(task, stage, side) for side in sides}
        if any(motion is None for motion in seen.values()):
            break
        off = max(m.off(asked[s].transmission_error) for s, m in seen.items() if m is not None)
        if off < least:
            best, least = stage, off
        if off < MET:
            break
        for side, motion in seen.items():
            assert motion is not None
            ratio = asked[side].transmission_error / max(motion.peak_to_peak, 1e-9)
            error = aims[side].transmission_error * min(max(ratio, 0.5), 2.0)
            aims[side] = replace(aims[side], transmission_error=error)
        models = tuple(
            m.asked(aims[m.side], task.blank) if m.side in aims else m for m in stage.models
        )
        again = run(task, replace(stage, models=models), task.free, _spread(task))
        if again is None:
            break
        stage = again
    return best


def _motion(task: PinionTask, stage: Stage, side: Side) -> Motion | None:
    """The motion of a fitted flank's ease-off."""
    assert stage.fit is not None
    k = [model.side for model in stage.models].index(side)
    model, look = stage.models[k], stage.fit.looks[k]
    places = target_places(model.conjugate, task.blank)
    return motion_of(places, np.where(model.there, look.ease_off, np.nan))


def _from_plain(task: PinionTask, sides: Sequence[Side]) -> Stage | None:
    """From a bevel pinion of the blank's angles: no tilt, tips in the root plane."""
    cone = pitch_cone(task.blank, "pinion")
    models, vectors = [], []
    for side in sides:
        start = plain_start(task.blank, task.request.blank.cutter_radius, side)
        found = task.conjugates[side]
        places = plain_places(found, task.blank, start, side)
        spread = CORNER_SPREAD if len(sides) > 1 else ROOT_SPREAD
        model = pinion_model(
            side, found, task.blank, cone, start, places, task.target(side), task.least_edge, spread
        )
        if model is None or model.count < FEWEST:
            return None
        models.append(model)
        vectors.append(start)
    stage = Stage(tuple(models), tuple(vectors), tuple(m.start_memory for m in models))
    first = tuple(name for name in task.free if name in (*BASE, *HEAD))
    to = goals(task, stage)
    off = {n: v for n, v in to.items() if any(abs(vec[INDEX[n]] - v) > 1e-9 for vec in vectors)}
    found = led(task, stage, off)
    found = None if found is None else run(task, in_root_plane(task, found.put(to)), first, {})
    return None if found is None else _finished(task, found, first)


def _from_conjugate(task: PinionTask, side: Side) -> Stage | None:
    """Tilt and swivel free; then what the method has not, or is fixed, led there and kept there."""
    found = task.conjugates[side]
    start = conjugate_start(task.wheel, task.blank, side)
    places = conjugate_places(found, start)
    cone = pitch_cone(task.blank, "pinion")
    model = pinion_model(
        side, found, task.blank, cone, start, places, task.target(side), task.least_edge
    )
    if model is None or model.count < FEWEST:
        return None
    free = (*BASE, *HEAD)
    stage = run(task, Stage((model,), (start,), (model.start_memory,)), free, {}, bounded=False)
    if stage is None:
        return None
    to = goals(task, stage)
    if to:
        stage, free = led(task, stage, to), ()
    return None if stage is None else _finished(task, in_root_plane(task, stage), free)


def _from_between(task: PinionTask) -> Stage | None:
    """Both flanks from the mean of the settings that each would have alone."""
    apart = [_alone(task.alone(), side) for side in SIDES]
    if any(stage is None for stage in apart):
        return None
    stages = [stage for stage in apart if stage is not None]
    start = Stage(
        tuple(replace(s.models[0], root_spread=CORNER_SPREAD) for s in stages),
        tuple(s.vectors[0] for s in stages),
        tuple(s.memories[0] for s in stages),
    )
    found = run(task, start, task.free, _spread(task))
    return None if found is None else _finished(task, found, task.free)


def _spread(task: PinionTask) -> dict[str, Wish]:
    """Wishes about zero, which keep motions and bent blades no greater than they serve."""
    found: dict[str, Wish] = {}
    for name, spread in task.method.spreads.items():
        apart = task.method.joint and name in APART
        for one in [f"{side}.{name}" for side in SIDES] if apart else [name]:
            found[one] = Wish(0.0, spread)
    return found


def _finished(task: PinionTask, stage: Stage, free: Sequence[str]) -> Stage | None:
    """The last stage, with all that moves."""
    if stage.fit is not None and set(task.free) == set(free):
        return stage
    return run(task, stage, task.free, _spread(task))
