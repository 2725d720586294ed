"""Gleason No. 463 hypoid grinder: an untilted wheel, and a cam that modifies the roll [lin1996].

The paper does not give the swivel offset C nor the cams' pitch radii: they are the user's data
(`Gleason463Constants`; `fit_cam` finds an unknown cam from design angles). Only C/r_u acts while
the cam stands on its nominal seat.

Signs, with phi_e eccentric, phi_c cradle and phi cam guide angle, s = 1 for a right-hand member and -1 for a
left-hand one (see `_cradle_machine`):

* S_r = 2 e sin(phi_e/2), e = 8 in; q = -s Q with the paper's Q = 360 deg - phi_c + phi_e/2;
* E_m = s E_v; guide angle of the chain's cam = s phi: mirroring the cradle's roll turns the guide's sign
  and with it 2C and 24E, while 6D and 120F stay. The notes' series are in the machine's own cradle angle;
* delta = cam setting - nominal setting of that cam; W counts from the centre of roll, the paper's
  spindle angle from the shaft's zero: a constant turn of the work by n_i/n_p phi;
* the paper's wheel angle is beta = Q + 180 deg - theta (right) or Q + theta (left).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from hypoid.geometry import DesignError, Problem

from ._cam import Cam, cradle_limits, rising_root
from ._change_gears import EXACT, train
from ._cradle_machine import (
    Matrix,
    Workpiece,
    beyond,
    eccentric_of,
    gears_of,
    to_chain_frames,
    turn,
    work_side,
)
from ._dials import Dial, angle_dial, faults, full_turn, gear_dial, half_turn, length_dial
from ._roll_series import cam_of_roll, centre_rates
from ._settings import MachineSettings

NAME = "gleason-463"
ECCENTRIC = 8.0 * 25.4  # e [lin1996, below (21)]
ABLE = frozenset({"cam", "modified_roll"})
TEETH = (5, 40)  # index intervals looked at when none is given


@dataclass(frozen=True)
class Cam463:
    """One generating cam; mm."""

    pitch_radius: float  # r_u
    nominal_setting: float  # cam setting at which the cam stands central (delta = 0)
    half_breadth: float | None = None  # a; None: unknown, then its cusps are not checked


@dataclass(frozen=True)
class Gleason463Constants:
    """What is built into one grinder; mm."""

    swivel_offset: float  # C
    cams: Mapping[int, Cam463] = field(default_factory=dict[int, Cam463])  # by cam number
    eccentric: float = ECCENTRIC


# Stand-ins for the example of the paper, from `fit_cam`: C/r_u is found (5.420, 6.750), C itself is not.
STAND_IN_463 = Gleason463Constants(381.0, {23: Cam463(70.302, 101.6), 29: Cam463(56.439, 76.2)})


@dataclass(frozen=True)
class Gleason463Dials:
    """What the operator sets on a No. 463; mm, rad and teeth (the feed cam never enters the geometry)."""

    eccentric_angle: float  # phi_e
    cradle_angle: float  # phi_c
    machine_root_angle: float  # gamma_m
    cam_number: int
    cam_setting: float
    cam_guide_angle: float  # phi
    index_gears: tuple[int, ...]  # four, their train is n_i/n_p
    index_interval: int  # n_i, slots passed from one to the next
    machine_center_to_back: float = 0.0  # D_x, from the crossing point
    sliding_base: float = 0.0  # E_s
    blank_offset: float = 0.0  # E_v, up positive


# The paper gives no travels: the lengths' bounds and the guide's are ours, wide; see `_tilt_head`.
DIALS_463: dict[str, Dial] = {
    "eccentric_angle": angle_dial(0.0, 180.0, "32 deg 49 min"),
    "cradle_angle": angle_dial(0.0, 360.0, "67 deg 3 min", cyclic=True),
    "machine_root_angle": angle_dial(-90.0, 90.0, "20 deg 26 min", cyclic=True),
    "cam_number": Dial("count", 1, 999, example="23"),
    "cam_setting": length_dial(400.0, "101.6 mm"),
    "cam_guide_angle": angle_dial(-45.0, 45.0, "5 deg 10 min"),
    "index_gears": gear_dial("[48, 80, 50, 81]"),
    "index_interval": Dial("count", 1, 200, example="10"),
    "machine_center_to_back": length_dial(400.0, "-9.013 mm"),
    "sliding_base": length_dial(400.0, "3.146 mm"),
    "blank_offset": length_dial(200.0, "-11.642 mm"),
}


def to_basic(dials: Gleason463Dials, work: Workpiece) -> MachineSettings:
    """Basic settings with the cam's roll; every dial out of range is named in a `DesignError`."""
    cam, constants = machine_cam(dials, work), _constants(work)
    s, half = work.sign, dials.eccentric_angle / 2
    own = Cam(
        cam.swivel_offset, cam.pitch_radius, cam.setting, s * cam.guide_angle, cam.index_ratio
    )
    return MachineSettings(
        radial_distance=2.0 * constants.eccentric * math.sin(half),
        cradle_angle=half_turn(-s * (half - dials.cradle_angle)),
        machine_root_angle=half_turn(dials.machine_root_angle),
        ratio_of_roll=float(own.index_ratio) * centre_rates(own)[0],
        roll_to_blade_ratio=0.0,
        blank_offset=s * dials.blank_offset + 0.0,  # no -0
        machine_center_to_back=dials.machine_center_to_back,
        sliding_base=dials.sliding_base,
        cam=own,
    )


