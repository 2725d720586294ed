"""Compiled kinematics against matrices, and the meshing condition against 40-digit differences."""

from __future__ import annotations

from dataclasses import fields
from functools import cache
from typing import Any

import jax
import mpmath
import numpy as np
import pytest
from independent import Envelope, carried

from hypoid.cutter import EdgePiece, edge_point
from hypoid.geometry import turn_z
from hypoid.machine import (
    Cam,
    MachineSettings,
    Meshing,
    Motions,
    chain,
    generator,
    mesh_closed,
    meshing_function,
    place,
    place_plain,
    sweep,
    to_cradle,
)

Array = np.ndarray[Any, Any]


def random_cam(rng: np.random.Generator) -> Cam:
    return Cam(381.0, rng.uniform(50, 80), rng.uniform(-5, 5), rng.uniform(-0.1, 0.1), 0.37)


def random_settings(rng: np.random.Generator, plain: bool = False) -> MachineSettings:
    """Any machine: tilt, swivel and, unless plain, every motion there is."""
    moving: dict[str, Any] = {}
    if not plain:
        moving = {
            "helical_motion": rng.uniform(-5, 5),
            "modified_roll": tuple(rng.uniform(-0.1, 0.1, rng.integers(0, 6))),
            "motions": Motions(
                **{
                    f.name: tuple(rng.uniform(-0.3, 0.3, rng.integers(0, 7)))
                    for f in fields(Motions)
                }
            ),
            "cutter_lead": rng.uniform(-2, 2),
            "cam": random_cam(rng) if rng.uniform() < 0.5 else None,
        }
    return MachineSettings(
        radial_distance=rng.uniform(50, 200),
        cradle_angle=rng.uniform(-2, 2),
        machine_root_angle=rng.uniform(-0.2, 1.5),
        ratio_of_roll=rng.uniform(1, 13),
        roll_to_blade_ratio=rng.uniform(0.05, 1),
        tilt_angle=rng.uniform(-0.5, 0.5),
        swivel_angle=rng.uniform(-3, 3),
        blank_offset=rng.uniform(-60, 60),
        machine_center_to_back=rng.uniform(-20, 20),
        sliding_base=rng.uniform(-20, 20),
        **moving,
    )


def random_piece(rng: np.random.Generator) -> EdgePiece:
    tangent, other = np.linalg.qr(rng.normal(size=(3, 2)))[0].T
    start = np.array([rng.uniform(50, 120), rng.uniform(-5, 5), rng.uniform(-3, 3)])
    return EdgePiece(
        start=tuple(start),
        tangent=tuple(tangent),
        metal=tuple(other),
        curvature=rng.choice([0.0, -1.0, 0.002]),
        relief=0.004,
        relief_from=0.7,
        low=-3.0,
        high=3.0,
    )


@cache
def kinematics(plain: bool) -> Any:
    """Point in the member's frame, F and normal at any s, theta, phi, as the package computes them."""

    def run(gen: Any, piece: EdgePiece, s: Any, theta: Any, phi: Any) -> Any:
        edge = sweep(gen, piece, s, theta)
        mesh = Meshing(jax.numpy.cos(phi), jax.numpy.sin(phi), 1.0 + 0.0 * phi, 1.0 + 0.0 * phi)
        on_cradle = to_cradle(gen, edge)
        at = place_plain(gen, on_cradle, theta, mesh) if plain else place(gen, edge, theta, phi)
        point = turn_z(jax.numpy.cos(at.turn), -jax.numpy.sin(at.turn), at.point)
        roots = [mesh_closed(gen, on_cradle, branch) for branch in (1.0, -1.0)]
        closed = [(r.cosine, r.sine, r.slope, r.discriminant) for r in roots]
        return point, meshing_function(gen, edge, phi)[0], closed

    return jax.jit(run)  # not kept on disk: a test must run what it tests


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("plain", [True, False], ids=["plain roll", "moving axes"])
def test_compiled_motions_are_the_matrices(seed: int, plain: bool) -> None:
    """Three ways for one chain: compiled, 4 x 4 matrices, motion by motion."""
    rng = np.random.default_rng(seed)
    settings, piece = random_settings(rng, plain), random_piece(rng)
    s, theta, phi = rng.uniform(-3, 3, 8), rng.uniform(-1, 1, 8), rng.uniform(-0.6, 0.6, 8)
    point, _, _ = kinematics(plain)(generator(settings), piece, s, theta, phi)
    edge = np.stack(edge_point(piece, s)[0])
    for i in range(8):
        matrix = chain(settings, theta[i], phi[i])
        assert matrix[:3, :3] @ matrix[:3, :3].T == pytest.approx(np.eye(3), abs=1e-14)
        by_matrices = (matrix @ np.append(edge[:, i], 1.0))[:3]
        by_motions = carried(settings, edge[:, i], theta[i], phi[i])
        assert np.array(point)[:, i] == pytest.approx(by_matrices, abs=1e-11, rel=0)
        assert np.array(by_motions) == pytest.approx(by_matrices, abs=1e-11, rel=0)


@pytest.mark.parametrize("seed", range(4))
def test_meshing_function_is_n_dr_dphi(seed: int, forty_digits: None) -> None:
    """F by screw velocities, sign and size, at any phi: not only where it vanishes."""
    rng = np.random.default_rng(100 + seed)
    settings, piece = random_settings(rng), random_piece(rng)
    s, theta, phi = rng.uniform(-3, 3, 8), rng.uniform(-1, 1, 8), rng.uniform(-0.6, 0.6, 8)
    _, value, _ = kinematics(False)(generator(settings), piece, s, theta, phi)
    exact = Envelope(settings, piece)
    for i in range(4):
        triple, scale = exact.meshing(*(mpmath.mpf(v[i]) for v in (s, theta, phi)))
        assert abs(triple - float(value[i])) < 1e-11 * scale


@pytest.mark.parametrize("seed", range(6))
def test_both_closed_roots_mesh(seed: int, forty_digits: None) -> None:
    """A cos(phi) + B sin(phi) + C = 0: n . dr/dphi is nil at both roots, dF/dphi = +-Q there."""
    rng = np.random.default_rng(200 + seed)
    settings, piece = random_settings(rng, plain=True), random_piece(rng)
    s, theta = rng.uniform(-3, 3, 8), rng.uniform(-1, 1, 8)
    _, _, closed = kinematics(True)(generator(settings), piece, s, theta, 0.0 * s)
    exact, met = Envelope(settings, piece), 0
    for cosine, sine, slope, discriminant in closed:
        for i in np.flatnonzero(np.asarray(discriminant) > 0.0)[:2]:
            at = mpmath.mpf(s[i]), mpmath.mpf(theta[i])
            phi = mpmath.mpf(float(np.arctan2(sine[i], cosine[i])))
            value, scale = exact.meshing(*at, phi)
            assert abs(value) < 1e-9 * scale
            h = mpmath.mpf("1e-10")
            ahead, behind = (exact.meshing(*at, phi + d)[0] for d in (h, -h))
            assert abs((ahead - behind) / (2 * h) - float(slope[i])) < 1e-9 * scale
            met += 1
    assert met > 0
