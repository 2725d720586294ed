"""Basic machine settings of one flank, how they move, and the generator chain, motion by motion.

The chain is that of the 2005 paper as corrected (errata 1-3 of its notes), for a left-hand member:
head -theta, tilt i about y, swivel j, cutter centre at (S_r cos q, -S_r sin q), cradle +phi, blank
offset +E_m, sliding base -dX_b, machine root angle, machine centre to back -dX_p, work turned by
R_b theta + W(phi). A right-hand member is the mirror image (y -> -y) with the same settings.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from ._cam import Cam, cam_roll

ORDERS = 6  # of the cradle angle, in every motion


@dataclass(frozen=True)
class Motions:
    """How settings move with the cradle angle phi: coefficients of phi, phi**2, ... phi**6.

    Each is what is added to the setting of that name, in mm/rad**n or rad/rad**n.
    """

    radial_distance: Sequence[float] = ()
    tilt_angle: Sequence[float] = ()
    swivel_angle: Sequence[float] = ()
    blank_offset: Sequence[float] = ()  # vertical motion
    machine_root_angle: Sequence[float] = ()
    machine_center_to_back: Sequence[float] = ()  # horizontal motion
    sliding_base: Sequence[float] = ()  # helical motion, beside `helical_motion`

    def moved(self) -> tuple[str, ...]:
        """The settings that move."""
        return tuple(f.name for f in fields(self) if any(getattr(self, f.name)))


NO_MOTIONS = Motions()


@dataclass(frozen=True)
class MachineSettings:
    """Basic settings of one flank; mm and rad, signs of the generator chain.

    The work turns by W(phi) = R_a (phi + c2 phi**2 + ... + c6 phi**6) with the cradle angle phi, or
    as a cam turns it, and the sliding base moves by h phi; ``modified_roll`` holds c2, c3, ... as
    far as they are wanted. ``machine_center_to_back`` counts from the crossing point.
    """

    radial_distance: float  # S_r
    cradle_angle: float  # q
    machine_root_angle: float  # gamma_m
    ratio_of_roll: float  # R_a
    roll_to_blade_ratio: float  # R_b, 0 for face milling
    tilt_angle: float = 0.0  # i
    swivel_angle: float = 0.0  # j
    blank_offset: float = 0.0  # E_m
    machine_center_to_back: float = 0.0  # dX_p
    sliding_base: float = 0.0  # dX_b
    helical_motion: float = 0.0  # h, mm/rad
    modified_roll: Sequence[float] = ()
    motions: Motions = NO_MOTIONS
    cam: Cam | None = None  # turns the work in place of ratio_of_roll and modified_roll
    generated: bool = True  # False: form cut (Formate, Helixform), the cradle stands at phi = 0
    cutter_lead: float = (
        0.0  # Helixform: advance along the cutter axis, mm/rad of the cutter's turn
    )

    @property
    def plain_roll(self) -> bool:
        """Whether the meshing condition is closed in phi: a plain roll and nothing else moving."""
        rolls = self.cam is not None or any(self.modified_roll)
        return not (rolls or self.helical_motion or self.cutter_lead or self.motions.moved())

    @property
    def sliding_motion(self) -> tuple[float, ...]:
        """Coefficients of phi, phi**2, ... by which the sliding base moves, mm/rad**n."""
        first, *more = [*self.motions.sliding_base, *[0.0] * ORDERS][:ORDERS]
        return (self.helical_motion + first, *more)


def chain(settings: MachineSettings, theta: float, phi: float) -> np.ndarray:
    """The 4 x 4 motion (cutter frame to the member's frame, left hand), matrix by matrix, mm.

    The plain reading of the corrected chain [vimercati2005, appendix A with errata 1 and 2]; the
    fast code is tested against it.
    """

    def turn(axis: int, angle: float) -> np.ndarray:
        c, s = np.cos(angle), np.sin(angle)
        m = np.eye(4)
        a, b = [(1, 2), (2, 0), (0, 1)][axis]
        m[a, a] = m[b, b] = c
        m[a, b], m[b, a] = -s, s
        return m

    def shift(x: float, y: float, z: float) -> np.ndarray:
        m = np.eye(4)
        m[:3, 3] = x, y, z
        return m

    phi = phi if settings.generated else 0.0

    def at(name: str) -> float:
        powers = enumerate(getattr(settings.motions, name), start=1)
        return getattr(settings, name) + sum(c * phi**n for n, c in powers)

    roll = sum(c * phi ** (n + 1) for n, c in enumerate([1.0, *settings.modified_roll]))
    work = settings.ratio_of_roll * roll
    if settings.cam is not None:
        work = float(cam_roll(settings.cam, np.float64(phi))[0])
    base = at("sliding_base") + settings.helical_motion * phi
    return (
        turn(2, -(settings.roll_to_blade_ratio * theta + work))
        @ shift(0.0, 0.0, -at("machine_center_to_back"))
        @ turn(1, -(np.pi / 2 - at("machine_root_angle")))
        @ shift(0.0, at("blank_offset"), -base)
        @ turn(2, phi)
        @ turn(2, np.pi / 2 - settings.cradle_angle)
        @ shift(0.0, -at("radial_distance"), 0.0)
        @ turn(2, at("swivel_angle"))
        @ turn(1, at("tilt_angle"))
        @ shift(0.0, 0.0, settings.cutter_lead * theta)
        @ turn(2, -theta)
    )
