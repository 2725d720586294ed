"""The hexahedra of one tooth with its part of the ring: sections joined to columns of elements."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._hex_layout import Layout
from ._hex_outline import Line
from ._hex_quality import FACE_EDGES, FACES
from ._hex_ring import Ring

Array = np.ndarray[Any, Any]
SIDES = {  # borders of a section and the surface that their columns make
    "slot_bottom": "slot_bottom",
    "concave_lower": "concave_fillet",
    "concave_upper": "concave_fillet",
    "convex_lower": "convex_fillet",
    "convex_upper": "convex_fillet",
    "concave_flank": "concave_flank",
    "convex_flank": "convex_flank",
    "top_land": "top_land",
}
PARTS = ("tooth", "root", "rim")


@dataclass(frozen=True)
class Cell:
    """One tooth, left hand: elements with a positive Jacobian there, or after a mirroring if made for it."""

    nodes: Array  # (n, 3) mm
    elements: Array  # (m, 8 or 20)
    part: Array  # (m,) index into PARTS
    faces: dict[
        str, Array
    ]  # (k, 2) element and face, both sides but for the borders to the neighbours
    low: Array  # nodes on the border at low angles
    high: Array  # the same of the other border
    low_faces: Array
    high_faces: Array


def cell(
    layout: Layout, line: Line, there: Array, below: Ring, quadratic: bool, mirrored: bool
) -> Cell:
    """One tooth from its sections and the ring's; `mirrored` orders nodes for the other hand."""
    along = (len(line.z) - 1) // 2
    columns = below.before + along + below.behind
    place = _places(layout, line, there, below)
    quads, sides = layout.quads, layout.quad_edges + layout.nodes
    # section by section: ring below, then what stands on it where there are teeth
    ring, every = layout.ring_cells, len(quads)
    number = np.full((columns, every), -1)
    number[:, :ring] = 0
    number[below.before : below.before + along] = 0
    number[number == 0] = np.arange((number == 0).sum())
    column, quad = np.nonzero(number >= 0)
    # left hand: angle, height and cone distance turn to the left, so the end to the heel comes first
    first, last = (0, 2) if mirrored else (2, 0)
    width = place.shape[1]
    start, middle, end = ((2 * column + k)[:, None] * width for k in (first, 1, last))
    corners = quads[quad]
    keys = [start + corners, end + corners]
    if quadratic:
        keys += [start + sides[quad], end + sides[quad], middle + corners]
    used, elements = np.unique(np.concatenate(keys, axis=1), return_inverse=True)
    elements = elements.reshape(len(column), -1)

    j = layout.cells[quad, 1]
    part = np.where(j < layout.base, 2, np.where(j < layout.surface, 1, 0))
    faces: dict[str, Array] = {}

    def add(name: str, elements_of: Array, face: Array | int) -> None:
        pair = np.stack(np.broadcast_arrays(elements_of.ravel(), np.ravel(face)), axis=1)
        faces[name] = np.concatenate([faces.get(name, pair[:0]), pair])

    teeth = slice(below.before, below.before + along)
    for border, name in SIDES.items():
        which, side = layout.borders[border]
        add(name, number[teeth][:, which], 2 + side)
    toward = {"toe": 1, "heel": 0} if not mirrored else {"toe": 0, "heel": 1}
    add("toe", number[teeth][0, ring:], toward["toe"])
    add("heel", number[teeth][-1, ring:], toward["heel"])
    add(below.names[0], number[0, :ring], toward["toe"])
    add(below.names[1], number[-1, :ring], toward["heel"])
    add(below.names[2], number[:, layout.borders["ring_below"][0]], 2)
    which = layout.borders["ring_above"][0]
    add(below.names[3], number[: below.before][:, which], 4)
    add(below.names[3], number[below.before + along :][:, which], 4)
    low, high = _borders(layout, used, width, columns)
    borders = []
    for border in ("low_side", "high_side"):
        which, side = layout.borders[border]
        found = number[:, which]
        found = found[found >= 0]
        borders.append(np.stack([found, np.full(len(found), 2 + side)], axis=1))
    xyz = place.reshape(-1, 3)[used]
    return Cell(
        xyz,
        elements,
        part,
        {name: found for name, found in faces.items() if len(found)},
        low,
        high,
        borders[0],
        borders[1],
    )


def _places(layout: Layout, line: Line, there: Array, below: Ring) -> Array:
    """Places (sections, nodes and edges, 3), mm; NaN where nothing is."""
    n, base = layout.number, layout.base
    teeth = slice(2 * below.before, 2 * below.before + len(line.z))
    shape = (len(below.z), line.z.shape[1])
    z, rho, angle = (np.full(shape, np.nan) for _ in range(3))
    nodes = n[:, : base + 1]
    flat = layout.nodes + layout.edge(nodes[:-1], nodes[1:])
    level = np.concatenate([nodes, flat])
    foot = np.concatenate([nodes[:, base], flat[:, base]])
    around = np.pad(
        line.angle[:, foot], ((teeth.start, shape[0] - teeth.stop), (0, 0)), mode="edge"
    )
    # columns are of one width at the bottom, as at the base line at the top
    low, high = around[:, :1], around[:, [layout.columns]]
    place = np.append(np.arange(layout.columns + 1.0), np.arange(layout.columns) + 0.5)
    even = low + place / layout.columns * (high - low)
    steep = layout.nodes + layout.edge(nodes[:, :-1], nodes[:, 1:])
    for row, up in enumerate(below.rows):
        j, between = divmod(row, 2)
        ids = steep[:, j] if between else level[:, j]
        z[:, ids], rho[:, ids] = below.z[:, row, None], below.rho[:, row, None]
        angle[:, ids] = (up * around + (1.0 - up) * even)[:, : len(ids)]
    for made, found in ((z, line.z), (rho, line.rho), (angle, line.angle)):
        made[teeth, there] = found[:, there]
    return np.stack([rho * np.cos(angle), rho * np.sin(angle), z], axis=-1)


def _borders(layout: Layout, used: Array, width: int, columns: int) -> tuple[Array, Array]:
    """Nodes on the borders to both neighbours, in the same order."""
    made: list[Array] = []
    for row in (layout.number[0], layout.number[-1]):
        nodes = row[: layout.surface + 1]
        own = np.concatenate([nodes, layout.nodes + layout.edge(nodes[:-1], nodes[1:])])
        key = (np.arange(2 * columns + 1)[:, None] * width + own).ravel()
        place = np.minimum(np.searchsorted(used, key), len(used) - 1)
        made.append(np.where(used[place] == key, place, -1))
    there = made[0] >= 0
    return made[0][there], made[1][there]


def face_nodes(elements: Array, faces: Array) -> Array:
    """Nodes (k, 4 or 8) of faces (k, 2): corners anticlockwise from outside, then those between them."""
    columns = FACES if elements.shape[1] == 8 else np.concatenate([FACES, FACE_EDGES], axis=1)
    return elements[faces[:, :1], columns[faces[:, 1]]]
