"""Laws of the loaded contact, on the 2022 pair with relief and a coarse compliance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import RELIEF, TABLE_1

from hypoid.contact import Misalignment, to_wheel
from hypoid.design import build
from hypoid.geometry import DesignError
from hypoid.load import (
    Elements,
    LoadCase,
    LoadedContact,
    Outcome,
    ToothCompliance,
    _position,
    loaded_contact,
    root_stress,
    tooth_compliance,
)
from hypoid.load._cells import Cells, compliance
from hypoid.load._guess import Guess, first_rotation, first_window
from hypoid.load._load_case import _spline_range
from hypoid.load._loaded import solved_positions
from hypoid.load._meeting import Meeting, meeting
from hypoid.load._patch import EDGES, Window, patch
from hypoid.load._position import position_contact
from hypoid.pair import GearPair

from .conftest import QUICK, TORQUES
from .test_half_space import MODULUS, hertz


def at(loaded: LoadedContact, torque: float, position: int = 0) -> Any:
    """Contact of all pairs at one position after pinion angle zero."""
    return position_contact(met_at(loaded, position), loaded.teeth, torque)


def met_at(loaded: LoadedContact, position: int = 0) -> list[Meeting]:
    """All pairs that can touch there."""
    where = len(loaded.unloaded.phi) // 2 + position
    return [m for k in range(-4, 5) if (m := meeting(loaded.unloaded, where, k)) is not None]


def test_moments_are_in_equilibrium(loaded: LoadedContact) -> None:
    """The moment of all cells' forces about the pinion's axis, as vectors, is the torque, to 1e-9."""
    for torque in TORQUES:
        found = at(loaded, torque)
        assert found.outcome is Outcome.OK
        assert not found.open_window
        mount = loaded.unloaded.mount
        axis = np.array(to_wheel(mount, 0.0, (0.0, 0.0, 1.0), free=True), dtype=float)
        origin = np.array(to_wheel(mount, 0.0, (0.0, 0.0, 0.0)), dtype=float)
        moment = np.zeros(3)
        for p, part in zip(found.patches, found.parts, strict=True):
            force = -p.normal * found.solution.force[part][:, None]
            moment += np.cross(p.point - origin, force).sum(axis=0)
        # G is a mirror image of the pinion's frame, so the moment about its axis changes sign
        assert abs(moment @ axis) == pytest.approx(torque, rel=1e-9)
    for case in loaded.cases:
        for position in case.positions:
            assert sum(p.share for p in position.pairs) == pytest.approx(1.0, abs=1e-9)


def test_compliance_of_all_cells_is_symmetric_and_positive(loaded: LoadedContact) -> None:
    found = at(loaded, TORQUES[-1])
    matrix = compliance([Cells(p, loaded.teeth) for p in found.patches])
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-12 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix)[0] > 0.0


def test_no_cell_cuts_and_none_pulls(loaded: LoadedContact) -> None:
    found = at(loaded, TORQUES[-1], 7)
    solution = found.solution
    assert solution.force.min() >= 0.0
    gap = np.concatenate([p.gap for p in found.patches])
    lever = np.concatenate([p.pinion_lever for p in found.patches])
    under = (
        gap
        + compliance([Cells(p, loaded.teeth) for p in found.patches]) @ solution.force
        - lever * solution.rotation
    )
    assert under.min() > -2e-9
    assert np.abs(under[solution.touching]).max() < 1e-9


def test_a_light_load_is_hertz_at_the_contact_point(loaded: LoadedContact) -> None:
    """One pair, a small ellipse far from edges: the closed form with the surfaces' own curvatures."""
    found = at(loaded, TORQUES[0])
    (p,) = [
        p
        for p, part in zip(found.patches, found.parts, strict=True)
        if found.solution.force[part].any()
    ]
    low, high = p.meeting.curvature
    force = found.solution.force.sum()
    radius = 1.0 / np.sqrt(low * high)
    _, _, peak, _ = hertz(high / low, radius, force)
    assert (found.solution.force[: p.count] / p.area).max() == pytest.approx(peak, rel=0.02)
    assert loaded.teeth.plane_modulus == pytest.approx(MODULUS)


