"""Residuals of one pinion flank against what is asked of it, with their exact Jacobian.

Three kinds of rows: ease-off against its target (um), the root that the blade's tips cut against the
blank's root line, and wishes: values that entries should keep near, each with how far it may stray.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import PitchCone, Side

from ._conjugate import Conjugate
from ._settings_model import INDEX, NAMES, flank_at, root_at
from ._target import Target, TargetPlaces

Array = np.ndarray[Any, Any]
UM = 1e-3  # mm
LEFT = 1e-8  # mm that Newton may leave
ROOT_PLACES = 3  # toe, mean point, heel
FOLDING = 0.1  # of the mean point's (z, rho) per (s, roll): nearer to where the flank folds, nothing counts
BRANCHES = (1.0, -1.0)  # roots of the meshing condition


@dataclass(frozen=True)
class Wish:
    """A value that an entry of the vector should keep near, and how far it may stray (mm, rad)."""

    value: float
    spread: float


@dataclass(frozen=True)
class Seen:
    """One look at the model: residuals, Jacobian by every entry, and where Newton may start next."""

    residual: Array
    jacobian: Array  # (rows, entries of the vector)
    memory: tuple[Array, Array, Array]
    ease_off: Array  # (n,) mm


@dataclass(frozen=True)
class PinionModel:
    """A pinion flank to be fitted: its conjugate, what is asked, and which root and blade cut it."""

    side: Side
    cone: PitchCone
    conjugate: Conjugate
    wanted: Array  # (n,) mm, the target ease-off
    there: Array  # (n,) bool: points that count
    root_distance: Array  # S where the root is looked at, mm
    root_height: Array  # H wanted there
    root_spread: float  # how far it may stray, mm
    branch: float
    outward: float
    reference: float  # height of a curved blade's angle above the tips, mm
    root_branch: float
    lead: Array  # (n,) edge parameters to start from
    roll: Array

    @property
    def blade_side(self) -> float:
        """+1 for the outside blade, which cuts the concave flank."""
        return 1.0 if self.side == "concave" else -1.0

    @property
    def start_memory(self) -> tuple[Array, Array, Array]:
        return self.lead, self.roll, np.zeros(ROOT_PLACES)

    def look(
        self, vector: Array, wishes: Mapping[str, Wish], memory: tuple[Array, Array, Array]
    ) -> Seen | None:
        """Residuals and Jacobian at a vector; None where the flank or its root cannot be found."""
        s, roll, root_roll = memory
        c, side = self.conjugate, self.blade_side
        got = flank_at(vector, self.branch, self.outward, side, self.reference, c.z, c.rho, s, roll)
        s, roll, angle, left, lever = got[:5]
        if not np.all(left[self.there] < LEFT):
            return None
        root = root_at(vector, self.root_branch, self.cone, side, self.root_distance, root_roll)
        if not np.all(root[2] < LEFT):
            return None
        off, turned = angle - c.angle, got[6:] / lever
        ease_off = -(off - off[c.middle]) * c.lever
        slopes = -(turned - turned[:, c.middle : c.middle + 1]) * c.lever
        wanted = self.wanted - self.wanted[c.middle]
        rows = [
            (ease_off - wanted)[self.there] / UM,
            (root[1] - self.root_height) / self.root_spread,
        ]
        lines = [slopes[:, self.there].T / UM, (root[3:] / self.root_spread).T]
        for name, wish in wishes.items():
            rows.append(np.array([(vector[INDEX[name]] - wish.value) / wish.spread]))
            line = np.zeros((1, len(NAMES)))
            line[0, INDEX[name]] = 1.0 / wish.spread
            lines.append(line)
        residual, jacobian = np.concatenate(rows), np.concatenate(lines)
        if not (np.isfinite(residual).all() and np.isfinite(jacobian).all()):
            return None
        return Seen(residual, jacobian, (s, roll, root[0]), ease_off)


def target_places(conjugate: Conjugate, blank: PairBlank) -> TargetPlaces:
    """Where a target is asked for: the conjugate's points."""
    own, depth = blank.pinion, 0.5 * (blank.working_depth or 0.0)
    along = conjugate.distance - own.mean_cone_distance
    z1, z2 = blank.cones.teeth
    return TargetPlaces(
        x=along / (0.5 * own.face_width),
        y=conjugate.height / depth,
        height=conjugate.height,
        along=along,
        turn=np.where(conjugate.there, conjugate.roll - conjugate.roll[conjugate.middle], np.nan),
        wheel_lever=np.abs(conjugate.lever) * z2 / z1,
        wheel_pitch=2.0 * math.pi / z2,
    )


def pinion_model(
    side: Side,
    conjugate: Conjugate,
    blank: PairBlank,
    cone: PitchCone,
    vector: Array,
    lead: Array,
    roll: Array,
    target: Target,
    root_spread: float,
) -> PinionModel:
    """The model of a pinion flank at a start; ``lead`` and ``roll`` (n,) are where Newton begins."""
    own, c = blank.pinion, conjugate
    outward, side_sign = (-1.0 if side == "concave" else 1.0), (1.0 if side == "concave" else -1.0)
    places = target_places(c, blank)
    distance = np.array([own.inner_cone_distance, own.mean_cone_distance, own.outer_cone_distance])
    looks = [
        flank_at(vector, trial, outward, side_sign, 0.0, c.z, c.rho, lead, roll)
        for trial in BRANCHES
    ]
    branch = int(np.argmin([_misfit(got, c) for got in looks]))
    got = looks[branch]
    # a left-hand member turns its concave flanks to falling angles
    if got[4][c.middle] * outward < 0.0:
        outward = -outward
    there = c.there & (got[3] < LEFT) & (got[5] / got[5][c.middle] > FOLDING)
    root = -np.array([own.inner_dedendum, own.mean_dedendum, own.outer_dedendum])
    roots = [root_at(vector, sign, cone, side_sign, distance, np.zeros(3)) for sign in BRANCHES]
    off = [float(np.abs(r[1] - root).max() + 1e6 * r[2].max()) for r in roots]
    return PinionModel(
        side, cone, c, target.at(places), there, distance, root, root_spread,
        BRANCHES[branch], outward, 0.0, BRANCHES[int(np.argmin(off))], got[0], got[1],
    )  # fmt: skip


def _misfit(got: Array, conjugate: Conjugate) -> float:
    """How far a flank stands from a conjugate, mm, turned to meet it at the middle; points lost weigh more."""
    off = got[2] - conjugate.angle
    off = np.abs(off - off[conjugate.middle]) * np.abs(conjugate.lever)
    found = (got[3] < LEFT) & conjugate.there
    if not found[conjugate.middle]:
        return np.inf
    return float(np.median(off[found])) + 10.0 * float((~found & conjugate.there).mean())


def lead_of(conjugate: Conjugate, vector: Array) -> Array:
    """Edge parameters of the conjugate's points on a cutter that stands as the wheel's, mm."""
    tilt, swivel, q = (vector[INDEX[n]] for n in ("tilt_angle", "swivel_angle", "cradle_angle"))
    turn, radial = 0.5 * math.pi - q + swivel, vector[INDEX["radial_distance"]]
    axis = np.array(
        [math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn), math.cos(tilt)]
    )
    centre = np.array([radial * math.cos(q), -radial * math.sin(q), -vector[INDEX["sliding_base"]]])
    height = -(conjugate.cradle_point - centre) @ axis
    return height / math.cos(vector[INDEX["blade_angle"]])
