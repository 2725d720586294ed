"""Speed of inspection and correction; run with `make bench`.

Targets, warm, on two cores: a 5 x 9 flank compared and corrected under 1 s, a 45 x 45 one under 3 s, a thousand
simulated loops (cut, measure, correct, cut, measure, correct, cut) under 60 s.
"""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from inspection import EVERY, bench_of

from hypoid.inspect import (
    Response,
    Wish,
    compare,
    correction,
    measured_points,
    measuring_grid,
    random_errors,
    simulated_loop,
)

LOOPS = 1000


@pytest.mark.parametrize(("rows", "columns"), [(5, 9), (45, 45)])
def test_a_flank_compared_and_corrected(benchmark: Any, rows: int, columns: int) -> None:
    """From coordinates to the rounded steps, its null directions and the exact prediction."""
    one = bench_of("lin-tsay-fong-1996", "pinion")
    setup = one.setups[0]
    wrong = {"machine_root_angle": 1e-3, "eccentric_angle": 5e-4}
    grid = measuring_grid(one.pair.pinion, rows, columns)
    noise = np.random.default_rng(0).normal(0.0, 0.0015, rows * columns)
    put = {"concave": Response(setup, grid).cut(wrong)["concave"] + noise}
    measured = measured_points(grid, put)

    def once() -> float:
        fresh = measuring_grid(one.pair.pinion, rows, columns)
        found = compare(fresh, measured)
        return correction(Response(setup, fresh), found.deviations).rms_predicted

    once()
    assert benchmark.pedantic(once, rounds=5) < 0.0018


def test_a_thousand_simulated_loops(benchmark: Any) -> None:
    """On every example's setups in turn, three wrong settings each, on as many threads as there are cores."""
    responses = [r for name, member in EVERY for r in bench_of(name, member).responses]

    def loop(seed: int) -> float:
        response, random = responses[seed % len(responses)], np.random.default_rng(seed)
        wrong = random.choice(response.setup.defaults, 3, replace=False)
        return simulated_loop(response, random_errors(response, wrong, random), Wish(), random).rms[
            1
        ]

    def all_of_them() -> list[float]:
        with ThreadPoolExecutor(2) as pool:
            return list(pool.map(loop, range(LOOPS)))

    for seed in range(2 * len(responses)):
        loop(seed)
    assert np.quantile(benchmark.pedantic(all_of_them, rounds=1), 0.99) < 0.0015
