"""All that is wrong with a design file, at once: each key with what was given and what works."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from hypoid.geometry import Problem

from ._design_file import DesignFile
from ._design_rules import design_rules
from ._document import Document, Location, did_you_mean, path_of, shown, toml, value_at
from ._keys import DesignTable, keys_of, table_of
from ._sheet_file import SummarySheetFile
from ._sheet_rules import sheet_rules


@dataclass(frozen=True)
class Form:
    """One kind of design file: its tables, and what ties their keys together."""

    model: type[DesignTable]
    rules: Callable[[Document], Iterator[Problem]]


DESIGNED = Form(DesignFile, design_rules)
SHEET = Form(SummarySheetFile, sheet_rules)


def form_of(document: Document) -> Form | Problem:
    """Which kind of design file this is, or why it is none."""
    if "cutting" in document:
        return DESIGNED
    members = {name: value_at(document, (name,)) for name in ("pinion", "wheel")}
    if any(isinstance(table, Mapping) and "blank" in table for table in members.values()):
        return SHEET
    words = [str(key) for table in members.values() if isinstance(table, Mapping) for key in table]
    near = [(w, f"{p}.{w}") for p, t in members.items() if isinstance(t, Mapping) for w in t]
    hint = next((w for w in document if get_close_matches(w, ["cutting"], cutoff=0.75)), "")
    hint = f"; is [{hint}] meant to be [cutting]?" if hint else ""
    for word in get_close_matches("blank", words, n=1, cutoff=0.75):
        where = next(path for name, path in near if name == word)
        hint = f"; is [{where}] meant to be [{where.split('.')[0]}.blank]?"
    expected = (
        "[cutting], for a pair that the program designs, or [pinion.blank] and [wheel.blank], "
        "for a summary sheet" + hint
    )
    return Problem("cutting", "neither [cutting] nor a blank", expected, _EXAMPLE)


_EXAMPLE = toml({"method": "exact-face-hobbed", "cutter_radius": "100 mm"}).join(("cutting = ", ""))


def problems_of(document: Document, form: Form) -> tuple[Problem, ...]:
    """Every fault of a parsed design file, key by key and between keys; none for a good one."""
    try:
        form.model.model_validate(document)
        faults: list[Problem] = []
    except ValidationError as error:
        found = error.errors(include_url=False)
        faults = [_problem(detail, document, form.model) for detail in found]
    known = {fault.path for fault in faults}
    between = (*form.rules(document), *_unknown_assumptions(document))
    return (*faults, *(p for p in between if p.path not in known))


def _problem(error: ErrorDetails, document: Document, model: type[BaseModel]) -> Problem:
    loc, path = error["loc"], path_of(error["loc"])
    if error["type"] == "extra_forbidden":
        keys = _keys(model, loc[:-1])
        near = get_close_matches(str(loc[-1]), keys, n=1)
        expected = f"one of {', '.join(keys)}{did_you_mean(str(loc[-1]), list(keys))}"
        key = (near or list(keys))[0]
        return Problem(path, "an unknown key", expected, _line(key, keys[key]))
    name, field = _field(model, loc)
    expected, example = field.description or "", _line(name, field)
    if error["type"] == "quantity":
        context = error.get("ctx", {})
        expected = f"{expected}, as {error['msg']}"
        example = f"{name} = {toml(context['example'])}"
    given = "nothing" if error["type"] == "missing" else shown(value_at(document, loc))
    return Problem(path, given, expected, example)


def _unknown_assumptions(document: Document) -> Iterator[Problem]:
    """What [[assumed]] names must be there, or the reason would be read with no value."""
    entries = document.get("assumed")
    for index, entry in enumerate(entries if isinstance(entries, list) else []):
        value = value_at(entry, ("value",))
        if not isinstance(value, str) or not value:
            continue
        if value_at(document, tuple(value.split("."))) is None:
            expected = "the path of a key in this file" + did_you_mean(
                value, list(_paths(document))
            )
            example = 'value = "pair.shaft_angle"'
            yield Problem(f"assumed[{index}].value", toml(value), expected, example)


def _paths(document: Document, before: str = "") -> Iterator[str]:
    for key, value in document.items():
        yield f"{before}{key}"
        if isinstance(value, Mapping):
            yield from _paths(value, f"{before}{key}.")  # pyright: ignore[reportUnknownArgumentType]


def _walk(model: type[BaseModel], loc: Location) -> tuple[type[BaseModel], str, FieldInfo | None]:
    """The table at a place, and the last named key on the way there."""
    name, field, entry = "", None, False
    for part in loc:
        if not isinstance(part, str):
            continue
        if entry:  # the name of an entry, as cams.23: the table is its field's
            entry = False
            continue
        if name and field is not None:
            model = table_of(field.annotation) or model
        name, field = part, keys_of(model)[part]
        entry = get_origin(field.annotation) is dict
    return model, name, field


def _keys(model: type[BaseModel], loc: Location) -> dict[str, FieldInfo]:
    """The keys that the table at a place may have."""
    model, _, field = _walk(model, loc)
    return keys_of((table_of(field.annotation) if field else None) or model)


def _field(model: type[BaseModel], loc: Location) -> tuple[str, FieldInfo]:
    """The key at a place; of a list's or table's entry, the key that holds them."""
    _, name, field = _walk(model, loc)
    assert field is not None
    return name, field


def _line(key: str, field: FieldInfo) -> str:
    """A line of the file that would do."""
    return f"{key} = {toml((field.examples or [''])[0])}"
