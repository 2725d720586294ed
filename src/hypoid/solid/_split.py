"""Hexahedra under a face split into smaller ones, whose nodes on the border hang on those beside them.

The small ones' nodes are where the large ones' shape functions put them, so a border of both is one surface. As its
nodes move with the large faces, what the small ones add is the freedom of their own inside.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

from ._hex_cell import face_nodes
from ._hex_mesh import HexMesh
from ._hex_quality import CORNERS, FACE_EDGES, FACES, node_places, shape_values

Array = np.ndarray[Any, Any]
SAME = 1e-7  # mm: nodes of neighbours so near to each other are one
ALONG = 2  # the local axis along the face, see `HexMesh.elements`


@dataclass(frozen=True, eq=False)
class SplitMesh:
    """A mesh with some elements split: nodes on the borders of the small ones move as the large faces there do."""

    mesh: HexMesh
    split: Array  # (m,) bool, which elements are small ones
    hung: Array  # (k,) nodes that move with others
    on: Array  # (k, 8) the nodes of the large faces that they are on
    share: Array  # (k, 8) of each of these nodes' displacement


def split_under(mesh: HexMesh, faces: Array, across: int, along: int, deep: int) -> SplitMesh:
    """Split the 20-node elements under `faces` (k, 2), all of one number, as those of a tooth's flank are.

    `across` and `along` the face evenly, and `deep` ones below it, the first of them the thinnest.
    """
    (face,) = np.unique(faces[:, 1])
    chosen = np.unique(faces[:, 0])
    steps, numbers = _steps(int(face), across, along, deep)
    places, small = _lattice(steps)
    nodes, own = _joined(
        np.einsum("un,end->eud", shape_values(places), mesh.nodes[mesh.elements[chosen]])
    )
    kept = np.setdiff1d(np.arange(len(mesh.elements)), chosen)
    used, rest = np.unique(mesh.elements[kept], return_inverse=True)
    rest = rest.reshape(-1, mesh.elements.shape[1])
    added = own[:, small] + len(used)  # (chosen, small ones, 20)
    count = added.shape[1]
    at = np.full(len(mesh.elements), -1)
    at[kept] = np.arange(len(kept))
    first = np.full(len(mesh.elements), -1)
    first[chosen] = len(kept) + count * np.arange(len(chosen))

    def carried(pairs: Array) -> Array:
        """Faces (n, 2) of this mesh as they are in the split one."""
        large = pairs[at[pairs[:, 0]] >= 0]
        made = [np.column_stack([at[large[:, 0]], large[:, 1]])]
        for which in np.unique(pairs[:, 1]):
            of = pairs[(pairs[:, 1] == which) & (first[pairs[:, 0]] >= 0), 0]
            there = (first[of][:, None] + _at_side(numbers, int(which))).ravel()
            made.append(np.column_stack([there, np.full(len(there), which)]))
        return np.concatenate(made)

    whole = replace(
        mesh,
        nodes=np.concatenate([mesh.nodes[used], nodes]),
        elements=np.concatenate([rest, added.reshape(-1, added.shape[2])]),
        tooth=np.concatenate([mesh.tooth[kept], np.repeat(mesh.tooth[chosen], count)]),
        face_sets={name: carried(pairs) for name, pairs in mesh.face_sets.items()},
    )
    sets = {
        name: np.unique(face_nodes(whole.elements, whole.face_sets[name]))
        for name in mesh.node_sets
    }
    split = np.arange(len(whole.elements)) >= len(kept)
    hung, on, share = (
        np.concatenate(v) for v in zip(*_hung(mesh.elements, chosen, places, own), strict=True)
    )
    hung, once = np.unique(hung + len(used), return_index=True)
    return SplitMesh(
        replace(whole, node_sets=sets), split, hung, np.searchsorted(used, on[once]), share[once]
    )


def _hung(
    elements: Array, chosen: Array, places: Array, own: Array
) -> Iterator[tuple[Array, Array, Array]]:
    """Nodes (k,) of the split elements on faces that others share; those faces' nodes (k, 8), and shares (k, 8)."""
    corners = np.sort(elements[:, FACES], axis=-1).reshape(-1, 4)
    _, number = np.unique(corners, axis=0, return_inverse=True)
    number = number.reshape(-1, len(FACES))
    others = np.delete(number, chosen, axis=0)
    border = np.isin(number[chosen], others)
    values = shape_values(places)
    for face, there in enumerate(border.T):
        axis, end = _normal(face)
        at = np.flatnonzero(places[:, axis] == end)
        nodes = np.concatenate([FACES[face], FACE_EDGES[face]])
        which = np.flatnonzero(there)
        yield (
            own[which][:, at].ravel(),
            np.repeat(elements[chosen[which]][:, nodes], len(at), axis=0),
            np.tile(values[np.ix_(at, nodes)], (len(which), 1)),
        )


def _normal(face: int) -> tuple[int, float]:
    """The local axis across a face, and where on it the face is."""
    place = CORNERS[FACES[face]]
    axis = int(np.flatnonzero(np.all(place == place[0], axis=0))[0])
    return axis, float(place[0, axis])


def _steps(face: int, across: int, along: int, deep: int) -> tuple[list[Array], tuple[int, ...]]:
    """Borders of the small elements on each local axis, from -1 to 1, and how many there are."""
    normal, outward = _normal(face)
    counts = [across] * 3
    counts[ALONG], counts[normal] = along, deep
    steps = [np.linspace(-1.0, 1.0, n + 1) for n in counts]
    depth = (np.arange(deep + 1) / deep) ** 2  # from the face inwards
    steps[normal] = np.sort(outward * (1.0 - 2.0 * depth))
    return steps, tuple(counts)


def _lattice(steps: list[Array]) -> tuple[Array, Array]:
    """Local places (u, 3) of all small elements' nodes, and which of them (small ones, 20) are each one's."""
    fine = [np.sort(np.concatenate([s, 0.5 * (s[1:] + s[:-1])])) for s in steps]
    size = tuple(len(f) for f in fine)
    one = np.array(list(product(*(range(len(s) - 1) for s in steps))))
    index = 2 * one[:, None] + 1 + node_places(20).astype(int)
    flat = np.ravel_multi_index(tuple(np.moveaxis(index, -1, 0)), size)
    used, small = np.unique(flat, return_inverse=True)
    at = np.unravel_index(used, size)
    places = np.stack([f[i] for f, i in zip(fine, at, strict=True)], axis=1)
    return places, small.reshape(flat.shape)


def _joined(places: Array) -> tuple[Array, Array]:
    """Nodes (n, 3) of places (e, u, 3), those that elements share once, and which (e, u) each is."""
    flat = places.reshape(-1, 3)
    twins = KDTree(flat).query_pairs(SAME, output_type="ndarray")
    links = coo_array((np.ones(len(twins)), tuple(twins.T)), shape=(len(flat),) * 2)
    count, number = connected_components(links, directed=False)
    first = np.full(count, len(flat))
    np.minimum.at(first, number, np.arange(len(flat)))
    return flat[first], number.reshape(places.shape[:2])


def _at_side(counts: tuple[int, ...], face: int) -> Array:
    """Which small elements of one lie at its face."""
    axis, end = _normal(face)
    index = np.unravel_index(np.arange(np.prod(counts)), counts)[axis]
    return np.flatnonzero(index == (counts[axis] - 1 if end > 0.0 else 0))