def test_a_small_torque_tends_to_the_rigid_contact(loaded: LoadedContact) -> None:
    """Transmission error under load less its mean goes to the unloaded one as the torque goes to zero."""
    apart = []
    for case in loaded.cases:
        rigid = np.array([p.unloaded for p in case.positions])
        apart.append(np.abs(case.transmission_error - rigid).max())
    # a point contact: as the torque to the power 2/3
    assert apart[0] < 1.2 * (TORQUES[0] / TORQUES[1]) ** (2.0 / 3.0) * apart[1] < apart[2]
    assert apart[0] < 5e-6
    light = loaded.cases[0].positions
    assert all(len(p.pairs) <= 2 for p in light)
    assert [p.unloaded for p in light] == pytest.approx(
        loaded.unloaded.transmission_error[:: len(loaded.unloaded.cycle) // 8], abs=1e-12
    )


def test_more_torque_turns_further_and_presses_harder(loaded: LoadedContact) -> None:
    for one, two in zip(loaded.cases[:-1], loaded.cases[1:], strict=True):
        for a, b in zip(one.positions, two.positions, strict=True):
            assert b.rotation > a.rotation
            assert b.stiffness > a.stiffness
            assert len(b.pairs) >= len(a.pairs)
        assert two.max_pressure > one.max_pressure
        assert two.contact_ratio > one.contact_ratio


def test_stiffness_is_the_slope_of_torque(loaded: LoadedContact) -> None:
    found = at(loaded, 11e4)
    more = position_contact(
        [p.meeting for p in found.patches], loaded.teeth, 11.02e4, found.guesses
    )
    slope = 200.0 / (more.solution.rotation - found.solution.rotation)
    assert slope == pytest.approx(found.solution.stiffness, rel=0.02)


def test_positions_repeat_after_a_pitch(loaded: LoadedContact) -> None:
    case = loaded.cases[-1]
    first, last = case.positions[0], case.positions[-1]
    assert last.pinion_angle - first.pinion_angle == pytest.approx(2.0 * loaded.unloaded.pitch)
    assert [p.pair + 2 for p in first.pairs] == [p.pair for p in last.pairs]
    again = at(loaded, case.torque, loaded.unloaded.sampling.positions_per_pitch)
    assert again.solution.rotation == pytest.approx(last.rotation, rel=2e-3)


def test_a_window_foretold_beside_its_contact_is_put_right(loaded: LoadedContact) -> None:
    """A pair that finds no contact where it is looked for, but must be near one, is looked at where it is nearest."""
    found = at(loaded, 11e4)
    meetings = [p.meeting for p in found.patches]
    astray = dict(found.guesses)
    least = min(p.meeting.pair for p in found.patches)
    low, high = astray[least].window.along
    away = Window((high + 1.0, 2.0 * high - low + 1.0), astray[least].window.across)
    astray[least] = Guess(away)
    again = position_contact(meetings, loaded.teeth, 11e4, astray, found.solution.rotation)
    assert again.solution.rotation == pytest.approx(found.solution.rotation, rel=1e-3)
    forces = [
        {
            p.meeting.pair: float(one.solution.force[part].sum())
            for p, part in zip(one.patches, one.parts, strict=True)
        }
        for one in (again, found)
    ]
    assert forces[0] == pytest.approx(forces[1], rel=0.02)


def test_four_times_the_cells_change_little(
    loaded: LoadedContact, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = at(loaded, 11e4)
    coarse = [
        (found.solution.force[part] / p.area).max()
        for p, part in zip(found.patches, found.parts, strict=True)
    ]
    monkeypatch.setattr("hypoid.load._patch.COLUMNS", 50)
    monkeypatch.setattr("hypoid.load._patch.ROWS", 22)
    fine = position_contact([p.meeting for p in found.patches], loaded.teeth, 11e4, found.guesses)
    assert fine.solution.rotation == pytest.approx(found.solution.rotation, rel=3e-3)
    peaks = [
        (fine.solution.force[part] / p.area).max()
        for p, part in zip(fine.patches, fine.parts, strict=True)
    ]
    assert max(peaks) == pytest.approx(max(coarse), rel=0.03)


def test_what_is_foretold_is_found(loaded: LoadedContact, monkeypatch: pytest.MonkeyPatch) -> None:
    """Torques close together, one position after the other: most contacts want no second window."""
    solved: list[int] = []

    def counted(cells: Any, *rest: Any) -> Any:
        solved.append(len(cells))
        return contact(cells, *rest)

    contact = _position._contact
    monkeypatch.setattr(_position, "_contact", counted)
    torques = [2e4, 3e4, 4e4, 5e4, 6e4]
    steps = solved_positions(loaded.unloaded, loaded.teeth, torques, 10)
    next(steps), next(steps)
    solved.clear()
    next(steps)
    assert len(torques) <= len(solved) <= 2 * len(torques)


@pytest.mark.parametrize("torque", TORQUES)
def test_where_nothing_is_known_the_first_guess_is_near(
    loaded: LoadedContact, torque: float
) -> None:
    """Line contacts that take half of the approach: rotation within half, first windows within four times."""
    met = met_at(loaded)
    found = at(loaded, torque)
    assert first_rotation(met, loaded.teeth, torque) == pytest.approx(found.rotation, rel=0.5)
    most = max(found.patches, key=lambda p: found.guesses[p.meeting.pair].approach)
    contact = found.guesses[most.meeting.pair].contact
    assert contact is not None
    window = first_window(most.meeting, loaded.teeth, found.rotation)
    for ends, seen in zip(window.ends, contact.ends, strict=True):
        assert 0.25 < np.ptp(ends) / np.ptp(seen) < 4.0


def test_guesses_beside_the_flanks_are_left(loaded: LoadedContact) -> None:
    """Windows where no cell is, or a rotation that means nothing: the contact is found as if none had been given."""
    met = met_at(loaded)
    beside = {m.pair: Guess(Window((500.0, 501.0), (500.0, 501.0))) for m in met}
    alone = position_contact(met, loaded.teeth, TORQUES[1])
    for guesses, rotation in ((beside, alone.rotation), ({}, -1.0), ({}, float("nan"))):
        found = position_contact(met, loaded.teeth, TORQUES[1], guesses, rotation)
        assert found.outcome is Outcome.OK
        assert found.rotation == alone.rotation


def test_rays_that_miss_the_flank_have_no_gap(loaded: LoadedContact) -> None:
    met = meeting(loaded.unloaded, len(loaded.unloaded.phi) // 2, 0)
    assert met is not None
    far = np.array([-200.0, 0.0, 30.0, 200.0])
    assert np.isfinite(met.surface(far, 0.0 * far).gap).tolist() == [False, True, False, False]


def test_gaps_are_those_of_the_exact_surfaces(loaded: LoadedContact) -> None:
    """Turn the wheel by a cell's gap over its lever: the wheel's exact surface passes through the cell's point."""
    unloaded = loaded.unloaded
    met = meeting(unloaded, len(unloaded.phi) // 2, 1)
    assert met is not None
    cells = patch(met, Window((-2.0, 2.0), (-0.4, 0.4)))
    flank = unloaded.wheel_flank
    exact = flank.at_cone(*cells.wheel_place)
    x, y, _ = (exact.position * flank.hand).T
    mount = unloaded.mount
    angle = np.arctan2(cells.point[:, 1], cells.point[:, 0]) - np.arctan2(y, x)
    lead = -mount.sense * angle - mount.wheel_zero - mount.ratio * met.phi
    gap = (met.lead - lead) * cells.wheel_lever
    good = exact.ok
    assert good.sum() > 200
    np.testing.assert_allclose(cells.gap[good], gap[good], atol=2e-6)
    own = unloaded.pinion_flank.at_cone(*cells.pinion_place)
    back = np.array(to_wheel(mount, met.phi, tuple((own.position * unloaded.pinion_flank.hand).T)))
    np.testing.assert_allclose(back.T[own.ok], cells.point[own.ok], atol=2e-6)
    normal = np.array(
        to_wheel(mount, met.phi, tuple((own.normal * unloaded.pinion_flank.hand).T), free=True)
    ).T
    np.testing.assert_allclose(normal[own.ok], cells.normal[own.ok], atol=1e-5)


def test_twice_the_size_and_eight_times_the_torque_keep_the_pressure(
    loaded: LoadedContact, compliance_folder: Path
) -> None:
    spec = replace(
        TABLE_1,
        offset=110.0,
        wheel_mean_radius=260.0,
        wheel_face_width=70.0,
        cutter_radius=200.0,
        tip_relief=replace(RELIEF, coefficient=0.002, height=3.0),
    )
    pair = build(spec)  # the pinion's face width is rounded to whole mm: 43 and 85, not 86
    members = (
        tooth_compliance(pair.pinion, "concave", elements=QUICK, cache=compliance_folder),
        tooth_compliance(pair.wheel, "convex", elements=QUICK, cache=compliance_folder),
    )
    twice = loaded_contact(pair, "drive", [88e4], *members, positions=9)
    one = loaded.cases[-1]
    for a, b in zip(one.positions, twice.cases[0].positions, strict=True):
        assert b.rotation == pytest.approx(a.rotation, rel=0.02)
        for p, q in zip(a.pairs, b.pairs, strict=False):
            assert q.share == pytest.approx(p.share, abs=0.01)
    assert twice.cases[0].max_pressure == pytest.approx(one.max_pressure, rel=0.02)


def test_a_right_hand_pair_is_the_mirror_image(
    variant: Callable[[str], GearPair], loaded: LoadedContact, compliance_folder: Path
) -> None:
    pair = build(replace(TABLE_1, tip_relief=RELIEF, pinion_hand="right"))
    members = (
        tooth_compliance(pair.pinion, "concave", elements=QUICK, cache=compliance_folder),
        tooth_compliance(pair.wheel, "convex", elements=QUICK, cache=compliance_folder),
    )
    mirrored = loaded_contact(pair, "drive", [11e4], *members, positions=5)
    for a, b in zip(loaded.cases[-1].positions[::2], mirrored.cases[0].positions, strict=True):
        assert b.rotation == pytest.approx(a.rotation, rel=1e-3)
        assert [p.share for p in b.pairs] == pytest.approx([p.share for p in a.pairs], abs=3e-3)


def test_root_stress_is_linear_in_the_hats_and_greatest_on_the_loaded_side(
    loaded: LoadedContact,
) -> None:
    for member in ("pinion", "wheel"):
        light, heavy = (root_stress(loaded, case, member) for case in loaded.cases[1:])
        assert 3.0 < heavy.max_principal / light.max_principal < 11.0
        assert heavy.side[heavy.critical] == heavy.loaded_side
        assert heavy.most_compressed < -0.5 * heavy.max_principal
        assert heavy.max_von_mises > 0.5 * heavy.max_principal
        assert (np.diff(heavy.pinion_angle) >= 0.0).all()
        opposite = heavy.side != heavy.loaded_side
        assert heavy.side[heavy.most_pressed] != heavy.loaded_side
        assert heavy.least[:, heavy.most_pressed].min() == heavy.least[:, opposite].min()


def test_bad_input_is_told_all_at_once(
    relief_pair: GearPair, drive_teeth: tuple[ToothCompliance, ToothCompliance]
) -> None:
    with pytest.raises(DesignError) as told:
        loaded_contact(relief_pair, "drive", [-11e4, 0.0], *drive_teeth, positions=20, pairs=4)
    words = [(p.path, p.expected) for p in told.value.problems]
    assert [w[0] for w in words] == ["torque", "torque", "positions", "pairs"]
    assert "coast" in words[0][1]
    with pytest.raises(DesignError):
        loaded_contact(relief_pair, "drive", [], *drive_teeth)


def test_too_few_pairs_are_told(
    relief_pair: GearPair, drive_teeth: tuple[ToothCompliance, ToothCompliance]
) -> None:
    """With how many are enough: two fewer still are not."""

    def told(pairs: int) -> tuple[int, str]:
        found = loaded_contact(relief_pair, "drive", [11e4], *drive_teeth, positions=5, pairs=pairs)
        return found.cases[0].pairs_needed, " ".join(found.cases[0].faults)

    needed, words = told(3)
    assert needed > 3
    assert f"{needed} are needed" in words
    assert told(needed - 2)[0] == needed
    assert told(needed) == (0, "")


def test_an_interrupt_keeps_what_is_done(
    relief_pair: GearPair, drive_teeth: tuple[ToothCompliance, ToothCompliance]
) -> None:
    def stop(_what: str, done: int, _total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    found = loaded_contact(relief_pair, "drive", [1e4], *drive_teeth, positions=9, progress=stop)
    assert not found.complete
    assert len(found.cases[0].positions) == 2


def test_coast_under_errors_of_mounting_keeps_the_laws(
    relief_pair: GearPair, compliance_folder: Path
) -> None:
    """The other flanks, mounted wrong: moments, signs and shares hold as they do for drive."""
    members = (
        tooth_compliance(relief_pair.pinion, "convex", elements=QUICK, cache=compliance_folder),
        tooth_compliance(relief_pair.wheel, "concave", elements=QUICK, cache=compliance_folder),
    )
    error = Misalignment(0.05, 0.02, -0.03, 2e-4)
    found = loaded_contact(
        relief_pair, "coast", [6e4], *members, positions=5, misalignment=error
    ).cases[0]
    for at in found.positions:
        assert at.outcome is Outcome.OK
        assert abs(at.pinion_wrench[5]) == pytest.approx(6e4, rel=1e-9)
        assert abs(at.wheel_wrench[5]) == pytest.approx(at.wheel_torque, rel=1e-9)
        assert sum(p.share for p in at.pairs) == pytest.approx(1.0, abs=1e-9)
        assert all(p.pressure.min() >= 0.0 for p in at.pairs)
        assert at.transmission_error < at.unloaded  # the wheel lags


def test_drive_of_a_mirrored_pair_under_errors_is_the_drive_of_the_pair(
    relief_pair: GearPair,
    drive_teeth: tuple[ToothCompliance, ToothCompliance],
    compliance_folder: Path,
) -> None:
    error = Misalignment(0.05, 0.02, -0.03, 2e-4)
    mirrored = build(replace(TABLE_1, tip_relief=RELIEF, pinion_hand="right"))
    members = (
        tooth_compliance(mirrored.pinion, "concave", elements=QUICK, cache=compliance_folder),
        tooth_compliance(mirrored.wheel, "convex", elements=QUICK, cache=compliance_folder),
    )
    one, other = (
        loaded_contact(pair, "drive", [6e4], *teeth, positions=5, misalignment=error).cases[0]
        for pair, teeth in ((relief_pair, drive_teeth), (mirrored, members))
    )
    for a, b in zip(one.positions, other.positions, strict=True):
        assert b.rotation == pytest.approx(a.rotation, rel=1e-3)
        assert [p.share for p in b.pairs] == pytest.approx([p.share for p in a.pairs], abs=3e-3)
        np.testing.assert_allclose(
            b.pinion_wrench, a.pinion_wrench * [1, -1, 1, -1, 1, -1], rtol=2e-3, atol=5.0
        )


def test_a_torque_beyond_all_measure_is_told(
    relief_pair: GearPair, drive_teeth: tuple[ToothCompliance, ToothCompliance]
) -> None:
    """200 times the design's: edges bound the contacts, which is an outcome, and where it begins is told."""
    found = loaded_contact(relief_pair, "drive", [11e4, 2.2e7], *drive_teeth, positions=5)
    light, far = found.cases
    assert all(at.outcome is Outcome.OK for at in light.positions)
    assert light.leaves_at == 0.0
    assert all(at.outcome is Outcome.LEFT_FLANKS for at in far.positions)
    (words,) = far.faults
    assert "22000 N m" in words
    assert "left the flanks" in words
    assert f"{far.leaves_at * 1e-3:.2g} N m" in words
    shares = [at(found, torque).bounded_by_edges for torque in (11e4, far.leaves_at, 2.2e7)]
    assert shares[0] < 0.1
    assert shares[1] == pytest.approx(0.5, abs=0.05)
    assert shares[2] > 0.7


def test_a_light_contact_is_bounded_by_flanks_that_part(loaded: LoadedContact) -> None:
    assert at(loaded, TORQUES[0]).bounded_by_edges == 0.0


@pytest.mark.parametrize("torque", [3e4, 11e4])
def test_the_arc_of_contact_is_the_mean_number_of_pairs(
    relief_pair: GearPair, drive_teeth: tuple[ToothCompliance, ToothCompliance], torque: float
) -> None:
    """Read between positions, eight a pitch find it within 0.05; forty count it within one of them."""

    def case(positions: int) -> LoadCase:
        return loaded_contact(
            relief_pair, "drive", [torque], *drive_teeth, positions=positions
        ).cases[0]

    fine, few = case(81), case(17)
    assert fine.arc_of_contact == pytest.approx(fine.contact_ratio, abs=1.0 / 40.0)
    assert few.arc_of_contact == pytest.approx(fine.arc_of_contact, abs=0.06)


@pytest.mark.slow
def test_load_beside_an_end_hardly_depends_on_the_elements(
    loaded: LoadedContact, relief_pair: GearPair, compliance_folder: Path
) -> None:
    """A pair alone across the wheel's heel: force on the last millimetre, with images beyond the ends, within 3 %."""
    fine = Elements(along=28, profile=10, fillet=2, through=4, below=2, rim=2)
    members = (
        tooth_compliance(relief_pair.pinion, "concave", elements=fine, cache=compliance_folder),
        tooth_compliance(relief_pair.wheel, "convex", elements=fine, cache=compliance_folder),
    )
    met = meeting(loaded.unloaded, len(loaded.unloaded.phi) // 2, 2)
    assert met is not None
    forces = []
    for teeth in (loaded.teeth, replace(loaded.teeth, pinion=members[0], wheel=members[1])):
        found = position_contact([met], teeth, 4e4)
        beside = found.patches[0].edges[:, EDGES.index("wheel heel")] < 1.0
        forces.append(found.solution.force[beside].sum())
    assert forces[0] == pytest.approx(forces[1], rel=0.03)
    assert forces[0] > 1000.0


def test_the_range_between_positions_is_that_of_a_smooth_curve() -> None:
    """Six samples of a period find a sine's range within 2 %, its doubt covers the error; samples alone miss 13 %."""
    angle = np.arange(6) / 6.0 * 2.0 * np.pi
    made = _spline_range(np.sin(angle + 0.1))
    assert made == pytest.approx(2.0, rel=0.02)
    assert np.ptp(np.sin(angle)) < 0.87 * 2.0
    assert _spline_range(np.sin(2.0 * np.pi * np.arange(24) / 24.0 + 0.1)) == pytest.approx(
        2.0, rel=2e-4
    )
