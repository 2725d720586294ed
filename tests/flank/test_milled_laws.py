"""What holds for every cutter, motion and method of face milling (issue of the face-milled gears)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import mpmath
import numpy as np
import pytest
from independent import Envelope, carried, edge_mp
from milled import CUTTERS, METHODS, mill_sweep, milled, settings_of

from hypoid.cutter import EdgePiece
from hypoid.flank import Flank, cut_flank
from hypoid.machine import MachineSettings, Motions, generator, mesh_straight

Array = np.ndarray[Any, Any]
ALL = [(c, m) for c in CUTTERS for m in METHODS]
ROLLING = [m for m in METHODS if settings_of(m).generated]


def side_of(cutter: str, method: str) -> Any:
    """Both sides in turn, so that each cutter and each method has seen both."""
    return ("concave", "convex")[(list(CUTTERS).index(cutter) + list(METHODS).index(method)) % 2]


def places(flank: Flank, rows: int = 6, columns: int = 5) -> tuple[Array, Array]:
    """(S, H) over flank and fillet, from just above what the edge reaches to the tip."""
    distance = np.linspace(flank.toe, flank.heel, columns)
    lowest = flank.charts[flank.cut_pieces[-1]]
    low = np.maximum(lowest.bounds(distance)[0], flank.root.at(distance)) + 0.05
    height = low + np.outer(np.linspace(0.0, 1.0, rows), flank.tip.at(distance) - low)
    return np.broadcast_to(distance, height.shape).ravel(), height.ravel()


@pytest.mark.parametrize(("cutter", "method"), ALL)
def test_points_are_where_they_are_asked_for(cutter: str, method: str) -> None:
    flank = milled(cutter, method, side_of(cutter, method))
    distance, height = places(flank)
    points = flank.at_cone(distance, height)
    assert points.ok.all()
    rho = np.hypot(*points.position[:, :2].T)
    reached = flank.cone.cone_distance_height(points.position[:, 2], rho)
    assert np.abs(np.array(reached) - [distance, height]).max() < 1e-9
    seen = {flank.cut_pieces[k] for k in points.piece}
    assert seen == set(flank.cut_pieces)


@pytest.mark.parametrize(("cutter", "method"), ALL)
def test_normal_is_orthogonal_to_both_tangents(cutter: str, method: str) -> None:
    """By central differences of the points themselves."""
    flank = milled(cutter, method, side_of(cutter, method))
    points = flank.at_cone(*places(flank))
    h = 1e-5
    for index, name in enumerate(flank.cut_pieces):
        mine = points.piece == index
        s, turn = points.s[mine], points.theta[mine]
        for ds, dt in ((h, 0.0), (0.0, h)):
            ahead, _ = flank.at_cutter(s + ds, turn + dt, name)
            behind, _ = flank.at_cutter(s - ds, turn - dt, name)
            tangent = (ahead - behind) / np.linalg.norm(ahead - behind, axis=1)[:, None]
            assert np.abs((tangent * points.normal[mine]).sum(axis=1)).max() < 1e-6


def cutter_turn(
    settings: MachineSettings, piece: EdgePiece, s: float, phi: float, at: Array
) -> Any:
    """The cutter turn that brings an edge point to a place, by search on the plain chain."""
    theta = np.linspace(-np.pi, np.pi, 20001)
    edge = [float(c) for c in edge_mp(piece, s)]
    apart = np.linalg.norm(np.array(carried(settings, edge, theta, phi)).T - at, axis=1)
    return theta[np.argmin(apart)]


@pytest.mark.parametrize("method", ROLLING)
def test_n_dr_dphi_is_zero(method: str, forty_digits: None) -> None:
    """The same point and normal from 40-digit differences of the plain chain at that cradle angle.

    Fillet, flank and tip; on the straight edge the form that is linear in u leads back to it.
    """
    flank = milled("straight", method)
    points = flank.at_cone(*places(flank, 3, 2))
    for k in (0, 2, 5):
        piece = flank.pieces[flank.cut_pieces[points.piece[k]]]
        s, phi = mpmath.mpf(points.s[k]), mpmath.mpf(points.theta[k])
        exact = Envelope(flank.settings, piece)
        near = cutter_turn(flank.settings, piece, points.s[k], points.theta[k], points.position[k])
        theta = mpmath.findroot(lambda t: exact.meshing(s, t, phi)[0], (near, near + 1e-6))  # noqa: B023
        assert mpmath.norm(exact.swept(s, theta, phi) - mpmath.matrix(points.position[k])) < 1e-9
        _, normal = exact.patch(s, theta, phi)
        assert 1.0 - abs(mpmath.fdot(normal, points.normal[k])) < 1e-15
        if piece is flank.pieces["flank"]:  # and back: along a straight edge meshing is linear
            found = mesh_straight(generator(flank.settings), piece, float(theta), float(phi))
            assert float(found) == pytest.approx(points.s[k], abs=1e-9)


@pytest.mark.parametrize(
    ("method", "way"),
    [
        *[(m, "newton") for m in ROLLING],
        *[(m, "cradle") for m in ROLLING if settings_of(m).plain_roll],
    ],
)
@pytest.mark.parametrize("side", ["concave", "convex"])
def test_closed_in_theta_against_the_other_ways(method: str, side: Any, way: Any) -> None:
    """One surface by three ways: closed in theta, closed in phi (plain roll), Newton; 1e-9 mm."""
    best = milled("straight", method, side)
    assert best.surface.way == "cutter"
    other = milled("straight", method, side, way=way)
    a, b = (flank.at_cone(*places(best)) for flank in (best, other))
    assert a.ok.all()
    assert b.ok.all()
    assert np.abs(a.position - b.position).max() < 1e-9
    assert np.abs(a.normal - b.normal).max() < 1e-10


@pytest.mark.parametrize("method", METHODS)
def test_the_other_hand_is_the_mirror_image(method: str) -> None:
    left, right = milled("straight", method), milled("straight", method, mirrored=True)
    a, b = (flank.at_cone(*places(left)) for flank in (left, right))
    mirror = [1.0, -1.0, 1.0]
    assert np.abs(a.position * mirror - b.position).max() < 1e-9
    assert np.abs(a.normal * mirror - b.normal).max() < 1e-11
    assert np.abs(a.principal_curvatures - b.principal_curvatures).max() < 1e-8


@pytest.mark.parametrize(("cutter", "method"), [*[(c, "all axes") for c in CUTTERS], *ALL[:8]])
def test_k_times_as_large_is_k_times_as_large(cutter: str, method: str) -> None:
    k = 1.7
    one, many = milled(cutter, method), milled(cutter, method, size=k)
    distance, height = places(one)
    a, b = one.at_cone(distance, height), many.at_cone(k * distance, k * height)
    assert a.ok.all()
    assert b.ok.all()
    assert np.abs(k * a.position - b.position).max() < 1e-8
    assert np.abs(a.normal - b.normal).max() < 1e-9


def test_motions_of_size_zero_are_the_plain_method() -> None:
    plain = milled("straight", "generated")
    nothing = (1e-300,) * 6  # not zero, so that the axes are there to move
    settings = replace(
        plain.settings,
        modified_roll=(0.0,) * 5,
        motions=Motions(nothing, nothing, nothing, nothing, nothing, nothing, nothing),
    )
    assert not settings.plain_roll
    still = cut_flank(
        "pinion", plain.side, settings, plain.pieces, plain.cone, mirrored=False, toe=plain.toe,
        heel=plain.heel, tip=plain.tip, root=plain.root, way="cutter",
    )  # fmt: skip
    a, b = (flank.at_cone(*places(plain)) for flank in (plain, still))
    assert np.abs(a.position - b.position).max() < 1e-10
    assert np.abs(a.normal - b.normal).max() < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize(
    ("cutter", "method"),
    [*[("straight", m) for m in ROLLING if m != "cam"], *[(c, "modified roll") for c in CUTTERS]],
)
def test_the_sweep_never_penetrates_the_finished_flank(cutter: str, method: str) -> None:
    """Brute force: all that the blade sweeps, with no meshing condition, ends at the flank (1e-6 mm)."""
    side = side_of(cutter, method)
    flank = milled(cutter, method, side)
    sweep = mill_sweep(cutter, flank)
    for distance in (flank.toe, 0.5 * (flank.toe + flank.heel), flank.heel):
        low = max(float(flank.charts["fillet"].bounds(distance)[0]), flank.root.at(distance)) + 0.05
        heights = np.linspace(low, flank.tip.at(distance), 5)
        points = flank.at_cone(np.full(5, distance), heights)
        assert points.ok.all()
        cut = sweep.boundary(distance, heights, side)
        x, y, _ = points.position.T
        around = np.stack([-y, x, 0.0 * x], axis=1)
        apart = np.angle(np.exp(1j * (cut - np.arctan2(y, x))))
        assert np.abs(apart * (around * points.normal).sum(axis=1)).max() < 1e-6
