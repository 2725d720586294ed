"""One formula for line, arc and relief: its derivative, its limits and its joints."""

from __future__ import annotations

from dataclasses import replace
from math import pi
from typing import Any

import mpmath
import numpy as np
import pytest
from independent import edge_mp

from hypoid.cutter import EdgePiece, edge_point


def piece(
    curvature: float = 0.0, relief: float = 0.0, relief_from: float = 0.0, parabola: float = 0.0
) -> EdgePiece:
    c, s = np.cos(0.3), np.sin(0.3)
    return EdgePiece(
        start=(98.0, -3.0, 0.7),  # pyright: ignore[reportArgumentType]
        tangent=(c, 0.0, -s),  # pyright: ignore[reportArgumentType]
        metal=(s, 0.0, c),  # pyright: ignore[reportArgumentType]
        curvature=curvature,
        relief=relief,
        relief_from=relief_from,
        low=-3.0,
        high=3.0,
        parabola=parabola,
    )


def points(edge: EdgePiece, s: Any) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    point, derivative = edge_point(edge, s)
    return np.stack(point, axis=-1), np.stack(derivative, axis=-1)


@pytest.mark.parametrize(
    "edge",
    [
        piece(),
        piece(-1.0 / 1.032),
        piece(1.0 / 762.0),
        piece(0.0, 0.004, 0.9),
        piece(0.1, 0.01),
        piece(parabola=-0.003),
        piece(0.1, 0.01, 0.9, 0.003),
    ],
    ids=["line", "edge arc", "curved blade", "relief", "arc and relief", "parabola", "all terms"],
)
def test_point_and_derivative_agree_with_forty_digits(edge: EdgePiece, forty_digits: None) -> None:
    s = np.linspace(-3.0, 3.0, 25)
    point, derivative = points(edge, s)
    h = mpmath.mpf("1e-15")

    def exact(at: Any) -> mpmath.matrix:
        bow = float(edge.parabola) * mpmath.mpf(at) ** 2
        straight = replace(edge, parabola=0.0)
        return mpmath.matrix(
            [p + bow * float(m) for p, m in zip(edge_mp(straight, at), edge.metal, strict=True)]
        )

    for i, value in enumerate(s):
        assert mpmath.norm(exact(mpmath.mpf(value)) - mpmath.matrix(point[i])) < 5e-14
        if abs(value - edge.relief_from) > 1e-9:  # the parabola's start: one-sided only
            slope = (exact(value + h) - exact(value - h)) / (2 * h)
            assert mpmath.norm(slope - mpmath.matrix(derivative[i])) < 1e-14


@pytest.mark.parametrize("turn", [0.99e-3, 1.01e-3])
def test_arc_meets_its_own_series(turn: float, forty_digits: None) -> None:
    """Both sides of the switch between series and sine."""
    edge = piece(turn)
    exact = mpmath.matrix(edge_mp(edge, mpmath.mpf(1)))
    assert mpmath.norm(exact - mpmath.matrix(points(edge, np.ones(1))[0][0])) < 1e-13


def test_relief_leaves_the_edge_as_a_parabola_towards_the_metal() -> None:
    s = np.array([-1.0, 0.9, 1.9, 2.9])
    straight, relieved = (points(e, s)[0] for e in (piece(), piece(0.0, 0.004, 0.9)))
    metal = np.array(piece().metal)
    assert (relieved - straight) @ metal == pytest.approx([0.0, 0.0, 0.004, 0.016], abs=1e-13)


def test_turning_a_piece_turns_its_points() -> None:
    s = np.linspace(-2.0, 2.0, 5)
    before, after = points(piece(0.5), s)[0], points(piece(0.5).turned(pi / 2), s)[0]
    assert after == pytest.approx(before @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]), abs=1e-13)
