"""Targets of a correction other than the nominal flank: a wanted form, or the mate's errors made good.

Corrected towards its pair's ease-off, a member takes off what its mate stands out (and the other way round), so that
the pair meets as designed though only one of both is cut again.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from hypoid.contact import pattern, unloaded_contact
from hypoid.pair import Direction, GearPair

from ._grid import FlankNodes
from ._topography import coordinates

Array = np.ndarray[Any, Any]
DEGREE = 3  # of the maps between both flanks


def form(
    nodes: FlankNodes,
    *,
    profile_crowning: float = 0.0,
    lengthwise_crowning: float = 0.0,
    bias: float = 0.0,
) -> Array:
    """Target deviation (rows, columns), mm, of a form; signs and places as in ``Topography``."""
    x, y = coordinates(nodes)
    return -profile_crowning * y * y - lengthwise_crowning * x * x + bias * x * y


def mates_ease_off(pair: GearPair, nodes: FlankNodes, mate: FlankNodes, deviation: Array) -> Array:
    """Target (rows, columns), mm, of one flank from its mate's deviations, so that the ease-off is the design's.

    Each place of one flank comes nearest to one of the other (``contact.pattern``); there the target is the mate's
    deviation with the other sign. NaN nowhere: maps are smooth.
    """
    direction: Direction = "drive" if _drives(nodes) else "coast"
    met = pattern(unloaded_contact(pair, direction))
    distance = np.broadcast_to(met.distance, met.height.shape)
    there = np.isfinite(met.gap) & np.isfinite(met.wheel_distance)
    own = distance[there], met.height[there]
    other = met.wheel_distance[there], met.wheel_height[there]
    if nodes.flank.member == "wheel":
        own, other = other, own
    at = _scaled(nodes, nodes.distance.ravel(), nodes.height.ravel())
    from_own = _terms(*_scaled(nodes, *own))
    places = [
        _terms(*at) @ np.linalg.lstsq(from_own, value, rcond=None)[0]
        for value in _scaled(mate, *other)
    ]
    x, y = (c.ravel() for c in _scaled(mate, mate.distance, mate.height))
    value = np.asarray(deviation, float).ravel()
    known = np.isfinite(value)
    fit, *_ = np.linalg.lstsq(_terms(x, y)[known], value[known], rcond=None)
    return -(_terms(*places) @ fit).reshape(nodes.shape)


def _drives(nodes: FlankNodes) -> bool:
    return (nodes.flank.member == "pinion") == (nodes.side == "concave")


def _scaled(nodes: FlankNodes, distance: Array, height: Array) -> tuple[Array, Array]:
    """Places (S, H) in coordinates of a grid, straight in both."""
    toe, heel = nodes.distance[0, 0], nodes.distance[0, -1]
    x = (2.0 * distance - toe - heel) / (heel - toe)
    middle = 0.5 * (nodes.height[0] + nodes.height[-1])
    slope = (middle[-1] - middle[0]) / (heel - toe)
    half = 0.5 * float((nodes.height[-1] - nodes.height[0]).mean())
    return x, (height - middle[0] - slope * (distance - toe)) / half


def _terms(x: Array, y: Array) -> Array:
    powers = [(i, j) for i in range(DEGREE + 1) for j in range(DEGREE + 1 - i)]
    return np.stack([x**i * y**j for i, j in powers], axis=-1)
