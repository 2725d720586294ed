"""Rates and times, measured and never asserted: `make bench`.

Point rates stand beside the machine's matrix products, so that they can be compared elsewhere.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hypoid
from hypoid.contact import Misalignment, Sampling, contacts, unloaded_contact
from hypoid.pair import GearPair

EXAMPLE = Path(__file__).parent.parent / "examples" / "gonzalez-fuentes-2022.toml"
POINTS = 1_000_000
FLANKS = ("pinion concave", "pinion convex", "wheel concave", "wheel convex")
LIKE_THE_ISSUE = Sampling(positions_per_pitch=10, pitches=2, pairs=5, columns=61, rows=31)


@pytest.fixture(scope="module")
def pair() -> GearPair:
    return hypoid.read(EXAMPLE)


@pytest.fixture(scope="module")
def matrix_product_rate() -> float:
    """Multiplications and additions a second of a float64 matrix product, all cores."""
    n = 1500
    a = np.random.default_rng(0).random((n, n))
    best = min(_timed(lambda: a @ a) for _ in range(5))
    return 2.0 * n**3 / best


def _timed(work: Callable[[], Any]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def _note_rate(benchmark: Any, first: float, product: float) -> None:
    rate = POINTS / benchmark.stats.stats.min
    benchmark.extra_info["first_call_s"] = round(first, 2)
    benchmark.extra_info["million_points_a_second"] = round(rate / 1e6, 2)
    benchmark.extra_info["matrix_product_GFlop_a_second"] = round(product / 1e9, 1)
    benchmark.extra_info["matrix_product_flops_a_point"] = round(product / rate)


@pytest.mark.parametrize("name", FLANKS)
def test_points_from_cutter_parameters(
    benchmark: Any, pair: GearPair, name: str, matrix_product_rate: float
) -> None:
    flank = next(f for f in pair.flanks() if f.name == name)
    rng = np.random.default_rng(1)
    piece = flank.pieces["flank"]
    s = rng.uniform(float(piece.low), float(piece.high), POINTS)
    theta = flank.theta_start + rng.uniform(-0.12, 0.12, POINTS)
    first = _timed(lambda: flank.at_cutter(s, theta))
    benchmark.pedantic(flank.at_cutter, (s, theta), rounds=7)
    _note_rate(benchmark, first, matrix_product_rate)


@pytest.mark.parametrize("name", FLANKS)
def test_points_at_z_and_rho(
    benchmark: Any, pair: GearPair, name: str, matrix_product_rate: float
) -> None:
    flank = next(f for f in pair.flanks() if f.name == name)
    rng = np.random.default_rng(2)
    distance = rng.uniform(flank.toe, flank.heel, POINTS)
    z, rho = flank.cone.axial_radial(
        distance, rng.uniform(flank.root.at(0.0) + 0.05, flank.tip.at(0.0), POINTS)
    )
    first = _timed(lambda: flank.at(z, rho))
    benchmark.pedantic(flank.at, (z, rho), rounds=5)
    assert flank.at(z[:1000], rho[:1000]).ok.all()
    _note_rate(benchmark, first, matrix_product_rate)


def test_unloaded_contact_of_both_sides(benchmark: Any, pair: GearPair) -> None:
    """21 positions, 5 pairs, 61 x 31 grid."""

    def both() -> None:
        for direction in ("drive", "coast"):
            result = unloaded_contact(pair, direction, None, LIKE_THE_ISSUE)
            assert result.path
            assert len(result.transmission_error) == 21

    benchmark.extra_info["first_call_s"] = round(_timed(both), 2)
    benchmark.pedantic(both, rounds=9)


def test_thousand_misalignments(benchmark: Any, pair: GearPair) -> None:
    rng = np.random.default_rng(3)
    errors = [Misalignment(*(0.05 * rng.normal(size=3)), 5e-4 * rng.normal()) for _ in range(1000)]
    sampling = Sampling(positions_per_pitch=10, columns=31, rows=16, every_edge=False)
    list(contacts(pair, "drive", errors[:1], sampling))

    def batch() -> float:
        return max(c.peak_to_peak for c in contacts(pair, "drive", errors, sampling))

    benchmark.pedantic(batch, rounds=1)


@pytest.mark.parametrize("cache", ["cold", "warm"])
def test_contact_command(benchmark: Any, tmp_path: Path, cache: str) -> None:
    """`hypoid contact` as a whole process, from an empty compilation cache and from a full one."""
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path)}

    def run() -> None:
        command = [sys.executable, "-m", "hypoid", "contact", str(EXAMPLE), "--json"]
        done = subprocess.run(command, env=environment, capture_output=True, check=False)
        assert done.returncode in (0, 1)

    if cache == "warm":
        run()
    benchmark.pedantic(run, rounds=1 if cache == "cold" else 3)
