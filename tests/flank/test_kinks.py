"""Kinks of the edge: where two of its surfaces cross, the deeper one is the tooth."""

from __future__ import annotations

import numpy as np
import pytest
from milled import mill_sweep, milled


@pytest.mark.parametrize(
    ("cutter", "upper"), [("toprem", "flank"), ("straight flankrem", "flankrem")]
)
def test_next_to_a_kink_the_tooth_is_what_the_blade_leaves(cutter: str, upper: str) -> None:
    """Brute force, in the band where both surfaces are there, and on either side of it."""
    flank = milled(cutter, "generated")
    distance = 0.5 * (flank.toe + flank.heel)
    names = flank.cut_pieces
    lower = names[names.index(upper) + 1]
    low = float(flank.charts[upper].bounds(distance)[0])
    high = float(flank.charts[lower].bounds(distance)[1])
    band = high - low
    assert 0.01 < band < 0.1  # mm; 0.050 and 0.023
    heights = np.linspace(low - band, high + band, 13)
    points = flank.at_cone(np.full(13, distance), heights)
    assert points.ok.all()
    assert len(set(points.piece)) == 2
    x, y, _ = points.position.T
    lever = np.abs(x * points.normal[:, 1] - y * points.normal[:, 0])
    cut = mill_sweep(cutter, flank).boundary(distance, heights, "concave", (-0.3, 0.3))
    apart = np.angle(np.exp(1j * (cut - np.arctan2(y, x)))) * lever
    assert np.abs(apart).max() < 1e-5  # mm


@pytest.mark.parametrize(
    ("cutter", "upper"), [("toprem", "flank"), ("straight flankrem", "flankrem")]
)
def test_the_deeper_piece_takes_a_micrometre(cutter: str, upper: str) -> None:
    """How much metal the upper piece alone would leave in that band: 0.36 and 1.14 um."""
    flank = milled(cutter, "generated")
    distance = np.full(41, 0.5 * (flank.toe + flank.heel))
    lower = flank.cut_pieces[flank.cut_pieces.index(upper) + 1]
    ends = flank.charts[upper].bounds(distance)[0][0], flank.charts[lower].bounds(distance)[1][0]
    heights = np.linspace(*ends, 41)
    points = flank.at_cone(distance, heights)
    s, turn, _ = flank.parameters(distance, heights, upper)
    alone, _ = flank.at_cutter(s, turn, upper)
    left = ((alone - points.position) * points.normal).sum(axis=1)
    assert left.min() > -1e-9
    assert 3e-4 < left.max() < 1.2e-3  # mm
