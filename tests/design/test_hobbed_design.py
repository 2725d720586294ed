"""Face-hobbed pairs from their blank: wheel corrected to the blank, pinion in one setting-up to targets."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import cos, degrees, pi, radians
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tri_ac import stick_sweep

from hypoid.blank import BlankRequest, TypeII, iso_blank
from hypoid.contact import Misalignment, pair_backlash, unloaded_contact
from hypoid.cutter import TriAcHead
from hypoid.design import (
    EaseOffTarget,
    HobbedDesign,
    HobbedRequest,
    MotionTarget,
    PinionLimits,
    StickGrind,
    build,
    design_exact,
    design_hobbed,
)
from hypoid.design._conjugate import conjugate
from hypoid.design._hobbed_cut import stick
from hypoid.design._hobbed_joint import COLUMNS, joint_model, joint_vector
from hypoid.design._hobbed_model import FIXED, ROLLED_AT, ROOT_AT
from hypoid.design._hobbed_start import conjugate_start, pinion_thickness
from hypoid.design._hobbed_wheel import head_plan, hobbed_wheel
from hypoid.design._milled_wheel import pitch_cone
from hypoid.design._motion import motion_of
from hypoid.design._settings_model import NAMES
from hypoid.design._target import TargetPlaces
from hypoid.flank import SIDES, PointStatus, Side, flank_angles
from hypoid.geometry import DesignError
from hypoid.io import read_spec
from hypoid.pair import Direction, GearPair

BLANKS = Path(__file__).parents[2] / "examples" / "blanks"
MATES: dict[Side, Side] = {"concave": "convex", "convex": "concave"}


@cache
def request_2005() -> HobbedRequest:
    spec = read_spec(BLANKS / "vimercati-piazza-2005.toml")
    assert isinstance(spec, HobbedRequest)
    return spec


@cache
def designed(case: str) -> tuple[HobbedDesign, GearPair]:
    request = request_2005()
    if case != "2005":
        crowned = EaseOffTarget(0.020, 0.020)
        request = replace(request, drive=crowned, coast=crowned, tolerance=0.007)
    if case == "free spacing":
        request = replace(request, equal_spacing=False)
    made = design_hobbed(request)
    return made, build(made.spec)


@pytest.mark.parametrize("wheel", ["formate", "generated"])
@pytest.mark.parametrize("hand", ["left", "right"])
def test_wheel_has_the_blanks_angles_and_tooth_at_the_mean_point(wheel: Any, hand: Any) -> None:
    """From the exact flanks: 23 and 17 deg, 28.900 deg spiral, s_mn2."""
    asked = request_2005()
    request = replace(asked, wheel_method=wheel, blank=replace(asked.blank, pinion_hand=hand))
    blank = iso_blank(request.blank)
    made, own = hobbed_wheel(request, blank), blank.wheel
    at = own.mean_cone_distance
    concave, convex = (flank_angles(made.flank(side), at) for side in SIDES)
    assert degrees(concave.pressure) == pytest.approx(23.0, abs=1e-7)
    assert degrees(convex.pressure) == pytest.approx(17.0, abs=1e-7)
    spiral = 0.5 * (concave.spiral + convex.spiral)
    assert degrees(spiral) == pytest.approx(degrees(own.mean_spiral_angle), abs=1e-7)
    turns = [float(made.flank(side).parameters([at], [0.0])[2][0]) for side in SIDES]
    thick = (turns[1] - turns[0]) % (2.0 * pi / 44)
    normal = thick * 0.5 * own.mean_pitch_diameter * cos(own.mean_spiral_angle)
    assert own.thickness is not None
    assert normal == pytest.approx(own.thickness.mean_normal, abs=1e-8)


def test_straight_unraked_pinion_is_the_wheels_conjugate() -> None:
    """No ease-off beyond 1e-9 mm from the start that the notes call the baseline pinion."""
    request = replace(request_2005(), grind=StickGrind(hook_angle=0.0, side_rake_angle=0.0))
    blank = iso_blank(request.blank)
    wheel, cone = hobbed_wheel(request, blank), pitch_cone(blank, "pinion")
    start = conjugate_start(head_plan(request, blank, 0.0), blank, wheel)
    assert start is not None
    none = EaseOffTarget(0.0, 0.0)
    model = joint_model(
        start,
        {side: conjugate(blank, wheel.flank(MATES[side]), cone) for side in SIDES},
        {"concave": none, "convex": none},
        blank,
        cone,
        pinion_thickness(blank, 0.15),
        equal_spacing=True,
    )
    assert model is not None
    seen = model.look(joint_vector(start), {}, model.start)
    assert seen is not None
    for side, own in model.sides.items():
        assert own.there.sum() > 60
        assert np.abs(seen.misfit[side][own.there]).max() < 1e-9


def test_jacobian_of_flank_and_root_by_every_entry() -> None:
    """n . dr/dp and dH/dp against Richardson's differences, plain roll and motions alike."""
    made, _ = designed("2005")
    own, fit = made.blank.pinion, made.fit
    plan = head_plan(made.request, made.blank, 762.0)
    held = stick(plan, own.teeth, fit.height, 1.0)
    side = fit.sides["concave"]
    at = np.flatnonzero(np.isfinite(side.residual))[::9]
    cone = pitch_cone(made.blank, "pinion")
    z, rho = cone.axial_radial(side.distance[at], side.height[at])
    flank = build(made.spec).pinion.concave
    s, turn, _ = flank.parameters(side.distance[at], side.height[at])
    # every axis moves a little, so that derivatives of motions are seen at other places than zero
    vector = fit.vector[COLUMNS["concave"]].copy()
    vector[NAMES.index("helical_motion")] = 0.3
    vector[NAMES.index("modified_roll_2")] = 0.01
    vector[NAMES.index("machine_root_angle_1")] = 0.01
    begin = [s, turn, np.zeros(len(s))]
    here = ROLLED_AT(vector, held, z, rho, *begin)
    assert np.all(here[4] < 1e-9)
    begin = [here[0], here[1], here[2]]
    distance = [own.inner_cone_distance, own.mean_cone_distance, own.outer_cone_distance]
    root = ROOT_AT(vector, held, cone, distance, [turn[0]] * 3, [0.0] * 3)
    assert np.all(root[3] < 1e-9)
    for k, name in enumerate(NAMES):
        flank_slopes, root_slopes = [], []
        for h in (2e-4, 1e-4):
            ends = [vector.copy(), vector.copy()]
            ends[0][k] += h
            ends[1][k] -= h
            up, down = (ROLLED_AT(v, held, z, rho, *begin)[3] for v in ends)
            flank_slopes.append((up - down) / (2.0 * h) * here[5])
            up, down = (ROOT_AT(v, held, cone, distance, root[0], root[1])[2] for v in ends)
            root_slopes.append((up - down) / (2.0 * h))
        if name == "blade_curvature":  # 1/R by h = 1e-4: far from straight; other orders are left
            continue
        for exact, slopes in ((here[FIXED + k], flank_slopes), (root[4 + k], root_slopes)):
            wanted = (4.0 * slopes[1] - slopes[0]) / 3.0
            size = max(1e-3, float(np.abs(wanted).max()))
            assert np.abs(exact - wanted).max() < 1e-6 * size + 1e-8, name


