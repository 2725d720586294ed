"""A face-hobbed pinion's fit at work: what moves within which bounds, one run of it, and its first stage."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import SIDES, Side

from ._fit import EVENED, Fit, Look, evened, gauss_newton
from ._hobbed_joint import BLADES, PLACE, JointModel, JointSeen, Memory, SideModel, joint_vector
from ._hobbed_request import HobbedRequest
from ._hobbed_start import Start
from ._joint_fit import Wish
from ._pinion_methods import (
    METHODS,
    Bounds,
    Freedom,
    bounds_of,
    chain_value,
    goals,
    lead,
    step_limits,
)
from ._settings_model import MOTIONS, NAMES, ROLL

Array = np.ndarray[Any, Any]
V = TypeVar("V")
BENDS = tuple(f"{side}.blade_curvature" for side in SIDES)
MOVING = (*ROLL, *MOTIONS, "helical_motion")  # left for the last stage
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
        steps: int = 60,
        bounded: bool = True,
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

        scale = np.array([self.limits[name] for name in free])
        low, high = np.array([self.ends(name) if bounded else FAR for name in free]).T
        fit = gauss_newton(model, vector[index], memory, scale, low=low, high=high, steps=steps)
        return None if fit is None else (full(fit.x), fit)

    def evened(
        self,
        vector: Array,
        fit: Fit,
        free: tuple[str, ...],
        more: Mapping[str, Wish],
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
            found = replace(self, model=model).run(vector, free, more, fit.look.memory)
            if found is None:
                break
            vector, fit = found
        return squares


def work_of(model: JointModel, request: HobbedRequest, start: Start, blank: PairBlank) -> Work:
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
    )


def begun(work: Work) -> tuple[Array, Fit] | None:
    """The stage before motions: what the method has not, is fixed or bounded, led there and kept there."""
    vector, memory = joint_vector(work.start), work.model.start
    first = tuple(dict.fromkeys((*work.first, *work.method.rest)))
    stage = work.run(vector, first, {}, memory, bounded=False)
    if stage is None:
        return None
    vector, memory = stage[0], stage[1].look.memory
    to = goals(work.method, work.fixed, work.bounds, {n: [vector[k]] for n, k in PLACE.items()})
    off = {name: value for name, value in to.items() if abs(vector[PLACE[name]] - value) > 1e-9}
    if not to:
        return stage
    # without tilt the swivel only says where the cutter's turn counts from
    untilted = to.get("tilt_angle") == 0.0
    swivel = float(vector[PLACE["swivel_angle"]])
    if any(name != "swivel_angle" or not untilted for name in off):
        wishes = lead(off, work.limits)
        if untilted or "swivel_angle" not in to:
            wishes["swivel_angle"] = Wish(swivel, math.radians(1.0))
        names = tuple(dict.fromkeys((*first, *wishes)))
        stage = work.run(vector, names, wishes, memory, steps=80, bounded=False)
        if stage is None:
            return None
        vector, memory = stage[0], stage[1].look.memory
    put = vector.copy()
    put[[PLACE[name] for name in to]] = list(to.values())
    if untilted:
        turned = float(put[PLACE["swivel_angle"]] - vector[PLACE["swivel_angle"]])
        memory = {
            side: (s, turn + turned, phi, root_turn + turned, root_phi)
            for side, (s, turn, phi, root_turn, root_phi) in memory.items()
        }
    return work.run(put, work.first, {}, memory)
