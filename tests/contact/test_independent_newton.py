"""The refined contact against seven plain equations: position, normals and both meshing conditions.

Nothing of the package's kinematics is used: the chain motion by motion, derivatives by complex
steps, the mounting written out, SciPy's root finder.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, radians, sin
from typing import Any

import numpy as np
import pytest
from independent import carried
from scipy.optimize import root

from hypoid.contact import Misalignment, Sampling, UnloadedContact, unloaded_contact
from hypoid.cutter import EdgePiece
from hypoid.flank import Flank
from hypoid.pair import Direction, GearPair

ARCSEC = pi / 180 / 3600
MISALIGNMENTS = [
    Misalignment(),
    *(Misalignment(**{name: sign * 0.05}) for name in ("offset", "pinion_axial", "wheel_axial") for sign in (-1, 1)),
    Misalignment(shaft_angle=radians(0.03)),
    Misalignment(0.02, -0.03, 0.04, radians(-0.02)),
]  # fmt: skip


@dataclass(frozen=True)
class PlainSurface:
    """A flank by its edge piece and plain motions, left hand."""

    flank: Flank

    def point(self, s: Any, theta: Any, phi: Any) -> np.ndarray:
        return np.array(carried(self.flank.settings, self._edge(s), theta, phi))

    def contact_data(
        self, s: float, theta: float, phi: float
    ) -> tuple[np.ndarray, np.ndarray, float]:
        """Point, unit normal and meshing condition; derivatives by complex steps."""
        at = np.array([s, theta, phi], dtype=complex)
        by_s, by_theta, by_phi = (
            self.point(*(at + 1e-30j * np.eye(3)[k])).imag / 1e-30 for k in range(3)
        )
        normal = np.cross(by_s, by_theta)
        normal /= np.linalg.norm(normal)
        return self.point(*at).real, normal, float(normal @ by_phi)

    def _edge(self, s: Any) -> np.ndarray:
        piece: EdgePiece = self.flank.pieces["flank"]
        beyond = s - piece.relief_from if s.real > piece.relief_from else 0.0
        rise = piece.relief * beyond**2
        start, along, out = (np.array(v) for v in (piece.start, piece.tangent, piece.metal))
        return start + s * along + rise * out


def mounted(pair: GearPair, direction: Direction, error: Misalignment, phi: float, lead: float):
    """Pinion and wheel frames carried to frame G of the canonical pair, written out."""
    sense = 1.0 if direction == "drive" else -1.0
    cones = pair.blank.cones
    sigma = cones.shaft_angle + error.shaft_angle
    axis = np.array([sin(sigma), 0.0, cos(sigma)])
    x1 = np.array([-cos(sigma), 0.0, sin(sigma)])
    frame = np.array([x1, np.cross(axis, x1), axis]).T
    foot = np.array([0.0, cones.offset + error.offset, 0.0]) + error.pinion_axial * axis
    # mean points of the two sides of a tooth are half a pitch apart
    half = 0.0 if direction == "drive" else pi / pair.pinion.teeth
    half_wheel = pi / pair.wheel.teeth if direction == "drive" else 0.0
    turn = cones.pinion_azimuth - half - sense * phi
    turn_wheel = cones.wheel_azimuth + half_wheel + sense * (lead + pair.ratio * phi)

    def about_z(angle: float) -> np.ndarray:
        return np.array([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]])

    pinion = frame @ about_z(turn)
    wheel = about_z(turn_wheel) @ np.diag([1.0, -1.0, 1.0])  # a right-hand member
    return (pinion, foot), (wheel, np.array([0.0, 0.0, error.wheel_axial]))


def seven_equations(contact: UnloadedContact, index: int) -> tuple[float, np.ndarray]:
    """Lead and (s1, theta1) of the contact at one position, solved from a start some way off."""
    pinion, wheel = (PlainSurface(f) for f in contact.pair.mates(contact.direction))
    points, phi = contact.points, float(contact.phi[index])

    def equations(unknown: np.ndarray) -> np.ndarray:
        s1, t1, p1, s2, t2, p2, lead = unknown
        here, there = mounted(contact.pair, contact.direction, contact.misalignment, phi, lead)
        r1, n1, f1 = pinion.contact_data(s1, t1, p1)
        r2, n2, f2 = wheel.contact_data(s2, t2, p2)
        apart = here[0] @ r1 + here[1] - there[0] @ r2 - there[1]
        twist = np.cross(here[0] @ n1, there[0] @ n2)
        across = np.argsort(np.abs(here[0] @ n1))[:2]
        return np.array([*apart, *(10.0 * twist[across]), f1, f2])

    shift = np.array([0.05, 1e-3, 1e-3, 0.05, 1e-3, 1e-3, 1e-6])
    near = [points.s1, points.theta1, 0 * phi, points.s2, points.theta2, 0 * phi, points.lead]
    start = np.array([v[index] if np.ndim(v) else v for v in near]) + shift
    found = root(equations, start, method="hybr", options={"xtol": 1e-14})
    assert np.abs(found.fun).max() < 1e-9, found.message
    return float(found.x[6]), found.x[:2]


@pytest.mark.parametrize("direction", ["drive", "coast"])
@pytest.mark.parametrize("name", ["plain", "relief"])
def test_refined_contact_meets_seven_plain_equations(
    variant: Any, name: str, direction: Any
) -> None:
    """Lead to 3e-6 arcsec, place to 1e-6 mm, over nine misalignments (methods of contact)."""
    pair = variant(name)
    for error in MISALIGNMENTS:
        contact = unloaded_contact(pair, direction, error, Sampling(positions_per_pitch=10))
        path = contact.on_path
        index = int(path[len(path) // 2 + 1])
        lead, place = seven_equations(contact, index)
        assert abs(lead - contact.points.lead[index]) < 3e-6 * ARCSEC
        flank = contact.pinion_flank
        mine = flank.at_cutter([contact.points.s1[index]], [contact.points.theta1[index]])[0]
        theirs = flank.at_cutter([place[0]], [place[1]])[0]
        assert np.abs(mine - theirs).max() < 1e-6
