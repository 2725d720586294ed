"""The commands `inspect` and `correct` on files, as a shop uses them."""

from __future__ import annotations

import json
import tomllib

import numpy as np
import pytest
from inspection import bench_of, example

from hypoid.cli import main
from hypoid.cli._correct_options import weights_of
from hypoid.design import build
from hypoid.geometry import DesignError
from hypoid.inspect import measured_points, random_errors
from hypoid.io import example_files, inspection_text, read_layout, read_spec

NAME = "lin-tsay-fong-1996"
FILE = str(next(f for f in example_files() if f.stem == NAME))


@pytest.fixture(scope="module")
def cut(tmp_path_factory):
    """A pinion cut with wrong settings and measured with noise, as a file."""
    one = bench_of(NAME, "pinion")
    random = np.random.default_rng(1)
    put = {}
    for response in one.responses:
        errors = random_errors(response, response.setup.defaults[:5], random)
        for side, value in response.cut(errors).items():
            put[side] = value + random.normal(0.0, 0.0015, 45)
    put["concave"][12] += 0.04
    path = tmp_path_factory.mktemp("measured") / "pinion.csv"
    path.write_text(
        inspection_text(one.grid, read_layout("hypoid"), measured_points(one.grid, put))
    )
    return str(path)


def test_nominal_grid_round_trip(tmp_path, capsys):
    file = tmp_path / "nominal.csv"
    assert (
        main(
            [
                "inspect",
                FILE,
                "--member",
                "wheel",
                "--nominal",
                str(file),
                "--rows",
                "7",
                "--columns",
                "11",
            ]
        )
        == 0
    )
    assert "# rows: 7, root-to-tip" in file.read_text()
    capsys.readouterr()
    words = [
        "inspect",
        FILE,
        "--member",
        "wheel",
        "-m",
        str(file),
        "--rows",
        "7",
        "--columns",
        "11",
        "--json",
    ]
    assert main(words) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["concave"]["largest_um"] < 1e-3
    assert found["convex"]["rms_um"] < 1e-3
    assert np.array(found["convex"]["deviation_um"]).shape == (7, 11)


def test_nominal_json_and_layouts(tmp_path):
    for name, more in (("n.json", []), ("n.txt", ["--layout", "points-axis-x"])):
        file = tmp_path / name
        assert main(["inspect", FILE, "--nominal", str(file), *more]) == 0
        assert main(["inspect", FILE, "-m", str(file)]) == 0


def test_inspect_says_what_is_wrong_and_shows_outliers(cut, tmp_path, capsys):
    assert main(["inspect", FILE, "-m", cut, "--figure", str(tmp_path / "map.svg")]) == 0
    said = capsys.readouterr()
    assert "Outlier, left out of mean and fits: concave, tooth 1, D2" in said.err
    assert "pressure angle [min]" in said.out
    assert (tmp_path / "map.svg").read_text().startswith("<svg")
    assert main(["inspect", FILE, "--member", "wheel", "-m", cut]) == 2
    assert main(["inspect", FILE, "-m", "nowhere.csv", "--json"]) == 2
    assert main(["inspect", FILE, "--rows", "99", "--toe", "150"]) == 2
    said = capsys.readouterr().err
    assert "--rows" in said
    assert "--toe" in said


def test_correct_writes_settings_that_cut_the_flank(cut, tmp_path, capsys):
    """The design with the new settings, read again, is the nominal one with the steps that were told."""
    new, steps = tmp_path / "new.toml", tmp_path / "steps.json"
    words = [
        "correct",
        FILE,
        "-m",
        cut,
        "-o",
        str(new),
        "--save",
        str(steps),
        "--no-contact",
        "--json",
    ]
    assert main(words) == 0
    told = json.loads(capsys.readouterr().out)
    assert [s["sides"] for s in told["setups"]] == [["concave"], ["convex"]]
    for setup in told["setups"]:
        assert setup["rms_predicted_um"] < 1.7
        assert setup["converged"]
        assert setup["undecided"]
    given = tomllib.loads(new.read_text())
    assert given["pinion"]["teeth"] == 27
    assert "# assumed" in new.read_text()
    again = build(read_spec(new))
    one = bench_of(NAME, "pinion")
    total = json.loads(steps.read_text())["total"]
    for response in one.responses:
        (side,) = response.setup.sides
        a, b = again.pinion.flank(side).settings, response.setup.settings(total[side])
        for name in (
            "radial_distance",
            "cradle_angle",
            "machine_root_angle",
            "sliding_base",
            "blank_offset",
        ):
            assert getattr(a, name) == pytest.approx(getattr(b, name), abs=1e-9)
    assert main([*words[:4], "--on-machine", str(steps), "--no-contact", "--json"]) == 0


