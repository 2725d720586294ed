"""What every design file is made of: quantities as keys, tables that refuse what they do not know.

Every key carries what is expected of it and an example; messages and the JSON Schema are made of
these.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from typing import Annotated, Any, Literal, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError

from hypoid.design import STIFFNESS_EXAMPLE, STIFFNESS_EXPECTED, bearing_compliance

from ._quantity import Kind, QuantityError, parse

DEG = pi / 180
LARGEST = 1e5  # mm; beyond any gear, within any arithmetic
MOST = 1e3  # of a coefficient, in the unit of its key
MOST_TEETH = 1000
EPS = 1e-9  # rad; a limit that is itself allowed, through the rounding of its conversion


def read_as(kind: Kind) -> Callable[[object], float]:
    """A validator that reads a quantity of that kind."""

    def read(given: object) -> float:
        try:
            return parse(given, kind)
        except QuantityError as error:
            about = {"expected": error.expected, "example": error.example}
            raise PydanticCustomError("quantity", "{expected}", about) from None

    return read


_TEXT = WithJsonSchema({"type": "string"})
Length = Annotated[float, BeforeValidator(read_as("length")), _TEXT]
Angle = Annotated[float, BeforeValidator(read_as("angle")), _TEXT]
PerLength = Annotated[float, BeforeValidator(read_as("per_length")), _TEXT]
LengthPerAngle = Annotated[float, BeforeValidator(read_as("length_per_angle")), _TEXT]


Coefficient = Annotated[float, Field(ge=-MOST, le=MOST)]


def key(expected: str, example: object, **more: Any) -> Any:
    """A key of a table: what is expected of it, an example, and its range or default."""
    return Field(description=expected, examples=[example], **more)


def any_length(example: str) -> Any:
    """A key for a length of either sign that need not be given."""
    return key("a length", example, default=None, ge=-LARGEST, le=LARGEST)


def any_angle(example: str) -> Any:
    """A key for an angle of either sign that need not be given."""
    most = 360 * DEG + EPS
    return key("an angle of up to 360 deg either way", example, default=None, ge=-most, le=most)


def lead(example: str) -> Any:
    """A key for a length per angle of either sign that need not be given."""
    expected = f"a length per angle of up to {MOST:g} mm/rad either way"
    return key(expected, example, default=None, ge=-MOST, le=MOST)


class Table(BaseModel):
    """A table of the design file: no key but those named here, nothing converted in silence."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class Settings(Table):
    """Basic machine settings of a flank, in the words of a summary sheet; what is given holds."""

    radial_distance: Length | None = key(
        "a length above 0", "108.966 mm", default=None, gt=0, le=LARGEST
    )
    cradle_angle: Angle | None = any_angle("47.606 deg")
    tilt_angle: Angle | None = any_angle("0.3 deg")
    swivel_angle: Angle | None = any_angle("-35 deg")
    blank_offset: Length | None = any_length("-55.489 mm")
    machine_root_angle: Angle | None = any_angle("10.791 deg")
    machine_center_to_back: Length | None = any_length("18.029 mm")
    sliding_base: Length | None = any_length("-3.376 mm")
    ratio_of_roll: float | None = key(
        "a plain number above 0, up to 1000", 12.431511, default=None, gt=0, le=1000
    )
    helical_motion: LengthPerAngle | None = lead("0.1 mm/rad")
    modified_roll: list[Coefficient] | None = key(
        f"up to 5 plain numbers, of orders 2 to 6, each up to {MOST:g} either way",
        [0.0, 0.001],
        default=None,
        max_length=5,
    )


class Pair(Table):
    """[pair]."""

    shaft_angle: Angle = key(
        "an angle from 30 to 150 deg", "90 deg", ge=30 * DEG - EPS, le=150 * DEG + EPS
    )
    offset: Length = key(
        "a length of 0 or more, within the wheel's mean pitch radius", "55 mm", ge=0, le=LARGEST
    )


class BodyTable(Table):
    """[pinion.body], [wheel.body]: what carries the teeth."""

    bore_diameter: Length | None = key("a length above 0", "40 mm", default=None, gt=0, le=LARGEST)
    mounting_distance: Length | None = any_length("95 mm")
    tip_rounding: Length = key(
        "a length from 0 to 1 mm, the radius between flank and top land",
        "0.2 mm",
        default="0 mm",
        validate_default=True,
        ge=0,
        le=1,
    )


def _read_stiffness(given: object) -> object:
    """A validator: what `bearing_compliance` takes."""
    try:
        bearing_compliance(given)  # pyright: ignore[reportArgumentType]
    except ValueError as error:
        about = {"why": str(error)}
        raise PydanticCustomError("stiffness", "{why}", about) from None
    return [[float(v) for v in row] for row in given]  # pyright: ignore


Stiffness = Annotated[list[list[float]], BeforeValidator(_read_stiffness)]


class SupportTable(Table):
    """[pinion.support], [wheel.support]: what holds the member's body."""

    held: Literal["bore", "back"] | None = key(
        '"bore" or "back", the face that its shaft holds', "bore", default=None
    )
    stiffness: Stiffness | None = key(STIFFNESS_EXPECTED, STIFFNESS_EXAMPLE, default=None)


class Contact(Table):
    """[contact]."""

    marking_thickness: Length = key(
        "a length above 0", "0.0065 mm", default="6.35 um", validate_default=True, gt=0, le=LARGEST
    )


class Assumed(Table):
    """[[assumed]]: a value that the source does not give."""

    value: str = key("the path of a key in this file", "pinion.hand", min_length=1)
    reason: str = key("why this value was chosen", "Fig. A.16 shows a left-hand pinion")


class DesignTable(Table):
    """What every design file says first."""

    schema_version: Literal[1] = key("1, the version of this format", 1, alias="schema")
    title: str = key("a text", "High-reduction hypoid 6 x 73", default="Untitled pair")
    source: str = key("a text", "Gonzalez-Perez 2022, Table 1", default="")
    contact: Contact = key("a table", {"marking_thickness": "0.0065 mm"}, default=Contact())
    assumed: list[Assumed] = key("tables [[assumed]]", [], default=[])


def keys_of(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """A table's keys as the file writes them."""
    return {field.alias or name: field for name, field in model.model_fields.items()}


def table_of(annotation: Any) -> type[BaseModel] | None:
    """The table in `Table`, `Table | None`, `list[Table]` or `dict[str, Table]`."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((table for part in get_args(annotation) if (table := table_of(part))), None)
