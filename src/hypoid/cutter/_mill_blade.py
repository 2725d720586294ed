"""Blade of a face-mill head, or one side of a cup-shaped grinding wheel: its profile by measures.

The plane of the profile holds the cutter axis; its origin is the sharp corner, where the straight
flank, extended, meets the plane of the tips [tsay1993, (1)-(4); lin1996, (1)]. For a curved profile
the straight flank is its tangent at the reference height.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ._profile import BladeName, PlanePiece, fillet_piece, land_piece


@dataclass(frozen=True)
class CircularProfile:
    """Circular arc as the cutting edge: the blade angle holds at the reference height (mm)."""

    radius: float  # positive crowns the tooth: the edge bends towards the metal
    reference_height: float  # above the plane of the tips, along the axis


@dataclass(frozen=True)
class ParabolicProfile:
    """Parabola as the cutting edge, its vertex at the reference height, where the blade angle holds.

    Off its tangent there by coefficient times the square of the way along that tangent (mm).
    """

    coefficient: float  # 1/mm, positive crowns the tooth: the edge bends towards the metal
    reference_height: float  # above the plane of the tips, along the axis


@dataclass(frozen=True)
class Toprem:
    """Straight edge at the blade's tip that leaves the flank at a kink and removes more (mm, rad).

    It frees the root of the tooth from the mate's tip [vimercati2005, (2)].
    """

    angle: float  # between Toprem and flank
    height: float  # of the kink above the plane of the tips, along the axis


@dataclass(frozen=True)
class Flankrem:
    """Edge near the shank that removes more at the tooth's tip: a straight edge, or a parabola (mm, rad).

    One of ``angle`` (straight, at a kink) and ``coefficient`` (a parabola on top of the flank's own
    profile, tangent to it) is given.
    """

    height: (
        float  # where it begins above the plane of the tips, along the axis; it ends at the shank
    )
    angle: float = 0.0  # between Flankrem and flank
    coefficient: float = 0.0  # 1/mm, of the square of the way along the edge from its beginning


BladeCurve = CircularProfile | ParabolicProfile


@dataclass(frozen=True)
class MillBlade:
    """One side of a face-mill head: flat, edge arc, Toprem, flank and Flankrem (mm, rad)."""

    name: BladeName
    point_radius: float  # where the extended straight flank meets the plane of the tips
    angle: float  # blade (pressure) angle against the cutter axis, positive if wider at the shank
    edge_radius: float  # 0: a sharp corner
    land: float  # flat from the sharp corner to the middle of the slot or to the other blade
    height: float  # from the tip to the end of the edge at the shank, along the axis
    profile: BladeCurve | None = None  # None: straight
    toprem: Toprem | None = None
    flankrem: Flankrem | None = None

    @property
    def line(self) -> PlanePiece:
        """The flank's curve with its zero of s, without ends: x off the sharp corner, z = 0 at the tips."""
        height = self.profile.reference_height if self.profile else 0.0
        curve = PlanePiece(
            "flank", (height * math.tan(self.angle), -height), math.pi / 2 - self.angle, 0.0, 0.0
        )
        if isinstance(self.profile, CircularProfile):
            return replace(curve, curvature=1.0 / self.profile.radius)
        if isinstance(self.profile, ParabolicProfile):
            return replace(curve, parabola=self.profile.coefficient)
        return curve

    @property
    def outline(self) -> tuple[PlanePiece, ...]:
        """Land, edge arc, Toprem, flank and straight Flankrem in the blade's plane, as far as there are any.

        Each but Toprem and Flankrem is tangent to the one before; a parabolic Flankrem is a relief
        of the flank itself. The flank's s counts from the sharp corner, or from the reference height
        if it is curved; a Flankrem's s goes on from the flank's; a Toprem's counts from where it
        meets the plane of the tips, extended.
        """
        flank = self.line
        toprem, flankrem = self._toprem(flank), self._flankrem(flank)
        if self.flankrem and not flankrem:
            begin = flank.at_depth(self.flankrem.height)
            flank = replace(flank, relief=self.flankrem.coefficient, relief_from=begin)
        first = toprem or flank
        start = first.at_depth(0.0, self.edge_radius)
        at = first.at(start)
        tip = (at.x - self.edge_radius * math.cos(at.lean), 0.0)
        pieces = [land_piece(tip, self.land + tip[0])]
        if self.edge_radius:
            pieces.append(fillet_piece(tip, self.edge_radius, at.lean))
        if toprem:
            pieces.append(replace(toprem, low=start))
        low = flank.at_depth(self.toprem.height) if self.toprem else start
        high = flankrem.low if flankrem else flank.at_depth(self.height)
        pieces.append(replace(flank, low=low, high=high))
        return (*pieces, flankrem) if flankrem else tuple(pieces)

    def _toprem(self, flank: PlanePiece) -> PlanePiece | None:
        """Toprem from the plane of the tips to its kink."""
        if self.toprem is None:
            return None
        kink = flank.at(flank.at_depth(self.toprem.height))
        lean = kink.lean - self.toprem.angle
        corner = (kink.x + kink.z * math.tan(lean), 0.0)
        high = -kink.z / math.cos(lean)
        return PlanePiece("toprem", corner, math.pi / 2 - lean, 0.0, high)

    def _flankrem(self, flank: PlanePiece) -> PlanePiece | None:
        """Straight Flankrem from its kink to the shank."""
        if self.flankrem is None or self.flankrem.coefficient:
            return None
        begin = flank.at_depth(self.flankrem.height)
        at = flank.at(begin)
        lean = at.lean + self.flankrem.angle
        start = (at.x - begin * math.sin(lean), at.z + begin * math.cos(lean))
        piece = PlanePiece("flankrem", start, math.pi / 2 - lean, begin, begin)
        return replace(piece, high=piece.at_depth(self.height))
