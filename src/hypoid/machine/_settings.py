"""Basic machine settings of one flank, and the generator they define.

The chain is that of the 2005 paper as corrected (errata 1-3 of its notes), for a left-hand member:
head -theta, tilt i about y, swivel j, cutter centre at (S_r cos q, -S_r sin q), cradle +phi, blank
offset +E_m, sliding base -dX_b, machine root angle, machine centre to back -dX_p, work turned by
R_b theta + W(phi). A right-hand member is the mirror image (y -> -y) with the same settings.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.geometry import Batch, Scalar, Vector

ROLL_ORDERS = 5  # modified roll: orders 2 to 6


@dataclass(frozen=True)
class MachineSettings:
    """Basic settings of one flank; mm and rad, signs of the generator chain.

    The work turns by W(phi) = R_a (phi + c2 phi**2 + ... + c6 phi**6) with the cradle angle phi and
    the sliding base moves by h phi; ``modified_roll`` holds c2, c3, ... as far as they are wanted.
    ``machine_center_to_back`` counts from the crossing point.
    """

    radial_distance: float  # S_r
    cradle_angle: float  # q
    machine_root_angle: float  # gamma_m
    ratio_of_roll: float  # R_a
    roll_to_blade_ratio: float  # R_b
    tilt_angle: float = 0.0  # i
    swivel_angle: float = 0.0  # j
    blank_offset: float = 0.0  # E_m
    machine_center_to_back: float = 0.0  # dX_p
    sliding_base: float = 0.0  # dX_b
    helical_motion: float = 0.0  # h, mm/rad
    modified_roll: Sequence[float] = ()

    @property
    def constant_motion(self) -> bool:
        """Whether the meshing condition is closed in phi: a plain roll and nothing else moving."""
        return self.helical_motion == 0.0 and not any(self.modified_roll)


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Generator:
    """What the kinematics of one flank needs of its settings: a tree of numbers, all traced."""

    centre: Vector  # cutter centre in the cradle frame, mm
    head: tuple[Vector, Vector, Vector]  # rows: rotation from the cutter frame to the cradle frame
    blank_offset: Scalar
    sliding_base: Scalar
    helical_motion: Scalar
    root_sine: Scalar
    root_cosine: Scalar
    machine_center_to_back: Scalar
    roll: Batch  # W as powers: R_a, R_a c2, ..., R_a c6
    blade_ratio: Scalar  # R_b


def generator(settings: MachineSettings) -> Generator:
    """The generator of a flank from its basic settings (any of which may be traced)."""
    q, i, j = settings.cradle_angle, settings.tilt_angle, settings.swivel_angle
    turn = jnp.pi / 2 - q + j
    ct, st, ci, si = jnp.cos(turn), jnp.sin(turn), jnp.cos(i), jnp.sin(i)
    zero = 0.0 * ct
    roll = [1.0, *settings.modified_roll]
    roll += [0.0] * (1 + ROLL_ORDERS - len(roll))
    number = jnp.asarray
    return Generator(
        centre=(
            settings.radial_distance * jnp.cos(q),
            -settings.radial_distance * jnp.sin(q),
            zero,
        ),
        head=((ct * ci, -st, ct * si), (st * ci, ct, st * si), (-si + zero, zero, ci + zero)),
        blank_offset=number(settings.blank_offset),
        sliding_base=number(settings.sliding_base),
        helical_motion=number(settings.helical_motion),
        root_sine=jnp.sin(settings.machine_root_angle),
        root_cosine=jnp.cos(settings.machine_root_angle),
        machine_center_to_back=number(settings.machine_center_to_back),
        roll=settings.ratio_of_roll * number(roll),
        blade_ratio=number(settings.roll_to_blade_ratio),
    )


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

    work = sum(c * phi ** (n + 1) for n, c in enumerate([1.0, *settings.modified_roll]))
    base = settings.sliding_base + settings.helical_motion * phi
    return (
        turn(2, -(settings.roll_to_blade_ratio * theta + settings.ratio_of_roll * work))
        @ shift(0.0, 0.0, -settings.machine_center_to_back)
        @ turn(1, -(np.pi / 2 - settings.machine_root_angle))
        @ shift(0.0, settings.blank_offset, -base)
        @ turn(2, phi)
        @ turn(2, np.pi / 2 - settings.cradle_angle)
        @ shift(0.0, -settings.radial_distance, 0.0)
        @ turn(2, settings.swivel_angle)
        @ turn(1, settings.tilt_angle)
        @ turn(2, -theta)
    )
