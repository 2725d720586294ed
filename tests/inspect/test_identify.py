"""Unknown gears from their points: what the points decide is found, what they do not is told."""

from __future__ import annotations

import numpy as np
import pytest
from inspection import EVERY

from hypoid.geometry import DesignError
from hypoid.inspect import Measured, MeasuredSide, identify

NOISE = 0.0015


def points_of(one, setup, errors, seed=4):
    """Noisy points of the flanks that a wrong setup cuts, on the guess's grid."""
    random = np.random.default_rng(seed)
    sides = {}
    for side in setup.sides:
        nodes, flank = one.grid.flanks[side], setup.recut(side, errors)
        at = flank.at_cone(nodes.distance, nodes.height)
        noisy = at.position + random.normal(0.0, NOISE, (45, 1)) * at.normal
        sides[side] = MeasuredSide((1,), position=nodes.placed(noisy * flank.hand)[None])
    return Measured(one.grid.member.name, sides)


@pytest.mark.parametrize(("name", "member"), EVERY)
def test_settings_and_blade_angles_of_an_unknown_gear(bench, name, member):
    """Guesses off by up to 1 mm and 45 min: the points are met to their noise, errors within what is told."""
    one = bench(name, member)
    for setup in one.setups:
        random = np.random.default_rng(4)
        names = [*setup.defaults, *(n for n in setup.adjustments if n.endswith("blade_angle"))]
        errors = {n: float(5 * setup.adjustments[n].reach * random.uniform(-1, 1)) for n in names}
        found = identify(one.grid, setup, points_of(one, setup, errors), free=names, noise=NOISE)
        assert found.converged
        assert found.rms == pytest.approx(NOISE, rel=0.2)
        off = np.array([(found.steps[n] - errors[n]) / found.standard_error[n] for n in names])
        assert np.abs(off).max() < 4.0
        decided = [n for n in names if found.standard_error[n] < 0.5 * setup.adjustments[n].reach]
        assert decided
        assert any("cradle_angle" in n.words for n in found.undecided)


def test_outliers_take_no_part(bench):
    one = bench("lin-tsay-fong-1996", "pinion")
    setup = one.setups[0]
    measured = points_of(one, setup, {})
    measured.sides["concave"].position[0, 12] += 0.04 * one.grid.flanks["concave"].normal[12]
    found = identify(one.grid, setup, measured, noise=NOISE)
    assert found.rms < 1.25 * NOISE
    assert np.isnan(found.deviation["concave"].ravel()[12])


def test_coordinates_are_needed(bench):
    one = bench("lin-tsay-fong-1996", "pinion")
    deviations = Measured("pinion", {"concave": MeasuredSide((1,), deviation=np.zeros((1, 45)))})
    with pytest.raises(DesignError, match="coordinates"):
        identify(one.grid, one.setups[0], deviations)
