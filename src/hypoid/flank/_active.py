"""Where an undercut flank begins: the floor of the chart of what is left of it.

Along a cone distance the flank as it is cut is what removes most (design, section 2). Where that is another piece,
or the other root of the meshing condition, the flank itself is cut away: there is nothing left that could touch.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.polynomial import chebyshev

from hypoid.cutter import EdgePiece

from ._chart import COLUMNS, Floor, edge_line
from ._section import cut_points

if TYPE_CHECKING:
    from ._flank import Flank, FlankPoints

Array = np.ndarray[Any, Any]
LOOKS, AT_ONCE = 4, 24  # narrowings of where points change, and into how many parts
ALONG = 2 * COLUMNS + 1  # sections through the line where the flank begins
NEAR = 1e-3  # tooth depths about its own end, where a flank may begin above nothing at all
ABOVE = 1e-3  # mm that the chart keeps from that line


def first_of(
    flank: Flank,
    distance: Array,
    low: Array,
    high: Array,
    wanted: Callable[[FlankPoints], Array],
) -> tuple[Array, Array]:
    """Heights (n,) just below and at the first point above which all are wanted, at cone distances (n,), all mm.

    The point at `low` counts as unwanted, that at `high` as wanted, whatever they are.
    """
    every = np.arange(len(distance))
    for _ in range(LOOKS):
        height = low[:, None] + np.outer(high - low, np.linspace(0.0, 1.0, AT_ONCE + 1))
        points = flank.at_cone(np.broadcast_to(distance[:, None], height.shape), height)
        found = wanted(points).reshape(height.shape)
        found[:, 0], found[:, -1] = False, True
        # the first above which all are wanted
        first = AT_ONCE + 1 - np.argmin(found[:, ::-1], axis=1)
        low, high = height[every, first - 1], height[every, first]
    return low, high


def undercut_floor(flank: Flank, piece: EdgePiece) -> Floor | None:
    """Where the chart of a flank's straight piece begins, so that nothing else cuts deeper above.

    None where nothing is left of it, or where coordinates run out before it ends.
    """
    index = flank.cut_pieces.index("flank")
    x = np.cos(np.linspace(np.pi, 0.0, ALONG))
    distance = 0.5 * (flank.toe + flank.heel) + 0.5 * (flank.heel - flank.toe) * x
    low, tip = flank.root.at(distance), flank.tip.at(distance)

    def own(points: FlankPoints) -> Array:
        return (points.status == 0) & (points.piece <= index) & ~points.other

    below, begins = first_of(flank, distance, low, tip, own)
    end = edge_line(flank.surface, piece, flank.cone, distance, float(piece.low), flank.theta_start)
    ended = np.abs(begins - end[1]) < NEAR * (tip - low)
    if (begins >= tip).any() or not (ended | (flank.at_cone(distance, below).status == 0)).all():
        return None
    # a smooth line that nowhere passes below: it leaves out a little beside where undercut begins
    line = chebyshev.chebfit(x, begins, COLUMNS - 1)
    line[0] += max(float((begins - chebyshev.chebval(x, line)).max()), 0.0) + ABOVE

    def start(places: Array, height: Array) -> tuple[Array, Array]:
        values, _, _ = cut_points(flank, *flank.cone.axial_radial(places, height))
        return values[6], values[7]

    return Floor(lambda x: chebyshev.chebval(x, line), start)
