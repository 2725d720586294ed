"""Where one piece of an edge ends on a flank and the next begins: lines along the face.

Pieces join at their own ends. Where the flank is undercut the lowest one crosses the next: both by Newton.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np

from hypoid.flank import Flank, edge_line, lowest

Array = np.ndarray[Any, Any]
Line = tuple[Array, Array]  # edge parameters and turns along the face
SCAN = 65  # heights in each section that are looked at
STEPS = 8
TANGENT = 1e-6  # mm, between the ends of two pieces that join without a kink
CLOSE = 1e-8  # mm and rad, what Newton may leave
BY_JOINT = 1e-3  # mm of edge, within which differences no longer tell a crossing from the joint
ARRIVED = 1e-12  # mm and rad, which the next step takes to what rounding leaves
SLACK = 1e-6  # mm, of an edge parameter beyond its piece's end


def rise(flank: Flank, distance: Array) -> Array:
    """How the height changes along the edge where the lowest piece joins the next: falling is undercut."""
    if len(flank.cut_pieces) < 2:
        return np.ones(len(distance))
    piece, start = flank.pieces[flank.cut_pieces[-2]], flank.theta_start
    low, high = (
        edge_line(flank.surface, piece, flank.cone, distance, float(piece.low) + step, start)[1]
        for step in (-1e-5, 1e-5)
    )
    return (high - low) / 2e-5


def edge_end(flank: Flank, name: str, end: Literal["low", "high"], distance: Array) -> Line:
    """Where a piece's own end passes cone distances."""
    piece = flank.pieces[name]
    line = np.full(len(distance), float(getattr(piece, end)))
    return line, edge_line(flank.surface, piece, flank.cone, distance, line, flank.theta_start)[0]


def height_of(flank: Flank, name: str, line: Line, distance: Array) -> Array:
    """Heights, mm, of a line on a piece."""
    return edge_line(flank.surface, flank.pieces[name], flank.cone, distance, *line)[1]


def borders(
    flank: Flank,
    distance: Array,
    tip: Array,
    span: tuple[float, float],
    ends: tuple[Line, Line],
    band: tuple[Line, Line] | None,
) -> list[tuple[str, tuple[Line, Line]]]:
    """Each piece between two lines, root to tip; none where they change along the face.

    A band over the lowest piece (see ``vanishing_band``) goes by the name of the second.
    """
    first, last = ends
    found: list[tuple[str, tuple[Line, Line]]] = []
    names = flank.cut_pieces[::-1]
    lowest_name = names[0]
    if band:
        found = [(names[0], (first, band[0])), (names[1], band)]
        first, names = band[1], names[2:]
    for name, after in zip(names, [*names[1:], None], strict=True):
        if after is None:
            return [*found, (name, (first, last))]
        high, low = edge_end(flank, name, "high", distance), edge_end(flank, after, "low", distance)
        height, start = (
            height_of(flank, name, high, distance),
            height_of(flank, after, low, distance),
        )
        if (height >= tip).all():
            return [*found, (name, (first, last))]
        if (height >= tip).any():
            return []
        middle, met = np.array([0.5 * (span[0] + span[1])]), (high, low)
        if not flank.generated and name == lowest_name and rise(flank, middle)[0] < 0.0:
            met = _crossing(flank, (name, after), distance, tip, span, (high, low))
        elif (
            np.abs(height - start).max() > TANGENT
        ):  # a kink of the edge: each goes on below the other
            met = meet(flank, (name, after), distance, met)
        if met is None:
            return []
        high, low = met
        found.append((name, (first, high)))
        first = low
    return found


