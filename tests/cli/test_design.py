"""`hypoid design`: a short file in, a complete one out that reads back to the same flanks."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hypoid as package
from hypoid.cli import main
from hypoid.design import (
    HobbedRequest,
    SummarySheetSpec,
    build,
    design_exact,
    design_hobbed,
    design_milled,
)
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
        apart = np.abs(first.position - second.position)
        # where a fillet runs out into the land its place is a double root: apart along the normal, then
        along = np.abs(((first.position - second.position) * first.normal).sum(axis=1))
        on_flank = both & (first.piece == one.cut_pieces.index("flank"))
        assert apart[on_flank].max() < 1e-9
        assert along[both].max() < 1e-9


@pytest.mark.parametrize("name", ["vimercati-piazza-2005", "gonzalez-fuentes-2022"])
def test_face_hobbed_files_read_back_to_the_same_flanks(
    hypoid: Any, tmp_path: Path, name: str
) -> None:
    """Tri-Ac and exact: both flanks of a member by one setting-up, points within 1e-9 mm above the fillet."""
    source, target = EXAMPLE.parent / f"{name}.toml", tmp_path / "designed.toml"
    status, out, _ = hypoid("design", str(source), "-o", str(target), "--json")
    result = json.loads(out)
    assert status in (0, 1)  # the 2005 pinion is undercut at its toe, as the paper says
    text = target.read_text(encoding="utf-8")
    assert "#" in text.split("[pinion.settings]")[1].splitlines()[0]  # says where they came from
    spec, request = read_spec(target), read_spec(source)
    assert isinstance(spec, SummarySheetSpec)
    if isinstance(request, HobbedRequest):
        made = design_hobbed(request).spec
        assert result["fits"]["pinion concave"]["residual_largest_um"] < 12.0
        assert result["residual_maps"]["convex"]
    else:
        made = design_exact(request).spec  # pyright: ignore[reportArgumentType]
    for one, other in zip(build(made).flanks(), build(spec).flanks(), strict=True):
        distance, height = one.grid(9, 9)
        first, second = (flank.at_cone(distance, height) for flank in (one, other))
        low = np.asarray(one.charts["flank"].bounds(distance.ravel())[0])
        both = first.ok & second.ok & (height.ravel() > low + 1e-3)
        assert both.sum() > 30
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


def test_report_shows_what_the_fit_leaves(hypoid: Any, tmp_path: Path) -> None:
    """Residual maps of both pinion flanks beside their targets, and singular directions in words."""
    report = tmp_path / "designed.html"
    status, _, err = hypoid(
        "design", str(EXAMPLE), "-o", str(tmp_path / "d.toml"), "--report", str(report)
    )
    assert status in (0, 1)
    assert f"The report is {report}" in err
    text = report.read_text(encoding="utf-8")
    section = text.split("Fit to the target</h2>")[-1].split("</section>")[0]
    assert "The target determines every free setting." in section
    assert "<svg" in section


def test_a_hobbed_pinions_ranges_from_the_file_to_the_written_settings(
    hypoid: Any, tmp_path: Path
) -> None:
    """The written sheet keeps the range and says which setting stands at its bound; nonsense ends with 2."""
    text = (EXAMPLE.parent / "vimercati-piazza-2005.toml").read_text(encoding="utf-8")
    source, target = tmp_path / "asked.toml", tmp_path / "designed.toml"
    source.write_text(
        text + '\n[pinion.range]\ntilt_angle = ["0 deg", "15 deg"]\n', encoding="utf-8"
    )
    status, _, err = hypoid("design", str(source), "-o", str(target))
    assert status == 1
    assert "tilt_angle stands at its upper bound, 15 deg" in err
    assert "# tilt_angle stands at its upper bound, 15 deg" in target.read_text(encoding="utf-8")
    spec = read_spec(target)
    assert isinstance(spec, SummarySheetSpec)
    for flank in (spec.pinion.concave, spec.pinion.convex):
        assert np.degrees(flank.dials["tilt_angle"]) == pytest.approx(15.0, abs=1e-9)
    source.write_text(
        text + '\n[pinion.range]\ntilt_angle = ["15 deg", "0 deg"]\n', encoding="utf-8"
    )
    status, _, err = hypoid("design", str(source))
    assert status == 2
    assert "pinion.range.tilt_angle" in err
