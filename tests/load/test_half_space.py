"""Cells on a half-space against closed forms: Hertz, Love, a plain sum, and an independent solver."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import dblquad
from scipy.optimize import brentq, nnls
from scipy.special import ellipe, ellipk

from hypoid.load._active_set import Outcome, solve_contact
from hypoid.load._love import (
    mirrored,
    mirrored_grid,
    parallelogram,
    polygon,
    rectangle,
    regular_grid,
    unlike,
)
from hypoid.load._patch import greatest

MODULUS = 103e3 / 0.91  # E*, MPa: two bodies of 206 GPa and 0.3


def hertz(ratio: float, mean_radius: float, force: float) -> tuple[float, float, float, float]:
    """Semi-axes a >= b (mm), peak pressure and approach of two bodies with R'/R'' = ratio [Johnson, sec. 4.2]."""
    first, second = 1.0 / (mean_radius * np.sqrt(ratio)), np.sqrt(ratio) / mean_radius

    def curvature_ratio(e2: float) -> float:
        return ((1.0 - e2) ** -1.0 * ellipe(e2) - ellipk(e2)) / (ellipk(e2) - ellipe(e2))

    e2 = 0.0 if ratio == 1.0 else brentq(lambda m: curvature_ratio(m) - ratio, 1e-9, 1.0 - 1e-12)
    if e2 == 0.0:
        a = b = (0.75 * force * mean_radius / MODULUS) ** (1.0 / 3.0)
        peak = 1.5 * force / (np.pi * a * b)
        return a, b, peak, a * a / mean_radius
    # 1/R' = 2 A with A = (p0 / E*) (b / (a^2 e^2)) (K - E), p0 = 3 F / (2 pi a b)
    a = (3.0 * force * (ellipk(e2) - ellipe(e2)) / (np.pi * MODULUS * e2 * first)) ** (1.0 / 3.0)
    b = a * np.sqrt(1.0 - e2)
    peak = 1.5 * force / (np.pi * a * b)
    assert second > first
    return a, b, peak, peak * b * ellipk(e2) / MODULUS


def press(ratio: float, columns: int, rows: int, scale: float = 1.0) -> tuple[np.ndarray, ...]:
    """A paraboloid on cells over 1.25 times its Hertz contact; lengths grow with the scale, loads with its square."""
    radius, force = 20.0 * scale, 1000.0 * scale**2
    a, b, peak, approach = hertz(ratio, radius, force)
    width, height = 2.5 * a / columns, 2.5 * b / rows
    x = (np.arange(columns) - (columns - 1) / 2.0) * width
    y = (np.arange(rows) - (rows - 1) / 2.0) * height
    x, y = (v.ravel() for v in np.meshgrid(x, y, indexing="ij"))
    gap = x * x / (2.0 * radius * np.sqrt(ratio)) + y * y * np.sqrt(ratio) / (2.0 * radius)
    area = width * height
    compliance = regular_grid(columns, rows, width, height) / (np.pi * MODULUS * area)
    found = solve_contact(compliance, gap, np.ones_like(gap), force)
    assert found.outcome is Outcome.OK
    return found, area, peak, approach, force, compliance, gap


@pytest.mark.parametrize(
    ("ratio", "columns", "rows"), [(1.0, 17, 17), (4.0, 27, 17), (300.0, 25, 11)]
)
def test_hertz_peak_and_approach(ratio: float, columns: int, rows: int) -> None:
    """Sphere, crossed cylinders and a contact as long as that of gears, within half a percent."""
    found, area, peak, approach, force, _, _ = press(ratio, columns, rows)
    assert found.force.max() / area == pytest.approx(peak, rel=5e-3)
    assert found.rotation == pytest.approx(approach, rel=5e-3)
    assert found.force.sum() == pytest.approx(force, rel=1e-12)


