"""Section 6.3 of the 2022 paper and what its notes measured: contact of the 6 x 73 pair."""

from __future__ import annotations

from math import degrees, pi, radians
from typing import Any

import numpy as np
import pytest

from hypoid.contact import Sampling, UnloadedContact, ease_off, pattern, tip_interference
from hypoid.contact import unloaded_contact as contact_of
from hypoid.pair import GearPair

ARCSEC = pi / 180 / 3600
BOTH = pytest.mark.parametrize("direction", ["drive", "coast"])


@pytest.fixture(scope="module")
def contacts(variant: Any) -> Any:
    made: dict[tuple[str, str], UnloadedContact] = {}

    def one(name: str, direction: Any) -> UnloadedContact:
        key = (name, direction)
        if key not in made:
            made[key] = contact_of(variant(name), direction)
        return made[key]

    return one


@BOTH
def test_conjugate_no_transmission_error(contacts: Any, direction: str) -> None:
    """Figs. 7(b) and 8(b): zero; here below 1e-6 arcsec."""
    contact = contacts("plain", direction)
    assert contact.touched
    assert not contact.edge_contact
    assert np.abs(contact.transmission_error).max() < 1e-6 * ARCSEC
    assert np.abs(contact.points.lead[contact.leading]).max() < 1e-6 * ARCSEC


@BOTH
def test_contact_at_the_pitch_point_at_pinion_angle_zero(contacts: Any, direction: str) -> None:
    contact = contacts("plain", direction)
    distance, height = contact.contact_point
    assert distance == pytest.approx(contact.pair.blank.pinion.mean_cone_distance, abs=1e-9)
    assert height == pytest.approx(0.0, abs=1e-9)


@BOTH
def test_neighbouring_pairs_nearly_touch(contacts: Any, direction: str) -> None:
    """Notes: pairs +-1 within 0.9 um and pairs +-2 within 4.5-7.9 um of touching.

    Normal gap of each pair where it comes nearest at pinion angle zero.
    """
    contact = contacts("plain", direction)
    n, middle = contact.sampling.positions_per_pitch, len(contact.phi) // 2
    from hypoid.contact._pattern import _levers  # the lever of each node at one pinion angle

    gaps: dict[int, float] = {}
    for k in (-2, -1, 1, 2):
        index = middle - k * n
        lever = _levers(contact, np.full(contact.leads.shape[1], contact.phi[index]))[0]
        node = int(contact.leads[index].argmax())
        gaps[k] = float(-contact.curve[index] * lever[node] * 1e3)
    assert max(gaps[-1], gaps[1]) < 0.9
    assert min(gaps[-2], gaps[2]) > 4.0
    assert max(gaps[-2], gaps[2]) < 8.0


@pytest.mark.parametrize(("positions", "share"), [(20, 0.550), (40, 0.578), (80, 0.583)])
def test_pattern_share_against_positions(
    paper_pair: GearPair, positions: int, share: float
) -> None:
    """Methods of contact: 0.550 / 0.578 / 0.583 of the drive flank at 21 / 41 / 81 positions a pitch."""
    contact = contact_of(paper_pair, "drive", None, Sampling(positions_per_pitch=positions))
    assert pattern(contact, 0.0065).share == pytest.approx(share, abs=6e-3)


def test_wheel_tip_cuts_into_the_pinion_fillet(contacts: Any) -> None:
    """Notes, item 9: 2.6-2.7 um on both sides without relief, clear with 0.004/mm from the tip."""
    for direction in ("drive", "coast"):
        pinion_tip, wheel_tip = tip_interference(contacts("plain", direction))
        assert not pinion_tip.found
        assert 2.6e-3 <= wheel_tip.depth < 2.75e-3
        assert not any(cut.found for cut in tip_interference(contacts("relief", direction)))


@BOTH
def test_ease_off_of_a_conjugate_pair(contacts: Any, direction: str) -> None:
    """Nothing stands out of the conjugate; along the path it is touched; crowned lengthwise."""
    contact = contacts("plain", direction)
    ease = ease_off(contact)
    assert np.nanmin(ease.value) > -1e-9
    distance, height = contact.path
    column = np.abs(ease.distance[:, None] - distance).argmin(axis=0)
    row = np.abs(ease.height[:, column] - height).argmin(axis=0)
    assert np.nanmax(ease.value[row, column]) < 0.3e-3
    assert ease.lengthwise_crowning > 5e-3
    assert abs(ease.bias) > 5e-3  # the diagonal contact of Figs. 7 and 8


@BOTH
def test_relief_takes_material_off_the_tip_only(contacts: Any, direction: str) -> None:
    plain, relieved = (ease_off(contacts(name, direction)) for name in ("plain", "relief"))
    more = relieved.value - plain.value
    low = relieved.height < 0.3  # both reliefs begin 1.5 mm below a tip of 2.3765
    mate_low = relieved.height > -0.3
    assert np.nanmax(np.abs(more[low & mate_low])) < 2e-4
    assert np.nanmax(more) > 8e-3


def test_a_right_hand_pair_is_the_mirror_image(variant: Any) -> None:
    for direction in ("drive", "coast"):
        left, right = (
            contact_of(variant(name), direction, None, Sampling(positions_per_pitch=10))
            for name in ("plain", "right-hand")
        )
        np.testing.assert_allclose(right.curve, left.curve, atol=1e-13)
        np.testing.assert_allclose(right.path, left.path, atol=1e-9)


def test_rigid_contact_ratio_does_not_depend_on_the_sampling(paper_pair: GearPair) -> None:
    fine, coarse = (
        contact_of(paper_pair, "drive", None, Sampling(positions_per_pitch=n)) for n in (40, 20)
    )
    assert coarse.contact_ratio == pytest.approx(fine.contact_ratio, abs=1e-4)
    assert [degrees(a) for a in fine.transfer_points] == pytest.approx([-52.144, 53.261], abs=2e-3)
    assert radians(60) == pytest.approx(fine.pitch)