def test_one_setting_up_and_one_head_cut_both_pinion_flanks() -> None:
    made, pair = designed("crowned")
    concave, convex = made.spec.pinion.concave, made.spec.pinion.convex
    assert concave.dials == convex.dials
    assert pair.pinion.concave.settings == pair.pinion.convex.settings
    head = pair.pinion.heads["concave"]
    assert head is pair.pinion.heads["convex"]
    assert isinstance(head, TriAcHead)
    assert head.following == pytest.approx(pi / 13, abs=1e-15)  # equal blade spacing
    assert head.outer.radius != head.inner.radius


@pytest.mark.parametrize("case", ["crowned", "free spacing"])
def test_target_and_tooth_are_met(case: str) -> None:
    """Residual within the tolerance on both flanks; slot as wide as backlash and mating tooth ask."""
    made, pair = designed(case)
    assert not made.faults
    assert made.fit.largest < made.request.tolerance
    own = made.blank.pinion
    thick = float(pair.pinion.tooth.thickness([own.mean_cone_distance])[0])
    wanted = pinion_thickness(made.blank, made.request.normal_backlash)
    assert thick * cos(own.mean_spiral_angle) == pytest.approx(wanted, abs=2e-3)
    if case == "free spacing":
        assert made.fit.spacing is not None
        assert abs(degrees(made.fit.spacing) - 180.0 / 13) > 0.1
    assert pair_backlash(pair).mean_normal == pytest.approx(0.15, abs=0.012)