def test_the_greatest_pressure_does_not_depend_on_where_the_cells_stand() -> None:
    """A sphere on 9 x 9 cells, moved by parts of a cell: read between the cells within 0.4 %, a cell is not."""
    radius, force, n = 20.0, 1000.0, 11
    a, _, exact, _ = hertz(1.0, radius, force)
    size = 2.0 * a / 9.0
    cells, read = [], []
    for shift in (0.0, 0.15, 0.3, 0.5):
        x = (np.arange(n) - (n - 1) / 2.0 + shift) * size
        x, y = (v.ravel() for v in np.meshgrid(x, x, indexing="ij"))
        compliance = regular_grid(n, n, size, size) / (np.pi * MODULUS * size**2)
        found = solve_contact(compliance, (x * x + y * y) / (2.0 * radius), np.ones(n * n), force)
        pressure = found.force / size**2
        cells.append(pressure.max() / exact)
        on: Any = SimpleNamespace(on=np.ones((n, n), dtype=bool), whole=n * n)
        read.append(greatest(on, pressure, np.ones(n * n, dtype=bool)) / exact)
    assert np.ptp(cells) > 0.01
    assert np.ptp(read) < 0.004
    assert read[0] == pytest.approx(1.0, abs=0.01)


def test_hertz_converges() -> None:
    """Four times the cells: the approach is at least twice as good."""
    errors = []
    for n in (9, 18, 36):
        found, _, _, approach, *_ = press(1.0, n, n)
        errors.append(abs(found.rotation / approach - 1.0))
    assert errors[1] < 0.5 * errors[0]
    assert errors[2] < 0.5 * errors[1]


def test_lengths_by_k_and_forces_by_k_squared_keep_the_pressure() -> None:
    one, area, *_ = press(4.0, 15, 9)
    three, area_three, *_ = press(4.0, 15, 9, scale=3.0)
    np.testing.assert_allclose(three.force / area_three, one.force / area, rtol=1e-9)
    assert three.rotation == pytest.approx(3.0 * one.rotation, rel=1e-9)


def test_the_same_as_nonnegative_least_squares() -> None:
    """With f = L^-T v, the solution at the found rotation minimises |L^T f + L^-1 (g - l phi)|, f >= 0."""
    found, *_, compliance, gap = press(4.0, 9, 7)
    lower = np.linalg.cholesky(compliance)
    force, _ = nnls(lower.T, np.linalg.solve(lower, found.rotation - gap))
    np.testing.assert_allclose(found.force, force, atol=1e-9 * force.max())
    assert found.gap.min() >= -1e-9
    assert np.abs(found.gap * found.force).max() < 1e-12


def test_levers_share_the_moment() -> None:
    """Any levers: the moment is met to rounding and more moment never turns the member back."""
    rng = np.random.default_rng(3)
    *_, compliance, gap = press(4.0, 9, 7)
    lever = rng.uniform(5.0, 9.0, len(gap))
    last, start = 0.0, None
    for moment in (1e-3, 1.0, 50.0, 1e3, 2e4):
        found = solve_contact(compliance, gap, lever, moment, start)
        cold = solve_contact(compliance, gap, lever, moment)
        assert found.outcome is Outcome.OK
        np.testing.assert_allclose(found.force, cold.force, rtol=1e-8, atol=1e-9 * cold.force.max())
        assert lever @ found.force == pytest.approx(moment, rel=1e-9)
        assert found.rotation > last
        last, start = found.rotation, found.touching


def test_any_first_guess_ends_in_the_same_contact() -> None:
    """Sets that differ by few cells border one factor, by many ask for a new one: the answer is the same."""
    rng = np.random.default_rng(5)
    *_, compliance, gap = press(4.0, 15, 11)
    lever = rng.uniform(5.0, 9.0, len(gap))
    cold = solve_contact(compliance, gap, lever, 4e3)
    assert 20 < cold.touching.sum() < 140
    for share in (0.02, 0.1, 0.2, 0.5):
        start = cold.touching ^ (rng.random(len(gap)) < share)
        found = solve_contact(compliance, gap, lever, 4e3, start)
        assert found.outcome is Outcome.OK
        np.testing.assert_array_equal(found.touching, cold.touching)
        np.testing.assert_allclose(found.force, cold.force, atol=1e-9 * cold.force.max())
        assert found.rotation == pytest.approx(cold.rotation, rel=1e-10)
        assert found.stiffness == pytest.approx(cold.stiffness, rel=1e-9)


