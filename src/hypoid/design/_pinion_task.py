"""What is to be fitted of a pinion, and one stage of the fit: a flank alone, or both flanks of a slot."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import SIDES, Side

from ._conjugate import Conjugate, conjugate
from ._joint_fit import Entry, FlankModel, JointFit, Tie, Wish, joint_fit
from ._milled_request import MilledRequest
from ._milled_wheel import LEAST_EDGE, MilledWheel, pitch_cone
from ._pinion_methods import (
    ALONE,
    METHODS,
    Bounds,
    Freedom,
    blade_wish,
    bounds_of,
    chain_value,
    entries_of,
    lead,
    step_limits,
)
from ._pinion_methods import goals as goals_of
from ._pinion_model import FOLDING, ROOT_PLACES, PinionModel, Seen
from ._settings_model import INDEX
from ._target import Target

Array = np.ndarray[Any, Any]
BACKLASH = 0.002  # mm, how far a slot's backlash may stray
FEWEST = 20  # points of the conjugate that a fit needs
UNFOLDINGS = 4  # runs of a stage, each without the places that folded in the last
ROOT_SPREAD = 0.02  # mm, of the mean of a slot's two corners; each may stray further
JOINT_BLADE = math.radians(2.0)  # blades of one cutter depart further from their pressure angles
CUTTER = 0.1  # of the cutter's radius, that a spread-blade pinion cutter may stray


@dataclass(frozen=True)
class PinionTask:
    """The wheel's conjugate flanks, and what method and request let move."""

    request: MilledRequest
    blank: PairBlank
    wheel: MilledWheel
    conjugates: Mapping[Side, Conjugate]
    method: Freedom
    bounds: Bounds
    fixed: Mapping[str, float]  # chain's signs

    @property
    def free(self) -> tuple[str, ...]:
        """Entries that the method or the request moves and the request does not fix."""
        names = dict.fromkeys((*self.method.free, *self.request.limits.free))
        return tuple(name for name in names if name not in self.fixed)

    @property
    def limits(self) -> dict[str, float]:
        """Greatest change of each entry in one step."""
        return step_limits(self.blank, self.blank.wheel.teeth / self.blank.pinion.teeth)

    @property
    def least_edge(self) -> float:
        """Along the blade from its tips, mm, that an edge arc must find below the active flank."""
        radius = self.request.pinion_edge_radius
        if radius is None:
            radius = LEAST_EDGE * self.blank.mean_normal_module
        angles = self.blank.pressure_angles
        assert angles is not None
        least = min(angles.drive, angles.coast)
        return radius * (1.0 - math.sin(least)) / math.cos(least)

    def target(self, side: Side) -> Target:
        """What is asked of a pinion flank."""
        return self.request.drive if side == "concave" else self.request.coast

    def alone(self) -> PinionTask:
        """The same, each flank by itself: where a joint fit may start from."""
        return replace(self, method=METHODS[ALONE[self.request.pinion_method]])

    def entries(self, names: Sequence[str], joint: bool, bounded: bool) -> tuple[Entry, ...]:
        """Unknowns of these names."""
        plane = self.method.root_plane and bounded
        bounds = self.bounds if bounded else {}
        return entries_of(
            tuple(names), self.limits, bounds, self.blank, joint=joint, root_plane=plane
        )


def pinion_task(request: MilledRequest, blank: PairBlank, wheel: MilledWheel) -> PinionTask:
    """The task of a request."""
    cone = pitch_cone(blank, "pinion")
    found: dict[Side, Conjugate] = {
        "concave": conjugate(blank, wheel.flank("convex"), cone),
        "convex": conjugate(blank, wheel.flank("concave"), cone),
    }
    fixed = {n: chain_value(n, v, blank) for n, v in request.limits.fixed.items()}
    method = METHODS[request.pinion_method]
    return PinionTask(request, blank, wheel, found, method, bounds_of(request.limits, blank), fixed)


@dataclass(frozen=True)
class Stage:
    """Flanks as far as they are fitted: models, vectors, and where Newton goes on from."""

    models: tuple[PinionModel, ...]
    vectors: tuple[Array, ...]
    memories: tuple[Any, ...]
    fit: JointFit | None = None

    @property
    def cost(self) -> float:
        """Sum of squares; infinite before any fit."""
        return math.inf if self.fit is None else self.fit.fit.cost

    @property
    def largest(self) -> float:
        """Greatest residual of the ease-off on any flank, mm."""
        if self.fit is None:
            return math.inf
        looks = zip(self.fit.looks, self.models, strict=True)
        return max(float(np.abs(m.off(look)).max()) for look, m in looks)

    def put(self, values: Mapping[str, float]) -> Stage:
        """The same with entries of every flank at these values."""
        vectors = tuple(v.copy() for v in self.vectors)
        for vector in vectors:
            for name, value in values.items():
                if name in INDEX:
                    vector[INDEX[name]] = value
        return replace(self, vectors=vectors)


