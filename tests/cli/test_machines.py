"""`hypoid settings --machine`: dials, their steps, and the axes of a free-form machine."""

import json
from pathlib import Path
from typing import Any

import pytest

from hypoid.cli import main
from hypoid.io import example_files

FILES = {f.stem: str(f) for f in example_files()}
TILTED, CAM = FILES["tsay-lin-1993"], FILES["lin-tsay-fong-1996"]


@pytest.fixture
def hypoid(capsys: pytest.CaptureFixture[str]) -> Any:
    def run(*argv: str) -> tuple[int, str, str]:
        status = main(argv)
        return status, *capsys.readouterr()

    return run


def test_dials_of_the_no_122_are_those_of_the_file(hypoid: Any) -> None:
    """Tsay & Lin 1993, Table 1: to basic settings and back."""
    status, out, _ = hypoid("settings", TILTED, "--machine", "gleason-122", "--json")
    pinion = json.loads(out)["pinion"]["concave"]
    assert status in (0, 1)
    assert pinion["eccentric_angle_deg"] == pytest.approx(64 + 29 / 60, abs=1e-9)
    assert pinion["cradle_angle_deg"] == pytest.approx(355 + 53 / 60, abs=1e-9)
    assert pinion["swivel_angle_deg"] == pytest.approx(359.5, abs=1e-9)
    assert pinion["cutter_spindle_rotation_angle_deg"] == pytest.approx(52 + 41 / 60, abs=1e-9)
    a, b, c, d = pinion["ratio_gears"]
    assert a * c / (b * d) == pytest.approx(53 * 48 / (42 * 76), rel=1e-12)


def test_increments_say_what_they_do_in_um(hypoid: Any) -> None:
    """The printed dials lie on minutes: on their own machine rounding does nothing, on another it does."""
    words = ("settings", TILTED, "--increments", "--json", "--machine")
    own, other = (json.loads(hypoid(*words, m)[1]) for m in ("gleason-122", "gleason-106"))
    for member in ("pinion", "wheel"):
        for side in ("concave", "convex"):
            assert own[member][side]["rounding_largest_um"] < 1e-6
            assert 0.05 < other[member][side]["rounding_largest_um"] < 20.0
            assert len(other[member][side]["rounding_um"]) == 5


def test_cam_machine_keeps_its_cam(hypoid: Any) -> None:
    """Lin, Tsay & Fong 1996, Table 2."""
    _, out, _ = hypoid("settings", CAM, "--machine", "gleason-463", "--json")
    convex = json.loads(out)["pinion"]["convex"]
    assert convex["cam_number"] == 23
    assert convex["cam_setting_mm"] == pytest.approx(101.6, abs=1e-6)
    assert convex["cam_guide_angle_deg"] == pytest.approx(5 + 10 / 60, abs=1e-6)


def test_six_axis_table(hypoid: Any) -> None:
    _, out, _ = hypoid("settings", CAM, "--machine", "six-axis", "--positions", "7", "--json")
    table = json.loads(out)["wheel"]["concave"]
    assert {len(column) for column in table.values()} == {7}
    assert table["b_deg"] == pytest.approx([21.25] * 7, abs=1e-9)  # the machine root angle


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--machine", "gleason-999"), "gleason-122"),
        (("--machine", "six-axis", "--positions", "1"), "at least 2"),
        (("--machine", "gleason-463"), "no such motion"),
    ],
)
def test_what_no_machine_can_do(hypoid: Any, words: tuple[str, ...], said: str) -> None:
    status, out, err = hypoid("settings", TILTED, *words)
    assert (status, out) == (2, "")
    assert said in err


def test_wide_tables_are_not_cut_short(hypoid: Any) -> None:
    _, out, _ = hypoid("settings", TILTED, "--machine", "gleason-122")
    assert "64 deg 29 min" in out
    assert "53/42" in out or "24/28" in out
    assert "…" not in out


def test_every_example_has_settings(hypoid: Any) -> None:
    for path in FILES.values():
        status, out, _ = hypoid("settings", path, "--json")
        assert status in (0, 1), Path(path).name
        assert {"pinion", "wheel", "faults", "assumed"} <= json.loads(out).keys()


def test_the_files_own_machine_is_the_machine(hypoid: Any, tmp_path: Path) -> None:
    """Another C with cams in proportion: the same flanks, and `--machine` knows that very grinder."""
    text = Path(CAM).read_text(encoding="utf-8")
    for old, new in (("381 mm", "762 mm"), ("70.302", "140.604"), ("56.439", "112.878")):
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "own.toml"
    path.write_text(text, encoding="utf-8")
    status, out, err = hypoid("settings", str(path), "--machine", "gleason-463", "--json")
    assert (status, err) == (0, "")
    assert json.loads(out)["pinion"]["convex"]["cam_number"] == 23
