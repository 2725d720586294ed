"""Every example member's tooth against a brute-force sweep of its blades, at toe, mean and heel."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from milled import member_sweep

import hypoid
from hypoid.flank import roll_range
from hypoid.io import example_files
from hypoid.pair import GearPair, Member

FILES = {f.stem: f for f in example_files()}
AGREEMENT = 1e-3  # mm, what is asked; along the normal


@cache
def pair_of(name: str) -> GearPair:
    return hypoid.read(FILES[name])


@pytest.mark.slow
@pytest.mark.parametrize("side", ["concave", "convex"])
@pytest.mark.parametrize("name", ["pinion", "wheel"])
@pytest.mark.parametrize("example", FILES)
def test_the_tooth_is_what_the_blades_leave(example: str, name: str, side: Any) -> None:
    member: Member = getattr(pair_of(example), name)
    flank, sweep = member.flank(side), member_sweep(member, member.flank(side))
    grid = member.tooth.grid(3, 6)
    profile = grid.side(side)
    low, high = roll_range(flank) if flank.generated else (-0.45, 0.45)
    for k, distance in enumerate(grid.distance):
        rows = slice(1, None)  # the lowest line is a double root
        cut = sweep.boundary(distance, profile.height[k, rows], side, (low - 0.1, high + 0.1))
        cut += member.stock_turn if side == "convex" else 0.0  # how the work stood for that cut
        _, rho = flank.cone.axial_radial(distance, profile.height[k, rows])
        lever = rho * np.abs(profile.normal[k, rows, 1])
        angle = profile.angle[k, rows]
        pitch = 2.0 * np.pi / member.teeth
        apart = np.mod(cut - angle + 0.5 * pitch, pitch) - 0.5 * pitch
        assert np.abs(apart * lever).max() < AGREEMENT
