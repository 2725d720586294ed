"""AGMA 929-B22, annex C: spiral bevel 14/39, face milled with spread blades, generated, completing.

Values reach us through the self-test of a public transcription (repository afuentesaz/AGMAStandards).
"""

from __future__ import annotations

from dataclasses import replace
from math import radians

import pytest

from hypoid.blank import (
    BlankRequest,
    CrownGearTooth,
    PairBlank,
    SlotGeometry,
    crown_gear_tooth,
    edge_radii,
    iso_blank,
    slot_geometry,
)
from hypoid.geometry import DesignError

TOLERANCE = 3e-5  # inputs carry five digits


@pytest.fixture(scope="module")
def annex_c() -> SlotGeometry:
    return SlotGeometry(
        teeth=(14, 39),
        mean_normal_module=3.21331,
        pitch_angles=(radians(19.7468), radians(70.2532)),
        mean_cone_distances=(81.273, 81.273),
        outer_cone_distances=(93.973, 93.973),
        face_widths=(25.4, 25.4),
        offset_angle=0.0,
        dedendum_angles=(radians(2.2259), radians(6.4935)),
        addenda=(4.83648, 1.58937),
        dedenda=(2.55337, 5.80048),
        clearance=0.964,
        thicknesses=(6.2788, 3.67226),
        pressure_angles=(radians(20.0), radians(20.0)),
        tooth=CrownGearTooth(81.273, radians(35.0), radians(70.2532), 39, 114.3, 0, 0.0),
    )


def test_slots_and_blade_points(annex_c: SlotGeometry) -> None:
    assert annex_c.backlash == pytest.approx(0.1527, abs=TOLERANCE)
    assert annex_c.slots[0] == pytest.approx((1.87892, 1.95742, 1.87263), abs=TOLERANCE)
    assert annex_c.slots[1] == pytest.approx((2.20026,) * 3, abs=TOLERANCE)
    assert annex_c.blade_points() == pytest.approx((0.96132, 1.12513), abs=TOLERANCE)


def test_top_lands(annex_c: SlotGeometry) -> None:
    pinion, wheel = annex_c.top_lands()
    assert pinion == pytest.approx((2.29128, 1.83117, 1.36288), abs=TOLERANCE)
    assert wheel == pytest.approx((2.45566, 2.50681, 2.39535), abs=TOLERANCE)


def test_edge_radii(annex_c: SlotGeometry) -> None:
    pinion, wheel = edge_radii(annex_c)
    assert pinion.no_interference == pytest.approx(1.23193, abs=TOLERANCE)
    assert wheel.no_interference == pytest.approx(2.27601, abs=TOLERANCE)
    assert (pinion.manufacture, wheel.manufacture) == pytest.approx(
        (1.08727, 1.32122), abs=TOLERANCE
    )
    assert (pinion.no_mutilation, wheel.no_mutilation) == pytest.approx(
        (1.92869, 2.20626), abs=TOLERANCE
    )
    assert (pinion.largest, wheel.largest) == pytest.approx((1.08727, 1.32122), abs=TOLERANCE)


def test_a_designed_blank_agrees_with_its_own_thickness_and_land() -> None:
    """Slots, teeth and backlash of a blank by ISO 23509 fill its pitch; lands as the blank estimates."""
    request = BlankRequest(
        0, 14, 39, radians(90.0), 0.0, 25.4, 114.3, radians(35.0),
        wheel_outer_diameter=176.893, taper="duplex",
    )  # fmt: skip
    blank = iso_blank(request)
    slots = slot_geometry(blank, crown_gear_tooth(blank.cones, 114.3, 0))
    depth = sum(slots.dedenda)
    filled = slots.slots[0][1] + slots.slots[1][1] + depth * slots.flare
    assert filled == pytest.approx(slots.pitch, abs=1e-9)
    lands, own = slots.top_lands(), (blank.pinion.top_land, blank.wheel.top_land)
    for found, estimate in zip(lands, own, strict=True):
        assert estimate is not None
        assert found[1] == pytest.approx(estimate.mean, abs=1e-9)
        # towards the ends the estimate lets the thickness grow as the pitch, not as the slots leave it
        assert found == pytest.approx((estimate.inner, estimate.mean, estimate.outer), rel=0.2)


def test_a_form_cut_wheel_has_straight_sides_and_a_plane_root() -> None:
    request = BlankRequest(
        1,
        13,
        42,
        radians(90.0),
        15.0,
        30.0,
        63.5,
        radians(50.0),
        "pinion",
        wheel_outer_diameter=170.0,
    )
    blank = iso_blank(request)
    tooth = crown_gear_tooth(blank.cones, 63.5, 0)
    formed = slot_geometry(blank, tooth, wheel_generated=False)
    generated = slot_geometry(blank, tooth)
    for crown in formed.ends[1]:
        assert formed.wheel_dedendum(crown) <= generated.wheel_dedendum(crown) + 1e-12
    middle = formed.mean_cone_distances[1]
    assert formed.wheel_dedendum(middle) == pytest.approx(
        generated.wheel_dedendum(middle), abs=1e-12
    )
    # a straight-sided tooth is wider at its tip than an involute one of the same foot
    assert formed.top_lands()[1][1] > generated.top_lands()[1][1] - 0.05


def test_a_blank_as_drawn_has_no_slots(paper: PairBlank) -> None:
    tooth = crown_gear_tooth(paper.cones, 100.0, 5)
    with pytest.raises(DesignError):
        slot_geometry(replace(paper, depths=None), tooth)
