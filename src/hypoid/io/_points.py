"""The flanks of a tooth as grids of points and normals, from their lowest points to the tip."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hypoid.flank import SIDES, Side
from hypoid.pair import Member

from ._grid import FlankGrid, grid_csv
from ._write import write_text


def tooth_points(member: Member, columns: int = 61, rows: int = 61) -> dict[Side, FlankGrid]:
    """Both flanks of one tooth as they are cut, fillets with them; the member's own hand."""
    grid = member.tooth.grid(columns, rows)
    made: dict[Side, FlankGrid] = {}
    for side in SIDES:
        position, normal = member.tooth.placed(grid, side)
        there = np.isfinite(position).all(axis=-1)
        distance = np.broadcast_to(grid.distance[:, None], there.shape)
        made[side] = FlankGrid(
            member=member.name,
            side=side,
            shape=(rows, columns),
            cone_distance=distance.T.ravel(),
            height=grid.side(side).height.T.ravel(),
            position=position.swapaxes(0, 1).reshape(-1, 3),
            normal=normal.swapaxes(0, 1).reshape(-1, 3),
            status=["ok" if ok else "not_converged" for ok in there.T.ravel()],
        )
    return made


def point_files(path: str | Path) -> dict[Side, Path]:
    """A file for each flank: OUT.csv becomes OUT-concave.csv and OUT-convex.csv."""
    target = Path(path)
    return {side: target.with_name(f"{target.stem}-{side}{target.suffix}") for side in SIDES}


def write_points(grids: Mapping[Side, FlankGrid], path: str | Path) -> list[Path]:
    """Write a CSV for each flank (`point_files`)."""
    files = point_files(path)
    return [write_text(files[side], grid_csv(grid)) for side, grid in grids.items()]
