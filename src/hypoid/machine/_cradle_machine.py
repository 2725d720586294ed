"""What the cradle machines of both papers share: the work's side, and the way to the program's frames.

Both papers stand their work on the x axis and write one machine for both hands: cradle angle zeta
turns by Rz(-zeta), the blank offset is positive "up" whatever the hand [tsay1993, (17)-(20);
lin1996, (23)]. Against the generator chain:

* the member's axis goes from x to z by the fixed turn A = Ry(-90 deg);
* then the machine's motion is the mirror image (y -> -y) of the chain's: it is the right-hand
  member as it stands, with phi = zeta, and E_m = E_v. So ``A . machine = S . chain . S``, S the mirror;
* a left-hand member's machine runs mirrored: ``A . machine = chain`` with phi = -zeta, E_m = -E_v, and the
  cradle angle, swivel and cam guide angle with their signs turned. Tilt, root angle, machine centre
  to back, sliding base and ratio of roll are alike for both hands.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.geometry import DesignError, Problem

from ._change_gears import nearest_gears, reach
from ._dials import Hand, shown
from ._settings import MachineSettings

Matrix = np.ndarray[Any, Any]
MIRROR: Matrix = np.diag([1.0, -1.0, 1.0, 1.0])


@dataclass(frozen=True)
class Workpiece:
    """What a machine must know of the member besides its dials."""

    teeth: int
    hand: Hand
    constants: Any = None  # of the machine, where they are not its usual ones
    path: str = "settings"  # where the settings stand in the design file, for errors

    def __post_init__(self) -> None:
        found: list[Problem] = []
        if self.teeth < 1:
            found.append(Problem(f"{self.path}: teeth", str(self.teeth), "at least 1", "6"))
        if self.hand not in ("left", "right"):
            found.append(Problem(f"{self.path}: hand", self.hand, "left or right", "right"))
        if found:
            raise DesignError(found)

    @property
    def sign(self) -> int:
        """1 for a right-hand member, -1 for a left-hand one: phi = sign * zeta."""
        return 1 if self.hand == "right" else -1


def turn(axis: int, angle: float) -> Matrix:
    """Right-handed turn of points about an axis (0, 1, 2 for x, y, z), 4 x 4."""
    m, c, s = np.eye(4), math.cos(angle), math.sin(angle)
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    m[a, a] = m[b, b] = c
    m[a, b], m[b, a] = -s, s
    return m


def work_side(
    root_angle: float, offset: float, base: float, back: float, zeta: float, xi: float
) -> Matrix:
    """Cradle to work, equation by equation; the work's axis is x, its origin the crossing point.

    [tsay1993, (17)-(20) with PAB = 0; lin1996, M65 M53 M32 of (23), sign of M53(3, 4) corrected].
    """
    c, s = math.cos(zeta), math.sin(zeta)
    cradle = np.array([[c, s, 0, 0], [-s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    c, s = math.cos(root_angle), math.sin(root_angle)
    head = np.array(
        [[c, 0, s, -base * s], [0, 1, 0, -offset], [-s, 0, c, -base * c], [0, 0, 0, 1.0]]
    )
    slide = np.array([[1, 0, 0, -back], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    c, s = math.cos(xi), math.sin(xi)
    spindle = np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1.0]])
    return spindle @ slide @ head @ cradle


def to_chain_frames(machine: Matrix, hand: Hand) -> Matrix:
    """A machine's motion (cutter to work) in the frames of `chain`: axis on z, as a left-hand member."""
    upright = turn(1, -math.pi / 2) @ machine
    return upright if hand == "left" else MIRROR @ upright @ MIRROR


def eccentric_of(
    settings: MachineSettings, constant: float, path: str
) -> tuple[float, list[Problem]]:
    """Eccentric angle, rad, for a radial distance S_r = 2 e sin(angle/2), or why there is none."""
    radial = settings.radial_distance
    if 0.0 <= radial <= 2.0 * constant * (1.0 + 1e-12):
        return 2.0 * math.asin(min(1.0, radial / (2.0 * constant))), []
    expected = f"a radial distance from 0 mm to {shown(2.0 * constant, 'length')}"
    expected += f" (twice the eccentric of {shown(constant, 'length')})"
    given = shown(radial, "length")
    return 0.0, [Problem(f"{path}.radial_distance", given, expected, shown(constant, "length"))]


def gears_of(
    ratio: float, what: str, path: str, example: str
) -> tuple[tuple[int, ...], list[Problem]]:
    """Change gears nearest to a ratio, or why there are none."""
    low, high = reach()
    if not (math.isfinite(ratio) and low <= ratio <= high):
        expected = f"{what} whose change gears give a ratio from {low:.4f} to {high:.4f}"
        return (), [Problem(path, f"a ratio of {ratio:.6g}", expected, example)]
    return nearest_gears(ratio).teeth, []


def beyond(settings: MachineSettings, able: frozenset[str], name: str, path: str) -> list[Problem]:
    """What basic settings ask for that a machine cannot do, by the settings' names."""
    asked = {
        "roll_to_blade_ratio": settings.roll_to_blade_ratio,
        "tilt_angle": settings.tilt_angle,
        "helical_motion": settings.helical_motion,
        "modified_roll": tuple(settings.modified_roll) if any(settings.modified_roll) else (),
        "cutter_lead": settings.cutter_lead,
        "cam": settings.cam,
        "generated": "" if settings.generated else "a form cut",
        **{f"motions.{m}": getattr(settings.motions, m) for m in settings.motions.moved()},
    }
    return [
        Problem(f"{path}.{key}", str(value), f"none: the {name} has no such motion", "leave it out")
        for key, value in asked.items()
        if value and key not in able
    ]
