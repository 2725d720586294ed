"""The design file of a summary sheet: blank, cutter and machine settings of both members.

A key at a flank goes before the same key at its member. One model holds the dials of all machines;
which of them a machine has, and what a method needs, stands in `_sheet_rules.py`.
"""

from __future__ import annotations

from math import factorial
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema
from pydantic_core import PydanticCustomError

from hypoid.design import Method

from ._keys import (
    DEG,
    EPS,
    LARGEST,
    Angle,
    DesignTable,
    Length,
    LengthPerAngle,
    Pair,
    PerLength,
    Settings,
    Table,
    key,
)
from ._quantity import Kind, QuantityError, parse

ORDERS = 6  # of the cradle angle
ROLL_TERMS = ("roll_2c", "roll_6d", "roll_24e", "roll_120f")  # of orders 2, 3, 4, 5
_PER: tuple[Kind, ...] = (
    "length_per_angle", "length_per_angle^2", "length_per_angle^3",
    "length_per_angle^4", "length_per_angle^5", "length_per_angle^6",
)  # fmt: skip


def _read_motion(given: object) -> list[float]:
    """Coefficients of a length by orders of the angle, each with the unit of its order."""
    entries: list[object] = given if isinstance(given, list) else []  # pyright: ignore[reportUnknownVariableType]
    if not 1 <= len(entries) <= ORDERS:
        raise PydanticCustomError("entries", "up to 6 quantities")
    values: list[float] = []
    for order, (entry, kind) in enumerate(zip(entries, _PER, strict=False), start=1):
        try:
            values.append(parse(entry, kind))
        except QuantityError as error:
            example = [f"0.1 {unit}" for unit in ("mm/rad", "mm/rad^2", "mm/rad^3")][:order]
            about = {
                "expected": f"{error.expected} for order {order}; got {error.given}",
                "example": example
                if order < 4
                else [*map(str, entries[: order - 1]), error.example],
            }
            raise PydanticCustomError("quantity", "{expected}", about) from None
    return values


_TEXTS = {"type": "array", "items": {"type": "string"}, "minItems": 1, "maxItems": ORDERS}
LengthMotion = Annotated[list[float], BeforeValidator(_read_motion), WithJsonSchema(_TEXTS)]
AngleMotion = Annotated[list[float], Field(min_length=1, max_length=ORDERS)]
Gears = Annotated[list[Annotated[int, Field(ge=12, le=200)]], Field(min_length=4, max_length=4)]


def _length_motion() -> Any:
    return key(
        "up to 6 quantities, of orders 1 to 6 of the cradle angle",
        ["0.1 mm/rad", "0.01 mm/rad^2"],
        default=None,
    )


def _angle_motion() -> Any:
    return key(
        "up to 6 plain numbers (rad/rad, rad/rad^2, ...), of orders 1 to 6 of the cradle angle",
        [0.001, 0.0002],
        default=None,
    )


def _gears(example: list[int]) -> Any:
    return key(
        "four whole numbers (driver, driven, driver, driven), each from 12 to 200 teeth",
        example,
        default=None,
    )


class MotionsTable(Table):
    """motions: how the axes of a basic machine move with the cradle."""

    radial_distance: LengthMotion | None = _length_motion()
    tilt_angle: AngleMotion | None = _angle_motion()
    swivel_angle: AngleMotion | None = _angle_motion()
    blank_offset: LengthMotion | None = _length_motion()
    machine_root_angle: AngleMotion | None = _angle_motion()
    machine_center_to_back: LengthMotion | None = _length_motion()
    sliding_base: LengthMotion | None = _length_motion()


