"""`hypoid export`: files that other programs read, what is said of them, and what is refused."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
import trimesh

import hypoid
from hypoid.cli import main
from hypoid.geometry import DesignError, Problem
from hypoid.io import example_files, write_mesh
from hypoid.solid import SurfaceMesh, surface_mesh

FILES = {file.stem: file for file in example_files()}
EXAMPLE = str(FILES["gonzalez-fuentes-2022"])
COARSE = ("--chord-error", "0.1mm")
KINDS = ("stl", "ply", "obj", "glb")


@pytest.fixture
def export(capsys: pytest.CaptureFixture[str]) -> Any:
    def run(*argv: str) -> tuple[int, str, str]:
        status = main(["export", *argv])
        return status, *capsys.readouterr()

    return run


@pytest.fixture(scope="module")
def wheel_tooth() -> SurfaceMesh:
    return surface_mesh(hypoid.read(EXAMPLE).wheel, teeth=2, chord_error=0.02)


def read_back(path: Path) -> Any:
    """One mesh of all that a file holds, mm, by the reader of another's making."""
    found = trimesh.load(path)
    if isinstance(found, trimesh.Scene):
        found = found.to_mesh()
        found.apply_scale(1e3)  # GLB is in metres
        found.merge_vertices(merge_norm=True, merge_tex=True)
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_other_programs_read_the_same_solid(
    wheel_tooth: SurfaceMesh, tmp_path: Path, kind: str
) -> None:
    path = write_mesh(wheel_tooth, tmp_path / f"tooth.{kind}")
    seen = read_back(path)
    assert seen.is_volume
    assert len(seen.faces) == len(wheel_tooth.triangles)
    assert seen.volume == pytest.approx(wheel_tooth.volume, rel=1e-5)  # single precision
    assert seen.bounds == pytest.approx(
        np.array([wheel_tooth.vertices.min(axis=0), wheel_tooth.vertices.max(axis=0)]), abs=2e-5
    )
    assert [f.name for f in tmp_path.iterdir()] == [path.name]


def test_glb_names_the_surfaces_and_shades_them_by_their_own_normals(
    wheel_tooth: SurfaceMesh, tmp_path: Path
) -> None:
    scene = trimesh.load(write_mesh(wheel_tooth, tmp_path / "tooth.glb"))
    assert set(scene.geometry) == set(wheel_tooth.groups)
    for name, part in scene.geometry.items():
        vertices, triangles, normals = wheel_tooth.part(name)
        assert (len(part.vertices), len(part.faces)) == (len(vertices), len(triangles))
        assert part.vertex_normals == pytest.approx(normals, abs=1e-5)


@pytest.mark.parametrize("kind", ["ply", "obj"])
def test_normals_go_with_the_vertices(wheel_tooth: SurfaceMesh, tmp_path: Path, kind: str) -> None:
    path = write_mesh(wheel_tooth, tmp_path / f"tooth.{kind}")
    seen = trimesh.load(path, process=False)
    if len(seen.vertices) == len(wheel_tooth.vertices):
        assert seen.vertex_normals == pytest.approx(wheel_tooth.normals, abs=1e-5)


def test_one_file_a_member_and_all_kinds_in_one_call(export: Any, tmp_path: Path) -> None:
    outputs = [word for kind in KINDS for word in (f"--{kind}", str(tmp_path / f"out.{kind}"))]
    status, out, err = export(EXAMPLE, *outputs, *COARSE, "--teeth", "1", "--json")
    assert status == 0
    files = json.loads(out)["files"]
    assert {Path(f["file"]).name for f in files} == {
        f"out-{member}.{kind}" for member in ("pinion", "wheel") for kind in KINDS
    }
    assert {f.name for f in tmp_path.iterdir()} == {Path(f["file"]).name for f in files}
    for file in files:
        assert file["watertight"] is True
        assert 0.0 < file["chord_error_um"] <= 100.0
        assert file["teeth"] == 1
        seen = read_back(Path(file["file"]))
        assert len(seen.faces) == file["triangles"]
        assert seen.volume == pytest.approx(file["volume_mm3"], rel=1e-5)
        assert file["mass_kg"] == pytest.approx(7.85e-6 * file["volume_mm3"])
    assert "pinion" in err
    assert "wheel" in err


def test_one_member_keeps_its_name_and_people_see_a_table(export: Any, tmp_path: Path) -> None:
    path = tmp_path / "gear.STL"
    status, out, _ = export(EXAMPLE, "--stl", str(path), "--member", "wheel", *COARSE)
    assert status == 0
    assert trimesh.load(path).is_volume
    for word in ("gear.STL", "triangles", "chord_error_um", "volume_mm3", "mass_kg", "watertight"):
        assert word in out


