"""Face-mill head and cup-shaped wheel: Tsay & Lin 1993 (1)-(4), (6)-(13); Lin, Tsay & Fong 1996 (1)."""

from __future__ import annotations

import itertools
from dataclasses import replace
from math import cos, pi, radians, sin
from typing import Any

import numpy as np
import pytest

from hypoid.cutter import (
    BladeName,
    CircularProfile,
    EdgePiece,
    FaceMillHead,
    Flankrem,
    MillBlade,
    ParabolicProfile,
    Toprem,
    edge_point,
)
from hypoid.geometry import DesignError

Array = np.ndarray[Any, Any]

# a 9 in head, 17 and 28 deg as on the pinion of 1993; the rest is chosen to tell the sides apart
R_M, W, HEIGHT = 114.3, 2.54, 14.0
RHO = {"outer": 0.9, "inner": 0.6}
PSI = {"outer": radians(17.0), "inner": radians(28.0)}
HEAD = FaceMillHead.spread_blade(
    2 * R_M, W, PSI["outer"], PSI["inner"], HEIGHT, edge_radius=(RHO["outer"], RHO["inner"])
)
NAMES: tuple[BladeName, ...] = ("outer", "inner")
CROWNED = {
    "straight": None,
    "arc": CircularProfile(700.0, 6.0),
    "hollow arc": CircularProfile(-500.0, 5.0),
    "parabola": ParabolicProfile(0.0012, 6.0),
    "hollow parabola": ParabolicProfile(-0.0009, 7.0),
}
TOPREMS = {"no Toprem": None, "Toprem": Toprem(radians(4.0), 1.7)}
FLANKREMS = {
    "no Flankrem": None,
    "straight Flankrem": Flankrem(9.5, angle=radians(2.0)),
    "parabolic Flankrem": Flankrem(9.5, coefficient=0.004),
}


def edge(piece: EdgePiece, s: Any) -> tuple[Array, Array, Array]:
    """Points, unit normals out of the blade, and unit tangents (n, 3) of a piece at theta = 0."""
    point, along = (np.stack(np.broadcast_arrays(*v), axis=-1) for v in edge_point(piece, s))
    along = along / np.linalg.norm(along, axis=-1, keepdims=True)
    across = np.cross(along, [0.0, 1.0, 0.0])  # in the x-z plane, normal to the edge
    return point, across * np.sign(across @ np.array(piece.metal))[..., None], along


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("beta", [0.0, 0.4, pi / 2, -2.0])
def test_edge_arc_of_tsay_lin_6_7_10_11(name: BladeName, beta: float) -> None:
    """(6), (7) and, at beta = 90 deg, (1), (2); their normals (10), (11) point into the blade."""
    piece = HEAD.pieces(name)["fillet"]
    rho, psi = RHO[name], PSI[name]
    sign = 1.0 if name == "outer" else -1.0
    theta = np.linspace(0.0, pi / 2 - psi, 9)  # the range of the notes
    point, normal, _ = edge(piece.turned(pi / 2 - beta) if beta != pi / 2 else piece, rho * theta)
    x = R_M + sign * (W / 2 - rho * (1.0 - sin(psi)) / cos(psi) + rho * np.sin(theta))
    z = -rho * (1.0 - np.cos(theta))
    assert piece.high == pytest.approx(rho * theta[-1], abs=1e-14)
    expected = np.stack([x * sin(beta), x * cos(beta), z], axis=-1)
    assert point == pytest.approx(expected, abs=1e-12)
    if beta == pi / 2:
        inward = [-sign * np.sin(theta), 0.0 * theta, -np.cos(theta)]
        assert normal == pytest.approx(-np.stack(inward, axis=-1), abs=1e-13)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("beta", [0.0, 0.4, pi / 2, -2.0])
def test_straight_edge_of_tsay_lin_8_9_12_13(name: BladeName, beta: float) -> None:
    """(8), (9) and, at beta = 90 deg, (3), (4); U begins where the edge arc ends."""
    piece = HEAD.pieces(name)["flank"].turned(pi / 2 - beta)
    rho, psi = RHO[name], PSI[name]
    sign = 1.0 if name == "outer" else -1.0
    u = np.linspace(0.0, 12.0, 7)
    point, along = edge_point(piece, piece.low + u)
    drop = rho * (1.0 - sin(psi)) / cos(psi)
    x = R_M + sign * (W / 2 + drop * sin(psi) + u * sin(psi))
    z = -rho * (1.0 - sin(psi)) - u * cos(psi)
    expected = np.stack([x * sin(beta), x * cos(beta), z], axis=-1)
    assert np.stack(point, axis=-1) == pytest.approx(expected, abs=1e-12)
    inward = np.array([-sign * cos(psi) * sin(beta), -sign * cos(psi) * cos(beta), -sin(psi)])
    assert np.array(piece.metal) == pytest.approx(-inward, abs=1e-13)
    assert np.stack(np.broadcast_arrays(*along), axis=-1) @ inward == pytest.approx(0, abs=1e-14)


