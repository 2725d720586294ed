"""The flanks of a tooth as grids of points and normals, from their lowest points to the tip."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hypoid.flank import Side
from hypoid.pair import Member

from ._grid import FlankGrid, grid_csv
from ._write import write_text

SIDES: tuple[Side, Side] = ("concave", "convex")


def tooth_points(member: Member, columns: int = 61, rows: int = 61) -> dict[Side, FlankGrid]:
    """Both flanks of one tooth as they are cut, fillets with them; the member's own hand."""
    tooth = member.tooth
    grid = tooth.grid(columns, rows)
    hand = -1.0 if member.concave.mirrored else 1.0
    made: dict[Side, FlankGrid] = {}
    for side in SIDES:
        profile = grid.side(side)
        z, radius = tooth.concave.cone.axial_radial(grid.distance[:, None], profile.height)
        c, s = np.cos(profile.angle), np.sin(profile.angle)
        radial, around, axial = np.moveaxis(profile.normal, -1, 0)
        position = np.stack([radius * c, hand * radius * s, z], axis=-1)
        normal = np.stack([c * radial - s * around, hand * (s * radial + c * around), axial], -1)
        there = np.isfinite(position).all(axis=-1)
        distance = np.broadcast_to(grid.distance[:, None], there.shape)
        made[side] = FlankGrid(
            member=member.name,
            side=side,
            shape=(rows, columns),
            cone_distance=distance.T.ravel(),
            height=profile.height.T.ravel(),
            position=position.swapaxes(0, 1).reshape(-1, 3),
            normal=normal.swapaxes(0, 1).reshape(-1, 3),
            status=["ok" if ok else "not_converged" for ok in there.T.ravel()],
        )
    return made


def write_points(grids: Mapping[Side, FlankGrid], path: str | Path) -> list[Path]:
    """Write a CSV for each flank: OUT.csv becomes OUT-concave.csv and OUT-convex.csv."""
    target = Path(path)
    return [
        write_text(target.with_name(f"{target.stem}-{side}{target.suffix}"), grid_csv(grid))
        for side, grid in grids.items()
    ]
