"""Elements split under a face: the same body, more freedom, held to the large elements on their borders."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import sparse
from scipy.sparse.linalg import spsolve

import hypoid
from hypoid.load import STEEL
from hypoid.load._bricks import gauss, gradients, stiffness
from hypoid.load._hats import _loads
from hypoid.solid import HexMesh, SplitMesh, face_nodes, hex_mesh, shape_gradients, split_under

Array = np.ndarray[Any, Any]
EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def mesh() -> HexMesh:
    pair = hypoid.read(EXAMPLES / "vimercati-piazza-2005.toml")
    return hex_mesh(pair.pinion, along=6, profile=4, fillet=2, through=2, below=1, rim=1)


@pytest.fixture(scope="module")
def split(mesh: HexMesh) -> SplitMesh:
    faces = mesh.face_sets["concave_flank"]
    place = mesh.nodes[face_nodes(mesh.elements, faces)].mean(axis=1)
    return split_under(mesh, faces[np.argsort(place[:, 2])[8:16]], 3, 2, 2)


def volume(mesh: HexMesh) -> float:
    points, weights = gauss(3)
    _, volumes = gradients(mesh.nodes[mesh.elements], shape_gradients(points))
    return float((volumes @ weights).sum())


def test_a_split_mesh_is_the_same_body(mesh: HexMesh, split: SplitMesh) -> None:
    assert split.split.sum() == 8 * 3 * 2 * 2
    assert len(split.mesh.elements) == len(mesh.elements) + 8 * (3 * 2 * 2 - 1)
    assert volume(split.mesh) == pytest.approx(volume(mesh), rel=1e-12)
    np.testing.assert_array_equal(np.unique(split.mesh.elements), np.arange(len(split.mesh.nodes)))
    for name, faces in mesh.face_sets.items():
        before = mesh.nodes[face_nodes(mesh.elements, faces)].reshape(-1, 3)
        after = split.mesh.nodes[split.mesh.face_nodes(name)].reshape(-1, 3)
        np.testing.assert_allclose(np.ptp(after, axis=0), np.ptp(before, axis=0), atol=1e-12)
    small = split.split[split.mesh.face_sets["concave_flank"][:, 0]].sum()
    assert small == 8 * 3 * 2
    assert len(split.mesh.face_sets["concave_flank"]) == 24 - 8 + small


def test_hung_nodes_are_where_the_others_say(split: SplitMesh) -> None:
    np.testing.assert_allclose(split.share.sum(axis=1), 1.0, rtol=1e-12)
    there = (split.mesh.nodes[split.on] * split.share[..., None]).sum(axis=1)
    np.testing.assert_allclose(there, split.mesh.nodes[split.hung], atol=1e-12)
    large = np.unique(split.mesh.elements[~split.split])
    assert np.isin(split.on, large).all()
    assert not np.isin(split.hung, large).any()


def test_more_freedom_gives_way_more(mesh: HexMesh, split: SplitMesh) -> None:
    """The work of an even pressure on the flank, bore held: greater, and by a little only."""
    first, second = (_work(one) for one in (mesh, split))
    assert first < second < 1.05 * first


def _work(of: HexMesh | SplitMesh) -> float:
    mesh = of.mesh if isinstance(of, SplitMesh) else of
    n = len(mesh.nodes)
    matrix = stiffness(mesh.nodes, mesh.elements, STEEL)
    follow: Any = sparse.eye_array(n).tolil()
    free = np.ones(n, dtype=bool)
    if isinstance(of, SplitMesh):
        for node, on, share in zip(of.hung, of.on, of.share, strict=True):
            follow[node, node] = 0.0
            follow[node, on] = share
        free[of.hung] = False
    free[mesh.node_sets["bore"]] = False
    columns = sparse.kron(follow.tocsc()[:, np.flatnonzero(free)], sparse.eye_array(3)).tocsc()
    faces = mesh.face_nodes("concave_flank")
    pressure, _ = _loads(mesh.nodes, faces, np.zeros((len(faces), 4), dtype=int), 1, 1.0)
    load = columns.T @ pressure.toarray()[:, 0]
    return float(load @ spsolve((columns.T @ matrix @ columns).tocsc(), load))