class SheetSettings(Settings):
    """Settings of a flank: a method, a machine, and that machine's dials by name."""

    method: Method | None = key(
        '"generated", "formate", "helixform", "modified-roll", "tilt", "duplex" or '
        '"helical-duplex"',
        "generated",
        default=None,
    )
    machine: Literal["basic", "gleason-106", "gleason-122", "gleason-463"] | None = key(
        '"basic", "gleason-106", "gleason-122" or "gleason-463"', "basic", default=None
    )
    # More of the basic machine.
    roll_2c: float | None = key("a plain number", 0.0101, default=None)
    roll_6d: float | None = key("a plain number", 0.0068, default=None)
    roll_24e: float | None = key("a plain number", -0.378, default=None)
    roll_120f: float | None = key("a plain number", 0.01, default=None)
    cutter_lead: LengthPerAngle | None = key("length per angle", "0.5 mm/rad", default=None)
    motions: MotionsTable | None = key(
        "a table", {"sliding_base": ["0.1 mm/rad", "0.01 mm/rad^2"]}, default=None
    )
    # Dials of No. 106, 122 and 463.
    eccentric_angle: Angle | None = key("an angle", "64 deg 29 min", default=None)
    cutter_spindle_rotation_angle: Angle | None = key("an angle", "52 deg 41 min", default=None)
    ratio_gears: Gears | None = _gears([53, 42, 48, 76])
    helical_gears: Gears | None = _gears([52, 66, 82, 49])
    helical_direction: Literal[1, -1] | None = key(
        "1 (the sliding base grows with the cradle roll) or -1", 1, default=None
    )
    cam_number: int | None = key("a whole number from 1 to 999", 23, default=None, ge=1, le=999)
    cam_setting: Length | None = key("a length", "101.6 mm", default=None)
    cam_guide_angle: Angle | None = key("an angle", "5 deg 10 min", default=None)
    index_gears: Gears | None = _gears([48, 80, 50, 81])
    index_interval: int | None = key("a whole number from 1 to 200", 10, default=None, ge=1, le=200)


class TopremTable(Table):
    """toprem of a blade."""

    angle: Angle = key("an angle above 0, off the flank", "7 deg", gt=0)
    height: Length = key("a length above 0, from the tips to the kink", "1.5 mm", gt=0, le=LARGEST)


class FlankremTable(Table):
    """flankrem of a blade: straight by its angle, or a parabola by its coefficient."""

    height: Length = key("a length above 0, from the tips", "10 mm", gt=0, le=LARGEST)
    angle: Angle | None = key("an angle above 0, off the flank", "2 deg", default=None, gt=0)
    coefficient: PerLength | None = key(
        "a number per length, above 0", "0.004 /mm", default=None, gt=0
    )


class BladeTable(Table):
    """The blade of a flank; the outside blade cuts the concave one."""

    angle: Angle | None = key("an angle from above -10 to below 60 deg", "20 deg", default=None)
    edge_radius: Length | None = key("a length of 0 or more", "1 mm", default=None, ge=0)
    point_diameter: Length | None = key(
        "a length above 0", "250.952 mm", default=None, gt=0, le=LARGEST
    )
    profile: Literal["straight", "circular-arc", "parabola"] | None = key(
        '"straight", "circular-arc" or "parabola"', "straight", default=None
    )
    radius: Length | None = key(
        "a length other than 0, positive to crown the tooth", "800 mm", default=None
    )
    coefficient: PerLength | None = key(
        "a number per length, positive to crown the tooth", "0.0005 /mm", default=None
    )
    reference_height: Length | None = key(
        "a length of 0 or more above the tips, where a curved blade has its angle",
        "5 mm",
        default=None,
        ge=0,
    )
    toprem: TopremTable | None = key(
        "a table", {"angle": "7 deg", "height": "1.5 mm"}, default=None
    )
    flankrem: FlankremTable | None = key(
        "a table", {"height": "10 mm", "angle": "2 deg"}, default=None
    )


class CutterTable(Table):
    """[pinion.cutter]: diameter and point width of a spread-blade cutter, or only its type."""

    type: Literal["face-mill"] = key('"face-mill"', "face-mill")
    diameter: Length | None = key(
        "a length above 0, to the middle of the point width", "9 in", default=None, gt=0, le=LARGEST
    )
    point_width: Length | None = key("a length above 0", "0.1 in", default=None, gt=0, le=LARGEST)
    height: Length | None = key("a length above 0", "15 mm", default=None, gt=0, le=LARGEST)


