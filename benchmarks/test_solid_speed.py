"""Speed of teeth and solids; run with `make bench`.

Targets, warm, on two cores: the whole 73-tooth wheel as a watertight mesh of 5 um chord error under 3 s; a
merged tooth of 61 x 61 places a flank under 0.3 s.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import hypoid
from hypoid.io import write_mesh
from hypoid.pair import GearPair
from hypoid.solid import surface_mesh

EXAMPLE = Path(__file__).parent.parent / "examples" / "gonzalez-fuentes-2022.toml"
MEMBERS = ("pinion", "wheel")


@pytest.fixture(scope="module")
def pair() -> GearPair:
    return hypoid.read(EXAMPLE)


@pytest.mark.parametrize("name", MEMBERS)
def test_merged_tooth(benchmark: Any, pair: GearPair, name: str) -> None:
    tooth = getattr(pair, name).tooth
    tooth.grid(61, 61)
    benchmark.pedantic(tooth.grid, (61, 61), rounds=9)


@pytest.mark.parametrize("name", MEMBERS)
def test_whole_gear_at_five_micrometres(benchmark: Any, pair: GearPair, name: str) -> None:
    member = getattr(pair, name)

    def watertight() -> Any:
        mesh = surface_mesh(member, chord_error=5e-3)
        assert mesh.watertight
        return mesh

    watertight()
    mesh = benchmark.pedantic(watertight, rounds=5)
    benchmark.extra_info["triangles"] = len(mesh.triangles)
    benchmark.extra_info["chord_error_um"] = round(mesh.chord_error * 1e3, 2)


@pytest.mark.parametrize("kind", ["stl", "ply", "glb", "obj"])
def test_whole_wheel_to_a_file(benchmark: Any, pair: GearPair, tmp_path: Path, kind: str) -> None:
    mesh = surface_mesh(pair.wheel, chord_error=5e-3)
    benchmark.pedantic(write_mesh, (mesh, tmp_path / f"wheel.{kind}"), rounds=2)
