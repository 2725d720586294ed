"""Files that are written: whole or not at all, with units in the header."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from hypoid.geometry import DesignError
from hypoid.io import FlankGrid, grid_csv, grid_json, write_text


@pytest.fixture
def grid() -> FlankGrid:
    position = np.arange(18.0).reshape(6, 3)
    position[4] = np.nan
    return FlankGrid(
        member="pinion",
        side="concave",
        shape=(2, 3),
        cone_distance=[100.0, 110.0, 120.0] * 2,
        height=[-1.0] * 3 + [2.0] * 3,
        position=position,
        normal=np.tile([0.0, 0.0, 1.0], (6, 1)),
        status=["ok", "ok", "ok", "ok", "singular", "ok"],
    )


def test_csv_has_units_in_its_header_and_a_line_a_point(grid: FlankGrid) -> None:
    comment, *lines = grid_csv(grid).splitlines()
    rows = list(csv.DictReader(lines))
    assert "pinion concave" in comment
    assert len(rows) == 6
    assert (rows[5]["row"], rows[5]["column"]) == ("1", "2")
    assert float(rows[5]["z_mm"]) == 17.0
    assert (rows[4]["x_mm"], rows[4]["status"]) == ("", "singular")


def test_json_has_null_where_there_is_no_number(grid: FlankGrid) -> None:
    content = json.loads(grid_json(grid))
    assert (content["rows"], content["columns"]) == (2, 3)
    assert content["points"][4]["x_mm"] is None
    assert content["points"][4]["cone_distance_mm"] == 110.0


def test_grid_of_another_size_is_refused(grid: FlankGrid) -> None:
    wrong = FlankGrid(**{**vars(grid), "shape": (2, 2)})
    with pytest.raises(ValueError, match="reshape"):
        grid_csv(wrong)


def test_write_leaves_one_whole_file(tmp_path: Path) -> None:
    target = tmp_path / "out.txt"
    write_text(target, "first\n")
    write_text(target, "second µ\n")
    assert target.read_text(encoding="utf-8") == "second µ\n"
    assert list(tmp_path.iterdir()) == [target]


def test_place_that_cannot_be_written_is_a_design_error(tmp_path: Path) -> None:
    for target in (tmp_path / "none" / "out.txt", tmp_path):
        with pytest.raises(DesignError, match="cannot be written"):
            write_text(target, "x")
    assert list(tmp_path.iterdir()) == []
