"""A parsed file before it is checked: what it says at a place, and how messages show that."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import Any

from pydantic import BaseModel

from ._keys import keys_of
from ._quantity import Kind, QuantityError, parse, written

Location = tuple[int | str, ...]
Document = Mapping[str, Any]
MEMBERS = ("pinion", "wheel")
SHORT, DEPTH = 60, 6  # characters and levels of what messages show


def value_at(document: Any, loc: Location) -> Any:
    """What the file says at a place, None where it says nothing."""
    for part in loc:
        if isinstance(document, Mapping):
            document = document.get(part)  # pyright: ignore[reportUnknownMemberType]
        elif isinstance(document, Sequence) and isinstance(part, int) and part < len(document):
            document = document[part]
        else:
            return None
    return document


def table_at(document: Any, path: str) -> Document:
    """The table at a dotted path; empty where there is none."""
    found = value_at(document, tuple(path.split(".")))
    return found if isinstance(found, Mapping) else {}  # pyright: ignore[reportUnknownVariableType]


def number_at(document: Any, path: str, kind: Kind) -> float | None:
    """The quantity at a dotted path, None where there is none that can be read."""
    try:
        return parse(value_at(document, tuple(path.split("."))), kind)
    except QuantityError:
        return None


def path_of(loc: Location) -> str:
    """A place as messages write it."""
    parts = (f"[{part}]" if isinstance(part, int) else f".{part}" for part in loc)
    return "".join(parts).removeprefix(".")


def paths(document: Document) -> list[str]:
    """Every key of a file as a dotted path, however deep."""
    found: list[str] = []
    tables: list[tuple[str, Document]] = [("", document)]
    while tables:
        before, table = tables.pop()
        for key, value in table.items():
            found.append(f"{before}{key}")
            if isinstance(value, Mapping):
                tables.append((f"{before}{key}.", value))  # pyright: ignore[reportUnknownArgumentType]
    return found


def line(model: type[BaseModel], key: str) -> str:
    """A line of the file that would do for a key of a table."""
    return assigned(key, (keys_of(model)[key].examples or [""])[0])


def assigned(key: str, value: Any) -> str:
    """A line that gives a key a value."""
    return f"{key} = {toml(value)}"


def left_out(key: str, value: Any) -> str:
    """The line of a key that must not stand, as a comment."""
    return f"# {key} = {shown(value)}"


def shown(value: Any) -> str:
    """What was given, short."""
    text = "nothing" if value is None else toml(value)
    if len(text) <= SHORT:
        return text
    return "a table" if isinstance(value, Mapping) else f"{text[: SHORT - 3]}..."


def toml(value: Any, depth: int = DEPTH) -> str:
    """A value in the notation of the file, as deep as it matters."""
    match value:
        case dict() | list() if not depth:
            return "..."
        case dict():
            return "{" + ", ".join(f"{k} = {toml(v, depth - 1)}" for k, v in value.items()) + "}"
        case list():
            return "[" + ", ".join(toml(entry, depth - 1) for entry in value) + "]"
        case str() | bool():
            return json.dumps(value, ensure_ascii=False)
        case _:
            return written(value)


def did_you_mean(word: str, words: Sequence[str]) -> str:
    """`; did you mean teeth?`, or nothing where no word is near."""
    near = get_close_matches(word, words, n=1)
    return f"; did you mean {near[0]}?" if near else ""
