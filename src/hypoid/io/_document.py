"""A parsed file before it is checked: what it says at a place, and how messages show that."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import Any

from pydantic import BaseModel

from ._keys import keys_of
from ._quantity import Kind, QuantityError, parse

Location = tuple[int | str, ...]
Document = Mapping[str, Any]


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


def line(model: type[BaseModel], key: str) -> str:
    """A line of the file that would do for a key of a table."""
    return f"{key} = {toml((keys_of(model)[key].examples or [''])[0])}"


def shown(value: Any) -> str:
    """What was given, short."""
    text = "a table" if isinstance(value, Mapping) else "nothing" if value is None else toml(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def toml(value: Any) -> str:
    """A value in the notation of the file."""
    match value:
        case dict():
            return "{" + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + "}"
        case list():
            return "[" + ", ".join(map(toml, value)) + "]"
        case str() | bool():
            return json.dumps(value, ensure_ascii=False)
        case _:
            return str(value)


def did_you_mean(word: str, words: Sequence[str]) -> str:
    """`; did you mean teeth?`, or nothing where no word is near."""
    near = get_close_matches(word, words, n=1)
    return f"; did you mean {near[0]}?" if near else ""