@pytest.mark.parametrize("direction", ["drive", "coast"])
def test_contact_of_the_flanks_themselves_in_the_middle(direction: Direction) -> None:
    contact = unloaded_contact(designed("crowned")[1], direction)
    assert not contact.edge_contact
    assert np.isfinite(contact.peak_to_peak)
    distance, height = contact.contact_point
    own = designed("crowned")[0].blank.pinion
    assert abs(distance - own.mean_cone_distance) < 0.1 * own.face_width
    assert abs(height) < 1.0


CASES: list[tuple[Direction, float, float, float, float]] = [
    # direction, dE, dP (Table 2, mm), HYFH, T2000 (Table 3, urad)
    ("drive", 0.254, -0.102, 49.0, 52.0),
    ("drive", 0.0, 0.0, 51.0, 54.0),
    ("drive", -0.508, 0.280, 62.0, 63.0),
    ("coast", -0.254, 0.051, 45.0, 47.0),
    ("coast", 0.0, 0.0, 53.0, 57.0),
    ("coast", 0.508, -0.254, 70.0, 76.0),
]


@pytest.mark.parametrize(("direction", "offset", "axial", "hyfh", "t2000"), CASES)
def test_six_mountings_of_2005_predicted_from_the_blank(
    direction: Direction, offset: float, axial: float, hyfh: float, t2000: float
) -> None:
    """Table 3 within 5 urad of one of its two programs; only the two mean cases were asked."""
    error = Misalignment(offset=offset, pinion_axial=axial)
    contact = unloaded_contact(designed("2005")[1], direction, error)
    found = contact.peak_to_peak * 1e6
    assert min(abs(found - hyfh), abs(found - t2000)) < 5.0
    if not offset:
        assert found == pytest.approx(t2000, abs=1.2)
    assert not contact.edge_contact


@pytest.mark.slow
@pytest.mark.parametrize("side", SIDES)
def test_designed_pinion_is_what_its_blades_sweep(side: Side) -> None:
    """The paper's blade and machine, swept with no meshing condition: within 1e-6 mm, mean and heel."""
    _, pair = designed("2005")
    flank, head = pair.pinion.flank(side), pair.pinion.heads[side]
    assert isinstance(head, TriAcHead)
    sweep = stick_sweep(head, flank)
    heights = np.linspace(-2.0, 4.5, 5)
    for distance in (0.5 * (flank.toe + flank.heel), flank.heel):
        points = flank.at_cone(np.full(5, distance), heights)
        assert (points.status == PointStatus.OK).all()
        swept = sweep.boundary(distance, heights, side)
        x, y, _ = points.position.T
        lever = (np.stack([-y, x, 0.0 * x], axis=1) * points.normal).sum(axis=1)
        apart = np.angle(np.exp(1j * (swept - np.arctan2(y, x)))) * lever
        assert np.abs(apart).max() < 1e-6


def test_a_method_that_falls_short_says_how_far_and_what_would_help() -> None:
    crowned = EaseOffTarget(0.020, 0.020)
    asked = replace(request_2005(), drive=crowned, coast=crowned, pinion_method="generated")
    made = design_hobbed(asked)
    assert made.fit.settings.tilt_angle == 0.0
    told = [fault for fault in made.faults if "from its target ease-off" in fault]
    assert told
    assert "these would help both" in told[0]


