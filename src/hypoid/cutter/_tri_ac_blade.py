"""Stick blade of a Tri-Ac face-hob head: its profile by the measures of the 2005 paper.

Lengths and angles are those of the edge's projection on a plane that holds the direction of the cutter
axis and cuts across the tooth, but the blade angle, which is ground in the tool plane, tilted by the
hook and the side rake.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from ._mill_blade import CircularProfile, MillBlade, Toprem
from ._profile import BladeName, PlanePiece

TopremReading = Literal["along-flank", "axial", "straight-part"]


@dataclass(frozen=True)
class BladeToprem:
    """Straight edge at the blade's tip by its length L_T and its angle tau to the flank (mm, rad).

    The length has three readings (notes of 2005, item 5): along the edge from the tip line, edge
    extended, to the kink; the height of the kink over that line; or the straight part between edge
    arc and kink alone. They part by 3-30 um at the tip.
    """

    length: float  # L_T
    angle: float  # tau, positive removes more
    measured: TopremReading = "along-flank"


@dataclass(frozen=True)
class TriAcBlade:
    """One blade of a Tri-Ac head: flat, edge arc, Toprem and straight or curved edge (mm, rad).

    Either blade of the usual head has positive measures only [vimercati2005, Figs. 2-4].
    """

    name: BladeName
    radius: float  # r_b: of the pitch point P about the cutter axis
    blade_angle: float  # alpha_e: of the edge at P, in the tool plane
    height: float  # h_f: from P to the tip, along the cutter axis
    edge_radius: float  # r_e; 0: a sharp corner
    shank_height: float  # from P to the end of the edge at the shank, along the axis
    eccentric_angle: float = 0.0  # eps_b: turn of the blade about P, the slope angle of other heads
    hook_angle: float = 0.0  # Gamma_b, positive leads with the tip
    rake_angle: float = 0.0  # kappa_e, side rake
    curve_radius: float = 0.0  # rho_t, positive crowns the tooth; 0 or infinite: a straight edge
    toprem: BladeToprem | None = None
    land: float | None = None  # width of the flat at the tip; None: half the head's slot

    @property
    def bend(self) -> float:
        """Curvature of the edge, 1/mm."""
        return 1.0 / self.curve_radius if self.curve_radius else 0.0

    @property
    def profile_angle(self) -> float:
        """alpha_t: angle of the edge at P in the projection, rad (notes of 2005, item 6)."""
        tangent = math.tan(self.blade_angle)
        twist = tangent * math.tan(self.rake_angle) * math.sin(self.hook_angle)
        return math.atan2(tangent, math.cos(self.hook_angle) + twist)

    @property
    def rake_plane(self) -> tuple[float, float]:
        """What 1 mm across towards the metal, and 1 mm to the tip, moves a point along y_t, mm.

        y_t = -+x_t tan(kappa_e)/cos(Gamma_b) - z_t tan(Gamma_b) (notes of 2005, item 6).
        """
        hook = self.hook_angle
        return -math.tan(self.rake_angle) / math.cos(hook), -math.tan(hook)

    @property
    def kink_angle(self) -> float:
        """delta: lean of the flank where Toprem, else the edge arc, meets it, rad; NaN if it does not.

        Each reading of L_T is linear in the sine and cosine of delta (notes of 2005, item 5).
        """
        toprem = self.toprem or BladeToprem(0.0, 0.0, "straight-part")
        length, radius = toprem.length, self.edge_radius
        sine, cosine = math.sin(toprem.angle), math.cos(toprem.angle)
        # height of the kink: a constant, a part with sin(delta) and one with cos(delta)
        constant, with_sine, with_cosine = length, 0.0, 0.0
        if toprem.measured != "axial":
            constant, with_sine, with_cosine = 0.0, length * sine, length * cosine
        if toprem.measured == "straight-part":
            constant += radius
            with_sine -= radius * cosine
            with_cosine += radius * sine
        across, along = 1.0 - self.bend * with_sine, self.bend * with_cosine
        share = math.sin(self.profile_angle) + self.bend * (constant - self.height)
        share /= math.hypot(across, along)
        return math.asin(share) + math.atan2(along, across) if abs(share) < 1.0 else math.nan

    @property
    def arc_height(self) -> float:
        """Height of the edge arc over the tips, mm."""
        angle = self.toprem.angle if self.toprem else 0.0
        return self.edge_radius * (1.0 - math.sin(self.kink_angle - angle))

    @property
    def flank_start(self) -> float:
        """H: height over the tips, mm, at which the flank begins: Toprem's kink, or the edge arc's end."""
        if self.toprem is None:
            return self.arc_height
        length = self.toprem.length
        if self.toprem.measured == "axial":
            return length
        height = length * math.cos(self.kink_angle - self.toprem.angle)
        return height + (self.arc_height if self.toprem.measured == "straight-part" else 0.0)

    @property
    def projection(self) -> MillBlade:
        """The same edge by heights: a blade of a plane profile, its sharp corner on the tangent at P."""
        return MillBlade(
            self.name,
            point_radius=self.radius,
            angle=self.profile_angle,
            edge_radius=self.edge_radius,
            land=0.0,
            height=self.height + self.shank_height,
            profile=CircularProfile(self.curve_radius or math.inf, self.height),
            toprem=Toprem(self.toprem.angle, self.flank_start) if self.toprem else None,
        )

    def outline(self, land: float) -> tuple[PlanePiece, ...]:
        """Flat of that width, edge arc, Toprem and flank: x off P towards the metal, z = 0 at the tip, mm.

        The flank's s counts from P along the projection [vimercati2005, (2); notes, item 5].
        """
        corner = self.height * math.tan(self.profile_angle)
        flat, *edge = (
            replace(piece, start=(piece.start[0] - corner, piece.start[1]))
            for piece in self.projection.outline
        )
        return (replace(flat, low=-land), *edge)

    @property
    def tip(self) -> float:
        """Where the flat ends and the edge begins: x off P, negative, as the metal lies the other way, mm."""
        return self.outline(0.0)[0].start[0]
