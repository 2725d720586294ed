"""The pair in mesh as triangles: both members with all their teeth, mounted, at pinion angle zero.

Members are read as left-hand ones, as the contact does; the picture is turned into the pair's own
hand at the end. Rims and shafts are drawn for the eye: a design file says nothing about them.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from hypoid.contact import Mounting, Pattern, UnloadedContact, mounting
from hypoid.flank import Flank
from hypoid.pair import GearPair, Member

from ._style import GREEN, ORANGE, SKY

Array = np.ndarray[Any, Any]
COLUMNS = {"pinion": 73, "wheel": 25}  # nodes along a tooth, toe to heel
ROWS = 14  # nodes across, root to tip
LIFT = 0.04  # mm: the painted pattern stands proud of the flank to be seen
TURNS = 120  # sides of a body of revolution


@dataclass(frozen=True)
class Mesh:
    """Triangles of one colour in the picture's frame, and the member that they turn with."""

    name: str
    member: str
    vertices: Array  # (n, 3) mm, no NaN
    triangles: Array  # (m, 3) indices
    colour: str


@dataclass(frozen=True)
class Axis:
    """A member's axis in the picture: a point and the direction that its turn counts about."""

    point: tuple[float, float, float]
    direction: tuple[float, float, float]
    turn: float  # of this member per turn of the pinion


@dataclass(frozen=True)
class Scene:
    """The pair in mesh."""

    meshes: tuple[Mesh, ...]
    axes: dict[str, Axis]


def scene(pair: GearPair, contact: UnloadedContact | None, marked: Pattern | None) -> Scene:
    """The pair mounted for drive at pinion angle zero; the drive pattern is painted on both."""
    mount = mounting(pair, "drive")
    place = {"pinion": _pinion_place(mount), "wheel": _wheel_place(mount, contact)}
    flip = np.array([1.0, 1.0 if pair.pinion.blank.hand == "right" else -1.0, 1.0])
    meshes: list[Mesh] = []
    for member, colour in ((pair.pinion, SKY), (pair.wheel, ORANGE)):
        turn, shift = place[member.name]
        parts = [*_teeth(member), _body(member)]
        meshes.append(_joined(f"{member.name}", member.name, parts, turn, shift, flip, colour))
    if marked is not None and marked.touched.any():
        paint = {
            "pinion": (
                pair.pinion.concave,
                np.broadcast_to(marked.distance, marked.gap.shape),
                marked.height,
            ),
            "wheel": (pair.wheel.convex, marked.wheel_distance, marked.wheel_height),
        }
        for name, (flank, distance, height) in paint.items():
            turn, shift = place[name]
            patch = _patch(flank, distance, height, marked.touched)
            teeth = pair.pinion.teeth if name == "pinion" else pair.wheel.teeth
            mesh = _joined(
                f"{name}: drive pattern", name, _around([patch], teeth), turn, shift, flip, GREEN
            )
            meshes.append(mesh)
    return Scene(tuple(m for m in meshes if len(m.triangles)), _axes(pair, place, flip))


def _pinion_place(mount: Mounting) -> tuple[Array, Array]:
    """Rotation and shift of the pinion into the picture's frame, at pinion angle zero."""
    axes = np.array([[float(c) for c in row] for row in mount.axes])
    return axes @ _turn_z(float(mount.pinion_zero)), np.array([float(c) for c in mount.shift])


def _wheel_place(mount: Mounting, contact: UnloadedContact | None) -> tuple[Array, Array]:
    """Rotation of the wheel where the contact puts it at pinion angle zero (no shift)."""
    lead = contact.index_shift if contact is not None else 0.0
    lead = lead if np.isfinite(lead) else 0.0
    turned = float(mount.sense) * (lead + float(mount.wheel_zero))
    return _turn_z(-turned), np.zeros(3)


def _axes(pair: GearPair, place: dict[str, tuple[Array, Array]], flip: Array) -> dict[str, Axis]:
    """Axes with the sense in which each member turns when the pinion drives."""
    mirror = float(np.prod(flip))
    turns = {"pinion": -mirror, "wheel": -mirror * pair.ratio}
    axes: dict[str, Axis] = {}
    for name, (turn, shift) in place.items():
        x, y, z = (float(c) for c in shift * flip)
        u, v, w = (float(c) for c in turn[:, 2] * flip)
        axes[name] = Axis((x, y, z), (u, v, w), turns[name])
    return axes


