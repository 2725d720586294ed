"""A face-hobbed pinion's fit at work: what moves within which bounds, one run of it, and its first stage."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, TypeVar

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import SIDES, Side

from ._fit import CUT, EVENED, Fit, Look, evened, gauss_newton
from ._hobbed_joint import (
    BLADES,
    JOINT,
    PLACE,
    JointModel,
    JointSeen,
    Memory,
    SideModel,
    joint_vector,
    placed,
)
from ._hobbed_request import HobbedRequest
from ._hobbed_start import Start
from ._joint_fit import Wish
from ._pinion_methods import (
    HEAD,
    METHODS,
    Bounds,
    Freedom,
    bounds_of,
    chain_value,
    goals,
    lead,
    step_limits,
)
from ._pinion_model import FOLDING
from ._settings_model import MOTIONS, NAMES, ROLL

Array = np.ndarray[Any, Any]
V = TypeVar("V")
TILT, SWIVEL = PLACE["tilt_angle"], PLACE["swivel_angle"]
BENDS = tuple(f"{side}.blade_curvature" for side in SIDES)
MOVING = (*ROLL, *MOTIONS, "helical_motion")  # left for the last stage
FEWEST = 20  # points of a conjugate that a fit needs
STEPS, PATIENCE = 60, 2  # steps of a run, and times as many of a patient one
UNFOLDINGS = 4  # runs of a stage, each without the places that folded in the last
FAR = -math.inf, math.inf
RADIUS_SPREAD = 0.01  # of the head's radius, that a blade's may stray at the price of 1 um
ANGLE_SPREAD = math.radians(0.5)


def _each(values: Mapping[str, V]) -> dict[str, V]:
    """The same by the joint vector's entries: what is said of a blade holds for both flanks' own."""
    made: dict[str, V] = {}
    for name, value in values.items():
        blade = BLADES.get(name, name)
        own = blade in BLADES.values()
        made |= {f"{side}.{blade}": value for side in SIDES} if own else {name: value}
    return made


@dataclass(frozen=True)
class Work:
    """One fit's model, and what it may move."""

    model: JointModel
    request: HobbedRequest
    start: Start
    blank: PairBlank
    method: Freedom
    free: tuple[str, ...]  # that method or request moves, and the request does not fix
    first: tuple[str, ...]  # of these, the method's own before anything moves with the cradle
    fixed: Mapping[str, float]  # chain's signs
    bounds: Bounds  # chain's signs
    limits: Mapping[str, float]  # greatest change of each entry in one step
    patient: bool  # leaves out places that fold, turns the swivel first, takes more steps

    @property
    def wishes(self) -> dict[str, Wish]:
        """Blades near their head's radius and their pressure angle's."""
        cut, radius = self.start.cut, self.start.plan.radius
        wished: dict[str, Wish] = {}
        for i, side in enumerate(SIDES):
            wished[f"{side}.blade_angle"] = Wish(cut.angles[i], ANGLE_SPREAD)
            wished[f"{side}.blade_radius"] = Wish(radius, RADIUS_SPREAD * radius)
        return wished

    def look(self, vector: Array, more: Mapping[str, Wish], memory: Memory) -> JointSeen | None:
        return self.model.look(vector, {**self.wishes, **more}, memory)

    def ends(self, name: str) -> tuple[float, float]:
        """Bounds of an entry."""
        return self.bounds.get(name, FAR)

    def run(
        self,
        vector: Array,
        free: tuple[str, ...],
        more: Mapping[str, Wish],
        memory: Any,
        *,
        steps: int = STEPS,
        bounded: bool = True,
    ) -> Stage | None:
        """One stage: these entries free, with these wishes beside the blades'.

        A patient fit: places that fold on the way are of another sheet from there on: they are left out, and
        the stage goes on. So are those near undercut, which hold the others up, while the tolerance is not met.
        """
        index = [PLACE[name] for name in free]
        scale = np.array([self.limits[name] for name in free])
        low, high = np.array([self.ends(name) if bounded else FAR for name in free]).T
        work, most = self, PATIENCE * steps if self.patient else steps
        for left in range(UNFOLDINGS if self.patient else 1, 0, -1):
            model = partial(work._at, vector, index, more)
            fit = gauss_newton(model, vector[index], memory, scale, low=low, high=high, steps=most)
            if fit is None:
                return None
            vector = vector.copy()
            vector[index] = fit.x
            stage = Stage(work, vector, fit)
            seen = stage.look()
            if seen is None or left == 1:
                return stage
            least = 0.0 if stage.largest(seen) <= self.request.tolerance else FOLDING
            sides = work.model.sides
            there: dict[Side, Array] = {
                side: own.there & (seen.upright[side] >= least) for side, own in sides.items()
            }
            lost = any((there[side] != own.there).any() for side, own in sides.items())
            if not lost or min(at.sum() for at in there.values()) < FEWEST:
                return stage
            work, memory = replace(work, model=work.model.only(there)), placed(stage.memory, there)
        return None

    def _at(
        self, vector: Array, index: list[int], more: Mapping[str, Wish], x: Array, memory: Any
    ) -> Look | None:
        whole = vector.copy()
        whole[index] = x
        seen = self.look(whole, more, memory)
        return None if seen is None else Look(seen.residual, seen.jacobian[:, index], seen.memory)


