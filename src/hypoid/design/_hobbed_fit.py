"""Settings of a face-hobbed pinion: one setting-up for both flanks, from a start to a method's closest."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import SIDES, Side
from hypoid.machine import MachineSettings

from ._conjugate import Conjugate, conjugate
from ._fit import EVENED, Fit, Look, evened, gauss_newton, promised
from ._flank_fit import MOST_ADVICE, plain_settings
from ._hobbed_joint import (
    BLADES,
    COLUMNS,
    JOINT,
    PLACE,
    JointModel,
    JointSeen,
    Memory,
    SideModel,
    joint_model,
    joint_vector,
)
from ._hobbed_request import HobbedRequest
from ._hobbed_start import Start, conjugate_start, pinion_thickness, plain_start
from ._hobbed_wheel import HobbedWheel, head_plan
from ._joint_fit import Wish
from ._milled_wheel import pitch_cone
from ._motion import motion_of
from ._pinion_methods import HEAD, METHODS, step_limits
from ._pinion_model import UM, target_places
from ._settings_model import BLADE, MOTIONS, NAMES, ROLL
from ._target import MotionTarget, Target

Array = np.ndarray[Any, Any]
FEWEST = 20  # points of a conjugate that a fit needs
LEADING = math.radians(0.02)  # how firmly tilt is led to zero
RADIUS_SPREAD = 0.01  # of the head's radius, that a blade's may stray at the price of 1 um
ANGLE_SPREAD = math.radians(0.5)
MOTION_PASSES, MOTION_MET = 3, 0.004  # of the depth asked for
ADVICE = (
    *HEAD,
    *ROLL[:3],
    "helical_motion",
    *(f"{side}.blade_curvature" for side in SIDES),
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
    that does not reach the targets, from the other, too.
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
    order = ("plain", "conjugate") if generated else ("conjugate", "plain")
    best: HobbedFit | None = None
    for which in order:
        plain = which == "plain"
        start = (
            plain_start(plan, blank, thickness) if plain else conjugate_start(plan, blank, wheel)
        )
        fit = None if start is None else _fitted(request, blank, start, found, targets, thickness)
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
    work = _Work(model, request, start)
    freedom = METHODS[request.pinion_method]
    bends = request.grind.pinion_curve_radius is None
    vector, memory = joint_vector(start), model.start
    limits = work.limits(blank, vector[PLACE["ratio_of_roll"]])
    own = _entries([n for n in freedom.free if n not in (*ROLL, *MOTIONS, "helical_motion")], bends)
    stage = work.run(vector, own, {}, memory, limits)
    if freedom.rest:  # tilt is free on the way, led to zero, then kept there
        first = tuple(dict.fromkeys((*own, *HEAD)))
        stage = work.run(vector, first, {}, memory, limits)
        if stage is not None and abs(stage[0][PLACE["tilt_angle"]]) > 1e-9:
            lead = {"tilt_angle": Wish(0.0, LEADING)}
            lead |= {"swivel_angle": Wish(stage[0][PLACE["swivel_angle"]], math.radians(1.0))}
            stage = work.run(stage[0], first, lead, stage[1].look.memory, limits, steps=80)
        if stage is not None:
            rested, swivel = stage[0].copy(), float(stage[0][PLACE["swivel_angle"]])
            rested[[PLACE[name] for name in freedom.rest]] = 0.0
            # without tilt the swivel only says where the cutter's turn counts from
            kept = {
                side: (s, turn - swivel, phi, root_turn - swivel, root_phi)
                for side, (s, turn, phi, root_turn, root_phi) in stage[1].look.memory.items()
            }
            stage = work.run(rested, own, {}, kept, limits)
    if stage is None:
        return None
    vector, fit = stage
    free = _entries(freedom.free, bends)
    more = {name: Wish(0.0, spread) for name, spread in freedom.spreads.items()}
    if set(free) != set(own):
        last = work.run(vector, free, more, fit.look.memory, limits)
        if last is not None:
            vector, fit = last
    aimed = dict(targets)
    for _ in range(MOTION_PASSES):
        next_aim = _aimed_again(work, vector, fit.look.memory, targets, aimed, blank)
        if next_aim is None:
            break
        aimed = next_aim
        last = replace(work, model=_with_targets(model, aimed, blank)).run(
            vector, free, more, fit.look.memory, limits
        )
        if last is None:
            break
        vector, fit = last
    vector, fit = work.evened(vector, fit, free, more, limits)
    return work.result(vector, fit, free, limits)


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
    work: _Work,
    vector: Array,
    memory: Memory,
    targets: Mapping[Side, Target],
    aimed: Mapping[Side, Target],
    blank: PairBlank,
) -> dict[Side, Target] | None:
    """Targets whose motion is asked deeper or shallower by what the fit missed; None where none is off.

    The fit is to an ease-off: what it leaves changes the motion that was asked for.
    """
    seen = work.look(vector, {}, memory)
    if seen is None:
        return None
    off, again = False, dict(aimed)
    for side, own in work.model.sides.items():
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


def _entries(names: Any, bends: bool) -> tuple[str, ...]:
    """A method's entries in the joint vector: of the blades, both flanks' own."""
    made: list[str] = []
    for name in names:
        made += [name] if name not in BLADES else [f"{side}.{BLADES[name]}" for side in SIDES]
    return (*made, *(f"{side}.blade_curvature" for side in SIDES)) if bends else tuple(made)


@dataclass(frozen=True)
class _Work:
    model: JointModel
    request: HobbedRequest
    start: Start

    @property
    def wishes(self) -> dict[str, Wish]:
        """Blades near their head's radius and their pressure angle's."""
        cut, radius = self.start.cut, self.start.plan.radius
        wished: dict[str, Wish] = {}
        for i, side in enumerate(SIDES):
            wished[f"{side}.blade_angle"] = Wish(cut.angles[i], ANGLE_SPREAD)
            wished[f"{side}.blade_radius"] = Wish(radius, RADIUS_SPREAD * radius)
        return wished

    def limits(self, blank: PairBlank, ratio: float) -> dict[str, float]:
        """Greatest change of each entry in one step."""
        held = step_limits(blank, ratio)
        own = {name: held[name] for name in NAMES if name not in BLADE}
        own |= {f"{side}.{BLADES[name]}": held[name] for side in SIDES for name in BLADE}
        return own

    def look(self, vector: Array, more: Mapping[str, Wish], memory: Memory) -> JointSeen | None:
        return self.model.look(vector, {**self.wishes, **more}, memory)

    def run(
        self,
        vector: Array,
        free: tuple[str, ...],
        more: Mapping[str, Wish],
        memory: Any,
        limits: Mapping[str, float],
        steps: int = 60,
    ) -> tuple[Array, Fit] | None:
        """One stage: these entries free, with these wishes beside the blades'."""
        index = [PLACE[name] for name in free]

        def full(x: Array) -> Array:
            whole = vector.copy()
            whole[index] = x
            return whole

        def model(x: Array, memory: Any) -> Look | None:
            seen = self.look(full(x), more, memory)
            if seen is None:
                return None
            return Look(seen.residual, seen.jacobian[:, index], seen.memory)

        scale = np.array([limits[name] for name in free])
        fit = gauss_newton(model, vector[index], memory, scale, steps=steps)
        return None if fit is None else (full(fit.x), fit)

    def evened(
        self,
        vector: Array,
        fit: Fit,
        free: tuple[str, ...],
        more: Mapping[str, Wish],
        limits: Mapping[str, float],
    ) -> tuple[Array, Fit]:
        """Where a fit ended, or nearer to the least greatest residual if that meets the tolerance, and it does not."""
        squares, model = (vector, fit), self.model
        for _ in range(EVENED):
            seen = self.look(vector, {}, fit.look.memory)
            if seen is None:
                break
            left = {side: seen.misfit[side][own.there] for side, own in model.sides.items()}
            greatest = max(float(np.abs(v).max()) for v in left.values())
            if greatest <= self.request.tolerance:
                return vector, fit
            sides: dict[Side, SideModel] = {}
            for side, own in model.sides.items():
                weight = own.weight.copy()
                weight[own.there] = evened(weight[own.there], left[side], greatest)
                sides[side] = replace(own, weight=weight)
            model = replace(model, sides=sides)
            found = replace(self, model=model).run(vector, free, more, fit.look.memory, limits)
            if found is None:
                break
            vector, fit = found
        return squares

    def result(
        self, vector: Array, fit: Fit, free: tuple[str, ...], limits: Mapping[str, float]
    ) -> HobbedFit | None:
        model = self.model
        seen = self.look(vector, {}, fit.look.memory)
        if seen is None:
            return None
        sides: dict[Side, SideFit] = {}
        for side, own in model.sides.items():
            residual = np.where(own.there, seen.misfit[side], np.nan)
            c = own.conjugate
            sides[side] = SideFit(
                side, c.distance, c.height, residual, own.wanted, seen.root_error[side]
            )
        plan, spacing, thickness = self.start.plan, None, seen.thickness
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
            height=self.start.cut.height,
            spacing=spacing,
            thickness=thickness,
            vector=vector,
            free=free,
            sides=sides,
            fit=fit,
            helpful=_helpful(model, seen, free, limits),
        )


def _helpful(
    model: JointModel, seen: JointSeen, free: tuple[str, ...], limits: Mapping[str, float]
) -> tuple[tuple[str, float], ...]:
    """What one more free entry would leave of the residual, by one linear step, the best first."""
    scale = np.array([limits[name] for name in JOINT])
    mine: list[int] = []
    at = 0
    for own in model.sides.values():
        count = int(own.there.sum())
        mine += range(at, at + count)
        at += count + len(model.root_distance)
    names = [*free, *(name for name in ADVICE if name not in free)]
    moving = np.arange(len(names)) < len(free)
    columns = (seen.jacobian * scale)[:, [PLACE[name] for name in names]]
    found = promised(columns, seen.residual, moving, mine)
    best = sorted(found.items(), key=lambda entry: entry[1])[:MOST_ADVICE]
    return tuple((names[k], UM * rms) for k, rms in best)
