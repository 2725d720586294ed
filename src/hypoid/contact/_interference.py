"""Does a tip edge cut into the mating fillet? (notes of 2022, item 9)

A mating tip reaches below the place where the blade's edge arc begins; there the fillet holds more
metal than the conjugate flank would. Tip points are carried to the mate at every position, with the
wheel where the contact puts it, and compared with the whole tooth, fillet included.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._field import angle_field
from ._mounting import to_pinion, to_wheel
from ._unloaded import UnloadedContact

Array = np.ndarray[Any, Any]
REACH = 0.1  # mm above the fillet limit that is still looked at
NOTICEABLE = 1e-4  # mm: shallower than a tenth of a micrometre is not reported
STEP = 1e-4  # mm, for the slope of the angle field


@dataclass(frozen=True)
class TipInterference:
    """Deepest cut of one member's tip edge into the mate; mm, rad."""

    tip_of: str  # "pinion" or "wheel"
    into: str  # the flank that is cut into
    depth: float  # normal penetration, 0 if clear
    cone_distance: float  # where, on the mate
    height: float
    pinion_angle: float

    @property
    def found(self) -> bool:
        return self.depth > NOTICEABLE


def tip_interference(contact: UnloadedContact, columns: int = 61) -> tuple[TipInterference, ...]:
    """The deepest cut of either tip edge into the mating tooth, over the whole passage."""
    n = contact.sampling.positions_per_pitch
    lead = contact.envelope[:n][(np.arange(len(contact.phi)) - contact.cycle[0]) % n]
    mount = contact.mount
    total = lead + mount.wheel_zero + mount.ratio * contact.phi
    return tuple(
        _deepest(contact, tip_of, np.asarray(mount.sense * total), columns)
        for tip_of in ("pinion", "wheel")
    )


def _deepest(contact: UnloadedContact, tip_of: str, turn: Array, columns: int) -> TipInterference:
    pinion, wheel = contact.pinion_flank, contact.wheel_flank
    own, mate = (pinion, wheel) if tip_of == "pinion" else (wheel, pinion)
    face = np.linspace(own.toe, own.heel, columns)
    top = own.cut_pieces[0]
    s, theta, _ = own.parameters(face, own.tip.at(face), top)
    edge, _ = own.at_cutter(s, theta, top)
    m = len(contact.phi)
    tip = np.tile(edge, (m, 1))
    if own.mirrored:
        tip[:, 1] *= -1.0
    turn = np.where(np.isfinite(turn), turn, np.nan)  # where the flanks never meet
    phi, turned = np.repeat(contact.phi, columns), np.repeat(turn, columns)
    # ``turned`` is how far the wheel has turned back, seen as a left-hand member
    if tip_of == "pinion":
        seen = np.array(to_wheel(contact.mount, phi, tuple(tip.T))).T
        seen = _turn(seen, turned)
    else:
        seen = to_pinion(contact.mount, phi, _turn(tip, -turned))
    z, rho = seen[:, 2], np.hypot(seen[:, 0], seen[:, 1])
    distance, height = mate.cone.cone_distance_height(z, rho)
    near = (distance >= mate.toe) & (distance <= mate.heel)
    # the cut can only lie below the fillet limit, and shows a little above it at most
    limit = np.asarray(angle_field(mate).lowest.bounds(distance)[0])
    near &= (height >= mate.root.at(distance)) & (height <= limit + REACH)
    index = np.flatnonzero(near & np.isfinite(z))
    s, h = distance[index], height[index]
    angle = mate.chart_angle(s, h)
    along = (mate.chart_angle(s + STEP, h) - mate.chart_angle(s - STEP, h)) / (2.0 * STEP)
    across = (mate.chart_angle(s, h + STEP) - mate.chart_angle(s, h - STEP)) / (2.0 * STEP)
    # arc length about the axis to normal distance: the tangential part of the unit normal
    lever = rho[index] / np.sqrt(1.0 + rho[index] ** 2 * (along**2 + across**2))
    outward = -1.0 if mate.side == "concave" else 1.0
    apart = np.arctan2(seen[index, 1], seen[index, 0]) - angle
    apart = (apart + np.pi) % (2.0 * np.pi) - np.pi
    mine = np.abs(apart) < np.pi / contact.pair_teeth(mate.member) / 2.0
    gap = np.where(mine, apart * lever * outward, np.inf)
    if not len(gap) or not np.isfinite(gap).any():
        return TipInterference(tip_of, mate.name, 0.0, np.nan, np.nan, np.nan)
    worst = int(gap.argmin())
    place = index[worst]
    return TipInterference(
        tip_of,
        mate.name,
        max(0.0, float(-gap[worst])),
        float(distance[place]),
        float(height[place]),
        float(phi[place]),
    )


def _turn(points: Array, angle: Array) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    x, y = points[:, 0], points[:, 1]
    return np.stack([c * x - s * y, s * x + c * y, points[:, 2]], axis=-1)