@dataclass(frozen=True)
class Stage:
    """Where a run ended, and what it worked with there."""

    work: Work
    vector: Array
    fit: Fit

    @property
    def memory(self) -> Memory:
        """Where Newton goes on from."""
        return self.fit.look.memory

    def look(self) -> JointSeen | None:
        """The stage looked at, blades' wishes alone."""
        return self.work.look(self.vector, {}, self.memory)

    def largest(self, seen: JointSeen) -> float:
        """Greatest residual of both flanks, mm."""
        sides = self.work.model.sides.items()
        return max(float(np.abs(seen.misfit[side][own.there]).max()) for side, own in sides)

    def run(self, free: tuple[str, ...], more: Mapping[str, Wish], **how: Any) -> Stage | None:
        """A run from here."""
        return self.work.run(self.vector, free, more, self.memory, **how)

    def asked(self, model: JointModel) -> Stage:
        """The same with another model, of other targets or weights."""
        return replace(self, work=replace(self.work, model=model))


def evened_out(stage: Stage, more: Mapping[str, Wish]) -> Stage:
    """Where a fit ended, or nearer to the least greatest residual if that meets the tolerance, and it does not."""
    squares = stage
    for _ in range(EVENED):
        seen = stage.look()
        if seen is None:
            break
        model, greatest = stage.work.model, stage.largest(seen)
        if greatest <= stage.work.request.tolerance:
            plain = {
                s: replace(own, weight=np.ones(len(own.weight))) for s, own in model.sides.items()
            }
            return stage.asked(replace(model, sides=plain))
        sides: dict[Side, SideModel] = {}
        for side, own in model.sides.items():
            weight, left = own.weight.copy(), seen.misfit[side][own.there]
            weight[own.there] = evened(weight[own.there], left, greatest)
            sides[side] = replace(own, weight=weight)
        found = stage.asked(replace(model, sides=sides)).run(stage.work.free, more)
        if found is None:
            break
        stage = found
    return squares


def work_of(
    model: JointModel, request: HobbedRequest, start: Start, blank: PairBlank, *, patient: bool
) -> Work:
    """What a fit works with: the request's method and limits, as entries of the joint vector."""
    method, asked = METHODS[request.pinion_method], request.limits
    bends = request.grind.pinion_curve_radius is None
    fixed = _each({n: chain_value(n, v, blank) for n, v in asked.fixed.items()})
    own = [*_each(dict.fromkeys(method.free)), *(BENDS if bends else ())]
    names = dict.fromkeys((*own, *_each(dict.fromkeys(asked.free))))
    held = step_limits(blank, float(joint_vector(start)[PLACE["ratio_of_roll"]]))
    return Work(
        model,
        request,
        start,
        blank,
        method,
        tuple(name for name in names if name not in fixed),
        tuple(name for name in own if name not in fixed and name not in MOVING),
        fixed,
        _each(bounds_of(asked, blank)),
        _each({name: held[name] for name in NAMES}),
        patient,
    )


def begun(work: Work) -> Stage | None:
    """The stage before motions: what the method has not, is fixed or bounded, led there and kept there."""
    first = tuple(dict.fromkeys((*work.first, *work.method.rest)))
    vector, memory = joint_vector(work.start), work.model.start
    if work.patient:
        vector, memory = _swivelled(work, first)
    stage = work.run(vector, first, {}, memory, bounded=False)
    if stage is None:
        return None
    has = {name: [float(stage.vector[k])] for name, k in PLACE.items()}
    to = goals(work.method, work.fixed, work.bounds, has)
    if not to:
        return stage
    # without tilt the swivel only says where the cutter's turn counts from
    untilted = to.get("tilt_angle") == 0.0
    off = {name: value for name, value in to.items() if abs(has[name][0] - value) > 1e-9}
    if any(name != "swivel_angle" or not untilted for name in off):
        wishes = lead(off, work.limits)
        if untilted or "swivel_angle" not in to:
            wishes["swivel_angle"] = Wish(has["swivel_angle"][0], math.radians(1.0))
        stage = stage.run(tuple(dict.fromkeys((*first, *wishes))), wishes, steps=80, bounded=False)
        if stage is None:
            return None
    put, memory = stage.vector.copy(), stage.memory
    put[[PLACE[name] for name in to]] = list(to.values())
    if untilted:
        memory = _turned(memory, float(put[SWIVEL] - stage.vector[SWIVEL]))
    return stage.work.run(put, work.first, {}, memory)


def _swivelled(work: Work, free: tuple[str, ...]) -> tuple[Array, Memory]:
    """The start, and where there is no tilt, with the swivel along which tilt is wanted.

    Tilt and swivel are polar coordinates of the cutter's axis: at no tilt the swivel moves nothing, and a
    fit that is to lean the axis across it would stay where it is.
    """
    vector, memory = joint_vector(work.start), work.model.start
    if vector[TILT] != 0.0 or not {"tilt_angle", "swivel_angle"} <= set(free):
        return vector, memory
    across, turned = vector.copy(), _turned(memory, 0.5 * math.pi)
    across[SWIVEL] += 0.5 * math.pi
    seen, other = work.look(vector, {}, memory), work.look(across, {}, turned)
    if seen is None or other is None:
        return vector, memory
    index = [PLACE[name] for name in free if name not in ("tilt_angle", "swivel_angle")]
    scale = np.array([work.limits[name] for name in (*(JOINT[k] for k in index), *HEAD)])
    columns = [seen.jacobian[:, index], seen.jacobian[:, [TILT]], other.jacobian[:, [TILT]]]
    step = np.linalg.lstsq(np.hstack(columns) * scale, -seen.residual, rcond=CUT)[0]
    swivel = math.atan2(step[-1], step[-2])
    vector[SWIVEL] += swivel
    return vector, _turned(memory, swivel)


def _turned(memory: Memory, by: float) -> Memory:
    """The memory of an untilted cutter whose swivel changes so much: its turn counts from there."""
    return {
        side: (s, turn + by, phi, root_turn + by, root_phi)
        for side, (s, turn, phi, root_turn, root_phi) in memory.items()
    }