class GivenBlankTable(Table):
    """[pinion.blank]: the numbers of a drawing; the heel by cone distance and addendum, or by crown."""

    pitch_angle: Angle = key(
        "an angle between 0 and 90 deg", "22 deg 4 min", gt=EPS, lt=90 * DEG - EPS
    )
    face_width: Length = key("a length above 0", "25 mm", gt=0, le=LARGEST)
    mean_spiral_angle: Angle = key(
        "an angle from 0 to below 80 deg", "35 deg", ge=0, lt=80 * DEG - EPS
    )
    face_angle: Angle = key("an angle between 0 and 120 deg", "23 deg 45 min", gt=0, lt=120 * DEG)
    outer_cone_distance: Length | None = key(
        "a length above 0", "155.55 mm", default=None, gt=0, le=LARGEST
    )
    outer_addendum: Length | None = key(
        "a length of 0 or more", "9.9 mm", default=None, ge=0, le=LARGEST
    )
    outside_diameter: Length | None = key(
        "a length above 0", "128.725 mm", default=None, gt=0, le=LARGEST
    )
    pitch_apex_to_crown: Length | None = key(
        "a length", "148.381 mm", default=None, ge=-LARGEST, le=LARGEST
    )
    outer_dedendum: Length | None = key(
        "a length of 0 or more", "11.45 mm", default=None, ge=0, le=LARGEST
    )
    root_angle: Angle | None = key(
        "an angle between -30 and 90 deg", "76 deg 26 min", default=None, gt=-30 * DEG, lt=90 * DEG
    )


class SheetFlank(Table):
    """One flank of a member."""

    settings: SheetSettings = key(
        "a table", {"cradle_angle": "67 deg 3 min"}, default=SheetSettings()
    )
    blade: BladeTable = key("a table", {"angle": "20 deg"}, default=BladeTable())


class SheetMember(Table):
    """[pinion], [wheel]."""

    teeth: int = key("a whole number from 1 to 1000", 27, ge=1, le=1000)
    hand: Literal["left", "right"] = key('"left" or "right"', "left")
    blank: GivenBlankTable = key("a table", {"pitch_angle": "22 deg 4 min", "face_width": "25 mm"})
    cutter: CutterTable = key("a table", {"type": "face-mill"})
    settings: SheetSettings = key("a table", {"method": "generated"}, default=SheetSettings())
    blade: BladeTable = key("a table", {"edge_radius": "1 mm"}, default=BladeTable())
    concave: SheetFlank = key("a table", {}, default=SheetFlank())
    convex: SheetFlank = key("a table", {}, default=SheetFlank())


class SheetPair(Pair):
    """[pair]."""

    offset: Length = key("a length of 0 or more", "20 mm", ge=0)


class CamTable(Table):
    """One generating cam of a No. 463."""

    pitch_radius: Length = key("a length above 0", "70.302 mm", gt=0, le=LARGEST)
    nominal_setting: Length = key("a length", "101.6 mm")
    half_breadth: Length | None = key("a length above 0", "20 mm", default=None, gt=0, le=LARGEST)


class Grinder463Table(Table):
    """[machine.gleason-463]: what each grinder has of its own."""

    swivel_offset: Length = key("a length above 0", "381 mm", gt=0, le=LARGEST)
    cams: dict[str, CamTable] = key(
        "a table by cam number, a whole number from 1 to 999",
        {"23": {"pitch_radius": "70.302 mm", "nominal_setting": "101.6 mm"}},
    )


class MachineTable(Table):
    """[machine]: what each machine of its kind has of its own."""

    gleason_463: Grinder463Table | None = key(
        "a table", {"swivel_offset": "381 mm", "cams": {}}, default=None, alias="gleason-463"
    )


class SummarySheetFile(DesignTable):
    """A design file of schema 1 with a blank at each member: a summary sheet."""

    pair: SheetPair = key("a table", {"shaft_angle": "90 deg", "offset": "20 mm"})
    pinion: SheetMember = key("a table", {"teeth": 27, "hand": "right"})
    wheel: SheetMember = key("a table", {"teeth": 28, "hand": "left"})
    machine: MachineTable = key("a table", {}, default=MachineTable())


def plain_roll(terms: dict[str, float]) -> tuple[float, ...]:
    """c2, c3, ... of the field's 2C, 6D, 24E, 120F: work = R_a (q - C q**2 - D q**3 - ...)."""
    last = max(ROLL_TERMS.index(name) for name in terms)
    return tuple(
        -terms.get(name, 0.0) / factorial(order) + 0.0  # no negative zero
        for order, name in enumerate(ROLL_TERMS[: last + 1], start=2)
    )
