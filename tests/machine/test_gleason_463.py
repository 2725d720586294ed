"""The No. 463 grinder: the paper's own matrices and cam contact, the basic settings, and back.

Lin, Tsay & Fong 1996 with the notes' corrections, written out once more in 40 digits. In plain doubles the
poses differ by 5e-13 mm at most, within the 1e-12 mm asked for.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, degrees, pi, radians, tau
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from independent import carried

from hypoid.geometry import DesignError
from hypoid.machine import (
    MACHINES,
    Cam,
    MachineSettings,
    Workpiece,
    chain,
    roll_series,
)
from hypoid.machine._gleason_463 import (
    STAND_IN_463,
    Gleason463Dials,
    roll_limits,
)

NO_463 = MACHINES["gleason-463"]
HANDS = pytest.mark.parametrize("hand", ["left", "right"])
POINTS = [(125.0, 0.0, 0.0), (-80.0, 60.0, -20.0), (10.0, -90.0, 15.0), (100.0, 40.0, 30.0)]
PINION_IB = Gleason463Dials(  # Table 2
    eccentric_angle=radians(32 + 49 / 60),
    cradle_angle=radians(67 + 3 / 60),
    machine_root_angle=radians(20 + 26 / 60),
    cam_number=23,
    cam_setting=101.6,
    cam_guide_angle=radians(5 + 10 / 60),
    index_gears=(48, 80, 50, 81),
    index_interval=10,
    machine_center_to_back=-9.013,
    sliding_base=3.146,
    blank_offset=-11.642,
)
GEAR = Gleason463Dials(
    eccentric_angle=radians(35 + 44 / 60),
    cradle_angle=radians(324 + 59 / 60),
    machine_root_angle=radians(21 + 15 / 60),
    cam_number=29,
    cam_setting=76.2,
    cam_guide_angle=radians(-40 / 60),
    index_gears=(42, 70, 45, 84),
    index_interval=9,
    machine_center_to_back=-2.402,
    sliding_base=0.870,
    blank_offset=2.957,
)
PINION_WORK = Workpiece(27, "right", STAND_IN_463)
GEAR_WORK = Workpiece(28, "left", STAND_IN_463)
TRAINS = [(27, (48, 80, 50, 81), 10), (28, (42, 70, 45, 84), 9)]


def angles(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(radians(low), radians(high))


def dials_of(reach: float, seat: float) -> st.SearchStrategy[Gleason463Dials]:
    """Any dials for a pinion of 27 teeth: lengths up to reach, cam off its nominal seat up to seat (mm)."""
    lengths = st.floats(-reach, reach)
    return st.builds(
        Gleason463Dials,
        eccentric_angle=angles(0.0, 180.0),
        cradle_angle=angles(0.0, 360.0),
        machine_root_angle=angles(-90.0, 90.0),
        cam_number=st.just(23),
        cam_setting=st.floats(101.6 - seat, 101.6 + seat),
        cam_guide_angle=angles(-45.0, 45.0),
        index_gears=st.just((48, 80, 50, 81)),
        index_interval=st.just(10),
        machine_center_to_back=lengths,
        sliding_base=lengths,
        blank_offset=st.floats(-min(reach, 200.0), min(reach, 200.0)),
    )


def random_dials(rng: np.random.Generator, gears: tuple[int, ...], slots: int) -> Gleason463Dials:
    e, c, g, guide = np.radians(rng.uniform([0, 0, -90, -10], [180, 360, 90, 10]))
    setting = 101.6 + rng.uniform(-8, 8)
    lengths = rng.uniform(-60, 60, 3)
    return Gleason463Dials(e, c, g, 23, setting, guide, gears, slots, *lengths)


def exact(dials: Gleason463Dials, work: Workpiece) -> MachineSettings:
    """Basic settings in the chain's signs by (20), (21) and the notes, 40 digits."""
    s, e = work.sign, mp.mpf(dials.eccentric_angle)
    cam = STAND_IN_463.cams[dials.cam_number]
    c, delta = mp.mpf(STAND_IN_463.swivel_offset), dials.cam_setting - cam.nominal_setting
    own = Cam(
        c,  # type: ignore[arg-type]
        cam.pitch_radius,
        delta,
        s * dials.cam_guide_angle,
        mp.mpf(dials.index_interval) / work.teeth,  # type: ignore[arg-type]
    )
    return MachineSettings(
        radial_distance=2 * mp.mpf("203.2") * mp.sin(e / 2),
        cradle_angle=-s * (e / 2 - dials.cradle_angle),
        machine_root_angle=dials.machine_root_angle,
        ratio_of_roll=mp.nan,  # type: ignore[arg-type]
        roll_to_blade_ratio=0.0,
        blank_offset=s * dials.blank_offset,
        machine_center_to_back=dials.machine_center_to_back,
        sliding_base=dials.sliding_base,
        cam=own,
    )


