"""`hypoid design`: a short file in, a complete one out that reads back to the same flanks."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hypoid as package
from hypoid.cli import main
from hypoid.design import SummarySheetSpec, build, design_milled
from hypoid.io import read_spec

EXAMPLE = Path(__file__).parents[2] / "examples" / "blanks" / "hypoid-13x42.toml"


@pytest.fixture
def hypoid(capsys: pytest.CaptureFixture[str]) -> Any:
    def run(*argv: str) -> tuple[int, str, str]:
        status = main(argv)
        return status, *capsys.readouterr()

    return run


def test_the_written_file_makes_the_same_flanks(hypoid: Any, tmp_path: Path) -> None:
    """Points of all four flanks within 1e-9 mm, from the file and from the design itself."""
    target = tmp_path / "designed.toml"
    status, out, err = hypoid("design", str(EXAMPLE), "-o", str(target), "--json")
    result = json.loads(out)
    assert status in (0, 1)
    assert f"The complete design is {target}" in err
    assert result["fits"]["pinion concave"]["residual_largest_um"] < 5.0
    assert result["residual_maps"]["concave"]
    assert result["slots"]["wheel"]["largest_edge_radius_mm"] > 0.3
    spec = read_spec(target)
    assert isinstance(spec, SummarySheetSpec)
    again = build(spec)
    made = build(design_milled(read_spec(EXAMPLE)).spec)  # pyright: ignore[reportArgumentType]
    for one, other in zip(made.flanks(), again.flanks(), strict=True):
        distance, height = one.grid(5, 9)
        first, second = (flank.at_cone(distance, height) for flank in (one, other))
        both = first.ok & second.ok
        assert both.mean() > 0.75  # the root row lies in the land
        assert np.abs(first.position[both] - second.position[both]).max() < 1e-9


def test_the_short_file_serves_every_command(hypoid: Any) -> None:
    status, out, _ = hypoid("blank", str(EXAMPLE), "--json")
    assert status == 0
    assert json.loads(out)["pinion"]["face_width_mm"] == pytest.approx(31.910, abs=2e-3)
    assert package.read(EXAMPLE).title.startswith("Hypoid 13 x 42")


def test_what_is_no_request_is_refused_before_anything_is_written(
    hypoid: Any, tmp_path: Path
) -> None:
    sheet = EXAMPLE.parents[1] / "lin-tsay-fong-1996.toml"
    target = tmp_path / "out.toml"
    status, _, err = hypoid("design", str(sheet), "-o", str(target))
    assert status == 2
    assert "cutting.process" in err
    assert not target.exists()
    status, _, err = hypoid("design", str(EXAMPLE), "-o", str(tmp_path / "none" / "out.toml"))
    assert status == 2
    assert "folder" in err
