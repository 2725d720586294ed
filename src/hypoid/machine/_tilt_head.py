"""Cradle with a tilted head: eccentric, cradle, swivel and cutter spindle rotation [tsay1993].

What No. 106 and No. 122 share; they differ by the constants. The mechanism's own motion is written
from the paper's matrices (`machine_motion`); the basic settings are closed forms of the same dials,
and a test shows that both are one rigid motion.

Signs, with psi_e eccentric, psi_c cradle, psi_s swivel, psi_t cutter spindle rotation angle, eps the wedge
angle, s = 1 for a right-hand member and -1 for a left-hand one (see `_cradle_machine`):

* S_r = 2 L sin(psi_e/2), sin(i/2) = sin(eps) sin(psi_t/2), so that i <= 2 eps;
* q = s q', q' = 90 deg - psi_c - psi_e/2;
* j = -90 deg - s j', j' = -psi_e/2 - psi_s - chi, chi = atan(cos(eps) tan(psi_t/2)): the chain counts its
  swivel from a quarter turn further on than q' + j', the direction in which the cutter leans;
* the paper's cutter angle is beta = -s theta - chi (constant shift: blade angle zero differs);
* E_m = s E_v, R_a = (Ta Tc)/(Tb Td) 50/T_n, h = d K (Te Tg)/(Tf Th), where d is the dial
  ``helical_direction``: 1 if the sliding base setting grows with phi. The printed (21) has -1 for a
  right-hand member; the paper's own pinion needs 1 (notes, item 5).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from hypoid.geometry import DesignError, Problem

from ._change_gears import train
from ._cradle_machine import (
    Matrix,
    Workpiece,
    beyond,
    eccentric_of,
    gears_of,
    to_chain_frames,
    work_side,
)
from ._dials import (
    Dial,
    angle_dial,
    check,
    full_turn,
    gear_dial,
    half_turn,
    length_dial,
    shown,
)
from ._settings import MachineSettings

INCH = 25.4
WEDGE = math.radians(15.0)
INDEX = 50.0  # of the ratio gears: Nc/50
ABLE = frozenset({"tilt_angle", "helical_motion", "generated"})


@dataclass(frozen=True)
class TiltHeadConstants:
    """What is built into a machine; mm, rad."""

    name: str
    eccentric: float  # L
    helical: float  # K, mm/rad of sliding base for helical gears of ratio one
    wedge: float = WEDGE  # eps


@dataclass(frozen=True)
class TiltHeadDials:
    """What the operator sets on a No. 106 or No. 122; mm, rad and teeth.

    Without ratio gears the cradle stands still: a form cut (Formate).
    """

    eccentric_angle: float  # psi_e
    cradle_angle: float  # psi_c
    swivel_angle: float  # psi_s
    cutter_spindle_rotation_angle: float  # psi_t
    machine_root_angle: float  # gamma_m
    machine_center_to_back: float = 0.0  # D_x, from the crossing point
    sliding_base: float = 0.0  # X_b, withdraw positive
    blank_offset: float = 0.0  # E_v, up positive
    ratio_gears: tuple[int, ...] = ()  # Ta, Tb, Tc, Td
    helical_gears: tuple[int, ...] = ()  # Te, Tf, Tg, Th; none: no helical motion
    helical_direction: int = 1  # 1: the sliding base setting grows with the cradle roll phi


# Angles are those the mechanism closes at. The papers give no travels of the slides: the lengths' bounds
# are ours, wide enough for any work on these machines, and catch a slip of units only.
TILT_HEAD: dict[str, Dial] = {
    "eccentric_angle": angle_dial(0.0, 180.0, "64 deg 29 min"),
    "cradle_angle": angle_dial(0.0, 360.0, "355 deg 53 min", cyclic=True),
    "swivel_angle": angle_dial(0.0, 360.0, "359 deg 30 min", cyclic=True),
    "cutter_spindle_rotation_angle": angle_dial(0.0, 180.0, "52 deg 41 min"),
    "machine_root_angle": angle_dial(-90.0, 90.0, "73 deg 26 min", cyclic=True),
    "machine_center_to_back": length_dial(400.0, "1.34 mm"),
    "sliding_base": length_dial(400.0, "19.78 mm"),
    "blank_offset": length_dial(200.0, "20.91 mm"),
    "ratio_gears": gear_dial("[53, 42, 48, 76]", optional=True),
    "helical_gears": gear_dial("[52, 66, 82, 49]", optional=True),
    "helical_direction": Dial("direction", -1, 1, example="1"),
}


def to_basic(
    dials: TiltHeadDials, work: Workpiece, constants: TiltHeadConstants
) -> MachineSettings:
    """Basic settings of dials; a `DesignError` names every dial out of its range."""
    check(dials, TILT_HEAD, work.path)
    s = work.sign
    half, lean = dials.eccentric_angle / 2, dials.cutter_spindle_rotation_angle / 2
    cradle = math.pi / 2 - dials.cradle_angle - half
    swivel = -half - dials.swivel_angle - _chi(dials, constants)
    helical = dials.helical_direction * helical_motion(dials, constants)
    return MachineSettings(
        radial_distance=2.0 * constants.eccentric * math.sin(half),
        cradle_angle=half_turn(s * cradle),
        tilt_angle=2.0 * math.asin(math.sin(constants.wedge) * math.sin(lean)),
        swivel_angle=half_turn(-math.pi / 2 - s * swivel),
        blank_offset=s * dials.blank_offset + 0.0,  # no -0
        machine_root_angle=half_turn(dials.machine_root_angle),
        machine_center_to_back=dials.machine_center_to_back,
        sliding_base=dials.sliding_base,
        ratio_of_roll=ratio_of_roll(dials, work.teeth),
        roll_to_blade_ratio=0.0,
        helical_motion=helical,
        generated=bool(dials.ratio_gears),
    )


def from_basic(
    settings: MachineSettings, work: Workpiece, constants: TiltHeadConstants
) -> TiltHeadDials:
    """Dials of basic settings, change gears the nearest there are; errors name what cannot be set.

    A negative tilt is read as the positive one with the swivel half a turn on (the blade's own
    angle, which does not matter in face milling, then shifts by half a turn).
    """
    path, s = work.path, work.sign
    found = beyond(settings, ABLE, constants.name, path)
    eccentric, more = eccentric_of(settings, constants.eccentric, path)
    found += more
    tilt, swivel = abs(settings.tilt_angle), settings.swivel_angle
    if settings.tilt_angle < 0.0:
        swivel += math.pi
    limit = 2.0 * constants.wedge
    if not tilt <= limit + 1e-12:
        expected = f"a tilt from 0 deg to {shown(limit, 'angle')} (twice the wedge angle"
        expected += f" of the {constants.name})"
        given = shown(settings.tilt_angle, "angle")
        found.append(Problem(f"{path}.tilt_angle", given, expected, "13 deg 11 min"))
    ratio_gears: tuple[int, ...] = ()
    helical_gears: tuple[int, ...] = ()
    if settings.generated:
        wanted = settings.ratio_of_roll * work.teeth / INDEX
        ratio_gears, more = gears_of(wanted, "a ratio of roll", f"{path}.ratio_of_roll", "6.6416")
        found += more
        if settings.helical_motion:
            wanted = abs(settings.helical_motion) / constants.helical
            at = f"{path}.helical_motion"
            helical_gears, more = gears_of(wanted, "a helical motion", at, "10.509 mm/rad")
            found += more
    elif settings.helical_motion:
        expected = "no helical motion: the cradle of a form cut stands still"
        given = f"{settings.helical_motion:g} mm/rad"
        found.append(Problem(f"{path}.helical_motion", given, expected, "leave it out"))
    if found:
        raise DesignError(found)
    lean = math.sin(tilt / 2) / math.sin(constants.wedge)
    spindle = 2.0 * math.asin(min(1.0, lean))
    dials = TiltHeadDials(
        eccentric_angle=eccentric,
        cradle_angle=full_turn(math.pi / 2 - s * settings.cradle_angle - eccentric / 2),
        swivel_angle=0.0,
        cutter_spindle_rotation_angle=spindle,
        machine_root_angle=full_turn(settings.machine_root_angle),
        machine_center_to_back=settings.machine_center_to_back,
        sliding_base=settings.sliding_base,
        blank_offset=s * settings.blank_offset + 0.0,
        ratio_gears=ratio_gears,
        helical_gears=helical_gears,
        helical_direction=-1 if settings.helical_motion < 0.0 else 1,
    )
    chi = _chi(dials, constants)
    turned = full_turn(s * (math.pi / 2 + swivel) - eccentric / 2 - chi)
    dials = replace(dials, swivel_angle=turned)
    check(dials, TILT_HEAD, path)
    return dials


def ratio_of_roll(dials: TiltHeadDials, teeth: int) -> float:
    """R_a, work turn per cradle turn [tsay1993, (16)]; 0 without ratio gears."""
    return train(dials.ratio_gears) * INDEX / teeth if dials.ratio_gears else 0.0


def helical_motion(dials: TiltHeadDials, constants: TiltHeadConstants) -> float:
    """Size of the helical motion, mm/rad of cradle roll [tsay1993, below (21)]; 0 without gears."""
    if not (dials.helical_gears and dials.ratio_gears):
        return 0.0
    return constants.helical * train(dials.helical_gears)


def machine_motion(
    dials: TiltHeadDials, work: Workpiece, constants: TiltHeadConstants, beta: float, zeta: float
) -> Matrix:
    """The mechanism as the paper writes it: blade frame S_s to work frame S_e, 4 x 4, mm.

    beta is the paper's cutter angle, zeta its cradle angle [tsay1993, (5), (14), (16)-(21), the
    sign of the helical motion in (21) by the dial].
    """
    zeta = zeta if dials.ratio_gears else 0.0
    sb, cb = math.sin(beta), math.cos(beta)
    blade = np.array([[sb, -cb, 0, 0], [cb, sb, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    grown = work.sign * dials.helical_direction * helical_motion(dials, constants)
    base = dials.sliding_base + grown * zeta
    side = work_side(
        dials.machine_root_angle,
        dials.blank_offset,
        base,
        dials.machine_center_to_back,
        zeta,
        zeta * ratio_of_roll(dials, work.teeth),
    )
    return side @ _head(dials, constants) @ blade


def pose(
    dials: TiltHeadDials, work: Workpiece, constants: TiltHeadConstants, theta: float, phi: float
) -> Matrix:
    """`machine_motion` in the frames and angles of `chain`, 4 x 4, mm: the same rigid motion."""
    beta = -work.sign * theta - _chi(dials, constants)
    motion = machine_motion(dials, work, constants, beta, work.sign * phi)
    return to_chain_frames(motion, work.hand)


def _head(dials: TiltHeadDials, constants: TiltHeadConstants) -> Matrix:
    """Cutter to cradle [tsay1993, (14)], the elements as printed."""
    length, eps = constants.eccentric, constants.wedge
    psi_e, psi_c = dials.eccentric_angle, dials.cradle_angle
    psi_t = dials.cutter_spindle_rotation_angle
    tau = psi_c + psi_e + dials.swivel_angle
    st, ct, se, ce = math.sin(tau), math.cos(tau), math.sin(eps), math.cos(eps)
    sp, cp, lift = math.sin(psi_t), math.cos(psi_t), 0.5 * math.sin(2.0 * eps)
    own = ce * ce * cp + se * se
    x = length * (math.cos(psi_c) - math.cos(psi_c + psi_e))
    y = -length * (math.sin(psi_c) - math.sin(psi_c + psi_e))
    rise, side = (1.0 - cp) * lift, se * sp
    return np.array(
        [
            [ct * own - st * ce * sp, ct * ce * sp + st * cp, rise * ct + st * side, x],
            [-st * own - ct * ce * sp, -st * ce * sp + ct * cp, -rise * st + ct * side, y],
            [rise, -side, se * se * cp + ce * ce, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def _chi(dials: TiltHeadDials, constants: TiltHeadConstants) -> float:
    half = dials.cutter_spindle_rotation_angle / 2
    return math.atan2(math.cos(constants.wedge) * math.sin(half), math.cos(half))
