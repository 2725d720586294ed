"""A flank's grid of points as CSV or JSON, with names, units and frame in the file itself."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from dataclasses import dataclass
from io import StringIO
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

_COLUMNS = (
    "row", "column", "cone_distance_mm", "height_mm",
    "x_mm", "y_mm", "z_mm", "normal_x", "normal_y", "normal_z", "status",
)  # fmt: skip
_FRAME = "member frame: z along the axis from apex to heel, origin at the crossing point"


@dataclass(frozen=True)
class FlankGrid:
    """A flank sampled at `shape` rows (root to tip) by columns (toe to heel), row after row."""

    member: str
    side: str
    shape: tuple[int, int]  # rows, columns; n = rows * columns
    cone_distance: ArrayLike  # (n,) mm, S
    height: ArrayLike  # (n,) mm, H, positive to the tip
    position: ArrayLike  # (n, 3) mm, member frame
    normal: ArrayLike  # (n, 3), unit, out of the tooth
    status: Sequence[str]  # (n,) "ok", or why a point is none


def grid_csv(grid: FlankGrid) -> str:
    """CSV: a comment line on what it is, a line of column names with units, a line a point."""
    text = StringIO()
    text.write(f"# {grid.member} {grid.side} flank; {_FRAME}; normals point out of the tooth\n")
    table = csv.writer(text, lineterminator="\n")
    table.writerow(_COLUMNS)
    for index, (numbers, status) in enumerate(zip(_numbers(grid), grid.status, strict=True)):
        shown = ["" if not np.isfinite(x) else f"{x:.12g}" for x in numbers]
        table.writerow([*divmod(index, grid.shape[1]), *shown, status])
    return text.getvalue()


def grid_dict(grid: FlankGrid) -> dict[str, Any]:
    """The grid as plain lists, for JSON; a number that is none is null."""
    numbers = [[x if np.isfinite(x) else None for x in row] for row in _numbers(grid).tolist()]
    points = [
        dict(zip(_COLUMNS, (*divmod(i, grid.shape[1]), *row, status), strict=True))
        for i, (row, status) in enumerate(zip(numbers, grid.status, strict=True))
    ]
    return {
        "member": grid.member,
        "side": grid.side,
        "rows": grid.shape[0],
        "columns": grid.shape[1],
        "frame": _FRAME,
        "points": points,
    }


def grid_json(grid: FlankGrid) -> str:
    """The grid as a JSON text."""
    return json.dumps(grid_dict(grid), indent=1, allow_nan=False) + "\n"


def _numbers(grid: FlankGrid) -> NDArray[np.float64]:
    """S, H, position and normal side by side, (n, 8)."""
    columns = (grid.cone_distance, grid.height, grid.position, grid.normal)
    n = grid.shape[0] * grid.shape[1]
    return np.hstack([np.asarray(c, dtype=np.float64).reshape(n, -1) for c in columns])
