"""Copies of one tooth's mesh, each joined to the next at the nodes of their border."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._hex_cell import Cell, face_nodes

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Sector:
    """Teeth by rising angle about z; the middle one stands where the one tooth did."""

    nodes: Array
    elements: Array
    tooth: Array  # (m,) of each element
    face_sets: dict[str, Array]
    node_sets: dict[str, Array]


def sector(one: Cell, teeth: int, pitch: float, whole: bool, mirrored: bool) -> Sector:
    """Copies of a tooth, turned about z by pitches (rad); `one` has its nodes in its own hand already."""
    # the border at high angles belongs to the next tooth, as its border at low ones
    minus, plus = (one.high, one.low) if mirrored else (one.low, one.high)
    count = len(one.nodes)
    own = np.ones(count, dtype=bool)
    own[plus] = False
    each = int(own.sum())
    index = np.full(count, -1)
    index[own] = np.arange(each)
    borrowed = np.zeros(count, dtype=int)
    borrowed[plus] = index[minus]

    turns = (np.arange(teeth) - teeth // 2) * pitch
    nodes = [_turned(one.nodes[own], turn) for turn in turns]
    elements: list[Array] = []
    for k in range(teeth):
        last = k == teeth - 1
        after = 0 if last and whole else (k + 1) * each
        number = np.where(own, k * each + index, after + borrowed)
        if last and not whole:  # what would be the next tooth's border
            number[plus] = teeth * each + np.arange(len(plus))
            nodes.append(_turned(one.nodes[plus], turns[-1]))
        elements.append(number[one.elements])
    every = np.concatenate(elements)
    size = len(one.elements)
    faces = {
        name: np.concatenate([found + np.array([k * size, 0]) for k in range(teeth)])
        for name, found in one.faces.items()
    }
    if not whole:
        first, end = (
            (one.high_faces, one.low_faces) if mirrored else (one.low_faces, one.high_faces)
        )
        faces["side_minus"] = first
        faces["side_plus"] = end + np.array([(teeth - 1) * size, 0])
    return Sector(
        np.concatenate(nodes),
        every,
        np.repeat(np.arange(teeth), size),
        faces,
        {name: np.unique(face_nodes(every, found)) for name, found in faces.items()},
    )


def _turned(nodes: Array, turn: float) -> Array:
    c, s = np.cos(turn), np.sin(turn)
    x, y, z = nodes.T
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)
