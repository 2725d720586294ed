"""The six-axis machine is the same rigid motion as the generator chain, and leads back to it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from milled import METHODS, settings_of

from hypoid.geometry import DesignError
from hypoid.machine import (
    AxisTable,
    Cam,
    MachineSettings,
    Motions,
    axis_table,
    basic_of,
    chain,
)

ROLL = np.linspace(-0.4, 0.4, 41)


def random_settings(rng: np.random.Generator, **moving: Any) -> MachineSettings:
    return MachineSettings(
        radial_distance=rng.uniform(50, 150),
        cradle_angle=rng.uniform(-1.1, 1.1),
        machine_root_angle=rng.uniform(-0.2, 1.4),
        ratio_of_roll=rng.uniform(1, 8),
        roll_to_blade_ratio=rng.uniform(0, 1),
        tilt_angle=rng.uniform(-0.5, 0.5),
        swivel_angle=rng.uniform(-3, 3),
        blank_offset=rng.uniform(-60, 60),
        machine_center_to_back=rng.uniform(-20, 20),
        sliding_base=rng.uniform(-20, 20),
        **moving,
    )


@pytest.mark.parametrize("seed", range(20))
def test_same_rigid_motion_as_the_chain(seed: int) -> None:
    """Every motion at once, face-milled or face-hobbed; 1e-12 mm."""
    rng = np.random.default_rng(seed)
    names = Motions.__dataclass_fields__
    settings = random_settings(
        rng,
        helical_motion=rng.uniform(-5, 5),
        modified_roll=tuple(rng.uniform(-0.1, 0.1, 4)),
        motions=Motions(**{n: tuple(rng.uniform(-0.3, 0.3, 3)) for n in names}),
        cam=Cam(381.0, 60.0, 1.0, 0.05, 0.37) if seed % 2 else None,
    )
    table = axis_table(settings, ROLL)
    for k in range(0, len(ROLL), 5):
        theta = rng.uniform(-1, 1)
        apart = table.pose(k, theta) - chain(settings, theta, ROLL[k])
        assert np.abs(apart).max() < 1e-12 * 200.0  # turns times mm


def test_axes_are_continuous() -> None:
    """No position jumps by a turn, however far the work rolls."""
    settings = replace(settings_of("all axes"), ratio_of_roll=9.0)
    table = axis_table(settings, np.linspace(-1.0, 1.0, 2001))
    for axis in (table.a, table.b, table.c):
        assert np.abs(np.diff(axis)).max() < 0.05


@pytest.mark.parametrize("angle", [np.pi / 2, -np.pi / 2])
def test_parallel_axes_keep_the_tool_at_zero(angle: float) -> None:
    """Work and tool axis parallel: A and C turn about one line, and A alone does it."""
    settings = replace(settings_of("generated"), machine_root_angle=angle)
    table = axis_table(settings, ROLL)
    assert np.abs(table.c).max() == 0.0
    for k in (0, 20, 40):
        assert np.abs(table.pose(k) - chain(settings, 0.0, ROLL[k])).max() < 1e-11


def test_swing_is_the_machine_root_angle_without_tilt() -> None:
    settings = settings_of("modified roll")
    assert axis_table(settings, ROLL).b == pytest.approx(settings.machine_root_angle, abs=1e-14)


@pytest.mark.parametrize("seed", range(10))
def test_back_to_basic_settings(seed: int) -> None:
    """Polynomial motions of the axes that the fit moves come back; so does the motion, to 1e-9 mm."""
    rng = np.random.default_rng(seed)
    settings = random_settings(
        rng,
        helical_motion=rng.uniform(-5, 5),
        modified_roll=tuple(rng.uniform(-0.1, 0.1, 5)),
        motions=Motions(tilt_angle=(0.02, 0.01), radial_distance=(1.0, 0.2), blank_offset=(0.3,)),
    )
    found = basic_of(axis_table(settings, ROLL), settings)
    assert found.centre_error < 1e-9
    assert found.axis_error < 1e-6
    back = found.settings
    assert back.ratio_of_roll == pytest.approx(settings.ratio_of_roll, rel=1e-12)
    assert back.modified_roll == pytest.approx(settings.modified_roll, abs=1e-10)
    assert back.helical_motion == pytest.approx(settings.helical_motion, abs=1e-9)
    assert back.motions.tilt_angle[:2] == pytest.approx((0.02, 0.01), abs=1e-10)


@pytest.mark.parametrize("method", [m for m in METHODS if settings_of(m).generated])
def test_every_method_comes_back(method: str) -> None:
    """Exact for polynomial motions of tilt, radial, vertical, base and roll; what six orders leave else."""
    settings = settings_of(method)
    start = replace(settings, ratio_of_roll=1.0, modified_roll=(), cam=None)
    found = basic_of(axis_table(settings, ROLL), start)
    exact = method not in ("cam", "all axes")
    assert found.centre_error < (1e-9 if exact else 1e-3)
    assert found.axis_error < (1e-6 if exact else 1.0)


def broken(**changes: Any) -> AxisTable:
    return replace(axis_table(settings_of("generated"), ROLL), **changes)


@pytest.mark.parametrize(
    ("table", "word"),
    [
        (broken(x=np.full(41, np.nan)), "table row 0"),
        (broken(roll=ROLL[::-1]), "a growing roll"),
        (axis_table(settings_of("generated"), ROLL[:1]), "at least 2 positions"),
    ],
)
def test_tables_that_are_none(table: AxisTable, word: str) -> None:
    with pytest.raises(DesignError, match=word):
        basic_of(table, settings_of("generated"))


def test_roll_that_is_none() -> None:
    with pytest.raises(DesignError, match="finite cradle angles"):
        axis_table(settings_of("generated"), np.array([0.0, np.inf]))
