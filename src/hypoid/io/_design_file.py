"""The design file, schema 1: its tables and keys, their units and ranges, as pydantic models.

Every key carries what is expected of it and an example; messages and the JSON Schema are made of
these. What ties several keys together stands in `_problems.py`.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema
from pydantic_core import PydanticCustomError

from ._quantity import Kind, QuantityError, parse

_DEG = pi / 180
_LARGEST = 1e5  # mm; beyond any gear, within any arithmetic
_EPS = 1e-9  # rad; a limit that is itself allowed, through the rounding of its conversion


def _read_as(kind: Kind) -> Callable[[object], float]:
    def read(given: object) -> float:
        try:
            return parse(given, kind)
        except QuantityError as error:
            about = {"expected": error.expected, "example": error.example}
            raise PydanticCustomError("quantity", "{expected}", about) from None

    return read


_TEXT = WithJsonSchema({"type": "string"})
Length = Annotated[float, BeforeValidator(_read_as("length")), _TEXT]
Angle = Annotated[float, BeforeValidator(_read_as("angle")), _TEXT]
PerLength = Annotated[float, BeforeValidator(_read_as("per_length")), _TEXT]
LengthPerAngle = Annotated[float, BeforeValidator(_read_as("length_per_angle")), _TEXT]


def _key(expected: str, example: object, **more: Any) -> Any:
    """A key of a table: what is expected of it, an example, and its range or default."""
    return Field(description=expected, examples=[example], **more)


class Table(BaseModel):
    """A table of the design file: no key but those named here, nothing converted in silence."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class Settings(Table):
    """Basic machine settings of a flank, in the words of a summary sheet; what is given holds."""

    radial_distance: Length | None = _key("a length above 0", "108.966 mm", default=None, gt=0)
    cradle_angle: Angle | None = _key("an angle", "47.606 deg", default=None)
    tilt_angle: Angle | None = _key("an angle", "0 deg", default=None)
    swivel_angle: Angle | None = _key("an angle", "0 deg", default=None)
    blank_offset: Length | None = _key("a length", "-55.489 mm", default=None)
    machine_root_angle: Angle | None = _key("an angle", "10.791 deg", default=None)
    machine_center_to_back: Length | None = _key("a length", "18.029 mm", default=None)
    sliding_base: Length | None = _key("a length", "-3.376 mm", default=None)
    ratio_of_roll: float | None = _key("a plain number above 0", 12.431511, default=None, gt=0)
    helical_motion: LengthPerAngle | None = _key("length per angle", "0.1 mm/rad", default=None)
    modified_roll: list[float] | None = _key(
        "up to 5 plain numbers, of orders 2 to 6",
        [0.0, 0.001],
        default=None,
        max_length=5,
    )


class Flank(Table):
    """One flank of a member."""

    settings: Settings = _key("a table", {}, default=Settings())


class Member(Table):
    """What both members may carry."""

    settings: Settings = _key("a table", {}, default=Settings())
    concave: Flank = _key("a table", {}, default=Flank())
    convex: Flank = _key("a table", {}, default=Flank())


class Pinion(Member):
    """[pinion]."""

    teeth: int = _key("a whole number from 1 to 1000", 6, ge=1, le=1000)
    hand: Literal["left", "right"] = _key('"left" or "right"', "left")
    mean_spiral_angle: Angle = _key(
        "an angle from 0 to below 80 deg", "65 deg", ge=0, lt=80 * _DEG - _EPS
    )


class Wheel(Member):
    """[wheel]; the mean pitch radius or the mean pitch diameter, one of them."""

    teeth: int = _key("a whole number from 1 to 1000, above pinion.teeth", 73, ge=1, le=1000)
    mean_pitch_radius: Length | None = _key(
        "a length above 0", "130 mm", default=None, gt=0, le=_LARGEST
    )
    mean_pitch_diameter: Length | None = _key(
        "a length above 0", "260 mm", default=None, gt=0, le=2 * _LARGEST
    )
    face_width: Length = _key("a length above 0", "35 mm", gt=0, le=_LARGEST)


