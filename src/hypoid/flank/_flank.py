"""A flank answers one question: at axial position z and radius rho, where is the surface?"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any, Literal

import numpy as np
from jaxtyping import Bool, Float, Int

from hypoid.cutter import EdgePiece
from hypoid.geometry import horner, horner_line, on_unit
from hypoid.machine import MachineSettings

from ._active import undercut_floor
from ._chart import Border, Chart, Floor, PitchCone, chart, height_at
from ._envelope import Surface
from ._locate import curvatures, from_cutter, locate, locate_slowly
from ._section import cut_points, roots
from ._status import PointStatus

Array = np.ndarray[Any, Any]
Side = Literal["concave", "convex"]
TOLERANCE = 1e-9  # mm, what Newton may leave
RUNOUT = 2e-2  # mm: last bit of edge before the root land
RUNOUT_TOLERANCE = 1e-6  # mm, what is left there
EDGE = 1e-7  # mm, how far past its own end a piece may be read


@dataclass(frozen=True)
class FlankPoints:
    """Points of a flank in the member's frame, a status beside each (see PointStatus)."""

    position: Float[Array, "n 3"]  # mm; NaN where the status is not OK or OUTSIDE_BLANK
    normal: Float[Array, "n 3"]  # unit, out of the tooth
    status: Int[Array, " n"]
    piece: Int[Array, " n"]  # index into Flank.cut_pieces
    s: Float[Array, " n"]  # edge parameter, mm
    theta: Float[Array, " n"]  # the surface's turn, rad (see Surface)
    other: Bool[Array, " n"]  # made by the meshing condition's other root (undercut)
    flank: Flank

    @property
    def ok(self) -> Array:
        return self.status == PointStatus.OK

    @cached_property
    def _curvature(self) -> Array:
        values = np.full((8, len(self.s)), np.nan)
        for (index, name), (other, surface) in product(
            enumerate(self.flank.cut_pieces), enumerate(roots(self.flank.surface))
        ):
            mine = (self.piece == index) & (self.other == other) & np.isfinite(self.s)
            if mine.any():
                piece = self.flank.pieces[name]
                values[:, mine] = curvatures(surface, piece, self.s[mine], self.theta[mine])
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

    Built by ``cut_flank``. ``toe`` and ``heel`` bound it in cone distance (mm), ``tip`` and
    ``root`` in height above the pitch cone. ``pieces`` run from the blade's tip to its shank.
    """

    member: str
    side: Side
    settings: MachineSettings
    pieces: Mapping[str, EdgePiece]
    surface: Surface
    cone: PitchCone
    mirrored: bool  # a right-hand member
    theta_start: float  # turn that puts the mean point in place, rad
    toe: float
    heel: float
    tip: Border
    root: Border

    @cached_property
    def cut_pieces(self) -> tuple[str, ...]:
        """Pieces that have an angle over (z, rho), from the tooth's tip to its root."""
        return tuple(name for name in reversed(list(self.pieces)) if name != "land")

    @cached_property
    def charts(self) -> Mapping[str, Chart]:
        """Charts of flank and fillet between toe and heel, made on first use."""
        return {
            name: self._chart(self.pieces[name], rooted=name == "fillet", tip=self._tip_of(name))
            for name in self.cut_pieces
        }

    def _chart(
        self,
        piece: EdgePiece,
        *,
        rooted: bool,
        tip: Border | None = None,
        floor: Floor | None = None,
    ) -> Chart:
        ends = self.toe, self.heel, self.theta_start
        return chart(self.surface, piece, self.cone, *ends, rooted, tip, floor)

    def _tip_of(self, name: str) -> Border | None:
        """The tooth's tip, where a piece reaches it."""
        return self.tip if name == self.cut_pieces[0] else None

    @cached_property
    def active_chart(self) -> Chart:
        """Chart of what is left of the flank: all of it, or what undercut leaves; of infinite error if nothing."""
        return self.active_chart_of(self.pieces["flank"])

    def active_chart_of(self, piece: EdgePiece) -> Chart:
        """The same of another form of the flank's piece (without its relief, say)."""
        own = piece is self.pieces["flank"]
        whole = self.charts["flank"] if own else self._chart(piece, rooted=False)
        if np.isfinite(whole.error) or (floor := undercut_floor(self, piece)) is None:
            return whole
        tip = self._tip_of("flank") if own else None
        left = self._chart(piece, rooted=True, tip=tip, floor=floor)
        return left if np.isfinite(left.error) else whole

    @property
    def name(self) -> str:
        return f"{self.member} {self.side}"

    @cached_property
    def hand(self) -> Array:
        """Signs (3,) between the member's own hand and a left-hand one, either way."""
        return np.array([1.0, -1.0 if self.mirrored else 1.0, 1.0])

    def left_angle(self, distance: Any, height: Any) -> Array:
        """Angle about the axis at (S, H), rad in (-pi, pi], read as a left-hand member; shape of S."""
        x, y, _ = (self.at_cone(distance, height).position * self.hand).T
        return np.arctan2(y, x).reshape(np.shape(distance))

    @cached_property
    def cut_away(self) -> tuple[str, ...]:
        """Pieces that fold, or that another piece cuts away somewhere between toe and heel."""
        return tuple(n for n, chart in self.charts.items() if not np.isfinite(chart.error))

    @property
    def generated(self) -> bool:
        """Whether the edge makes the whole flank and fillet with no singular place in between."""
        return not self.cut_away

    def at(self, z: Any, rho: Any) -> FlankPoints:
        """Surface points at axial positions z and radii rho (mm, any shape, taken flat).

        A fillet joins its flank along one edge line; where more than one piece reaches a place
        (undercut), the one that removes most is the tooth (design, section 2).
        """
        z, rho = (a.ravel() for a in np.broadcast_arrays(*(np.asarray(v, float) for v in (z, rho))))
        asked = np.isfinite(z) & np.isfinite(rho)
        z, rho = np.where(asked, z, np.nan), np.where(asked, rho, np.nan)
        distance, height = self.cone.cone_distance_height(z, rho)
        values = np.full((8, len(z)), np.nan)
        status = np.full(len(z), PointStatus.NOT_CONVERGED, dtype=np.int8)
        piece = np.zeros(len(z), dtype=np.int8)
        other = np.zeros(len(z), dtype=bool)

        def ask(index: int, places: Array) -> None:
            if not len(places):
                return
            got, state = self._on_piece(self.cut_pieces[index], z[places], rho[places])
            before = status[places]
            take = (state == PointStatus.SINGULAR) & (before == PointStatus.NOT_CONVERGED)
            take |= (state == PointStatus.OK) & (before != PointStatus.OK)
            both = np.flatnonzero((state == PointStatus.OK) & (before == PointStatus.OK))
            take[both] = self._removes_more(got[:, both], values[:, places[both]])
            if not take.all():
                places, got, state = places[take], got[:, take], state[take]
            values[:, places], status[places], piece[places] = got[:8], state, index

        count = len(self.cut_pieces)
        if self.generated:  # each piece above its lower edge; next to that edge, its neighbour
            owner = np.full(len(z), count - 1)
            for index in range(count - 2, -1, -1):
                low = self.charts[self.cut_pieces[index]].bounds(distance)[0]
                owner[height >= low] = index
            for index in range(count):
                ask(index, np.flatnonzero(asked & (owner == index)))
            for index in range(count - 1):  # below a kink of the edge what lies under it goes on
                high = self.charts[self.cut_pieces[index + 1]].bounds(distance)[1]
                ask(index + 1, np.flatnonzero(asked & (owner == index) & (height < high - EDGE)))
            missed = asked & (status != PointStatus.OK)
            for index in range(count):
                ask(index, np.flatnonzero(missed & (np.abs(owner - index) == 1)))
        else:  # curves turn back and cross: of all that the edge sweeps, what removes most
            values, piece, other = cut_points(self, z, rho)
            status[asked] = PointStatus.SINGULAR
            status[np.isfinite(values[6])] = PointStatus.OK
        failed = np.flatnonzero(status >= PointStatus.SINGULAR)
        values[:, failed] = np.nan
        status[asked & ~self._on_blank(distance, height)] = PointStatus.OUTSIDE_BLANK
        position, normal = self._handed(values)
        return FlankPoints(position, normal, status, piece, values[6], values[7], other, self)

    def at_cutter(self, s: Any, theta: Any, piece: str = "flank") -> tuple[Array, Array]:
        """Points (n, 3) mm and unit normals (n, 3) from edge parameter s (mm) and turn (rad)."""
        return self._handed(from_cutter(self.surface, self.pieces[piece], s, theta))

    def _handed(self, values: Array) -> tuple[Array, Array]:
        """Positions and normals (n, 3) of the member's own hand, from rows of a left-hand one."""
        if self.mirrored:
            values[1] *= -1.0
            values[4] *= -1.0
        return values[:3].T, values[3:6].T

    def _on_blank(self, distance: Array, height: Array) -> Array:
        slack = 1e-6
        inside = (distance >= self.toe - slack) & (distance <= self.heel + slack)
        inside &= height <= self.tip.at(distance) + slack
        return inside & (height >= self.root.at(distance) - slack)

    def parameters(
        self, distance: Any, height: Any, piece: str = "flank"
    ) -> tuple[Array, Array, Array]:
        """Edge parameter s (mm), turn (rad) and angle about the axis (rad) at (S, H), mm.

        On that piece and its extension only; the angle is that of a left-hand member and
        never wraps. NaN where Newton does not arrive.
        """
        distance, height = (np.asarray(v, float).ravel() for v in (distance, height))
        start = self.active_chart if piece == "flank" else self.charts[piece]
        x, y = start.coordinates(distance, height)
        x, y = np.clip(x, -1.0, 1.0), np.clip(y, -1.0, 1.0)
        s, theta, angle, left, _ = height_at(
            self.surface,
            self.pieces[piece],
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
        lowest, *above = (self.charts[name] for name in reversed(self.cut_pieces))
        value = horner(lowest.angle, *lowest.coordinates(distance, height))
        for part in above:
            x, y = part.coordinates(distance, height)
            value = np.where(y >= -1.0, horner(part.angle, x, y), value)
        return value

    def grid(self, rows: int, columns: int) -> tuple[Array, Array]:
        """Cone distances and heights (rows, columns), mm, over the blank: root to tip, toe to heel."""
        distance = np.linspace(self.toe, self.heel, columns)
        share = np.linspace(0.0, 1.0, rows)
        low, high = self.root.at(distance), self.tip.at(distance)
        height = low + np.outer(share, high - low)
        return np.broadcast_to(distance, height.shape), height

    def at_cone(self, distance: Any, height: Any) -> FlankPoints:
        """Surface points at cone distance S and height H above the pitch cone (mm)."""
        return self.at(*self.cone.axial_radial(np.asarray(distance), np.asarray(height)))

    def _on_piece(self, name: str, z: Array, rho: Array) -> tuple[Array, Array]:
        """Rows of values (position, normal, s, theta; left hand) and a status at places (z, rho).

        The quick way only arrives where surface and chart have one sense, so the chart's serves.
        """
        piece, chart = self.pieces[name], self.charts[name]
        args = (self.surface, piece, chart, self.cone)
        sense = np.full(len(z), chart.sense)
        values = locate(*args, z, rho)
        poor = np.flatnonzero(~(values[8] < TOLERANCE))
        if len(poor):
            _, y = chart.coordinates(*self.cone.cone_distance_height(z[poor], rho[poor]))
            poor = poor[np.abs(y) < 1.5]  # elsewhere the piece is not asked for
        if len(poor):
            *slowly, sense[poor] = locate_slowly(*args, z[poor], rho[poor])
            values[:, poor] = slowly
        s, left = values[6], values[8]
        low, high = float(piece.low) - EDGE, float(piece.high) + EDGE
        met, singular = left < TOLERANCE, sense * self._sense < 0.0
        if (
            name == "fillet"
        ):  # where it runs out into the root land, the equations have a double root
            x = on_unit(self.toe, self.heel, self.cone.cone_distance_height(z, rho)[0])
            first = np.asarray(horner_line(chart.first, np.clip(x, -1.0, 1.0)))
            runout = s < first + RUNOUT
            met |= runout & (left < RUNOUT_TOLERANCE)
            low = np.where(runout, first - RUNOUT, first - EDGE)
            singular &= ~runout
        met &= (s >= low) & (s <= high)
        state = np.full(len(z), PointStatus.NOT_CONVERGED, dtype=np.int8)
        state[met] = PointStatus.OK
        state[met & singular] = PointStatus.SINGULAR
        return values, state

    @property
    def _sense(self) -> float:
        """Sign of the (s, theta) -> (z, rho) Jacobian on the sound side of the flank."""
        return float(self.charts["flank"].sense)

    @staticmethod
    def _removes_more(new: Array, old: Array) -> Array:
        """Whether new points lie deeper in the tooth than old ones at the same (z, rho)."""
        return ((new[:3] - old[:3]) * new[3:6]).sum(axis=0) < 0.0
