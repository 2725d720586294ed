"""Backlash of mounted pairs, from the contacts of both sides."""

from __future__ import annotations

from dataclasses import replace

import pytest

import hypoid
from hypoid.contact import Misalignment, backlash, pair_backlash, unloaded_contact
from hypoid.design import SummarySheetSpec, build
from hypoid.geometry import DesignError
from hypoid.io import example_files, read_spec
from hypoid.pair import GearPair


def test_an_exact_pair_has_none(paper_pair: GearPair) -> None:
    """Gonzalez-Perez & Fuentes-Aznar 2022: both members' blades lie flank to flank at P."""
    drive, coast = (unloaded_contact(paper_pair, d) for d in ("drive", "coast"))
    for angle in (0.0, 0.3, -0.7):
        assert backlash(drive, coast, angle).mean_normal == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(("name", "share"), [("pinion", 6 / 73), ("wheel", 1.0)])
def test_a_thinner_tooth_gives_its_own_angle(paper_pair: GearPair, name: str, share: float) -> None:
    member = getattr(paper_pair, name)
    thin = replace(paper_pair, **{name: replace(member, stock_turn=-0.002)})
    found = pair_backlash(thin)
    assert found.wheel_angle == pytest.approx(0.002 * share, abs=1e-10)
    radius = 0.5 * paper_pair.wheel.blank.mean_pitch_diameter
    assert found.mean_transverse == pytest.approx(found.wheel_angle * radius)
    assert found.mean_normal < found.mean_transverse < found.outer_transverse


def test_withdrawing_either_member_opens_the_mesh(paper_pair: GearPair) -> None:
    for error in (Misalignment(pinion_axial=0.05), Misalignment(wheel_axial=0.05)):
        both = [unloaded_contact(paper_pair, d, error) for d in ("drive", "coast")]
        assert backlash(*both).mean_normal > 1e-3


def test_tsay_1993_has_too_little_room() -> None:
    """Notes on Tsay & Lin 1993: the corrected pair's backlash is negative by 0.25 to 0.6 mm."""
    file = next(f for f in example_files() if f.stem == "tsay-lin-1993")
    found = pair_backlash(hypoid.read(file))
    assert -0.6 < found.mean_normal < found.wheel_angle < 0.0
    assert -0.6 < found.outer_transverse < -0.25


def test_flanks_cut_one_by_one_are_divided_for_the_backlash_asked() -> None:
    """Lin, Tsay & Fong 1996: the pinion's flanks have settings of their own.

    To within the motion error: 28 arcsec on a radius of 63 mm are 8 um.
    """
    file = next(f for f in example_files() if f.stem == "lin-tsay-fong-1996")
    spec = read_spec(file)
    assert isinstance(spec, SummarySheetSpec)
    for asked in (0.1, 0.2):
        found = pair_backlash(build(replace(spec, normal_backlash=asked)))
        assert found.mean_normal == pytest.approx(asked, abs=8e-3)


def test_a_slot_cut_at_once_leaves_nothing_to_divide() -> None:
    file = next(f for f in example_files() if f.stem == "tsay-lin-1993")
    spec = read_spec(file)
    assert isinstance(spec, SummarySheetSpec)
    with pytest.raises(DesignError, match="normal_backlash"):
        build(replace(spec, normal_backlash=0.1))
