"""Nodes of the ring below the teeth: a quadrilateral in the member's axial section, revolved.

Its outline has five corners, the base line's two ends among them. The flatter of these lies within the upper side,
so the ring reaches beyond the teeth there: behind the heel below a pinion's rim, before the toe on a wheel's front.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._body import Body

Array = np.ndarray[Any, Any]
GROWTH = 2.0  # of layers towards bore or back face, at most where their number is free
WIDENING = 1.5  # of columns beyond the teeth
THIN = 1e-3  # of the base line's length: what is shorter is left out


@dataclass(frozen=True)
class Ring:
    """Axial and radial place of the ring's nodes (sections, rows), middle nodes included; mm."""

    z: Array
    rho: Array
    rows: Array  # shares of the way up, 1 at the base line
    before: int  # columns of elements before the toe
    behind: int  # and behind the heel
    names: tuple[str, str, str, str]  # faces: first, last, below, above beyond the teeth


def ring(body: Body, share: Array, layer: float, rim: int | None) -> Ring:
    """Ring below the sections at shares (2 n + 1,) of the base line, from toe to heel.

    `layer` is the thickness (mm) of the lowest layer above the base line, which the first below it takes up.
    """
    heel_outer, bore_back, bore_front, toe, heel = _corners(body)
    line = heel - toe
    length = float(np.hypot(*line))
    step = length / (len(share) // 2)
    teeth = toe + share[:, None] * line
    flat_heel = line[0] > line[1]  # the base line lies rather along the axis
    if flat_heel:
        beyond = _beyond(heel, heel_outer, step, length)
        top = np.concatenate([teeth, beyond[1:]])
        low = bore_front, bore_back
        names = "front_face", "back_face", "bore", "rim"
        before, behind = 0, len(beyond) // 2
    else:
        beyond = _beyond(toe, bore_front, step, length)
        top = np.concatenate([beyond[:0:-1], teeth])
        low = bore_back, heel_outer
        names = "bore", "rim", "back_face", "front_face"
        before, behind = len(beyond) // 2, 0
    way = np.append(0.0, np.cumsum(np.hypot(*np.diff(top, axis=0).T)))
    bottom = low[0] + np.outer(way / way[-1], low[1] - low[0])
    depth = float(np.hypot(*(top - bottom).T).mean())
    rows = 1.0 - graded(depth, layer, GROWTH, rim)[::-1]
    at = bottom[:, None] + rows[None, :, None] * (top - bottom)[:, None]
    return Ring(at[..., 0], at[..., 1], rows, before, behind, names)


def graded(length: float, first: float, growth: float, count: int | None = None) -> Array:
    """Shares (2 n + 1,) of a length in n steps and their halves, that grow from about `first`."""
    if count is None:
        count = max(1, int(np.ceil(np.log1p(length / first * (growth - 1.0)) / np.log(growth))))
    low, high = 1.0, 1e3
    for _ in range(60):  # the growth that fills the length
        ratio = 0.5 * (low + high)
        full = first * (ratio ** np.arange(count)).sum()
        low, high = (ratio, high) if full < length else (low, ratio)
    ends = np.append(0.0, np.cumsum(low ** np.arange(count)))
    ends /= ends[-1]
    shares = np.repeat(ends, 2)[:-1]
    shares[1::2] = 0.5 * (ends[1:] + ends[:-1])
    return shares


def _beyond(start: Array, end: Array, step: float, length: float) -> Array:
    """Points from one end of the base line to the corner beyond it, the start alone where they are one."""
    there = float(np.hypot(*(end - start)))
    if there < THIN * length:
        return start[None]
    return start + np.outer(graded(there, step, WIDENING), end - start)


def _corners(body: Body) -> tuple[Array, Array, Array, Array, Array]:
    return (
        np.array([body.back, body.heel_base[1]]),
        np.array([body.back, body.bore]),
        np.array([body.front, body.bore]),
        np.array(body.toe_base),
        np.array(body.heel_base),
    )
