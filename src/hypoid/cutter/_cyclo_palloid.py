"""Two-part face-hob head (Cyclo-Palloid): outer and inner blades turn about two parallel axes.

The axes stand apart along the blades' front plane as it passes the pitch point. Then each part is
a Cyclo-Cut head of its own radius and slope angle: r' cos(nu') = r cos(nu) + e and r' sin(nu') =
r sin(nu). The second keeps the module and, as the instant centre of cutter and crown gear stays on
the front plane, the spiral and the pressure angle at the pitch point; only the lengthwise curvature
changes. With no eccentricity it is the Cyclo-Cut head itself.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, replace

from hypoid.geometry import DesignError, Problem

from ._edge import EdgePiece
from ._face_hob import FaceHobHead
from ._mill_faults import round_down, round_up
from ._profile import BladeName


@dataclass(frozen=True)
class PartSetting:
    """Where the axis of one part stands on the cradle, and the turn that its blades need there."""

    radial_distance: float  # mm
    cradle_angle: float  # rad
    turn: float  # for the part's pieces, about their own axis, rad


@dataclass(frozen=True)
class CycloPalloidHead:
    """Two-part face-hob head: a Cyclo-Cut head whose parts are set apart (mm).

    ``head`` says how both parts stand on one axis. A positive eccentricity crowns: the outer blades'
    axis moves away from the pitch point by its share of it, the inner blades' towards it by the rest.
    """

    head: FaceHobHead
    eccentricity: float  # between both axes
    outer_share: float = 0.5  # of it that moves the outer part, 0 to 1

    def offset(self, name: BladeName) -> float:
        """How far a part's axis moves away from the pitch point, along the front plane, mm."""
        share = self.outer_share if name == "outer" else self.outer_share - 1.0
        return share * self.eccentricity

    def part(self, name: BladeName) -> FaceHobHead:
        """The Cyclo-Cut head that a part is for its own blades, about its own axis."""
        offset, head = self.offset(name), self.head
        if not offset:
            return head
        along = head.radius * math.cos(head.slope_angle) + offset
        base = head.radius * math.sin(head.slope_angle)
        return replace(head, radius=math.hypot(along, base), slope_angle=math.atan2(base, along))

    def shift(self, name: BladeName) -> tuple[float, float]:
        """Shift (x, y) of a part's axis, mm, in the cutter frame when its blade passes P on the x axis.

        It does not turn with the cutter: it is one of the machine's settings.
        """
        offset, slope = self.offset(name), self.head.slope_angle
        return -offset * math.cos(slope), offset * math.sin(slope)

    def pieces(self, name: BladeName) -> dict[str, EdgePiece]:
        """Edge pieces of a part's blade, by name, in a cutter frame about that part's own axis (mm).

        Its axes are parallel to those of ``head``, and its blade passes P at the same turn of the
        cutter: these pieces moved by ``shift`` meet those of ``head`` at P, in one front plane.
        DesignError if the head has faults.
        """
        part = self.checked().part(name)
        turn = part.slope_angle - self.head.slope_angle
        pieces = part.pieces(name)
        return {key: piece.turned(turn) for key, piece in pieces.items()} if turn else pieces

    def setting(
        self, name: BladeName, radial_distance: float, cradle_angle: float, turn: float
    ) -> PartSetting:
        """Setting of a part from that of ``head`` (mm, rad), whose pieces are turned by ``turn``.

        For a head without tilt and swivel, its centre at (S_r cos(q), -S_r sin(q)) on the cradle.
        """
        if not self.offset(name):
            return PartSetting(radial_distance, cradle_angle, turn)
        shift = complex(*self.shift(name)) * cmath.exp(1j * turn)
        centre = (shift - 1j * radial_distance) * cmath.exp(1j * (math.pi / 2 - cradle_angle))
        moved = cradle_angle - cmath.phase(centre * cmath.exp(1j * cradle_angle))
        return PartSetting(abs(centre), moved, turn + moved - cradle_angle)

    def crowning(self, distance: float, spiral_angle: float) -> float:
        """Lengthwise relative curvature, 1/mm, of two mating flanks cut by such heads, at the pitch point.

        In the pitch plane of their crown gear, P at that distance from its axis, mm; positive where
        they part towards toe and heel.
        """
        inner, outer = (
            1.0 / lengthwise_radius(part.radius, part.slope_angle, distance, spiral_angle)
            for part in (self.part("inner"), self.part("outer"))
        )
        return inner - outer

    def faults(self, path: str = "cutter") -> list[Problem]:
        """Every fault of how the parts are set apart; ``path`` begins each path."""
        problems: list[Problem] = []
        if not 0.0 <= self.outer_share <= 1.0:
            given, example = f"{self.outer_share:g}", "outer_share = 0.5"
            where = f"{path}.outer_share"
            problems.append(Problem(where, given, "a share between 0 and 1", example))
            return problems
        head, amount = self.head, self.eccentricity
        room = head.radius * math.cos(head.slope_angle)
        reach = [  # of each blade towards its axis, tip and shank
            -min(piece.at(s).x for piece in head.outer.profile for s in (piece.low, piece.high)),
            max(piece.at(s).x for piece in head.inner.profile for s in (piece.low, piece.high)),
        ]
        share = self.outer_share
        least = -(room - reach[0]) / share if share else -math.inf
        most = (room - reach[1]) / (1.0 - share) if share < 1.0 else math.inf
        least, most = max(least, -room), min(most, room)
        if not least < amount < most:
            problems.append(
                Problem(
                    f"{path}.eccentricity",
                    f"{amount:g} mm",
                    f"above {round_up(least):g} and below {round_down(most):g} mm: "
                    "both blades then keep clear of their axes",
                    'eccentricity = "2 mm"',
                )
            )
        return problems

    def checked(self, path: str = "cutter") -> CycloPalloidHead:
        """The head itself; DesignError with all its faults if it has any."""
        if problems := self.faults(path):
            raise DesignError(problems)
        return self


def lengthwise_radius(
    radius: float, slope_angle: float, distance: float, spiral_angle: float
) -> float:
    """Radius of curvature of a face-hobbed tooth trace at P, in the pitch plane of its crown gear, mm.

    By Euler and Savary: with k = r sin(nu)/(R cos(beta)) = z0/z_crown and p from P to the instant
    centre, rho = p**2 (1 + k)/(r cos(nu) + k p); a face mill (k = 0) has rho = r. The same as
    ISO 23509 by other means.
    """
    along, across = radius * math.cos(slope_angle), radius * math.sin(slope_angle)
    k = across / (distance * math.cos(spiral_angle))
    p = (along + k * distance * math.sin(spiral_angle)) / (1.0 + k)
    return p * p * (1.0 + k) / (along + k * p)
