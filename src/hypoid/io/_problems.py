"""All that is wrong with a design file, at once: each key with what was given and what works."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from hypoid.geometry import Problem

from ._design_file import DesignFile
from ._quantity import QuantityError, parse

Location = tuple[int | str, ...]


def problems_of(document: Mapping[str, Any]) -> tuple[Problem, ...]:
    """Every fault of a parsed design file, key by key and between keys; none for a good one."""
    try:
        DesignFile.model_validate(document)
        faults: list[Problem] = []
    except ValidationError as error:
        faults = [_problem(detail, document) for detail in error.errors(include_url=False)]
    known = {fault.path for fault in faults}
    return (*faults, *(p for p in _between_keys(document) if p.path not in known))


def _problem(error: ErrorDetails, document: Mapping[str, Any]) -> Problem:
    loc, path = error["loc"], _path(error["loc"])
    if error["type"] == "extra_forbidden":
        keys = _keys(loc[:-1])
        near = get_close_matches(str(loc[-1]), keys, n=1)
        expected = f"one of {', '.join(keys)}" + (f"; did you mean {near[0]}?" if near else "")
        key = (near or list(keys))[0]
        return Problem(path, "an unknown key", expected, _line(key, keys[key]))
    field = _field(loc)
    expected, example = field.description or "", _line(_key_of(loc), field)
    if error["type"] == "quantity":
        context = error.get("ctx", {})
        expected = f"{expected}, as {error['msg']}"
        example = f"{_key_of(loc)} = {_toml(context['example'])}"
    given = "nothing" if error["type"] == "missing" else _shown(_value(document, loc))
    return Problem(path, given, expected, example)


def _between_keys(document: Mapping[str, Any]) -> Iterator[Problem]:
    """What ties keys together, as far as each of them can be read by itself."""
    wheel = _value(document, ("wheel",))
    if isinstance(wheel, Mapping):
        sizes = {"mean_pitch_radius", "mean_pitch_diameter"} & wheel.keys()
        if len(sizes) != 1:
            given = "both of them" if sizes else "nothing"
            expected = "either mean_pitch_radius or mean_pitch_diameter"
            yield Problem(
                "wheel.mean_pitch_radius", given, expected, 'mean_pitch_radius = "130 mm"'
            )
    few, many = (_value(document, (member, "teeth")) for member in ("pinion", "wheel"))
    if isinstance(few, int) and isinstance(many, int) and 1 <= many <= few:
        expected = f"more teeth than the pinion, which has {few}"
        yield Problem("wheel.teeth", str(many), expected, f"teeth = {few + 1}")
    radius = _length(document, "wheel.mean_pitch_radius")
    if radius is None:
        diameter = _length(document, "wheel.mean_pitch_diameter")
        radius = None if diameter is None else diameter / 2
    if radius is None or radius <= 0:
        return
    for path, limit, why in (
        ("pair.offset", radius, "the wheel's mean pitch radius: the offset lies beyond the wheel"),
        ("wheel.face_width", 2 * radius, "the wheel's mean pitch diameter: no cone is that wide"),
    ):
        length = _length(document, path)
        if length is not None and length >= limit:
            key, given = path.split(".")[1], _shown(_value(document, tuple(path.split("."))))
            example = f'{key} = "{0.25 * limit:g} mm"'
            yield Problem(path, given, f"less than {limit:g} mm, {why}", example)


def _length(document: Mapping[str, Any], path: str) -> float | None:
    try:
        return parse(_value(document, tuple(path.split("."))), "length")
    except QuantityError:
        return None


def _value(document: Any, loc: Location) -> Any:
    """What the file says at a place, None where it says nothing."""
    for part in loc:
        if isinstance(document, Mapping):
            document = document.get(part)  # pyright: ignore[reportUnknownMemberType]
        elif isinstance(document, Sequence) and isinstance(part, int) and part < len(document):
            document = document[part]
        else:
            return None
    return document


def _keys(loc: Location) -> dict[str, FieldInfo]:
    """The keys that the table at a place may have."""
    model: type[BaseModel] = DesignFile
    for part in loc:
        if isinstance(part, str):
            model = _table(_keys_of(model)[part].annotation) or model
    return _keys_of(model)


def _keys_of(model: type[BaseModel]) -> dict[str, FieldInfo]:
    return {field.alias or name: field for name, field in model.model_fields.items()}


def _table(annotation: Any) -> type[BaseModel] | None:
    """The table in `Table`, `Table | None` or `list[Table]`."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((table for part in get_args(annotation) if (table := _table(part))), None)


def _field(loc: Location) -> FieldInfo:
    names = [part for part in loc if isinstance(part, str)]
    return _keys(tuple(names[:-1]))[names[-1]]


def _key_of(loc: Location) -> str:
    return next(part for part in reversed(loc) if isinstance(part, str))


def _path(loc: Location) -> str:
    parts = (f"[{part}]" if isinstance(part, int) else f".{part}" for part in loc)
    return "".join(parts).removeprefix(".")


def _line(key: str, field: FieldInfo) -> str:
    """A line of the file that would do."""
    return f"{key} = {_toml((field.examples or [''])[0])}"


def _shown(value: Any) -> str:
    text = "a table" if isinstance(value, Mapping) else _toml(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _toml(value: Any) -> str:
    match value:
        case dict():
            return "{" + ", ".join(f"{k} = {_toml(v)}" for k, v in value.items()) + "}"
        case list():
            return "[" + ", ".join(map(_toml, value)) + "]"
        case str() | bool():
            return json.dumps(value, ensure_ascii=False)
        case _:
            return str(value)
