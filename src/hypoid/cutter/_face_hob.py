"""Face-hob head with inner and outer blades whose front planes carry no rake (Cyclo-Cut).

Frame of the cutter: z along its axis, positive to the blade tips, z = 0 in the pitch plane; the
pitch point of an outer blade lies on the x axis at the cutter radius [gonzalez2022, Fig. A.15].
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hypoid.geometry import DesignError, Problem

from ._edge import EdgePiece
from ._profile import BladeName, PlanePiece, fillet_piece, land_piece, placed


@dataclass(frozen=True)
class BladeRelief:
    """Parabola that lifts the blade off the tooth's tip: c (s - b)**2 along the edge from s = b on."""

    coefficient: float  # 1/mm
    start: float  # b: distance along the edge from the pitch point towards the shank, mm


@dataclass(frozen=True)
class Blade:
    """One blade of a face-hob head: flat land, edge arc, straight edge with relief (mm, rad)."""

    name: BladeName
    pressure_angle: float
    reference_height: float  # h_r: pitch point to blade tip
    edge_radius: float  # r_t
    shank_height: float  # height of the edge beyond the pitch point, towards the shank
    land: float  # width of the flat at the tip
    relief: BladeRelief | None = None

    @property
    def arc_height(self) -> float:
        """Height above the pitch point where the edge arc begins, mm (notes of 2022, item 9)."""
        return self.reference_height - self.edge_radius * (1.0 - math.sin(self.pressure_angle))

    @property
    def profile(self) -> tuple[PlanePiece, ...]:
        """Land, edge arc and flank in the front plane: x off the pitch point towards the metal, z to the tip."""
        cosine = math.cos(self.pressure_angle)
        arc_start_x = -self.arc_height * math.tan(self.pressure_angle) - self.edge_radius * cosine
        tip = (arc_start_x, self.reference_height)
        relief = self.relief or BladeRelief(0.0, math.inf)
        return (
            land_piece(tip, self.land),
            fillet_piece(tip, self.edge_radius, self.pressure_angle),
            PlanePiece(
                "flank",
                (0.0, 0.0),
                math.pi / 2 - self.pressure_angle,
                -self.arc_height / cosine,
                self.shank_height / cosine,
                relief=relief.coefficient,
                relief_from=min(relief.start, 1e3),
            ),
        )


@dataclass(frozen=True)
class FaceHobHead:
    """Face-hob head: its radius, blade groups, slope angle and its two blades (mm, rad)."""

    radius: float  # r_c0
    blade_groups: int  # z_0
    slope_angle: float  # nu
    outer: Blade
    inner: Blade

    def pieces(self, name: BladeName) -> dict[str, EdgePiece]:
        """Edge pieces of a blade in the cutter frame, by name; the inner blade follows by pi/z0.

        The front plane holds the cutter axis' direction and passes at r_b = r_c0 sin(nu) from that
        axis [gonzalez2022, (A.1)]; inner and outer blades share one zero of the cutter's turn, or
        the tooth thickness would be wrong (notes of 2022, item 6).
        """
        blade = self.outer if name == "outer" else self.inner
        side = 1.0 if name == "outer" else -1.0
        across = (math.cos(self.slope_angle) * side, -math.sin(self.slope_angle) * side)
        pieces = placed(blade.profile, self.radius, across)
        phase = 0.0 if name == "outer" else -math.pi / self.blade_groups
        return {key: piece.turned(phase) for key, piece in pieces.items()}


def slope_angle(blade_module: float, blade_groups: int, radius: float) -> float:
    """Slope angle nu of a face-hob blade, rad [gonzalez2022, (7) and (A.1)]."""
    ratio = blade_module * blade_groups / (2.0 * radius)
    if not ratio < 1.0:
        raise DesignError(
            [
                Problem(
                    "cutting.cutter_radius",
                    f"{radius:g} mm with {blade_groups} blade groups of module {blade_module:.4g} mm",
                    f"a cutter radius above m_b z0/2 = {blade_module * blade_groups / 2:.4g} mm",
                    'cutter_radius = "100 mm"',
                )
            ]
        )
    return math.asin(ratio)
