"""Derivatives of transmission error, path and ease-off by everything, against differences of rebuilt pairs.

The differences go the whole way: settings changed, flanks cut again, contact searched again; two steps
each (Richardson), so that they are good to their rounding.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import hypoid
from hypoid.contact import (
    Misalignment,
    Sampling,
    TracedContact,
    ease_off,
    traced_contact,
    unloaded_contact,
)
from hypoid.flank import recut
from hypoid.geometry import jitted

EXAMPLES = Path(__file__).parents[2] / "examples"
LOOK = Sampling(positions_per_pitch=12, pairs=3, columns=21, rows=11)
PAIRS = ("lin-tsay-fong-1996",)
SETTINGS = ("radial_distance", "machine_root_angle", "blank_offset", "tilt_angle")


@cache
def traced(name: str) -> TracedContact:
    pair = hypoid.read(EXAMPLES / f"{name}.toml")
    return traced_contact(unloaded_contact(pair, "drive", sampling=LOOK))


@cache
def slopes_of(name: str) -> Any:
    """Derivatives of the transmission error by every parameter."""
    one = traced(name)
    return jitted(jax.jacfwd(one.transmission_error))(one.parameters)


def changed(one: TracedContact, setting: str, step: float) -> Any:
    """Contact of the pair whose pinion flank is cut again with a setting moved."""
    contact = one.contact
    flank = contact.pinion_flank
    settings = replace(flank.settings, **{setting: getattr(flank.settings, setting) + step})
    pinion = replace(contact.pair.pinion, **{flank.side: recut(flank, settings)})
    return unloaded_contact(replace(contact.pair, pinion=pinion), "drive", sampling=LOOK)


def lead(one: TracedContact, contact: Any) -> np.ndarray:
    values = contact.points.lead[one.contact.on_path]
    return values - values[np.argmin(np.abs(one.pinion_angle))]


def richardson(of: Any, step: float) -> np.ndarray:
    coarse, fine = ((of(h) - of(-h)) / (2.0 * h) for h in (2.0 * step, step))
    return (4.0 * fine - coarse) / 3.0


@pytest.mark.parametrize("name", PAIRS)
def test_values_are_those_of_the_contact(name: str) -> None:
    one = traced(name)
    both = jitted(lambda p: (one.transmission_error(p), one.path(p)))
    error, path = both(one.parameters)
    assert np.abs(np.asarray(error) - lead(one, one.contact)).max() < 1e-13
    assert np.abs(np.asarray(path) - np.stack(one.contact.path, axis=1)).max() < 1e-8


@pytest.mark.parametrize("name", PAIRS)
def test_transmission_error_by_settings(name: str) -> None:
    one = traced(name)
    slopes = slopes_of(name)
    for setting in SETTINGS:
        exact = np.asarray(slopes.pinion.settings[setting])
        seen = richardson(lambda h, s=setting: lead(one, changed(one, s, h)), 2e-4)
        there = np.isfinite(seen)
        size = float(np.abs(seen[there]).max())
        assert np.abs(exact - seen)[there].max() < 1e-5 * size + 1e-9, setting


@pytest.mark.parametrize("name", PAIRS)
def test_transmission_error_by_misalignment(name: str) -> None:
    one = traced(name)
    slopes = np.asarray(slopes_of(name).misalignment)
    for k, error in enumerate(("offset", "pinion_axial", "wheel_axial", "shaft_angle")):

        def at(step: float, error: str = error) -> np.ndarray:
            mounted = Misalignment(**{error: step})
            return lead(one, unloaded_contact(one.contact.pair, "drive", mounted, LOOK))

        seen = richardson(at, 1e-4)
        there = np.isfinite(seen)
        size = float(np.abs(seen[there]).max())
        assert np.abs(slopes[:, k] - seen)[there].max() < 1e-5 * size + 1e-9, error


def test_ease_off_and_its_slopes() -> None:
    one = traced("lin-tsay-fong-1996")
    both = jitted(lambda p: (one.ease_off(p), jax.jacfwd(one.ease_off)(p).pinion.settings))
    value, slopes = both(one.parameters)
    value = np.asarray(value)
    whole = ease_off(one.contact)
    i, j = np.linspace(0, 10, 5).round().astype(int), np.linspace(0, 20, 9).round().astype(int)
    seen = whole.value[i][:, j]
    there = np.isfinite(seen) & np.isfinite(value)
    assert there.mean() > 0.5
    assert np.abs(value - seen)[there].max() < 1e-7
    # an envelope moves by n . dr/dp: the ease-off's slope by a setting is that of the flank's points
    exact = np.asarray(slopes["radial_distance"])

    def at(step: float) -> np.ndarray:
        settings = dict(one.parameters.pinion.settings)
        settings["radial_distance"] = settings["radial_distance"] + step
        moved = replace(one.parameters, pinion=replace(one.parameters.pinion, settings=settings))
        return np.asarray(both(moved)[0])

    seen = richardson(at, 1e-3)
    assert np.abs(exact - seen)[there].max() < 1e-7 * float(np.abs(seen[there]).max()) + 1e-9


def test_edge_and_motion_coefficients_have_slopes() -> None:
    slopes = slopes_of("lin-tsay-fong-1996")
    assert jnp.abs(slopes.pinion.edge.start[0]).max() > 0.0
    assert jnp.abs(slopes.pinion.motions["sliding_base"][:, 1]).max() > 0.0
