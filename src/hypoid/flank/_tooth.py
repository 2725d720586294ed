"""The tooth between two slots: both flanks as they are cut, top land and slot bottom along the face.

All angles are those of a left-hand member, where concave flanks face falling angles: a slot reaches from its
convex flank up to its concave one, a tooth from its concave flank to the next slot's convex one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ._flank import Flank, Side
from ._locate import from_cutter
from ._section import lowest, sections

Array = np.ndarray[Any, Any]
SIDES: tuple[Side, Side] = ("concave", "convex")
NEAR_ROOT = 0.3  # how much closer rows stand at the root than at the tip, as a share
LOWERINGS = 20  # of the tip of a pointed tooth, to where its flanks cross


@dataclass(frozen=True)
class Profile:
    """One flank of a tooth on a grid: cone distance (n,) by rows, root to tip; left hand, mm and rad."""

    height: Array  # (n, rows)
    angle: Array  # (n, rows), the convex flank's where it bounds the same tooth
    normal: Array  # (n, rows, 3), of the point turned to angle zero: radial, around, axial
    piece: Array  # (n, rows) index into Flank.cut_pieces


@dataclass(frozen=True)
class ToothGrid:
    """A tooth by cone distance (n,), mm: both flanks, and the slot's bottom beside its concave flank."""

    distance: Array
    concave: Profile
    convex: Profile
    tip: Array  # (n,) height of the tip: the face cone, or below it where the tooth is pointed
    pointed: Array  # (n,) bool
    bottom_height: Array  # (n, across), from the slot's convex flank to its concave one
    bottom_angle: Array

    def side(self, side: Side) -> Profile:
        return self.concave if side == "concave" else self.convex


