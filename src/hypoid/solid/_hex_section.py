"""Inner nodes of the sections S = const, between the outline of a tooth and the base line below it.

A section is a cone; unrolled into the plane (its radius there is the distance from the back cone's apex) it
keeps every length. There all sections are smoothed at once, with the base line's nodes free along it and the
borders to both neighbours the same but for a turn by one pitch.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.sparse import csc_array, csr_array, eye_array, kron
from scipy.sparse.linalg import splu

from hypoid.flank import PitchCone

from ._hex_layout import Layout
from ._hex_outline import Line, through_shares
from ._smooth import Place, edge_vectors, smooth

Array = np.ndarray[Any, Any]
BELOW = 2.2  # thickness of the lowest layer below the slot to the uppermost
FLATTEST = 1e-6  # cosine of a pitch angle, below which the unrolled cone is not quite to scale


@dataclass(frozen=True)
class Outline:
    """A tooth's outline by sections: from the slot's middle at low angles to the tip, and back down."""

    distance: Array  # (sections,)
    base: Array  # height of the base line, mm
    concave_bottom: Line
    concave: Line
    convex: Line
    convex_bottom: Line
    pitch: float


@dataclass(frozen=True)
class Plane:
    """Unrolled sections: radius of the pitch line (sections,), mm, and the angle at their middle."""

    cone: PitchCone
    distance: Array
    middle: Array

    @cached_property
    def cosine(self) -> float:
        return max(float(self.cone.cosine), FLATTEST)

    @cached_property
    def radius(self) -> Array:
        return self.distance * float(self.cone.sine) / self.cosine

    def flat(self, angle: Array, height: Array) -> Array:
        """Arc along the pitch line and height, mm: (sections, n, 2)."""
        arc = (angle - self.middle[:, None]) * (self.cosine * self.radius[:, None])
        return np.stack([arc, height], axis=-1)

    def of_line(self, line: Line) -> Array:
        return self.flat(line.angle, self.cone.cone_distance_height(line.z, line.rho)[1])

    def line(self, flat: Array) -> Line:
        """Back to space."""
        z, rho = self.cone.axial_radial(self.distance[:, None], flat[..., 1])
        angle = flat[..., 0] / (self.cosine * self.radius[:, None]) + self.middle[:, None]
        return Line(np.asarray(z), np.asarray(rho), angle)


def unrolled(flat: Array, radius: Any) -> Array:
    """Points (..., 2) mm in the plane from arc and height."""
    turn = flat[..., 0] / radius
    r = radius + flat[..., 1]
    # 1 - cos without loss, for flat sections
    fall = 2.0 * np.sin(0.5 * turn) ** 2
    return np.stack([r * np.sin(turn), flat[..., 1] - r * fall], axis=-1)


def sections(layout: Layout, outline: Outline, cone: PitchCone) -> tuple[Line, Array]:
    """Nodes and middle nodes of every section above the ring, and which of them are set.

    Columns of the line are the layout's nodes, then its edges.
    """
    middle = 0.5 * (outline.concave.angle[:, -1] + outline.convex.angle[:, -1])
    plane = Plane(cone, outline.distance, middle)
    first = _first(layout, outline, plane)
    made = _smoothed(layout, outline, plane, first)
    edges = layout.edges
    # along arcs about the axis, as base line and top land are
    between = 0.5 * (made[:, edges[:, 0]] + made[:, edges[:, 1]])
    flat = np.concatenate([made, between], axis=1)
    above = np.zeros(layout.number.shape, dtype=bool)
    above[:, layout.base :] = True
    there = above[layout.number >= 0]
    there = np.concatenate([there, there[edges].all(axis=1)])
    line = plane.line(flat)
    for nodes, exact in _lines(layout, outline):
        line.z[:, nodes], line.rho[:, nodes], line.angle[:, nodes] = exact.z, exact.rho, exact.angle
    return line, there


def _chain(layout: Layout, nodes: Array) -> Array:
    """Nodes of a line with the edges between them, as columns."""
    made = np.repeat(nodes, 2)[:-1]
    made[1::2] = layout.nodes + layout.edge(nodes[:-1], nodes[1:])
    return made


def _lines(layout: Layout, outline: Outline) -> list[tuple[Array, Line]]:
    """Columns of the outline and what stands there: bottom, fillet and flank of both sides."""
    n, surface = layout.number, layout.surface
    tower = layout.tower
    strip = np.concatenate([n[: tower.start, surface], n[tower.start, surface:]])
    other = np.concatenate([n[tower.stop :, surface][::-1], n[tower.stop - 1, surface:]])
    made: list[tuple[Array, Line]] = []
    for nodes, root, flank, bottom in (
        (strip, layout.concave, outline.concave, outline.concave_bottom),
        (other, layout.convex, outline.convex, outline.convex_bottom[::-1]),
    ):
        chain = _chain(layout, nodes)
        split = 2 * root.bottom
        made += [(chain[: split + 1], bottom), (chain[split:], flank)]
    # the flank's own lowest point is the bottom's end, too: the flank comes last
    return made


def _first(layout: Layout, outline: Outline, plane: Plane) -> Array:
    """First guess (sections, nodes, 2): arcs about the axis from flank to flank, straight lines down."""
    count = len(outline.distance)
    flat = np.full((count, layout.nodes, 2), np.nan)
    for columns, line in _lines(layout, outline):
        flat[:, columns[::2]] = plane.of_line(line)[:, ::2]
    n, base, surface = layout.number, layout.base, layout.surface
    a, b = layout.tower.start, layout.tower.stop - 1
    share = through_shares(layout.through)[:, None, None]
    for j in range(surface, n.shape[1]):
        left, right = flat[:, n[a, j]], flat[:, n[b, j]]
        row = left + share * (right - left)
        flat[:, n[a + 1 : b, j]] = np.moveaxis(row[1:-1], 0, 1)
    top = flat[:, n[:, surface]]
    foot = _feet(top[..., 0], a, b, through_shares(layout.through))
    low = np.stack([foot, np.broadcast_to(outline.base[:, None], foot.shape)], axis=-1)
    depth = depths(layout.below)
    for step, j in enumerate(range(base, surface)):
        flat[:, n[:, j]] = low + depth[step] * (top - low)
    return flat


def depths(count: int) -> Array:
    """Shares (count + 1,) of the way from the base line up to the surface of the layers' borders."""
    size = BELOW ** np.linspace(1.0, 0.0, count)
    return np.append(0.0, np.cumsum(size)) / size.sum()


