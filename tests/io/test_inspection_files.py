"""Inspection files: round trips in every layout, a user's own layouts, and every way a file can be wrong."""

from __future__ import annotations

import numpy as np
import pytest
from inspection import bench_of

from hypoid.flank import SIDES
from hypoid.geometry import DesignError
from hypoid.inspect import Measured, MeasuredSide, compare, measured_points
from hypoid.io import (
    Layout,
    inspection_json,
    inspection_text,
    layouts,
    read_inspection,
    read_layout,
)

GRID = bench_of("lin-tsay-fong-1996", "pinion").grid
TEETH = (1, 2, 14)


def measured(teeth=TEETH, seed=0):
    random = np.random.default_rng(seed)
    return measured_points(
        GRID, {s: random.normal(0.0, 0.003, (len(teeth), 45)) for s in SIDES}, teeth
    )


def as_deviations(one):
    sides = {
        s: MeasuredSide(f.teeth, deviation=f.deviation) for s, f in compare(GRID, one).sides.items()
    }
    return Measured(one.member, sides, thickness=0.0123)


@pytest.mark.parametrize("name", sorted(layouts()))
def test_round_trip_is_exact_to_the_printed_digits(tmp_path, name):
    layout = read_layout(name)
    given = as_deviations(measured()) if layout.has_deviation else measured()
    text = inspection_text(GRID, layout, given)
    file = tmp_path / "measured.txt"
    file.write_text(text)
    again = read_inspection(file, GRID)  # the layout is the one that the file names
    assert inspection_text(GRID, layout, again) == text
    for side in SIDES:
        one, two = given.sides[side], again.sides[side]
        assert one.teeth == two.teeth
        a = one.deviation if layout.has_deviation else one.position
        b = two.deviation if layout.has_deviation else two.position
        assert np.abs(a - b).max() <= 0.5001 * 10.0**-layout.digits


@pytest.mark.parametrize("name", sorted(layouts()))
def test_every_file_says_what_it_is(name):
    head = [
        line
        for line in inspection_text(GRID, read_layout(name)).splitlines()
        if line.startswith("#")
    ]
    told = "\n".join(head)
    size = "member: pinion", "hand: right", "teeth: 27", "rows: 5", "columns: 9"
    signs = "axis:", "length: mm", "normals:", "deviation: um"
    more = "reference_point: E3", "tooth_thickness_mm: 6.657452", "pitch_deg: 13.333333333"
    for words in (*size, *signs, *more):
        assert words in told


def test_json_both_ways(tmp_path):
    file = tmp_path / "m.json"
    for given in (measured(), as_deviations(measured())):
        file.write_text(inspection_json(GRID, given))
        again = compare(GRID, read_inspection(file, GRID))
        first = compare(GRID, given)
        for side in SIDES:
            assert np.abs(first.sides[side].mean - again.sides[side].mean).max() < 1e-7
        assert again.thickness == pytest.approx(first.thickness, abs=1e-6)


def test_the_axis_along_x_is_a_turn_not_a_mirror():
    """Cross products of points and normals go with the points."""
    layout = read_layout("points-axis-x")
    line = [x for x in inspection_text(GRID, layout).splitlines() if x.startswith("E3;")]
    cells = np.array([float(c) for c in line[0].split(";")[1:]])
    point, normal = cells[:3], -cells[3:]
    p, n = GRID.flanks["concave"].position[22], GRID.flanks["concave"].normal[22]
    assert point[0] == pytest.approx(p[2], abs=1e-6)
    assert np.cross(point, normal)[0] == pytest.approx(np.cross(p, n)[2], abs=1e-5)


def test_a_shops_own_layout(tmp_path, monkeypatch):
    """Inches, semicolons, decimal commas, the axis down, words for the sides, numbers from zero."""
    folder = tmp_path / "hypoid" / "layouts"
    folder.mkdir(parents=True)
    (folder / "ours.toml").write_text(
        'columns = ["side", "column", "row", "-", "x", "y", "z"]\n'
        'delimiter = ";"\ndecimal = ","\nlength = "in"\naxis = "-y"\nfirst = 0\nrows = "tip-to-root"\n'
        'sides = {concave = "L", convex = "R"}\ncomment = "%"\ndigits = 9\nheading = false\n'
    )
    monkeypatch.setattr("hypoid.io._inspection_layout.user_layouts", lambda: folder)
    layout = read_layout("ours")
    given = measured((1,))
    text = inspection_text(GRID, layout, given)
    first = next(line for line in text.splitlines() if not line.startswith("%"))
    assert first.startswith("L;0;0;0;")
    assert "," in first
    file = tmp_path / "m.txt"
    file.write_text(text)
    again = read_inspection(file, GRID, "ours")
    assert np.abs(again.sides["convex"].position - given.sides["convex"].position).max() < 2e-8
    assert isinstance(layout, Layout)


