"""Face-milled pairs from their blank: wheel in closed form, pinion exactly conjugate or to a target."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import degrees, pi, radians
from typing import Any

import numpy as np
import pytest

from hypoid.blank import BlankRequest, TaperAngles, TypeII, iso_blank
from hypoid.contact import backlash, ease_off, unloaded_contact
from hypoid.design import (
    EaseOffTarget,
    MilledDesign,
    MilledRequest,
    MotionTarget,
    PinionLimits,
    build,
    design_milled,
)
from hypoid.design._conjugate import conjugate
from hypoid.design._milled_design import _pinion_edge
from hypoid.design._milled_wheel import milled_wheel, pitch_cone
from hypoid.design._pinion_fit import _alone, _evened
from hypoid.design._pinion_model import pinion_model
from hypoid.design._pinion_start import conjugate_places, conjugate_start
from hypoid.design._pinion_task import PinionTask, pinion_task
from hypoid.design._settings_model import NAMES, flank_at
from hypoid.flank import flank_angles
from hypoid.geometry import DesignError
from hypoid.pair import GearPair

BLANK = BlankRequest(  # sample F.3 of ISO 23509
    1, 13, 42, pi / 2, 15.0, 30.0, 63.5, radians(50.0), "pinion",
    wheel_outer_diameter=170.0, tooth=TypeII(0.35, 2.0, 0.125, 0.1),
    taper=TaperAngles(radians(1.0), radians(4.0)),
)  # fmt: skip
REQUEST = MilledRequest("13 x 42", "", (), BLANK)
SIDES: tuple[Any, ...] = ("concave", "convex")


@cache
def designed(wheel: Any, pinion: Any) -> tuple[MilledDesign, GearPair]:
    made = design_milled(replace(REQUEST, wheel_method=wheel, pinion_method=pinion))
    return made, build(made.spec)


@pytest.mark.parametrize("hand", ["left", "right"])
def test_formate_wheel_has_the_blanks_angles_and_tooth_at_the_mean_point(hand: Any) -> None:
    """From the exact flanks: 17.747 and 22.253 deg, 38.610 deg spiral, s_mn2."""
    request = replace(REQUEST, blank=replace(BLANK, pinion_hand=hand))
    blank = iso_blank(request.blank)
    wheel = milled_wheel(request, blank)
    at = blank.wheel.mean_cone_distance
    concave, convex = (flank_angles(wheel.flank(side), at) for side in SIDES)
    own = blank.pressure_angles
    assert own is not None
    assert concave.pressure == pytest.approx(own.coast, abs=1e-9)
    assert convex.pressure == pytest.approx(own.drive, abs=1e-9)
    spiral = 0.5 * (concave.spiral + convex.spiral)
    assert spiral == pytest.approx(blank.wheel.mean_spiral_angle, abs=1e-9)
    angles = [float(wheel.flank(side).left_angle([at], [0.0])[0]) for side in SIDES]
    slot = (angles[0] - angles[1]) * 0.5 * blank.wheel.mean_pitch_diameter
    tooth = 2.0 * pi / 42 * 0.5 * blank.wheel.mean_pitch_diameter - slot
    assert blank.wheel.thickness is not None
    assert tooth * np.cos(spiral) == pytest.approx(blank.wheel.thickness.mean_normal, abs=1e-8)


def test_generated_wheel_has_the_blanks_angles_within_a_few_minutes() -> None:
    request = replace(REQUEST, wheel_method="generated")
    blank = iso_blank(BLANK)
    wheel = milled_wheel(request, blank)
    own = blank.pressure_angles
    assert own is not None
    for side, pressure in (("concave", own.coast), ("convex", own.drive)):
        found = flank_angles(wheel.flank(side), blank.wheel.mean_cone_distance)  # pyright: ignore
        assert degrees(found.pressure) == pytest.approx(degrees(pressure), abs=0.01)
        assert degrees(found.spiral) == pytest.approx(38.61, abs=0.7)  # each side, about the mean


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(
    ("sigma", "offset"), [(90.0, 15.0), (90.0, 0.0), (75.0, 10.0), (100.0, 8.0)]
)
def test_the_start_is_the_form_cut_wheels_exact_conjugate(
    side: Any, sigma: float, offset: float
) -> None:
    """Same cutter axis, blades of the opposite kind, cradle along the wheel's axis: zero ease-off."""
    given = replace(BLANK, shaft_angle=radians(sigma), offset=offset, method=1 if offset else 0)
    request = replace(REQUEST, blank=given)
    blank = iso_blank(given)
    wheel = milled_wheel(request, blank)
    cone = pitch_cone(blank, "pinion")
    mate = wheel.flank("convex" if side == "concave" else "concave")
    found = conjugate(blank, mate, cone)
    start = conjugate_start(wheel, blank, side)
    flat = EaseOffTarget(0.0, 0.0)
    model = pinion_model(side, found, blank, cone, start, conjugate_places(found, start), flat, 0.0)
    assert model is not None
    seen = model.look(start, model.start_memory)
    assert seen is not None
    assert model.there.mean() > 0.6
    assert np.abs(seen.ease_off[model.there]).max() < 1e-10


