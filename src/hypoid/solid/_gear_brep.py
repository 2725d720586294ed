"""The B-rep of a gear, or of a few of its teeth between the middles of two slots, on its body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.pair import Member

from ._body import Body
from ._brep import Brep, Flat, SplineSurface, Use, turned
from ._splines import SplineCurve, SplineSpan, through

Array = np.ndarray[Any, Any]
WHOLE = np.array([[0.0, 0.0], [1.0, 1.0]])


def gear_brep(
    member: Member, splines: tuple[SplineSpan, ...], body: Body, teeth: int | None = None
) -> Brep:
    """A member with all its teeth, or so many of them, by its tooth's splines and its body."""
    return _Builder(member, splines, body, teeth or member.teeth).brep


class _Builder:
    """Teeth side by side along lines from toe to heel, closed by their ends and the body.

    Lines are those at which patches meet, by rising angle in a left-hand member; a right-hand one is its mirror image.
    """

    def __init__(
        self, member: Member, splines: tuple[SplineSpan, ...], body: Body, teeth: int
    ) -> None:
        self.brep = Brep()
        self._member, self._spans, self._body = member, splines, body
        self._teeth_count, self._whole = teeth, teeth == member.teeth
        self._hand = member.concave.hand
        count = len(splines[0].patches)
        each = [(k, i, 0.0, 1.0) for k in range(teeth) for i in range(count)]
        if not self._whole:
            each[0] = (0, 0, 0.5, 1.0)
            each.append((teeth, 0, 0.0, 0.5))
        self._bands = each  # tooth, patch, and the part of it
        self._lines: list[list[int]] = []  # edges by line and span
        self._corners: list[list[int]] = []  # vertices by line and station
        self._cross: list[list[int]] = []  # edges by band and station
        self._teeth()
        self._ring() if self._whole else self._sector()

    def _placed(self, points: Array, tooth: int) -> Array:
        """Points of a tooth, or poles, turned to its place and hand."""
        angle = tooth * self._member.tooth.pitch
        cosine, sine = np.cos(angle), np.sin(angle)
        turn = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        return (points @ turn) * self._hand

    def _teeth(self) -> None:
        brep, spans = self.brep, self._spans
        lines = [(k, i, low) for k, i, low, _ in self._bands]
        if not self._whole:
            k, i, _, high = self._bands[-1]
            lines.append((k, i, high))
        for k, i, v in lines:
            curves = [self._curve(span.patches[i].along(v), k) for span in spans]
            ends = [brep.vertex(c.poles[0]) for c in curves] + [brep.vertex(curves[-1].poles[-1])]
            self._corners.append(ends)
            self._lines.append([brep.edge(c, *ends[j : j + 2]) for j, c in enumerate(curves)])
        if self._whole:
            self._corners.append(self._corners[0])
            self._lines.append(self._lines[0])
        for b, (k, i, low, high) in enumerate(self._bands):
            across = [self._curve(s.patches[i].across(0), k) for s in spans]
            across.append(self._curve(spans[-1].patches[i].across(-1), k))
            below, above = self._corners[b : b + 2]
            self._cross.append(
                [brep.edge(c, below[j], above[j], low, high) for j, c in enumerate(across)]
            )
            for j, span in enumerate(spans):
                uses = [
                    Use(self._lines[b][j], True),
                    Use(self._cross[b][j + 1], True),
                    Use(self._lines[b + 1][j], False),
                    Use(self._cross[b][j], False),
                ]
                patch = span.patches[i]
                if patch.strip.name == "top land" and not span.span.pointed:
                    self._face_cone(uses)
                    continue
                surface = SplineSurface(patch.knots, self._placed(patch.poles, k))
                square = np.array([[0.0, low], [1.0, high]])
                brep.spline_face(patch.strip.name, surface, uses, square, self._hand[1] < 0.0)

    def _curve(self, curve: SplineCurve, tooth: int) -> SplineCurve:
        return SplineCurve(curve.knots, self._placed(curve.poles, tooth), curve.nodes)

    def _face_cone(self, uses: list[Use]) -> None:
        start = self._angle(self.brep.edges[uses[0].edge].start)
        toe, heel = self._tip(0), self._tip(-1)
        flat = abs(heel[0] - toe[0]) < 1e-9  # a face angle of 90 deg
        surface = _square_to_axis(toe[0], -1.0) if flat else turned(toe, heel, start, True)
        self.brep.face("top land", surface, uses)

    def _chain(self, end: int) -> list[Use]:
        return [Use(edges[end], True) for edges in self._cross]

    def _angle(self, vertex: int) -> float:
        x, y, _ = self.brep.points[vertex]
        return float(np.arctan2(y, x))

    def _vertex(self, z: float, radius: float, angle: float) -> int:
        return self.brep.vertex(np.array([radius * np.cos(angle), radius * np.sin(angle), z]))

    def _tip(self, end: int) -> tuple[float, float]:
        flank = self._member.concave
        distance = flank.heel if end else flank.toe
        z, radius = flank.cone.axial_radial(distance, float(flank.tip.at(distance)))
        return float(z), float(radius)

    def _ring(self) -> None:
        """The body of a whole gear: full turns, each closed at its own seam."""
        brep, body = self.brep, self._body
        toe, heel = (self._angle(self._corners[0][end]) for end in (0, -1))
        places = {
            "toe": (*body.toe_base, toe),
            "front": (body.front, body.bore, toe),
            "bore": (body.back, body.bore, toe),
            "back": (body.back, body.heel_base[1], heel),
            "heel": (*body.heel_base, heel),
        }
        corner = {name: self._vertex(*place) for name, place in places.items()}
        around = {
            name: brep.arc(z, radius, (angle, angle + 2.0 * np.pi), (corner[name], corner[name]))
            for name, (z, radius, angle) in places.items()
        }

        def seamed(name: str, low: str, high: list[Use], top: int, end: Any, outward: bool) -> None:
            seam = brep.segment(corner[low], top)
            loop = [around[low], Use(seam, True), *_back(high), Use(seam, False)]
            z, radius, angle = places[low]
            brep.face(name, turned((z, radius), end, angle, outward), loop)

        ends = [
            self._chain(end) if self._hand[1] > 0.0 else _back(self._chain(end)) for end in (0, -1)
        ]
        seamed("toe", "toe", ends[0], self._corners[0][0], self._tip(0), False)
        seamed("heel", "heel", ends[1], self._corners[0][-1], self._tip(-1), True)
        seamed("bore", "front", [around["bore"]], corner["bore"], places["bore"][:2], False)
        seamed("rim", "heel", [around["back"]], corner["back"], places["back"][:2], True)
        brep.face("front", _square_to_axis(body.front, -1.0), [around["toe"]], [around["front"]])
        brep.face("back", _square_to_axis(body.back, 1.0), [around["back"]], [around["bore"]])

    def _sector(self) -> None:
        """The body below a few teeth, between two sheets of lines that point to the axis."""
        brep, body = self.brep, self._body
        sides = [self._side(0), self._side(-1)]
        first, last = sides
        wide = self._hand[1] * self._teeth_count * self._member.tooth.pitch
        places = {
            "toe": body.toe_base,
            "front": (body.front, body.bore),
            "bore": (body.back, body.bore),
            "back": (body.back, body.heel_base[1]),
            "heel": body.heel_base,
        }
        around = {
            name: brep.arc(
                *place,
                (self._angle(first.corner[name]), self._angle(first.corner[name]) + wide),
                (first.corner[name], last.corner[name]),
            )
            for name, place in places.items()
        }

        def loop(low: str, up: str, high: list[Use]) -> list[Use]:
            return [around[low], *last.path[up], *_back(high), *_back(first.path[up])]

        def over(name: str, low: str, end: Any, uses: list[Use], outward: bool) -> None:
            angle = self._angle(first.corner[low])
            brep.face(name, turned(places[low], end, angle, outward), uses)

        over("toe", "toe", self._tip(0), loop("toe", "toe", self._chain(0)), False)
        over("heel", "heel", self._tip(-1), loop("heel", "heel", self._chain(-1)), True)
        over("bore", "front", places["bore"], loop("front", "bore", [around["bore"]]), False)
        over("rim", "heel", places["back"], loop("heel", "rim", [around["back"]]), True)
        front, back = _square_to_axis(body.front, -1.0), _square_to_axis(body.back, 1.0)
        brep.face("front", front, loop("front", "front", [around["toe"]]))
        brep.face("back", back, loop("bore", "back", [around["back"]]))

    def _side(self, line: int) -> _Side:
        """The sheet below the middle of a slot, from its bottom by the base line to the bore."""
        brep, body, flank = self.brep, self._body, self._member.concave
        corners, edges = self._corners[line], self._lines[line]
        outward = (line == -1) == (self._hand[1] > 0.0)
        name = "end" if line else "start"
        sheets: list[tuple[SplineCurve, SplineCurve, SplineCurve]] = []
        for edge, span in zip(edges, self._spans, strict=True):
            curve = brep.edges[edge].curve
            assert isinstance(curve, SplineCurve)
            x, y, _ = curve(curve.nodes).T
            share = span.span.start + (span.span.end - span.span.start) * curve.nodes
            share = (share - flank.toe) / (flank.heel - flank.toe)
            z, radius = np.outer(body.toe_base, 1.0 - share) + np.outer(body.heel_base, share)
            angle = np.arctan2(y, x)

            def ring(radius: Any, angle: Array = angle, z: Array = z) -> Array:
                return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1)

            base, bore = (through(curve.nodes, ring(r)) for r in (radius, body.bore))
            sheets.append((curve, base, bore))
        ends = [
            [brep.vertex(s[k].poles[0]) for s in sheets] + [brep.vertex(sheets[-1][k].poles[-1])]
            for k in (1, 2)
        ]
        upper = [brep.segment(a, b) for a, b in zip(ends[0], corners, strict=True)]
        lower = [brep.segment(a, b) for a, b in zip(ends[1], ends[0], strict=True)]
        inner: list[Use] = []
        for j, (curve, base, bore) in enumerate(sheets):
            middle, bottom = (
                brep.edge(c, v[j], v[j + 1]) for c, v in zip((base, bore), ends, strict=True)
            )
            inner.append(Use(bottom, True))
            for low, high, low_edge, high_edge, across in (
                (base, curve, middle, edges[j], upper),
                (bore, base, bottom, middle, lower),
            ):
                surface = SplineSurface(
                    (curve.knots, np.array([0.0, 0.0, 1.0, 1.0])),
                    np.stack([low.poles, high.poles], axis=1),
                )
                uses = [Use(low_edge, True), Use(across[j + 1], True)]
                uses += [Use(high_edge, False), Use(across[j], False)]
                brep.spline_face(name, surface, uses, WHOLE, outward)
        angle = self._angle(ends[1][-1])
        back_bore = self._vertex(body.back, body.bore, angle)
        back_rim = self._vertex(body.back, body.heel_base[1], angle)
        along, rise, rim = (
            brep.segment(*pair)
            for pair in ((ends[1][-1], back_bore), (back_bore, back_rim), (ends[0][-1], back_rim))
        )
        normal = np.array([-np.sin(angle), np.cos(angle), 0.0]) * (1.0 if outward else -1.0)
        flat = Flat(brep.points[back_bore], normal)
        uses = [Use(along, True), Use(rise, True), Use(rim, False), Use(lower[-1], False)]
        brep.face(name, flat, uses)
        corner = {
            "toe": ends[0][0],
            "front": ends[1][0],
            "bore": back_bore,
            "back": back_rim,
            "heel": ends[0][-1],
        }
        path = {
            "toe": [Use(upper[0], True)],
            "heel": [Use(upper[-1], True)],
            "front": [Use(lower[0], True)],
            "bore": [*inner, Use(along, True)],
            "back": [Use(rise, True)],
            "rim": [Use(rim, True)],
        }
        return _Side(corner, path)


@dataclass(frozen=True)
class _Side:
    """Where the body's edges meet one side of a sector, and its edges between two of them."""

    corner: dict[str, int]
    path: dict[str, list[Use]]


def _back(uses: list[Use]) -> list[Use]:
    return [Use(use.edge, not use.forward, use.on) for use in uses[::-1]]


def _square_to_axis(z: float, normal: float) -> Flat:
    return Flat(np.array([0.0, 0.0, z]), np.array([0.0, 0.0, normal]))
