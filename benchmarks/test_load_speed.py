"""Speed of the loaded contact; run with `make bench`.

Targets, on two cores: the compliance of both members under 60 s with SciPy alone, once; then 21 positions by 7
torques under 10 s, one more misalignment under 2 s.
"""

from __future__ import annotations

import resource
from pathlib import Path
from typing import Any

import pytest

import hypoid
from hypoid.contact import Misalignment
from hypoid.load import MESHES, STEEL, ToothCompliance, loaded_contact, tooth_compliance
from hypoid.load._setup import elements_of
from hypoid.pair import GearPair

EXAMPLE = Path(__file__).parent.parent / "examples" / "gonzalez-fuentes-2022-relief.toml"
TORQUES = [t * 1e3 for t in (5.0, 20.0, 40.0, 60.0, 80.0, 100.0, 110.0)]  # N mm


@pytest.fixture(scope="module")
def pair() -> GearPair:
    return hypoid.read(EXAMPLE)


@pytest.fixture(scope="module")
def teeth(pair: GearPair, tmp_path_factory: pytest.TempPathFactory) -> tuple[ToothCompliance, ...]:
    return both(pair, tmp_path_factory.mktemp("compliance"))


def both(pair: GearPair, folder: Path) -> tuple[ToothCompliance, ...]:
    flanks = zip((pair.pinion, pair.wheel), pair.mates("drive"), strict=True)
    return tuple(
        tooth_compliance(
            member, flank.side, STEEL, elements_of(member, MESHES["usual"]), cache=folder
        )
        for member, flank in flanks
    )


def test_compliance_of_both_members(benchmark: Any, pair: GearPair, tmp_path: Path) -> None:
    made = benchmark.pedantic(both, (pair, tmp_path), rounds=1)
    benchmark.extra_info["nodes"] = [one.nodes for one in made]
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    benchmark.extra_info["peak_memory_gib"] = round(peak, 2)


def test_twenty_one_positions_by_seven_torques(
    benchmark: Any, pair: GearPair, teeth: tuple[ToothCompliance, ToothCompliance]
) -> None:
    loaded_contact(pair, "drive", TORQUES[:1], *teeth, positions=5)  # compiles the unloaded contact
    found = benchmark.pedantic(
        loaded_contact, (pair, "drive", TORQUES, *teeth), {"positions": 21}, rounds=3
    )
    assert len(found.cases) == len(TORQUES)


def test_one_more_misalignment(
    benchmark: Any, pair: GearPair, teeth: tuple[ToothCompliance, ToothCompliance]
) -> None:
    """One torque, 21 positions."""
    error = Misalignment(pinion_axial=0.05)
    loaded_contact(pair, "drive", TORQUES[:1], *teeth, positions=5)
    benchmark.pedantic(
        loaded_contact,
        (pair, "drive", TORQUES[-1:], *teeth),
        {"positions": 21, "misalignment": error},
        rounds=3,
    )
