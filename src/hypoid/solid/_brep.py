"""A gear or a few of its teeth as faces, edges and vertices: each edge is one curve, used by two faces.

The tooth's faces are splines, the cones that end the teeth and the body are what they are: cones, cylinders
and planes. Nothing here needs a CAD kernel; ``hypoid.io`` hands it to one.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias

import numpy as np

from ._splines import SplineCurve, through

Array = np.ndarray[Any, Any]
LEAST = 1e-7  # mm, tolerance of an edge
DENSE = 4  # points between those a curve passes, where it is held against a surface


@dataclass(frozen=True)
class Arc:
    """About the axis; its parameter is the angle, rad."""

    z: float
    radius: float

    def __call__(self, at: Array) -> Array:
        x, y = self.radius * np.cos(at), self.radius * np.sin(at)
        return np.stack([x, y, np.full(np.shape(at), self.z)], axis=-1)


@dataclass(frozen=True)
class Segment:
    """A straight line; its parameter is the length, mm."""

    start: Array
    direction: Array

    def __call__(self, at: Array) -> Array:
        return self.start + np.multiply.outer(at, self.direction)


Curve: TypeAlias = SplineCurve | Arc | Segment


@dataclass(frozen=True)
class SplineSurface:
    """Knots (with their multiplicity) along u and v, and poles (n, m, 3)."""

    knots: tuple[Array, Array]
    poles: Array


@dataclass(frozen=True)
class Flat:
    """A plane by a point and its normal, out of the solid."""

    point: Array
    normal: Array

    def parameters(self, point: Array) -> Array:
        across = (
            np.array([1.0, 0.0, 0.0]) if abs(self.normal[2]) > 0.5 else np.array([0.0, 0.0, 1.0])
        )
        return np.stack([point @ across, point @ np.cross(self.normal, across)], axis=-1)


@dataclass(frozen=True)
class Turned:
    """A cone or cylinder about the axis, from its smaller radius on.

    Parameters are the angle from ``zero``, rad, positive about ``axis``, and the length along the generatrix.
    """

    z: float
    radius: float
    lean: float  # angle between generatrix and axis, rad; 0 a cylinder
    axis: float  # +1 where the radius grows with z, -1 where it falls
    zero: float
    outward: bool  # the solid lies inside

    def parameters(self, point: Array) -> Array:
        angle = np.unwrap(np.arctan2(point[:, 1], point[:, 0])) - self.zero
        along = self.axis * (point[:, 2] - self.z) * np.cos(self.lean)
        along += (np.hypot(point[:, 0], point[:, 1]) - self.radius) * np.sin(self.lean)
        return np.stack([self.axis * angle, along], axis=-1)

    def __call__(self, place: Array) -> Array:
        angle = self.zero + self.axis * place[:, 0]
        radius = self.radius + place[:, 1] * np.sin(self.lean)
        z = self.z + self.axis * place[:, 1] * np.cos(self.lean)
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1)


def turned(
    start: tuple[float, float], end: tuple[float, float], zero: float, outward: bool
) -> Turned:
    """What a line between two places (z, radius) sweeps about the axis."""
    (z, radius), (z_end, radius_end) = sorted((start, end), key=lambda place: place[1])
    if radius_end - radius < 1e-9:
        return Turned(min(z, z_end), radius, 0.0, 1.0, zero, outward)
    lean = float(np.arctan2(radius_end - radius, abs(z_end - z)))
    return Turned(z, radius, lean, 1.0 if z_end > z else -1.0, zero, outward)


@dataclass(frozen=True)
class Edge:
    curve: Curve
    start: int  # vertices
    end: int
    low: float
    high: float
    tolerance: float = LEAST


@dataclass(frozen=True)
class Use:
    """An edge as a face goes along it, and its curve over the face's parameters (none on a plane)."""

    edge: int
    forward: bool
    on: SplineCurve | None = None


@dataclass(frozen=True)
class Face:
    """Loops have the face on their left, in the surface's parameters."""

    name: str
    surface: SplineSurface | Flat | Turned
    loops: tuple[tuple[Use, ...], ...]
    outward: bool  # the surface's own normal points out of the solid


