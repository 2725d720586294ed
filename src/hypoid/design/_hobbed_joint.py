"""Residuals of both flanks of a face-hobbed pinion, cut in one setting-up, with their exact Jacobian.

Settings and motions are common, radius, angle and curvature of each blade its flank's own. Rows: the
ease-off of either flank against its target (um), the root that either blade's corner cuts against the
blank's root line, the tooth's thickness at the mean point, and wishes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import cos, pi
from typing import Any

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import SIDES, Flank, PitchCone, Side, roots_near

from ._conjugate import Conjugate
from ._hobbed_cut import stick
from ._hobbed_model import FIXED, ROLLED_AT, ROOT_AT, Stick
from ._hobbed_start import Start
from ._joint_fit import Wish
from ._pinion_model import FOLDING, LEFT, UM, target_places
from ._settings_model import BLADE, INDEX, NAMES, vector_of
from ._target import Target

Array = np.ndarray[Any, Any]
BLADES = {
    "point_radius": "blade_radius",
    "blade_angle": "blade_angle",
    "blade_curvature": "blade_curvature",
}
COMMON = tuple(name for name in NAMES if name not in BLADE)
JOINT = (*COMMON, *(f"{side}.{BLADES[name]}" for side in SIDES for name in BLADE))
PLACE = {name: k for k, name in enumerate(JOINT)}
# columns of the joint vector that make either flank's own
COLUMNS = {
    side: np.array([PLACE[n] for n in COMMON] + [PLACE[f"{side}.{BLADES[n]}"] for n in BLADE])
    for side in SIDES
}
assert NAMES[-3:] == BLADE
assert [INDEX[name] for name in COMMON] == list(range(len(COMMON)))
ROOT_LEFT = 1e-6  # mm that Newton may leave at a root, where its path may run along the edge's
SAME = 1e-6  # rad of the cutter's turn
ROOT_PLACES = 3  # toe, mean point, heel
THICKNESS_SPREAD = 1e-3  # mm: the slot's width comes before the last um of the ease-off
ROOT_SPREAD = 0.01  # mm, at the mean point
ROOT_AT_ENDS = 0.15  # of the clearance: a tilted head of one setting-up cuts no cone
SIDE_ROOTS = 2.0**0.5  # both corners are looked at: together they weigh as one

# where Newton starts: s, turn and phi of the flank, turn and phi of the root
Memory = Mapping[Side, tuple[Array, Array, Array, Array, Array]]


@dataclass(frozen=True)
class SideModel:
    """One flank of the pinion and what is asked of it."""

    side: Side
    conjugate: Conjugate
    wanted: Array  # (n,) mm, the target ease-off
    there: Array  # (n,) bool: points that count
    weight: Array  # (n,) of their rows
    stick: Stick
    z: Array  # (n + 1,) mm, where the flank is asked for, the mean point last
    rho: Array


@dataclass(frozen=True)
class JointSeen:
    """One look at both flanks."""

    residual: Array
    jacobian: Array  # (rows, entries of the joint vector)
    memory: Memory
    misfit: Mapping[Side, Array]  # (n,) mm, ease-off less its target, all points
    root_error: Mapping[Side, Array]  # (3,) mm
    thickness: float  # normal, at the mean point, mm
    upright: Mapping[Side, Array]  # (n,) of the flank against the mean point's: 0 where it folds


@dataclass(frozen=True)
class JointModel:
    """A face-hobbed pinion to be fitted."""

    cone: PitchCone
    sides: Mapping[Side, SideModel]
    root_distance: Array
    root_height: Array
    root_spread: Array  # (3,) how far it may stray, mm
    teeth: int
    across: float  # turns an angle about the axis into a normal thickness at the mean point, mm
    thickness: float  # wanted there, mm
    weigh_thickness: bool  # not where the blades' spacing makes it
    start: Memory

    def only(self, there: Mapping[Side, Array]) -> JointModel:
        """The model without the points that do not count any more."""
        sides = {
            side: replace(
                own, there=there[side], z=_kept(own.z, there[side]), rho=_kept(own.rho, there[side])
            )
            for side, own in self.sides.items()
        }
        return replace(self, sides=sides)

    def look(self, vector: Array, wishes: Mapping[str, Wish], memory: Memory) -> JointSeen | None:
        """Residuals and Jacobian at a joint vector; None where a flank or its root cannot be found."""
        rows: list[Array] = []
        lines: list[Array] = []
        kept: dict[Side, tuple[Array, Array, Array, Array, Array]] = {}
        misfit: dict[Side, Array] = {}
        off_root: dict[Side, Array] = {}
        upright: dict[Side, Array] = {}
        at_mean: dict[Side, tuple[float, Array]] = {}
        for side, model in self.sides.items():
            c, columns = model.conjugate, COLUMNS[side]
            own, (*start, root_turn, root_phi) = vector[columns], memory[side]
            got = ROLLED_AT(own, model.stick, model.z, model.rho, *start)
            if not np.all(got[4] < LEFT):
                return None
            root = ROOT_AT(own, model.stick, self.cone, self.root_distance, root_turn, root_phi)
            if not np.all(root[3] < ROOT_LEFT):
                return None
            kept[side] = got[0], got[1], got[2], root[0], root[1]
            angle, turned = got[3], got[FIXED:] / got[5]
            at_mean[side] = float(angle[-1]), turned[:, -1]
            off = angle[:-1] - c.angle
            ease_off = -(off - off[c.middle]) * c.lever
            slopes = -(turned[:, :-1] - turned[:, c.middle : c.middle + 1]) * c.lever
            misfit[side] = ease_off - (model.wanted - model.wanted[c.middle])
            off_root[side] = root[2] - self.root_height
            upright[side] = got[6][:-1] / got[6][-1]
            weight = model.weight[model.there] / UM
            rows += [
                weight * misfit[side][model.there],
                off_root[side] / (SIDE_ROOTS * self.root_spread),
            ]
            lines += [
                _spread(weight[:, None] * slopes[:, model.there].T, columns),
                _spread((root[4:] / (SIDE_ROOTS * self.root_spread)).T, columns),
            ]
        turn = at_mean["convex"][0] - at_mean["concave"][0]
        thickness = float(np.mod(turn, 2.0 * pi / self.teeth)) * self.across
        if self.weigh_thickness:
            rows.append(np.array([(thickness - self.thickness) / THICKNESS_SPREAD]))
            line = np.zeros((1, len(JOINT)))
            for side, sign in zip(SIDES, (-1.0, 1.0), strict=True):  # concave, convex
                line[0, COLUMNS[side]] += sign * at_mean[side][1] * self.across / THICKNESS_SPREAD
            lines.append(line)
        for name, wish in wishes.items():
            rows.append(np.array([(vector[PLACE[name]] - wish.value) / wish.spread]))
            line = np.zeros((1, len(JOINT)))
            line[0, PLACE[name]] = 1.0 / wish.spread
            lines.append(line)
        residual, jacobian = np.concatenate(rows), np.concatenate(lines)
        if not (np.isfinite(residual).all() and np.isfinite(jacobian).all()):
            return None
        return JointSeen(residual, jacobian, kept, misfit, off_root, thickness, upright)


def placed(memory: Memory, there: Mapping[Side, Array]) -> Memory:
    """Where Newton starts with points that do not count any more: they are asked for at the mean point."""
    return {
        side: (*(_kept(at, there[side]) for at in (s, turn, phi)), *root)
        for side, (s, turn, phi, *root) in memory.items()
    }  # pyright: ignore[reportReturnType]


def _kept(values: Array, there: Array) -> Array:
    """Values (n + 1,), of points that count, and the mean point's, the last, of those that do not."""
    return np.where(np.append(there, True), values, values[-1])


