"""One tooth with its part of the ring, condensed to its hats and its two cut faces; copies of it as a closed ring.

With u the displacement of the cut to the last tooth, in the tooth's own frame, and z = exp(2 pi i m / N), the ring
of N equal teeth comes apart by a discrete Fourier transform over the teeth: B(m) = A00 + A11 + A01 z + A10 conj(z)
for the cuts, g0 + g1 conj(z) for what hats do to them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse
from scipy.spatial import KDTree

from ._layers import Progress, through

Array = np.ndarray[Any, Any]
MATCH = 1e-6  # mm: nodes of both cut faces stand on each other


@dataclass(frozen=True, eq=False)
class Superelement:
    """A tooth's response to unit hats and to displacements of its cuts, both in its own frame."""

    cut: Array  # (2c, 2c) N/mm: the cut below (rising angle), then the one above, in the next tooth's frame
    hat_to_cut: Array  # (2c, h): force on the cuts that hats ask for, N/N
    hat: Array  # (h, h) mm/N, cuts held
    seen: Array  # (r, h): a linear function of the displacements, for unit hats, cuts held
    seen_of_cut: Array  # (r, 2c): the same for unit displacements of the cuts


def condense(
    stiffness: Any,
    load: Any,
    seen: Any,
    cuts: tuple[Array, Array],
    held: Array,
    place: Array,
    pitch: float,
    progress: Progress = lambda *_: None,
) -> Superelement:
    """Condense a tooth's stiffness (3n, 3n) to hats `load` (3n, h), with `seen` (r, 3n) of displacements.

    `cuts` are nodes below and above, the second the first turned by `pitch` (rad); nodes `held` do not move.
    `place` (n,) tells where nodes stand along the face, see `node_places`.
    """
    n = stiffness.shape[0] // 3
    low, high = (nodes[~np.isin(nodes, held)] for nodes in cuts)
    turn = _turned(n, high, pitch)
    stiff = (turn.T @ stiffness @ turn).tocsc()
    dofs = [(3 * nodes[:, None] + np.arange(3)).ravel() for nodes in (low, high)]
    cut = np.concatenate(dofs)
    fixed = (3 * held[:, None] + np.arange(3)).ravel()
    inner = np.setdiff1d(np.arange(3 * n), np.concatenate([cut, fixed]))
    to_cut = stiff[inner][:, cut]
    sight = (seen @ turn).tocsr()
    columns = sparse.hstack([load.tocsr()[inner], to_cut]).tocsr()
    whole = stiff[inner][:, inner]
    solved, glance = through(whole, place[inner // 3], columns, sight[:, inner].T, progress)
    h = load.shape[1]
    return Superelement(
        cut=_even(stiff[cut][:, cut].toarray() - solved[h:, h:]),
        hat_to_cut=-solved[h:, :h],
        hat=_even(solved[:h, :h]),
        seen=glance[:, :h],
        seen_of_cut=sight[:, cut].toarray() - glance[:, h:],
    )


def _turned(n: int, nodes: Array, angle: float) -> Any:
    """Displacements (3n) from those where `nodes` count in a frame turned by `angle` about z."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = 3 * nodes, 3 * nodes + 1
    turn: Any = sparse.eye_array(3 * n).tolil()
    turn[x, x], turn[x, y], turn[y, x], turn[y, y] = c, -s, s, c
    return turn.tocsc()


def matched(nodes: Array, low: Array, high: Array, pitch: float) -> Array:
    """`high` in the order of `low`: each the other turned by the pitch about z."""
    c, s = np.cos(pitch), np.sin(pitch)
    x, y, z = nodes[low].T
    away, index = KDTree(nodes[high]).query(np.stack([c * x - s * y, s * x + c * y, z], axis=1))
    if float(np.max(away)) > MATCH:
        raise ValueError("the cut faces of this mesh are not each other turned by a pitch")
    return high[index]


@dataclass(frozen=True, eq=False)
class Ring:
    """Response of tooth n to hats on tooth 0, n counted by rising angle, modulo the number of teeth."""

    compliance: dict[int, Array]  # (h, h) mm/N: displacement at tooth n by force on tooth 0
    seen: dict[int, Array]  # (r, h)


def ring(one: Superelement, teeth: int, reach: int, sight: int) -> Ring:
    """A closed ring of `teeth` copies: compliance up to `reach` teeth away, what is seen up to `sight`."""
    c = len(one.cut) // 2
    (a00, a01), (a10, a11) = ((one.cut[i : i + c, :c], one.cut[i : i + c, c:]) for i in (0, c))
    g0, g1 = one.hat_to_cut[:c], one.hat_to_cut[c:]
    s0, s1 = one.seen_of_cut[:, :c], one.seen_of_cut[:, c:]
    compliance = {n % teeth: np.zeros_like(one.hat) for n in range(-reach, reach + 1)}
    seen = {n % teeth: np.zeros_like(one.seen) for n in range(-sight, sight + 1)}
    for m in range(teeth // 2 + 1):
        twice = 1.0 if 2 * m % teeth == 0 else 2.0  # m and teeth - m are conjugates
        z = np.exp(2j * np.pi * m / teeth)
        border = a00 + a11 + a01 * z + a10 * np.conj(z)
        drive = g0 + g1 * np.conj(z)
        if m == 0:
            border, drive, z = border.real, drive.real, 1.0
        moved = np.linalg.solve(border, drive)
        answer = drive.conj().T @ moved
        glance = (s0 + s1 * z) @ moved
        for n, total in compliance.items():
            total += (twice * z**n / teeth * answer).real
        for n, total in seen.items():
            total += (twice * z**n / teeth * glance).real
    compliance[0] += one.hat
    seen[0] += one.seen
    return Ring(compliance, seen)


def _even(matrix: Array) -> Array:
    return 0.5 * (matrix + matrix.T)
