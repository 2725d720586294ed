"""All that is wrong with a design file, at once: each key with what was given and what works."""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Annotated, Any, get_origin

from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from hypoid.geometry import Problem

from ._design_file import DesignFile
from ._design_rules import design_rules
from ._document import (
    MEMBERS,
    Document,
    Location,
    assigned,
    did_you_mean,
    line,
    path_of,
    paths,
    shown,
    table_at,
    toml,
    value_at,
)
from ._keys import LARGEST, DesignTable, keys_of, table_of
from ._request_file import RequestFile
from ._request_rules import request_rules
from ._sheet_file import SummarySheetFile
from ._sheet_rules import sheet_rules
from ._sheet_settings import range_rules


@dataclass(frozen=True)
class Form:
    """One kind of design file: its tables, and what ties their keys together."""

    model: type[DesignTable]
    rules: Callable[[Document], Iterator[Problem]]
    # What the build finds, too: told only along with other faults, for it takes its time.
    late_rules: Callable[[Document], Iterator[Problem]] | None = None


DESIGNED = Form(DesignFile, design_rules)
SHEET = Form(SummarySheetFile, sheet_rules, range_rules)
REQUEST = Form(RequestFile, request_rules)


def form_of(document: Document) -> Form | tuple[Problem, ...]:
    """Which kind of design file this is, or why it is none."""
    members = {name: document[name] for name in MEMBERS if name in document}
    tables = {name: t for name, t in members.items() if isinstance(t, Mapping)}
    blanks = [name for name, table in tables.items() if "blank" in table]
    if "cutting" in document and blanks:
        given = f"[cutting] and [{blanks[0]}.blank]"
        return (Problem("cutting", given, f"one of them: {_KINDS}", _EXAMPLE),)
    if blanks:
        return SHEET
    if "process" in table_at(document, "cutting"):
        return REQUEST
    if "cutting" in document:
        return DESIGNED
    faults = [
        Problem(name, shown(value), f"one table, [{name}]", line(SummarySheetFile, name))
        for name, value in members.items()
        if name not in tables
    ]
    hint = _hint(document, tables)
    return tuple(faults) or (
        Problem("cutting", "neither [cutting] nor a blank", f"{_KINDS}{hint}", _EXAMPLE),
    )


_KINDS = (
    "[cutting], for a pair that the program designs, or [pinion.blank] and [wheel.blank], "
    "for a summary sheet"
)
_EXAMPLE = assigned("cutting", {"method": "exact-face-hobbed", "cutter_radius": "100 mm"})


def _hint(document: Document, members: Mapping[str, Document]) -> str:
    """The table that a slip may have hidden."""
    words = {f"{name}.{key}": f"{name}.blank" for name, table in members.items() for key in table}
    words |= dict.fromkeys(document, "cutting")
    for given, meant in words.items():
        if get_close_matches(given.split(".")[-1], [meant.split(".")[-1]], cutoff=0.75):
            return f"; is [{given}] meant to be [{meant}]?"
    return ""


def problems_of(document: Document, form: Form) -> tuple[Problem, ...]:
    """Every fault of a parsed design file, key by key and between keys; none for a good one.

    Each path is told once, and what follows from a fault above it not at all.
    """
    found: dict[str, Problem] = {}

    def tell(problems: Iterable[Problem]) -> None:
        for problem in problems:
            if not _covered(problem.path, found):
                found[problem.path] = problem

    try:
        form.model.model_validate(document)
    except ValidationError as error:
        details = error.errors(include_url=False)
        found = {p.path: p for p in (_problem(d, document, form.model) for d in details)}
    tell(form.rules(document))
    if found and form.late_rules:
        tell(form.late_rules(document))
    tell(_unknown_assumptions(document, frozenset(found)))
    return tuple(found.values())


def _covered(path: str, told: Container[str]) -> bool:
    """Whether a path, or a table that it lies in, is among those told."""
    ends = [match.start() for match in re.finditer(r"[.\[]", path)]
    return any(path[:end] in told for end in (*ends, len(path)))


def _problem(error: ErrorDetails, document: Document, model: type[BaseModel]) -> Problem:
    loc = error["loc"]
    if isinstance(loc[-1], int):  # a list of numbers is told whole
        loc = loc[:-1]
    path = path_of(loc)
    if error["type"] == "extra_forbidden":
        keys = _keys(model, loc[:-1])
        near = get_close_matches(str(loc[-1]), keys, n=1)
        expected = f"one of {', '.join(keys)}{did_you_mean(str(loc[-1]), list(keys))}"
        key = (near or list(keys))[0]
        return Problem(
            path, "an unknown key", expected, assigned(key, (keys[key].examples or [""])[0])
        )
    name, field = _field(model, loc)
    expected = field.description or ""
    example = assigned(name, (field.examples or [""])[0])
    context = error.get("ctx", {})
    if error["type"] == "quantity":
        expected = f"{expected}, as {error['msg']}"
        example = assigned(name, _first_that_works(field, context["example"]))
    elif error["type"] == "stiffness":
        expected = f"{expected}; this is {error['msg']}"
    elif (most := abs(context.get("le", context.get("ge", 0)))) in (LARGEST, 2 * LARGEST):
        expected += f", up to {most / 1e3:g} m"
    given = "nothing" if error["type"] == "missing" else shown(value_at(document, loc))
    return Problem(path, given, expected, example)


def _first_that_works(field: FieldInfo, offered: Any) -> Any:
    """What is offered for a key, or its usual example where that cannot stand there."""
    wanted: Any = (
        Annotated[field.annotation, *field.metadata] if field.metadata else field.annotation
    )
    try:
        TypeAdapter(wanted).validate_python(offered)
    except ValidationError:
        return (field.examples or [""])[0]
    return offered


def _unknown_assumptions(document: Document, told: Container[str]) -> Iterator[Problem]:
    """What [[assumed]] names must be there, or the reason would be read with no value."""
    entries = document.get("assumed")
    for index, entry in enumerate(entries if isinstance(entries, list) else []):
        value = value_at(entry, ("value",))
        if not isinstance(value, str) or not value or _covered(value, told):
            continue
        if value_at(document, tuple(value.split("."))) is None:
            expected = "the path of a key in this file" + did_you_mean(value, paths(document))
            example = 'value = "pair.shaft_angle"'
            yield Problem(f"assumed[{index}].value", toml(value), expected, example)


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