@dataclass
class Brep:
    """Vertices (mm), edges and faces of one closed solid; grows while it is built."""

    points: list[Array] = field(default_factory=list)
    edges: list[Edge] = field(default_factory=list)
    faces: list[Face] = field(default_factory=list)

    def vertex(self, point: Array) -> int:
        self.points.append(np.asarray(point, float))
        return len(self.points) - 1

    def edge(self, curve: Curve, start: int, end: int, low: float = 0.0, high: float = 1.0) -> int:
        self.edges.append(Edge(curve, start, end, low, high))
        return len(self.edges) - 1

    def segment(self, start: int, end: int) -> int:
        a, b = self.points[start], self.points[end]
        length = float(np.linalg.norm(b - a))
        return self.edge(Segment(a, (b - a) / length), start, end, 0.0, length)

    def arc(
        self, z: float, radius: float, angles: tuple[float, float], ends: tuple[int, int]
    ) -> Use:
        """From one angle to the other, rad, whichever is the greater."""
        (low, start), (high, end) = sorted(zip(angles, ends, strict=True))
        return Use(self.edge(Arc(z, radius), start, end, low, high), angles[0] < angles[1])

    def spline_face(
        self, name: str, surface: SplineSurface, uses: list[Use], square: Array, outward: bool
    ) -> None:
        """Four edges about a rectangle (u, v) of a spline: low v, high u, high v, low u."""
        (u0, v0), (u1, v1) = square
        corners = np.array([[u0, v0], [u1, v0], [u1, v1], [u0, v1], [u0, v0]])
        loop: list[Use] = []
        for k, use in enumerate(uses):
            ends = corners[k : k + 2] if use.forward else corners[k : k + 2][::-1]
            edge = self.edges[use.edge]
            loop.append(Use(use.edge, use.forward, _straight(edge.low, edge.high, ends)))
        self.faces.append(Face(name, surface, (tuple(loop),), outward))

    def face(self, name: str, surface: Flat | Turned, *loops: list[Use]) -> None:
        """A plane, cone or cylinder within loops, the first about the others."""
        outward = surface.outward if isinstance(surface, Turned) else True
        made = [self._loop(surface, loop, inner=k > 0) for k, loop in enumerate(loops)]
        self.faces.append(Face(name, surface, tuple(made), outward))

    def _loop(self, surface: Flat | Turned, loop: list[Use], inner: bool) -> tuple[Use, ...]:
        uses: list[Use] = []
        path: list[Array] = []
        last = 0.0
        for use in loop:
            edge = self.edges[use.edge]
            if isinstance(surface, Flat):
                places = surface.parameters(edge.curve(np.linspace(edge.low, edge.high, 9)))
                on = None
            else:
                on = self._over(surface, use, last)
                places = on(np.linspace(edge.low, edge.high, 9))
                last = float(places[-1 if use.forward else 0, 0])
            uses.append(Use(use.edge, use.forward, on))
            path.append(places if use.forward else places[::-1])
        x, y = np.concatenate(path).T
        area = float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
        if (area < 0.0) != inner:
            uses = [Use(use.edge, not use.forward, use.on) for use in uses[::-1]]
        if isinstance(surface, Turned):  # the kernel counts angles from 0 on
            least = min(float(use.on.poles[:, 0].min()) for use in uses if use.on)
            turn = np.array([2.0 * np.pi * np.ceil(-least / (2.0 * np.pi) - 1e-6), 0.0])
            uses = [
                replace(use, on=replace(use.on, poles=use.on.poles + turn))
                for use in uses
                if use.on
            ]
        return tuple(uses)

    def _over(self, surface: Turned, use: Use, last: float) -> SplineCurve:
        """An edge over a turned surface's parameters, next to where the one before it ended."""
        edge = self.edges[use.edge]
        straight = not isinstance(edge.curve, SplineCurve)
        if isinstance(edge.curve, SplineCurve):
            own = edge.curve.nodes
            nodes = np.sort(np.concatenate([own, 0.5 * (own[1:] + own[:-1])]))
            places = surface.parameters(edge.curve(nodes))
            made = through(nodes, places)
        else:
            fine = np.linspace(edge.low, edge.high, 65)
            made = _straight(edge.low, edge.high, surface.parameters(edge.curve(fine))[[0, -1]])
        begin = float(made(np.array([edge.low if use.forward else edge.high]))[0, 0])
        shift = 2.0 * np.pi * np.round((last - begin) / (2.0 * np.pi))
        made = SplineCurve(made.knots, made.poles + np.array([shift, 0.0]), made.nodes)
        if not straight:
            fine = np.linspace(edge.low, edge.high, DENSE * len(made.nodes))
            off = np.abs(np.linalg.norm(surface(made(fine)) - edge.curve(fine), axis=1)).max()
            if 1.1 * off > edge.tolerance:
                self.edges[use.edge] = Edge(
                    edge.curve, edge.start, edge.end, edge.low, edge.high, 1.1 * float(off)
                )
        return made


def _straight(low: float, high: float, ends: Array) -> SplineCurve:
    """From one place to another, evenly over an edge's own parameter."""
    return SplineCurve(np.array([low, low, high, high]), ends, np.array([low, high]))
