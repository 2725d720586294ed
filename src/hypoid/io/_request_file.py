"""The design file of a pair that is asked for by its blank: ISO 23509, a method a member, a contact.

What ties several keys together stands in `_request_rules.py`.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from hypoid.design import FREE

from ._keys import (
    DEG,
    EPS,
    LARGEST,
    MOST_TEETH,
    Angle,
    Contact,
    DesignTable,
    Length,
    LengthPerAngle,
    Pair,
    Table,
    any_angle,
    any_length,
    key,
    lead,
)

Share = Annotated[float, Field(ge=-1, le=1)]


def _spiral() -> object:
    return key("an angle from 0 to below 80 deg", "35 deg", default=None, ge=0, lt=80 * DEG - EPS)


def _diameter(example: str) -> object:
    return key("a length above 0", example, default=None, gt=0, le=2 * LARGEST)


def _curve(lacking: str) -> object:
    expected = f"a length other than 0, of stick blades, positive to crown the tooth; {lacking}"
    return key(expected, "762 mm", default=None, ge=-LARGEST, le=LARGEST)


class StickToprem(Table):
    """toprem of the pinion's stick blades."""

    angle: Angle = key(
        "an angle above 0 and below 30 deg, off the flank", "2.5 deg", gt=0, lt=30 * DEG
    )
    length: Length = key(
        "a length above 0, along the flank from the line of the tips", "1.6 mm", gt=0, le=LARGEST
    )


class RequestPair(Pair):
    """[pair]."""

    offset: Length = key("a length of 0 or more", "15 mm", ge=0, le=LARGEST)
    normal_backlash: Length = key(
        "a length of 0 or more, at the mean point", "0.15 mm", default="0.15 mm",
        validate_default=True, ge=0, le=LARGEST,
    )  # fmt: skip


class FixedTable(Table):
    """[pinion.fixed]: settings that keep a value, in the words and signs of a summary sheet."""

    radial_distance: Length | None = any_length("64.2 mm")
    tilt_angle: Angle | None = any_angle("20 deg")
    swivel_angle: Angle | None = any_angle("-50 deg")
    blank_offset: Length | None = any_length("-15 mm")
    machine_root_angle: Angle | None = any_angle("-5 deg")
    machine_center_to_back: Length | None = any_length("2 mm")
    sliding_base: Length | None = any_length("15 mm")
    ratio_of_roll: float | None = key(
        "a plain number above 0, up to 1000", 3.2, default=None, gt=0, le=1000
    )
    helical_motion: LengthPerAngle | None = lead("8 mm/rad")
    blade_angle: Angle | None = any_angle("20 deg")
    point_radius: Length | None = any_length("62 mm")
    cutter_radius: Length | None = any_length("63.5 mm")
    point_width: Length | None = any_length("1.6 mm")
    blade_radius: Length | None = any_length("88 mm")


def _range(example: list[str]) -> object:
    return key("two values, the least first", example, default=None, min_length=2, max_length=2)


class RangeTable(Table):
    """[pinion.range]: the least and the greatest that a setting may take."""

    radial_distance: list[Length] | None = _range(["50 mm", "90 mm"])  # pyright: ignore[reportAssignmentType]
    tilt_angle: list[Angle] | None = _range(["0 deg", "15 deg"])  # pyright: ignore[reportAssignmentType]
    swivel_angle: list[Angle] | None = _range(["-60 deg", "0 deg"])  # pyright: ignore[reportAssignmentType]
    blank_offset: list[Length] | None = _range(["-40 mm", "40 mm"])  # pyright: ignore[reportAssignmentType]
    machine_root_angle: list[Angle] | None = _range(["-10 deg", "60 deg"])  # pyright: ignore[reportAssignmentType]
    machine_center_to_back: list[Length] | None = _range(["-10 mm", "10 mm"])  # pyright: ignore[reportAssignmentType]
    sliding_base: list[Length] | None = _range(["-30 mm", "30 mm"])  # pyright: ignore[reportAssignmentType]
    ratio_of_roll: list[float] | None = _range(["2.5", "4"])  # pyright: ignore[reportAssignmentType]
    helical_motion: list[LengthPerAngle] | None = _range(["-10 mm/rad", "10 mm/rad"])  # pyright: ignore[reportAssignmentType]
    blade_angle: list[Angle] | None = _range(["14 deg", "26 deg"])  # pyright: ignore[reportAssignmentType]
    point_radius: list[Length] | None = _range(["55 mm", "70 mm"])  # pyright: ignore[reportAssignmentType]
    cutter_radius: list[Length] | None = _range(["60 mm", "67 mm"])  # pyright: ignore[reportAssignmentType]
    point_width: list[Length] | None = _range(["1.2 mm", "2 mm"])  # pyright: ignore[reportAssignmentType]
    blade_radius: list[Length] | None = _range(["87 mm", "89 mm"])  # pyright: ignore[reportAssignmentType]


