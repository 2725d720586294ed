"""`hypoid examples`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ._options import AsJson
from ._output import DONE, say, write_json


def examples(
    *,
    copy_to: Annotated[Path | None, Parameter(help="Copy them to this folder.")] = None,
    schema: Annotated[
        bool, Parameter(negative=(), help="Write the JSON Schema of design files instead.")
    ] = False,
    json: AsJson = False,
) -> int:
    """The design files that ship with the program, one or more for a paper."""
    from hypoid.io import example_files, json_schema, read_spec, write_text

    if schema:
        write_json(json_schema())
        return DONE
    files = example_files()
    if copy_to is not None:
        files = [write_text(copy_to / f.name, f.read_text(encoding="utf-8")) for f in files]
        say(f"{len(files)} design files are in {copy_to}.")
    listed = [{"file": str(f), "title": read_spec(f).title} for f in files]
    if json:
        write_json({"examples": listed})
    else:
        for entry in listed:
            print(f"{entry['file']}  {entry['title']}")
    return DONE
