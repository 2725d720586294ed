"""Contact on an edge: the greatest lead where it lies on the outline of either active flank.

A window of points around the best node shrinks fourfold at each level. Edges, corners and the mate's
outline need no case of their own, since a point off the mate does not count.
"""

from __future__ import annotations

import numpy as np

from ..geometry import on_unit
from ._field import AngleField, FlankNodes, lead_on_flank
from ._mounting import Mounting

LEVELS, SHRINK, POINTS = 6, 4.0, 9
PADDING = 64  # positions are padded to a multiple of it, so that few shapes are compiled


def zoom(
    mount: Mounting,
    pinion: AngleField,
    wheel: AngleField,
    nodes: FlankNodes,
    phi: np.ndarray,
    best: np.ndarray,
    top: np.ndarray,
) -> np.ndarray:
    """Greatest lead (rad) near the best nodes, at pinion angles phi (m,); never below ``top``."""
    count = len(phi)
    if not count:
        return top
    columns, rows = len(nodes.distance), len(nodes.share)
    size = -(-count // PADDING) * PADDING
    angle = np.resize(phi, size)
    node, value = np.resize(best, size), np.resize(top, size)
    x = on_unit(nodes.distance[0], nodes.distance[-1], nodes.distance[node % columns])
    y = 2.0 * nodes.share[node // columns] - 1.0
    wide, high = 2.0 / (columns - 1), 2.0 / (rows - 1)
    spread = np.linspace(-1.0, 1.0, POINTS)
    dx, dy = (g.ravel() for g in np.meshgrid(spread, spread))
    each = np.arange(size)
    for _ in range(LEVELS):
        u = np.clip(x[:, None] + wide * dx, -1.0, 1.0)
        v = np.clip(y[:, None] + high * dy, -1.0, 1.0)
        found = np.asarray(lead_on_flank(mount, pinion, wheel, angle[:, None], u, v))
        k = found.argmax(axis=1)
        better = found[each, k] > value
        value = np.where(better, found[each, k], value)
        x, y = np.where(better, u[each, k], x), np.where(better, v[each, k], y)
        wide, high = wide / SHRINK, high / SHRINK
    return value[:count]