def by_the_paper(
    dials: Gleason463Dials, work: Workpiece, point: Any, theta: float, phi: float
) -> list[Any]:
    """A wheel point of `chain` by (1), (2), (18) and (20)-(23), in the left-hand member's frame.

    (23) with -E_s cos(gamma_m) (notes, item 7). The paper's spindle counts from the shaft's zero, the
    chain's work from the centre of roll: n_i/n_p phi lies between.
    """
    s, cam = work.sign, STAND_IN_463.cams[dials.cam_number]
    c, r = mp.mpf(STAND_IN_463.swivel_offset), mp.mpf(cam.pitch_radius)
    delta, guide = dials.cam_setting - cam.nominal_setting, mp.mpf(dials.cam_guide_angle)
    q = 2 * mp.pi - dials.cradle_angle + mp.mpf(dials.eccentric_angle) / 2  # (20)
    radial = 2 * mp.mpf("203.2") * mp.sin(mp.mpf(dials.eccentric_angle) / 2)  # (21)
    beta, xi_c = (q + mp.pi - theta if s > 0 else q + theta), s * mp.mpf(phi)
    x, y, z = (mp.mpf(v) for v in point)
    y = -s * y  # the mirror, on the wheel's side
    x, y = x * mp.sin(beta) - y * mp.cos(beta), x * mp.cos(beta) + y * mp.sin(beta)  # (1)
    x, y = x + radial * mp.cos(q), y - radial * mp.sin(q)  # (22)

    def contact(alpha_e: Any) -> Any:  # (18)
        off = xi_c - alpha_e - guide
        turned = mp.sin(guide) + mp.sin(r / c * off) + mp.sin(xi_c - guide)
        return c * turned + delta * mp.sin(off)

    near = -guide + (1 + c / (r + delta)) * xi_c
    shaft = mp.findroot(contact, (near, near + mp.mpf("1e-3")), tol=1e-60)
    xi_w = mp.mpf(dials.index_interval) / work.teeth * (shaft + guide)  # (2)
    sg, cg = mp.sin(dials.machine_root_angle), mp.cos(dials.machine_root_angle)
    x, y = mp.cos(xi_c) * x + mp.sin(xi_c) * y, -mp.sin(xi_c) * x + mp.cos(xi_c) * y  # M32
    base = dials.sliding_base
    x, z = cg * x + sg * z - base * sg, -sg * x + cg * z - base * cg  # M53
    y = y - dials.blank_offset
    x = x - dials.machine_center_to_back  # M65
    y, z = mp.cos(xi_w) * y - mp.sin(xi_w) * z, mp.sin(xi_w) * y + mp.cos(xi_w) * z
    return [-z, -s * y, x]


@HANDS
@pytest.mark.parametrize("seed", range(6))
def test_lin_1996_mechanism(hand: Any, seed: int, forty_digits: None) -> None:
    """(1), (2), (18), (20)-(23): the pose to 1e-12 mm, the basic settings and the cam's motion to 1e-30."""
    rng = np.random.default_rng(seed)
    teeth, gears, slots = TRAINS[seed % 2]
    dials, work = random_dials(rng, gears, slots), Workpiece(teeth, hand, STAND_IN_463)
    for point in POINTS:
        theta, phi = rng.uniform(-2, 2), rng.uniform(-0.25, 0.25)
        paper = by_the_paper(dials, work, point, theta, phi)
        by_settings = carried(exact(dials, work), point, mp.mpf(theta), mp.mpf(phi), mp)
        assert max(abs(p - c) for p, c in zip(paper, by_settings, strict=True)) < mp.mpf("1e-30")
        posed = NO_463.pose(dials, work, theta, phi) @ [*point, 1.0]
        assert posed[:3] == pytest.approx([float(p) for p in paper], abs=1e-12, rel=0)


@HANDS
@settings(max_examples=80, deadline=None)
@given(dials=dials_of(60.0, 60.0), theta=st.floats(-2.0, 2.0), share=st.floats(0.02, 0.98))
def test_mechanical_and_basic_pose_are_one_rigid_motion(
    hand: Any, dials: Gleason463Dials, theta: float, share: float
) -> None:
    """Over all of the cam's uniform motion, whatever its seat."""
    work = Workpiece(27, hand, STAND_IN_463)
    low, high = roll_limits(dials, work)
    phi = low + (high - low) * share
    apart = NO_463.pose(dials, work, theta, phi) - chain(NO_463.to_basic(dials, work), theta, phi)
    cam = STAND_IN_463.cams[dials.cam_number]
    far = abs(dials.cam_setting - cam.nominal_setting) > 0.5 * cam.pitch_radius  # the roll is steep
    assert np.abs(apart[:3, 3]).max() < (1e-11 if far else 1e-12)  # mm
    assert np.abs(apart[:3, :3]).max() < (1e-12 if far else 1e-13)


