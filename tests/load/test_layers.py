"""Elimination layer by layer against a sparse direct solver that knows nothing of layers."""

from __future__ import annotations

from threading import Event
from typing import Any

import numpy as np
import pytest
from scipy import sparse
from scipy.sparse.linalg import splu

from hypoid.load import STEEL
from hypoid.load._bricks import stiffness
from hypoid.load._dense import side_by_side
from hypoid.load._layers import node_places, through
from hypoid.pair import GearPair
from hypoid.solid import hex_mesh


def block(columns: int) -> tuple[Any, np.ndarray]:
    """A positive chain of 2 columns + 1 sections in which a column's three sections all meet; places by unknown."""
    rng = np.random.default_rng(columns)
    place = np.repeat(np.arange(2 * columns - 1), rng.integers(3, 8, 2 * columns - 1))
    total = np.zeros((len(place),) * 2)
    for c in range(columns):
        own = np.flatnonzero(np.abs(place - 2 * c) <= 1)
        some = rng.normal(size=(len(own), len(own) + 3))
        total[np.ix_(own, own)] += some @ some.T
    mix = rng.permutation(len(place))
    return sparse.csr_array(total[np.ix_(mix, mix)]), place[mix]


@pytest.mark.parametrize("columns", [1, 2, 3, 4, 9])
def test_products_through_a_chain(columns: int) -> None:
    matrix, place = block(columns)
    n, rng = len(place), np.random.default_rng(7)
    load = sparse.random_array((n, 11), density=0.1, rng=rng).tocsr()
    sight = sparse.random_array((n, 5), density=0.2, rng=rng).tocsr()
    loads, sights = through(matrix, place, load, sight)
    inverse = np.linalg.inv(matrix.toarray())
    np.testing.assert_allclose(loads, load.T @ inverse @ load.toarray(), atol=1e-9)
    np.testing.assert_allclose(sights, sight.T @ inverse @ load.toarray(), atol=1e-9)


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_a_tooth_falls_into_layers(relief_pair: GearPair, member: str) -> None:
    """Of either member, the ring behind the heel included: products as by a sparse solver."""
    mesh = hex_mesh(
        getattr(relief_pair, member), along=6, profile=3, fillet=2, through=2, below=1, rim=1
    )
    place = node_places(len(mesh.nodes), mesh.elements)
    assert place.max() >= 2 * 6
    assert (np.bincount(place) > 0).all()
    held = mesh.node_sets["bore"]
    free = np.setdiff1d(np.arange(3 * len(mesh.nodes)), (3 * held[:, None] + np.arange(3)).ravel())
    matrix = stiffness(mesh.nodes, mesh.elements, STEEL)[free][:, free]
    load = sparse.random_array((len(free), 6), density=0.01, rng=np.random.default_rng(1)).tocsc()
    found, _ = through(matrix, place[free // 3], load, load[:, :0])
    expected = load.T @ splu(matrix.tocsc()).solve(load.toarray())
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())


def test_a_mesh_that_is_no_chain_is_refused() -> None:
    apart = np.arange(40).reshape(2, 20)
    with pytest.raises(ValueError, match="one behind the other"):
        node_places(40, apart)


def test_a_job_that_fails_ends_the_one_beside_it() -> None:
    """As Ctrl-C from a progress does: the other job is told, and nothing waits for its end."""
    told: list[bool] = []

    def fails(_: Event) -> None:
        raise KeyboardInterrupt

    def waits(stop: Event) -> None:
        told.append(stop.wait(timeout=60.0))

    with pytest.raises(KeyboardInterrupt):
        side_by_side([fails, waits])
    assert told == [True]
