"""What each piece of an edge leaves of a flank, from root to tip, and where one ends and the next begins.

Pieces join at their own ends. Where the flank is undercut the lowest one crosses the next: both by Newton.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Chebyshev

from hypoid.flank import Flank, edge_line, lowest
from hypoid.geometry import horner_line, on_unit

Array = np.ndarray[Any, Any]
Line = tuple[Array, Array]  # edge parameters and turns along the face
ORDER = 24  # of the polynomials that place a border along the face
SCAN = 65  # heights in each section that are looked at
STEPS = 8
TANGENT = 1e-6  # mm, between the ends of two pieces that join without a kink
SLACK = 1e-6  # mm, of an edge parameter beyond its piece's end


@dataclass(frozen=True)
class _Border:
    """A line across cone distances on one piece of an edge: edge parameter and turn."""

    s: Callable[[Array], Array]
    turn: Callable[[Array], Array]


@dataclass(frozen=True)
class Piece:
    """What one edge piece leaves of a flank between two borders."""

    flank: Flank
    piece: str
    low: _Border
    high: _Border
    relief: str = ""
    smooth: bool = True

    @property
    def name(self) -> str:
        return self.relief or self.piece

    def at(self, distance: Array, share: Array) -> tuple[Array, Array]:
        """Points and normals (n, m, 3), left hand, at cone distances (n,) and shares (m,) of the edge."""
        ends = [(b.s(distance)[:, None], b.turn(distance)[:, None]) for b in (self.low, self.high)]
        s, turn = ((a + (b - a) * share).ravel() for a, b in zip(*ends, strict=True))
        flank = self.flank
        reached = np.repeat(distance, len(share))
        turn, _ = edge_line(flank.surface, flank.pieces[self.piece], flank.cone, reached, s, turn)
        shape = (len(distance), len(share), 3)
        position, normal = (a * flank.hand for a in flank.at_cutter(s, turn, self.piece))
        return position.reshape(shape), normal.reshape(shape)


@dataclass(frozen=True)
class Merged:
    """A whole flank from root to tip by height: where the pieces that make it change along the face."""

    flank: Flank
    low: Callable[[Array], Array]
    high: Callable[[Array], Array]
    name: str = "flank and fillet"
    smooth: bool = False

    def at(self, distance: Array, share: Array) -> tuple[Array, Array]:
        low, high = (border(distance)[:, None] for border in (self.low, self.high))
        height = low + (high - low) * share**2
        flank, root = self.flank, share <= 0.0
        at = flank.at_cone(np.broadcast_to(distance[:, None], height.shape), height)
        shape = (*height.shape, 3)
        position, normal = ((a * flank.hand).reshape(shape) for a in (at.position, at.normal))
        if root.any():  # the lowest line itself, where heights have a double root
            _, _, s, turn = lowest(flank, distance)
            ends = flank.at_cutter(s, turn, flank.cut_pieces[-1])
            position[:, root], normal[:, root] = ((a * flank.hand)[:, None] for a in ends)
        return position, normal


def pieces(
    flank: Flank, distance: Array, tip: Array, span: tuple[float, float], merged: bool
) -> Iterator[Piece | Merged]:
    """Pieces of a flank from root to tip."""

    def fitted(values: Array) -> Callable[[Array], Array]:
        return Chebyshev.fit(distance, values, ORDER - 1, domain=span)

    low, _, first, turn = lowest(flank, distance)
    chart = flank.charts[flank.cut_pieces[-1]]
    if np.isfinite(chart.error):  # the same line, smooth along the face
        first = np.asarray(horner_line(chart.first, on_unit(flank.toe, flank.heel, distance)))
    top = flank.at_cone(distance, tip)
    borders = _borders(flank, distance, tip, span, (first, turn), (top.s, top.theta))
    made: list[Piece] = []
    for name, ends in borders:
        lower, upper = (_Border(fitted(s), fitted(t)) for s, t in ends)
        piece = flank.pieces[name]
        begin, least, most = float(piece.relief_from), ends[0][0].max(), ends[1][0].min()
        if float(piece.relief) and least < begin < most:
            s = np.full(len(distance), begin)
            at = edge_line(flank.surface, piece, flank.cone, distance, s, flank.theta_start)[0]
            middle = _Border(fitted(s), fitted(at))
            made += [
                Piece(flank, name, lower, middle),
                Piece(flank, name, middle, upper, "relief"),
            ]
        else:
            smooth = not float(piece.relief) or begin >= ends[1][0].max() or begin <= least
            made.append(Piece(flank, name, lower, upper, smooth=smooth))
    if made and not merged and (flank.generated or all(_is_cut(piece, span) for piece in made)):
        yield from made
    else:
        yield Merged(flank, fitted(low), fitted(tip))


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


def _is_cut(piece: Piece, span: tuple[float, float]) -> bool:
    """Whether nothing removes more than a piece where it is taken to be the tooth."""
    distance = span[0] + (span[1] - span[0]) * np.linspace(0.02, 0.98, 5)
    flank = piece.flank
    point = piece.at(distance, np.linspace(0.05, 0.95, 5))[0].reshape(-1, 3)
    seen = flank.at(point[:, 2], np.hypot(point[:, 0], point[:, 1])).position
    return bool(np.abs(seen * flank.hand - point).max() < 1e-6)


def _borders(
    flank: Flank, distance: Array, tip: Array, span: tuple[float, float], first: Line, last: Line
) -> list[tuple[str, tuple[Line, Line]]]:
    """Each piece between two lines, root to tip; none where they change along the face."""

    def end(name: str, s: float) -> tuple[Line, Array]:
        line = np.full(len(distance), s)
        at = (flank.surface, flank.pieces[name], flank.cone, distance, line, flank.theta_start)
        turn, height = edge_line(*at)
        return (line, turn), height

    found: list[tuple[str, tuple[Line, Line]]] = []
    names = flank.cut_pieces[::-1]
    for name, after in zip(names, [*names[1:], None], strict=True):
        if after is None:
            return [*found, (name, (first, last))]
        (high, height), (low, start) = (
            end(name, float(flank.pieces[name].high)),
            end(after, float(flank.pieces[after].low)),
        )
        if (height >= tip).all():
            return [*found, (name, (first, last))]
        if (height >= tip).any():
            return []
        middle, met = np.array([0.5 * (span[0] + span[1])]), (high, low)
        if not flank.generated and name == names[0] and rise(flank, middle)[0] < 0.0:
            met = _crossing(flank, (name, after), distance, tip, span, (high[0], low[0]))
        elif (
            np.abs(height - start).max() > TANGENT
        ):  # a kink of the edge: each goes on below the other
            met = _meet(flank, (name, after), distance, met)
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
    joint: Line,
) -> tuple[Line, Line] | None:
    """Where the lowest piece crosses the next (undercut), from where points by height change pieces.

    Where undercut begins, both pieces leave their joint: the upper one in proportion, the lower one with the square.
    """
    share = np.linspace(0.0, 1.0, SCAN + 1)[1:]
    low = lowest(flank, distance)[0]
    seen = flank.at_cone(np.tile(distance, SCAN), (low + np.outer(share, tip - low)).ravel())
    piece, s, turn = (a.reshape(SCAN, -1) for a in (seen.piece, seen.s, seen.theta))
    row, every = np.argmax(piece != piece[0], axis=0), np.arange(len(distance))
    if (row == 0).any():
        return None
    line = [(s[r, every], turn[r, every]) for r in (row - 1, row)]
    ends = [end for end in span if abs(float(rise(flank, np.array([end]))[0])) < 1e-6]
    if ends:
        middle = [len(distance) // 2]
        met = _meet(flank, names, distance[middle], [(a[middle], b[middle]) for a, b in line], 1e-3)
        if met is None:
            return None
        away = np.min([np.abs(distance - end) for end in ends], axis=0)
        ratio = away / away[middle]
        line = [
            (j + (at[0] - j) * ratio**power, at[1] + 0.0 * ratio)
            for at, j, power in zip(met, joint, (2, 1), strict=True)
        ]
    return _meet(flank, names, distance, line)


def _meet(
    flank: Flank,
    names: tuple[str, str],
    distance: Array,
    start: Sequence[Line],
    close: float = 1e-8,
) -> tuple[Line, Line] | None:
    """Newton for where two pieces cross at cone distances; None where they do not, between their own ends."""

    def section(which: int, s: Array) -> Array:
        own = flank.pieces[names[which]]
        turn, up = edge_line(flank.surface, own, flank.cone, distance, s, turns[which])
        turns[which] = turn
        x, y, _ = (flank.at_cutter(s, turn, names[which])[0] * flank.hand).T
        return np.stack([up, np.arctan2(y, x)])

    line, turns = [a for a, _ in start], [b for _, b in start]
    step, left = 1e-5, np.full((2, 1), np.inf)
    for _ in range(STEPS):
        here = [section(k, line[k]) for k in (0, 1)]
        a, b = (
            (section(k, line[k] + step) - section(k, line[k] - step)) / (2.0 * step) for k in (0, 1)
        )
        left = here[0] - here[1]
        left[1] = np.angle(np.exp(1j * left[1]))
        determinant = b[0] * a[1] - a[0] * b[1]
        line[0] = line[0] + (b[1] * left[0] - b[0] * left[1]) / determinant
        line[1] = line[1] + (a[1] * left[0] - a[0] * left[1]) / determinant
    for s, own in zip(line, (flank.pieces[name] for name in names), strict=True):
        if not ((s > float(own.low) - SLACK) & (s < float(own.high) + SLACK)).all():
            return None
    if not np.abs(left).max() < close:
        return None
    return (line[0], turns[0]), (line[1], turns[1])