@pytest.mark.parametrize("name", NAMES)
def test_cup_shaped_wheel_of_lin_1(name: BladeName) -> None:
    """(1) with u from the sharp corner, and its normal, dR/du x dR/dbeta, along the edge's metal."""
    head = FaceMillHead.spread_blade(2 * R_M, W, PSI["outer"], PSI["inner"], HEIGHT)
    pieces, psi, sign = head.pieces(name), PSI[name], 1.0 if name == "outer" else -1.0
    assert list(pieces) == ["land", "flank"]
    flank = pieces["flank"]
    assert flank.low == pytest.approx(0.0, abs=1e-14)
    u = np.linspace(flank.low, flank.high, 6)
    point, normal, along = edge(flank, u)
    x = R_M + sign * (W / 2 + u * sin(psi))
    expected = np.stack([x, 0 * u, -u * cos(psi)], axis=-1)
    assert point == pytest.approx(expected, abs=1e-12)
    by_beta = np.stack([0 * u, -x, 0 * u], axis=-1)  # at beta = 90 deg
    n = np.cross(along, by_beta)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    assert np.abs(np.sum(n * normal, axis=-1)) == pytest.approx(1.0, abs=1e-13)
    assert np.array(flank.metal)[0] * sign > 0.8  # +rho outside, -rho inside
    assert point[-1, 2] == pytest.approx(-HEIGHT, abs=1e-13)


@pytest.mark.parametrize("flankrem", FLANKREMS.values(), ids=FLANKREMS)
@pytest.mark.parametrize("toprem", TOPREMS.values(), ids=TOPREMS)
@pytest.mark.parametrize("curve", CROWNED.values(), ids=CROWNED)
@pytest.mark.parametrize("name", NAMES)
def test_pieces_join_from_tip_to_shank(
    name: BladeName, curve: Any, toprem: Toprem | None, flankrem: Flankrem | None
) -> None:
    """One chain of points; one tangent but at the kinks, which have the angles that were asked for."""
    head = FaceMillHead.spread_blade(
        2 * R_M,
        W,
        PSI["outer"],
        PSI["inner"],
        HEIGHT,
        edge_radius=0.7,
        profile=curve,
        toprem=toprem,
        flankrem=flankrem,
    )
    pieces = head.pieces(name)
    expected = ["land", "fillet", "toprem", "flank", "flankrem"]
    if toprem is None:
        expected.remove("toprem")
    if flankrem is None or flankrem.coefficient:  # a parabola is a relief of the flank itself
        expected.remove("flankrem")
    assert list(pieces) == expected
    for first, second in itertools.pairwise(expected):
        end, _, along = edge(pieces[first], np.array(pieces[first].high))
        start, _, goes_on = edge(pieces[second], np.array(pieces[second].low))
        assert start == pytest.approx(end, abs=1e-13)
        kink = 0.0
        if (first, second) == ("toprem", "flank") and toprem:
            kink = toprem.angle
        if (first, second) == ("flank", "flankrem") and flankrem:
            kink = flankrem.angle
        metal = np.array(pieces[second].metal)
        turned = np.arctan2(goes_on @ edge(pieces[first], pieces[first].high)[1], goes_on @ along)
        assert turned == pytest.approx(kink, abs=1e-13)  # towards the metal
        assert edge(pieces[second], pieces[second].low)[1] @ metal > 0.9
    side = 1.0 if name == "outer" else -1.0
    tip, _, _ = edge(pieces["land"], pieces["land"].low)
    assert tip == pytest.approx([R_M, 0.0, 0.0], abs=1e-12)  # lands meet in the middle of the slot
    shank, _, _ = edge(pieces[expected[-1]], pieces[expected[-1]].high)
    assert shank[2] == pytest.approx(-HEIGHT, abs=1e-13)
    assert side * (shank[0] - R_M) > 0.0


@pytest.mark.parametrize("name", NAMES)
def test_point_diameters_make_the_same_head(name: BladeName) -> None:
    head = FaceMillHead.from_point_diameters(
        2 * R_M + W, 2 * R_M - W, PSI["outer"], PSI["inner"], HEIGHT, edge_radius=(0.9, 0.6)
    )
    for key, piece in head.pieces(name).items():
        ours, theirs = (
            np.hstack([p.start, p.tangent, p.low, p.high]) for p in (piece, HEAD.pieces(name)[key])
        )
        assert ours == pytest.approx(theirs, abs=1e-12)


def test_single_side_needs_no_other_blade() -> None:
    outer = HEAD.outer
    assert outer is not None
    alone = FaceMillHead(outer=outer)
    assert alone.faults() == []
    assert alone.pieces("outer") == HEAD.pieces("outer")
    with pytest.raises(DesignError) as caught:
        alone.pieces("inner")
    assert [p.path for p in caught.value.problems] == ["cutter.inner"]


def test_a_blade_scales_with_its_measures() -> None:
    """Every length by k: the edge by k, its curvature by 1/k."""
    k, blade = 1.7, HEAD.outer
    assert blade is not None
    blade = replace(
        blade,
        profile=CircularProfile(700.0, 6.0),
        toprem=TOPREMS["Toprem"],
        flankrem=FLANKREMS["parabolic Flankrem"],
    )
    assert blade.toprem is not None
    assert blade.flankrem is not None
    larger = MillBlade(
        "outer",
        k * blade.point_radius,
        blade.angle,
        k * blade.edge_radius,
        k * blade.land,
        k * blade.height,
        CircularProfile(k * 700.0, k * 6.0),
        Toprem(blade.toprem.angle, k * blade.toprem.height),
        Flankrem(k * blade.flankrem.height, coefficient=blade.flankrem.coefficient / k),
    )
    for small, large in zip(blade.outline, larger.outline, strict=True):
        for share in (0.0, 0.3, 1.0):
            here = small.at(small.low + share * (small.high - small.low))
            there = large.at(large.low + share * (large.high - large.low))
            assert [there.x, there.z] == pytest.approx([k * here.x, k * here.z], abs=1e-12)