def from_basic(settings: MachineSettings, work: Workpiece) -> Gleason463Dials:
    """Dials of basic settings.

    A cam in the settings must be one of the machine's. A series of roll is met in R_a and c2 by the cam
    and index interval that leave the cam nearest to its nominal seat: c3 and above are then the
    cam's own (`roll_series`).
    """
    path, s, constants = work.path, work.sign, _constants(work)
    found = beyond(settings, ABLE, "No. 463", path)
    eccentric, more = eccentric_of(settings, constants.eccentric, path)
    found += more
    number, cam, more = _cam_for(settings, work, constants)
    found += more
    interval = round(float(cam.index_ratio) * work.teeth)
    if not found and abs(interval - float(cam.index_ratio) * work.teeth) > 1e-9 * interval:
        given = f"{float(cam.index_ratio):g} for {work.teeth} teeth"
        expected = "a whole number of slots, index ratio times teeth"
        found.append(Problem(f"{path}.index_interval", given, expected, f"{interval}"))
    gears, more = gears_of(
        interval / work.teeth if interval else math.nan, "an index", f"{path}.index_gears", "10/27"
    )
    found += more
    if found:
        raise DesignError(found)
    dials = Gleason463Dials(
        eccentric_angle=eccentric,
        cradle_angle=full_turn(eccentric / 2 + s * settings.cradle_angle),
        machine_root_angle=full_turn(settings.machine_root_angle),
        cam_number=number,
        cam_setting=constants.cams[number].nominal_setting + float(cam.setting),
        cam_guide_angle=s * float(cam.guide_angle),
        index_gears=gears,
        index_interval=interval,
        machine_center_to_back=settings.machine_center_to_back,
        sliding_base=settings.sliding_base,
        blank_offset=s * settings.blank_offset + 0.0,
    )
    machine_cam(dials, work)  # names what is out of range
    return dials


def machine_cam(dials: Gleason463Dials, work: Workpiece) -> Cam:
    """The cam as it stands on the machine, guide angle as the dial reads; checks every dial."""
    path, constants = work.path, _constants(work)
    found = faults(dials, DIALS_463, path)
    cam = constants.cams.get(dials.cam_number)
    delta = 0.0
    if cam is None:
        known = ", ".join(str(n) for n in sorted(constants.cams)) or "none yet"
        expected = f"a cam that the machine constants describe ({known})"
        found.append(Problem(f"{path}.cam_number", str(dials.cam_number), expected, "23"))
    else:
        delta = dials.cam_setting - cam.nominal_setting
        if abs(delta) >= cam.pitch_radius:
            low, high = (cam.nominal_setting + d * cam.pitch_radius for d in (-1.0, 1.0))
            expected = f"a setting between {low:.6g} mm and {high:.6g} mm, within the pitch radius"
            expected += " of the cam's nominal one"
            given = f"{dials.cam_setting:.6g} mm"
            example = f"{cam.nominal_setting:.6g} mm"
            found.append(Problem(f"{path}.cam_setting", given, expected, example))
    if not any(p.path == f"{path}.index_gears" for p in found):
        wanted, given = dials.index_interval / work.teeth, train(dials.index_gears)
        if abs(given - wanted) > EXACT * wanted:
            expected = f"gears with the ratio {dials.index_interval}/{work.teeth} = {wanted:.6g}"
            expected += " of index interval to teeth: the slots would not close"
            a, b, c, d = dials.index_gears
            shown = f"{a}/{b} x {c}/{d} = {given:.6g}"
            near, _ = gears_of(wanted, "an index", f"{path}.index_gears", "")
            example = str(list(near or (48, 80, 50, 81)))
            found.append(Problem(f"{path}.index_gears", shown, expected, example))
    if found or cam is None:
        raise DesignError(found)
    ratio = train(dials.index_gears)
    return Cam(constants.swivel_offset, cam.pitch_radius, delta, dials.cam_guide_angle, ratio)


def roll_limits(dials: Gleason463Dials, work: Workpiece) -> tuple[float, float]:
    """Angles phi of the chain, rad, between which the cam rolls uniformly (`check_roll` names a fault)."""
    cam = machine_cam(dials, work)
    low, high = cradle_limits(cam, _constants(work).cams[dials.cam_number].half_breadth)
    return (low, high) if work.sign > 0 else (-high, -low)