BAD_LAYOUTS = {
    'columns = ["x", "y"]': "x, y and z, or deviation",
    'columns = ["x", "y", "z", "w"]': "names from tooth",
    'columns = ["x", "y", "z"]\nlength = "furlong"': "one of mm",
    'columns = ["x", "y", "z"]\nseparator = ","': "one of name",
    'columns = ["x", "y", "z"]\nsides = {left = "L"}': "a word for concave",
    "columns = [": "no TOML",
    'columns = ["x", "y", "z"]\ndigits = 99': "from 0 to 15",
}


@pytest.mark.parametrize("text", BAD_LAYOUTS)
def test_what_is_wrong_with_a_layout(tmp_path, text):
    file = tmp_path / "bad.toml"
    file.write_text(text)
    with pytest.raises(DesignError) as caught:
        read_layout(str(file))
    problem = caught.value.problems[0]
    assert BAD_LAYOUTS[text] in problem.expected + problem.given


def test_an_unknown_layout_names_those_there_are():
    with pytest.raises(DesignError, match="points-axis-x"):
        read_layout("nonsense")


def read(tmp_path, text):
    file = tmp_path / "m.csv"
    file.write_text(text)
    return read_inspection(file, GRID)


def text_of(given=None):
    return inspection_text(GRID, read_layout("hypoid"), given or measured((1,)))


LINES = {
    "unreadable": (lambda cells: [*cells[:5], "abc", *cells[6:]], "x = 'abc'"),
    "decimal comma": (lambda cells: [*cells[:5], *cells[5].split("."), *cells[6:]], "12 values"),
    "short": (lambda cells: cells[:-2], "9 values"),
    "other row": (lambda cells: [*cells[:2], "9", *cells[3:]], "a point of this grid"),
    "other side": (lambda cells: [cells[0], "left", *cells[2:]], "a side, concave or convex"),
    "other tooth": (lambda cells: ["40", *cells[1:]], "a tooth from 1 to 27"),
    "infinite": (lambda cells: [*cells[:5], "inf", *cells[6:]], "x = 'inf'"),
}


@pytest.mark.parametrize("name", LINES)
def test_a_bad_line_is_named_by_its_number(tmp_path, name):
    change, words = LINES[name]
    lines = text_of().splitlines()
    at = next(k for k, line in enumerate(lines) if line.startswith("1,concave,3,4"))
    lines[at] = ",".join(change(lines[at].split(",")))
    with pytest.raises(DesignError) as caught:
        read(tmp_path, "\n".join(lines))
    (problem,) = caught.value.problems
    assert f"line {at + 1}" in problem.path
    assert words in problem.given + problem.expected


def test_decimal_commas_are_recognised(tmp_path):
    file = tmp_path / "m.txt"
    file.write_text(inspection_text(GRID, read_layout("points")).replace(".", ","))
    with pytest.raises(DesignError, match="a decimal comma"):
        read_inspection(file, GRID, "points")


def test_a_point_twice_and_another_members_file(tmp_path):
    text = text_of()
    with pytest.raises(DesignError, match="a second time"):
        read(tmp_path, text + text.splitlines()[-1] + "\n")
    with pytest.raises(DesignError) as caught:
        read(
            tmp_path, text.replace("member: pinion", "member: wheel").replace("rows: 5", "rows: 7")
        )
    assert [p.path.split(": ")[-1] for p in caught.value.problems] == ["member", "rows"]


def test_missing_points_and_lines(tmp_path):
    lines = text_of().splitlines()
    kept = [x for x in lines if not x.startswith("1,concave,3,4")]
    kept = [
        ",".join([*x.split(",")[:5], *["nan"] * 6]) if x.startswith("1,convex,1,1,") else x
        for x in kept
    ]
    again = read(tmp_path, "\n".join(kept))
    assert np.isnan(again.sides["concave"].position[0, 2 * 9 + 3]).all()
    assert np.isnan(again.sides["convex"].position[0, 0]).all()
    assert again.sides["concave"].count == 44


def test_no_file_empty_file_and_no_json(tmp_path):
    with pytest.raises(DesignError, match="cannot be read"):
        read_inspection(tmp_path / "none.csv", GRID)
    with pytest.raises(DesignError, match="at least 6"):
        compare(GRID, read(tmp_path, ""))
    (tmp_path / "m.json").write_text("{")
    with pytest.raises(DesignError, match="no JSON"):
        read_inspection(tmp_path / "m.json", GRID)
    (tmp_path / "m.json").write_text(
        '{"flanks": {"concave": {"position_mm": [[1, 2]]}, "left": {}}}'
    )
    with pytest.raises(DesignError) as caught:
        read_inspection(tmp_path / "m.json", GRID)
    assert len(caught.value.problems) == 2


def test_a_file_far_too_long_ends_the_reading(tmp_path):
    """Lines that are not of this grid are told twenty at a time, whatever follows."""
    file = tmp_path / "m.csv"
    line = "1,concave,99,1,A99,1.0,2.0,3.0,0.0,0.0,1.0\n"
    file.write_text(text_of() + line * 400_000)  # 17 MB
    with pytest.raises(DesignError) as caught:
        read_inspection(file, GRID)
    assert len(caught.value.problems) == 20
