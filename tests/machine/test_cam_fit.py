"""The unknown cams of the 1996 paper from the angles its flanks were designed for."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, cos, degrees, hypot, radians, sin
from typing import Any, Literal

import pytest

from hypoid.geometry import DesignError
from hypoid.machine import (
    MACHINES,
    DesignAngles,
    DesignFlank,
    MachineSettings,
    MeanPoint,
    StraightBlade,
    Workpiece,
    fit_cam,
    mean_point_angles,
)
from hypoid.machine._gleason_463 import STAND_IN_463, Gleason463Dials

DESIGNED = DesignAngles(spiral=radians(35.0), pressure=radians(20.0))  # a prior of the notes


def minutes(degree: int, minute: int) -> float:
    return radians(degree + minute / 60)


def mean_point(outside_diameter: float, crown: float, pitch_angle: float, face: float) -> MeanPoint:
    """Middle of the face on the pitch cone, from the crown (Table 1): the back cone is square to it."""
    outer = crown * cos(pitch_angle) + 0.5 * outside_diameter * sin(pitch_angle)
    mean = outer - 0.5 * face
    return MeanPoint(mean * cos(pitch_angle), mean * sin(pitch_angle), pitch_angle)


PINION_AT = mean_point(128.725, 148.381, minutes(22, 4), 25.0)
GEAR_AT = mean_point(132.911, 147.452, minutes(22, 56), 25.0)
PINION_TRAIN = {"cam_number": 23, "cam_setting": 101.6, "index_gears": (48, 80, 50, 81)}
TABLE_2 = {
    "P-IB": Gleason463Dials(
        minutes(32, 49), minutes(67, 3), minutes(20, 26),
        cam_guide_angle=minutes(5, 10), index_interval=10, **PINION_TRAIN,
        machine_center_to_back=-9.013, sliding_base=3.146, blank_offset=-11.642,
    ),
    "P-OB": Gleason463Dials(
        minutes(32, 38), minutes(71, 45), minutes(20, 26),
        cam_guide_angle=0.0, index_interval=10, **PINION_TRAIN,
        machine_center_to_back=-8.463, sliding_base=2.964, blank_offset=-11.275,
    ),
    "gear": Gleason463Dials(
        minutes(35, 44), minutes(324, 59), minutes(21, 15),
        cam_number=29, cam_setting=76.2, cam_guide_angle=-minutes(0, 40),
        index_gears=(42, 70, 45, 84), index_interval=9,
        machine_center_to_back=-2.402, sliding_base=0.870, blank_offset=2.957,
    ),
}  # fmt: skip
PINION, GEAR = Workpiece(27, "right", STAND_IN_463), Workpiece(28, "left", STAND_IN_463)


def flank(name: str, work: Workpiece, at: MeanPoint, blade: StraightBlade) -> DesignFlank:
    settings = MACHINES["gleason-463"].to_basic(TABLE_2[name], work)
    return DesignFlank(settings, blade, at, DESIGNED)


PINION_FLANKS = [
    flank("P-IB", PINION, PINION_AT, StraightBlade("inside", 0.5 * 250.952, radians(21.0))),
    flank("P-OB", PINION, PINION_AT, StraightBlade("outside", 0.5 * 251.460, radians(19.0))),
]
GEAR_FLANKS = [
    flank("gear", GEAR, GEAR_AT, StraightBlade("inside", 0.5 * (250.0 - 2.413), radians(21.0))),
    flank("gear", GEAR, GEAR_AT, StraightBlade("outside", 0.5 * (250.0 + 2.413), radians(19.0))),
]


def with_cam(flank: DesignFlank, **changes: Any) -> DesignFlank:
    assert flank.settings.cam is not None
    cam = replace(flank.settings.cam, **changes)
    return replace(flank, settings=replace(flank.settings, cam=cam))


@pytest.mark.parametrize(
    ("flanks", "start", "ratio"),
    [(PINION_FLANKS, 90.0, 5.420), (GEAR_FLANKS, 45.0, 6.750)],
    ids=["No. 23", "No. 29"],
)
def test_lin_1996_cams_that_the_paper_does_not_give(
    flanks: list[DesignFlank], start: float, ratio: float
) -> None:
    """C/r_23 = 5.420, C/r_29 = 6.750, under 0.09 deg left on all eight angles (notes), from far off."""
    fit = fit_cam([with_cam(flank, pitch_radius=start) for flank in flanks])
    assert fit.offset_to_radius == pytest.approx(ratio, abs=5e-4)
    assert fit.pitch_radius == pytest.approx(381.0 / fit.offset_to_radius, rel=1e-12)
    assert len(fit.left) == 2
    for left in fit.left:
        assert abs(degrees(left.spiral)) < 0.09
        assert abs(degrees(left.pressure)) < 0.09


def test_only_the_ratio_of_both_constants_acts() -> None:
    """With the cam on its seat C and r_u scale together (notes)."""
    angles = [
        mean_point_angles(with_cam(f, swivel_offset=k * 381.0, pitch_radius=k * 70.302).settings, f.blade, f.at)
        for f in PINION_FLANKS[:1] for k in (1.0, 0.5)
    ]  # fmt: skip
    assert angles[0].spiral == pytest.approx(angles[1].spiral, abs=1e-9)
    assert angles[0].pressure == pytest.approx(angles[1].pressure, abs=1e-9)


def test_what_a_fit_leaves_is_least() -> None:
    """Half a per mille of C/r_u to either side is worse, and `left` is what the fitted cam leaves."""
    fit = fit_cam(PINION_FLANKS)

    def square(ratio: float) -> float:
        total = 0.0
        for f in PINION_FLANKS:
            ground = with_cam(f, pitch_radius=381.0 / ratio)
            got = mean_point_angles(ground.settings, f.blade, f.at)
            total += (got.spiral - DESIGNED.spiral) ** 2 + (got.pressure - DESIGNED.pressure) ** 2
        return total

    least = square(fit.offset_to_radius)
    assert sum(a.spiral**2 + a.pressure**2 for a in fit.left) == pytest.approx(least, rel=1e-9)
    for share in (0.9995, 1.0005):
        assert square(share * fit.offset_to_radius) > least


def test_known_cam_is_found_again() -> None:
    flanks = [
        replace(f, angles=mean_point_angles(with_cam(f, pitch_radius=63.7).settings, f.blade, f.at))
        for f in PINION_FLANKS
    ]
    assert fit_cam(flanks).pitch_radius == pytest.approx(63.7, rel=1e-7)


@pytest.mark.parametrize("side", ["inside", "outside"])
@pytest.mark.parametrize(("spiral", "blade"), [(35.0, 20.0), (10.0, 14.5), (-25.0, 22.0)])
def test_pitch_cone_rolling_on_the_crown_gear(
    side: Literal["inside", "outside"], spiral: float, blade: float
) -> None:
    """Textbook: tips in the pitch plane, roll 1/sin(pitch angle): spiral as laid out, pressure as the blade.

    The mean point lies on the line about which work and crown gear roll, so it meshes with any edge.
    """
    pitch, mean, radius = radians(30.0), 120.0, 90.0
    along, across = mean - radius * sin(radians(spiral)), radius * cos(radians(spiral))
    settings = MachineSettings(
        radial_distance=hypot(along, across),
        cradle_angle=atan2(across, along),
        machine_root_angle=pitch,
        ratio_of_roll=1.0 / sin(pitch),
        roll_to_blade_ratio=0.0,
    )
    at = MeanPoint(mean * cos(pitch), mean * sin(pitch), pitch)
    found = mean_point_angles(settings, StraightBlade(side, radius, radians(blade)), at)
    assert degrees(found.spiral) == pytest.approx(spiral, abs=1e-6)
    assert degrees(found.pressure) == pytest.approx(blade, abs=1e-6)
    form = replace(
        settings, generated=False
    )  # nothing rolls: the blade's own surface, at the same place
    plain = mean_point_angles(form, StraightBlade(side, radius, radians(blade)), at)
    assert plain.spiral == pytest.approx(found.spiral, abs=1e-8)
    assert plain.pressure == pytest.approx(found.pressure, abs=1e-8)


def test_flanks_without_a_cam_are_named() -> None:
    plain = replace(PINION_FLANKS[0], settings=replace(PINION_FLANKS[0].settings, cam=None))
    for flanks in ([], [plain], [PINION_FLANKS[0], plain]):
        with pytest.raises(DesignError, match="flanks ground with a cam"):
            fit_cam(flanks)


def test_place_that_the_flank_does_not_reach_is_named() -> None:
    f = PINION_FLANKS[0]
    with pytest.raises(DesignError, match="a point of the flank"):
        mean_point_angles(f.settings, f.blade, replace(f.at, radius=2000.0))
