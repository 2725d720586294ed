"""The commands: what goes to which stream, the names that scripts rely on, the exit status."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from hypoid.cli import main
from hypoid.io import example_files

EXAMPLE = str(next(f for f in example_files() if f.name == "gonzalez-fuentes-2022.toml"))


@pytest.fixture
def hypoid(capsys: pytest.CaptureFixture[str]) -> Any:
    def run(*argv: str) -> tuple[int, str, str]:
        status = main(argv)
        return status, *capsys.readouterr()

    return run


def bad(tmp_path: Path, old: str, new: str) -> str:
    text = Path(EXAMPLE).read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "bad.toml"
    path.write_text(text.replace(old, new), encoding="utf-8")
    return str(path)


def test_blank_has_the_names_that_scripts_rely_on(hypoid: Any) -> None:
    status, out, _ = hypoid("blank", EXAMPLE, "--json")
    result = json.loads(out)
    assert status == 0
    pair, pinion, wheel = result["pair"], result["pinion"], result["wheel"]
    assert pair["mean_normal_module_mm"] == pytest.approx(2.716, abs=5e-4)
    assert pair["limit_pressure_angle_deg"] == pytest.approx(-0.649, abs=5e-4)
    assert {"shaft_angle_deg", "offset_mm"} <= pair.keys()
    assert (pinion["teeth"], pinion["hand"], wheel["teeth"], wheel["hand"]) == (
        6,
        "left",
        73,
        "right",
    )
    named = (
        "pitch_angle_deg mean_spiral_angle_deg mean_pitch_diameter_mm outer_pitch_diameter_mm "
        "mean_cone_distance_mm outer_cone_distance_mm face_width_mm "
        "pitch_apex_beyond_crossing_point_mm mean_addendum_mm mean_dedendum_mm outer_addendum_mm "
        "outer_dedendum_mm face_angle_deg root_angle_deg"
    )
    for member in (pinion, wheel):
        assert set(named.split()) <= member.keys()


def test_blank_for_people_is_a_table(hypoid: Any) -> None:
    status, out, _ = hypoid("blank", EXAMPLE)
    assert status == 0
    assert "mean_normal_module_mm" in out
    assert "10.7913" in out


@pytest.mark.parametrize("command", ["check", "blank", "settings", "flank", "contact", "report"])
def test_bad_file_is_status_2_with_problems_as_json(
    hypoid: Any, tmp_path: Path, command: str
) -> None:
    path = bad(tmp_path, '"65 deg"', '"95 deg"')
    status, out, err = hypoid(command, path, "--json")
    (problem,) = json.loads(out)["problems"]
    assert status == 2
    assert problem["path"] == "pinion.mean_spiral_angle"
    assert set(problem) == {"path", "given", "expected", "example"}
    assert "pinion.mean_spiral_angle" in err
    assert hypoid(command, path)[:2] == (2, "")


@pytest.mark.parametrize(
    ("old", "new", "path"),
    [
        ('cutter_radius = "100 mm"', 'cutter_radius = "5 mm"', "cutting.cutter_radius"),
        ('offset = "55 mm"', 'offset = "129 mm"', "pinion.mean_spiral_angle"),
    ],
)
def test_geometry_that_cannot_be_is_bad_input(
    hypoid: Any, tmp_path: Path, old: str, new: str, path: str
) -> None:
    status, out, _ = hypoid("blank", bad(tmp_path, old, new), "--json")
    assert status == 2
    assert json.loads(out)["problems"][0]["path"] == path


@pytest.mark.parametrize(
    "argv",
    [
        ("blank",),
        ("blank", EXAMPLE, "--colour"),
        ("blnk", EXAMPLE),
        ("flank", EXAMPLE, "--rows", "1"),
        ("flank", EXAMPLE, "--side", "left"),
        ("contact", EXAMPLE, "--offset", "0.1"),
        ("contact", EXAMPLE, "--offset", "1 deg", "--shaft-angle", "-1 mm"),
        ("report", EXAMPLE, "-o", "no/such/folder/report.html"),
        ("blank", "no/such/file.toml"),
        ("blank", "."),
    ],
)
def test_bad_command_lines_are_status_2(hypoid: Any, argv: tuple[str, ...]) -> None:
    status, out, err = hypoid(*argv)
    assert (status, out) == (2, "")
    assert "expected:" in err
    assert json.loads(hypoid(*argv, "--json")[1])["problems"]


def test_options_with_units_report_all_their_problems(hypoid: Any) -> None:
    argv = ("contact", EXAMPLE, "--offset", "1 deg", "--shaft-angle", "3", "--json")
    _, out, _ = hypoid(*argv)
    found = {p["path"]: p["example"] for p in json.loads(out)["problems"]}
    assert found == {"--offset": '--offset "55 mm"', "--shaft-angle": '--shaft-angle "3 deg"'}


def test_examples_are_copied_and_work(hypoid: Any, tmp_path: Path) -> None:
    status, _, _ = hypoid("examples", "--copy-to", str(tmp_path))
    assert status == 0
    assert {f.name for f in tmp_path.iterdir()} == {f.name for f in example_files()}
    listed = json.loads(hypoid("examples", "--json")[1])["examples"]
    assert [Path(entry["file"]).name for entry in listed] == [f.name for f in example_files()]
    assert hypoid("examples", "--copy-to", str(tmp_path / "none"))[0] == 2


def test_schema_is_written_for_editors(hypoid: Any) -> None:
    assert json.loads(hypoid("examples", "--schema")[1])["title"] == "Hypoid design file"


def test_help_names_every_command(hypoid: Any) -> None:
    status, out, _ = hypoid("--help")
    assert status == 0
    for command in ("check", "blank", "settings", "flank", "contact", "report", "examples"):
        assert command in out


def test_interrupt_is_status_130(hypoid: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("hypoid.io.read_spec", interrupted)
    status, out, err = hypoid("blank", EXAMPLE)
    assert (status, out, err) == (130, "", "Interrupted.\n")


def test_reader_that_stops_early_is_no_error() -> None:
    process = subprocess.Popen(
        [
            sys.executable,
            "-c",
            "from hypoid.cli import main; raise SystemExit(main())",
            "blank",
            EXAMPLE,
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert process.stdout is not None
    process.stdout.close()
    _, err = process.communicate(timeout=60)
    assert (process.returncode, err) == (0, b"")
