"""The closed form in phi and the general Newton are two ways to one surface."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from hypoid.flank import Flank


@pytest.mark.parametrize("kind", ["plain", "relief", "tilted"])
@pytest.mark.parametrize(
    "name", ["pinion concave", "pinion convex", "wheel concave", "wheel convex"]
)
def test_closed_form_agrees_with_newton(
    flank_of: Callable[[str, str], Flank], kind: str, name: str
) -> None:
    closed = flank_of(kind, name)
    assert closed.surface.way == "cradle"
    newton = replace(closed, surface=replace(closed.surface, way="newton"))
    rng = np.random.default_rng(7)
    for piece, edge in closed.pieces.items():
        if piece == "land":
            continue
        # every point that the blank asks for: s over the edge, theta from toe to heel
        distance, height = (g.ravel() for g in closed.grid(21, 31))
        points = closed.at_cone(distance, height)
        mine = points.piece == ("flank", "fillet").index(piece)
        s, theta = points.s[mine], points.theta[mine]
        s = np.append(s, rng.uniform(float(edge.low), float(edge.high), len(s)))
        theta = np.append(theta, theta)
        a, b = closed.at_cutter(s, theta, piece), newton.at_cutter(s, theta, piece)
        met = np.isfinite(a[0]).all(axis=1)
        assert met.mean() > 0.85
        assert b[0][met] == pytest.approx(a[0][met], abs=1e-9, rel=0)
        assert b[1][met] == pytest.approx(a[1][met], abs=1e-10, rel=0)


def test_moving_axes_leave_the_closed_form(flank_of: Callable[[str, str], Flank]) -> None:
    flank = flank_of("moving", "pinion concave")
    assert flank.surface.way == "newton"
    plain = flank_of("plain", "pinion concave")
    s, theta = np.array([-1.0, 1.0]), np.array([0.05, -0.05])
    apart = np.linalg.norm(flank.at_cutter(s, theta)[0] - plain.at_cutter(s, theta)[0], axis=1)
    assert apart.min() > 1e-3  # the motions do something
