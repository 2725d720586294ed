"""Contact of both members in CalculiX: the model's placing, its files, and the loaded contact against it."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hypoid.contact import Sampling, angle_field, unloaded_contact
from hypoid.geometry import DesignError
from hypoid.io import contact_text, read_contact, write_contact
from hypoid.io._calculix import STIFFNESS
from hypoid.load import (
    ContactAnswer,
    ContactModel,
    Elements,
    PairAnswer,
    PairLoad,
    ToothCompliance,
    contact_model,
    hat_widths,
    loaded_contact,
    tooth_compliance,
)
from hypoid.load._contact_model import PAIRS, PER_PITCH, _lead, _mesh, _placed
from hypoid.pair import Direction, GearPair
from hypoid.solid import face_nodes, hex_mesh

TORQUE = 30e3  # N mm: three pairs bear
KEPT = Path(__file__).parent / "calculix_contact.json"
FINER = Path(__file__).parent / "calculix_finer.json"
ANSWERS = ["kept", "fresh"] if shutil.which("ccx") else ["kept"]
ROUGH = Elements(along=8, profile=5, fillet=2, through=2, below=1, rim=1)


@pytest.mark.parametrize(
    ("name", "direction"), [("relief", "drive"), ("relief", "coast"), ("right-hand", "drive")]
)
def test_placed_wheel_just_touches_the_pinion(
    variant: Callable[[str], GearPair], name: str, direction: Direction
) -> None:
    """No node of the wheel's flanks is in the pinion's metal, one is within micrometres of it: pair by pair."""
    pair = variant(name)
    sampling = Sampling(positions_per_pitch=PER_PITCH, pairs=PAIRS)
    unloaded = unloaded_contact(pair, direction, None, sampling)
    pinion, wheel = pair.mates(direction)
    position = 0.03
    mesh = hex_mesh(pair.wheel, teeth=3, along=24, profile=8, fillet=2, through=1, below=1, rim=1)
    nodes = mesh.nodes[np.unique(mesh.face_nodes(f"{wheel.side}_flank"))]
    placed = _placed(unloaded, position, nodes, 0.0)
    z, rho = placed[:, 2], np.hypot(placed[:, 0], placed[:, 1])
    distance, height = pinion.cone.cone_distance_height(z, rho)
    there = np.asarray(angle_field(pinion).holds(distance, height))  # not its fillet
    exact = pinion.at(z[there], rho[there])
    ok = exact.ok
    # about the axis the pinion's tooth is met a whole number of pitches on
    turn = np.arctan2(placed[there, 1], placed[there, 0])[ok]
    turn -= np.arctan2(exact.position[ok, 1], exact.position[ok, 0])
    pitch = 2.0 * np.pi / pair.pinion.teeth
    away = turn - pitch * np.round(turn / pitch)
    x, n = exact.position[ok], exact.normal[ok]
    gap = away * (x[:, 0] * n[:, 1] - x[:, 1] * n[:, 0])
    near = np.abs(gap) < 0.1
    assert near.sum() > 50
    assert gap[near].min() > -1e-4
    assert gap[near].min() < 6e-3


def test_lead_between_positions_is_that_of_a_finer_contact(relief_pair: GearPair) -> None:
    coarse, fine = (
        unloaded_contact(relief_pair, "drive", None, Sampling(positions_per_pitch=n, pairs=PAIRS))
        for n in (PER_PITCH, 3 * PER_PITCH)
    )
    at = len(fine.phi) // 2 + 1
    expected = fine.curve[at - 3 * PER_PITCH * np.array([-1, 0, 1])]
    found = [_lead(coarse, float(fine.phi[at]), k) for k in (-1, 0, 1)]
    np.testing.assert_allclose(found, expected, atol=2e-8)


def test_faces_lie_on_the_exact_flank_however_few_are_asked_for(relief_pair: GearPair) -> None:
    """The pinion's flank winds far about its axis: eight elements along it would miss it by micrometres."""
    _, sizes, error = _mesh(relief_pair.pinion, "concave", 1, ROUGH)
    assert sizes.along > 2 * ROUGH.along
    assert error < 1e-3


