"""A measured pinion under load: its exact departure in place, its teeth as stiff as the nominal ones."""

from __future__ import annotations

import numpy as np
import pytest

from hypoid.inspect import measuring_grid, pair_as_measured
from hypoid.load import LoadedContact, ToothCompliance, loaded_contact
from hypoid.pair import GearPair

from .conftest import TORQUES


def test_a_measured_flank_bears_a_load(
    relief_pair: GearPair,
    drive_teeth: tuple[ToothCompliance, ToothCompliance],
    loaded: LoadedContact,
) -> None:
    """Nothing measured changes nothing; 20 um of lengthwise crowning shorten the contact and raise its peak."""
    grid = measuring_grid(relief_pair.pinion)
    rows, columns = grid.rows, grid.columns
    flat = np.zeros((rows, columns))
    same, _ = pair_as_measured(relief_pair, grid, {"concave": flat})
    found = loaded_contact(same, "drive", TORQUES[-1:], *drive_teeth, positions=9)
    nominal = loaded.cases[-1]
    assert found.cases[0].max_pressure == pytest.approx(
        nominal.max_pressure, rel=0.015
    )  # contact windows settle anew and move a peak by about 1 %
    crown = flat - 0.02 * np.linspace(-1.0, 1.0, columns) ** 2
    worn, _ = pair_as_measured(relief_pair, grid, {"concave": crown})
    found = loaded_contact(worn, "drive", TORQUES[-1:], *drive_teeth, positions=9)
    assert found.cases[0].max_pressure > 1.05 * nominal.max_pressure
    pairs = [
        np.mean([sum(p.share > 0.0 for p in position.pairs) for position in case.positions])
        for case in (nominal, found.cases[0])
    ]
    assert pairs[1] < pairs[0]
