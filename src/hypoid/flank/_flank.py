"""A flank answers one question: at axial position z and radius rho, where is the surface?"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
from jaxtyping import Float, Int

from ..cutter import EdgePiece
from ..geometry import horner
from ..machine import MachineSettings, generator
from ._chart import Chart, PitchCone, chart, height_at
from ._envelope import Surface
from ._locate import curvatures, from_cutter, locate, locate_slowly, roots_near
from ._status import PointStatus

Array = np.ndarray[Any, Any]
Side = Literal["concave", "convex"]
CUT_PIECES = ("flank", "fillet")  # pieces that have an angle over (z, rho), in order of asking
TOLERANCE = 1e-9  # mm, what Newton may leave
RUNOUT, RUNOUT_TOLERANCE = 2e-2, 1e-6  # mm: last bit of edge before the root land, what is left there
EDGE = 1e-7  # mm, how far past its own end a piece may be read


@dataclass(frozen=True)
class FlankPoints:
    """Points of a flank in the member's frame, a status beside each (see PointStatus)."""

    position: Float[Array, "n 3"]  # mm; NaN where the status is not OK or OUTSIDE_BLANK
    normal: Float[Array, "n 3"]  # unit, out of the tooth
    status: Int[Array, " n"]
    piece: Int[Array, " n"]  # index into CUT_PIECES: 0 flank, 1 fillet
    s: Float[Array, " n"]  # edge parameter, mm
    theta: Float[Array, " n"]  # cutter turn, rad
    flank: Flank

    @property
    def ok(self) -> Array:
        return self.status == PointStatus.OK

    @cached_property
    def _curvature(self) -> Array:
        values = np.full((8, len(self.s)), np.nan)
        for index, name in enumerate(CUT_PIECES):
            mine = (self.piece == index) & np.isfinite(self.s)
            if mine.any():
                piece = self.flank.pieces[name]
                values[:, mine] = curvatures(
                    self.flank.surface, piece, self.s[mine], self.theta[mine]
                )
        if self.flank.mirrored:
            values[[3, 6]] *= -1.0
        return values

    @property
    def principal_curvatures(self) -> Float[Array, "n 2"]:
        """Principal curvatures, 1/mm, the greater first, positive where the tooth is convex."""
        return self._curvature[:2].T

    @property
    def principal_directions(self) -> Float[Array, "n 2 3"]:
        """Unit directions of the two principal curvatures, member's frame."""
        return self._curvature[2:].T.reshape(-1, 2, 3)