def test_a_start_that_leans_the_cutter_the_wrong_way_is_left() -> None:
    """12 x 31 at 73.5 deg: tilt is wanted across the swivel that both starts have, and places fold on the way.

    Number 275 of the random blanks, which kept 38 um: the cutter's axis stayed upright, where swivel moves
    nothing. Places that fold are left out, but only a few.
    """
    crowned = EaseOffTarget(0.0192, 0.0128)
    blank = BlankRequest(
        1, 12, 31, 1.282794190901493, 6.015696763294402, 37.304341662326024, 113.95184982917482,
        0.3118232397334818, wheel_outer_diameter=31 * 6.5851828034489435, taper="uniform",
        tooth=TypeII(depth_factor=2.0), blade_groups=14,
    )  # fmt: skip
    grind = StickGrind(pinion_curve_radius=None)
    request = HobbedRequest(
        "", "", (), blank, grind=grind, drive=crowned, coast=crowned, tolerance=0.0102646
    )
    made = design_hobbed(request)
    assert degrees(made.fit.settings.tilt_angle) > 10.0
    for fit in made.fit.sides.values():
        assert fit.largest < request.tolerance
        assert np.isfinite(fit.residual).sum() > 50  # of 65 that the blank leaves of 91


def limited(**limits: Any) -> HobbedDesign:
    """The crowned 15 x 44 with its pinion's settings held or bounded."""
    made, _ = designed("crowned")
    return design_hobbed(replace(made.request, limits=PinionLimits(**limits)))


@pytest.mark.parametrize("name", ["tilt_angle", "blank_offset", "blade_radius"])
def test_ranges_of_settings_hold_and_are_active(name: str) -> None:
    """Cut off just short of the free fit's value, each stands at its bound, met targets or not."""
    free, _ = designed("crowned")
    settings = free.fit.settings
    inner = free.fit.radii[1]
    low, high = {
        "tilt_angle": (0.0, settings.tilt_angle - radians(2.0)),
        "blank_offset": (
            -settings.blank_offset - 9.0,
            -settings.blank_offset - 0.5,
        ),  # sheet's sign
        "blade_radius": (inner - 5.0, inner - 0.1),
    }[name]
    made = limited(ranges={name: (low, high)})
    found = {
        "tilt_angle": made.fit.settings.tilt_angle,
        "blank_offset": -made.fit.settings.blank_offset,
        "blade_radius": made.fit.radii[1],
    }
    assert low <= found[name] <= high
    assert found[name] == pytest.approx(high, abs=1e-9)
    said = "convex.blade_radius" if name == "blade_radius" else name
    assert any(words.startswith(f"{said} stands at its upper bound") for words in made.fit.held)
    assert all(fit.largest < made.request.tolerance for fit in made.fit.sides.values())
    assert made.fit.thickness == pytest.approx(free.fit.thickness, abs=2e-3)


def test_a_bound_that_keeps_a_target_from_being_met_is_named_for_both_flanks() -> None:
    made = limited(ranges={"tilt_angle": (0.0, radians(15.0))})
    assert made.fit.settings.tilt_angle == pytest.approx(radians(15.0), abs=1e-12)
    told = [fault for fault in made.faults if "target ease-off" in fault]
    assert len(told) == 2  # drive and coast
    for fault in told:
        assert "tilt_angle stands at its upper bound, 15 deg" in fault


def test_fixed_and_freed_settings() -> None:
    """A fixed value stays, in the sheet's signs; what is freed beside the method's gains."""
    made = limited(fixed={"tilt_angle": radians(27.0), "blank_offset": -23.5})
    assert made.fit.settings.tilt_angle == pytest.approx(radians(27.0), abs=1e-12)
    assert made.fit.settings.blank_offset == pytest.approx(23.5, abs=1e-12)  # chain's sign
    assert not {"tilt_angle", "blank_offset"} & set(made.fit.free)
    free, _ = designed("crowned")
    more = limited(free=("modified_roll_2",))
    assert more.fit.settings.modified_roll[0] != 0.0
    assert more.fit.rms < free.fit.rms