def test_says_so_when_nothing_can_carry() -> None:
    found = solve_contact(np.eye(2), np.zeros(2), -np.ones(2), 1.0)
    assert found.outcome is Outcome.NO_CONTACT
    found = solve_contact(-np.eye(2), np.zeros(2), np.ones(2), 1.0)
    assert found.outcome is Outcome.NOT_POSITIVE


def test_love_against_quadrature() -> None:
    for x, y in ((0.9, 0.4), (2.0, -1.3)):
        found, _ = dblquad(
            lambda v, u, x, y: 1.0 / np.hypot(u - x, v - y), -0.5, 0.5, -0.25, 0.25, args=(x, y)
        )
        assert rectangle(np.array(x), np.array(y), 1.0, 0.5) == pytest.approx(found, rel=1e-8)


def test_a_parallelogram_is_a_rectangle_when_square_and_a_sum_when_not() -> None:
    at = np.array([[0.0, 0.0], [0.3, 0.1], [2.0, -1.0]])
    found = parallelogram(at, np.array([1.0, 0.0]), np.array([0.0, 0.5]))
    np.testing.assert_allclose(found, rectangle(at[:, 0], at[:, 1], 1.0, 0.5), rtol=1e-12)
    first, second = np.array([0.8, 0.3]), np.array([-0.2, 0.6])
    s, t = np.meshgrid(*2 * [(np.arange(600) + 0.5) / 600 - 0.5])
    area = abs(first[0] * second[1] - first[1] * second[0])
    place = s[..., None] * first + t[..., None] * second
    for q in (np.array([0.11, 0.23]), np.array([1.5, 0.7])):
        r = np.hypot(*(place - q).transpose(2, 0, 1))
        assert parallelogram(q, first, second) == pytest.approx(area * (1.0 / r).mean(), rel=3e-3)
    assert parallelogram(at, second, first) == pytest.approx(parallelogram(at, first, second))


def boxes(x: Any, y: Any, width: Any, height: Any) -> Any:
    """Corners (n, 4, 2) of rectangles."""
    half = 0.5 * np.stack(np.broadcast_arrays(width, height, x), axis=-1)[:, None, :2]
    return np.stack([x, y], axis=-1)[:, None] + half * [(-1, -1), (1, -1), (1, 1), (-1, 1)]


def test_pieces_of_a_rectangle_add_up_to_it() -> None:
    """Cut by an inclined line; a corner given twice does not count."""
    whole = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.0, 0.5]])
    left = np.array([[0.0, 0.0], [0.3, 0.0], [0.7, 0.5], [0.0, 0.5], [0.0, 0.5]])
    right = np.array([[0.7, 0.5], [0.3, 0.0], [1.0, 0.0], [1.0, 0.5]])  # the other way round
    for eye in (np.array([0.2, 0.1]), np.array([3.0, -1.0]), np.array([0.3, 0.0])):
        found = polygon(eye, left) + polygon(eye, right)
        assert found == pytest.approx(float(polygon(eye, whole)), rel=1e-12)


