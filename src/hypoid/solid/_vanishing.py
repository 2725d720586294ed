"""A piece that its neighbours cut away along part of the face: a Toprem, as a rule.

Where it vanishes, the three cross at one point. Its strip would end there in a corner, and strips would change along
the face. So the strip goes on as a narrow band above the lowest piece, with what is left of the vanishing one and the
beginning of the one above.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from hypoid.flank import Flank

from ._borders import CLOSE, Line, edge_end, extended_meet, meet_by_joint, rise

Array = np.ndarray[Any, Any]
NARROW = (
    6e-3  # mm of the third piece's edge, from where the lowest would cross it to the band's end
)
MET = 1e-6  # mm, where the three cross


def width(flank: Flank, distance: Array) -> Array:
    """How much more of the third piece's edge the second cuts away than the lowest, mm, at cone distances.

    Nought where the second vanishes, -1 where it does not reach the third; 1 where the lowest does not, or where
    nothing can vanish.
    """
    if flank.generated or len(flank.cut_pieces) < 3:
        return np.ones(len(distance))
    (_, (first, _), off), ((s, _), (second, _), missed) = _over(flank, distance)
    own = flank.pieces[flank.cut_pieces[-2]]
    reaches = (missed < CLOSE) & (s > float(own.low)) & (s < float(own.high))
    return np.where(reaches, np.where(off < CLOSE, second - first, 1.0), -1.0)


def vanishing_band(
    flank: Flank, distance: Array, span: tuple[float, float]
) -> tuple[Line, Line] | None:
    """The band's lines where the second piece is narrow or not there: on the lowest piece, and on the third."""
    middle = np.array([0.5 * (span[0] + span[1])])
    if not (wide := width(flank, middle)[0]) < NARROW:
        return None
    (low, high, off), _ = _over(flank, distance)
    if not (off < CLOSE).all():
        return None
    if wide > 0.0:
        joint = _joint(flank, distance, np.array(span))
        if joint is None:
            return None
        low = joint
    s = high[0] + NARROW
    return low, (s, high[1])


def _over(flank: Flank, distance: Array) -> list[tuple[Line, Line, Array]]:
    """Where the lowest piece and the second, or what extends them, cross the third; with what is left."""
    lowest, second, third = flank.cut_pieces[:-4:-1]
    start = edge_end(flank, third, "low", distance)
    return [
        extended_meet(
            flank, (name, third), distance, [edge_end(flank, name, "high", distance), start]
        )
        for name in (lowest, second)
    ]


def _joint(flank: Flank, distance: Array, span: Array) -> Line | None:
    """Where the lowest piece ends below a narrow second one: at its own end, or in undercut where they cross.

    From an end of the span where the second vanishes: there it is known, and elsewhere it leaves the joint
    in proportion to the fall of the edge, on the lowest piece with the square.
    """
    lowest, second = flank.cut_pieces[:-3:-1]
    own = edge_end(flank, lowest, "high", distance), edge_end(flank, second, "low", distance)
    fall = rise(flank, distance)
    if fall[len(fall) // 2] >= 0.0:
        return own[0]
    ends = span[np.abs(width(flank, span)) < MET]
    if not len(ends):
        return None
    at, ((below, _), _, _), ((above, _), _, _) = (rise(flank, ends), *_over(flank, ends))
    back, on = (below - own[0][0][0]) / at**2, (above - own[1][0][0]) / at
    start = [
        (line[0] + np.interp(distance, ends, ratio) * fall**power, line[1])
        for line, ratio, power in zip(own, (back, on), (2, 1), strict=True)
    ]
    met = meet_by_joint(flank, (lowest, second), distance, start, own)
    return met[0] if met else None
