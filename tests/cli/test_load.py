"""`hypoid load` and `hypoid stress`: names that scripts rely on, figures, and what is refused."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from hypoid.cli import main
from hypoid.io import example_files

RELIEF = str(next(f for f in example_files() if f.stem == "gonzalez-fuentes-2022-relief"))
QUICK = ("--mesh", "coarse", "--positions", "5")


@pytest.fixture
def hypoid(capsys: pytest.CaptureFixture[str]) -> Any:
    def run(*argv: str) -> tuple[int, str, str]:
        status = main(argv)
        return status, *capsys.readouterr()

    return run


@pytest.mark.slow
def test_load_has_the_names_that_scripts_rely_on(hypoid: Any, tmp_path: Path) -> None:
    drawn = tmp_path / "load.png"
    words = ("--torque", "30 N m", "--torque", "10 N m", "--figure", str(drawn), "--json")
    status, out, _ = hypoid("load", RELIEF, *words, *QUICK)
    assert status == 0
    result = json.loads(out)
    assert result["complete"] is True
    assert [case["torque_Nm"] for case in result["cases"]] == [10.0, 30.0]
    for case in result["cases"]:
        assert case["max_pressure_MPa"] > 0.0
        assert case["transmission_error_peak_to_peak_urad"] > 0.0
        assert set(case["max_root_stress_MPa"]) == {"pinion", "wheel"}
        assert len(case["positions"]) == 5
        for position in case["positions"]:
            assert len(position["load_share"]) == position["pairs_in_contact"]
            assert sum(position["load_share"]) == pytest.approx(1.0, abs=1e-9)
            assert position["max_pressure_MPa"] <= case["max_pressure_MPa"]
            pinion = position["bearings"]["pinion"]
            assert pinion["force_N"][2] == position["pinion_axial_force_N"]
            assert abs(pinion["moment_Nm"][2]) == pytest.approx(case["torque_Nm"], rel=1e-9)
            assert pinion["displacement_mm"] == [0.0, 0.0, 0.0]  # nothing is said of bearings
            assert position["bearing_misalignment"]["offset_um"] == pytest.approx(0.0, abs=1e-6)
    assert any("206 GPa" in a["value"] for a in result["assumed"])
    assert drawn.read_bytes().startswith(b"\x89PNG")
    status, out, _ = hypoid("load", RELIEF, *words[:2], *QUICK)
    assert "greatest pressure [MPa]" in out


@pytest.mark.slow
def test_stress_by_member_and_over_time(hypoid: Any, tmp_path: Path) -> None:
    drawn = tmp_path / "stress.svg"
    words = ("--torque", "30 N m", "--figure", str(drawn))
    status, out, _ = hypoid("stress", RELIEF, *words, *QUICK, "--json")
    assert status == 0
    (case,) = json.loads(out)["cases"]
    for name, side in (("pinion", "concave"), ("wheel", "convex")):
        member = case[name]
        assert member["side"] == side
        assert member["max_principal_MPa"] == case["max_root_stress_MPa"][name]
        assert max(member["principal_there_MPa"]) == pytest.approx(member["max_principal_MPa"])
        assert len(member["pinion_angle_deg"]) == len(member["principal_there_MPa"])
        assert member["most_compressed_MPa"] < 0.0
    assert drawn.read_text(encoding="utf-8").startswith("<svg")
    status, out, _ = hypoid("stress", RELIEF, *words[:2], *QUICK)
    assert "max_von_mises_MPa" in out


@pytest.mark.parametrize("command", ["load", "stress"])
def test_all_that_is_wrong_is_told_at_once(hypoid: Any, command: str) -> None:
    words = ("--torque", "-110 N m", "--torque", "5", "--poissons-ratio", "0.5", "--positions", "4")
    status, out, err = hypoid(command, RELIEF, *words, "--figure", "nowhere/x.gif", "--json")
    assert status == 2
    paths = [problem["path"] for problem in json.loads(out)["problems"]]
    assert paths == ["--torque", "--torque", "--positions", "--poissons-ratio", "--figure"]
    assert "coast" in err
    assert '"5 N m"' in err


def test_no_torque(hypoid: Any) -> None:
    status, _, err = hypoid("load", RELIEF)
    assert status == 2
    assert '--torque "110 N m"' in err


@pytest.mark.parametrize("text", ["0", "-5", "0 N m", "1e999", "much"])
@pytest.mark.parametrize("command", [("load",), ("export", "--calculix", "nowhere.inp")])
def test_the_example_of_a_torque_is_one_that_works(
    hypoid: Any, command: tuple[str, ...], text: str
) -> None:
    status, _, err = hypoid(command[0], RELIEF, *command[1:], f"--torque={text}")
    assert status == 2
    assert '--torque "110 N m"' in err


@pytest.mark.slow
def test_a_report_under_load(hypoid: Any, tmp_path: Path) -> None:
    target = tmp_path / "report.html"
    words = ("--torque", "10 N m", "--torque", "30 N m", "-o", str(target))
    status, _, _ = hypoid("report", RELIEF, *words, *QUICK)
    assert status == 0
    text = target.read_text(encoding="utf-8")
    section = text[text.index('id="under-load"') :]
    assert section.count("<svg") >= 2
    assert "Harris map" in section
    assert "206 GPa" in section


def test_a_report_tells_what_is_wrong_with_its_load_before_it_computes(hypoid: Any) -> None:
    status, _, err = hypoid("report", RELIEF, "--torque", "5", "--poissons-ratio", "0.6")
    assert status == 2
    assert "--torque" in err
    assert "--poissons-ratio" in err


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_an_interrupt_of_the_real_command_keeps_finished_positions(tmp_path: Path) -> None:
    """SIGINT in the second position: status 130, JSON with those done, and nothing else on standard output.

    In the second, as the first is kept only once its torques are all done. Where tests run in the background SIGINT is
    ignored, and so would the command do: it is told to listen.
    """
    words = [
        "load",
        RELIEF,
        "--torque",
        "30 N m",
        "--mesh",
        "coarse",
        "--positions",
        "81",
        "--json",
    ]
    code = (
        "import sys; from hypoid.cli import main; import hypoid.load._loaded as l, signal\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "made = l._position\n"
        "def position(*given):\n"
        "    found = made(*given)\n"
        "    print('position', file=sys.stderr, flush=True)\n"
        "    return found\n"
        "l._position = position\n"
        f"sys.exit(main({words!r}))"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stderr is not None
    seen = (line for line in process.stderr if line.startswith("position"))
    next(seen)
    next(seen)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=120)
    assert process.returncode == 130, err
    result = json.loads(out)
    assert result["complete"] is False
    assert 1 <= len(result["cases"][0]["positions"]) < 40
    assert "Interrupted" in err


@pytest.mark.parametrize("radius", ["-0.1 mm", "3 mm", "0.2"])
def test_a_tip_rounding_that_is_none(hypoid: Any, radius: str) -> None:
    status, _, err = hypoid("load", RELIEF, "--torque", "5 N m", "--tip-rounding", radius)
    assert status == 2
    assert "--tip-rounding" in err
    assert '"0.2 mm"' in err or "mm" in err


def test_a_face_that_holds_nothing(hypoid: Any) -> None:
    status, _, err = hypoid("load", RELIEF, "--torque", "5 N m", "--pinion-held", "teeth")
    assert status == 2
    assert "bore" in err
    assert "back" in err
