"""`hypoid settings` and `hypoid flank`: tables 4 and 5 of the 2022 paper, and a grid with units."""

import csv
import json
from pathlib import Path

import pytest

from hypoid.cli import main
from hypoid.io import example_files

EXAMPLE = str(next(f for f in example_files() if f.name == "gonzalez-fuentes-2022.toml"))


def test_settings_are_tables_4_and_5(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["settings", EXAMPLE, "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    for side in ("concave", "convex"):
        pinion, wheel = result["pinion"][side], result["wheel"][side]
        assert pinion["radial_distance_mm"] == pytest.approx(108.966, abs=5e-4)
        assert pinion["blank_offset_mm"] == pytest.approx(-55.489, abs=5e-4)
        assert pinion["sliding_base_mm"] == pytest.approx(-3.376, abs=5e-4)
        assert pinion["ratio_of_roll"] == pytest.approx(12.431511, abs=5e-7)
        assert wheel["cradle_angle_deg"] == pytest.approx(47.606, abs=5e-4)
        assert wheel["roll_to_blade_ratio"] == pytest.approx(0.068493, abs=5e-7)
        assert wheel["modified_roll"] == []


def test_flank_writes_a_grid(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "flank.csv"
    argv = ["flank", EXAMPLE, "--member", "wheel", "--side", "convex", "-o", str(target)]
    assert main([*argv, "--rows", "3", "--columns", "4"]) == 0
    assert capsys.readouterr().out == ""
    rows = list(csv.DictReader(target.read_text(encoding="utf-8").splitlines()[1:]))
    assert len(rows) == 12
    assert {row["status"] for row in rows} == {"ok"}
    normal = [float(rows[5][f"normal_{axis}"]) for axis in "xyz"]
    assert sum(n * n for n in normal) == pytest.approx(1.0, abs=1e-10)
