"""Coarse compliance of the 2022 pair with relief, made once."""

from __future__ import annotations

from pathlib import Path

import pytest

from hypoid.load import Elements, LoadedContact, ToothCompliance, loaded_contact, tooth_compliance
from hypoid.pair import GearPair

QUICK = Elements(along=10, profile=5, fillet=2, through=2, below=1, rim=1)
TORQUES = (1e2, 1e4, 11e4)  # N mm


@pytest.fixture(scope="session")
def compliance_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("compliance")


@pytest.fixture(scope="session")
def drive_teeth(
    relief_pair: GearPair, compliance_folder: Path
) -> tuple[ToothCompliance, ToothCompliance]:
    return (
        tooth_compliance(relief_pair.pinion, "concave", elements=QUICK, cache=compliance_folder),
        tooth_compliance(relief_pair.wheel, "convex", elements=QUICK, cache=compliance_folder),
    )


@pytest.fixture(scope="session")
def loaded(
    relief_pair: GearPair, drive_teeth: tuple[ToothCompliance, ToothCompliance]
) -> LoadedContact:
    return loaded_contact(relief_pair, "drive", TORQUES, *drive_teeth, positions=9)
