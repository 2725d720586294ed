"""Numbers that the program put in because the file does not give them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from pydantic import BaseModel

from hypoid.design import Assumption


def defaults_used(tables: Mapping[str, BaseModel | None]) -> Iterator[Assumption]:
    """The keys of these tables, by their paths, whose defaults stand."""
    for path, table in tables.items():
        for name, field in type(table).model_fields.items() if table else ():
            if (
                field.default is not None
                and not field.is_required()
                and name not in (table.model_fields_set if table else ())
            ):
                reason = f"not given; the program's default is {field.default}"
                yield Assumption(f"{path}.{field.alias or name}", reason)