def test_the_conjugate_start_transmits_uniformly() -> None:
    """Through the ordinary way, build and contact: no transmission error on the drive side."""
    made, _ = designed("formate", "tilt")
    from hypoid.design._designed_sheet import sheet_dials
    from hypoid.design._flank_fit import plain_settings
    from hypoid.design._settings_model import INDEX

    start = conjugate_start(made.wheel, made.blank, "concave")
    apex = made.blank.pinion.pitch_apex_beyond_crossing_point
    flank = made.spec.pinion.concave
    blade = replace(
        flank.blade,
        point_radius=float(start[INDEX["point_radius"]]),
        angle=float(start[INDEX["blade_angle"]]),
    )
    exact = replace(flank, dials=sheet_dials(plain_settings(start), apex), blade=blade)
    spec = replace(made.spec, pinion=replace(made.spec.pinion, concave=exact))
    contact = unloaded_contact(build(spec), "drive")
    middle = len(contact.phi) // 2
    near = contact.curve[middle - 8 : middle + 9]
    assert (
        np.ptp(near) < 1e-7
    )  # contact is a line, which has no point to refine: the grid's own noise


@pytest.mark.parametrize(
    ("wheel", "pinion", "largest"),
    [
        ("formate", "tilt", 5.0),
        ("formate", "modified-roll", 5.0),
        ("formate", "helical", 5.0),
        ("formate", "universal", 3.0),  # 0.8 before the tips' arc had its room below the flank
        ("generated", "tilt", 5.0),
        ("generated", "modified-roll", 2.0),
    ],
)
def test_the_asked_ease_off_is_met(wheel: str, pinion: str, largest: float) -> None:
    """The fit's own residual, and the ease-off that the built pair shows by another way."""
    made, pair = designed(wheel, pinion)
    for side, direction in (("concave", "drive"), ("convex", "coast")):
        fit = made.fits[side]  # pyright: ignore[reportArgumentType]
        assert 1e3 * fit.largest < largest
        contact = unloaded_contact(pair, direction)  # pyright: ignore[reportArgumentType]
        assert not contact.edge_contact
        assert np.isfinite(contact.peak_to_peak)
        seen = ease_off(contact)
        # contact counts profile crowning over half the active depth, the target over half the working one
        deep = (
            0.5
            * float((seen.height[-1] - seen.height[0]).mean())
            / (0.5 * made.blank.depths.working_depth)
        )  # pyright: ignore
        assert seen.lengthwise_crowning == pytest.approx(0.015, abs=0.003)
        assert seen.profile_crowning == pytest.approx(0.010 * deep**2, abs=0.0045)
        assert abs(seen.bias) < 0.003
        assert seen.residual < 0.002
    assert not pair.faults


def test_no_tilt_where_the_method_has_none() -> None:
    """Then the tips run along the root cone: the fit finds the root angle by itself."""
    made, _ = designed("formate", "modified-roll")
    for fit in made.fits.values():
        assert fit.settings.tilt_angle == 0.0
        assert degrees(fit.settings.machine_root_angle) == pytest.approx(
            degrees(made.blank.pinion.root_angle), abs=0.05
        )


def test_a_method_that_falls_short_says_how_far_and_what_would_help() -> None:
    made, _ = designed("formate", "generated")
    (first, *_) = made.faults
    assert "um from its target" in first
    assert "these would help" in first