def run(
    task: PinionTask,
    stage: Stage,
    names: Sequence[str],
    more: Mapping[str, Wish],
    *,
    bounded: bool = True,
    steps: int = 60,
) -> Stage | None:
    """One stage: these entries free, with these wishes beside the blades'; None where none can be looked at.

    Places that fold on the way are of another sheet from there on: they are left out, and the stage goes on. So are
    those near undercut, which hold the others up, while the tolerance is not met.
    """
    joint = len(stage.models) > 1
    wishes = {**_blade_wishes(task, stage), **more}
    for left in range(UNFOLDINGS, 0, -1):
        tie = _slot_tie(task, stage) if joint else None
        looks: list[FlankModel] = [model.look for model in stage.models]
        found = joint_fit(
            looks, stage.vectors, stage.memories, task.entries(names, joint, bounded), INDEX,
            wishes=wishes, tie=tie, steps=steps,
        )  # fmt: skip
        if found is None:
            return None
        stage = Stage(stage.models, found.vectors, found.fit.look.memory, found)
        least = 0.0 if stage.largest <= task.request.tolerance else FOLDING
        if left == 1 or not any((look.upright < least).any() for look in found.looks):
            return stage
        pairs = zip(stage.models, found.looks, strict=True)
        models = tuple(replace(m, there=m.there & (look.upright >= least)) for m, look in pairs)
        if any(model.count < FEWEST for model in models):
            return stage
        stage = replace(stage, models=models, fit=None)
    return None


def _blade_wishes(task: PinionTask, stage: Stage) -> dict[str, Wish]:
    """Blades near their pressure angles, and a cutter for both flanks near the one that is asked for."""
    angles = task.blank.pressure_angles
    assert angles is not None
    pressure: dict[Side, float] = {"concave": angles.drive, "convex": angles.coast}
    if len(stage.models) == 1:
        return {"blade_angle": blade_wish(pressure[stage.models[0].side])}
    radius = task.request.blank.cutter_radius
    wishes = {f"{side}.blade_angle": Wish(pressure[side], JOINT_BLADE) for side in SIDES}
    return {**wishes, "cutter_radius": Wish(radius, CUTTER * radius)}


def _slot_tie(task: PinionTask, stage: Stage) -> Any:
    """Rows of the normal backlash that one cutter's slot leaves, and of its root, concave flank first.

    Turned onto its conjugate each flank would touch; what lies between both turns is play. A tilted
    cutter's root slants across the slot: what is asked for is the mean of both corners'.
    """
    pitch = 2.0 * math.pi / task.blank.pinion.teeth
    first, second = (float(m.conjugate.lever[m.conjugate.middle]) for m in stage.models)
    lever, asked = 0.5 * (first - second), task.request.normal_backlash

    def tie(looks: Sequence[Seen]) -> Tie:
        concave, convex = looks
        play = convex.turn - concave.turn - asked / lever
        play -= pitch * round(play / pitch)
        size = lever / BACKLASH
        at = [slice(m.count, m.count + ROOT_PLACES) for m in stage.models]
        share = [0.5 * m.root_spread / ROOT_SPREAD for m in stage.models]
        roots = sum(k * look.residual[n] for k, look, n in zip(share, looks, at, strict=True))
        slopes = tuple(
            np.vstack([sign * size * look.turn_slopes, k * look.jacobian[n]])
            for sign, k, look, n in zip((-1.0, 1.0), share, looks, at, strict=True)
        )
        return Tie(np.append(size * play, roots), slopes)

    return tie


def goals(task: PinionTask, stage: Stage) -> dict[str, float]:
    """Entries that a fit must be led to."""
    values = {name: [float(v[k]) for v in stage.vectors] for name, k in INDEX.items()}
    fixed = dict(task.fixed)
    if task.method.root_plane:
        fixed["machine_root_angle"] = task.blank.pinion.root_angle
    return goals_of(task.method, fixed, task.bounds, values)


def led(task: PinionTask, stage: Stage, to: Mapping[str, float]) -> Stage | None:
    """The stage with entries led to values by wishes, and then put there."""
    if not to:
        return stage
    wishes = lead({name: value for name, value in to.items() if name in INDEX}, task.limits)
    if "swivel_angle" not in to:  # it means less and less while the tilt goes to nothing
        at = INDEX["swivel_angle"]
        middle = float(np.mean([v[at] for v in stage.vectors]))
        wishes["swivel_angle"] = Wish(middle, math.radians(1.0))
    names = dict.fromkeys((*task.free, *wishes))
    found = run(task, stage, tuple(names), wishes, bounded=False, steps=80)
    return None if found is None else found.put(to)


def in_root_plane(task: PinionTask, stage: Stage) -> Stage:
    """The stage with its tips in the blank's root plane, where the method holds them there."""
    if not task.method.root_plane:
        return stage
    own, vectors = task.blank.pinion, tuple(v.copy() for v in stage.vectors)
    for vector in vectors:
        back = own.root_apex_beyond_crossing_point - vector[INDEX["machine_center_to_back"]]
        vector[INDEX["machine_root_angle"]] = own.root_angle
        vector[INDEX["sliding_base"]] = math.sin(own.root_angle) * back
    return replace(stage, vectors=vectors)
