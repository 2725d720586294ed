"""`hypoid flank`."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter
from cyclopts.validators import Number

from ._options import AsJson, DesignPath
from ._output import report_faults, say

Count = Annotated[int, Parameter(validator=Number(gte=2, lte=2000))]


def flank(
    file: DesignPath,
    /,
    *,
    member: Literal["pinion", "wheel"] = "pinion",
    side: Literal["concave", "convex"] = "concave",
    rows: Count = 15,
    columns: Count = 31,
    format: Literal["csv", "json"] = "csv",
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    json: AsJson = False,
) -> int:
    """Points and normals of one flank on a grid over the blank, with a status for each.

    Parameters
    ----------
    member
        The member whose flank is wanted.
    side
        The side of the teeth.
    rows
        Points from root to tip.
    columns
        Points from toe to heel.
    format
        The format to write.
    output
        The file to write; standard output without it.
    """
    import hypoid
    from hypoid.flank import PointStatus
    from hypoid.io import FlankGrid, grid_csv, grid_json, write_text

    pair = hypoid.read(file)
    wanted = (pair.pinion if member == "pinion" else pair.wheel).flank(side)
    distance, height = (a.ravel() for a in wanted.grid(rows, columns))
    points = wanted.at_cone(distance, height)
    states = [PointStatus(int(code)) for code in points.status]
    grid = FlankGrid(
        member=member,
        side=side,
        shape=(rows, columns),
        cone_distance=distance,
        height=height,
        position=points.position,
        normal=points.normal,
        status=[state.name.lower() for state in states],
    )
    text = grid_json(grid) if json or format == "json" else grid_csv(grid)
    if output is None:
        print(text, end="")
    else:
        say(f"{len(states)} points of the {wanted.name} flank are in {write_text(output, text)}.")
    missing = Counter(state for state in states if state is not PointStatus.OK)
    return report_faults(
        f"{count} of {len(states)} points: {state.message}" for state, count in missing.items()
    )