def _feet(arc: Array, a: int, b: int, share: Array) -> Array:
    """Where the columns meet the base line: below the surface's nodes, as far as these do not turn back."""
    steps = np.abs(np.diff(arc, axis=1))
    steps[:, a:b] = np.diff(share) * np.abs(arc[:, b] - arc[:, a])[:, None]
    way = np.concatenate([np.zeros((len(arc), 1)), np.cumsum(steps, axis=1)], axis=1)
    return arc[:, :1] + way / way[:, -1:] * (arc[:, -1:] - arc[:, :1])


def _smoothed(layout: Layout, outline: Outline, plane: Plane, first: Array) -> Array:
    """The first guess moved to where shapes are best."""
    edge_of = edge_vectors(layout.quads[layout.ring_cells :], layout.nodes)
    flat = np.nan_to_num(np.moveaxis(first, 0, 2))  # (nodes, 2, sections)
    freedom = _Freedom(layout, plane.radius, outline.pitch * plane.cosine * plane.radius)
    points = np.moveaxis(unrolled(np.moveaxis(flat, 1, 2), plane.radius), 2, 1)
    edges = (edge_of @ points.reshape(len(points), -1)).reshape(4, -1, 2, flat.shape[2])
    size = np.hypot(edges[:, :, 0], edges[:, :, 1])
    made = smooth(
        freedom.placed(flat),
        flat.reshape(-1, flat.shape[2])[freedom.free],
        edge_of,
        size,
        freedom.laplacian(edge_of, size),
    )
    made = np.moveaxis(freedom.put(flat, made), 2, 0)
    return np.where(np.isfinite(first), made, np.nan)


class _Freedom:
    """Which coordinates of a section are free: inner nodes, the borders together, feet along the base line."""

    def __init__(self, layout: Layout, radius: Array, shift: Array) -> None:
        self.radius, self.shift = radius, shift
        n, base, surface = layout.number, layout.base, layout.surface
        fixed = np.zeros((layout.nodes, 2), dtype=bool)
        tower = layout.tower
        fixed[n[:, :base]] = True
        fixed[n[: tower.start + 1, surface]] = True
        fixed[n[tower.stop - 1 :, surface]] = True
        fixed[n[[tower.start, tower.stop - 1], surface:]] = True
        fixed[n[tower, -1]] = True
        fixed[n[:, base], 1] = True
        self.low, self.high = n[0, base:surface], n[-1, base:surface]
        fixed[self.high] = True
        self.free = np.flatnonzero(~fixed.ravel())
        index = np.full(fixed.size, -1)
        index[self.free] = np.arange(len(self.free))
        index = index.reshape(fixed.shape)
        index[self.high] = index[self.low]  # each border is the other's copy
        moves = np.flatnonzero(index.ravel() >= 0)
        self.spread = csr_array(
            (np.ones(len(moves)), (moves, index.ravel()[moves])),
            shape=(fixed.size, len(self.free)),
        )

    def put(self, flat: Array, unknowns: Array) -> Array:
        made = flat.copy()
        made.reshape(-1, flat.shape[2])[self.free] = unknowns
        made[self.high] = made[self.low]
        made[self.high, 0] += self.shift
        return made

    def placed(self, flat: Array) -> Place:
        """Points in the plane from the unknowns, and the way back for their gradient."""

        def place(unknowns: Array) -> tuple[Array, Callable[[Array], Array]]:
            made = self.put(flat, unknowns)
            turn, r = made[:, 0] / self.radius, self.radius + made[:, 1]
            s, c = np.sin(turn), np.cos(turn)

            def back(by_points: Array) -> Array:
                x, y = by_points[:, 0], by_points[:, 1]
                by_flat = np.stack([(x * c - y * s) * r / self.radius, x * s + y * c], axis=1)
                return self.spread.T @ by_flat.reshape(-1, flat.shape[2])

            return np.moveaxis(unrolled(np.moveaxis(made, 1, 2), self.radius), 2, 1), back

        return place

    def laplacian(self, edge_of: csr_array, size: Array) -> Callable[[Array], Array]:
        """Inverse of the energy's stiffness where every element has its target's shape."""
        weight = 2.0 / size.mean(axis=2) ** 2
        stiff = (edge_of.T * weight.ravel()) @ edge_of
        both = self.spread.T @ kron(stiff, eye_array(2)) @ self.spread
        return splu(csc_array(both)).solve
