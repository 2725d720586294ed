"""Settings of a flank in a summary sheet: a method, a machine, and the dials of all machines by name.

Which of them a machine has, and what a method needs, stands in `_sheet_settings.py`.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import factorial
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema
from pydantic_core import PydanticCustomError

from hypoid.design import Method

from ._keys import (
    LARGEST,
    MOST,
    Angle,
    Coefficient,
    Length,
    LengthPerAngle,
    Settings,
    Table,
    any_angle,
    any_length,
    key,
    lead,
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
            expected = f"{error.expected} for order {order}; got {error.given}"
            about = {"expected": expected, "example": [*entries[: order - 1], error.example]}
            raise PydanticCustomError("quantity", "{expected}", about) from None
        if abs(values[-1]) > LARGEST:
            raise PydanticCustomError("entries", "up to 6 quantities")
    return values


_TEXTS = {"type": "array", "items": {"type": "string"}, "minItems": 1, "maxItems": ORDERS}
LengthMotion = Annotated[list[float], BeforeValidator(_read_motion), WithJsonSchema(_TEXTS)]
AngleMotion = Annotated[list[Coefficient], Field(min_length=1, max_length=ORDERS)]
Gears = Annotated[list[Annotated[int, Field(ge=12, le=200)]], Field(min_length=4, max_length=4)]


def _length_motion() -> Any:
    return key(
        f"up to 6 quantities, of orders 1 to 6 of the cradle angle, each up to {LARGEST:g} mm/rad^n",
        ["0.1 mm/rad", "0.01 mm/rad^2"],
        default=None,
    )


def _angle_motion() -> Any:
    return key(
        "up to 6 plain numbers (rad/rad, rad/rad^2, ...), of orders 1 to 6 of the cradle angle, "
        f"each up to {MOST:g} either way",
        [0.001, 0.0002],
        default=None,
    )


def _roll_term(example: float) -> Any:
    return key(f"a plain number of up to {MOST:g} either way", example, default=None)


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
    """settings of a member or a flank: a method, a machine, and that machine's dials by name."""

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
    roll_2c: Coefficient | None = _roll_term(0.0101)
    roll_6d: Coefficient | None = _roll_term(0.0068)
    roll_24e: Coefficient | None = _roll_term(-0.378)
    roll_120f: Coefficient | None = _roll_term(0.01)
    cutter_lead: LengthPerAngle | None = lead("0.5 mm/rad")
    motions: MotionsTable | None = key(
        "a table", {"sliding_base": ["0.1 mm/rad", "0.01 mm/rad^2"]}, default=None
    )
    # Dials of No. 106, 122 and 463.
    eccentric_angle: Angle | None = any_angle("64 deg 29 min")
    cutter_spindle_rotation_angle: Angle | None = any_angle("52 deg 41 min")
    ratio_gears: Gears | None = _gears([53, 42, 48, 76])
    helical_gears: Gears | None = _gears([52, 66, 82, 49])
    helical_direction: Literal[1, -1] | None = key(
        "1 (the sliding base grows with the cradle roll) or -1", 1, default=None
    )
    cam_number: int | None = key("a whole number from 1 to 999", 23, default=None, ge=1, le=999)
    cam_setting: Length | None = any_length("101.6 mm")
    cam_guide_angle: Angle | None = any_angle("5 deg 10 min")
    index_gears: Gears | None = _gears([48, 80, 50, 81])
    index_interval: int | None = key("a whole number from 1 to 200", 10, default=None, ge=1, le=200)


def plain_roll(terms: Mapping[str, float]) -> tuple[float, ...]:
    """c2, c3, ... of the field's 2C, 6D, 24E, 120F: work = R_a (q - C q**2 - D q**3 - ...)."""
    last = max(ROLL_TERMS.index(name) for name in terms)
    return tuple(
        -terms.get(name, 0.0) / factorial(order) + 0.0  # no negative zero
        for order, name in enumerate(ROLL_TERMS[: last + 1], start=2)
    )