class RequestPinion(Table):
    """[pinion]; `free`, `fixed`, `range` and `machine` say which settings a fit may move, and how far."""

    teeth: int = key("a whole number from 1 to 1000", 13, ge=1, le=MOST_TEETH)
    hand: Literal["left", "right"] = key('"left" or "right"', "left", default="left")
    mean_spiral_angle: Angle | None = _spiral()  # pyright: ignore[reportAssignmentType]
    method: Literal[
        "tilt", "modified-roll", "generated", "fixed-setting", "helical", "universal", "completing",
        "duplex-helical",
    ] = key(
        '"tilt", "modified-roll", "generated", "fixed-setting", "helical", "universal", "completing" or '
        '"duplex-helical"',
        "tilt", default="tilt",
    )  # fmt: skip
    machine: Literal["gleason-106", "gleason-122", "gleason-463"] | None = key(
        '"gleason-106", "gleason-122" or "gleason-463", whose dials bound the settings', "gleason-122",
        default=None,
    )  # fmt: skip
    free: list[str] = key(
        "names of settings that move beside the method's: " + ", ".join(FREE), ["blade_curvature"],
        default=[],
    )  # fmt: skip
    fixed: FixedTable = key("a table", {"tilt_angle": "10 deg"}, default=FixedTable())
    range: RangeTable = key("a table", {"tilt_angle": ["0 deg", "15 deg"]}, default=RangeTable())
    edge_radius: Length | None = key(
        "a length of 0 or more, of the blades", "0.6 mm", default=None, ge=0, le=LARGEST
    )
    curve_radius: Length | None = _curve("either flank's own where not given")  # pyright: ignore
    toprem: StickToprem | None = key(
        "a table, of the stick blades", {"angle": "2.5 deg", "length": "1.6 mm"}, default=None
    )


class RequestWheel(Table):
    """[wheel]; its size is a diameter or the module, one of them."""

    teeth: int = key("a whole number from 1 to 1000", 42, ge=1, le=MOST_TEETH)
    mean_spiral_angle: Angle | None = _spiral()  # pyright: ignore[reportAssignmentType]
    outer_pitch_diameter: Length | None = _diameter("170 mm")  # pyright: ignore[reportAssignmentType]
    mean_pitch_diameter: Length | None = _diameter("140 mm")  # pyright: ignore[reportAssignmentType]
    outer_transverse_module: Length | None = key(
        "a length above 0", "4 mm", default=None, gt=0, le=LARGEST
    )
    face_width: Length = key("a length above 0", "30 mm", gt=0, le=LARGEST)
    method: Literal["formate", "generated"] = key(
        '"formate" or "generated"', "formate", default="formate"
    )
    edge_radius: Length | None = key(
        "a length of 0 or more, of the blades", "0.8 mm", default=None, ge=0, le=LARGEST
    )
    curve_radius: Length | None = _curve("straight where not given")  # pyright: ignore


class RequestBlank(Table):
    """[blank]: ISO 23509's method, taper and tooth data of type II, or of type I."""

    method: Literal[0, 1, 2, 3] = key("0, 1, 2 or 3, the method of ISO 23509", 1)
    taper: Literal["standard", "uniform", "duplex", "modified"] = key(
        '"standard", "uniform", "duplex" or "modified"', "standard", default="standard"
    )
    wheel_addendum_angle: Angle | None = any_angle("1 deg")
    wheel_dedendum_angle: Angle | None = any_angle("4 deg")
    mean_addendum_factor: float | None = key(
        "a plain number from 0 to 1 (c_ham)", 0.35, default=None, ge=0, le=1
    )
    depth_factor: float | None = key(
        "a plain number above 0, up to 4 (k_d)", 2.0, default=None, gt=0, le=4
    )
    clearance_factor: float | None = key(
        "a plain number from 0 to 1 (k_c)", 0.125, default=None, ge=0, le=1
    )
    thickness_factor: float | None = key(
        "a plain number from -1 to 1 (k_t)", 0.1, default=None, ge=-1, le=1
    )
    addendum_coefficient: float | None = key(
        "a plain number above 0, up to 2 (k_hap)", 1.0, default=None, gt=0, le=2
    )
    dedendum_coefficient: float | None = key(
        "a plain number above 0, up to 3 (k_hfp)", 1.25, default=None, gt=0, le=3
    )
    profile_shift: float | None = key(
        "a plain number from -1 to 1 (x_hm1)", 0.3, default=None, ge=-1, le=1
    )
    thickness_modification: float | None = key(
        "a plain number from -1 to 1 (x_smn)", 0.05, default=None, ge=-1, le=1
    )


