"""Candidate cells of one tooth pair: a grid in the common tangent plane, and the gap of the exact surfaces there.

All in the contact's frame G (left-hand wheel frame, see `hypoid.contact`), mm. Along every cell's ray, parallel to
the common normal, the pinion is met by a secant; the gap is the wheel's lag behind its rigid place times its lever,
as everywhere in the unloaded contact.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.contact import Mounting, UnloadedContact, lead, to_pinion, to_wheel

from ._tips import Arc, active_field, land_angle

Array = np.ndarray[Any, Any]
ENDS = ("tip", "toe", "heel", "fillet limit")
EDGES = tuple(f"{member} {end}" for member in ("pinion", "wheel") for end in ENDS)
LIMITS = (
    EDGES.index("wheel fillet limit"),
    EDGES.index("pinion fillet limit"),
)  # by the mate's tip
COLUMNS, ROWS = 25, 11  # cells along the contact and across
CORNERS = 8  # of a rectangle that two tips and two ends have cut
STENCIL, REACH = (
    9,
    0.1,
)  # points each way and whole depths, for the curvature where the pair touches first
SECANTS, ARRIVED = 8, 1e-13  # most steps, and when they end, rad
STEP = 1e-3  # mm, of differences
NEAR = 0.1  # mm: cells so near to a rounded tip count full where its line is fitted
STRAIGHT = 2e-5  # 1/mm: the least relative curvature that a first patch counts with


@dataclass(frozen=True, eq=False)
class Meeting:
    """One tooth pair at one position: where it touches first, and how surfaces are read there."""

    contact: UnloadedContact
    pair: int  # k: this pair stands k pitches behind pair 0
    phi: float  # pinion angle of this pair's own passage, rad
    lead: float  # where the wheel stands: its rigid lead, rad
    origin: Array  # (3,)
    axes: Array  # (3, 3) rows: along the contact, across, pinion's outward normal
    curvature: tuple[float, float]  # 1/mm, along and across, of the gap
    gap: float  # mm, least
    lever: float  # of the pinion there, mm

    def surface(self, a: Array, b: Array) -> Surface:
        """The pinion's points on rays at (a, b), mm, of the tangent plane."""
        mount, phi = self.contact.mount, self.phi
        pair, flanks = self.contact.pair, (self.contact.pinion_flank, self.contact.wheel_flank)
        pinion = active_field(flanks[0], pair.pinion.tip_rounding)
        wheel = active_field(flanks[1], pair.wheel.tip_rounding)
        foot = self.origin + a[:, None] * self.axes[0] + b[:, None] * self.axes[1]

        def miss(height: Array) -> Array:
            return _miss(mount, pinion, phi, foot + height[:, None] * self.axes[2])

        height = np.zeros(len(a))
        last, now = miss(height), miss(height + STEP)
        before, height = height, height + STEP
        for _ in range(SECANTS):
            if not np.abs(now).max(initial=0.0) > ARRIVED:
                break
            slope = (now - last) / np.where(height == before, np.inf, height - before)
            step = np.where(slope == 0.0, 0.0, -now / np.where(slope == 0.0, 1.0, slope))
            step = np.clip(np.nan_to_num(step), -1.0, 1.0)
            before, last = height, now
            height = height + step
            now = miss(height)
        point = foot + height[:, None] * self.axes[2]
        moves = STEP * np.concatenate([self.axes, -self.axes])
        around = _miss(mount, pinion, phi, (point + moves[:, None]).reshape(-1, 3)).reshape(6, -1)
        slopes = (around[:3] - around[3:]).T
        normal = slopes @ self.axes
        normal *= (np.sign(slopes[:, 2]) / np.linalg.norm(normal, axis=1))[:, None]
        return Surface(self, point, normal, pinion, wheel)


def _miss(mount: Mounting, pinion: Any, phi: float, point: Array) -> Array:
    """Angle (n,), rad, by which points (n, 3) in G stand beside the pinion's flank."""
    x, y, z = to_pinion(mount, np.full(len(point), phi), point).T
    angle = pinion.angle(*pinion.cone.cone_distance_height(z, np.hypot(x, y)))
    return (np.arctan2(y, x) - np.asarray(angle) + np.pi) % (2.0 * np.pi) - np.pi