@pytest.mark.parametrize("growth", [1.0, 1.15, 1.3])
def test_a_line_contact_on_rows_that_grow(growth: float) -> None:
    """Hertz's cylinder on rows of one or of growing height, twenty over the contact: its peak within 1 %."""
    radius, half, columns, rows, length = 0.2, 0.01, 11, 20, 20.0
    line = np.pi * half**2 * MODULUS / (4.0 * radius)
    height = growth ** np.arange(rows)
    height *= 2.6 * half / height.sum()
    y = np.cumsum(height) - 0.5 * height - 1.3 * half
    step = length / columns
    x = (np.arange(columns) - (columns - 1) / 2.0) * step
    x, y = (v.ravel() for v in np.meshgrid(x, y, indexing="ij"))
    height = np.tile(height, columns)
    place, area = np.stack([x, y], axis=-1), step * height
    corners = boxes(x, y, step, height)[:, [0, 1, 2, 3, 3, 3]]
    matrix = unlike(place, place, corners, area, 0) / (np.pi * MODULUS)
    np.testing.assert_array_equal(matrix, matrix.T)
    found = solve_contact(matrix, y * y / (2.0 * radius), np.ones_like(y), line * length)
    force = found.force.reshape(columns, rows)[columns // 2]
    peak = (force / area[:rows]).max()
    exact = np.sqrt(force.sum() / step * MODULUS / (np.pi * radius))
    assert peak == pytest.approx(exact, rel=0.01)


def test_cells_of_a_grid_as_polygons_are_the_grid() -> None:
    """Far ones as points: five lengths off along it, a cell's field is 1/(12 * 25) more than a point's."""
    columns, rows, width, height = 7, 5, 0.4, 0.13
    grid = np.meshgrid(np.arange(columns) * width, np.arange(rows) * height, indexing="ij")
    place = np.stack(grid, axis=-1).reshape(-1, 2)
    x, y = place.T
    corners = boxes(x, y, width, height)[:, [0, 1, 2, 3, 3, 3]]
    area = np.full(len(place), width * height)
    found = unlike(place, place, corners, area, 0) * area
    np.testing.assert_allclose(found, regular_grid(columns, rows, width, height), rtol=1 / 290)
    line = np.array([1.0, 0.3, 0.8])
    found = unlike(mirrored(place, line), place, corners, area, 0) * area
    image = mirrored_grid(place, line[None], np.ones(1), width, height)
    np.testing.assert_allclose(found, image, rtol=1 / 290)


def test_images_beyond_several_lines_are_the_sum_of_each_ones() -> None:
    """By their weights, cells beyond a line among them; a line without a direction is none.

    Polygons see an oblique image one way, grids the mean of both.
    """
    width, height = 0.5, 0.25
    grid = np.meshgrid(np.arange(9) * width, np.arange(5) * height, indexing="ij")
    place = np.stack(grid, axis=-1).reshape(-1, 2)
    corners = boxes(*place.T, width, height)[:, [0, 1, 2, 3, 3, 3]]
    area = np.full(len(place), width * height)
    lines = np.array([(0.3, 1.0, 0.2), (-2.0, 2.0, 0.0), (5.0, -0.3, -1.0), (-1.0, 0.0, 0.0)])
    weights = np.array([1.0, 0.4, 2.5, 7.0])
    found = mirrored_grid(place, lines, weights, width, height)
    one_by_one = sum(
        weight * unlike(mirrored(place, line), place, corners, area, 0) * area
        for line, weight in zip(lines[:3], weights, strict=False)
    )
    np.testing.assert_allclose(found, one_by_one, rtol=0.01)


def test_images_beyond_a_line() -> None:
    """Of a cell with its middle on the line the image is the cell; elsewhere it is seen from the mirrored place."""
    place = np.array([(0.0, 0.0), (1.0, 0.3), (2.0, -0.2)])
    one = np.ones(1)
    found = mirrored_grid(place, np.array([[0.0, 2.0, 0.0]]), one, 0.5, 0.25)  # the line x = 0
    assert found[0, 0] == pytest.approx(rectangle(np.array(0.0), np.array(0.0), 0.5, 0.25))
    far_off = rectangle(np.array(3.0), np.array(0.5), 0.5, 0.25)
    assert found[1, 2] == pytest.approx(far_off, rel=2e-3)  # seen as a point
    np.testing.assert_allclose(found, found.T)
    far = mirrored_grid(place, np.array([[1e3, 1.0, 0.0]]), one, 0.5, 0.25)
    assert far.max() < 1e-4