class RequestCutting(Table):
    """[cutting]: the process and its cutter."""

    process: Literal["face-milled", "face-hobbed"] = key(
        '"face-milled" or "face-hobbed"', "face-milled"
    )
    cutter: Literal["tri-ac", "exact"] | None = key(
        '"tri-ac" for stick blades, or "exact" for the exact system of generation: what hobs',
        "tri-ac", default=None,
    )  # fmt: skip
    cutter_radius: Length = key("a length above 0", "63.5 mm", gt=0, le=LARGEST)
    pressure_angle: Angle = key(
        "an angle above 0 and below 45 deg, of both sides", "20 deg", default="20 deg",
        validate_default=True, gt=0, lt=45 * DEG - EPS,
    )  # fmt: skip
    coast_pressure_angle: Angle | None = key(
        "an angle above 0 and below 45 deg, of the coast side where it is another", "23 deg",
        default=None, gt=0, lt=45 * DEG - EPS,
    )  # fmt: skip
    blade_groups: int | None = key(
        "a whole number from 1 to 100, of a face-hob head", 13, default=None, ge=1, le=100
    )
    equal_spacing: bool | None = key(
        "true or false: whether inner blades stand midway between outer ones (true where not given)",
        True, default=None,
    )  # fmt: skip
    eccentric_angle: Angle | None = key(
        "an angle from 0 to below 60 deg; the slope angle where not given", "18.85 deg",
        default=None, ge=0, lt=60 * DEG,
    )  # fmt: skip
    hook_angle: Angle | None = key(
        "an angle between -45 and 45 deg; 4.42 deg where not given", "4.42 deg",
        default=None, gt=-45 * DEG, lt=45 * DEG,
    )  # fmt: skip
    side_rake_angle: Angle | None = key(
        "an angle between -45 and 45 deg; 12 deg where not given", "12 deg",
        default=None, gt=-45 * DEG, lt=45 * DEG,
    )  # fmt: skip
    tip_edge_radius_factor: float | None = key(
        "a plain number of 0 or more, times the mean normal module, of the exact system; 0.3 where "
        "not given", 0.38, default=None, ge=0, le=4,
    )  # fmt: skip
    limit_share: float = key(
        "a plain number from 0 to 1: how far the sides are balanced about the limit pressure angle",
        1.0, default=1.0, ge=0, le=1,
    )  # fmt: skip


class TargetTable(Table):
    """[contact.drive], [contact.coast]: an ease-off by its parts, or a motion and a pattern."""

    lengthwise_crowning: Length | None = any_length("15 um")
    profile_crowning: Length | None = any_length("10 um")
    bias: Length | None = any_length("0 um")
    pressure_angle: Angle | None = any_angle("0 min")
    spiral_angle: Angle | None = any_angle("0 min")
    tip_relief: Length | None = any_length("10 um")
    relief_from: float | None = key(
        "a plain number from -1 (root) to 1 (tip)", 0.5, default=None, ge=-1, le=1
    )
    transmission_error: Angle | None = any_angle("50 urad")
    pattern_length: float | None = key(
        "a plain number above 0, up to 1: a share of the face", 0.5, default=None, ge=-10, le=10
    )
    place: list[Share] | None = key(
        "two plain numbers, from -1 (toe, root) to 1 (heel, tip)", [0.0, 0.0], default=None,
        min_length=2, max_length=2,
    )  # fmt: skip
    path_tilt: float | None = key(
        "a plain number from -5 to 5: how far the path goes lengthwise while it climbs", 0.0,
        default=None, ge=-5, le=5,
    )  # fmt: skip


class RequestContact(Contact):
    """[contact]."""

    tolerance: Length = key(
        "a length above 0: how far a flank may keep from its target", "5 um", default="5 um",
        validate_default=True, gt=0, le=1,
    )  # fmt: skip
    drive: TargetTable = key("a table", {"lengthwise_crowning": "15 um"}, default=TargetTable())
    coast: TargetTable = key("a table", {"lengthwise_crowning": "15 um"}, default=TargetTable())


class RequestFile(DesignTable):
    """A design file of schema 1 whose [cutting] names a process: the program finds the settings."""

    pair: RequestPair = key("a table", {"shaft_angle": "90 deg", "offset": "15 mm"})
    pinion: RequestPinion = key("a table", {"teeth": 13, "mean_spiral_angle": "50 deg"})
    wheel: RequestWheel = key(
        "a table", {"teeth": 42, "outer_pitch_diameter": "170 mm", "face_width": "30 mm"}
    )
    blank: RequestBlank = key("a table", {"method": 1})
    cutting: RequestCutting = key("a table", {"process": "face-milled", "cutter_radius": "63.5 mm"})
    contact: RequestContact = key(  # pyright: ignore[reportIncompatibleVariableOverride]
        "a table", {"tolerance": "5 um"}, default=RequestContact()
    )
