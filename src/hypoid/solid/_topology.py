"""Which vertices the patches of a cell share, with each other and with the next cell.

Vertices are numbered within a cell. Where a patch ends around the axis it meets the next cell, whose
vertices carry the same numbers, raised by the number of vertices of a cell.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._body import Body
from ._cell import Cell

Array = np.ndarray[Any, Any]
NEXT = 1 << 40  # marks a vertex of the next cell until a cell's number of vertices is known


@dataclass(frozen=True, eq=False)
class Topology:
    """Vertices of a cell in the member's frame turned to a left hand, and the corners of its patches."""

    places: Array  # (n, 3) radius (mm), angle (rad), z (mm)
    normals: Array  # (n, 3) unit: radial, around, axial
    patches: dict[str, Array]  # (p + 1, q + 1) corners
    cut: Array  # (3, columns + 1) corners of the face at the cell's start: root, base line, bore
    corner: Array  # (3,) the triangle that is left of that face at the heel


def topology(cell: Cell, body: Body) -> Topology:
    """Numbers, places and normals of a cell's vertices."""
    corners, cut, corner = _numbered(cell)
    count = 1 + max(int(ids[ids < NEXT].max()) for ids in (*corners.values(), cut))
    corners = {name: np.where(ids < NEXT, ids, ids - NEXT + count) for name, ids in corners.items()}
    places, normals = np.zeros((count, 3)), np.zeros((count, 3))
    places[cut[1]] = _base_line(cell, body)
    normals[cut[1]] = (0.0, -1.0, 0.0)
    for name in (*(n for n in corners if n != "teeth"), "teeth"):  # the flanks' own normals last
        ids, points = corners[name], cell.patches[name]
        own = ids < count
        places[ids[own]] = points[::2, ::2][own]
        normals[ids[own]] = (_flank_normals if name == "teeth" else _patch_normals)(cell, name)[own]
    return Topology(places, normals, corners, cut, corner)


def _numbered(cell: Cell) -> tuple[dict[str, Array], Array, Array]:
    division, level, around = cell.division, cell.level, cell.around
    columns, rows, land = division.columns, division.height_rows, division.land
    used = 0

    def new(lines: int, sides: int) -> Array:
        """Lines of vertices around the axis, that many sides of the cell each."""
        nonlocal used
        own = used + np.arange(lines * sides).reshape(lines, sides)
        used += own.size
        return np.hstack([own, own[:, :1] + NEXT])

    teeth = new(columns + 1, division.bottom + 2 * rows + land)
    toe_base, heel_base, rim = (new(1, around) for _ in range(3))
    bore = new(columns + 1, around)
    corners = {"teeth": teeth}
    foot = division.bottom + level  # place of the concave flank's level row in the profile
    for end, profile, base in (("heel", teeth[-1], heel_base), ("toe", teeth[0], toe_base)):
        inner = new(rows - level, land - 1)[:, :-1]
        concave = profile[foot : foot + rows - level]
        convex = profile[len(profile) - 1 - level - np.arange(rows - level)]
        top = profile[foot + rows - level :][: land + 1]
        strip = np.vstack([np.column_stack([concave, inner, convex]), top])
        low = np.concatenate([profile[:foot], strip[0], profile[len(profile) - level :]])
        ordered = slice(None, None, 1 if end == "toe" else -1)
        corners[f"{end} above"] = strip[ordered]
        corners[f"{end} below"] = np.vstack([base, low])[ordered]
    corners |= {
        "rim": np.vstack([heel_base, rim]),
        "back": np.vstack([rim, bore[-1:]]),
        "bore": bore[::-1],
        "front": np.vstack([bore[:1], toe_base]),
    }
    line = np.concatenate([toe_base[0, :1], used + np.arange(columns - 1), heel_base[0, :1]])
    cut = np.stack([teeth[:, 0], line, bore[:, 0]])
    return corners, cut, np.array([heel_base[0, 0], rim[0, 0], bore[-1, 0]])


def _base_line(cell: Cell, body: Body) -> Array:
    """Places (columns + 1, 3) of the base line in the face at the cell's start."""
    distance = cell.division.distance
    share = (distance - distance[0]) / (distance[-1] - distance[0])
    (z_toe, toe), (z_heel, heel) = body.toe_base, body.heel_base
    angle = cell.grid.bottom_angle[::2, 0]
    return np.column_stack([toe + share * (heel - toe), angle, z_toe + share * (z_heel - z_toe)])


def cartesian(places: Array) -> Array:
    """Points (..., 3) at radius, angle and z."""
    radius, angle, z = np.moveaxis(places, -1, 0)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1)


def turned(vectors: Array, angle: Array) -> Array:
    """Vectors (..., 3), radial, around, axial, at an angle about the axis, in x, y, z."""
    radial, around, axial = np.moveaxis(vectors, -1, 0)
    c, s = np.cos(angle), np.sin(angle)
    x, y = c * radial - s * around, s * radial + c * around
    return np.stack(np.broadcast_arrays(x, y, axial), axis=-1)


def _patch_normals(cell: Cell, name: str) -> Array:
    """Outward normals at the corners of a patch, from the exact points beside them."""
    points = cell.patches[name]
    p, q = np.gradient(cartesian(points), axis=(0, 1), edge_order=2)
    normal = np.cross(q, p)[::2, ::2]
    normal = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    return turned(normal, -points[::2, ::2, 1])


def _flank_normals(cell: Cell, name: str) -> Array:
    """The same for the teeth, exact on the flanks."""
    normal, division = _patch_normals(cell, name), cell.division
    first, rows = division.bottom, division.height_rows
    normal[:, first : first + rows + 1] = cell.grid.concave.normal[::2, ::2]
    convex = cell.grid.convex.normal[::2, ::2]
    normal[:, -rows - 1 :] = convex[:, ::-1]
    normal[:, 0] = convex[:, 0]
    return normal