@pytest.fixture(scope="module")
def model(relief_pair: GearPair, drive_teeth: tuple[ToothCompliance, ToothCompliance]) -> Any:
    return contact_model(
        relief_pair, "drive", TORQUE, teeth=5, elements=ROUGH, compliance=drive_teeth
    )


def test_too_small_a_sector_and_bad_input_are_told(
    relief_pair: GearPair, drive_teeth: tuple[ToothCompliance, ToothCompliance]
) -> None:
    with pytest.raises(DesignError, match="at least 5: pairs -2 to 2 bear load"):
        contact_model(relief_pair, "drive", 11e4, teeth=3, compliance=drive_teeth)
    with pytest.raises(DesignError) as told:
        contact_model(relief_pair, "drive", -1.0, teeth=0, position=2.0)
    assert [p.path for p in told.value.problems] == ["torque", "position", "teeth"]


def test_finer_elements_stand_where_pairs_bear(
    relief_pair: GearPair,
    model: ContactModel,
    drive_teeth: tuple[ToothCompliance, ToothCompliance],
) -> None:
    """On the exact flank, but for nodes that hang on large elements; the rest of the model is as it was."""
    finer = contact_model(
        relief_pair, "drive", TORQUE, teeth=5, elements=ROUGH, finer=3, compliance=drive_teeth
    )
    assert (finer.guess, finer.elements) == (model.guess, model.elements)
    faces = {met.pair: met for met in finer.pairs}
    for met in model.pairs:
        if met.pair not in (-1, 0, 1):
            assert len(faces[met.pair].wheel_faces) == len(met.wheel_faces)
    for mesh, flank, split in zip(
        (finer.pinion, finer.wheel), relief_pair.mates("drive"), finer.split, strict=True
    ):
        assert split is not None
        member = "pinion_faces" if flank is relief_pair.mates("drive")[0] else "wheel_faces"
        for pair in (-1, 0, 1):
            own = getattr(faces[pair], member)
            assert split.split[own[:, 0]].all()
            nodes = np.setdiff1d(face_nodes(mesh.elements, own), split.hung)
            x, y, z = mesh.nodes[nodes].T
            exact = flank.at(z, np.hypot(x, y))
            turn = np.arctan2(y, x) - np.arctan2(exact.position[:, 1], exact.position[:, 0])
            away = turn - mesh.pitch * np.round(turn / mesh.pitch)
            there = exact.ok  # by rounding some stand above the tip
            assert there.mean() > 0.9
            assert np.abs(away * np.hypot(x, y))[there].max() < 1e-9
    text = contact_text(finer)
    assert text.count("*EQUATION") == 2
    with pytest.raises(DesignError, match="finer"):
        contact_model(relief_pair, "drive", TORQUE, finer=0, compliance=drive_teeth)


def test_what_is_no_finished_run_is_told(model: ContactModel, tmp_path: Path) -> None:
    with pytest.raises(DesignError, match="cannot be read"):
        read_contact(tmp_path / "none.dat", model)
    (tmp_path / "cut.dat").write_text("\n displacements (vx,vy,vz) for set ROTATION and time 1.\n")
    with pytest.raises(DesignError, match="no displacements, rotation, pair -2"):
        read_contact(tmp_path / "cut.dat", model)
    with pytest.raises(DesignError, match=r"a \.inp file"):
        write_contact(model, tmp_path / "model.txt")


def kept_answer(model: ContactModel, file: Path, finer: int) -> ContactAnswer:
    """CalculiX's answer as it was once (`benchmarks/calculix_check.py --keep`), to this model and no other."""
    kept = json.loads(file.read_text())
    assert kept.pop("finer") == finer
    assert kept.pop("elements") == [asdict(sizes) for sizes in model.elements]
    assert kept.pop("by")
    pairs = tuple(
        PairAnswer(**{**p, **{k: np.array(p[k]) for k in ("hats", "column_force")}})
        for p in kept.pop("pairs")
    )
    return ContactAnswer(**{**kept, "distance": np.array(kept["distance"])}, pairs=pairs)


@pytest.fixture(scope="module")
def fresh(model: ContactModel, tmp_path_factory: pytest.TempPathFactory) -> ContactAnswer:
    """CalculiX's answer now."""
    folder = tmp_path_factory.mktemp("contact")
    write_contact(model, folder / "contact.inp")
    subprocess.run(["ccx", "contact"], cwd=folder, check=True, capture_output=True, timeout=900)
    return read_contact(folder / "contact.dat", model)


