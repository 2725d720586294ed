"""`hypoid check`."""

from __future__ import annotations

from dataclasses import asdict

from ._options import AsJson, DesignPath
from ._output import report_faults, say, write_json


def check(file: DesignPath, /, *, json: AsJson = False) -> int:
    """Whether the design file is sound, what it assumes, and whether its blank has a fault."""
    from hypoid.design import spec_blank
    from hypoid.io import read_spec

    spec = read_spec(file)
    faults = [fault.value for fault in spec_blank(spec).faults]
    if json:
        assumed = [asdict(assumption) for assumption in spec.assumed]
        write_json({"title": spec.title, "assumed": assumed, "faults": faults})
    else:
        for assumption in spec.assumed:
            print(f"assumed: {assumption.value}: {assumption.reason}")
    if not faults:
        say(f"{file}: no fault found.")
    return report_faults(faults)
