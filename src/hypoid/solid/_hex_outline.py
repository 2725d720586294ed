"""Outline of a tooth by sections S = const: where the nodes of flanks, fillets, slot bottom and top land stand.

Angles are a left-hand member's, as in `ToothGrid`. Stations share the arc length of fillet and flank, so an
element has its middle nodes where they belong; every point of flank and fillet is asked from the exact surface.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.flank import Flank, PitchCone, Side, Tooth, ToothGrid
from hypoid.geometry import DesignError, Problem

from ._hex_layout import Root

Array = np.ndarray[Any, Any]
GRADE = 1.5  # elements over which the fillet's size goes over into the flank's
THROUGH = 6.0  # thickness of an element in a tooth's middle to one at its flanks


@dataclass(frozen=True)
class Line:
    """Nodes along a line of every section, corner and middle nodes in turn: (sections, nodes)."""

    z: Array
    rho: Array
    angle: Array

    def __getitem__(self, key: Any) -> Line:
        return Line(self.z[:, key], self.rho[:, key], self.angle[:, key])


def has_fillet(flank: Flank) -> bool:
    return flank.cut_pieces[-1] == "fillet"


def stations(root: Root, rows: int) -> tuple[Array, Array]:
    """Shares of the fillet's length and of the flank's, middle nodes included; `rows` on the tower."""
    fillet = np.linspace(0.0, 1.0, 2 * root.fillet + 1)
    count = rows - root.upper
    size = 1.0 - 0.4 * np.exp(-np.arange(count) / GRADE)
    return fillet, with_middles(np.append(0.0, np.cumsum(size)) / size.sum())


def with_middles(values: Array) -> Array:
    """Values (..., n) and their means in between (..., 2 n - 1)."""
    made = np.repeat(values, 2, axis=-1)[..., :-1].astype(float)
    made[..., 1::2] = 0.5 * (values[..., 1:] + values[..., :-1])
    return made


def through_shares(count: int) -> Array:
    """Shares (count + 1,) of the tooth's thickness, thin at both flanks."""
    depth = np.minimum(np.arange(count), np.arange(count)[::-1]) / max(0.5 * (count - 1), 1.0)
    size = THROUGH**depth
    return np.append(0.0, np.cumsum(size)) / size.sum()


def flank_line(
    tooth: Tooth, grid: ToothGrid, side: Side, root: Root, rows: int, tip: Array
) -> Line:
    """Fillet and flank of one side from the slot's bottom to the height `tip` (n,), on the exact surface."""
    flank, dense = tooth.flank(side), grid.side(side)
    cone, distance = flank.cone, grid.distance
    rise = np.sqrt(np.maximum(dense.height - dense.height[:, :1], 0.0))
    length = arc_lengths(cone, grid, side)
    low, high = stations(root, rows)
    at = np.zeros((len(distance), len(low) + len(high) - 1))
    angle, height = np.zeros(at.shape), np.zeros(at.shape)
    ends = joint(flank, grid, side) if root.fillet else dense.height[:, 0]
    for k in range(len(distance)):
        wanted = np.maximum([ends[k], tip[k]] - dense.height[k, 0], 0.0)
        end, whole = np.interp(np.sqrt(wanted), rise[k], length[k])
        at[k] = np.append(end * low[:-1], end + (whole - end) * high)
        height[k] = dense.height[k, 0] + np.interp(at[k], length[k], rise[k]) ** 2
        angle[k] = np.interp(at[k], length[k], dense.angle[k])
    height[:, -1] = tip
    z, rho = (np.asarray(v) for v in cone.axial_radial(distance[:, None], height))
    points = flank.at(z[:, 1:], rho[:, 1:]).position * flank.hand
    if not np.isfinite(points).all():
        k = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0]) // (at.shape[1] - 1)
        raise DesignError([_missing(flank, float(distance[k]))])
    x, y, along = points.T.reshape(3, len(distance), -1)
    own = np.arctan2(y, x)
    turn = 0.0 if side == "concave" else tooth.turn
    steps = np.round((angle[:, 1:] - own - turn) / tooth.pitch)
    angle[:, 1:] = own + turn + tooth.pitch * steps
    z[:, 1:], rho[:, 1:] = along, np.hypot(x, y)
    return Line(z, rho, angle)


