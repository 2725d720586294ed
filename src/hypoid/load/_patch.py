"""Candidate cells of one tooth pair: a grid in the common tangent plane, and the gap of the exact surfaces there.

All in the contact's frame G (left-hand wheel frame, see `hypoid.contact`), mm. The gap is the wheel's lag behind its
rigid place times its lever, as everywhere in the unloaded contact.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.flank import Flank

from ._meeting import Meeting
from ._surface import Surface
from ._tips import Arc, land_angle

Array = np.ndarray[Any, Any]
ENDS = ("tip", "toe", "heel", "fillet limit")
EDGES = tuple(f"{member} {end}" for member in ("pinion", "wheel") for end in ENDS)
LIMITS = (
    EDGES.index("wheel fillet limit"),
    EDGES.index("pinion fillet limit"),
)  # by the mate's tip
COLUMNS, ROWS = 25, 11  # cells along the contact and across: `CELLS` of them
CORNERS = 8  # of a rectangle that two tips and two ends have cut
NEAR = 0.1  # mm: cells so near to a rounded tip count full where its line is fitted


def _edge_lines(surface: Surface, flanks: Any, plane: Array) -> tuple[Array, Array]:
    """Both members' sharp edges as straight lines of the tangent plane (see `Patch.lines`), from cells (n, 2) in it."""
    terms = np.column_stack([np.ones(len(plane)), plane])
    first, second = (
        np.linalg.lstsq(
            terms,
            np.stack([flank.tip.at(s) - h, s - flank.toe, flank.heel - s], axis=1),
            rcond=None,
        )[0].T
        for flank, (s, h) in zip(flanks, (surface.pinion_place, surface.wheel_place), strict=True)
    )
    return first, second


def _arc(met: Meeting, cells: Surface, plane: Array, member: int) -> Arc | None:
    """The rounded tip of a member (0 pinion, 1 wheel) as cells (n, 2) in the plane see it, None where it is sharp.

    Its line is fitted to their distances from the tip, the near ones most: over a window it bends by up to 0.3 mm.
    """
    pair = met.contact.pair
    radius = (pair.pinion, pair.wheel)[member].tip_rounding
    if not (radius > 0.0 and len(plane)):
        return None
    flank = met.flanks[member]
    s, h = (cells.pinion_place, cells.wheel_place)[member]
    apart = flank.tip.at(s) - h
    weight = (np.abs(apart) + NEAR) ** -2.0
    terms = np.column_stack([np.ones(len(plane)), plane]) * weight[:, None]
    line = np.linalg.lstsq(terms, apart * weight, rcond=None)[0]
    line /= np.hypot(*line[1:])
    there = np.array([np.abs(line[0] + plane @ line[1:]).argmin()])
    point, normal = met.bodily(cells.cut(there), member)
    return Arc(line, float(land_angle(flank, normal, point)[0]), radius)