def _crossing(
    flank: Flank,
    names: tuple[str, str],
    distance: Array,
    tip: Array,
    span: tuple[float, float],
    joint: tuple[Line, Line],
) -> tuple[Line, Line] | None:
    """Where the lowest piece crosses the next (undercut), from where points by height change pieces.

    Where undercut begins, both pieces leave their joint: the upper one in proportion, the lower one with the square.
    """
    low, high, every = lowest(flank, distance)[0], tip, np.arange(len(distance))
    line: list[Line] = []
    for share in (np.linspace(0.0, 1.0, SCAN + 1)[1:], np.linspace(0.0, 1.0, SCAN)):
        height = low + np.outer(share, high - low)
        seen = flank.at_cone(np.tile(distance, SCAN), height.ravel())
        piece, s, turn = (a.reshape(SCAN, -1) for a in (seen.piece, seen.s, seen.theta))
        row = np.argmax(piece != piece[0], axis=0)
        if (row == 0).any():
            return None
        line = [(s[r, every], turn[r, every]) for r in (row - 1, row)]
        low, high = height[row - 1, every], height[row, every]
    ends = [end for end in span if abs(float(rise(flank, np.array([end]))[0])) < 1e-6]
    if ends:
        middle = [len(distance) // 2]
        met = meet(flank, names, distance[middle], [(a[middle], b[middle]) for a, b in line], 1e-3)
        if met is None:
            return None
        away = np.min([np.abs(distance - end) for end in ends], axis=0)
        ratio = away / away[middle]
        line = [
            (j + (at[0] - j) * ratio**power, at[1] + 0.0 * ratio)
            for at, (j, _), power in zip(met, joint, (2, 1), strict=True)
        ]
        return meet_by_joint(flank, names, distance, line, joint)
    return meet(flank, names, distance, line)


def meet(
    flank: Flank,
    names: tuple[str, str],
    distance: Array,
    start: Sequence[Line],
    close: float = CLOSE,
) -> tuple[Line, Line] | None:
    """Where two pieces cross at cone distances; None where they do not, between their own ends."""
    *lines, left = extended_meet(flank, names, distance, start)
    for (s, _), own in zip(lines, (flank.pieces[name] for name in names), strict=True):
        if not ((s > float(own.low) - SLACK) & (s < float(own.high) + SLACK)).all():
            return None
    return (lines[0], lines[1]) if (left < close).all() else None


def meet_by_joint(
    flank: Flank,
    names: tuple[str, str],
    distance: Array,
    start: Sequence[Line],
    joint: tuple[Line, Line],
) -> tuple[Line, Line] | None:
    """The same where undercut begins, from starts that close in on the joint as crossings do: at it, they stand."""
    *lines, left = extended_meet(flank, names, distance, start)
    near = start[1][0] - joint[1][0] < BY_JOINT
    if not (near | (left < CLOSE)).all():
        return None
    low, high = (
        (np.where(near, own[0], s), np.where(near, own[1], turn))
        for own, (s, turn) in zip(start, lines, strict=True)
    )
    return low, high


def extended_meet(
    flank: Flank, names: tuple[str, str], distance: Array, start: Sequence[Line]
) -> tuple[Line, Line, Array]:
    """Newton for where two pieces, or what extends them, cross at cone distances, and what is left."""
    count, step = len(distance), 1e-5
    either = np.array([[0.0], [step], [-step]])

    def section(which: int, s: Array) -> tuple[Array, Array]:
        """Height and angle (2, n) on a piece, and their slopes."""
        s, own = (s + either).ravel(), flank.pieces[names[which]]
        turn = np.tile(turns[which], 3)
        turn, up = edge_line(flank.surface, own, flank.cone, np.tile(distance, 3), s, turn)
        turns[which] = turn[:count]
        x, y, _ = (flank.at_cutter(s, turn, names[which])[0] * flank.hand).T
        here, more, less = np.stack([up, np.arctan2(y, x)], axis=1).reshape(3, count, 2)
        return here.T, (more - less).T / (2.0 * step)

    line, turns = [a for a, _ in start], [b for _, b in start]
    missed = np.full(count, np.inf)
    for _ in range(STEPS):
        (here, a), (there, b) = (section(k, line[k]) for k in (0, 1))
        off = here - there
        off[1] = np.angle(np.exp(1j * off[1]))
        missed = np.where(np.isfinite(off).all(axis=0), np.abs(off).max(axis=0), np.inf)
        determinant = b[0] * a[1] - a[0] * b[1]
        line[0] = line[0] + (b[1] * off[0] - b[0] * off[1]) / determinant
        line[1] = line[1] + (a[1] * off[0] - a[0] * off[1]) / determinant
        if (missed < ARRIVED).all():
            break
    return (line[0], turns[0]), (line[1], turns[1]), missed