@pytest.mark.parametrize("name", FILES)
def test_every_example_is_exported(export: Any, tmp_path: Path, name: str) -> None:
    """In every format (STEP: `tests/io/test_step.py`), read by programs of others' making."""
    kinds = (*KINDS, "inp", "vtu")
    outputs = [word for kind in kinds for word in (f"--{kind}", str(tmp_path / f"out.{kind}"))]
    outputs += ["--points", str(tmp_path / "out.csv")]
    status, out, _ = export(str(FILES[name]), *outputs, *COARSE, "--json")
    result = json.loads(out)
    assert status == (1 if result["faults"] else 0)
    pair = hypoid.read(FILES[name])
    for file in result["files"]:
        member, path = getattr(pair, file["member"]), Path(file["file"])
        if file["format"] in KINDS:
            seen = read_back(path)
            assert file["teeth"] == member.teeth
            assert seen.is_volume
            assert seen.volume == pytest.approx(file["volume_mm3"], rel=1e-5)
        elif file["format"] == "points":
            rows = np.loadtxt(path, delimiter=",", skiprows=2, usecols=range(10))
            assert len(rows) == 61 * 61
        else:
            seen = meshio.read(path)
            cells = [block for block in seen.cells if block.type == "hexahedron20"]
            assert sum(len(block.data) for block in cells) == file["elements"]
            assert len(seen.points) == file["nodes"]
    found = {(f["format"], f["member"]) for f in result["files"]}
    assert found == {(k, m) for k in (*kinds, "points") for m in ("pinion", "wheel")}


def test_bore_is_a_diameter(export: Any, tmp_path: Path) -> None:
    path = tmp_path / "gear.stl"
    argv = ("--stl", str(path), "--member", "wheel", "--bore", "120 mm", "--teeth", "2", *COARSE)
    assert export(EXAMPLE, *argv)[0] == 0
    assert np.hypot(*trimesh.load(path).vertices[:, :2].T).min() == pytest.approx(60.0, abs=1e-4)


