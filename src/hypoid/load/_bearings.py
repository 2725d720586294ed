"""Shafts and bearings: how a member moves as a whole under the contact's wrench, and what that does to the mounting.

Everything in the bearings' frame of `hypoid.design.bearing_compliance`, of the pair's own hand: x in the plane of both
axes' directions, y along their common perpendicular, z along the member's axis, about the crossing point. A wrench is
three forces (N) and three moments (N mm), a motion three displacements (mm) and three turns (rad).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from hypoid.contact import Misalignment, Mounting
from hypoid.design import STIFFNESS_EXAMPLE, STIFFNESS_EXPECTED, bearing_compliance
from hypoid.geometry import DesignError, Problem
from hypoid.pair import GearPair

Array = np.ndarray[Any, Any]
NAMES: tuple[Literal["pinion", "wheel"], ...] = ("pinion", "wheel")
MIRROR = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Bearings:
    """Compliance (6, 6) of both members' shafts with their bearings; zero where they are rigid."""

    pinion: Array
    wheel: Array

    @property
    def rigid(self) -> bool:
        return not (self.pinion.any() or self.wheel.any())


RIGID = Bearings(np.zeros((6, 6)), np.zeros((6, 6)))


def bearings_of(pair: GearPair) -> Bearings:
    """What the design gives; DesignError for a stiffness that holds no member."""
    made: dict[str, Array] = {}
    problems: list[Problem] = []
    for name in NAMES:
        given = getattr(pair, name).bearing_stiffness
        try:
            made[name] = np.zeros((6, 6)) if given is None else bearing_compliance(given)
        except ValueError as error:
            expected = f"{STIFFNESS_EXPECTED}; this is {error}"
            example = f"stiffness = {STIFFNESS_EXAMPLE}"
            problems.append(Problem(f"{name}.support.stiffness", "a matrix", expected, example))
    if problems:
        raise DesignError(problems)
    return Bearings(**made)


def wrenches(mount: Mounting, mirrored: bool, point: Array, normal: Array) -> tuple[Array, Array]:
    """Wrenches (n, 6) on pinion and wheel of unit forces along normals (n, 3) out of the pinion at points (n, 3) in G.

    `mirrored` tells whether the pair is the mirror image of the canonical one (left-hand pinion).
    """
    axes, shift = _frame(mount)
    # the pinion's frame is a true one for a left-hand pinion, G then is a mirror image of the wheel's
    on_pinion = _wrench((point - shift) @ axes, -normal @ axes, 1.0 - 2.0 * mirrored)
    return on_pinion, _wrench(point * MIRROR, normal * MIRROR, 1.0 - 2.0 * mirrored)


def _frame(mount: Mounting) -> tuple[Array, Array]:
    axes = np.array([[float(c) for c in row] for row in mount.axes])
    return axes, np.array([float(c) for c in mount.shift])


def _wrench(point: Array, force: Array, hand: float) -> Array:
    turn = np.array([1.0, hand, 1.0])
    point, force = point * turn, force * turn
    return np.concatenate([force, np.cross(point, force)], axis=1)


def moved_mounting(mount: Mounting, mirrored: bool, pinion: Array, wheel: Array) -> Misalignment:
    """Errors of mounting, beyond those it has, that motions (6,) of both members amount to.

    Exact for the lines that both axes have moved to: where their common perpendicular then stands, how long it is and
    at what angle they cross. Turns about a member's own axis change no mounting.
    """
    axes, shift = _frame(mount)
    turn = np.array([1.0, 1.0 - 2.0 * mirrored, 1.0])
    lines: list[tuple[Array, Array]] = []
    for motion, wheel_like in ((pinion, False), (wheel, True)):
        moved, angle = motion[:3] * turn, motion[3:] * turn * (1.0 - 2.0 * mirrored)
        way = np.array([0.0, 0.0, 1.0]) + np.cross(angle, [0.0, 0.0, 1.0])
        way /= np.linalg.norm(way)
        if wheel_like:
            lines.append((moved * MIRROR, way * MIRROR))
        else:
            lines.append((shift + axes @ moved, axes @ way))
    (a, u), (b, v) = lines
    apart, both = a - b, float(u @ v)
    # feet a + s u and b + t v of the common perpendicular
    s, t = np.linalg.solve([[1.0, -both], [both, -1.0]], [-apart @ u, -apart @ v])
    across = apart + s * u - t * v
    length = float(np.linalg.norm(across)) * (1.0 if across[1] <= 0.0 else -1.0)
    withdrawn = shift[0] / axes[0, 2]
    return Misalignment(
        offset=length + float(shift[1]),
        pinion_axial=-float(s) - float(withdrawn),
        wheel_axial=-float(t) - float(withdrawn * axes[2, 2] - shift[2]),
        shaft_angle=float(np.arccos(both)) - float(np.arccos(axes[2, 2])),
    )
