"""A tooth's strips as interpolating splines: the same points where strips meet, and as close as is asked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from hypoid.flank import Tooth

from ._strips import Span, Strip, spans

Array = np.ndarray[Any, Any]
DEGREE = 5
CLOSE = 5e-6  # mm, off the exact surface between the points that a spline passes
FLANK_CLOSE = 1e-6  # mm, the same across a flank: there teeth touch
ON_CONE = 5e-7  # mm, off the cones that end the teeth, along their edges
COLUMNS = (13, 17, 25, 33, 49, 65)
ROWS = (9, 13, 17, 25, 33, 49, 65, 97)
CLUSTERED = 0.7  # how far points crowd towards the ends: 0 even, 1 as a Chebyshev polynomial's


@dataclass(frozen=True)
class SplineCurve:
    """Knots (with their multiplicity), poles (n, d) and the parameters of the points that it passes."""

    knots: Array
    poles: Array
    nodes: Array

    @property
    def degree(self) -> int:
        return int((self.knots == self.knots[0]).sum()) - 1

    def __call__(self, at: Array) -> Array:
        return BSpline(self.knots, self.poles, self.degree)(at)


@dataclass(frozen=True)
class SplinePatch:
    """A strip's spline over the unit square: poles (n, m, 3), mm."""

    strip: Strip
    u: Array  # parameters of the points that it passes
    v: Array
    poles: Array

    @property
    def knots(self) -> tuple[Array, Array]:
        return _knots(self.u), _knots(self.v)

    def along(self, v: float) -> SplineCurve:
        """The curve from toe to heel at v."""
        if v in (0.0, 1.0):
            return SplineCurve(self.knots[0], self.poles[:, int(-v)], self.u)
        poles = BSpline(self.knots[1], self.poles.swapaxes(0, 1), DEGREE)(v)
        return SplineCurve(self.knots[0], np.asarray(poles), self.u)

    def across(self, end: int) -> SplineCurve:
        """The curve across at u = 0 (end 0) or u = 1 (end -1)."""
        return SplineCurve(self.knots[1], self.poles[end], self.v)

    def __call__(self, u: Array, v: Array) -> Array:
        """Points (n, m, 3)."""
        rows = BSpline(self.knots[0], self.poles, DEGREE)(u).swapaxes(0, 1)
        return BSpline(self.knots[1], rows, DEGREE)(v).swapaxes(0, 1)


@dataclass(frozen=True)
class SplineSpan:
    """A tooth's patches between two cone distances, by rising angle from the slot's bottom on."""

    span: Span
    patches: tuple[SplinePatch, ...]


def through(nodes: Array, points: Array) -> SplineCurve:
    """The spline through points (n, d) at parameters (n,)."""
    made = make_interp_spline(nodes, points, k=DEGREE)
    return SplineCurve(made.t, made.c, nodes)


def tooth_splines(tooth: Tooth) -> tuple[SplineSpan, ...]:
    """A tooth's faces as splines; edges that strips share are one curve."""
    made = spans(tooth)
    rows = [
        max(
            _enough(ROWS, lambda m, s=s, strip=k: _row_error(tooth, s, s.strips[strip], m))
            for s in made
        )
        for k in range(len(made[0].strips))
    ]
    found: list[SplineSpan] = []
    for span in made:
        columns = max(
            _enough(COLUMNS, lambda n, s=strip, a=span: _column_error(tooth, a, s, n))
            for strip in span.strips
        )
        u = _nodes(columns)
        patches: list[SplinePatch] = []
        for strip, m in zip(span.strips, rows, strict=True):
            v = _nodes(m)
            points = strip.at(u, v)[0]
            along = make_interp_spline(u, points, k=DEGREE).c
            poles = make_interp_spline(v, along.swapaxes(0, 1), k=DEGREE).c.swapaxes(0, 1)
            patches.append(SplinePatch(strip, u, v, poles))
        found.append(SplineSpan(span, _joined(tooth, patches, found)))
    return tuple(found)


def _joined(
    tooth: Tooth, patches: list[SplinePatch], before: list[SplineSpan]
) -> tuple[SplinePatch, ...]:
    """Borders that two patches share, given the same poles: rounding is all that told them apart."""
    cosine, sine = np.cos(tooth.pitch), np.sin(tooth.pitch)
    back = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    poles = [patch.poles.copy() for patch in patches]
    if before:
        for own, patch in zip(poles, before[-1].patches, strict=True):
            own[0] = patch.poles[-1]
    for first, second in pairwise(poles):
        second[:, 0] = first[:, -1]
    poles[0][:, 0] = poles[-1][:, -1] @ back
    return tuple(replace(p, poles=own) for p, own in zip(patches, poles, strict=True))


def _knots(nodes: Array) -> Array:
    inner = nodes[(DEGREE + 1) // 2 : -(DEGREE + 1) // 2]
    return np.concatenate([np.zeros(DEGREE + 1), inner, np.ones(DEGREE + 1)])


def _nodes(count: int) -> Array:
    even = np.linspace(0.0, 1.0, count)
    return (1.0 - CLUSTERED) * even + CLUSTERED * 0.5 * (1.0 - np.cos(np.pi * even))


def _enough(ladder: tuple[int, ...], error: Callable[[int], float]) -> int:
    """The first count whose error, a share of what is allowed, is under 1; else the last."""
    return next((count for count in ladder if error(count) < 1.0), ladder[-1])


def _between(nodes: Array) -> Array:
    return 0.5 * (nodes[1:] + nodes[:-1])


def _row_error(tooth: Tooth, span: Span, strip: Strip, count: int) -> float:
    u, v = np.linspace(0.0, 1.0, 5), _nodes(count)
    between = _between(v)
    exact, normal = strip.at(u, between)
    made = make_interp_spline(v, strip.at(u, v)[0].swapaxes(0, 1), k=DEGREE)(between).swapaxes(0, 1)
    close = FLANK_CLOSE if strip.name.endswith(" flank") else CLOSE
    worst = np.abs(((made - exact) * normal).sum(axis=-1)).max() / close
    flank = tooth.concave
    for k, end, cone in ((0, span.start, flank.toe), (-1, span.end, flank.heel)):
        if end == cone:
            distance = _distance_height(tooth, made[k])[0]
            worst = max(worst, np.abs(distance - cone).max() / ON_CONE)
    return float(worst)


def _column_error(tooth: Tooth, span: Span, strip: Strip, count: int) -> float:
    u, v = _nodes(count), np.linspace(0.0, 1.0, 5)
    between = _between(u)
    exact, normal = strip.at(between, v)
    made = make_interp_spline(u, strip.at(u, v)[0], k=DEGREE)(between)
    worst = np.abs(((made - exact) * normal).sum(axis=-1)).max() / CLOSE
    if strip.name == "top land" and not span.pointed:
        distance, height = _distance_height(tooth, made[:, [0, -1]])
        worst = max(worst, np.abs(height - tooth.concave.tip.at(distance)).max() / ON_CONE)
    return float(worst)


def _distance_height(tooth: Tooth, point: Array) -> tuple[Array, Array]:
    z, radius = point[..., 2], np.hypot(point[..., 0], point[..., 1])
    return tooth.concave.cone.cone_distance_height(z, radius)
