"""Every dial of every machine: its range in words, its steps, and what a machine cannot set."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan, pi, radians, tau
from typing import Any

import pytest

from hypoid.geometry import DesignError
from hypoid.machine import MACHINES, Cam, MachineSettings, Motions, Workpiece
from hypoid.machine._dials import full_turn, half_turn, shown
from hypoid.machine._gleason_463 import Gleason463Dials
from hypoid.machine._tilt_head import TiltHeadDials

TILTED = TiltHeadDials(
    eccentric_angle=radians(64.0),
    cradle_angle=radians(355.0),
    swivel_angle=radians(359.0),
    cutter_spindle_rotation_angle=radians(52.0),
    machine_root_angle=radians(-6.0),
    ratio_gears=(53, 42, 48, 76),
    helical_gears=(52, 66, 82, 49),
)
GROUND = Gleason463Dials(
    eccentric_angle=radians(32.0),
    cradle_angle=radians(67.0),
    machine_root_angle=radians(20.0),
    cam_number=23,
    cam_setting=101.6,
    cam_guide_angle=radians(5.0),
    index_gears=(48, 80, 50, 81),
    index_interval=10,
)
GOOD: dict[str, Any] = {"gleason-106": TILTED, "gleason-122": TILTED, "gleason-463": GROUND}
BASIC = MachineSettings(
    radial_distance=110.0,
    cradle_angle=1.0,
    machine_root_angle=0.3,
    ratio_of_roll=2.6,
    roll_to_blade_ratio=0.0,
)
GEARS = r"four tooth numbers \(driver, driven, driver, driven\) from 12 to 200"
WRONG: dict[str, tuple[list[Any], str]] = {  # by kind of dial, with the range as it is told
    "eccentric_angle": ([-0.01, pi + 0.01, nan, inf], "an angle from 0 deg to 180 deg"),
    "cutter_spindle_rotation_angle": ([-0.01, 3.2, nan], "an angle from 0 deg to 180 deg"),
    "cradle_angle": ([nan, inf], "an angle from 0 deg to 360 deg"),
    "swivel_angle": ([nan, -inf], "an angle from 0 deg to 360 deg"),
    "machine_root_angle": ([radians(91.0), radians(-91.0), nan], "an angle from -90 deg to 90 deg"),
    "cam_guide_angle": ([radians(46.0), radians(-46.0), nan], "an angle from -45 deg to 45 deg"),
    "machine_center_to_back": ([400.1, -400.1, nan], "a length from -400 mm to 400 mm"),
    "sliding_base": ([400.1, -inf], "a length from -400 mm to 400 mm"),
    "cam_setting": ([-400.1, nan], "a length from -400 mm to 400 mm"),
    "blank_offset": ([200.1, -200.1], "a length from -200 mm to 200 mm"),
    "ratio_gears": ([(53, 42), (53, 0, 48, 76), (53, 42, 48, 201), (53.5, 42, 48, 76)], GEARS),
    "helical_gears": ([(0, 66, 82, 49), (52, 66, 82, 49, 50)], GEARS + ", or none"),
    "index_gears": ([(), (48, 80, 50), (48, 80, 50, 11)], GEARS),
    "helical_direction": ([0, 2], r"1 \(with the cradle roll\) or -1"),
    "cam_number": ([0, 1000, 2.5], "a whole number from 1 to 999"),
    "index_interval": ([0, 201, 1.5], "a whole number from 1 to 200"),
}


def work_of(name: str, hand: Any = "right") -> Workpiece:
    return Workpiece(27, hand, MACHINES[name].constants, "pinion.concave.settings")


@pytest.mark.parametrize("name", MACHINES)
def test_every_dial_out_of_range_is_named_with_its_range(name: str) -> None:
    """No dial is left out of the table, and none accepts what its range does not hold."""
    machine, good = MACHINES[name], GOOD[name]
    machine.to_basic(good, work_of(name))
    assert set(machine.table) == set(machine.ranges) == set(machine.dials.__dataclass_fields__)
    for dial in machine.table:
        values, told = WRONG[dial]
        for value in values:
            with pytest.raises(DesignError, match=told) as caught:
                machine.to_basic(replace(good, **{dial: value}), work_of(name))
            problem = caught.value.problems[0]
            assert problem.path == f"pinion.concave.settings.{dial}"
            assert problem.example


@pytest.mark.parametrize("name", MACHINES)
def test_all_faults_come_at_once(name: str) -> None:
    machine = MACHINES[name]
    broken = {dial: WRONG[dial][0][0] for dial in machine.table}
    for raises in (lambda d: machine.to_basic(d, work_of(name)), machine.check):
        with pytest.raises(DesignError) as caught:
            raises(replace(GOOD[name], **broken))
        assert {p.path.split(".")[-1] for p in caught.value.problems} == set(machine.table)


@pytest.mark.parametrize("name", MACHINES)
def test_both_ends_of_a_range_belong_to_it(name: str) -> None:
    machine = MACHINES[name]
    for dial, (low, high) in machine.ranges.items():
        if machine.table[dial].kind in ("angle", "length"):
            for end in (low, high):
                machine.check(replace(GOOD[name], **{dial: end}))


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"roll_to_blade_ratio": 0.5}, "roll_to_blade_ratio"),
        ({"cutter_lead": 0.1}, "cutter_lead"),
        ({"motions": Motions(blank_offset=(0.1,))}, "motions.blank_offset"),
        ({"motions": Motions(tilt_angle=(0.0, 0.1))}, "motions.tilt_angle"),
        ({"radial_distance": 500.0}, "radial_distance"),
        ({"radial_distance": -1.0}, "radial_distance"),
        ({"radial_distance": nan}, "radial_distance"),
        ({"ratio_of_roll": 0.0}, "ratio_of_roll"),
        ({"ratio_of_roll": -2.6}, "ratio_of_roll"),
        ({"ratio_of_roll": nan}, "ratio_of_roll"),
        ({"blank_offset": 250.0}, "blank_offset"),
        ({"cradle_angle": nan}, "cradle_angle"),
    ],
)
def test_settings_that_no_machine_has(name: str, changes: dict[str, Any], path: str) -> None:
    MACHINES[name].from_basic(BASIC, work_of(name))
    with pytest.raises(DesignError) as caught:
        MACHINES[name].from_basic(replace(BASIC, **changes), work_of(name))
    assert f"pinion.concave.settings.{path}" in {p.path for p in caught.value.problems}


CAM = Cam(381.0, 70.302, 0.0, 0.1, 10 / 27)


@pytest.mark.parametrize(
    ("name", "changes", "path"),
    [
        ("gleason-122", {"modified_roll": (0.01,)}, "modified_roll"),
        ("gleason-106", {"cam": CAM}, "cam"),
        ("gleason-463", {"tilt_angle": 0.01}, "tilt_angle"),
        ("gleason-463", {"helical_motion": 1.0}, "helical_motion"),
        ("gleason-463", {"generated": False}, "generated"),
        ("gleason-122", {"generated": False, "helical_motion": 1.0}, "helical_motion"),
    ],
)
def test_settings_of_another_machine(name: str, changes: dict[str, Any], path: str) -> None:
    with pytest.raises(DesignError) as caught:
        MACHINES[name].from_basic(replace(BASIC, **changes), work_of(name))
    assert [p.path for p in caught.value.problems] == [f"pinion.concave.settings.{path}"]


@pytest.mark.parametrize("name", ["gleason-106", "gleason-122"])
@pytest.mark.parametrize("tilt", [30.01, -30.01, 90.0, 360.0, nan, inf])
def test_tilt_beyond_twice_the_wedge_angle(name: str, tilt: float) -> None:
    """sin(i/2) = sin(eps) sin(psi_t/2), so i <= 2 eps = 30 deg (notes); 30 deg itself can be set."""
    for most in (30.0, -30.0):
        dials = MACHINES[name].from_basic(replace(BASIC, tilt_angle=radians(most)), work_of(name))
        assert dials.cutter_spindle_rotation_angle == pytest.approx(pi, abs=1e-7)
    with pytest.raises(DesignError, match="a tilt from 0 deg to 30 deg") as caught:
        MACHINES[name].from_basic(replace(BASIC, tilt_angle=radians(tilt)), work_of(name))
    assert [p.path for p in caught.value.problems] == ["pinion.concave.settings.tilt_angle"]


@pytest.mark.parametrize(
    ("name", "most"), [("gleason-106", 152.4), ("gleason-122", 247.65), ("gleason-463", 406.4)]
)
def test_radial_distance_beyond_twice_the_eccentric(name: str, most: float) -> None:
    """S_r = 2 L sin(psi_e/2) [tsay1993, L of the nomenclature; lin1996, (21), e = 8 in]."""
    dials = MACHINES[name].from_basic(replace(BASIC, radial_distance=most), work_of(name))
    assert dials.eccentric_angle == pytest.approx(pi, abs=1e-7)
    with pytest.raises(DesignError, match=f"from 0 mm to {most} mm"):
        MACHINES[name].from_basic(replace(BASIC, radial_distance=most + 0.01), work_of(name))


def test_members_that_are_none() -> None:
    """No teeth and no hand: both at once."""
    with pytest.raises(DesignError) as caught:
        Workpiece(0, "up", path="wheel.convex.settings")  # type: ignore[arg-type]
    paths = [p.path for p in caught.value.problems]
    assert paths == ["wheel.convex.settings: teeth", "wheel.convex.settings: hand"]


def test_steps() -> None:
    """64 deg 29.4 min and 19.784 mm fall on the nearest minute and hundredth; gears stay."""
    off = replace(
        TILTED,
        eccentric_angle=radians(64 + 29.4 / 60),
        cradle_angle=radians(359 + 59.7 / 60),
        machine_root_angle=radians(-6 - 43.4 / 60),
        sliding_base=19.786,
        blank_offset=-20.914,
    )
    on = MACHINES["gleason-122"].rounded(off)
    assert on.eccentric_angle == pytest.approx(radians(64 + 29 / 60), abs=1e-15)
    assert on.cradle_angle == 0.0
    assert on.machine_root_angle == pytest.approx(radians(353 + 17 / 60), abs=1e-14)
    assert (on.sliding_base, on.blank_offset) == pytest.approx((19.79, -20.91), abs=1e-12)
    assert (on.ratio_gears, on.helical_gears) == (TILTED.ratio_gears, TILTED.helical_gears)
    guide = MACHINES["gleason-463"].rounded(replace(GROUND, cam_guide_angle=radians(-0.671)))
    assert guide.cam_guide_angle == pytest.approx(radians(-40 / 60), abs=1e-15)
    assert (guide.cam_number, guide.index_interval) == (23, 10)


def test_readings_as_a_person_writes_them() -> None:
    assert shown(radians(64 + 29 / 60), "angle") == "64 deg 29 min"
    assert shown(radians(-0.5), "angle") == "-0 deg 30 min"
    assert shown(radians(-1e-9), "angle") == "0 deg"
    assert shown(radians(59.99999999 / 60 + 3), "angle") == "4 deg"
    assert shown(19.78, "length") == "19.78 mm"
    table = MACHINES["gleason-122"].table
    assert table["ratio_gears"].words((53, 42, 48, 76)) == "53/42 x 48/76"
    assert table["helical_gears"].words(()) == "none"


def test_turns() -> None:
    assert full_turn(-0.5) == pytest.approx(tau - 0.5)
    assert full_turn(tau) == full_turn(-1e-16) == 0.0
    assert half_turn(pi) == pi
    assert half_turn(1.5 * pi) == pytest.approx(-0.5 * pi)
