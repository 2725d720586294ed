"""A measured flank is a flank: it answers, has normals, and meets its mate as the flank cut anew does."""

from __future__ import annotations

import numpy as np
import pytest
from inspection import EVERY

from hypoid.contact import unloaded_contact
from hypoid.geometry import DesignError
from hypoid.inspect import measured_flank, pair_as_measured, recut_pair

STEPS = {"machine_root_angle": 5e-4, "sliding_base": 0.05}


def within(nodes, count=120):
    random = np.random.default_rng(0)
    distance = random.uniform(nodes.distance.min(), nodes.distance.max(), count)
    low, high = (np.interp(distance, nodes.distance[0], nodes.height[k]) for k in (0, -1))
    return distance, random.uniform(low, high)


@pytest.mark.parametrize(("name", "member"), EVERY)
def test_it_is_the_flank_that_was_measured(bench, name, member):
    """Off the nominal by some 0.1 mm and 10 arcmin: found again to 0.03 um and 15 arcsec between the points."""
    one = bench(name, member)
    for response in one.responses:
        for side, value in response.cut(STEPS).items():
            nodes = one.grid.flanks[side]
            made = measured_flank(nodes, value)
            places = within(nodes)
            a, b = response.setup.recut(side, STEPS).at_cone(*places), made.flank.at_cone(*places)
            assert b.ok.all()
            assert np.linalg.norm(a.position - b.position, axis=1).max() < 3e-5
            turned = np.degrees(np.linalg.norm(a.normal - b.normal, axis=1)).max() * 3600.0
            assert turned < 15.0  # five rows carry a cubic
            assert made.left_out < 1e-5


@pytest.mark.parametrize("name", [n for n, m in EVERY if m == "pinion"])
def test_its_normals_are_those_of_its_points(bench, name):
    """Differences of points along and across a departed flank lie square to the normals."""
    nodes = bench(name, "pinion").grid.flanks["concave"]
    x = np.broadcast_to(np.linspace(-1.0, 1.0, 9), (5, 9))
    y = np.broadcast_to(np.linspace(-1.0, 1.0, 5)[:, None], (5, 9))
    flank = measured_flank(nodes, 0.05 * (x * y - x * x + y), order=2).flank
    distance, height = within(nodes, 30)
    normal = flank.at_cone(distance, height).normal
    h = 1e-3
    for ds, dh in ((h, 0.0), (0.0, h)):
        there = flank.at_cone(distance + ds, height + dh).position
        back = flank.at_cone(distance - ds, height - dh).position
        along = (there - back) / np.linalg.norm(there - back, axis=1)[:, None]
        assert np.abs((along * normal).sum(axis=1)).max() < 2e-7


def test_noise_is_smoothed_and_its_error_told(bench):
    nodes = bench("lin-tsay-fong-1996", "pinion").grid.flanks["convex"]
    random = np.random.default_rng(0)
    made = measured_flank(nodes, random.normal(0.0, 0.0015, (5, 9)))
    at, plain = (
        f.at_cone(nodes.distance, nodes.height).position for f in (made.flank, nodes.flank)
    )
    off = ((at - plain) * nodes.points.normal).sum(axis=1)
    assert np.sqrt(np.mean(off**2)) < 0.001
    assert made.left_out == pytest.approx(0.0015, rel=0.35)
    assert 0.0001 < float(np.nanmean(made.standard_error)) < 0.001
    with pytest.raises(DesignError, match="at least 6"):
        measured_flank(nodes, np.full((5, 9), np.nan))


def test_contact_of_the_measured_pair_is_that_of_the_pair_cut_anew(bench):
    """Transmission error to 0.05 arcsec and contact point to 5 um; the nominal pair's is further off."""
    one = bench("lin-tsay-fong-1996", "pinion")
    changes = [(r.setup, STEPS) for r in one.responses]
    again = recut_pair(one.pair, changes)
    cut = {s: v.reshape(5, 9) for r in one.responses for s, v in r.cut(STEPS).items()}
    measured, made = pair_as_measured(one.pair, one.grid, cut)
    assert set(made) == {"concave", "convex"}
    for direction in ("drive", "coast"):
        a, b, plain = (unloaded_contact(p, direction) for p in (again, measured, one.pair))
        arcsec = np.degrees([c.peak_to_peak for c in (a, b, plain)]) * 3600.0
        assert arcsec[1] == pytest.approx(arcsec[0], abs=0.05)
        assert b.contact_point == pytest.approx(a.contact_point, abs=0.005)
        assert abs(plain.contact_point[0] - a.contact_point[0]) > 0.1
