"""Residuals of one pinion flank against what is asked of it, with their exact Jacobian.

Three kinds of rows: ease-off against its target (um), the root that the blade's tips cut against the
blank's root line, and what the blade lacks below its flank: where a place on the active flank would be cut by
less edge than the tips' arc needs, or by none.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import PitchCone, Side

from ._conjugate import Conjugate
from ._pinion_start import Places
from ._settings_model import flank_at, root_at
from ._target import Target, TargetPlaces

Array = np.ndarray[Any, Any]
UM = 1e-3  # mm
LEFT = 1e-8  # mm that Newton may leave
FOLDING = 0.1  # of the mean point's places per parameters: nearer to undercut, nothing counts
ROOT_SPREAD = 0.01  # mm
CORNER_SPREAD = 0.1  # mm, of one corner of a slot that one cutter cuts
ROOT_PLACES = 3  # toe, mean point, heel
ROOT_ROLLS = (0.0, -0.25, 0.25)  # rad about the flank's roll, to look for the root from
EDGE_SPREAD = 0.02  # mm, by which a place may fall short of the edge that is kept for the arc
FAR = (
    5.0,
    2.0,
)  # mm, or normal modules, in the median off the conjugate: a start that met another sheet


@dataclass(frozen=True)
class Seen:
    """One look at the model: residuals, Jacobian by every entry, and where Newton may start next."""

    residual: Array
    jacobian: Array  # (rows, entries of the vector)
    memory: tuple[Array, ...]
    ease_off: Array  # (n,) mm
    turn: float  # rad, from the conjugate to the flank at the middle, about the axis
    turn_slopes: Array  # its derivatives by every entry
    upright: Array  # (n,) 1 at the mean point, 0 at undercut, less on another sheet; infinite where nothing counts


@dataclass(frozen=True)
class PinionModel:
    """A pinion flank to be fitted: its conjugate and what is asked."""

    side: Side
    cone: PitchCone
    conjugate: Conjugate
    wanted: Array  # (n,) mm, the target ease-off
    there: Array  # (n,) bool: points that count
    weight: Array  # (n,) of their rows
    root_distance: Array  # S where the root is looked at, mm
    root_height: Array  # H wanted there
    root_spread: float  # how far it may stray, mm
    least_edge: float  # mm along the blade from the tips, which its arc takes
    outward: float
    reference: float  # height of a curved blade's angle above the tips, mm
    start_memory: tuple[Array, ...]  # s and both turns of the flank (n,), both of the root

    @property
    def blade_side(self) -> float:
        """+1 for the outside blade, which cuts the concave flank."""
        return 1.0 if self.side == "concave" else -1.0

    @property
    def count(self) -> int:
        """Rows of the ease-off; those of the root follow."""
        return int(self.there.sum())

    def off(self, look: Seen) -> Array:
        """What the ease-off keeps from its target, mm, where points count."""
        wanted = self.wanted - self.wanted[self.conjugate.middle]
        return (look.ease_off - wanted)[self.there]

    def look(self, vector: Array, memory: tuple[Array, ...]) -> Seen | None:
        """Residuals and Jacobian at a vector; None where the flank or its root cannot be found."""
        c, side = self.conjugate, self.blade_side
        z, rho = (np.where(self.there, v, v[c.middle]) for v in (c.z, c.rho))
        start = (np.where(self.there, v, v[c.middle]) for v in memory[:3])
        got = flank_at(vector, self.outward, side, self.reference, z, rho, *start)
        s, theta, phi, angle, left, lever, sense = got[:7]
        if not np.all(left[self.there] < LEFT):
            return None
        root = root_at(vector, self.cone, side, self.root_distance, *memory[3:])
        if not np.all(root[3] < LEFT):
            return None
        half = 7 + len(vector)
        off, turned = angle - c.angle, got[7:half] / lever
        ease_off = -(off - off[c.middle]) * c.lever
        slopes = -(turned - turned[:, c.middle : c.middle + 1]) * c.lever
        wanted = self.wanted - self.wanted[c.middle]
        short = np.where(self.there, np.maximum(self.least_edge - s, 0.0), 0.0) / EDGE_SPREAD
        by_edge = np.where(short > 0.0, -got[half:] / EDGE_SPREAD, 0.0)
        weight = self.weight[self.there] / UM
        residual = np.concatenate(
            [
                weight * (ease_off - wanted)[self.there],
                (root[2] - self.root_height) / self.root_spread,
                short[self.there],
            ]
        )
        jacobian = np.concatenate(
            [
                weight[:, None] * slopes[:, self.there].T,
                (root[4:] / self.root_spread).T,
                by_edge[:, self.there].T,
            ]
        )
        if not (np.isfinite(residual).all() and np.isfinite(jacobian).all()):
            return None
        memory = (s, theta, phi, root[0], root[1])
        turn, turn_slopes = float(off[c.middle]), turned[:, c.middle]
        upright = np.where(self.there, sense / sense[c.middle], np.inf)
        return Seen(residual, jacobian, memory, ease_off, turn, turn_slopes, upright)

    def asked(self, target: Target, blank: PairBlank) -> PinionModel:
        """The same flank with another target."""
        return replace(self, wanted=target.at(target_places(self.conjugate, blank)))


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
    start: Places,
    target: Target,
    least_edge: float,
    root_spread: float = ROOT_SPREAD,
) -> PinionModel | None:
    """The model of a pinion flank at a start; None where the start does not reach the mean point.

    ``start`` holds edge parameter and both turns from which Newton begins, (n,) each; ``least_edge`` is what
    the arc at the tips takes of the blade, mm.
    """
    own, c = blank.pinion, conjugate
    outward, side_sign = (-1.0 if side == "concave" else 1.0), (1.0 if side == "concave" else -1.0)
    got = flank_at(vector, outward, side_sign, 0.0, c.z, c.rho, *start)
    found = (got[4] < LEFT) & c.there
    if not found[c.middle]:
        return None
    off = got[3] - c.angle
    off = np.abs(off - off[c.middle]) * np.abs(c.lever)
    if float(np.median(off[found])) > max(FAR[0], FAR[1] * blank.mean_normal_module):
        return None
    # a left-hand member turns its concave flanks to falling angles
    if got[5][c.middle] * outward < 0.0:
        outward = -outward
    there = found & (got[6] / got[6][c.middle] > FOLDING)
    distance = np.array([own.inner_cone_distance, own.mean_cone_distance, own.outer_cone_distance])
    height = -np.array([own.inner_dedendum, own.mean_dedendum, own.outer_dedendum])
    root = _root_start(vector, cone, side_sign, distance, height, c, got[:3], there)
    if root is None:
        return None
    memory = (*got[:3], *root)
    wanted = target.at(target_places(c, blank))
    return PinionModel(
        side,
        cone,
        c,
        wanted,
        there,
        np.ones(len(there)),
        distance,
        height,
        root_spread,
        least_edge,
        outward,
        0.0,
        memory,
    )


def _root_start(
    vector: Array,
    cone: PitchCone,
    side: float,
    distance: Array,
    height: Array,
    conjugate: Conjugate,
    flank: Array,
    there: Array,
) -> tuple[Array, Array] | None:
    """Both turns at which the tips cut the root nearest the blank's, from those of the flank's lowest points."""
    off = np.hypot(conjugate.distance - distance[:, None], conjugate.height - height[:, None])
    near = np.argmin(np.where(there, off, np.inf), axis=1)
    best, least = None, np.inf
    for more in ROOT_ROLLS:
        got = root_at(vector, cone, side, distance, flank[1][near], flank[2][near] + more)
        if np.all(got[3] < LEFT):
            miss = float(np.abs(got[2] - height).max())
            if miss < least:
                best, least = (got[0], got[1]), miss
    return best