@dataclass(frozen=True, eq=False)
class Surface:
    """Points of the pinion's flank as one pair sees them."""

    meeting: Meeting
    point: Array  # (n, 3)
    normal: Array  # (n, 3) out of the pinion's tooth
    pinion: Any
    wheel: Any

    def cut(self, on: Array) -> Surface:
        """Some of the points."""
        return replace(self, point=self.point[on], normal=self.normal[on])

    @property
    def pinion_place(self) -> tuple[Array, Array]:
        """(S, H) on the pinion, mm."""
        m = self.meeting
        x, y, z = to_pinion(m.contact.mount, np.full(len(self.point), m.phi), self.point).T
        return self.pinion.cone.cone_distance_height(z, np.hypot(x, y))

    @property
    def wheel_place(self) -> tuple[Array, Array]:
        """(S, H) on the wheel, mm."""
        x, y, z = self.point.T
        return self.wheel.cone.cone_distance_height(z, np.hypot(x, y))

    @property
    def bodily(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Points and outward normals, (n, 3) each, of pinion and wheel in their own left-hand frames."""
        mount, x, n = self.meeting.contact.mount, self.point, self.normal
        phi = np.full(len(x), self.meeting.phi)
        own = to_pinion(mount, phi, x)
        return (own, to_pinion(mount, phi, x + n) - own), (x, -n)

    @property
    def levers(self) -> tuple[Array, Array]:
        """Levers (n,) of pinion and wheel, mm: normal motion of a flank a radian of its travel."""
        (own, out), (x, n) = self.bodily
        sense = self.meeting.contact.mount.sense
        pinion = -sense * (own[:, 0] * out[:, 1] - own[:, 1] * out[:, 0])
        return pinion, np.abs(x[:, 0] * n[:, 1] - x[:, 1] * n[:, 0])

    def gaps(self) -> Array:
        """Gap (n,), mm, along the normal with the wheel in its rigid place; infinite off either active flank."""
        m = self.meeting
        own = to_pinion(m.contact.mount, np.full(len(self.point), m.phi), self.point)
        leads = np.asarray(lead(m.contact.mount, self.wheel, m.phi, tuple(own.T)))
        held = np.asarray(self.pinion.holds(*self.pinion_place)) & np.isfinite(leads)
        with np.errstate(invalid="ignore"):
            gap = (m.lead - leads) * self.levers[1]
        return np.where(held, gap, np.inf)


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
    flank = (met.contact.pinion_flank, met.contact.wheel_flank)[member]
    s, h = (cells.pinion_place, cells.wheel_place)[member]
    apart = flank.tip.at(s) - h
    weight = (np.abs(apart) + NEAR) ** -2.0
    terms = np.column_stack([np.ones(len(plane)), plane]) * weight[:, None]
    line = np.linalg.lstsq(terms, apart * weight, rcond=None)[0]
    line /= np.hypot(*line[1:])
    there = np.array([np.abs(line[0] + plane @ line[1:]).argmin()])
    point, normal = cells.cut(there).bodily[member]
    return Arc(line, float(land_angle(flank, normal, point)[0]), radius)


def meeting(contact: UnloadedContact, position: int, pair: int) -> Meeting | None:
    """Where pair k touches first at a position (index into `contact.phi`), None where its flanks do not face."""
    n = contact.sampling.positions_per_pitch
    own = position - pair * n
    if not 0 <= own < len(contact.phi) or not np.isfinite(contact.curve[own]):
        return None
    phi = float(contact.phi[own])
    node = int(contact.leads[own].argmax())
    at, normal = contact.nodes.point[:, node], contact.nodes.normal[:, node]
    if contact.interior[own]:
        flank = contact.pinion_flank
        found = flank.at_cutter(contact.points.s1[[own]], contact.points.theta1[[own]])
        at, normal = (v[0] * flank.hand for v in found)
    origin = np.array(to_wheel(contact.mount, phi, tuple(at)), dtype=float)
    out = np.array(to_wheel(contact.mount, phi, tuple(normal), free=True), dtype=float)
    rigid = contact.curve[position - n * np.arange(-_half(contact), _half(contact) + 1)].max()
    first = np.cross(out, (0.0, 0.0, 1.0))
    first /= np.linalg.norm(first)
    axes = np.array([first, np.cross(out, first), out])
    rough = Meeting(contact, pair, phi, float(rigid), origin, axes, (STRAIGHT, STRAIGHT), 0.0, 0.0)
    levers = rough.surface(np.zeros(1), np.zeros(1)).levers
    gap = (float(rigid) - float(contact.curve[own])) * float(levers[1][0])
    turn, curvature = _curvature(rough, contact.pinion_flank)
    c, s = np.cos(turn), np.sin(turn)
    if c * axes[0, 2] + s * axes[1, 2] < 0.0:  # always the same way, as the positions go on
        c, s = -c, -s
    axes = np.array([c * axes[0] + s * axes[1], c * axes[1] - s * axes[0], out])
    return Meeting(
        contact, pair, phi, float(rigid), origin, axes, curvature, gap, float(levers[0][0])
    )


def _half(contact: UnloadedContact) -> int:
    return contact.sampling.pairs // 2


def _curvature(rough: Meeting, flank: Any) -> tuple[float, tuple[float, float]]:
    """Direction of least curvature of the gap in the tangent plane, rad, and both curvatures, 1/mm."""
    depth = float(flank.tip.at(flank.heel) - flank.root.at(flank.heel))
    spread = np.linspace(-REACH * depth, REACH * depth, STENCIL)
    a, b = (v.ravel() for v in np.meshgrid(spread, spread))
    for wider in (1.0, 3.0):
        x, y = wider * a, wider * b
        gap = rough.surface(x, y).gaps()
        there = np.isfinite(gap)
        if there.sum() >= 2 * STENCIL:
            terms = np.stack([np.ones_like(x), x, y, 0.5 * x * x, x * y, 0.5 * y * y], axis=1)
            fit, *_ = np.linalg.lstsq(terms[there], gap[there], rcond=None)
            values, vectors = np.linalg.eigh([[fit[3], fit[4]], [fit[4], fit[5]]])
            low, high = (max(float(v), STRAIGHT) for v in values)
            return float(np.arctan2(vectors[1, 0], vectors[0, 0])), (low, max(high, low))
    return 0.0, (STRAIGHT, 1e-2)


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
        """The same about its own middle, `by` times as long and wide."""

        def one(ends: tuple[float, float]) -> tuple[float, float]:
            middle, half = 0.5 * (ends[0] + ends[1]), 0.5 * by * (ends[1] - ends[0])
            return middle - half, middle + half

        return Window(one(self.along), one(self.across))


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
    lines = _edge_lines(seen, (met.contact.pinion_flank, met.contact.wheel_flank), plane[on])
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
        **_cells(surface.cut(on), plane[on], np.full(on.sum(), size[0] * size[1]), gap[on], arcs),
    )


def recut(p: Patch, kept: Array, corners: Array) -> Patch:
    """A patch with the `kept` (n,) of its grid's cells, and polygons, corners (m, CORNERS, 2), for the others."""
    plane, flat = middles(corners)
    surface, gap, on = _faces(p.meeting, plane)
    gap += _falls_away(p.arcs, plane)
    on &= np.isfinite(gap)
    new = _cells(surface.cut(on), plane[on], flat[on], gap[on], p.arcs)
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
    gap = surface.gaps()
    return surface, gap, np.isfinite(gap) & (surface.normal @ met.axes[2] > 0.5)


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
    kept: Surface, plane: Array, flat: Array, gap: Array, arcs: Sequence[Arc | None]
) -> dict[str, Any]:
    """What a patch says of each of its cells, by name."""
    met = kept.meeting
    levers, places = kept.levers, (kept.pinion_place, kept.wheel_place)
    flanks = (met.contact.pinion_flank, met.contact.wheel_flank)
    edges: list[Array] = []
    for flank, field, arc, (s, h) in zip(
        flanks, (kept.pinion, kept.wheel), arcs, places, strict=True
    ):
        low = np.asarray(field.lowest.bounds(s)[0])
        tip = flank.tip.at(s) - h if arc is None else np.full(len(s), np.inf)
        edges += [tip, s - flank.toe, flank.heel - s, h - low]
    return {
        "point": kept.point,
        "normal": kept.normal,
        "flat": flat,
        "area": flat / (kept.normal @ met.axes[2]),
        "gap": gap,
        "pinion_lever": levers[0],
        "wheel_lever": levers[1],
        "pinion_place": places[0],
        "wheel_place": places[1],
        "plane": plane,
        "edges": np.stack(edges, axis=1),
    }
