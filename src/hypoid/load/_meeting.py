"""Where a tooth pair touches first at a position, and how its surfaces are seen from there.

All in the contact's frame G (left-hand wheel frame, see `hypoid.contact`), mm.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from hypoid.contact import UnloadedContact, to_pinion, to_wheel
from hypoid.flank import Flank

from ._surface import Surface, rows_on
from ._tips import active_field

Array = np.ndarray[Any, Any]
STENCIL, REACH = 9, 0.1  # points each way, odd, and whole depths: for the curvature at first touch
STRAIGHT = 2e-5  # 1/mm: the least relative curvature that a first patch counts with


@dataclass(frozen=True, eq=False)
class Meeting:
    """One tooth pair at one position: where it touches first, and how surfaces are read there."""

    contact: UnloadedContact
    pair: int  # k: this pair stands k pitches behind pair 0
    phi: float  # pinion angle of this pair's own passage, rad
    lead: float  # where the wheel stands: its rigid lead, rad
    origin: Array  # (3,)
    axes: Array  # (3, 3) rows: along the contact, across, pinion's outward normal
    curvature: tuple[float, float]  # 1/mm, along and across, of the gap
    gap: float  # mm, least
    lever: float  # of the pinion there, mm

    @cached_property
    def frame(self) -> tuple[Array, Array]:
        """Origin (3,) and axes (3, 3) in the pinion's frame."""
        points = np.vstack([self.origin, self.origin + self.axes])
        zero, *ends = to_pinion(self.contact.mount, np.full(4, self.phi), points)
        return zero, np.array(ends) - zero

    @property
    def depth(self) -> float:
        """Whole depth of the pinion's tooth at its heel, mm."""
        flank = self.contact.pinion_flank
        return float(flank.tip.at(flank.heel) - flank.root.at(flank.heel))

    @property
    def flanks(self) -> tuple[Flank, Flank]:
        """Of pinion and wheel."""
        return self.contact.pinion_flank, self.contact.wheel_flank

    def surface(self, a: Array, b: Array) -> Surface:
        """The pinion's points on rays at (a, b), mm, of the tangent plane."""
        pair, stand = self.contact.pair, (self.phi, self.lead, self.depth)
        fields = (
            active_field(flank, member.tip_rounding)
            for flank, member in zip(self.flanks, (pair.pinion, pair.wheel), strict=True)
        )
        return Surface(rows_on(self.contact.mount, *fields, stand, *self.frame, a, b))

    def bodily(self, seen: Surface, member: int) -> tuple[Array, Array]:
        """Points and outward normals, (n, 3) each, of a member (0 pinion, 1 wheel) in its own left-hand frame."""
        if member:
            return seen.point, -seen.normal
        zero, axes = self.frame
        turn = self.axes.T @ axes
        return zero + (seen.point - self.origin) @ turn, seen.normal @ turn


def meeting(contact: UnloadedContact, position: int, pair: int) -> Meeting | None:
    """Where pair k touches first at a position (index into `contact.phi`), None where its flanks do not face."""
    n = contact.sampling.positions_per_pitch
    own = position - pair * n
    if not 0 <= own < len(contact.phi) or not np.isfinite(contact.curve[own]):
        return None
    phi = float(contact.phi[own])
    node = int(contact.leads[own].argmax())
    at, normal = contact.nodes.point[:, node], contact.nodes.normal[:, node]
    if contact.interior[own]:
        flank = contact.pinion_flank
        found = flank.at_cutter(contact.points.s1[[own]], contact.points.theta1[[own]])
        at, normal = (v[0] * flank.hand for v in found)
    origin = np.array(to_wheel(contact.mount, phi, tuple(at)), dtype=float)
    out = np.array(to_wheel(contact.mount, phi, tuple(normal), free=True), dtype=float)
    rigid = contact.curve[position - n * np.arange(-_half(contact), _half(contact) + 1)].max()
    first = np.cross(out, (0.0, 0.0, 1.0))
    first /= np.linalg.norm(first)
    axes = np.array([first, np.cross(out, first), out])
    rough = Meeting(contact, pair, phi, float(rigid), origin, axes, (STRAIGHT, STRAIGHT), 0.0, 0.0)
    turn, curvature, (lever, wheel_lever) = _curvature(rough)
    gap = (float(rigid) - float(contact.curve[own])) * wheel_lever
    c, s = np.cos(turn), np.sin(turn)
    if c * axes[0, 2] + s * axes[1, 2] < 0.0:  # always the same way, as the positions go on
        c, s = -c, -s
    axes = np.array([c * axes[0] + s * axes[1], c * axes[1] - s * axes[0], out])
    return Meeting(contact, pair, phi, float(rigid), origin, axes, curvature, gap, lever)


def _half(contact: UnloadedContact) -> int:
    return contact.sampling.pairs // 2


def _curvature(rough: Meeting) -> tuple[float, tuple[float, float], tuple[float, float]]:
    """Direction of the gap's least curvature in the tangent plane, rad, both curvatures, 1/mm, and levers, mm."""
    spread = REACH * rough.depth * np.linspace(-1.0, 1.0, STENCIL)
    a, b = (v.ravel() for v in np.meshgrid(spread, spread))
    turn, curvature = 0.0, (STRAIGHT, 1e-2)
    for wider in (1.0, 3.0):
        x, y = wider * a, wider * b
        seen = rough.surface(x, y)
        lever, wheel_lever = (float(v[len(a) // 2]) for v in seen.levers)
        there = np.isfinite(seen.gap)
        if there.sum() >= 2 * STENCIL:
            terms = np.stack([np.ones_like(x), x, y, 0.5 * x * x, x * y, 0.5 * y * y], axis=1)
            fit, *_ = np.linalg.lstsq(terms[there], seen.gap[there], rcond=None)
            values, vectors = np.linalg.eigh([[fit[3], fit[4]], [fit[4], fit[5]]])
            low, high = (max(float(v), STRAIGHT) for v in values)
            turn = float(np.arctan2(vectors[1, 0], vectors[0, 0]))
            curvature = (low, max(high, low))
            break
    return turn, curvature, (lever, wheel_lever)