@dataclass(frozen=True, eq=False)
class Flank:
    """One flank of a member, from its cutting edge and machine settings.

    Built by ``cut_flank``. ``toe``, ``heel``, ``tip`` and ``root`` bound it in cone distance and
    height above the pitch cone (mm).
    """

    member: str
    side: Side
    settings: MachineSettings
    pieces: Mapping[str, EdgePiece]
    surface: Surface
    cone: PitchCone
    mirrored: bool  # a right-hand member
    theta_start: float  # cutter turn that puts the pitch point in place, rad
    toe: float
    heel: float
    tip: float
    root: float

    @cached_property
    def charts(self) -> Mapping[str, Chart]:
        """Charts of flank and fillet between toe and heel, made on first use."""
        return {
            name: chart(
                self.surface,
                self.pieces[name],
                self.cone,
                self.toe,
                self.heel,
                self.theta_start,
                rooted=name == "fillet",
            )
            for name in CUT_PIECES
        }

    @property
    def name(self) -> str:
        return f"{self.member} {self.side}"

    @property
    def generated(self) -> bool:
        """Whether the edge makes the whole flank and fillet with no singular place in between."""
        return all(np.isfinite(chart.error) for chart in self.charts.values())

    def at(self, z: Any, rho: Any) -> FlankPoints:
        """Surface points at axial positions z and radii rho (mm, any shape, taken flat).

        A fillet joins its flank along one edge line; where more than one piece reaches a place
        (undercut), the one that removes most is the tooth (design, section 2).
        """
        z, rho = (a.ravel() for a in np.broadcast_arrays(*(np.asarray(v, float) for v in (z, rho))))
        n = len(z)
        distance, height = self.cone.cone_distance_height(z, rho)
        slack = 1e-6
        inside = (distance >= self.toe - slack) & (distance <= self.heel + slack)
        inside &= (height <= self.tip + slack) & (height >= self.root - slack)
        values = np.full((8, n), np.nan)
        status = np.full(n, PointStatus.NOT_CONVERGED, dtype=np.int8)
        piece = np.zeros(n, dtype=np.int8)
        asked = np.isfinite(z) & np.isfinite(rho)
        waiting = np.flatnonzero(asked)
        for index, name in enumerate(CUT_PIECES):
            if not len(waiting):
                break
            got, state = self._on_piece(name, z[waiting], rho[waiting])
            better = (state == PointStatus.OK) & (
                (status[waiting] != PointStatus.OK) | self._removes_more(got, values[:, waiting])
            )
            better |= (state == PointStatus.SINGULAR) & (status[waiting] > PointStatus.SINGULAR)
            take = waiting[better]
            values[:, take], status[take], piece[take] = got[:, better], state[better], index
            if self.generated:
                waiting = waiting[status[waiting] != PointStatus.OK]
        values[:, (status == PointStatus.SINGULAR) | (status == PointStatus.NOT_CONVERGED)] = np.nan
        status[~inside & asked] = PointStatus.OUTSIDE_BLANK
        return FlankPoints(
            position=values[:3].T,
            normal=values[3:6].T,
            status=status,
            piece=piece,
            s=values[6],
            theta=values[7],
            flank=self,
        )

    def at_cutter(self, s: Any, theta: Any, piece: str = "flank") -> tuple[Array, Array]:
        """Points (n, 3) mm and unit normals (n, 3) from edge parameter s (mm) and cutter turn (rad)."""
        values = np.array(from_cutter(self.surface, self.pieces[piece], s, theta))
        if self.mirrored:
            values[[1, 4]] *= -1.0
        return values[:3].T, values[3:].T

    def parameters(self, distance: Any, height: Any) -> tuple[Array, Array, Array]:
        """Edge parameter s (mm), cutter turn (rad) and angle about the axis (rad) at (S, H), mm.

        On the flank piece and its extension only; the angle is that of a left-hand member and
        never wraps. NaN where Newton does not arrive.
        """
        distance, height = (np.asarray(v, float).ravel() for v in (distance, height))
        start = self.charts["flank"]
        x, y = start.coordinates(distance, height)
        x, y = np.clip(x, -1.0, 1.0), np.clip(y, -1.0, 1.0)
        s, theta, angle, left, _ = height_at(
            self.surface,
            self.pieces["flank"],
            self.cone,
            distance,
            height,
            horner(start.s, x, y),
            horner(start.theta, x, y),
        )
        missed = ~(left < TOLERANCE)
        return tuple(np.where(missed, np.nan, v) for v in (s, theta, angle))  # pyright: ignore

    def chart_angle(self, distance: Array, height: Array) -> Array:
        """Angle about the axis (rad, left hand) at (S, H), mm, read from the charts of flank and fillet.

        Quick and without compilation; as good as the charts' own ``error``.
        """
        fillet, flank = self.charts["fillet"], self.charts["flank"]
        x, y = fillet.coordinates(distance, height)
        u, v = flank.coordinates(distance, height)
        return np.where(y <= 1.0, horner(fillet.angle, x, y), horner(flank.angle, u, v))

    def grid(self, rows: int, columns: int) -> tuple[Array, Array]:
        """Cone distances (columns,) and heights (rows,) that span the blank, toe to heel, root to tip."""
        return np.linspace(self.toe, self.heel, columns), np.linspace(self.root, self.tip, rows)

    def at_cone(self, distance: Any, height: Any) -> FlankPoints:
        """Surface points at cone distance S and height H above the pitch cone (mm)."""
        return self.at(*self.cone.axial_radial(np.asarray(distance), np.asarray(height)))

    def _on_piece(self, name: str, z: Array, rho: Array) -> tuple[Array, Array]:
        piece, chart = self.pieces[name], self.charts[name]
        values = np.array(locate(self.surface, piece, chart, self.cone, z, rho))
        poor = ~(values[8] < TOLERANCE)
        distance, height = self.cone.cone_distance_height(z, rho)
        _, y = chart.coordinates(distance, height)
        poor &= np.abs(np.asarray(y)) < 1.5  # elsewhere the piece is not asked for
        if poor.any():
            values[:, poor] = locate_slowly(
                self.surface, piece, chart, self.cone, z[poor], rho[poor]
            )
        s, left, sense = values[6], values[8], values[9]
        # Where the fillet runs out into the root land, the equations have a double root.
        runout = s < float(piece.low) + RUNOUT if name == "fillet" else np.zeros(len(s), bool)
        met = left < np.where(runout, RUNOUT_TOLERANCE, TOLERANCE)
        own = (s >= float(piece.low) - np.where(runout, RUNOUT, EDGE)) & (s <= float(piece.high) + EDGE)
        state = np.full(len(z), PointStatus.NOT_CONVERGED, dtype=np.int8)
        state[met & own] = PointStatus.OK
        state[met & own & (sense * self._sense < 0.0) & ~runout] = PointStatus.SINGULAR
        if self.mirrored:
            values[[1, 4]] *= -1.0
        return values[:8], state

    @cached_property
    def _sense(self) -> float:
        """Sign of the (s, theta) -> (z, rho) Jacobian on the sound side of the flank."""
        z, rho = self.cone.axial_radial(0.5 * (self.toe + self.heel), 0.0)
        one = np.ones(1)
        args = (self.surface, self.pieces["flank"], self.charts["flank"], self.cone)
        return float(np.sign(locate(*args, z * one, rho * one)[9][0]))

    @staticmethod
    def _removes_more(new: Array, old: Array) -> Array:
        """Whether new points lie deeper in the tooth than old ones at the same (z, rho)."""
        return ((new[:3] - old[:3]) * new[3:6]).sum(axis=0) < 0.0


def cut_flank(
    member: str,
    side: Side,
    settings: MachineSettings,
    pieces: Mapping[str, EdgePiece],
    cone: PitchCone,
    *,
    mirrored: bool,
    theta_start: float,
    toe: float,
    heel: float,
    tip: float,
    root: float,
) -> Flank:
    """The flank that an edge cuts under given settings; of the two meshing roots the nearer to phi = 0."""
    gen = generator(settings)
    plain = settings.constant_motion
    zero, start = np.zeros(1), np.full(1, theta_start)
    found: list[tuple[float, Surface]] = []
    for branch in (1.0, -1.0):
        surface = Surface(gen, branch, 1.0, plain)
        phi, _, *normal = roots_near(surface, pieces["flank"], zero, start)
        # A left-hand member turns its concave flanks to -y at the pitch point, convex ones to +y.
        wanted = -1.0 if side == "concave" else 1.0
        outward = float(np.sign(normal[1][0]) * wanted)
        found.append((abs(float(phi[0])), Surface(gen, branch, outward, plain)))
    surface = min(found, key=lambda item: item[0])[1]
    return Flank(
        member, side, settings, pieces, surface, cone, mirrored, theta_start, toe, heel, tip, root
    )
