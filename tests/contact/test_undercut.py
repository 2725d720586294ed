"""Contact of an undercut pinion: on what is left of its flank, as the sweep of all that the edge cuts says.

Tsay & Lin 1993 as printed: the notes find its concave flank undercut. Independent of charts and their limits are the
points of `Flank.at_cone`, each the deepest of every piece and both roots at its place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import hypoid
from hypoid.contact import UnloadedContact, unloaded_contact
from hypoid.contact._field import angle_field, lead_grid
from hypoid.io import example_files

Array = np.ndarray[Any, Any]
COLUMNS, ROWS = 81, 121


@dataclass(frozen=True)
class AsCut:
    """A grid over the blank of the undercut flank; `own` where the flank itself is what cuts deepest."""

    contact: UnloadedContact
    distance: Array
    height: Array  # (rows, columns)
    own: Array
    point: Array  # (3, n) of those, left hand


@pytest.fixture(scope="module")
def as_cut() -> AsCut:
    file = next(f for f in example_files() if f.stem == "tsay-lin-1993-as-printed")
    contact = unloaded_contact(hypoid.read(file), "drive")
    flank = contact.pinion_flank
    height = flank.grid(ROWS, COLUMNS)[1]
    distance = np.linspace(flank.toe, flank.heel, COLUMNS)
    seen = flank.at_cone(np.broadcast_to(distance, height.shape), height)
    own = (seen.status == 0) & (seen.piece == flank.cut_pieces.index("flank")) & ~seen.other
    point = (seen.position * flank.hand)[own].T
    return AsCut(contact, distance, height, own.reshape(height.shape), point)


def test_the_chart_covers_what_is_left_and_nothing_else(as_cut: AsCut) -> None:
    flank = as_cut.contact.pinion_flank
    assert "flank" in flank.cut_away
    chart = flank.active_chart
    assert chart.error < 2e-5  # rad, 1 um at its radius
    low = np.asarray(chart.bounds(as_cut.distance)[0])
    above = as_cut.height > low
    assert as_cut.own[above].all()
    lost = as_cut.own & ~above
    assert lost.sum(axis=0).max() <= 1  # line of the grid, 0.1 mm, that the smooth line leaves out


def test_tsay_1993_as_printed_leads_where_the_swept_flank_does(as_cut: AsCut) -> None:
    """The greatest lead over points as cut, position by position, is the motion curve."""
    c = as_cut.contact
    every = np.flatnonzero(np.isfinite(c.curve))[::10]
    leads = np.asarray(
        lead_grid(c.mount, angle_field(c.wheel_flank), c.phi[every], tuple(as_cut.point))
    )
    greatest = leads.max(axis=1)
    assert np.isfinite(greatest).all()
    off = c.curve[every] - greatest
    assert off.max() < 5e-4  # the grid is 0.1 mm wide, and leads fall by up to 5 mrad a mm
    assert off.min() > -2e-5  # 1 um: the chart, and what it leaves out
