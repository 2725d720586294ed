"""Largest edge radii of the blades: AGMA 929-B22, clause 4.6, at the toe, where they are least."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, cos, sin, sqrt, tan

from ._slots import Process, SlotGeometry


@dataclass(frozen=True)
class EdgeRadii:
    """Largest edge radii of one member's blades, mm; the least of the three holds (98), (99)."""

    no_interference: float  # r_a01: the mate's tip stays off the fillet
    manufacture: float  # r_a02: fits the blade point with its flat
    no_mutilation: float  # r_a03: does not touch the other side

    @property
    def largest(self) -> float:
        """r_a0max, mm."""
        return min(self.no_interference, self.manufacture, self.no_mutilation)


def edge_radii(
    slots: SlotGeometry,
    *,
    process: Process = "completing",
    stock: tuple[float, float] = (0.0, 0.0),
    flat: float = 0.2,
    mutilation: float = 0.05,
) -> tuple[EdgeRadii, EdgeRadii]:
    """Largest edge radii of pinion and wheel, mm.

    ``flat`` is the least flat at a blade's tip (Delta_f), ``mutilation`` how far a blade may touch the
    other side of its slot (y), both mm.
    """
    points, running = slots.blade_points(process, stock), _no_interference(slots)
    found: list[EdgeRadii] = []
    for i in (0, 1):
        least = min(slots.slots[i])
        made, free = [], []
        for angle in slots.pressure_angles:
            lean = (1.0 - sin(angle)) / cos(angle)
            made.append(max((points[i] - flat) / lean, 0.0))  # (144)-(147)
            room = (least - points[i]) * lean
            root = sqrt(max(mutilation**2 + 2.0 * mutilation * room, 0.0))  # (154)-(157)
            free.append((mutilation + room + root) / lean**2)  # (158)-(161)
        found.append(EdgeRadii(min(running[i]), min(made), min(free)))
    return found[0], found[1]


def _no_interference(slots: SlotGeometry) -> tuple[list[float], list[float]]:
    """By pressure angle, pinion and wheel, mm (100)-(131)."""
    toes, inner = slots.ends, slots.inner_cone_distances
    crown1, crown2 = toes[0][0], toes[1][0]
    b1, b2 = slots.pinion_spiral(crown1), slots.tooth.spiral_angle(crown2)
    r1 = inner[0] * tan(slots.pitch_angles[0]) / cos(b1) ** 2
    r2 = inner[1] * tan(slots.pitch_angles[1]) / cos(b2) ** 2
    f1 = slots.pinion_dedendum(crown1)
    f2 = slots.wheel_dedendum(crown2)
    change1, change2 = _clearance_changes(slots, b1, b2)
    (z1, z2), (d1, d2) = slots.teeth, slots.pitch_angles
    share = z1 * cos(d2) / (z1 * cos(d2) + z2 * cos(d1))
    a1, a2 = r1 - change2 * share, r2 - change1 * (1.0 - share)
    tip1, tip2 = r1 + f2 - slots.clearance, r2 + f1 - slots.clearance
    pinion: list[float] = []
    wheel: list[float] = []
    for angle in slots.pressure_angles:
        base1, base2 = r1 * cos(angle), r2 * cos(angle)
        at = acos(base1 / a1)
        line = (a1 + a2) * sin(at)
        lowest1 = line - sqrt(tip2**2 - base2**2)  # profile radius that the mate's tip reaches
        lowest2 = line - sqrt(tip1**2 - base1**2)
        height1 = base1 * cos(angle) + lowest1 * sin(angle) - r1 + f1
        height2 = base2 * cos(angle) + lowest2 * sin(angle) - r2 + f2
        if not slots.wheel_generated:
            height1 = slots.clearance - change1
        pinion.append(height1 / (1.0 - sin(angle)))
        wheel.append(height2 / (1.0 - sin(angle)))
    return pinion, wheel


def _clearance_changes(slots: SlotGeometry, b1: float, b2: float) -> tuple[float, float]:
    """How much nearer the members may be moved before their backlash is used up, mm (52), (53)."""
    outer1 = slots.outer_cone_distances[0]
    end1 = outer1 * cos(slots.pinion_spiral(slots.crown(outer1)))
    inner = slots.inner_cone_distances
    sines = sum(sin(angle) for angle in slots.pressure_angles)
    change1 = slots.backlash * inner[0] * cos(b1) / end1 / sines
    change2 = slots.backlash * slots.share(inner[1], slots.outer_cone_distances[1]) / sines
    return change1, change2
