"""Smaller elements where a contact model's pairs bear: quadratic bricks see no contact narrower than they are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from hypoid.flank import Flank
from hypoid.solid import HexMesh, SplitMesh, face_nodes, split_under

Array = np.ndarray[Any, Any]
DEEP = 2  # elements for one below the flank, at least


def finer_under(
    mesh: HexMesh,
    flank: Flank,
    faces: Mapping[int, Array],
    reach: Mapping[int, tuple[float, float]],
    finer: int,
) -> tuple[SplitMesh, dict[int, Array]]:
    """The mesh with `finer` elements for one across a flank's height where pairs touch, half as many along it.

    `faces` (k, 2) of `mesh` by pair; `reach` by touching pair, cone distances S, mm, between which it touches. With
    the mesh its small faces by pair. Their nodes lie on the exact flank, except on borders with large ones.
    """
    chosen = [_within(mesh, flank, faces[pair], *ends) for pair, ends in reach.items()]
    half = -(-finer // 2)
    made = split_under(mesh, np.concatenate(chosen), finer, half, max(DEEP, half))
    small = made.mesh.face_sets[f"{flank.side}_flank"]
    small = small[made.split[small[:, 0]]]
    made = _onto(made, flank, small)
    tooth = made.mesh.tooth[small[:, 0]]
    of = {pair: mesh.tooth[faces[pair][0, 0]] for pair in reach}
    return made, {pair: small[tooth == number] for pair, number in of.items()}


def _within(mesh: HexMesh, flank: Flank, faces: Array, low: float, high: float) -> Array:
    """Faces (k, 2) that reach into these cone distances, mm, and one more either way."""
    x, y, z = np.moveaxis(mesh.nodes[face_nodes(mesh.elements, faces)[:, :4]], -1, 0)
    distance, _ = flank.cone.cone_distance_height(z, np.hypot(x, y))
    spare = float(np.ptp(distance, axis=1).max())
    there = (distance.max(axis=1) > low - spare) & (distance.min(axis=1) < high + spare)
    return faces[there]


def _onto(made: SplitMesh, flank: Flank, small: Array) -> SplitMesh:
    """With the nodes of small faces turned onto the exact flank, but for those that hang on large faces."""
    mesh = made.mesh
    free = np.setdiff1d(face_nodes(mesh.elements, small), made.hung)
    x, y, z = mesh.nodes[free].T
    distance, height = (np.asarray(v) for v in flank.cone.cone_distance_height(z, np.hypot(x, y)))
    below = np.minimum(height, flank.tip.at(distance))  # by rounding some stand above
    exact = flank.at(*flank.cone.axial_radial(distance, below))
    turn = np.arctan2(exact.position[:, 1], exact.position[:, 0]) - np.arctan2(y, x)
    turn = (turn + 0.5 * mesh.pitch) % mesh.pitch - 0.5 * mesh.pitch  # teeth are a pitch apart
    turn = np.where(exact.ok, turn, 0.0)
    c, s = np.cos(turn), np.sin(turn)
    nodes = mesh.nodes.copy()
    nodes[free] = np.stack([c * x - s * y, s * x + c * y, z], axis=1)
    return replace(made, mesh=replace(mesh, nodes=nodes))
