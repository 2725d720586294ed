"""Shafts and bearings: wrenches, motions, and the mounting that they amount to."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest
from conftest import RELIEF, TABLE_1

from hypoid.contact import Misalignment, mounting
from hypoid.design import BodySpec, bearing_compliance, build
from hypoid.geometry import DesignError
from hypoid.load import (
    STEEL,
    Bearings,
    LoadCase,
    LoadedContact,
    ToothCompliance,
    assumptions,
    bearings_of,
    loaded_contact,
    rim_thickness,
    warnings,
)
from hypoid.load._bearings import moved_mounting
from hypoid.load._setup import support
from hypoid.pair import GearPair
from hypoid.solid import body

TORQUE = 11e4
FLOATING = np.diag([2e5, 1.5e5, 1e5, 8e8, 6e8, 0.0])  # N/mm, N mm/rad
FLOATING[0, 4] = FLOATING[4, 0] = 4e6  # an overhung pinion: force and turn go together, N
ZERO = np.zeros((6, 6))
Teeth = tuple[ToothCompliance, ToothCompliance]


def case(pair: GearPair, teeth: Teeth, **more: Any) -> LoadCase:
    return loaded_contact(pair, "drive", [TORQUE], *teeth, positions=5, **more).cases[0]


@pytest.fixture(scope="module")
def yielding(relief_pair: GearPair, drive_teeth: Teeth) -> LoadCase:
    soft = bearing_compliance(FLOATING.tolist())
    return case(relief_pair, drive_teeth, bearings=Bearings(soft, 0.5 * soft))


def test_stiff_bearings_are_none(
    relief_pair: GearPair, drive_teeth: Teeth, loaded: LoadedContact
) -> None:
    hard = bearing_compliance((1e9 * FLOATING).tolist())
    found = case(relief_pair, drive_teeth, bearings=Bearings(hard, hard))
    for a, b in zip(found.positions, loaded.cases[-1].positions[::2], strict=True):
        assert a.rotation == pytest.approx(b.rotation, rel=1e-3)
        assert [p.share for p in a.pairs] == pytest.approx([p.share for p in b.pairs], abs=3e-3)


def test_motion_is_compliance_times_wrench(yielding: LoadCase) -> None:
    """Row by row in stiffness: K u = wrench but for the moment about the axis, which the drive takes."""
    for at in yielding.positions:
        np.testing.assert_allclose(
            (FLOATING @ at.pinion_motion)[:5], at.pinion_wrench[:5], rtol=1e-9
        )
        np.testing.assert_allclose(
            (2.0 * FLOATING @ at.wheel_motion)[:5], at.wheel_wrench[:5], rtol=1e-9
        )
        assert at.pinion_motion[5] == at.wheel_motion[5] == 0.0
        assert abs(at.pinion_wrench[5]) == pytest.approx(TORQUE, rel=1e-9)
        assert abs(at.wheel_wrench[5]) == pytest.approx(at.wheel_torque, rel=1e-9)
        forces = [np.linalg.norm(w[:3]) for w in (at.pinion_wrench, at.wheel_wrench)]
        assert forces[0] == pytest.approx(forces[1], rel=1e-12)


def test_yielding_bearings_are_the_misalignment_that_they_amount_to(
    relief_pair: GearPair, drive_teeth: Teeth, yielding: LoadCase, loaded: LoadedContact
) -> None:
    """Rigid bearings at the mounting into which the yielding ones have moved: the same shares and pressure."""
    at = yielding.positions[2]
    error = at.misalignment
    assert max(abs(v) for v in vars(error).values()) > 0.01
    same = case(relief_pair, drive_teeth, misalignment=error, bearings=Bearings(ZERO, ZERO))
    moved, rigid = same.positions[2], loaded.cases[-1].positions[4]
    shares = {p.pair: p.share for p in moved.pairs}
    for p in at.pairs:
        assert p.share == pytest.approx(shares.get(p.pair, 0.0), abs=0.02)
    assert at.max_pressure == pytest.approx(moved.max_pressure, rel=0.03)
    assert abs(rigid.max_pressure / moved.max_pressure - 1.0) > 0.05  # bearings do matter here


@pytest.mark.parametrize("mirrored", [False, True])
def test_each_error_of_mounting_by_a_motion(relief_pair: GearPair, mirrored: bool) -> None:
    """A motion along or about one axis of the bearings' frame is one error, on a mounting that has errors already."""
    mount = mounting(relief_pair, "drive", Misalignment(0.3, 0.0, 0.1, 0.01))
    hand, small = (-1.0 if mirrored else 1.0), 1e-4
    motions = {
        "offset": (1, -hand * small),
        "pinion_axial": (2, small),
        "shaft_angle": (4, -small),
    }
    for name, (axis, size) in motions.items():
        motion = np.zeros(6)
        motion[axis] = size
        found = moved_mounting(mount, mirrored, motion, np.zeros(6))
        for field in fields(found):
            expected = small if field.name == name else 0.0
            assert getattr(found, field.name) == pytest.approx(expected, abs=3e-7), name
    along = np.array([0.0, 0.0, small, 0.0, 0.0, 0.0])
    assert moved_mounting(mount, mirrored, np.zeros(6), along).wheel_axial == pytest.approx(small)
    turned = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0])  # about the member's own axis: nothing
    still = moved_mounting(mount, mirrored, turned, turned)
    assert max(abs(v) for v in vars(still).values()) < 1e-9


