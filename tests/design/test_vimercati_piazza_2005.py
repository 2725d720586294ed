"""The 15 x 44 truck pair of 2005 as a design file: Table 1, the notes' set, and Tables 2 and 3."""

from __future__ import annotations

from functools import cache
from math import degrees

import numpy as np
import pytest
from tri_ac import cut

import hypoid
from hypoid.contact import Misalignment, UnloadedContact, pair_backlash, unloaded_contact
from hypoid.flank import SIDES, Side, tooth_facts
from hypoid.io import example_files
from hypoid.machine import MachineSettings
from hypoid.pair import Direction, GearPair


@cache
def pair() -> GearPair:
    return hypoid.read(next(f for f in example_files() if f.stem == "vimercati-piazza-2005"))


def test_blank_is_table_1() -> None:
    """Table 1's cones touch, their pitch angles rounded to 0.01 deg, and have its normal module."""
    blank = pair().blank
    assert blank.tangency_residual is not None
    assert abs(degrees(blank.tangency_residual)) < 5e-3
    assert blank.mean_normal_module == pytest.approx(3.777, abs=5e-4)  # notes, item 9
    assert blank.outer_transverse_module == pytest.approx(5.080, abs=5e-4)


@pytest.mark.parametrize("member", ["pinion", "wheel"])
@pytest.mark.parametrize("side", SIDES)
def test_file_is_the_set_of_the_notes(member: str, side: Side) -> None:
    """The file's summary sheet, to the pitch apex and with the other sign of the offset, cuts the set's flanks.

    The set's chain counts from the crossing point: 1e-7 mm is what the file's digits of the sheet leave.
    """
    own = getattr(pair(), member).flank(side)
    given = cut(member, side)
    for name in MachineSettings.__dataclass_fields__:
        found, wanted = getattr(own.settings, name), getattr(given.settings, name)
        if isinstance(wanted, float) and (given.settings.generated or name != "ratio_of_roll"):
            assert found == pytest.approx(wanted, abs=1e-7), name
    distance, height = np.meshgrid(np.linspace(own.toe + 1, own.heel - 1, 7), [-0.5, 0.5, 2.5])
    at = own.at_cone(distance, height)
    z, rho = at.position[:, 2], np.hypot(at.position[:, 0], at.position[:, 1])
    other = given.at(z, rho)
    assert (at.ok & other.ok).all()
    pitch = 2.0 * np.pi / getattr(pair(), member).teeth
    turn = np.arctan2(at.position[:, 1], at.position[:, 0])
    turn -= np.arctan2(other.position[:, 1], other.position[:, 0])
    if member == "pinion" and side == "convex":  # another spacing: another turn of the whole flank
        assert np.ptp(np.unwrap(turn, period=pitch)) * rho.max() < 2e-6
        return
    assert (np.abs((turn + 0.5 * pitch) % pitch - 0.5 * pitch) * rho).max() < 1e-6


CASES: list[tuple[Direction, str, float, float, float, float, float]] = [
    # direction, contact at, dE, dP (Table 2, mm), HYFH, T2000 (Table 3, urad), the notes' set
    ("drive", "toe", 0.254, -0.102, 49.0, 52.0, 52.9),
    ("drive", "mean", 0.0, 0.0, 51.0, 54.0, 54.6),
    ("drive", "heel", -0.508, 0.280, 62.0, 63.0, 62.3),
    ("coast", "toe", -0.254, 0.051, 45.0, 47.0, 49.6),
    ("coast", "mean", 0.0, 0.0, 53.0, 57.0, 56.9),
    ("coast", "heel", 0.508, -0.254, 70.0, 76.0, 70.6),
]
PLACES = {"toe": -0.25, "mean": 0.0, "heel": 0.25}  # of the face width, off the mean point


@cache
def contact(direction: Direction, offset: float, axial: float) -> UnloadedContact:
    return unloaded_contact(pair(), direction, Misalignment(offset=offset, pinion_axial=axial))


@pytest.mark.parametrize(("direction", "place", "offset", "axial", "hyfh", "t2000", "notes"), CASES)
def test_transmission_errors_of_table_3(
    direction: Direction,
    place: str,
    offset: float,
    axial: float,
    hyfh: float,
    t2000: float,
    notes: float,
) -> None:
    """Peak to peak, urad. Only T2000's two mean cases were asked of the settings; the rest is predicted.

    Coast heel is 70.80 here: for half a degree before the handover the wheel's heel edge leads, which the
    notes' search over the flanks does not see (0.2 urad).
    """
    found = contact(direction, offset, axial).peak_to_peak * 1e6
    slack = 0.25 if (direction, place) == ("coast", "heel") else 0.06
    assert found == pytest.approx(notes, abs=slack)
    assert found == pytest.approx(t2000, abs=0.7 if place == "mean" else 5.5)
    assert found == pytest.approx(hyfh, abs=5.0)


@pytest.mark.parametrize(("direction", "place", "offset", "axial"), [case[:4] for case in CASES])
def test_errors_of_mounting_move_the_contact_as_table_2_says(
    direction: Direction, place: str, offset: float, axial: float
) -> None:
    """The paper: by 0.25 F. The summit of the motion curve here: to 0.05 F in drive, 0.11 F in coast."""
    found = contact(direction, offset, axial)
    summit = int(np.argmax(found.points.lead[found.on_path]))
    for member, path in ((pair().pinion, found.path), (pair().wheel, found.wheel_path)):
        share = (path[0][summit] - member.blank.mean_cone_distance) / member.blank.face_width
        assert share == pytest.approx(PLACES[place], abs=0.05 if direction == "drive" else 0.11)


def test_backlash_is_what_the_spacing_was_chosen_for() -> None:
    """Notes: 0.16 mm circumferential. The blade spacing that they print, 9.4 deg, does not give it."""
    assert pair_backlash(pair()).mean_transverse == pytest.approx(0.16, abs=2e-3)


def test_sections_of_figure_8() -> None:
    """Neck on the concave side at the toe alone; sharp top land there, deeper at the heel (Fig. 8, notes)."""
    facts = tooth_facts(pair().pinion.tooth)
    assert [(n.flank, n.cone_distance) for n in facts.necks] == [
        ("pinion concave", pytest.approx(pair().pinion.concave.toe))
    ]
    toe, _, heel = facts.sections
    assert toe.top_land == pytest.approx(1.1, abs=0.05)
    assert heel.top_land == pytest.approx(4.3, abs=0.2)  # 4.125: another spacing than the notes'
    assert heel.whole_depth > 9.0 * 1.02  # the paper: 5.5 % above nominal on the concave side