@dataclass(frozen=True, eq=False)
class Tooth:
    """One tooth of a member: its flanks, and the turn that puts the convex one in its slot (rad)."""

    concave: Flank
    convex: Flank
    teeth: int
    turn: float = 0.0

    @property
    def pitch(self) -> float:
        """Angular pitch, rad."""
        return 2.0 * np.pi / self.teeth

    def flank(self, side: Side) -> Flank:
        return self.concave if side == "concave" else self.convex

    @cached_property
    def convex_turn(self) -> float:
        """Turn that takes the convex flank to where it bounds one tooth with the concave one, rad."""
        middle = [0.5 * (self.concave.toe + self.concave.heel)]
        concave, convex = (float(self.flank(s).left_angle(middle, [0.0])[0]) for s in SIDES)
        return concave - convex + self.pitch - float(self.slot_angle(middle)[0])

    def slot_angle(self, distance: Any, height: Any = 0.0) -> Array:
        """Angle of the slot at (S, H), rad, in [0, pitch); NaN where a flank is not there."""
        distance, height = np.broadcast_arrays(np.asarray(distance, float), height)
        concave, convex = (self.flank(s).left_angle(distance, height) for s in SIDES)
        return np.mod(concave - convex - self.turn, self.pitch)

    def slot_width(self, distance: Any, height: Any = 0.0) -> Array:
        """Transverse width of the slot at (S, H), mm, along the arc about the axis."""
        return self.slot_angle(distance, height) * self._radius(distance, height)

    def thickness(self, distance: Any, height: Any = 0.0) -> Array:
        """Transverse thickness of the tooth at (S, H), mm, along the arc about the axis."""
        return (self.pitch - self.slot_angle(distance, height)) * self._radius(distance, height)

    def _radius(self, distance: Any, height: Any) -> Array:
        return np.asarray(self.concave.cone.axial_radial(np.asarray(distance, float), height)[1])

    def grid(
        self,
        columns: int | Array = 61,
        rows: int | Mapping[Side, Array] = 61,
        across: int = 9,
    ) -> ToothGrid:
        """The whole tooth, columns from toe to heel; rows stand closer at the root.

        Instead of counts: the columns' cone distances (n,), mm; each side's rows as shares (n, rows)
        of the height from its lowest point, 0, to the tip, 1.
        """
        if isinstance(columns, int):
            distance = np.linspace(self.concave.toe, self.concave.heel, columns)
        else:
            distance = np.asarray(columns, float)
        if isinstance(rows, int):
            t = np.linspace(0.0, 1.0, rows)
            rows = dict.fromkeys(SIDES, (NEAR_ROOT * t + (1.0 - NEAR_ROOT) * t * t)[None, :])
        tip = np.asarray(self.concave.tip.at(distance), float)
        made: dict[Side, Profile] = {s: self._profile(s, distance, tip, rows[s]) for s in SIDES}
        pointed = ~(made["convex"].angle[:, -1] > made["concave"].angle[:, -1])
        for _ in range(LOWERINGS if pointed.any() else 0):
            crossed = _crossing(made["concave"], made["convex"])
            if not np.isfinite(crossed).any():
                break
            tip = np.where(np.isfinite(crossed), crossed, tip)
            made = {s: self._profile(s, distance, tip, rows[s]) for s in SIDES}
        height, angle = self._bottom(distance, made, across)
        return ToothGrid(distance, made["concave"], made["convex"], tip, pointed, height, angle)

    def placed(self, grid: ToothGrid, side: Side) -> tuple[Array, Array]:
        """Points (n, rows, 3) mm of one flank of a grid and unit normals, in the member's own hand."""
        profile, flank = grid.side(side), self.flank(side)
        z, radius = flank.cone.axial_radial(grid.distance[:, None], profile.height)
        position = np.stack([radius, 0.0 * radius, z], axis=-1)
        points, normals = (_turned_back(v, -profile.angle) for v in (position, profile.normal))
        return points * flank.hand, normals * flank.hand

    def _profile(self, side: Side, distance: Array, tip: Array, share: Array) -> Profile:
        flank = self.flank(side)
        low, low_angle, s, turn = lowest(flank, distance)
        height = low[:, None] + (tip - low)[:, None] * share
        rows = height.shape[1]
        at = flank.at_cone(np.broadcast_to(distance[:, None], height.shape)[:, 1:], height[:, 1:])
        position, normal = at.position * flank.hand, at.normal * flank.hand
        angle = np.full(height.shape, np.nan)
        angle[:, 1:] = np.arctan2(position[:, 1], position[:, 0]).reshape(len(distance), rows - 1)
        angle[:, 0] = low_angle
        piece = np.full(height.shape, len(flank.cut_pieces) - 1)
        piece[:, 1:] = at.piece.reshape(len(distance), rows - 1)
        first = from_cutter(flank.surface, flank.pieces[flank.cut_pieces[-1]], s, turn)
        every = np.zeros((*height.shape, 3))
        every[:, 1:] = normal.reshape(len(distance), rows - 1, 3)
        every[:, 0] = first[3:6].T
        turned = _turned_back(every, angle)
        # continuous along the face, and the convex flank that bounds the tooth of the concave one
        middle = flank.left_angle([0.5 * (flank.toe + flank.heel)], [0.0])
        angle = middle + _wrapped(angle - middle)
        if side == "convex":
            angle = angle + self.convex_turn
        return Profile(height, angle, turned, piece)

    def _bottom(
        self, distance: Array, made: dict[Side, Profile], across: int
    ) -> tuple[Array, Array]:
        """The slot's bottom: the lower of what both lands sweep, between the flanks' lowest points.

        Where neither reaches, it runs straight to what is next to it; nowhere is it above the chord.
        """
        start = made["convex"].angle[:, 0] - self.pitch
        end = made["concave"].angle[:, 0]
        share = np.linspace(0.0, 1.0, across)
        angle = start[:, None] + np.outer(end - start, share)
        height = np.full(angle.shape, np.inf)
        for side in SIDES:
            flank = self.flank(side)
            if "land" not in flank.pieces:
                continue
            own = made[side]
            shift = 0.0 if side == "concave" else self.turn
            for k, curves in enumerate(sections(flank, distance, ["land"])):
                reference = own.angle[k, 0] - (self.pitch if side == "convex" else 0.0)
                for curve in curves:
                    if curve.other:
                        continue
                    there = np.isfinite(curve.height)
                    at = reference + _wrapped(curve.angle[there] + shift - reference)
                    order = np.argsort(at)
                    if len(order) < 2:
                        continue
                    land = np.interp(
                        angle[k], at[order], curve.height[there][order], left=np.inf, right=np.inf
                    )
                    height[k] = np.minimum(height[k], land)
        low = made["convex"].height[:, 0], made["concave"].height[:, 0]
        height[:, 0], height[:, -1] = low
        for row in height:
            there = np.isfinite(row)
            row[~there] = np.interp(share[~there], share[there], row[there])
        return np.minimum(height, low[0][:, None] + np.outer(low[1] - low[0], share)), angle


def _crossing(concave: Profile, convex: Profile) -> Array:
    """Height (n,) just below where the flanks cross, by the chord between rows; NaN where they do not."""
    thickness = convex.angle - concave.angle
    found = np.full(len(thickness), np.nan)
    for k in np.flatnonzero(~(thickness[:, -1] > 0.0)):
        last = int(np.flatnonzero(thickness[k] > 0.0).max(initial=0))
        a, b = thickness[k, last : last + 2]
        low, high = concave.height[k, last : last + 2]
        found[k] = low + 0.999 * (a / (a - b) if a > 0.0 else 0.0) * (high - low)
    return found


def _wrapped(angle: Array) -> Array:
    return np.angle(np.exp(1j * angle))


def _turned_back(normal: Array, angle: Array) -> Array:
    """Normals (..., 3) turned about the axis so that their points come to angle zero."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = normal[..., 0], normal[..., 1]
    return np.stack([c * x + s * y, c * y - s * x, normal[..., 2]], axis=-1)