def machine_motion(dials: Gleason463Dials, work: Workpiece, beta: float, xi_c: float) -> Matrix:
    """The mechanism as the paper writes it: wheel section to work frame S_6, 4 x 4, mm.

    beta is the paper's wheel angle, xi_c its cradle angle [lin1996, (1), (18), (20)-(25)].
    """
    cam, constants = machine_cam(dials, work), _constants(work)
    sb, cb = math.sin(beta), math.cos(beta)
    wheel = np.array([[sb, -cb, 0, 0], [cb, sb, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    basic = 2.0 * math.pi - dials.cradle_angle + dials.eccentric_angle / 2  # (20)
    radial = 2.0 * constants.eccentric * math.sin(dials.eccentric_angle / 2)  # (21)
    cradle = np.eye(4)
    cradle[:2, 3] = radial * math.cos(basic), -radial * math.sin(basic)  # (22)
    side = work_side(
        dials.machine_root_angle,
        dials.blank_offset,
        dials.sliding_base,
        dials.machine_center_to_back,
        xi_c,
        float(cam.index_ratio) * shaft_angle(cam, xi_c),
    )
    return side @ cradle @ wheel


def pose(dials: Gleason463Dials, work: Workpiece, theta: float, phi: float) -> Matrix:
    """`machine_motion` in the frames and angles of `chain`, 4 x 4, mm: the same rigid motion."""
    s, cam = work.sign, machine_cam(dials, work)
    basic = dials.eccentric_angle / 2 - dials.cradle_angle
    beta = basic + theta if s < 0 else basic + math.pi - theta
    motion = machine_motion(dials, work, beta, s * phi)
    from_centre = turn(0, float(cam.index_ratio) * float(cam.guide_angle))
    return to_chain_frames(from_centre @ motion, work.hand)


def shaft_angle(cam: Cam, cradle: float) -> float:
    """Input shaft angle alpha_e, rad, at a cradle angle alpha_a, both the paper's [lin1996, (18)]."""
    c, r, delta = float(cam.swivel_offset), float(cam.pitch_radius), float(cam.setting)
    guide = float(cam.guide_angle)
    reach = c / r * math.acos(min(1.0, abs(delta) / r))  # up to which (18) rises

    def contact(off: float) -> float:
        turned = math.sin(guide) + math.sin(r / c * off) + math.sin(cradle - guide)
        return c * turned + delta * math.sin(off)

    return cradle - guide - rising_root(contact, -reach, reach)


def _constants(work: Workpiece) -> Gleason463Constants:
    if not isinstance(work.constants, Gleason463Constants):
        expected = "the swivel offset C and of each cam its pitch radius and nominal setting"
        example = "swivel_offset 381 mm, cam 23: pitch_radius 70.3 mm, nominal_setting 101.6 mm"
        where = f"{work.path}: machine constants"
        raise DesignError([Problem(where, "none", expected, example)])
    return work.constants


def _cam_for(
    settings: MachineSettings, work: Workpiece, constants: Gleason463Constants
) -> tuple[int, Cam, list[Problem]]:
    """Number and seat of the machine's cam for basic settings (chain's signs), or why there is none."""
    c, cam = constants.swivel_offset, settings.cam
    known = ", ".join(f"No. {n}: {k.pitch_radius:.6g} mm" for n, k in constants.cams.items())
    if cam is not None:
        for number, own in constants.cams.items():
            same = abs(float(cam.pitch_radius) / own.pitch_radius - 1.0) < 1e-9
            if same and abs(float(cam.swivel_offset) / c - 1.0) < 1e-9:
                return number, cam, []
        given = (
            f"pitch radius {float(cam.pitch_radius):.6g} mm at C = {float(cam.swivel_offset):g} mm"
        )
        expected = f"a cam of the machine at C = {c:g} mm ({known or 'none yet'})"
        return 0, cam, [Problem(f"{work.path}.cam", given, expected, "see known cams")]
    choices: list[tuple[float, int, Cam]] = []
    c2 = settings.modified_roll[0] if settings.modified_roll else 0.0
    for number, own in constants.cams.items():
        for interval in range(*TEETH):
            ratio = interval / work.teeth
            if math.gcd(interval, work.teeth) == 1 and settings.ratio_of_roll > ratio:
                found = cam_of_roll(c, own.pitch_radius, ratio, settings.ratio_of_roll, c2)
                choices.append((abs(float(found.setting)), number, found))
    if choices:
        _, number, found = min(choices, key=lambda choice: choice[0])
        return number, found, []
    expected = (
        f"a ratio of roll above the least index ratio, and a known cam ({known or 'none yet'})"
    )
    given = f"{settings.ratio_of_roll:g}"
    nothing = Cam(c, c, 0.0, 0.0, 1.0)
    return 0, nothing, [Problem(f"{work.path}.ratio_of_roll", given, expected, "2.38")]
