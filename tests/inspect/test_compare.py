"""Measured against nominal: what was put into a measurement comes out of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from inspection import EVERY, bench_of, example

from hypoid.flank import SIDES, flank_angles
from hypoid.geometry import DesignError
from hypoid.inspect import (
    Borders,
    Measured,
    MeasuredSide,
    compare,
    form,
    measured_points,
    measuring_grid,
    topography,
)

LIN = ("lin-tsay-fong-1996", "pinion")


def zeros(grid):
    return {side: np.zeros(grid.rows * grid.columns) for side in SIDES}


def moved(measured, change):
    sides = {s: replace(one, position=change(one.position)) for s, one in measured.sides.items()}
    return Measured(measured.member, sides)


@pytest.mark.parametrize(("name", "member"), EVERY)
def test_deviations_come_back(bench, name, member):
    grid = bench(name, member).grid
    noise = np.random.default_rng(0).normal(0.0, 0.004, (45,))
    put = {side: noise for side in SIDES}
    found = compare(grid, measured_points(grid, put))
    for side, one in found.sides.items():
        lever = one.nodes.lever
        middle = np.ravel_multi_index(grid.reference, (5, 9))
        zeroed = noise - lever * noise[middle] / lever[middle]
        assert np.abs(one.mean.ravel() - zeroed).max() < 1e-6, side
        assert one.mean[grid.reference] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("name", "member"), EVERY)
def test_a_turned_part_deviates_by_nothing(bench, name, member):
    """Rotation about the axis is free, and both flanks turn as one: no thickness."""
    grid = bench(name, member).grid
    c, s = np.cos(0.3), np.sin(0.3)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    found = compare(grid, moved(measured_points(grid, zeros(grid)), lambda p: p @ turn.T))
    assert max(one.largest for one in found.sides.values()) < 1e-9
    assert found.thickness == pytest.approx(0.0, abs=1e-9)


def test_thickness_is_told_apart(bench):
    """Both flanks 10 um thicker along their normals: twice that over the cosines, and no deviation of form."""
    grid = bench(*LIN).grid
    put = {s: 0.010 * grid.flanks[s].lever / grid.flanks[s].lever[22] for s in SIDES}
    found = compare(grid, measured_points(grid, put))
    expected = sum(0.010 * grid.flanks[s].radius / abs(grid.flanks[s].lever[22]) for s in SIDES)
    assert found.thickness == pytest.approx(expected, rel=1e-3)
    assert max(one.largest for one in found.sides.values()) < 1e-6


def test_pitch_by_tooth(bench):
    grid = bench(*LIN).grid
    teeth = (1, 2, 3, 10)
    turns = np.array([0.0, 0.008, -0.004, 0.001])
    put = {}
    for side in SIDES:
        nodes = grid.flanks[side]
        put[side] = turns[:, None] / nodes.radius * nodes.lever
    found = compare(grid, measured_points(grid, put, teeth))
    for pitch in found.pitch.values():
        assert pitch.cumulative == pytest.approx(tuple(turns), abs=2e-6)
        assert pitch.total == pytest.approx(0.012, abs=2e-6)
        assert pitch.single == pytest.approx(0.012, abs=2e-6)  # from tooth 2 to 3
    assert found.thickness == pytest.approx(0.0, abs=2e-6)
    assert max(one.scatter.max() for one in found.sides.values()) < 2e-6


def test_runout_of_an_eccentric_part(bench):
    """Off its axis by e, a part runs out by 2 e cos(pitch angle) square to the pitch cone; a ball sees about that."""
    one = bench(*LIN)
    teeth = tuple(range(1, 28))
    measured = measured_points(one.grid, zeros(one.grid), teeth)
    found = compare(one.grid, moved(measured, lambda p: p + np.array([0.02, 0.0, 0.0])))
    assert found.runout == pytest.approx(0.04 * np.cos(one.grid.member.blank.pitch_angle), rel=0.03)


def test_a_shift_along_the_axis_is_fitted(bench):
    grid = bench(*LIN).grid
    measured = moved(measured_points(grid, zeros(grid)), lambda p: p + np.array([0.0, 0.0, 0.05]))
    assert max(one.largest for one in compare(grid, measured).sides.values()) > 0.0003
    fitted = compare(grid, measured, axial="fit")
    assert fitted.axial == pytest.approx(0.05, abs=2e-4)
    assert max(one.largest for one in fitted.sides.values()) < 1e-5
    given_ = compare(grid, measured, axial=0.05)
    assert max(one.largest for one in given_.sides.values()) < 1e-9


def test_outliers_are_marked_and_left_out(bench):
    grid = bench(*LIN).grid
    random = np.random.default_rng(3)
    put = {s: random.normal(0.0, 0.0015, (3, 45)) for s in SIDES}
    put["concave"][1, 7] += 0.04
    put["convex"][2, 30] -= 0.03
    found = compare(grid, measured_points(grid, put, (1, 2, 3)))
    assert [np.argwhere(found.sides[s].outlier).tolist() for s in SIDES] == [[[1, 7]], [[2, 30]]]
    assert found.sides["concave"].outliers[0].startswith("tooth 2, H1 (+")
    assert found.sides["concave"].mean.ravel()[7] == pytest.approx(
        put["concave"][[0, 2], 7].mean(), abs=0.003
    )


def test_plain_noise_has_no_outliers(bench):
    grid = bench(*LIN).grid
    marked = 0
    for seed in range(40):
        put = {s: np.random.default_rng(seed).normal(0.0, 0.0015, 45) for s in SIDES}
        found = compare(grid, measured_points(grid, put))
        marked += sum(int(one.outlier.sum()) for one in found.sides.values())
    assert marked <= 2  # of 3600


def test_missing_points_stay_missing(bench):
    grid = bench(*LIN).grid
    put = zeros(grid)
    put["concave"][[0, 5, 22]] = np.nan  # the reference point among them
    found = compare(grid, measured_points(grid, put))
    assert np.isnan(found.sides["concave"].mean.ravel()[[0, 5, 22]]).all()
    assert found.sides["concave"].largest < 1e-9


@pytest.mark.parametrize(("name", "member"), EVERY)
def test_angles_are_the_flanks_own(bench, name, member):
    """Pressure and spiral angle of a flank cut with another root angle, as the exact normals have them."""
    one = bench(name, member)
    for response in one.responses:
        steps = {"machine_root_angle": 1e-4, "sliding_base": 0.01}
        for side, value in response.cut(steps).items():
            nodes = one.grid.flanks[side]
            at = [float(v[nodes.reference]) for v in (nodes.distance, nodes.height)]
            before, after = (
                flank_angles(nodes.flank, *at),
                flank_angles(response.setup.recut(side, steps), *at),
            )
            parts = topography(nodes, value)
            turned = max(abs(after.pressure - before.pressure), abs(after.spiral - before.spiral))
            assert parts.pressure_angle == pytest.approx(
                after.pressure - before.pressure, abs=0.08 * turned
            )
            assert parts.spiral_angle == pytest.approx(
                after.spiral - before.spiral, abs=0.08 * turned
            )


@given(
    profile=st.floats(-0.02, 0.02), lengthwise=st.floats(-0.02, 0.02), bias=st.floats(-0.02, 0.02)
)
def test_a_form_comes_back(profile, lengthwise, bias):
    nodes = bench_of(*LIN).grid.flanks["concave"]
    put = form(nodes, profile_crowning=profile, lengthwise_crowning=lengthwise, bias=bias)
    found = topography(nodes, put)
    assert found.profile_crowning == pytest.approx(profile, abs=1e-9)
    assert found.lengthwise_crowning == pytest.approx(lengthwise, abs=1e-9)
    assert found.bias == pytest.approx(bias, abs=1e-9)
    assert found.residual < 1e-9


WRONG = {
    "in inches": lambda p: p / 25.4,
    "of the other hand": lambda p: p * np.array([1.0, -1.0, 1.0]),
    "rows from tip to root": lambda p: p.reshape(-1, 5, 9, 3)[:, ::-1].reshape(p.shape),
    "columns from heel to toe": lambda p: p.reshape(-1, 5, 9, 3)[:, :, ::-1].reshape(p.shape),
    "rows and columns swapped": lambda p: p.reshape(-1, 5, 9, 3).swapaxes(1, 2).reshape(p.shape),
    "axis along x": lambda p: p[..., [2, 0, 1]],
}


@pytest.mark.parametrize("words", WRONG)
@pytest.mark.parametrize(("name", "member"), EVERY)
def test_what_looks_like_something_else_is_named(bench, name, member, words):
    grid = bench(name, member).grid
    with pytest.raises(DesignError) as caught:
        compare(grid, moved(measured_points(grid, zeros(grid)), WRONG[words]))
    assert all(words in p.given for p in caught.value.problems)
    assert len(caught.value.problems) == 2


@pytest.mark.parametrize("name", [n for n, m in EVERY if m == "wheel"])
def test_the_other_side_and_the_other_member_are_named(bench, name):
    pinion, wheel = bench(name, "pinion").grid, bench(name, "wheel").grid
    grids = {"pinion": pinion, "wheel": wheel}
    good = measured_points(pinion, zeros(pinion))
    swapped = Measured("pinion", {"concave": good.sides["convex"], "convex": good.sides["concave"]})
    with pytest.raises(DesignError, match="these look like the convex flank"):
        compare(pinion, swapped, others=grids)
    with pytest.raises(DesignError, match="these look like the pinion's concave flank"):
        compare(wheel, good, others=grids)


def test_reversed_normals_and_micrometres_are_named(bench):
    grid = bench(*LIN).grid
    good = measured_points(grid, zeros(grid))
    normals = {
        s: replace(one, normal=-grid.flanks[s].normal[None]) for s, one in good.sides.items()
    }
    with pytest.raises(DesignError, match="reversed normals"):
        compare(grid, Measured("pinion", normals))
    right = {s: replace(one, normal=grid.flanks[s].normal[None]) for s, one in good.sides.items()}
    compare(grid, Measured("pinion", right))
    large = MeasuredSide((1,), deviation=np.full((1, 45), 7.0))
    with pytest.raises(DesignError, match="micrometres"):
        compare(grid, Measured("pinion", {"concave": large}))


def test_too_few_points_and_impossible_grids():
    member = example(LIN[0])[1].pinion
    grid = measuring_grid(member)
    few = np.full(45, np.nan)
    few[:5] = 0.0
    with pytest.raises(DesignError, match="at least 6"):
        compare(grid, measured_points(grid, {"concave": few}))
    with pytest.raises(DesignError) as caught:
        measuring_grid(member, 2, 46, Borders(toe=120.0))
    assert [p.path for p in caught.value.problems] == ["--rows", "--columns", "--toe"]
    with pytest.raises(DesignError, match="at least 5 per cent"):
        measuring_grid(member, 5, 9, Borders(root=60.0, tip=40.0))


def test_a_grid_into_the_fillet_says_so():
    grid = measuring_grid(example(LIN[0])[1].pinion, 5, 9, Borders(root=5.0))
    assert any("fillet" in words for words in grid.faults)


def test_45_by_45_points_and_normals_are_the_flanks(bench):
    pair = bench(*LIN).pair
    grid = measuring_grid(pair.pinion, 45, 45)
    nodes = grid.flanks["concave"]
    assert nodes.there.all()
    assert nodes.name(44, 44) == "AS45"
    again = nodes.flank.at_cone(nodes.distance, nodes.height)
    assert np.abs(again.position - nodes.position).max() < 1e-12
    a, b = (
        measuring_grid(pair.pinion).flanks[s].position[22] for s in SIDES
    )  # one tooth's two flanks
    arc = np.angle((b[0] + 1j * b[1]) / (a[0] + 1j * a[1])) * np.hypot(*a[:2])
    assert abs(arc) == pytest.approx(grid.thickness, abs=0.4)