@HANDS
@settings(max_examples=80, deadline=None)
@given(dials=dials_of(400.0, 70.0))
def test_dials_come_back(hand: Any, dials: Gleason463Dials) -> None:
    """At 180 deg the eccentric's arc sine is flat: half its digits go, and the cradle makes up for them."""
    work = Workpiece(27, hand, STAND_IN_463)
    basic = NO_463.to_basic(dials, work)
    back = NO_463.from_basic(basic, work)
    near = 1e-12 if cos(dials.eccentric_angle / 2) > 0.01 else 1e-7
    assert back.eccentric_angle == pytest.approx(dials.eccentric_angle, abs=near)
    for angle in ("cradle_angle", "machine_root_angle"):
        off = getattr(back, angle) - getattr(dials, angle)
        assert abs((off + pi) % tau - pi) < near
    for same in ("machine_center_to_back", "sliding_base", "blank_offset", "cam_guide_angle"):
        assert getattr(back, same) == getattr(dials, same)
    assert back.cam_setting == pytest.approx(dials.cam_setting, abs=1e-12)
    assert (back.cam_number, back.index_interval) == (23, 10)
    again = NO_463.to_basic(back, work)
    assert np.abs(chain(again, 0.4, 0.1) - chain(basic, 0.4, 0.1)).max() < 2e-12


def test_lin_1996_table_2() -> None:
    """S and Q by (20), (21): pinion right-hand as the paper has it, gear left-hand with Q's sign turned."""
    pinion, gear = NO_463.to_basic(PINION_IB, PINION_WORK), NO_463.to_basic(GEAR, GEAR_WORK)
    assert pinion.radial_distance == pytest.approx(114.800270, abs=5e-7)
    assert gear.radial_distance == pytest.approx(124.684719, abs=5e-7)
    assert degrees(pinion.cradle_angle) == pytest.approx(67.05 - 16.408333, abs=5e-7)
    assert degrees(gear.cradle_angle) == pytest.approx(17.866667 + 35.016667, abs=2e-6)
    for basic, dials, s in ((pinion, PINION_IB, 1), (gear, GEAR, -1)):
        assert basic.blank_offset == s * dials.blank_offset
        assert basic.machine_center_to_back == dials.machine_center_to_back
        assert basic.sliding_base == dials.sliding_base
        assert basic.cam is not None
        assert basic.cam.guide_angle == s * dials.cam_guide_angle
        assert (basic.cam.setting, basic.tilt_angle, basic.generated) == (0.0, 0.0, True)
        assert basic.ratio_of_roll == pytest.approx(roll_series(basic.cam).ratio_of_roll, rel=1e-14)


@pytest.mark.parametrize(
    ("dials", "work", "ratio"), [(PINION_IB, PINION_WORK, 10 / 27), (GEAR, GEAR_WORK, 9 / 28)]
)
def test_lin_1996_index_gears(dials: Gleason463Dials, work: Workpiece, ratio: float) -> None:
    """48/80 x 50/81 = 10/27, 42/70 x 45/84 = 9/28 (Table 2); any other train is named, however near."""
    cam = NO_463.to_basic(dials, work).cam
    assert cam is not None
    assert cam.index_ratio == pytest.approx(ratio, rel=1e-15)
    a, b, c, d = dials.index_gears
    for wrong in ((a, b, c, d - 1), (b, a, c, d), (a + 1, b, c, d)):
        with pytest.raises(DesignError, match=f"{dials.index_interval}/{work.teeth}") as caught:
            NO_463.to_basic(replace(dials, index_gears=wrong), work)
        assert [p.path for p in caught.value.problems] == ["settings.index_gears"]
    with pytest.raises(DesignError, match="the slots would not close"):
        NO_463.to_basic(dials, replace(work, teeth=work.teeth + 1))


def test_cams_that_the_machine_has_not() -> None:
    with pytest.raises(DesignError, match=r"the machine constants describe \(23, 29\)") as caught:
        NO_463.to_basic(replace(PINION_IB, cam_number=24), PINION_WORK)
    assert [p.path for p in caught.value.problems] == ["settings.cam_number"]
    unknown = replace(
        NO_463.to_basic(PINION_IB, PINION_WORK), cam=Cam(381.0, 65.0, 0.0, 0.0, 10 / 27)
    )
    with pytest.raises(DesignError, match=r"No\. 23: 70\.302 mm, No\. 29: 56\.439 mm") as caught:
        NO_463.from_basic(unknown, PINION_WORK)
    assert [p.path for p in caught.value.problems] == ["settings.cam"]


@pytest.mark.parametrize("constants", [None, 381.0])
def test_machine_constants_that_are_missing(constants: Any) -> None:
    """C and the cams' radii are the user's data: the paper gives neither."""
    assert NO_463.needs_constants
    work = Workpiece(27, "right", constants, "pinion.concave.settings")
    for call in (
        lambda: NO_463.to_basic(PINION_IB, work),
        lambda: NO_463.pose(PINION_IB, work, 0.0, 0.0),
        lambda: NO_463.from_basic(NO_463.to_basic(PINION_IB, PINION_WORK), work),
    ):
        with pytest.raises(DesignError, match="swivel offset C and of each cam") as caught:
            call()
        assert caught.value.problems[0].path == "pinion.concave.settings: machine constants"