@pytest.mark.parametrize(("method", "ratio"), [("universal", 1.0), ("tilt", 0.66)])
def test_transmission_error_and_pattern_as_asked(method: str, ratio: float) -> None:
    """54 and 57 urad within 2 %, by the contact of the flanks themselves.

    On universal motions no edge leads; with tilt alone edges do over a third of the drive side's pitch.
    """
    request = replace(
        REQUEST,
        pinion_method=method,  # pyright: ignore[reportArgumentType]
        drive=MotionTarget(54e-6, 0.6),
        coast=MotionTarget(57e-6, 0.6),
    )
    pair = build(design_milled(request).spec)
    for direction, asked in (("drive", 54e-6), ("coast", 57e-6)):
        contact = unloaded_contact(pair, direction)  # pyright: ignore[reportArgumentType]
        assert contact.peak_to_peak == pytest.approx(asked, rel=0.02)
        if direction == "drive":
            assert contact.contact_ratio == pytest.approx(ratio, abs=0.01)
        if method == "universal":
            assert not contact.edge_contact


@pytest.mark.parametrize("wheel", ["formate", "generated"])
def test_one_setting_cuts_both_flanks_with_the_backlash_that_is_asked(wheel: str) -> None:
    """Duplex-helical: one head and one setting; backlash from the contact of both flanks; no stock division."""
    request = replace(
        REQUEST,
        blank=replace(BLANK, taper="duplex"),
        wheel_method=wheel,  # pyright: ignore[reportArgumentType]
        pinion_method="duplex-helical",
    )
    made = design_milled(request)
    assert max(fit.largest for fit in made.fits.values()) < 0.015
    pair = build(made.spec)
    pinion = pair.pinion
    assert pinion.concave.settings == pinion.convex.settings
    assert pinion.heads["concave"] is pinion.heads["convex"]
    assert pinion.stock_turn == 0.0
    drive, coast = (unloaded_contact(pair, d) for d in ("drive", "coast"))  # pyright: ignore
    assert backlash(drive, coast).mean_normal == pytest.approx(0.15, abs=0.005)
    # beside a form-cut wheel the fit is led to its tolerance of 5 um, and an edge leads for 0.01 of the drive's pitch
    assert drive.contact_ratio > 0.98
    assert not coast.edge_contact
    assert coast.interior[len(coast.phi) // 2]


def test_a_fixed_setting_has_the_blanks_root_cone() -> None:
    """The tips run in the root plane whatever the fit moves: the root is the blank's."""
    made, _ = designed("generated", "fixed-setting")
    for fit in made.fits.values():
        assert fit.settings.tilt_angle == 0.0
        assert fit.settings.machine_root_angle == pytest.approx(
            made.blank.pinion.root_angle, abs=1e-12
        )
        assert (
            np.abs(fit.root_error).max() < 5e-4
        )  # as far as the blank's root apex and its dedendum agree
        assert 1e3 * fit.largest < 2.0


def test_bounds_and_fixed_settings_hold_and_are_named() -> None:
    """Tilt may not pass 15 deg: it stands there, the fault says so; a machine's head goes to 30 deg."""
    limits = PinionLimits(ranges={"tilt_angle": (0.0, radians(15.0))})
    made = design_milled(replace(REQUEST, limits=limits))
    for fit in made.fits.values():
        assert degrees(fit.settings.tilt_angle) <= 15.0 + 1e-9
    assert "tilt_angle stands at its upper bound, 15 deg" in made.faults[0]
    limits = PinionLimits(fixed={"blank_offset": -16.0}, machine="gleason-122")
    made = design_milled(replace(REQUEST, limits=limits))
    for fit in made.fits.values():
        assert fit.settings.blank_offset == pytest.approx(16.0, abs=1e-12)  # chain's sign
        assert degrees(fit.settings.tilt_angle) < 30.0 + 1e-9
    limits = PinionLimits(ranges={"blank_offset": (-40.0, -20.0)})  # named in the sheet's sign
    made = design_milled(replace(REQUEST, limits=limits))
    for fit in made.fits.values():
        assert 20.0 - 1e-9 <= fit.settings.blank_offset <= 40.0
        assert "blank_offset stands at its upper bound, -20 mm" in fit.held


@pytest.mark.parametrize("spiral", [0.0, 6.0])
def test_low_spiral_angles(spiral: float) -> None:
    """Lines of contact along the tooth: the fit finds its places in all three parameters."""
    blank = replace(
        BLANK, method=0, offset=0.0, spiral_angle=radians(spiral), spiral_of="wheel", taper="standard",
        z1=16, z2=32, cutter_radius=60.0,
    )  # fmt: skip
    request = replace(
        REQUEST,
        blank=blank,
        wheel_method="generated",
        pinion_method="modified-roll",
        tolerance=0.01,
    )
    made = design_milled(request)
    assert max(fit.largest for fit in made.fits.values()) < request.tolerance
    pair = build(made.spec)
    for direction in ("drive", "coast"):
        contact = unloaded_contact(pair, direction)
        middle = len(contact.phi) // 2
        assert contact.interior[middle]


def test_jacobian_of_the_flank_by_every_entry() -> None:
    """n . dr/dp, and ds/dp of the edge parameter, against Richardson's differences of flanks found anew."""
    made, _ = designed("formate", "universal")
    fit = made.fits["concave"]
    found = conjugate(made.blank, made.wheel.convex, pitch_cone(made.blank, "pinion"))
    start = fit.vector
    at = np.flatnonzero(np.isfinite(fit.residual))[::7]
    z, rho = found.z[at], found.rho[at]
    places = [part[at] for part in fit.fit.look.memory[0][:3]]

    def look(vector: Any) -> Any:
        return flank_at(vector, -1.0, 1.0, 0.0, z, rho, *places)

    here = look(start)
    assert np.all(here[4] < 1e-10)
    count = len(NAMES)
    for k, name in enumerate(NAMES):
        if name == "blade_curvature":
            continue  # a straight blade's 1/R: in the same form, checked at another size below
        differences = []
        for h in (2e-4, 1e-4):
            up, down = start.copy(), start.copy()
            up[k] += h
            down[k] -= h
            ahead, behind = look(up), look(down)
            moved = (ahead[3] - behind[3]) / (2.0 * h) * here[5]
            differences.append(np.stack([moved, (ahead[0] - behind[0]) / (2.0 * h)]))
        exact = (4.0 * differences[1] - differences[0]) / 3.0
        seen = np.stack([here[7 + k], here[7 + count + k]])
        size = np.maximum(1e-3, np.abs(exact).max(axis=1, keepdims=True))
        assert np.all(np.abs(seen - exact) < 1e-7 * size + [[1e-8], [1e-7]]), name


def test_nonsense_targets_are_told_with_their_keys() -> None:
    bad = replace(
        REQUEST,
        drive=MotionTarget(50e-6, pattern_length=-0.3),
        coast=EaseOffTarget(-0.01, -0.01),
        tolerance=0.0,
    )
    with pytest.raises(DesignError) as caught:
        design_milled(bad)
    paths = [problem.path for problem in caught.value.problems]
    assert paths == [
        "contact.drive.pattern_length",
        "contact.coast.lengthwise_crowning",
        "contact.coast.profile_crowning",
        "contact.tolerance",
    ]


def test_a_flank_above_its_tolerance_is_led_towards_the_least_greatest_residual() -> None:
    """Plain roll beside a form-cut wheel: squares grow, the greatest residual falls; where it cannot, squares stand."""
    request = replace(REQUEST, wheel_method="formate", pinion_method="generated")
    blank = iso_blank(request.blank)
    task = pinion_task(request, blank, milled_wheel(request, blank))
    for side in SIDES:
        squares = _alone(task, side)
        assert squares is not None

        def asked(share: float, least: float = squares.largest) -> PinionTask:
            return replace(task, request=replace(request, tolerance=share * least))

        assert _evened(asked(1.0), squares) is squares
        assert _evened(asked(0.1), squares) is squares
        evened = _evened(asked(0.9), squares)
        assert evened.largest <= 0.9 * squares.largest
        assert evened.cost >= (1.0 - 1e-6) * squares.cost
        assert all((model.weight == 1.0).all() for model in evened.models)


def test_no_blade_is_sharper_than_a_twentieth_of_the_module() -> None:
    made, _ = designed("formate", "tilt")
    fits: dict[Any, Any] = {s: replace(fit, least_edge=0.0) for s, fit in made.fits.items()}
    radius = _pinion_edge(made.blank, made.wheel, fits)
    assert radius == pytest.approx(0.05 * made.blank.mean_normal_module, rel=1e-12)
