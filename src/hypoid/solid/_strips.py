"""The faces of a tooth as exact surfaces over a unit square: bottom, fillets, flanks and top land.

A strip reaches along the face, u from toe to heel, and across, v with rising angle (left hand): the
slot's bottom, up the concave flank piece by piece of its edge, over the top land and down the convex
one. Where an edge piece ends, where two pieces cross (undercut), and where a relief begins, the
curvature jumps; there a strip ends, so each of them is smooth. Where the flanks meet below the face
cone, the tooth ends on a narrow land, and the face width is split where that begins.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from scipy.interpolate import RectBivariateSpline
from scipy.optimize import brentq

from hypoid.flank import SIDES, Flank, Side, Tooth

from ._borders import rise
from ._pieces import ORDER, Merged, Piece, pieces
from ._vanishing import NARROW, width

Array = np.ndarray[Any, Any]
Points = Callable[[Array, Array], tuple[Array, Array]]
LAND = 0.02  # mm, the land that a pointed tooth is left with
SCAN = 65  # sections, and heights in each, that are looked at
ACROSS = 9  # points across the slot's bottom
STEPS = 8
NEAR = 1e-6  # mm, between changes that count as one


@dataclass(frozen=True)
class Strip:
    """One face: places u (n,) and v (m,) in [0, 1] to points (n, m, 3) mm and unit normals, left hand."""

    name: str  # "bottom", "concave fillet", ..., "top land"
    at: Points
    exact: bool  # a surface that an edge cuts
    smooth: bool = True  # as smooth as its surface: no border of pieces runs through it


@dataclass(frozen=True)
class Span:
    """Strips of one tooth between two cone distances, mm, by rising angle; each begins where one ends."""

    start: float
    end: float
    strips: tuple[Strip, ...]
    pointed: bool  # its top land is what a pointed tooth keeps; else it lies on the face cone


def spans(tooth: Tooth) -> tuple[Span, ...]:
    """The tooth's strips, toe to heel, in as many spans as the top land asks for."""
    turns = {"concave": 0.0, "convex": tooth.convex_turn}
    stations, pointed = _stations(tooth, turns)
    bottom = _bottom(tooth)
    parts = list(zip(stations[:-1], stations[1:], pointed, strict=True))
    made = tuple(_span(tooth, turns, bottom, *part) for part in parts)
    if len({tuple(strip.name for strip in span.strips) for span in made}) > 1:
        made = tuple(_span(tooth, turns, bottom, *part, merged=True) for part in parts)
    return made


def _land(tooth: Tooth, turns: dict[str, float], distance: Array, height: Array) -> Array:
    """Thickness of the tooth, mm along the arc, negative where the flanks have crossed below."""
    concave, convex = (tooth.flank(s).left_angle(distance, height) + turns[s] for s in SIDES)
    radius = tooth.concave.cone.axial_radial(distance, height)[1]
    return np.angle(np.exp(1j * (convex - concave))) * radius


def _stations(tooth: Tooth, turns: dict[str, float]) -> tuple[list[float], list[bool]]:
    """Cone distances at which spans end, and which spans are pointed."""
    flank = tooth.concave

    def over(distance: Array) -> Array:
        return _land(tooth, turns, distance, np.asarray(flank.tip.at(distance))) - LAND

    changes = _changes(flank, over)
    for cut in (tooth.flank(side) for side in SIDES):
        if not cut.generated:
            changes += _changes(cut, partial(rise, cut))
            for least in (0.0, NARROW):
                changes += _changes(cut, lambda d, c=cut, w=least: width(c, d) - w)
    changes = [
        d for k, d in enumerate(sorted(changes)) if not k or d > sorted(changes)[k - 1] + NEAR
    ]
    stations = [flank.toe, *changes, flank.heel]
    middles = 0.5 * (np.array(stations[:-1]) + np.array(stations[1:]))
    return stations, [bool(v < 0.0) for v in over(middles)]


def _changes(flank: Flank, value: Callable[[Array], Array]) -> list[float]:
    """Cone distances at which a value along the face passes nought; where it jumps, it does not."""
    at = np.linspace(flank.toe, flank.heel, SCAN)
    signs = value(at) > 0.0

    def nought(low: float, high: float) -> Any:
        return brentq(lambda d: float(value(np.array([d]))[0]), low, high, xtol=1e-12)

    found = [nought(at[k], at[k + 1]) for k in np.flatnonzero(signs[:-1] != signs[1:]).tolist()]
    return [float(d) for d in found if abs(float(value(np.array([d]))[0])) < NEAR]


