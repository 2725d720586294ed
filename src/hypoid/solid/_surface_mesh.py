"""The surface of a tooth, a sector or a gear as triangles, as near to the exact surfaces as asked."""

from __future__ import annotations

from typing import Any

import numpy as np

from hypoid.flank import Side, Tooth
from hypoid.geometry import DesignError
from hypoid.pair import Member

from ._body import body
from ._divide import Divided, divided
from ._mesh import SurfaceMesh
from ._request import chord_problems, ring_problems
from ._topology import Topology, cartesian, topology, turned

Array = np.ndarray[Any, Any]
# where the surfaces of the teeth, the end faces and the ring are told apart
GROUPS = (
    "concave", "convex", "fillets", "top_land", "bottom", "toe", "heel", "rim", "back", "bore", "front",
    "start", "end",
)  # fmt: skip


def surface_mesh(
    member: Member,
    *,
    teeth: int | None = None,
    chord_error: float = 5e-3,
    bore: float | None = None,
    back: float | None = None,
) -> SurfaceMesh:
    """Surface of some teeth with their body, or of the whole gear: closed, outward, nowhere degenerate.

    Triangles stand off the exact surfaces by less than ``chord_error`` (mm), measured half-way between
    vertices. ``bore`` is a radius and ``back`` the back face's z, mm (see `body`). Groups name the
    surfaces: concave, convex, fillets, top_land, bottom, toe, heel, rim, back, bore, front; and where the
    gear is not whole start and end, the one of which is the other turned by the teeth's pitches.
    """
    problems = [*chord_problems(chord_error), *ring_problems(member, teeth, bore, back)]
    if problems:
        raise DesignError(problems)
    ring, tooth = body(member, bore, back), member.tooth
    count = member.teeth if teeth is None else teeth
    whole = count == member.teeth
    made = divided(tooth, ring, chord_error, member.name)
    corners = topology(made.cell, ring)
    triangles, groups = _triangles(tooth, made, corners, count, whole)

    copies = np.arange(count if whole else count + 1) * tooth.pitch
    places = np.repeat(corners.places[None], len(copies), axis=0)
    places[..., 1] += copies[:, None]
    vertices = cartesian(places).reshape(-1, 3)
    normals = turned(corners.normals[None], places[..., 1]).reshape(-1, 3)
    used = np.zeros(len(vertices), bool)  # the base line in the faces between teeth often is not
    used[triangles] = True
    vertices, normals, triangles = vertices[used], normals[used], (np.cumsum(used) - 1)[triangles]
    if member.concave.mirrored:
        hand, triangles = member.concave.hand, triangles[:, ::-1]
        vertices, normals = vertices * hand, normals * hand
    return SurfaceMesh(
        member=member.name,
        teeth=count,
        whole=whole,
        vertices=vertices,
        triangles=np.ascontiguousarray(triangles),
        normals=normals,
        groups=groups,
        chord_error=made.error,
    )


def _triangles(
    tooth: Tooth, made: Divided, corners: Topology, count: int, whole: bool
) -> tuple[Array, dict[str, Array]]:
    """Triangles of all cells in turn and, where the gear is not whole, of its two ends; and their groups."""
    parts, labels = [], []
    for name, ids in corners.patches.items():
        parts.append(_halves(ids, made.seen[name].other))
        labels.append(np.repeat(_labels(tooth, made, name).ravel(), 2))
    one, label = np.concatenate(parts), np.concatenate(labels)
    size = len(corners.places)
    every = (one + size * np.arange(count)[:, None, None]).reshape(-1, 3)
    label = np.tile(label, count)
    if whole:
        every %= size * count
    else:
        cut = _halves(corners.cut, np.zeros(np.array(corners.cut.shape) - 1, bool))
        start = np.concatenate([cut, corners.corner[None]])
        end = start[:, ::-1] + size * count
        every = np.concatenate([every, start, end])
        tail = [GROUPS.index("start"), GROUPS.index("end")]
        label = np.concatenate([label, np.repeat(tail, len(start))])
    groups = {name: np.flatnonzero(label == k) for k, name in enumerate(GROUPS)}
    return every, {name: found for name, found in groups.items() if len(found)}


def _halves(ids: Array, other: Array) -> Array:
    """Two triangles (2 p q, 3) for each quadrangle of a patch, by the diagonal chosen for it."""
    a, b, c, d = ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1]
    one = np.stack([np.where(other, x, y) for x, y in ((a, a), (b, b), (d, c))], axis=-1)
    two = np.stack([np.where(other, x, y) for x, y in ((b, a), (c, c), (d, d))], axis=-1)
    return np.stack([one, two], axis=2).reshape(-1, 3)


def _labels(tooth: Tooth, made: Divided, name: str) -> Array:
    """Index into GROUPS (p, q) for each quadrangle of a patch."""
    shape = made.seen[name].error.shape
    if name != "teeth":
        return np.full(shape, GROUPS.index(name.split()[0]))
    division, grid = made.cell.division, made.cell.grid
    bottom, rows, land = division.bottom, division.height_rows, division.land
    names = ("bottom", "concave", "top_land", "convex")
    along = np.repeat([GROUPS.index(n) for n in names], [bottom, rows, land, rows])
    found = np.broadcast_to(along, shape).copy()
    middle = slice(1, None, 2)
    fillet = GROUPS.index("fillets")
    segments: dict[Side, slice] = {
        "concave": slice(bottom, bottom + rows),
        "convex": slice(-1, -rows - 1, -1),
    }
    for side, where in segments.items():
        pieces = np.array(tooth.flank(side).cut_pieces)[grid.side(side).piece[middle, middle]]
        found[:, where] = np.where(pieces == "fillet", fillet, found[:, where])
    return found
