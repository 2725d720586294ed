"""Principal curvatures against 40-digit differences, Euler's law and the field's sign."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from independent import Envelope

from hypoid.flank import Flank

Array = np.ndarray[Any, Any]
NAMES = ("pinion concave", "pinion convex", "wheel concave", "wheel convex")
CASES = [("plain", n) for n in NAMES] + [("relief", NAMES[0]), ("tilted", NAMES[1])]
CASES += [("moving", NAMES[0]), ("right-hand", NAMES[3])]


@pytest.mark.parametrize(("kind", "name"), CASES)
def test_against_forty_digit_differences_of_normals(
    flank_of: Callable[[str, str], Flank], forty_digits: None, kind: str, name: str
) -> None:
    flank = flank_of(kind, name)
    middle, tip = 0.5 * (flank.toe + flank.heel), flank.tip.at(0.0)
    points = flank.at_cone(
        [middle, middle + 9.0, middle], [0.2, 0.8 * tip, flank.root.at(0.0) + 0.2]
    )
    assert points.ok[:2].all()  # the third place may lie below a tilted head's root
    for i in np.flatnonzero(points.ok):
        exact = Envelope(flank.settings, flank.pieces[("flank", "fillet")[points.piece[i]]], 1e-15)
        s, theta, h = mpmath.mpf(points.s[i]), mpmath.mpf(points.theta[i]), mpmath.mpf("1e-6")
        sign = np.array([1.0, -1.0 if flank.mirrored else 1.0, 1.0])
        phi = exact.root(s, theta, 0.0)
        ends = [(s + h, theta), (s - h, theta), (s, theta + h), (s, theta - h)]
        r, n = zip(*(exact.patch(*e, phi) for e in ends), strict=True)
        outward = mpmath.sign(mpmath.fdot(n[0], points.normal[i] * sign))
        r_s, r_t = (r[0] - r[1]) / (2 * h), (r[2] - r[3]) / (2 * h)
        n_s, n_t = (outward * (a - b) / (2 * h) for a, b in (n[:2], n[2:]))

        def form(a: Any, b: Any, c: Any, d: Any) -> Array:
            """Inner products of (a, b) with (c, d), in float64."""
            return np.array(
                [[float(mpmath.fdot(list(u), list(v))) for v in (c, d)] for u in (a, b)]
            )

        shape = np.linalg.solve(form(r_s, r_t, r_s, r_t), form(r_s, r_t, n_s, n_t))
        expected = np.sort(np.linalg.eigvals(shape).real)[::-1]
        assert points.principal_curvatures[i] == pytest.approx(expected, rel=2e-8, abs=1e-10)


@pytest.mark.parametrize("name", NAMES)
def test_euler_in_any_direction(flank_of: Callable[[str, str], Flank], name: str) -> None:
    """k_n = k1 cos2 + k2 sin2, from the second derivative of curves on the surface."""
    flank = flank_of("plain", name)
    rng = np.random.default_rng(3)
    middle = 0.5 * (flank.toe + flank.heel)
    points = flank.at_cone(rng.uniform(middle - 8, middle + 8, 20), rng.uniform(-1.0, 2.0, 20))
    assert (points.piece == 0).all()
    first, second = points.principal_directions.transpose(1, 0, 2)
    for a, b in ((first, first), (second, second), (points.normal, points.normal)):
        assert (a * b).sum(axis=1) == pytest.approx(1.0, abs=1e-12)
    for a, b in ((first, second), (first, points.normal), (second, points.normal)):
        assert np.abs((a * b).sum(axis=1)).max() < 1e-12
    turn = rng.uniform(0, np.pi, 20)
    ds, dt = 2e-3 * np.cos(turn), 3e-5 * np.sin(turn)
    ends = [flank.at_cutter(points.s + k * ds, points.theta + k * dt)[0] for k in (-1, 0, 1)]
    velocity, bend = 0.5 * (ends[2] - ends[0]), ends[2] - 2.0 * ends[1] + ends[0]
    square = (velocity**2).sum(axis=1)
    measured = -(bend * points.normal).sum(axis=1) / square
    cosine = (velocity * first).sum(axis=1) / np.sqrt(square)
    k1, k2 = points.principal_curvatures.T
    assert measured == pytest.approx(k1 * cosine**2 + k2 * (1.0 - cosine**2), abs=2e-6)


def test_sign_lengthwise(flank_of: Callable[[str, str], Flank]) -> None:
    """Along the tooth line the convex flanks bulge, the wheel's concave one is hollow.

    The pinion's concave flank bulges, too: at 65 deg its tooth winds about the axis as a worm's.
    """
    for name in NAMES:
        flank = flank_of("plain", name)
        distance = np.linspace(flank.toe + 1, flank.heel - 1, 7)
        points = flank.at_cone(distance, 0.0 * distance)
        x, y = (points.position[:, :2] / np.hypot(*points.position[:, :2].T)[:, None]).T
        up = np.stack([flank.cone.cosine * x, flank.cone.cosine * y, 0.0 * x - flank.cone.sine], 1)
        line = np.cross(points.normal, up)
        line /= np.linalg.norm(line, axis=1, keepdims=True)
        share = (points.principal_directions * line[:, None, :]).sum(axis=2) ** 2
        lengthwise = (points.principal_curvatures * share).sum(axis=1)
        assert (np.sign(lengthwise) == (-1.0 if name == "wheel concave" else 1.0)).all(), name