def arc_lengths(cone: PitchCone, grid: ToothGrid, side: Side) -> Array:
    """Length along every profile (n, rows), mm, from its lowest point."""
    dense = grid.side(side)
    z, rho = cone.axial_radial(grid.distance[:, None], dense.height)
    steps = np.hypot(
        np.hypot(np.diff(z), np.diff(rho)), 0.5 * (rho[:, 1:] + rho[:, :-1]) * np.diff(dense.angle)
    )
    return np.concatenate([np.zeros((len(steps), 1)), np.cumsum(steps, axis=1)], axis=1)


def tips(cone: PitchCone, grid: ToothGrid, land: float) -> Array:
    """Height (n,) up to which the tooth is meshed: its tip, or where its land would be less than `land` (mm)."""
    made = grid.tip.copy()
    for k, low in enumerate(grid.concave.height):
        convex = np.interp(low, grid.convex.height[k], grid.convex.angle[k])
        radius = cone.axial_radial(grid.distance[k], low)[1]
        spare = (convex - grid.concave.angle[k]) * radius - land
        if spare[-1] < 0.0 < spare.max():
            last = int(np.flatnonzero(spare > 0.0)[-1])
            made[k] = np.interp(0.0, -spare[last : last + 2], low[last : last + 2])
    return made


def joint(flank: Flank, grid: ToothGrid, side: Side) -> Array:
    """Height (n,) where the fillet ends: its neighbour's lower edge, or where both cross (undercut)."""
    if flank.generated:
        return np.asarray(flank.charts[flank.cut_pieces[-2]].bounds(grid.distance)[0])
    dense = grid.side(side)
    found = np.zeros(len(grid.distance))
    for k, piece in enumerate(dense.piece):
        own = np.flatnonzero(piece == len(flank.cut_pieces) - 1)
        last = int(np.clip(own.max(initial=1), 1, len(piece) - 3))
        h, a = dense.height[k], dense.angle[k]
        below = (a[last] - a[last - 1]) / (h[last] - h[last - 1])
        above = (a[last + 2] - a[last + 1]) / (h[last + 2] - h[last + 1])
        gap = a[last + 1] - above * (h[last + 1] - h[last]) - a[last]
        step = gap / (below - above) if below != above else 0.0
        found[k] = h[last] + np.clip(step, 0.0, h[last + 1] - h[last])
    return found


def bottom_lines(tooth: Tooth, grid: ToothGrid, elements: tuple[int, int]) -> tuple[Line, Line]:
    """Half a slot bottom on either side of a tooth, by angle: to its concave flank, from its convex one.

    The grid's own bottom has an even number of steps; its middle is the border of a tooth's sector.
    """
    cone = tooth.concave.cone
    middle = grid.bottom_angle.shape[1] // 2
    made: list[Line] = []
    for first, count, turn in (
        (middle, elements[0], 0.0),
        (0, elements[1], tooth.pitch),
    ):
        part = slice(first, first + middle + 1)
        share = np.linspace(0.0, middle, 2 * count + 1)
        angle, height = (
            np.array([np.interp(share, np.arange(middle + 1.0), row) for row in rows[:, part]])
            for rows in (grid.bottom_angle, grid.bottom_height)
        )
        z, rho = cone.axial_radial(grid.distance[:, None], height)
        made.append(Line(np.asarray(z), np.asarray(rho), angle + turn))
    return made[0], made[1]


def _missing(flank: Flank, distance: float) -> Problem:
    return Problem(
        flank.name,
        f"a flank that is not there at cone distance {distance:.2f} mm",
        "a tooth that is cut from toe to heel",
        "a higher pressure angle, a lower dedendum or more teeth",
    )
