"""Nominal measuring grids: points and normals of both flanks of a tooth, its thickness and pitch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from hypoid.flank import SIDES, Flank, FlankPoints, PointStatus, Side, best_way
from hypoid.geometry import DesignError, Problem
from hypoid.pair import Member

from ._cutting import Cutting, angles_of, cutting

Array = np.ndarray[Any, Any]
LEAST, MOST = 3, 45  # rows and columns of a grid


@dataclass(frozen=True)
class Borders:
    """What a grid leaves free, in per cent: of the face width at toe and heel, of the depth at root and tip."""

    toe: float = 10.0
    heel: float = 10.0
    root: float = 30.0  # below 15 to 20 % of the depth lies the fillet (notes on lin1996)
    tip: float = 10.0


@dataclass(frozen=True)
class PointGroup:
    """Points of a grid that one edge piece cuts: indices, cutter's turn and cradle angle."""

    cut: Cutting
    index: Array  # (k,) into the flat grid
    theta: Array  # (k,) rad
    phi: Array  # (k,) rad


@dataclass(frozen=True, eq=False)
class FlankNodes:
    """Nominal points of one flank, n = rows x columns, row after row: root to tip, toe to heel.

    ``points`` are the flank's own; ``position`` and ``normal`` stand where the flank bounds the grid's tooth.
    """

    flank: Flank
    shape: tuple[int, int]
    turn: float  # rad about the axis, from the flank's own place to the tooth's; left hand
    distance: Array  # (rows, columns) S, mm
    height: Array  # (rows, columns) H, mm
    points: FlankPoints

    @property
    def side(self) -> Side:
        return self.flank.side

    @property
    def reference(self) -> tuple[int, int]:
        """Row and column of the reference point: the grid's middle."""
        return self.shape[0] // 2, self.shape[1] // 2

    @cached_property
    def own(self) -> tuple[Array, Array]:
        """Points and normals (n, 3) in the flank's own place, left hand."""
        return self.points.position * self.flank.hand, self.points.normal * self.flank.hand

    @cached_property
    def position(self) -> Array:
        """Points (n, 3), mm, member's frame and hand."""
        return self.placed(self.own[0])

    @cached_property
    def normal(self) -> Array:
        """Unit normals (n, 3) out of the tooth, member's frame and hand."""
        return self.placed(self.own[1])

    def placed(self, vectors: Array) -> Array:
        """Vectors (..., 3) of the flank's own place, left hand, in the member's frame and hand."""
        return turned(vectors, self.turn) * self.flank.hand

    def taken_back(self, vectors: Array) -> Array:
        """Inverse of ``placed``."""
        return turned(vectors * self.flank.hand, -self.turn)

    @cached_property
    def lever(self) -> Array:
        """(n,) mm: normal distance per rad of a turn of the part, left hand."""
        (x, y, _), (nx, ny, _) = (v.T for v in self.own)
        return x * ny - y * nx

    @cached_property
    def radius(self) -> float:
        """Radius of the reference point, mm."""
        row, column = self.reference
        x, y, _ = self.own[0][row * self.shape[1] + column]
        return float(np.hypot(x, y))

    @cached_property
    def there(self) -> Array:
        """(n,) bool: points that the flank has."""
        return (self.points.status == PointStatus.OK) & ~self.points.other

    @cached_property
    def on_fillet(self) -> Array:
        """(n,) bool: points that the edge arc cuts, not the flank."""
        names = self.flank.cut_pieces
        return np.array([names[k] == "fillet" for k in self.points.piece]) & self.there

    @cached_property
    def groups(self) -> tuple[PointGroup, ...]:
        """The grid's points by the edge piece that cuts them."""
        made: list[PointGroup] = []
        for k, name in enumerate(self.flank.cut_pieces):
            mine = np.flatnonzero(self.there & (self.points.piece == k))
            if len(mine):
                surface = self.flank.surface
                cut = cutting(self.flank.settings, self.flank.pieces[name], surface, surface.way)
                s, turn = self.points.s[mine], self.points.theta[mine]
                made.append(PointGroup(cut, mine, *angles_of(cut, s, turn)))
        return tuple(made)

    def name(self, row: int, column: int) -> str:
        """A point's name as shops write it: column A, B ... from the toe, row 1, 2 ... from the root."""
        letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
        first = "" if column < 26 else letters[column // 26 - 1]
        return f"{first}{letters[column % 26]}{row + 1}"


@dataclass(frozen=True, eq=False)
class MeasuringGrid:
    """A member's nominal grid: both flanks of one tooth."""

    member: Member
    rows: int
    columns: int
    borders: Borders
    flanks: Mapping[Side, FlankNodes]

    @property
    def pitch(self) -> float:
        """Angular pitch, rad."""
        return self.member.tooth.pitch

    @cached_property
    def thickness(self) -> float:
        """Transverse tooth thickness at the mean point, mm, along the arc about the axis."""
        blank = self.member.blank
        return float(self.member.tooth.thickness([blank.mean_cone_distance])[0])

    @property
    def reference(self) -> tuple[int, int]:
        return self.rows // 2, self.columns // 2

    @property
    def faults(self) -> tuple[str, ...]:
        """Points that cannot be measured as a flank, in words."""
        words: list[str] = []
        for nodes in self.flanks.values():
            missing, fillet = int((~nodes.there).sum()), int(nodes.on_fillet.sum())
            if missing:
                words.append(
                    f"{nodes.flank.name}: {missing} of {nodes.there.size} points are not on the flank; "
                    "leave wider borders at root or tip."
                )
            if fillet:
                words.append(
                    f"{nodes.flank.name}: {fillet} points lie on the fillet; leave a wider border at the root."
                )
        return tuple(words)


def turned(vectors: Array, angle: Any) -> Array:
    """Vectors (..., 3) turned about the axis by an angle, rad."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = np.moveaxis(vectors, -1, 0)
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)


def measuring_grid(
    member: Member, rows: int = 5, columns: int = 9, borders: Borders | None = None
) -> MeasuringGrid:
    """Nominal grid of a member, columns toe to heel and rows root to tip, evenly between the borders.

    Raises
    ------
    DesignError
        For fewer than 3 or more than 45 rows or columns, and borders that leave nothing.
    """
    free = borders or Borders()
    _check(rows, columns, free)
    shift = {"concave": 0.0, "convex": member.tooth.convex_turn}
    flanks: dict[Side, FlankNodes] = {
        side: _nodes(member.flank(side), rows, columns, free, shift[side]) for side in SIDES
    }
    return MeasuringGrid(member, rows, columns, free, flanks)


def _nodes(flank: Flank, rows: int, columns: int, free: Borders, turn: float) -> FlankNodes:
    width = flank.heel - flank.toe
    distance = np.linspace(
        flank.toe + 0.01 * free.toe * width, flank.heel - 0.01 * free.heel * width, columns
    )
    low, high = flank.root.at(distance), flank.tip.at(distance)
    share = np.linspace(0.01 * free.root, 1.0 - 0.01 * free.tip, rows)
    height = low + np.outer(share, high - low)
    distance = np.broadcast_to(distance, height.shape)
    points = flank.at_cone(distance.ravel(), height.ravel())
    return FlankNodes(flank, (rows, columns), turn, distance, height, points)


def _check(rows: int, columns: int, free: Borders) -> None:
    found = [
        Problem(f"--{name}", str(count), f"from {LEAST} to {MOST}", f"--{name} {example}")
        for name, count, example in (("rows", rows, 5), ("columns", columns, 9))
        if not LEAST <= count <= MOST
    ]
    for name in ("toe", "heel", "root", "tip"):
        value = getattr(free, name)
        if not 0.0 <= value < 100.0:
            expected = "a share from 0 to below 100 per cent"
            found.append(Problem(f"--{name}", f"{value:g}", expected, f"--{name} 10"))
    for first, last, of in (("toe", "heel", "face"), ("root", "tip", "depth")):
        if not getattr(free, first) + getattr(free, last) < 95.0 and not found:
            given = f"{getattr(free, first):g} and {getattr(free, last):g} per cent"
            expected = f"borders that leave at least 5 per cent of the {of}"
            found.append(Problem(f"--{first}, --{last}", given, expected, "--toe 10 --heel 10"))
    if found:
        raise DesignError(found)


def way_of(flank: Flank, settings: Any) -> Any:
    """How the meshing condition of a flank under other settings is met."""
    return best_way(settings, not flank.settings.roll_to_blade_ratio)
