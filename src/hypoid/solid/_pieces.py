"""What each piece of an edge leaves of a flank, from root to tip."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Chebyshev

from hypoid.flank import Flank, edge_line, lowest
from hypoid.geometry import horner_line, on_unit

from ._borders import borders, height_of
from ._vanishing import vanishing_band

Array = np.ndarray[Any, Any]
ORDER = 24  # of the polynomials that place a border along the face


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
    """A flank between two heights (mm): where the pieces that make it change along the face.

    The whole of it from its lowest line to the tip, or a band above that, within which a kink costs little.
    """

    flank: Flank
    low: Callable[[Array], Array]
    high: Callable[[Array], Array]
    name: str = "flank and fillet"
    smooth: bool = False
    rooted: bool = True  # begins at the lowest line, from which heights grow with the square

    def at(self, distance: Array, share: Array) -> tuple[Array, Array]:
        low, high = (border(distance)[:, None] for border in (self.low, self.high))
        height = low + (high - low) * (share**2 if self.rooted else share)
        flank, root = self.flank, (share <= 0.0) & self.rooted
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
    band = vanishing_band(flank, distance, span)
    made: list[Piece | Merged] = []
    for name, ends in borders(
        flank, distance, tip, span, ((first, turn), (top.s, top.theta)), band
    ):
        if band and ends is band:
            owners = flank.cut_pieces[-1], flank.cut_pieces[-3]
            below, above = (
                fitted(height_of(flank, *of, distance)) for of in zip(owners, band, strict=True)
            )
            made.append(Merged(flank, below, above, name, rooted=False))
            continue
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


def _is_cut(piece: Piece | Merged, span: tuple[float, float]) -> bool:
    """Whether nothing removes more than a piece where it is taken to be the tooth."""
    distance = span[0] + (span[1] - span[0]) * np.linspace(0.02, 0.98, 5)
    flank = piece.flank
    point = piece.at(distance, np.linspace(0.05, 0.95, 5))[0].reshape(-1, 3)
    seen = flank.at(point[:, 2], np.hypot(point[:, 0], point[:, 1])).position
    return bool(np.abs(seen * flank.hand - point).max() < 1e-6)