def test_points_are_the_flanks_of_a_tooth(export: Any, tmp_path: Path) -> None:
    argv = ("--points", str(tmp_path / "p.csv"), "--member", "wheel", "--json")
    status, out, _ = export(EXAMPLE, *argv)
    assert status == 0
    wheel = hypoid.read(EXAMPLE).wheel
    assert [Path(f["file"]).name for f in json.loads(out)["files"]] == [
        "p-concave.csv",
        "p-convex.csv",
    ]
    _, *lines = (tmp_path / "p-concave.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(lines))
    assert {row["status"] for row in rows} == {"ok"}
    # above the lowest row, where printed digits of (z, rho) do not say where around the axis
    upper = [row for row in rows if row["row"] != "0"]
    keys = ("x_mm", "y_mm", "z_mm", "normal_x", "normal_y", "normal_z")
    values = np.array([[float(row[key]) for key in keys] for row in upper])
    exact = wheel.concave.at(values[:, 2], np.hypot(values[:, 0], values[:, 1]))
    assert (len(rows), len(upper)) == (61 * 61, 60 * 61)
    assert exact.ok.all()
    assert values == pytest.approx(np.hstack([exact.position, exact.normal]), abs=1e-8)


@pytest.mark.parametrize(
    ("argv", "paths"),
    [
        ((), ["command line"]),
        (("--stl", "OUT.ply"), ["--stl"]),
        (("--stl", "none/OUT.stl", "--obj", "OUT"), ["--stl", "--obj"]),
        (("--points", "folder.csv"), ["--points"]),
        (("--stl", "OUT.stl", "--chord-error", "0 um"), ["--chord-error"]),
        (("--stl", "OUT.stl", "--chord-error", "-5 um"), ["--chord-error"]),
        (("--stl", "OUT.stl", "--chord-error", "5", "--bore", "7"), ["--chord-error", "--bore"]),
        (("--stl", "OUT.stl", "--teeth", "0", "--member", "wheel"), ["--teeth"]),
        (("--stl", "OUT.stl", "--teeth", "7"), ["--teeth"]),
        (("--stl", "OUT.stl", "--teeth", "some"), ["--teeth"]),
        (("--stl", "OUT.stl", "--teeth", "1.5"), ["--teeth"]),
        (("--stl", "OUT.stl", "--bore", "-1 mm", "--member", "pinion"), ["--bore"]),
        (
            ("--stl", "OUT", "--bore", "900 mm", "--teeth", "80", "--chord-error", "1 m"),
            ["--stl", "--chord-error", "--teeth", "--bore", "--teeth", "--bore"],
        ),
    ],
)
def test_all_that_is_wrong_is_said_and_nothing_written(
    export: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, argv: Any, paths: list[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for side in ("concave", "convex"):
        for member in ("pinion", "wheel"):
            (tmp_path / f"folder-{member}-{side}.csv").mkdir()
    before = sorted(tmp_path.rglob("*"))
    status, out, err = export(EXAMPLE, *argv, "--json")
    problems = json.loads(out)["problems"]
    assert status == 2
    assert [p["path"] for p in problems] == paths
    assert "Traceback" not in err
    assert sorted(tmp_path.rglob("*")) == before


def test_a_bore_too_large_names_what_is_admissible(export: Any, tmp_path: Path) -> None:
    argv = ("--stl", str(tmp_path / "x.stl"), "--member", "pinion", "--bore", "40 mm", "--json")
    (problem,) = json.loads(export(EXAMPLE, *argv)[1])["problems"]
    assert "between 0 and 22.47 mm" in problem["expected"]


def test_a_design_file_and_its_options_are_judged_together(export: Any, tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    text = Path(EXAMPLE).read_text(encoding="utf-8").replace('"65 deg"', '"95 deg"')
    path.write_text(text, encoding="utf-8")
    status, out, _ = export(str(path), "--stl", "x.ply", "--json")
    assert status == 2
    assert [p["path"] for p in json.loads(out)["problems"]] == [
        "--stl",
        "pinion.mean_spiral_angle",
    ]


def test_a_file_that_cannot_be_written_is_left_as_it_was(
    export: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "gear.stl"
    path.write_text("as it was", encoding="utf-8")

    def full(*_: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    argv = ("--stl", str(path), "--member", "wheel", "--teeth", "1", *COARSE)
    status, out, err = export(EXAMPLE, *argv)
    assert (status, out) == (2, "")
    assert "No space left on device" in err
    assert path.read_text(encoding="utf-8") == "as it was"
    assert [f.name for f in tmp_path.iterdir()] == ["gear.stl"]


def test_one_file_that_fails_keeps_all_back(
    export: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(path: Path, *_: Any) -> None:
        raise DesignError([Problem(str(path), "a full disk", "room", "another disk")])

    monkeypatch.setattr("hypoid.io._points.write_text", failing)
    outputs = ("--stl", str(tmp_path / "x.stl"), "--points", str(tmp_path / "x.csv"))
    status, out, _ = export(
        EXAMPLE, *outputs, "--teeth", "1", "--member", "wheel", *COARSE, "--json"
    )
    assert status == 2
    assert [p["path"] for p in json.loads(out)["problems"]] == [str(tmp_path / "x-concave.csv")]
    assert not list(tmp_path.iterdir())


def test_names_that_no_file_can_have_are_refused(export: Any, tmp_path: Path) -> None:
    path = tmp_path / f"{'x' * 300}.stl"
    status, out, err = export(EXAMPLE, "--stl", str(path), "--teeth", "1", *COARSE)
    assert (status, out) == (2, "")
    assert "Traceback" not in err
    assert not list(tmp_path.iterdir())


def test_contact_model_that_cannot_be_is_told_all_at_once(export: Any, tmp_path: Path) -> None:
    target = str(tmp_path / "contact.txt")
    words = ("--calculix", target, "--member", "wheel", "--torque=-110 N m", "--position", "12 mm")
    status, _, err = export(EXAMPLE, *words, "--poissons-ratio", "0.5", "--finer", "0")
    assert status == 2
    told = (
        "ends in .inp",
        "--finer 4",
        "--direction coast",
        "pinion and wheel",
        "--position",
        "less than 0.5",
    )
    for words in told:
        assert words in err
    status, _, err = export(EXAMPLE, "--calculix", str(tmp_path / "contact.inp"))
    assert status == 2
    assert "--torque" in err
    status, _, err = export(EXAMPLE, "--torque", "5 N m", "--stl", str(tmp_path / "a.stl"))
    assert status == 2
    assert "--calculix contact.inp" in err
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_contact_model_of_a_sector(export: Any, tmp_path: Path) -> None:
    relief = str(FILES["gonzalez-fuentes-2022-relief"])
    path = tmp_path / "contact.inp"
    words = ("--calculix", str(path), "--torque", "30 N m", "--position", "12 deg", "--json")
    status, _, err = export(relief, *words, "--teeth", "2")
    assert status == 2
    assert "at least" in err
    assert "bear load" in err
    assert not list(tmp_path.iterdir())
    status, out, _ = export(relief, *words)
    assert status == 0
    (known,) = json.loads(out)["files"]
    assert (known["teeth_pinion"], known["torque_Nm"]) == (6, 30.0)
    assert known["teeth_wheel"] >= 5
    assert known["surface_error_um"] < 1.0
    text = path.read_text()
    assert text.count("*CONTACT PAIR") == len(known["pairs"])
    assert text.count("*END STEP") == 2
