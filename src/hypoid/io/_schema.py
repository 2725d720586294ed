"""JSON Schema of the design file, for editors that complete and check TOML."""

from __future__ import annotations

from typing import Any

from pydantic.json_schema import models_json_schema

from ._design_file import DesignFile
from ._request_file import RequestFile
from ._sheet_file import SummarySheetFile


def json_schema() -> dict[str, Any]:
    """Schema of all kinds of file: exact face-hobbed, a summary sheet, a pair asked for by its blank."""
    kinds = (DesignFile, SummarySheetFile, RequestFile)
    _, schema = models_json_schema([(kind, "validation") for kind in kinds], by_alias=True)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Hypoid design file",
        "anyOf": [{"$ref": f"#/$defs/{kind.__name__}"} for kind in kinds],
        **schema,
    }