def _span(
    tooth: Tooth,
    turns: dict[str, float],
    bottom: Callable[[Array, Array], Array],
    start: float,
    end: float,
    pointed: bool,
    merged: bool = False,
) -> Span:
    distance = 0.5 * (start + end) - 0.5 * (end - start) * np.cos(
        np.pi * (np.arange(ORDER) + 0.5) / ORDER
    )
    tip = np.asarray(tooth.concave.tip.at(distance), float)
    if pointed:
        tip = _narrowed(tooth, turns, distance, tip)

    made = {s: list(pieces(tooth.flank(s), distance, tip, (start, end), merged)) for s in SIDES}

    def placed(side: Side, piece: Piece | Merged, turned: bool) -> Points:
        cosine, sine = np.cos(turns[side]), np.sin(turns[side])
        matrix = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])

        def at(u: Array, v: Array) -> tuple[Array, Array]:
            position, normal = piece.at(start + (end - start) * u, 1.0 - v if turned else v)
            return position @ matrix, normal @ matrix

        return at

    def of(side: Side) -> list[Strip]:
        turned = side == "convex"
        strips = [
            Strip(f"{side} {p.name}", placed(side, p, turned), True, p.smooth) for p in made[side]
        ]
        return strips[::-1] if turned else strips

    concave, convex = of("concave"), of("convex")
    cone, zero, one = tooth.concave.cone, np.zeros(1), np.ones(1)

    def between(
        first: Strip, second: Strip, ends: tuple[Array, Array], back: float, name: str
    ) -> Strip:
        """From one strip's border to another's, evenly by angle; ``back`` turns the first one."""

        def at(u: Array, v: Array) -> tuple[Array, Array]:
            a, b = first.at(u, ends[0])[0][:, 0], second.at(u, ends[1])[0][:, 0]
            angles = np.arctan2(b[:, 1], b[:, 0]), np.arctan2(a[:, 1], a[:, 0]) - back
            wide = np.angle(np.exp(1j * (angles[0] - angles[1])))
            angle = angles[1][:, None] + np.outer(wide, v)
            places = [
                cone.cone_distance_height(p[:, 2], np.hypot(p[:, 0], p[:, 1])) for p in (a, b)
            ]
            low, high = (place[1][:, None] for place in places)
            along = start + (end - start) * u
            height = low + (high - low) * v + (bottom(along, v) if back else 0.0)
            z, radius = cone.axial_radial(along[:, None], height)
            point = np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1)
            up = np.array([cone.cosine, -cone.sine])
            around = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * up[0]
            normal = np.concatenate([around, np.full((*angle.shape, 1), up[1])], axis=-1)
            return point, normal

        return Strip(name, at, False)

    floor = between(convex[-1], concave[0], (one, zero), tooth.pitch, "bottom")
    top = between(concave[-1], convex[0], (one, zero), 0.0, "top land")
    return Span(start, end, (floor, *concave, top, *convex), pointed)


def _narrowed(tooth: Tooth, turns: dict[str, float], distance: Array, tip: Array) -> Array:
    """Heights where the tooth is as thick as the land that it keeps."""
    share = np.linspace(0.0, 1.0, SCAN)
    scan = np.outer(1.0 - share, 0.0 * tip) + np.outer(share, tip)
    wide = _land(tooth, turns, np.tile(distance, SCAN), scan.ravel()).reshape(scan.shape)
    last = np.argmax(wide < LAND, axis=0).clip(1)
    height = scan[last, np.arange(len(tip))]
    step = 1e-4
    for _ in range(STEPS):
        over = _land(tooth, turns, distance, height) - LAND
        slope = (over - (_land(tooth, turns, distance, height - step) - LAND)) / step
        height = np.minimum(height - over / slope, tip)
    return height


def _bottom(tooth: Tooth) -> Callable[[Array, Array], Array]:
    """How far the slot's bottom lies off the straight line between its ends, mm, at (S, share across)."""
    grid = tooth.grid(SCAN, 3, ACROSS)
    share = np.linspace(0.0, 1.0, ACROSS)
    ends = grid.bottom_height[:, :1], grid.bottom_height[:, -1:]
    off = grid.bottom_height - (ends[0] + (ends[1] - ends[0]) * share)
    return RectBivariateSpline(grid.distance, share, off)