def _turn_z(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


Part = tuple[Array, Array]  # vertices (n, 3), triangles (m, 3)


def _left_hand(flank: Flank, distance: Array, height: Array, lift: float = 0.0) -> Array:
    """Flank points (..., 3) at (S, H), read as a left-hand member; NaN where there is none."""
    at = flank.at_cone(distance, height)
    points = at.position + lift * at.normal
    points[:, 1] *= -1.0 if flank.mirrored else 1.0
    return points.reshape(*np.shape(distance), 3)


def _teeth(member: Member) -> list[Part]:
    """All teeth: both flanks with their fillets, the top land, and both ends."""
    pitch = 2.0 * np.pi / member.teeth
    sides: dict[str, Array] = {}
    for flank in (member.concave, member.convex):
        # nodes crowd towards the fillet; the runout into the root land is a double root
        share = np.linspace(0.0, 1.0, ROWS) ** 1.4
        distance = np.linspace(flank.toe, flank.heel, COLUMNS[member.name])
        low, high = flank.root.at(distance) + 1e-3, flank.tip.at(distance)
        height = low + np.outer(share, high - low)
        sides[flank.side] = _left_hand(flank, np.broadcast_to(distance, height.shape), height)
    concave, convex = sides["concave"], sides["convex"]
    # a left-hand tooth reaches from its concave flank in the sense of growing angle
    apart = _mean_angle(convex) - _mean_angle(concave)
    convex = convex @ _turn_z(apart % pitch - apart).T if np.isfinite(apart) else convex
    strips = [
        _grid(concave[::-1]),
        _grid(convex),
        _grid(np.stack([convex[-1], concave[-1]])),
        _grid(np.stack([concave[:, 0], convex[:, 0]])),
        _grid(np.stack([convex[:, -1], concave[:, -1]])),
    ]
    return _around(strips, member.teeth)


def _mean_angle(points: Array) -> float:
    middle = points[points.shape[0] // 2, points.shape[1] // 2]
    return float(np.arctan2(middle[1], middle[0]))


def _around(parts: list[Part], count: int) -> list[Part]:
    turns = [_turn_z(2.0 * np.pi * k / count) for k in range(count)]
    return [(points @ turn.T, triangles) for turn in turns for points, triangles in parts]


def _body(member: Member) -> Part:
    """A shaft for the pinion, a ring for the wheel: revolved below the root cone."""
    blank = member.blank
    toe, _, _, heel = blank.axial_section
    if member.name == "pinion":
        radius = 0.86 * toe[1]
        out = 0.35 * blank.face_width
        profile = [
            (toe[0] - out, 0.0),
            (toe[0] - out, radius),
            (toe[0], radius),
            toe,
            heel,
            (heel[0], 0.8 * heel[1]),
            (heel[0] + 1.4 * out, 0.8 * heel[1]),
            (heel[0] + 1.4 * out, 0.0),
        ]
    else:
        rim = blank.mean_dedendum + 3.0 * (blank.mean_addendum + blank.mean_dedendum)
        back = [
            blank.position(blank.outer_cone_distance, -rim),
            blank.position(blank.inner_cone_distance, -rim),
        ]
        profile = [toe, heel, *back, toe]
    angle = np.linspace(0.0, 2.0 * np.pi, TURNS + 1)
    strips: list[Part] = []
    for (z0, r0), (z1, r1) in pairwise(profile):
        rows = [
            np.stack([r * np.cos(angle), r * np.sin(angle), z + 0.0 * angle], axis=-1)
            for z, r in ((z1, r1), (z0, r0))
        ]
        strips.append(_grid(np.stack(rows)))
    return _merge(strips)


def _patch(flank: Flank, distance: Array, height: Array, touched: Array) -> Part:
    """The touched part of a flank, a little proud of it."""
    inside = np.where(touched & np.isfinite(distance) & np.isfinite(height), 1.0, np.nan)
    distance = np.clip(distance, flank.toe, flank.heel) * inside
    height = np.clip(height, flank.root.at(distance), flank.tip.at(distance)) * inside
    vertices = _left_hand(flank, distance, height, LIFT)
    return _grid(vertices[::-1] if flank.side == "concave" else vertices)


def _grid(points: Array) -> Part:
    """Two triangles a cell of a grid (rows, columns, 3), less those that a NaN point spoils."""
    rows, columns = points.shape[:2]
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (
        corner.ravel()
        for corner in (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1])
    )
    flat = points.reshape(-1, 3)
    triangles = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])
    return flat, triangles[np.isfinite(flat[triangles]).all(axis=(1, 2))]


def _merge(parts: Iterable[Part]) -> Part:
    vertices: list[Array] = []
    triangles: list[Array] = []
    count = 0
    for points, faces in parts:
        vertices.append(points)
        triangles.append(faces + count)
        count += len(points)
    return np.concatenate(vertices), np.concatenate(triangles)


def _joined(
    name: str,
    member: str,
    parts: Iterable[Part],
    turn: Array,
    shift: Array,
    flip: Array,
    colour: str,
) -> Mesh:
    """Parts as one mesh in the picture's frame, without the points that no triangle uses."""
    points, triangles = _merge(parts)
    used, triangles = np.unique(triangles, return_inverse=True)
    triangles = triangles.reshape(-1, 3)
    placed = (points[used] @ turn.T + shift) * flip
    if np.prod(flip) < 0.0:
        triangles = triangles[:, ::-1]
    return Mesh(name, member, placed, triangles, colour)
