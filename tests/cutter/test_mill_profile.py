"""Curved blades, Toprem and Flankrem against closed forms in 40 digits, and which way they remove."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians
from typing import Any

import mpmath
import numpy as np
import pytest

from hypoid.cutter import (
    CircularProfile,
    FaceMillHead,
    Flankrem,
    MillBlade,
    ParabolicProfile,
    PlanePiece,
    Toprem,
    edge_point,
)
from hypoid.cutter._profile import placed

mpf = mpmath.mpf
ANGLE, HEIGHT, R_P = radians(20.0), 14.0, 115.0
PLAIN = MillBlade("outer", R_P, ANGLE, edge_radius=0.8, land=1.5, height=HEIGHT)


def meridian(blade: MillBlade, name: str, s: Any) -> tuple[np.ndarray[Any, Any], Any]:
    """x off the sharp corner towards the metal, and z, of a piece as placed in the cutter frame."""
    head = FaceMillHead(outer=blade) if blade.name == "outer" else FaceMillHead(inner=blade)
    (x, y, z), _ = edge_point(head.pieces(blade.name)[name], s)
    assert np.abs(y).max() == 0.0
    side = 1.0 if blade.name == "outer" else -1.0
    return side * (np.asarray(x) - blade.point_radius), np.asarray(z)


@pytest.mark.parametrize("radius", [700.0, -400.0, 60.0])
@pytest.mark.parametrize("name", ["outer", "inner"])
def test_circular_profile_is_the_circle_of_vimercati_2d(
    name: Any, radius: float, forty_digits: None
) -> None:
    """Every point at `radius` from a centre on the normal at the reference height, metal side."""
    blade = replace(PLAIN, name=name, profile=CircularProfile(radius, 6.0))
    flank = blade.outline[-1]
    s = np.linspace(flank.low, flank.high, 15)
    a, rho = mpf(ANGLE), mpf(radius)
    centre = 6 * mpmath.tan(a) + rho * mpmath.cos(a), -6 + rho * mpmath.sin(a)
    for length, x, z in zip(s, *meridian(blade, "flank", s), strict=True):
        at = a + mpf(float(length)) / rho  # the edge leans more by s/rho
        expected = centre[0] - rho * mpmath.cos(at), centre[1] - rho * mpmath.sin(at)
        assert abs(expected[0] - x) < 2e-13  # x off R_P: the last digit of 115 is 1.4e-14
        assert abs(expected[1] - z) < 2e-14


@pytest.mark.parametrize("coefficient", [0.0008, -0.0011, 0.01])
@pytest.mark.parametrize("name", ["outer", "inner"])
def test_parabolic_profile_has_its_vertex_at_the_reference_height(
    name: Any, coefficient: float, forty_digits: None
) -> None:
    """u along the tangent, c u**2 off it on both sides of the vertex."""
    blade = replace(PLAIN, name=name, profile=ParabolicProfile(coefficient, 6.0))
    flank = blade.outline[-1]
    assert flank.low < -4.0 < 7.0 < flank.high
    u = np.linspace(flank.low, flank.high, 15)
    a, c = mpf(ANGLE), mpf(coefficient)
    for s, x, z in zip(u, *meridian(blade, "flank", u), strict=True):
        s = mpf(float(s))
        off = c * s * s
        assert abs(6 * mpmath.tan(a) + s * mpmath.sin(a) + off * mpmath.cos(a) - x) < 2e-13
        assert abs(-6 - s * mpmath.cos(a) + off * mpmath.sin(a) - z) < 2e-14


@pytest.mark.parametrize("radius", [700.0, -400.0, 60.0])
def test_edge_arc_of_a_curved_blade_by_the_notes_of_vimercati(
    radius: float, forty_digits: None
) -> None:
    """Without Toprem sin(delta) = (rho sin(a_t) - h_f + r_e)/(rho + r_e), notes of 2005, item 5."""
    blade = replace(PLAIN, profile=CircularProfile(radius, 6.0))
    land, fillet, flank = blade.outline
    rho, a, r_e = mpf(radius), mpf(ANGLE), mpf(0.8)
    delta = mpmath.asin((rho * mpmath.sin(a) - 6 + r_e) / (rho + r_e))
    assert abs(r_e * (mpmath.pi / 2 - delta) - fillet.high) < 1e-14
    assert abs(rho * (delta - a) - flank.low) < 1e-13
    # item 5 again: x_R from P, which stands at 6 tan(a) off our corner; gamma, L2 vanish here
    x_r = rho * (mpmath.cos(a) - mpmath.cos(delta)) - r_e * mpmath.cos(delta)
    assert abs(6 * mpmath.tan(a) + x_r - land.start[0]) < 1e-13


@pytest.mark.parametrize("coefficient", [0.0008, -0.0011, 0.01])
def test_edge_arc_of_a_parabolic_blade_touches_once(coefficient: float, forty_digits: None) -> None:
    """The centre stands one radius off the parabola and no nearer, and one below the tips."""
    blade = replace(PLAIN, profile=ParabolicProfile(coefficient, 6.0))
    land, _, flank = blade.outline
    a, c = mpf(ANGLE), mpf(coefficient)
    centre = mpf(land.start[0]), -mpf(blade.edge_radius)

    def distance(u: Any) -> Any:
        x = 6 * mpmath.tan(a) + u * mpmath.sin(a) + c * u * u * mpmath.cos(a)
        z = -6 - u * mpmath.cos(a) + c * u * u * mpmath.sin(a)
        return mpmath.sqrt((x - centre[0]) ** 2 + (z - centre[1]) ** 2)

    nearest = mpmath.findroot(lambda u: mpmath.diff(distance, u), mpf(flank.low))
    assert abs(nearest - flank.low) < 1e-13
    assert abs(distance(nearest) - mpf(0.8)) < 1e-14


@pytest.mark.parametrize("radius", [mpmath.inf, 700.0, -400.0])
def test_toprem_by_the_notes_of_vimercati(radius: Any, forty_digits: None) -> None:
    """Item 5 with H = the kink's height; gamma = 90 deg - delta + tau is the edge arc's turn (item 4)."""
    curve = CircularProfile(radius, 6.0) if radius != mpmath.inf else None
    tau, h, r_e, a, h_f = mpf(radians(4.0)), mpf(2), mpf(0.8), mpf(ANGLE), mpf(6)
    blade = replace(PLAIN, profile=curve, toprem=Toprem(float(tau), 2.0))
    land, fillet, toprem, flank = blade.outline
    if curve is None:
        delta, to_kink = a, -(h_f - h) * mpmath.tan(a)
    else:
        rho = mpf(radius)
        delta = mpmath.asin(mpmath.sin(a) - (h_f - h) / rho)
        to_kink = rho * (mpmath.cos(a) - mpmath.cos(delta))
    gamma = mpmath.pi / 2 - delta + tau
    length = (h - r_e * (1 - mpmath.cos(gamma))) / mpmath.cos(delta - tau)
    x_r = to_kink - length * mpmath.sin(delta - tau) - r_e * mpmath.sin(gamma)
    assert abs(r_e * gamma - fillet.high) < 1e-14
    assert abs(length - (toprem.high - toprem.low)) < 1e-13
    assert abs(h_f * mpmath.tan(a) + x_r - land.start[0]) < 1e-13
    assert abs(flank.at(flank.low).z + h) < 1e-14


def crossing(piece: PlanePiece, z: float) -> float:
    """x of a piece (or its continuation) at a height, by bisection on z, which falls along it."""
    low, high = -50.0, 50.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if piece.at(middle).z > z else (low, middle)
    return piece.at(low).x


def removed(blade: MillBlade, plain: MillBlade, heights: Any) -> np.ndarray[Any, Any]:
    """How much further than a plain blade an edge reaches into the metal at heights over the tips."""

    def reach(of: MillBlade, height: float) -> float:
        for piece in of.outline[1:]:
            if piece.at(piece.high).z <= -height <= piece.at(piece.low).z:
                return crossing(piece, -height)
        raise AssertionError(height)

    return np.array([reach(blade, h) - reach(plain, h) for h in heights])


@pytest.mark.parametrize("curve", [None, CircularProfile(700.0, 6.0), ParabolicProfile(0.001, 6.0)])
def test_toprem_removes_more_at_the_root_and_nothing_above(curve: Any) -> None:
    plain = replace(PLAIN, profile=curve, edge_radius=0.5)
    with_toprem = replace(plain, toprem=Toprem(radians(5.0), 2.0))
    more = removed(with_toprem, plain, [0.6, 1.0, 1.9])
    assert (more > 0.0).all()
    assert (np.diff(more) < 0.0).all()
    assert removed(with_toprem, plain, [2.1, 7.0, 13.0]) == pytest.approx(0.0, abs=1e-12)
    if curve is None:  # a wedge: (h - y) (tan(a) - tan(a - tau))
        wedge = (2.0 - np.array([0.6, 1.0, 1.9])) * (np.tan(ANGLE) - np.tan(ANGLE - radians(5.0)))
        assert more == pytest.approx(wedge, abs=1e-12)


@pytest.mark.parametrize("curve", [None, CircularProfile(700.0, 6.0), ParabolicProfile(0.001, 6.0)])
@pytest.mark.parametrize(
    "flankrem", [Flankrem(9.0, angle=radians(3.0)), Flankrem(9.0, coefficient=0.005)], ids=repr
)
def test_flankrem_removes_more_at_the_tip_and_nothing_below(curve: Any, flankrem: Flankrem) -> None:
    plain = replace(PLAIN, profile=curve)
    relieved = replace(plain, flankrem=flankrem)
    more = removed(relieved, plain, [9.5, 11.0, 13.9])
    assert (more > 0.0).all()
    assert (np.diff(more) > 0.0).all()
    assert removed(relieved, plain, [1.0, 6.0, 8.9]) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("curve", "sign"),
    [
        (CircularProfile(700.0, 6.0), 1.0),
        (CircularProfile(-700.0, 6.0), -1.0),
        (ParabolicProfile(0.001, 6.0), 1.0),
        (ParabolicProfile(-0.001, 6.0), -1.0),
    ],
    ids=repr,
)
def test_a_positive_curve_crowns_the_tooth(curve: Any, sign: float) -> None:
    """More removed at root and tip of the tooth than at the reference height, or less if negative."""
    low, middle, high = removed(replace(PLAIN, profile=curve), PLAIN, [1.0, 6.0, 13.0])
    assert middle == pytest.approx(0.0, abs=1e-12)
    assert sign * low > 1e-3
    assert sign * high > 1e-3


def test_parabolic_flankrem_is_measured_off_the_flank(forty_digits: None) -> None:
    """c (s - b)**2 along the normal of the flank's vertex, on top of the blade's own parabola."""
    blade = replace(PLAIN, profile=ParabolicProfile(0.001, 6.0), flankrem=Flankrem(9.0, 0.0, 0.005))
    *_, flank = blade.outline
    s = np.linspace(flank.relief_from, flank.high, 7)
    x, z = meridian(blade, "flank", s)
    for length, px, pz in zip(s, x, z, strict=True):
        u = mpf(float(length))
        off = mpf(0.001) * u * u + mpf(0.005) * (u - mpf(flank.relief_from)) ** 2
        a = mpf(ANGLE)
        assert abs(6 * mpmath.tan(a) + u * mpmath.sin(a) + off * mpmath.cos(a) - px) < 2e-13
        assert abs(-6 - u * mpmath.cos(a) + off * mpmath.sin(a) - pz) < 2e-14


def test_plane_piece_and_edge_piece_are_one_form() -> None:
    """`PlanePiece.at` in plain floats, against edge_point with every term of the form at work."""
    piece = PlanePiece("flank", (0.3, -2.0), pi / 2 - ANGLE, -4, 9, 0.02, 0.003, 0.006, 1.5)
    edge = placed([piece], R_P, (1.0, 0.0))["flank"]
    s, h = np.linspace(-4.0, 9.0, 27), 1e-5
    point, along = (np.stack(np.broadcast_arrays(*v)) for v in edge_point(edge, s))
    for i, length in enumerate(s):
        at = piece.at(length)
        assert [R_P + at.x, at.z] == pytest.approx([point[0][i], point[2][i]], abs=1e-13)
        assert at.lean == pytest.approx(np.arctan2(along[0][i], -along[2][i]), abs=1e-14)
        assert at.speed == pytest.approx(np.hypot(along[0][i], along[2][i]), abs=1e-14)
        ahead, behind = piece.at(length + h).lean, piece.at(length - h).lean
        if abs(length - 1.5) > h:
            assert at.bend == pytest.approx((ahead - behind) / (2 * h), abs=1e-9)
