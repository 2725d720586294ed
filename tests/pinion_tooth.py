"""A pinion tooth in contact with a rigid wheel, by the method and by fine elements.

One tooth, cuts free, bore held; the wheel stands where the unloaded contact puts it, and gaps are those of the exact
surfaces for both. The reference has no half-space in it, see `overlaid`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from overlaid import Block, Overlaid, Tooth, block, tooth

from hypoid.contact import Sampling, unloaded_contact
from hypoid.load import STEEL, Elements, Material, ToothCompliance, solve_contact
from hypoid.load._hats import Hats
from hypoid.load._meeting import Meeting, meeting
from hypoid.load._patch import greatest
from hypoid.load._position import Teeth, position_contact
from hypoid.pair import GearPair

Array = np.ndarray[Any, Any]
STEP = 2  # position beyond pinion angle 0, 40 a pitch: the contact stands clear of both tips
BESIDE, ZONE = 0.3, 2.4  # mm of S: middle of the contact, and half of where sections are close
RIDGE = 0.9  # mm: over less the reference's pressure swings, where the tooth's own elements meet


@dataclass(frozen=True)
class Fineness:
    """Elements of a reference."""

    sections: int  # of the tooth within the zone
    profile: int
    through: int
    along: float  # mm, of the block's elements in the contact
    across: float
    beside: float = 0.65  # mm, half of the block's width


COARSE = Fineness(10, 8, 4, 0.4, 0.033)
FINE = Fineness(18, 12, 6, 0.3, 0.026)


@dataclass(frozen=True, eq=False)
class Answer:
    """What is compared: line loads are means over the parts between `ends`."""

    rotation: float  # rad
    peak: float  # MPa, at one node or cell
    ridge: float  # MPa, the greatest across the contact, over `RIDGE` of its length
    line: Array  # N/mm


def drive_meeting(pair: GearPair, step: int = STEP) -> Meeting:
    """Pair 0 a little beyond pinion angle 0."""
    contact = unloaded_contact(pair, "drive", None, Sampling(positions_per_pitch=40, pairs=9))
    met = meeting(contact, len(contact.phi) // 2 + step, 0)
    assert met is not None
    return met


def spread(first: float, low: float, high: float, last: float, size: float, growth: float) -> Array:
    """Even steps of about `size` from low to high, growing beyond, to first and last."""
    even = np.linspace(low, high, max(1, round((high - low) / size)) + 1)

    def beyond(reach: float) -> Array:
        at, step = [0.0], even[1] - even[0]
        while reach - at[-1] > 1e-9:
            step *= growth
            left = reach - at[-1]
            at.append(reach if left < 1.6 * step else at[-1] + step)
        return np.array(at[1:])

    return np.concatenate([low - beyond(low - first)[::-1], even, high + beyond(last - high)])


def fine_tooth(pair: GearPair, met: Meeting, fine: Fineness) -> Tooth:
    """The whole tooth, its sections close where the contact is."""
    flank = met.contact.pinion_flank
    middle = float(met.surface(np.zeros(1), np.zeros(1)).pinion_place[0][0]) - BESIDE
    size = 2.0 * ZONE / fine.sections
    ends = spread(flank.toe, middle - ZONE, middle + ZONE, flank.heel, size, 1.4)
    sizes = Elements(profile=fine.profile, fillet=4, through=fine.through, below=2, rim=4)
    return tooth(pair.pinion, flank.side, sizes, ends)


def fine_block(met: Meeting, span: Array, fine: Fineness) -> tuple[Block, Array]:
    """The block for a contact between span[0] and span[1] (2,) in the tangent plane, and the hats that may bear."""
    low, high = span[0, 0] - 0.15, span[1, 0] + 0.15
    half = fine.across * np.ceil(1.3 * np.abs(span[:, 1]).max() / fine.across)
    made = block(
        met,
        spread(low - 0.5, low, high, high + 0.5, fine.along, 1.5),
        spread(-fine.beside, -half, half, fine.beside, fine.across, 1.6),
        spread(0.0, 0.0, 2.0 * fine.across, 1.0, fine.across, 1.7),
    )
    on = (made.a > low - 1e-9) & (made.a < high + 1e-9) & (np.abs(made.b) < half + 1e-9)
    return made, np.flatnonzero(on)


def ours(met: Meeting, own: Tooth) -> Teeth:
    """The method's compliance of one tooth alone, against a rigid wheel."""
    side, mate = met.contact.pinion_flank.side, met.contact.wheel_flank
    nothing: dict[str, Any] = {
        "stress": {},
        "fillet_points": np.zeros((0, 3)),
        "fillet_side": np.zeros(0),
    }
    half_space = own.hats.half_space / (np.pi * STEEL.plane_modulus)
    one = ToothCompliance(
        "pinion", side, 1, STEEL, own.hats.hats, {0: own.by_hats}, half_space, **nothing
    )
    wide = Hats(np.array([mate.toe, mate.heel]), np.array([[-9.0, 9.0], [-9.0, 9.0]]))
    zero = np.zeros((4, 4))
    rigid = ToothCompliance("wheel", mate.side, 1, Material(1e15), wide, {0: zero}, zero, **nothing)
    return Teeth(one, rigid, round(float(met.contact.mount.sense)))


def reach(met: Meeting, teeth: Teeth, torque: float) -> Array:
    """Where the contact begins and ends, (2, 2) mm along and across, under a torque, N mm."""
    found = position_contact([met], teeth, torque)
    plane = found.patches[0].plane[found.solution.touching]
    return np.array([plane.min(axis=0), plane.max(axis=0)])


def by_method(met: Meeting, teeth: Teeth, torque: float, ends: Array) -> Answer:
    """The method's answer under a torque, N mm."""
    found = position_contact([met], teeth, torque)
    (p,) = found.patches
    force = found.solution.force
    columns = np.zeros(p.on.shape)
    columns[p.on] = force
    sides = np.linspace(*p.window.along, p.on.shape[0] + 1)
    total = np.append(0.0, np.cumsum(columns.sum(axis=1)))
    line = np.diff(np.interp(ends, sides, total)) / np.diff(ends)
    peak = greatest(p, force / p.area, np.ones(p.count, dtype=bool))
    pressure = np.zeros(p.on.shape)
    pressure[p.on] = force / p.area
    ridge = _ridge(0.5 * (sides[1:] + sides[:-1]), pressure.max(axis=1))
    return Answer(found.solution.rotation, peak, ridge, line)


def _ridge(along: Array, tops: Array) -> float:
    """Greatest mean of the pressures `tops` at places `along`, mm, over `RIDGE`."""
    x = np.linspace(along[0], along[-1], 2001)
    count = max(1, round(RIDGE / (x[1] - x[0])))
    return float(np.convolve(np.interp(x, along, tops), np.full(count, 1.0 / count), "valid").max())


def by_elements(fine: Overlaid, torque: float, ends: Array) -> Answer:
    """The reference's answer: line load is straight between its hats."""
    found = solve_contact(fine.compliance, fine.gap, fine.lever, torque)
    rows = np.unique(fine.a)
    line = np.array([found.force[fine.a == a].sum() for a in rows]) / np.gradient(rows)
    count = 400
    x = np.linspace(ends[0], ends[-1], count * (len(ends) - 1) + 1)
    y = np.interp(x, rows, line)
    means = (0.5 * (y[1:] + y[:-1])).reshape(-1, count).mean(axis=1)
    pressure = found.force / fine.area
    tops = np.array([pressure[fine.a == a].max() for a in rows])
    return Answer(found.rotation, float(tops.max()), _ridge(rows, tops), means)