@pytest.fixture(scope="module", params=ANSWERS)
def answer(request: pytest.FixtureRequest, model: ContactModel) -> ContactAnswer:
    """What CalculiX said once, and where it is installed what it says now."""
    if request.param == "kept":
        return kept_answer(model, KEPT, 1)
    return request.getfixturevalue("fresh")


@pytest.fixture(scope="module")
def ours(relief_pair: GearPair, model: ContactModel, compliance_folder: Path) -> Any:
    """The loaded contact with the same elements, at the same position."""
    members = [
        tooth_compliance(member, side, elements=sizes, cache=compliance_folder)
        for member, side, sizes in zip(
            (relief_pair.pinion, relief_pair.wheel),
            ("concave", "convex"),
            model.elements,
            strict=True,
        )
    ]
    found = loaded_contact(relief_pair, "drive", [TORQUE], *members, positions=5)
    position = found.cases[0].positions[2]
    assert position.pinion_angle == 0.0
    return position


@pytest.mark.slow
def test_calculix_is_in_equilibrium(answer: ContactAnswer) -> None:
    """The contact's moments are the torque; nodal forces by our stiffness are its contact forces."""
    assert answer.torque == pytest.approx(TORQUE, rel=1e-6)
    assert abs(answer.balance) < 2e-3
    for pair in answer.pairs:
        assert pair.column_force.sum() == pytest.approx(pair.force, rel=2e-3)


@pytest.mark.slow
def test_load_sharing_of_three_pairs_against_calculix(answer: ContactAnswer, ours: Any) -> None:
    """Within 3 points of the torque, as the method's page asks."""
    theirs = {p.pair: p.share for p in answer.pairs}
    assert {-1, 0, 1} <= set(theirs)
    for pair in ours.pairs:
        assert theirs.get(pair.pair, 0.0) == pytest.approx(pair.share, abs=0.03)


@pytest.mark.slow
def test_line_load_against_calculix(answer: ContactAnswer, ours: Any) -> None:
    """Force on each column of the wheel's hats, and where the load's middle is along the face.

    The contact's points stand 1.5 mm apart along these elements and find the load in spots, so within a tenth of a
    pair's force; finer runs are on the validation page.
    """
    width = hat_widths(answer.distance)
    for theirs in answer.pairs:
        load: PairLoad = next(p for p in ours.pairs if p.pair == theirs.pair)
        columns = load.wheel_hats.reshape(len(width), -1).sum(axis=1)
        np.testing.assert_allclose(theirs.column_force, columns, atol=0.1 * load.force)
        np.testing.assert_allclose(answer.line_load(theirs.pair) @ width, theirs.force, rtol=2e-3)
        middle = answer.distance @ theirs.column_force / theirs.column_force.sum()
        assert middle == pytest.approx(answer.distance @ columns / columns.sum(), abs=0.6)


@pytest.mark.slow
def test_rotation_against_calculix(answer: ContactAnswer, ours: Any) -> None:
    """Elements wider than the contact are stiffer: by 21 % here, by less with finer ones."""
    assert 0.75 * ours.rotation < answer.rotation < ours.rotation


@pytest.mark.slow
def test_finer_elements_come_near_in_all(model: ContactModel, ours: Any) -> None:
    """Six elements for one where pairs bear, 57 000 nodes, once run: rotation, shares and line loads."""
    answer = kept_answer(model, FINER, 6)
    overlap = sum(float(p.pressure**2 @ p.area) for p in ours.pairs) / (STIFFNESS * TORQUE)
    assert answer.rotation == pytest.approx(ours.rotation + overlap, rel=0.05)
    width = hat_widths(answer.distance)
    for theirs in answer.pairs:
        load: PairLoad = next(p for p in ours.pairs if p.pair == theirs.pair)
        assert theirs.share == pytest.approx(load.share, abs=0.01)
        line = load.wheel_hats.reshape(len(width), -1).sum(axis=1) / width
        np.testing.assert_allclose(answer.line_load(theirs.pair), line, atol=0.035 * line.max())
