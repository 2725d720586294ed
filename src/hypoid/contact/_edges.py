"""Contact on an edge: the greatest lead where it lies on the outline of either active flank.

A window of points around the best node first slides along the outline, then shrinks. Edges, corners and the mate's
outline need no case of their own, since a point off the mate does not count.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.geometry import Batch, Scalar, compiled_fused, on_unit

from ._field import AngleField, FlankNodes, lead_on_flank
from ._mounting import Mounting

POINTS = 9  # a side of the window
SLIDES, LEVELS, SHRINK = 6, 16, 0.5  # steps at full size along an outline, steps in all
PADDING = 16  # positions are padded to a multiple of it, so that few shapes are compiled

Place = tuple[Batch, Batch, Batch]  # x, y of the chart and the lead there


@compiled_fused
def _zoom(
    mount: Mounting,
    pinion: AngleField,
    wheel: AngleField,
    phi: Batch,
    start: Place,
    window: tuple[Scalar, Scalar],
) -> Place:
    spread = jnp.linspace(-1.0, 1.0, POINTS)
    dx, dy = (window[k] * g.ravel() for k, g in enumerate(jnp.meshgrid(spread, spread)))

    def level(k: int, place: Place) -> Place:
        x, y, value = place
        scale = SHRINK ** jnp.maximum(k - SLIDES, 0)
        u = jnp.clip(x[:, None] + scale * dx, -1.0, 1.0)
        v = jnp.clip(y[:, None] + scale * dy, -1.0, 1.0)
        found = lead_on_flank(mount, pinion, wheel, phi[:, None], u, v)
        best = found.argmax(axis=1)[:, None]
        u, v, found = (jnp.take_along_axis(a, best, axis=1)[:, 0] for a in (u, v, found))
        better = found > value
        return jnp.where(better, u, x), jnp.where(better, v, y), jnp.where(better, found, value)

    return jax.lax.fori_loop(0, LEVELS, level, start)


def zoom(
    mount: Mounting,
    pinion: AngleField,
    wheel: AngleField,
    nodes: FlankNodes,
    phi: np.ndarray,
    best: np.ndarray,
    top: np.ndarray,
) -> np.ndarray:
    """Places x, y in the pinion's chart and greatest lead, rad, (3, m) near the best nodes, at pinion angles phi (m,).

    Never below ``top``.
    """
    count = len(phi)
    if not count:
        return np.zeros((3, 0))
    columns, rows = len(nodes.distance), len(nodes.share)
    size = -(-count // PADDING) * PADDING
    angle, node, value = (np.resize(a, size) for a in (phi, best, top))
    x = on_unit(nodes.distance[0], nodes.distance[-1], nodes.distance[node % columns])
    y = 2.0 * nodes.share[node // columns] - 1.0
    window = (2.0 / (columns - 1), 2.0 / (rows - 1))
    return np.array(_zoom(mount, pinion, wheel, angle, (x, y, value), window))[:, :count]
