"""Summary sheets at the command line: there and back through what is printed, and bad ones."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomlkit
from sheets import ON_122, ON_463, Changes, text

import hypoid
from hypoid.cli import main
from hypoid.io import example_files

TILTED = next(f for f in example_files() if f.stem == "tsay-lin-1993")
UNITS = {"_mm_per_rad": " mm/rad", "_mm": " mm", "_deg": " deg"}


def test_dials_of_a_no_122_as_printed_basic_settings(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Tsay & Lin 1993, tilted pinion and Formate gear, with an offset: one surface to 1e-9 mm."""
    main(["settings", str(TILTED), "--json"])
    printed = json.loads(capsys.readouterr().out)
    document: Any = tomlkit.parse(TILTED.read_text(encoding="utf-8"))
    for member in ("pinion", "wheel"):
        settings = {"method": document[member]["settings"]["method"], "machine": "basic"}
        for name, value in printed[member]["concave"].items():
            end = next((end for end in UNITS if name.endswith(end)), "")
            if end and value:
                settings[name.removesuffix(end)] = f"{value!r}{UNITS[end]}"
        if printed[member]["concave"]["generated"]:
            settings["ratio_of_roll"] = printed[member]["concave"]["ratio_of_roll"]
        document[member]["settings"] = settings
    del document["assumed"]
    file = tmp_path / "basic.toml"
    file.write_text(tomlkit.dumps(document), encoding="utf-8")
    for dialled, basic in zip(
        hypoid.read(TILTED).flanks(), hypoid.read(file).flanks(), strict=True
    ):
        places = np.meshgrid(np.linspace(dialled.toe, dialled.heel, 5), [-4.0, -1.0, 1.0])
        one, other = (flank.at_cone(*places) for flank in (dialled, basic))
        assert one.ok.sum() > 8
        assert np.abs(one.position - other.position)[one.ok].max() < 1e-9


BAD: dict[str, tuple[Changes, str]] = {
    "a dial": ({**ON_122, "pinion.settings.eccentric_angle": "181 deg"}, "from 0 deg to 180 deg"),
    "the cam": (
        {**ON_463, "machine.gleason-463.cams.23.half_breadth": "10 mm"},
        "a roll within the uniform motion of the cam",
    ),
    "zero teeth": ({"pinion.teeth": 0}, "from 1 to 1000"),
    "the edge": ({"pinion.blade.edge_radius": "5 mm"}, "the largest that fits"),
    "the tables": ({"pinion": [[{}]], "wheel": "x"}, "one table, [wheel]"),
    "no cutter": ({"pinion.cutter": None}, "diameter and point_width"),
}


@pytest.mark.parametrize("name", BAD)
@pytest.mark.parametrize("command", ["check", "settings", "flank", "report"])
def test_a_bad_sheet_is_status_2_and_leaves_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str, name: str
) -> None:
    changes, expected = BAD[name]
    file, target = tmp_path / "bad.toml", tmp_path / "out"
    file.write_text(text(changes), encoding="utf-8")
    output = ["-o", str(target)] if command in ("flank", "report") else []
    assert main([command, str(file), *output]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert expected in err
    assert "Traceback" not in err
    assert not target.exists()


def test_a_tilt_beyond_what_the_wedge_allows(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "tilt.toml"
    tilt = {"pinion.settings.method": "tilt", "pinion.settings.tilt_angle": "31 deg"}
    file.write_text(text(tilt), encoding="utf-8")
    assert main(["settings", str(file), "--machine", "gleason-122", "--json"]) == 2
    told = {p["path"]: p for p in json.loads(capsys.readouterr().out)["problems"]}
    problem = told["pinion.concave.settings.tilt_angle"]
    assert problem["given"] == "31 deg"
    assert "from 0 deg to 30 deg" in problem["expected"]