def _spread(rows: Array, columns: Array) -> Array:
    """Derivatives by a flank's vector as those by the joint vector."""
    wide = np.zeros((len(rows), len(JOINT)))
    wide[:, columns] = rows
    return wide


def joint_vector(start: Start) -> Array:
    """The joint vector of a start."""
    bend = start.plan.curvature
    blades: list[dict[str, float]] = [
        dict(zip(BLADE, (start.cut.radii[i], start.cut.angles[i], bend), strict=True))
        for i in (0, 1)
    ]
    first, second = (vector_of(start.cut.settings, blade) for blade in blades)
    return np.concatenate([first, second[-3:]])


def joint_model(
    start: Start,
    conjugates: Mapping[Side, Conjugate],
    targets: Mapping[Side, Target],
    blank: PairBlank,
    cone: PitchCone,
    thickness: float,
    *,
    equal_spacing: bool,
) -> JointModel | None:
    """The model of a pinion at a start; None where its flanks' roots are not found."""
    own = blank.pinion
    distance = np.array([own.inner_cone_distance, own.mean_cone_distance, own.outer_cone_distance])
    root = -np.array([own.inner_dedendum, own.mean_dedendum, own.outer_dedendum])
    at_ends = max(ROOT_AT_ENDS * (blank.clearance or 0.0), ROOT_SPREAD)
    root_spread = np.array([at_ends, ROOT_SPREAD, at_ends])
    vector = joint_vector(start)
    mean = own.position(own.mean_cone_distance, 0.0)
    sides: dict[Side, SideModel] = {}
    memory: dict[Side, tuple[Array, Array, Array, Array, Array]] = {}
    for side in SIDES:
        flank, c = start.flanks[side], conjugates[side]
        sign = 1.0 if side == "concave" else -1.0
        held = stick(start.plan, own.teeth, start.cut.height, sign)
        where = np.append(c.distance, own.mean_cone_distance), np.append(c.height, 0.0)
        begin = _on_flank(flank, *where)
        z, rho = np.append(c.z, mean[0]), np.append(c.rho, mean[1])
        entries = vector[COLUMNS[side]]
        got = ROLLED_AT(entries, held, z, rho, *begin)
        if any(start.cut.turns):  # of several sheets through the mean point the one that was cut
            turn = start.cut.turns[SIDES.index(side)]
            own_mean = ROLLED_AT(entries, held, mean[:1], mean[1:], [0.0], [turn], [0.0])
            if own_mean[4, 0] < LEFT and abs(own_mean[1, 0] - got[1, -1]) > SAME:
                lead = where[1] / np.cos(start.cut.angles[SIDES.index(side)])
                begin = (lead, *(np.full(len(lead), own_mean[k, 0]) for k in (1, 2)))
                got = ROLLED_AT(entries, held, z, rho, *begin)
        sound = (got[4] < LEFT) & (got[6] / got[6][-1] > FOLDING)
        if not sound[-1]:
            return None
        turns, rolls = (np.full(ROOT_PLACES, got[k][-1]) for k in (1, 2))
        cut = ROOT_AT(entries, held, cone, distance, turns, rolls)
        if not np.all(cut[3] < ROOT_LEFT):
            return None
        there = c.there & sound[:-1]
        wanted = targets[side].at(target_places(c, blank))
        # what does not count is asked for at the mean point, so that Newton always arrives
        lost = ~np.append(there, True)
        z[lost], rho[lost], got[:3, lost] = mean[0], mean[1], got[:3, -1:]
        sides[side] = SideModel(side, c, wanted, there, np.ones(len(there)), held, z, rho)
        memory[side] = got[0], got[1], got[2], cut[0], cut[1]
    return JointModel(
        cone,
        sides,
        distance,
        root,
        root_spread,
        own.teeth,
        0.5 * own.mean_pitch_diameter * cos(own.mean_spiral_angle),
        thickness,
        equal_spacing,
        memory,
    )


def _on_flank(flank: Flank, distance: Array, height: Array) -> tuple[Array, Array, Array]:
    """Edge parameter, turn and cradle angle to start from at places (S, H).

    Where charts do not reach, those of the middle.
    """
    s, turn, _ = flank.parameters(distance, height)
    lost = ~np.isfinite(s)
    s, turn = np.where(lost, np.nanmedian(s), s), np.where(lost, np.nanmedian(turn), turn)
    return s, turn, roots_near(flank.surface, flank.pieces["flank"], s, turn)[0]
