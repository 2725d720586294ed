"""A blade's profile in its own plane: pieces from the tip to the shank, and their place in a head.

Coordinates of the plane: x towards the metal that the blade removes, z towards its tip. Face-hob and
face-mill blades are both written in it; a head only says where the plane stands.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, NamedTuple

from ._edge import EdgePiece

BladeName = Literal["outer", "inner"]


class PlanePoint(NamedTuple):
    """Where a piece stands at one s, and how it goes on from there."""

    x: float  # mm
    z: float  # mm
    lean: float  # angle between the edge and the z axis, positive towards the metal, rad
    speed: float  # length of edge per s
    bend: float  # change of lean per s, rad/mm


@dataclass(frozen=True)
class PlanePiece:
    """A piece of a blade's profile in its plane (x to the metal, z to the tip); mm, rad.

    The form is that of ``EdgePiece``.
    """

    name: str
    start: tuple[float, float]
    dip: float  # angle of the tangent below the x axis at s = 0
    low: float
    high: float
    curvature: float = 0.0
    parabola: float = 0.0
    relief: float = 0.0
    relief_from: float = 0.0

    def at(self, s: float) -> PlanePoint:
        """The piece, or its continuation, at s (mm)."""
        turn, beyond = self.curvature * s, max(s - self.relief_from, 0.0)
        along, rise = s, 0.0
        if self.curvature:
            along = math.sin(turn) / self.curvature
            rise = 2.0 * math.sin(0.5 * turn) ** 2 / self.curvature
        rise += self.parabola * s * s + self.relief * beyond * beyond
        along_s, along_ss = math.cos(turn), -self.curvature * math.sin(turn)
        rise_s = math.sin(turn) + 2.0 * (self.parabola * s + self.relief * beyond)
        rise_ss = self.curvature * math.cos(turn) + 2.0 * self.parabola
        rise_ss += 2.0 * self.relief if beyond > 0.0 else 0.0
        square = along_s * along_s + rise_s * rise_s
        cosine, sine = math.cos(self.dip), math.sin(self.dip)
        return PlanePoint(
            self.start[0] + along * cosine + rise * sine,
            self.start[1] - along * sine + rise * cosine,
            math.pi / 2 - self.dip + math.atan2(rise_s, along_s),
            math.sqrt(square),
            (along_s * rise_ss - rise_s * along_ss) / square,
        )

    def at_depth(self, depth: float, radius: float = 0.0) -> float:
        """The s at a depth below z = 0, or where an arc of that radius, its top there, is tangent; mm.

        Newton from the tangent at s = 0; NaN where it does not arrive.
        """
        at = self.at(0.0)
        s = (depth + radius * (1.0 - math.sin(at.lean)) + at.z) / math.cos(at.lean)
        for _ in range(50):
            if not math.isfinite(s):
                break
            at = self.at(s)
            left = at.z + depth + radius * (1.0 - math.sin(at.lean))
            step = left / (math.cos(at.lean) * (at.speed + radius * at.bend))
            s += step
            if abs(step) <= 1e-12 * (1.0 + abs(s)):
                return s
        return math.nan


def land_piece(tip: tuple[float, float], width: float) -> PlanePiece:
    """Flat at the blade's tip, of that width, ending where the edge arc (or the flank) begins."""
    return PlanePiece("land", tip, 0.0, -width, 0.0)


def fillet_piece(tip: tuple[float, float], radius: float, lean: float) -> PlanePiece:
    """Edge arc from the flat, which it leaves at ``tip``, to an edge that leans by ``lean``."""
    high = radius * (math.pi / 2 - lean)
    return PlanePiece("fillet", tip, 0.0, 0.0, high, curvature=-1.0 / radius)


def placed(
    profile: Iterable[PlanePiece],
    radius: float,
    across: tuple[float, float],
    *,
    lean: tuple[float, float] = (0.0, 0.0),
    level: float = 0.0,
) -> dict[str, EdgePiece]:
    """Edge pieces in the cutter frame, by name, in the profile's order.

    The profile's point (0, level) stands on the x axis at ``radius`` (mm). ``across`` and ``lean``
    are what 1 mm along the profile's x and z moves in the cutter's x-y plane; its z is the cutter's.
    A unit ``across`` with no lean is a plane along the cutter axis. Else the profile is the projection
    of an edge in a raked plane: s stays the projection's, and tangent and metal carry the rake.
    """

    def turned(x: float, z: float) -> tuple[float, float, float]:
        return (x * across[0] + z * lean[0], x * across[1] + z * lean[1], z)

    pieces: dict[str, EdgePiece] = {}
    for plane in profile:
        cosine, sine = math.cos(plane.dip), math.sin(plane.dip)
        x, y, _ = turned(plane.start[0], plane.start[1] - level)
        pieces[plane.name] = EdgePiece(
            start=(radius + x, y, plane.start[1]),  # pyright: ignore[reportArgumentType]
            tangent=turned(cosine, -sine),  # pyright: ignore[reportArgumentType]
            metal=turned(sine, cosine),  # pyright: ignore[reportArgumentType]
            curvature=plane.curvature,
            parabola=plane.parabola,
            relief=plane.relief,
            relief_from=plane.relief_from,
            low=plane.low,
            high=plane.high,
        )
    return pieces
