"""Laws that every flank keeps, whatever cuts it: one row a kind of cutting."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import mpmath
import numpy as np
import pytest
from independent import Envelope

from hypoid.design import ExactFaceHobbedSpec, TipRelief, build
from hypoid.flank import Flank
from hypoid.pair import GearPair

Array = np.ndarray[Any, Any]
NAMES = ("pinion concave", "pinion convex", "wheel concave", "wheel convex")
KINDS = ("plain", "relief", "right-hand", "tilted", "moving")


@pytest.fixture(params=[(k, n) for k in KINDS for n in NAMES], ids=lambda p: f"{p[0]}-{p[1]}")
def flank(request: pytest.FixtureRequest, flank_of: Callable[[str, str], Flank]) -> Flank:
    return flank_of(*request.param)


def cutter_points(flank: Flank, piece: str) -> tuple[Array, Array]:
    """s and theta all over an edge piece, where it cuts the blank."""
    edge, start = flank.pieces[piece], flank.theta_start
    s = np.linspace(float(edge.low), float(edge.high), 11)[1:-1]
    grid = np.meshgrid(s, start + np.linspace(-0.04, 0.04, 5), indexing="ij")
    return grid[0].ravel(), grid[1].ravel()


@pytest.mark.parametrize("piece", ["flank", "fillet"])
def test_normal_is_unit_and_orthogonal_to_both_tangents(flank: Flank, piece: str) -> None:
    s, theta = cutter_points(flank, piece)
    normal = flank.at_cutter(s, theta, piece)[1]
    assert np.linalg.norm(normal, axis=1) == pytest.approx(1.0, abs=1e-14)
    h = 1e-4
    for ds, dt in ((h, 0.0), (0.0, h)):
        # fourth order: what is left is rounding, 1e-12
        ends = [flank.at_cutter(s + k * ds, theta + k * dt, piece)[0] for k in (1, -1, 2, -2)]
        tangent = (8.0 * (ends[0] - ends[1]) - (ends[2] - ends[3])) / (12.0 * h)
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        assert np.abs((tangent * normal).sum(axis=1)).max() < 2e-9


def test_every_point_meshes(flank: Flank, forty_digits: None) -> None:
    """n . dr/dphi = 0 by 40-digit differences of the plain chain; same point, same normal."""
    for piece in ("flank", "fillet"):
        exact = Envelope(flank.settings, flank.pieces[piece])
        s, theta = (v[[4, 39]] for v in cutter_points(flank, piece))
        position, normal = flank.at_cutter(s, theta, piece)
        if flank.mirrored:
            position, normal = position * [1, -1, 1], normal * [1, -1, 1]
        for i in range(2):
            at = mpmath.mpf(s[i]), mpmath.mpf(theta[i])
            phi = exact.root(*at, 0.0)
            assert abs(phi) < 0.6  # the root on the tooth
            point, n = exact.patch(*at, phi)
            assert mpmath.norm(point - mpmath.matrix(position[i])) < 1e-9
            sine = mpmath.norm(n - mpmath.matrix(normal[i]) * mpmath.fdot(n, normal[i]))
            assert sine < 1e-11


def test_at_returns_the_place_that_was_asked(flank: Flank) -> None:
    distance, height = (g.ravel() for g in flank.grid(13, 9))
    z, rho = flank.cone.axial_radial(distance, height)
    points = flank.at(z, rho)
    if flank.settings.plain_roll and flank.settings.tilt_angle == 0.0:
        assert points.ok.all()  # exactly as designed
    assert points.ok.mean() > 0.85
    points, z, rho, height = (
        flank.at(z[points.ok], rho[points.ok]),
        *(v[points.ok] for v in (z, rho, height)),
    )
    assert points.position[:, 2] == pytest.approx(z, abs=1e-9, rel=0)
    # next to the root land the equations have a double root: 1e-6 mm there
    near = (points.piece == 1) & (points.s < 0.05)
    radius = np.hypot(*points.position[:, :2].T)
    assert radius[~near] == pytest.approx(rho[~near], abs=1e-9, rel=0)
    assert radius[near] == pytest.approx(rho[near], abs=1e-6, rel=0)
    for index, piece in enumerate(("flank", "fillet")):  # and is a point of the edge that it names
        mine = points.piece == index
        assert mine.any()
        again, normal = flank.at_cutter(points.s[mine], points.theta[mine], piece)
        assert again == pytest.approx(points.position[mine], abs=1e-12, rel=0)
        assert normal == pytest.approx(points.normal[mine], abs=1e-12, rel=0)


def test_normals_point_out_of_the_tooth(flank: Flank, variant: Callable[[str], GearPair]) -> None:
    """Concave flanks look to -y on a left-hand member, convex ones to +y, tooth metal between."""
    middle = 0.5 * (flank.toe + flank.heel)
    point = flank.at_cone(middle, 0.3)
    around = np.array([-point.position[0, 1], point.position[0, 0], 0.0])
    wanted = (-1.0 if flank.side == "concave" else 1.0) * (-1.0 if flank.mirrored else 1.0)
    assert np.sign(point.normal[0] @ around) == wanted


@pytest.mark.parametrize("kind", KINDS)
def test_one_tooth_lies_between_its_flanks(variant: Callable[[str], GearPair], kind: str) -> None:
    """Thickness positive from root to tip, more at the root, and less than the pitch."""
    pair = variant(kind)
    for member in (pair.pinion, pair.wheel):
        flank = member.concave
        distance, height = (g.ravel() for g in flank.grid(9, 7))
        angle = []
        for side in (member.concave, member.convex):
            points = side.at_cone(distance, height)
            assert points.ok.mean() > 0.85
            angle.append(np.arctan2(points.position[:, 1], points.position[:, 0]))
        hand = -1.0 if flank.mirrored else 1.0
        tooth = (hand * (angle[1] - angle[0]) + np.pi) % (2.0 * np.pi) - np.pi
        assert np.nanmin(tooth) > 0.0
        assert np.nanmax(tooth) < 2.0 * np.pi / member.teeth
        thinner = np.diff(tooth.reshape(9, 7), axis=0)  # from root to tip
        assert np.nanmax(thinner) < 0.0


def test_tooth_thickness_at_the_pitch_point(paper_pair: GearPair) -> None:
    """No backlash, no thickness factor: half the pitch at the mean point of both members."""
    for member in (paper_pair.pinion, paper_pair.wheel):
        distance = member.blank.mean_cone_distance
        position, _ = member.convex.at_cutter([0.0], [member.convex.theta_start])
        sign = -1.0 if member.convex.mirrored else 1.0
        angle = sign * np.arctan2(position[0, 1], position[0, 0])
        assert angle == pytest.approx(np.pi / member.teeth, abs=1e-12)
        assert member.concave.at_cone(distance, 0.0).position[0, 1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_other_hand_is_the_mirror_image(flank_of: Callable[[str, str], Flank], name: str) -> None:
    left, right = flank_of("plain", name), flank_of("right-hand", name)
    distance, height = (g.ravel() for g in left.grid(9, 7))
    a, b = left.at_cone(distance, height), right.at_cone(distance, height)
    mirror = np.array([1.0, -1.0, 1.0])
    assert b.position == pytest.approx(a.position * mirror, abs=1e-12, rel=0)
    assert b.normal == pytest.approx(a.normal * mirror, abs=1e-12, rel=0)
    assert b.principal_curvatures == pytest.approx(a.principal_curvatures, abs=1e-13)
    assert b.principal_directions == pytest.approx(a.principal_directions * mirror, abs=1e-9)


@pytest.mark.parametrize("relief", [None, TipRelief(0.004, 1.5, "tip", "both")])
def test_a_pair_k_times_as_large_has_flanks_k_times_as_large(
    table_1_spec: ExactFaceHobbedSpec, relief: TipRelief | None
) -> None:
    k = 1.7
    larger = None
    if relief is not None:
        larger = replace(relief, coefficient=relief.coefficient / k, height=k * relief.height)
    spec = replace(table_1_spec, tip_relief=relief)
    lengths = ("offset", "wheel_mean_radius", "wheel_face_width", "cutter_radius")
    scaled = {name: k * getattr(spec, name) for name in lengths}
    one, many = build(spec), build(replace(spec, tip_relief=larger, **scaled))
    for a, b in zip(one.flanks(), many.flanks(), strict=True):
        distance, height = (g.ravel() for g in a.grid(7, 7))
        middle = 0.5 * (a.toe + a.heel)  # ends apart: face widths are rounded
        distance = middle + 0.9 * (distance - middle)
        height = np.maximum(height, a.root.at(0.0) + 0.01)
        p, q = a.at_cone(distance, height), b.at_cone(k * distance, k * height)
        assert q.ok.all()
        assert q.position == pytest.approx(k * p.position, abs=2e-8, rel=0)
        assert q.normal == pytest.approx(p.normal, abs=1e-8)
        assert k * q.principal_curvatures == pytest.approx(p.principal_curvatures, rel=1e-6)