def test_limits_without_sense_are_told() -> None:
    bad = {
        "machine": "gleason-122",
        "free": ("magic",),
        "fixed": {"point_radius": 88.0, "tilt_angle": 0.5},
        "ranges": {"tilt_angle": (0.0, 0.4), "sliding_base": (5.0, -5.0)},
    }
    with pytest.raises(DesignError) as caught:
        limited(**bad)
    assert {problem.path for problem in caught.value.problems} == {
        "pinion.machine",
        "pinion.free",
        "pinion.fixed.point_radius",
        "pinion.fixed.tilt_angle",
        "pinion.range.sliding_base",
    }
    with pytest.raises(DesignError) as caught:  # no such pinion is there at all
        limited(ranges={"radial_distance": (10.0, 20.0)})
    assert "widen pinion.range" in caught.value.problems[0].expected


def test_nonsense_is_told_with_its_keys() -> None:
    asked: Any = request_2005()
    bad = replace(
        asked,
        drive=MotionTarget(50e-6, pattern_length=-0.3),
        coast=EaseOffTarget(-0.01, 0.01),
        tolerance=0.0,
        pinion_method="completing",
        blank=replace(asked.blank, blade_groups=0),
    )
    with pytest.raises(DesignError) as caught:
        design_hobbed(bad)
    assert [problem.path for problem in caught.value.problems] == [
        "contact.drive.pattern_length",
        "contact.coast.lengthwise_crowning",
        "pinion.method",
        "cutting.blade_groups",
        "contact.tolerance",
    ]


def test_too_deep_a_slot_names_the_limit() -> None:
    asked = request_2005()
    tooth: Any = replace(asked.blank.tooth, depth_factor=3.9)  # pyright: ignore
    with pytest.raises(DesignError) as caught:
        design_hobbed(replace(asked, blank=replace(asked.blank, tooth=tooth)))
    assert caught.value.problems


def test_motion_of_a_parabola() -> None:
    """A (pitch/2)**2 where pairs hand over half a pitch from the summit, whatever stands beside it."""
    v, u = (
        g.ravel() for g in np.meshgrid(np.linspace(-1, 1, 7), np.linspace(-1, 1, 13), indexing="ij")
    )
    turn = 0.2 * u + 0.1 * v
    lead = 3e-3 * turn**2 + 1e-4 * (u - 0.5 * v) ** 2

    def found(pitch: float) -> Any:
        return motion_of(TargetPlaces(u, v, v, u, turn, np.ones_like(u), pitch), lead)

    assert found(0.2).peak_to_peak == pytest.approx(3e-3 * 0.1**2, rel=0.04)
    assert found(2.0) is None


def test_exact_pair_as_a_sheet_has_the_exact_flanks() -> None:
    """All four flanks of 2022 but for each member's index, 1e-9 mm; sliding base to the tips."""
    spec: Any = read_spec(BLANKS / "gonzalez-fuentes-2022.toml")
    made = design_exact(spec)
    for one, other in zip(build(spec).flanks(), build(made.spec).flanks(), strict=True):
        distance, height = one.grid(9, 7)
        a, b = one.at_cone(distance, height), other.at_cone(distance, height)
        # beside the line where the edge arc begins, either piece may have been asked
        low = np.asarray(one.charts["flank"].bounds(distance.ravel())[0])
        both = a.ok & b.ok & (height.ravel() > low + 1e-3)
        assert both.sum() > 30
        first, second = (p.position[both] for p in (a, b))
        assert np.abs(first[:, 2] - second[:, 2]).max() < 1e-9
        turn = np.angle((second[:, 0] + 1j * second[:, 1]) / (first[:, 0] + 1j * first[:, 1]))
        assert np.ptp(turn) * np.hypot(first[:, 0], first[:, 1]).max() < 1e-9