def test_a_right_hand_pair_on_mirrored_bearings(
    relief_pair: GearPair, drive_teeth: Teeth, yielding: LoadCase
) -> None:
    """Its mirror image: y turns round, and so do moments and turns about x and z."""
    pair = build(replace(TABLE_1, tip_relief=RELIEF, pinion_hand="right"))
    flip = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    soft = bearing_compliance((flip[:, None] * FLOATING * flip).tolist())
    found = case(pair, drive_teeth, bearings=Bearings(soft, 0.5 * soft))
    for a, b in zip(found.positions, yielding.positions, strict=True):
        np.testing.assert_allclose(a.pinion_motion, flip * b.pinion_motion, rtol=5e-3, atol=1e-7)
        assert a.misalignment.offset == pytest.approx(b.misalignment.offset, rel=5e-3)


def test_the_design_gives_bearings(relief_pair: GearPair) -> None:
    stiffness = tuple(tuple(row) for row in FLOATING.tolist())
    pair = build(replace(TABLE_1, bodies={"pinion": BodySpec(stiffness=stiffness, held="back")}))
    found = bearings_of(pair)
    np.testing.assert_allclose(FLOATING[:5, :5] @ found.pinion[:5, :5], np.eye(5), atol=1e-9)
    assert not found.wheel.any()
    assert pair.pinion.held == "back"
    assert bearings_of(relief_pair).rigid


def broken(**changes: float) -> list[list[float]]:
    rows = FLOATING.copy()
    for key, value in changes.items():
        rows[int(key[1]), int(key[2])] = value
    return rows.tolist()


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ([[1.0]], "6 rows of 6"),
        ("stiff", "6 rows of 6"),
        (broken(k22=0.0), "nothing holds"),
        (broken(k04=5e6), "not symmetric"),
        (broken(k04=1.2e7, k40=1.2e7), "not positive definite"),
        (broken(k55=-1.0), "nothing holds"),
    ],
)
def test_what_holds_no_member_is_told(relief_pair: GearPair, given: Any, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        bearing_compliance(given)
    member = replace(relief_pair.wheel, bearing_stiffness=given)
    with pytest.raises(DesignError) as told:
        bearings_of(replace(relief_pair, wheel=member))
    assert told.value.problems[0].path == "wheel.support.stiffness"


def test_a_shaft_that_winds_up(
    relief_pair: GearPair, drive_teeth: Teeth, loaded: LoadedContact
) -> None:
    """A torsional stiffness of the pinion adds torque over stiffness to its rotation, and nothing else."""
    wound = np.zeros((6, 6))
    wound[5, 5] = 1e-9  # rad / N mm
    found = case(relief_pair, drive_teeth, bearings=Bearings(wound, ZERO))
    for a, b in zip(found.positions, loaded.cases[-1].positions[::2], strict=True):
        assert a.rotation - b.rotation == pytest.approx(TORQUE * 1e-9, rel=0.02)
        assert [p.share for p in a.pairs] == pytest.approx([p.share for p in b.pairs], abs=3e-3)


def test_a_thin_rim_is_warned_of(relief_pair: GearPair) -> None:
    """A bore that leaves less metal under the slots than the teeth are deep."""
    assert not warnings(relief_pair)
    member = relief_pair.pinion
    thick = rim_thickness(member)
    depth = member.blank.outer_addendum + member.blank.outer_dedendum
    bored = replace(member, bore=body(member).bore + thick - 0.9 * depth)
    assert rim_thickness(bored) == pytest.approx(0.9 * depth)
    (words,) = warnings(replace(relief_pair, pinion=bored))
    assert "pinion's rim" in words


def test_the_face_that_is_held(relief_pair: GearPair) -> None:
    """As asked, else as the design says, else by the pitch angle; and what is assumed says so."""
    pinion, wheel = relief_pair.pinion, relief_pair.wheel
    assert support(pinion).faces(pinion) == ("bore",)
    assert support(wheel).faces(wheel) == ("back_face",)
    given = replace(pinion, held="back")
    assert support(given).faces(given) == ("back_face",)
    assert support(given, {"pinion": "bore"}).faces(given) == ("bore",)
    told = [a.value for a in assumptions(relief_pair, STEEL, {"wheel": "bore"})]
    assert "wheel held at its bore" in told
    assert "pinion held at its bore" in told