def test_correct_for_a_designed_pair_and_for_gears(tmp_path, capsys):
    for name, member in (("gonzalez-fuentes-2022", "wheel"), ("tsay-lin-1993", "pinion")):
        one = bench_of(name, member)
        (response,) = one.responses
        errors = {
            "machine_root_angle": 8e-4,
            "ratio_of_roll": 3e-4 * response.setup.adjustments["ratio_of_roll"].value,
        }
        measured, new = tmp_path / f"{name}.csv", tmp_path / f"{name}.toml"
        points = measured_points(one.grid, response.cut(errors))
        measured.write_text(inspection_text(one.grid, read_layout("hypoid"), points))
        file = next(f for f in example_files() if f.stem == name)
        words = [
            "correct",
            str(file),
            "--member",
            member,
            "-m",
            str(measured),
            "-o",
            str(new),
            "--no-contact",
            "--json",
        ]
        assert main(words) == 0
        (setup,) = json.loads(capsys.readouterr().out)["setups"]
        assert setup["rms_predicted_um"] < 1.0
        settings = getattr(build(read_spec(new)), member).concave.settings
        wanted = example(name)[1]
        moved = (
            settings.machine_root_angle
            - getattr(wanted, member).concave.settings.machine_root_angle
        )
        assert moved == pytest.approx(
            np.radians(setup["steps"]["machine_root_angle_deg"]), abs=1e-9
        )
        if name == "tsay-lin-1993":
            assert len(setup["gears"]["ratio_gears"]) == 4


def test_contact_before_now_and_predicted(cut, capsys):
    assert main(["correct", FILE, "-m", cut, "--json"]) == 0
    contact = json.loads(capsys.readouterr().out)["contact"]
    for direction in ("drive", "coast"):
        point = {n: contact[n][direction]["contact_point"]["cone_distance_mm"] for n in contact}
        assert (
            abs(point["predicted"] - point["nominal"])
            < 0.3 * abs(point["now"] - point["nominal"]) + 0.05
        )


def test_correct_tells_every_wrong_option(cut, capsys):
    words = [
        "correct",
        FILE,
        "-m",
        cut,
        "--rank",
        "0",
        "--bounds",
        "cradle_angle=3",
        "--increment",
        "x",
    ]
    assert main([*words, "--json"]) == 2
    said = json.loads(capsys.readouterr().out)["problems"]
    assert [p["path"] for p in said] == ["--rank", "--increment", "--bounds"]
    assert main(["correct", FILE, "-m", cut, "--free", "nonsense"]) == 2
    assert main(["correct", FILE, "-m", cut, "--target", "camber=3 um"]) == 2
    assert main(["correct", FILE, "-m", cut, "--on-machine", cut]) == 2
    other = ["--machine", "basic", "-o", "never.toml", "--no-contact"]
    assert main(["correct", FILE, "-m", cut, *other]) == 2
    assert "--machine gleason-463" in capsys.readouterr().err


def test_weights_are_of_rows_columns_and_points():
    grid = bench_of(NAME, "pinion").grid
    found = weights_of(grid, ("A=0.5", "1=0", "C3=2", "C=3"))["convex"]
    assert found.shape == (5, 9)
    assert (found[0] == 0.0).all()
    assert found[2].tolist() == [0.5, 1.0, 6.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]
    assert weights_of(grid, ()) == {}
    with pytest.raises(DesignError) as caught:
        weights_of(grid, ("Z9=1", "A=-1", "A=x", "A"))
    assert [p.path for p in caught.value.problems] == ["--weight"] * 4


def test_identify(cut, capsys):
    words = [
        "inspect",
        FILE,
        "-m",
        cut,
        "--identify",
        "--free",
        "machine_root_angle,eccentric_angle",
        "--json",
    ]
    assert main(words) == 0
    setups = json.loads(capsys.readouterr().out)["setups"]
    assert [s["sides"] for s in setups] == [["concave"], ["convex"]]
    assert setups[0]["rms_um"] < 3.0