class Pair(Table):
    """[pair]."""

    shaft_angle: Angle = _key(
        "an angle from 30 to 150 deg", "90 deg", ge=30 * _DEG - _EPS, le=150 * _DEG + _EPS
    )
    offset: Length = _key(
        "a length of 0 or more, within the wheel's mean pitch radius", "55 mm", ge=0
    )


class Blank(Table):
    """[blank]: tooth depths in data type II of ISO 23509."""

    mean_addendum_factor: float = _key("a plain number from 0 to 1", 0.5, default=0.5, ge=0, le=1)
    depth_factor: float = _key("a plain number above 0, up to 4", 1.75, default=1.75, gt=0, le=4)
    clearance_factor: float = _key("a plain number from 0 to 1", 0.125, default=0.125, ge=0, le=1)


class Relief(Table):
    """tip_relief of the cutting edges."""

    coefficient: PerLength = _key("a number per length, 0 or more", "0.004 /mm", ge=0, le=_LARGEST)
    height: Length = _key("a length above 0", "1.5 mm", gt=0, le=_LARGEST)
    measured_from: Literal["tip", "pitch"] = _key(
        '"tip" or "pitch", where the height starts', "tip", default="tip", alias="from"
    )
    flanks: Literal["drive", "coast", "both"] = _key(
        '"drive", "coast" or "both"', "both", default="both"
    )


class Cutting(Table):
    """[cutting]: the method, and the head-cutter it uses."""

    method: Literal["exact-face-hobbed"] = _key('"exact-face-hobbed"', "exact-face-hobbed")
    cutter_radius: Length = _key("a length above 0", "100 mm", gt=0, le=_LARGEST)
    blade_groups: int = _key("a whole number from 1 to 100", 5, ge=1, le=100)
    pressure_angle: Angle = _key(
        "an angle above 0 and below 45 deg", "20 deg", gt=0, lt=45 * _DEG - _EPS
    )
    tip_edge_radius_factor: float = _key(
        "a plain number of 0 or more, times the mean normal module",
        0.38, default=0.38, ge=0, le=4,
    )  # fmt: skip
    tip_relief: Relief | None = _key(
        "a table", {"coefficient": "0.004 /mm", "height": "1.5 mm"}, default=None
    )


class Contact(Table):
    """[contact]."""

    marking_thickness: Length = _key(
        "a length above 0", "0.0065 mm", default="6.35 um", validate_default=True, gt=0, le=_LARGEST
    )


class Assumed(Table):
    """[[assumed]]: a value that the source does not give."""

    value: str = _key("the path of a key in this file", "pinion.hand", min_length=1)
    reason: str = _key("why this value was chosen", "Fig. A.16 shows a left-hand pinion")


class DesignFile(Table):
    """A design file of schema 1."""

    schema_version: Literal[1] = _key("1, the version of this format", 1, alias="schema")
    title: str = _key("a text", "High-reduction hypoid 6 x 73", default="Untitled pair")
    source: str = _key("a text", "Gonzalez-Perez 2022, Table 1", default="")
    pair: Pair = _key("a table", {"shaft_angle": "90 deg", "offset": "55 mm"})
    pinion: Pinion = _key("a table", {"teeth": 6, "hand": "left", "mean_spiral_angle": "65 deg"})
    wheel: Wheel = _key(
        "a table", {"teeth": 73, "mean_pitch_radius": "130 mm", "face_width": "35 mm"}
    )
    blank: Blank = _key("a table", {"depth_factor": 1.75}, default=Blank())
    cutting: Cutting = _key(
        "a table",
        {
            "method": "exact-face-hobbed",
            "cutter_radius": "100 mm",
            "blade_groups": 5,
            "pressure_angle": "20 deg",
        },
    )
    contact: Contact = _key("a table", {"marking_thickness": "0.0065 mm"}, default=Contact())
    assumed: list[Assumed] = _key("tables [[assumed]]", [], default=[])


def json_schema() -> dict[str, Any]:
    """JSON Schema of the design file, for editors that complete and check TOML."""
    schema = DesignFile.model_json_schema(by_alias=True)
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