@dataclass(frozen=True)
class Window:
    """Rectangle of the tangent plane that cells cover: (low, high) along and across, mm."""

    along: tuple[float, float]
    across: tuple[float, float]

    @property
    def ends(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Both of them."""
        return self.along, self.across

    def scaled(self, by: float) -> Window:
        """The same about where the pair touches first, `by` times as long and wide."""
        return Window(*((by * low, by * high) for low, high in self.ends))


@dataclass(frozen=True, eq=False)
class Patch:
    """Cells of one pair: those of a grid that are `on`, in its order, then any that stand in for others of it.

    Cells off either flank are left out.
    """

    meeting: Meeting
    window: Window
    size: tuple[float, float]  # of the grid's cells, mm
    on: Array  # (COLUMNS, ROWS) bool
    cut: Array  # (m, CORNERS, 2) mm, corners of the cells that are not the grid's
    point: Array  # (n, 3)
    normal: Array  # (n, 3)
    flat: Array  # (n,) mm2 in the plane
    area: Array  # (n,) mm2
    gap: Array  # (n,) mm
    pinion_lever: Array  # (n,) mm
    wheel_lever: Array
    pinion_place: tuple[Array, Array]  # (S, H), (n,) each
    wheel_place: tuple[Array, Array]
    plane: Array  # (n, 2) mm, along and across
    lines: tuple[Array, Array]  # pinion's and wheel's tip, toe and heel, straight in the plane:
    # (3, 3) rows c0, c1, c2 with c0 + c1 along + c2 across = 0, positive on the flank
    arcs: tuple[Arc | None, Arc | None]  # pinion's and wheel's, where rounded
    edges: Array  # (n, EDGES) mm to each of them; rounded tips are none

    @property
    def count(self) -> int:
        return len(self.gap)

    @property
    def whole(self) -> int:
        """How many cells are the grid's."""
        return self.count - len(self.cut)

    @property
    def corners(self) -> Array:
        """Corners (n, CORNERS, 2) of all cells, mm; the last is repeated where there are fewer."""
        half = 0.5 * np.array(self.size) * [(-1, -1), (1, -1), (1, 1), *[(-1, 1)] * (CORNERS - 3)]
        return np.concatenate([self.plane[: self.whole, None] + half, self.cut])


def greatest(p: Patch, pressure: Array, among: Array) -> float:
    """Greatest pressure, MPa, of the cells `among` (n,), between cells, too.

    Where cells of the grid touch on both sides of the greatest, a parabola goes through the pressures' squares: Hertz's
    ellipsoid is one, whatever the grid's place on it.
    """
    if not among.any() or not pressure[among].max() > 0.0:
        return 0.0
    most = int(np.flatnonzero(among)[pressure[among].argmax()])
    if most >= p.whole:
        return float(pressure[most])
    squares = np.zeros(p.on.shape)
    squares[p.on] = pressure[: p.whole] ** 2
    at = np.argwhere(p.on)[most]
    top = squares[tuple(at)]
    gain = 0.0
    for axis, step in enumerate(np.eye(2, dtype=int)):
        if 0 < at[axis] < p.on.shape[axis] - 1:
            before, after = squares[tuple(at - step)], squares[tuple(at + step)]
            if min(before, after) > 0.0 and max(before, after) < top:
                gain += 0.125 * (after - before) ** 2 / (2.0 * top - before - after)
    return float(np.sqrt(top + gain))


def patch(met: Meeting, window: Window) -> Patch:
    """The cells of a window."""
    size = (np.ptp(window.along) / COLUMNS, np.ptp(window.across) / ROWS)
    a = window.along[0] + (np.arange(COLUMNS) + 0.5) * size[0]
    b = window.across[0] + (np.arange(ROWS) + 0.5) * size[1]
    plane = np.stack(np.meshgrid(a, b, indexing="ij"), axis=-1).reshape(-1, 2)
    surface, gap, on = _faces(met, plane)
    seen = surface.cut(on)
    lines = _edge_lines(seen, met.flanks, plane[on])
    arcs = _arc(met, seen, plane[on], 0), _arc(met, seen, plane[on], 1)
    for line, arc in zip(lines, arcs, strict=True):
        if arc is not None:
            line[0] = arc.line
    gap += _falls_away(arcs, plane)
    on &= np.isfinite(gap)
    return Patch(
        meeting=met,
        window=window,
        size=(float(size[0]), float(size[1])),
        on=on.reshape(COLUMNS, ROWS),
        cut=np.zeros((0, CORNERS, 2)),
        lines=lines,
        arcs=arcs,
        **_cells(
            met.flanks,
            surface.cut(on),
            plane[on],
            np.full(on.sum(), size[0] * size[1]),
            gap[on],
            arcs,
        ),
    )


def recut(p: Patch, kept: Array, corners: Array) -> Patch:
    """A patch with the `kept` (n,) of its grid's cells, and polygons, corners (m, CORNERS, 2), for the others."""
    plane, flat = middles(corners)
    surface, gap, on = _faces(p.meeting, plane)
    gap += _falls_away(p.arcs, plane)
    on &= np.isfinite(gap)
    new = _cells(p.meeting.flanks, surface.cut(on), plane[on], flat[on], gap[on], p.arcs)
    grid = p.on.copy()
    grid[p.on] = kept

    def joined(old: Any, added: Any) -> Any:
        if isinstance(old, tuple):
            return tuple(joined(o, a) for o, a in zip(old, added, strict=True))
        return np.concatenate([old[kept], added])

    both = {name: joined(getattr(p, name), value) for name, value in new.items()}
    return replace(p, on=grid, cut=corners[on], **both)


def nearest_edge(p: Patch, force: Array) -> tuple[Array, Array]:
    """Distance (n,), mm, to the nearest edge under these forces (n,), and which (n,) of EDGES it is.

    The fillet limit that a rounded tip works near is none before the contact reaches it: the flank goes on smoothly.
    """
    edges = p.edges.copy()
    terms = np.column_stack([np.ones(p.count), p.plane])
    for arc, limit in zip(p.arcs, LIMITS, strict=True):
        if arc is not None:
            slope = np.linalg.lstsq(terms, edges[:, limit], rcond=None)[0][1:]
            spread = np.ptp(p.corners @ slope, axis=1)
            if not ((force > 0.0) & (edges[:, limit] < spread)).any():
                edges[:, limit] = np.inf
    return edges.min(axis=1), edges.argmin(axis=1)


def on_arcs(p: Patch) -> Array:
    """Cells (n,) that lie on a rounded tip."""
    there = np.zeros(p.count, dtype=bool)
    for arc in p.arcs:
        if arc is not None:
            there |= arc.apart(p.plane) < arc.start
    return there


def _faces(met: Meeting, plane: Array) -> tuple[Surface, Array, Array]:
    """The pinion on rays at places (n, 2), the gap (n,) of sharp flanks, and where flanks face each other (n,)."""
    surface = met.surface(*plane.T)
    gap = surface.gap.copy()
    return surface, gap, np.isfinite(gap) & (surface.upright > 0.5)


def _falls_away(arcs: Sequence[Arc | None], plane: Array) -> Array:
    return sum((arc.falls_away(plane) for arc in arcs if arc is not None), np.zeros(len(plane)))


def middles(corners: Array) -> tuple[Array, Array]:
    """Centroids (m, 2) and areas (m,) of polygons (m, k, 2)."""
    after = np.roll(corners, -1, axis=1)
    twice = corners[..., 0] * after[..., 1] - after[..., 0] * corners[..., 1]
    area = 0.5 * twice.sum(axis=1)
    middle = ((corners + after) * twice[..., None]).sum(axis=1) / (6.0 * area[:, None])
    return middle, np.abs(area)


def _cells(
    flanks: Sequence[Flank],
    kept: Surface,
    plane: Array,
    flat: Array,
    gap: Array,
    arcs: Sequence[Arc | None],
) -> dict[str, Any]:
    """What a patch says of each of its cells, by name."""
    levers, places = kept.levers, (kept.pinion_place, kept.wheel_place)
    edges: list[Array] = []
    for flank, low, arc, (s, h) in zip(flanks, kept.limits, arcs, places, strict=True):
        tip = flank.tip.at(s) - h if arc is None else np.full(len(s), np.inf)
        edges += [tip, s - flank.toe, flank.heel - s, h - low]
    return {
        "point": kept.point,
        "normal": kept.normal,
        "flat": flat,
        "area": flat / kept.upright,
        "gap": gap,
        "pinion_lever": levers[0],
        "wheel_lever": levers[1],
        "pinion_place": places[0],
        "wheel_place": places[1],
        "plane": plane,
        "edges": np.stack(edges, axis=1),
    }
