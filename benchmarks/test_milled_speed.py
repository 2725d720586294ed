"""Speed of face-milled flanks and of the six-axis table; run with `make bench`.

Targets: 15 million points with normals a second from cutter parameters and a million at (z, rho),
warm, on two cores; 10,000 roll positions of six axes under 50 ms; a blank under 50 ms, and a complete
pair from it (wheel and both pinion flanks) under 5 s, warm.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hypoid.blank import iso_blank
from hypoid.design import MilledRequest, build, design_milled
from hypoid.flank import Flank
from hypoid.io import read_spec
from hypoid.machine import axis_table

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from milled import milled, settings_of

POINTS = 1_000_000
METHODS = ("generated", "modified roll", "formate", "cam", "all axes")


def places(flank: Flank) -> tuple[Any, Any]:
    rng = np.random.default_rng(0)
    distance = rng.uniform(flank.toe, flank.heel, POINTS)
    low = np.asarray(flank.charts["flank"].bounds(distance)[0])
    return distance, rng.uniform(low, flank.tip.at(distance))


def note(benchmark: Any) -> None:
    for name in ("min", "median"):
        seconds = getattr(benchmark.stats.stats, name)
        benchmark.extra_info[f"million_points_a_second_{name}"] = round(POINTS / seconds / 1e6, 2)


@pytest.mark.parametrize("method", METHODS)
def test_milled_points_from_cutter_parameters(benchmark: Any, method: str) -> None:
    flank = milled("straight", method)
    points = flank.at_cone(*(p[:1000] for p in places(flank)))
    s, turn = np.resize(points.s, POINTS), np.resize(points.theta, POINTS)
    flank.at_cutter(s, turn)
    benchmark.pedantic(flank.at_cutter, (s, turn), rounds=9)
    note(benchmark)


@pytest.mark.parametrize("method", METHODS[:3])
def test_milled_points_at_z_and_rho(benchmark: Any, method: str) -> None:
    flank = milled("straight", method)
    z, rho = flank.cone.axial_radial(*places(flank))
    flank.at(z[:10], rho[:10])
    found = benchmark.pedantic(flank.at, (z, rho), rounds=5)
    note(benchmark)
    assert found.ok.mean() > 0.98


def test_six_axis_table(benchmark: Any) -> None:
    settings, roll = settings_of("all axes"), np.linspace(-0.5, 0.5, 10_000)
    table = benchmark(axis_table, settings, roll)
    assert np.isfinite(table.a).all()


BLANK = Path(__file__).parents[1] / "examples" / "blanks" / "hypoid-13x42.toml"


def request() -> MilledRequest:
    asked = read_spec(BLANK)
    assert isinstance(asked, MilledRequest)
    return asked


def test_blank(benchmark: Any) -> None:
    blank = benchmark(iso_blank, request().blank)
    assert blank.cones.teeth == (13, 42)


def test_face_milled_pair_from_its_blank(benchmark: Any) -> None:
    asked = request()

    def complete() -> Any:
        return build(design_milled(asked).spec)

    complete()
    pair = benchmark.pedantic(complete, rounds=3)
    assert not pair.faults
