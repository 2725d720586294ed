"""What was measured: points or deviations of one or more teeth, as they come out of a file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.flank import Side

from ._grid import MeasuringGrid

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class MeasuredSide:
    """One flank of t teeth over a grid of n points, row after row; NaN where nothing was measured.

    Either ``position`` (t, n, 3), mm, member's frame, or ``deviation`` (t, n), mm, positive where material stands out.
    """

    teeth: tuple[int, ...]
    position: Array | None = None
    deviation: Array | None = None
    normal: Array | None = None  # (t, n, 3) as the file gives them, out of the tooth

    @property
    def count(self) -> int:
        """How many points were measured."""
        value = self.deviation if self.position is None else self.position[..., 0]
        return 0 if value is None else int(np.isfinite(value).sum())


@dataclass(frozen=True, eq=False)
class Measured:
    """A member's measurement; ``thickness`` is its deviation, mm, where the file says it."""

    member: str
    sides: Mapping[Side, MeasuredSide]
    thickness: float | None = None


def measured_points(
    grid: MeasuringGrid, deviation: Mapping[Side, Array], teeth: tuple[int, ...] = (1,)
) -> Measured:
    """A measurement whose points stand off the nominal ones by deviations (t, n) or (n,), mm, along the normals.

    Teeth are numbered from 1, each a pitch further (rising angles of a left-hand member).
    """
    from ._grid import turned

    sides: dict[Side, MeasuredSide] = {}
    for side, value in deviation.items():
        nodes = grid.flanks[side]
        value = np.broadcast_to(
            np.reshape(value, (-1, nodes.lever.size)), (len(teeth), nodes.lever.size)
        )
        position = nodes.position + value[..., None] * nodes.normal
        hand = float(nodes.flank.hand[1])
        places = [
            turned(p, hand * grid.pitch * (tooth - 1))
            for p, tooth in zip(position, teeth, strict=True)
        ]
        sides[side] = MeasuredSide(teeth, position=np.array(places))
    return Measured(grid.member.name, sides)
