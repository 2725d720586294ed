"""Rays of a contact find the flank: points whose place on it is known are met again."""

from __future__ import annotations

import numpy as np
import pytest

import hypoid
from hypoid.contact import Sampling, angle_field, to_wheel, unloaded_contact
from hypoid.io import example_files
from hypoid.load._meeting import meeting

EXAMPLES = {file.stem: file for file in example_files()}


@pytest.mark.parametrize("name", ["gonzalez-fuentes-2022-relief", "tsay-lin-1993-as-printed"])
def test_rays_to_points_of_the_flank_meet_them(name: str) -> None:
    """From tip to fillet limit, an undercut one too, about the contact; to 1e-4 mm, as its chart is."""
    pair = hypoid.read(EXAMPLES[name])
    contact = unloaded_contact(pair, "drive", None, Sampling(positions_per_pitch=40, pairs=9))
    met = meeting(contact, len(contact.phi) // 2, 0)
    assert met is not None
    flank, middle = contact.pinion_flank, met.surface(np.zeros(1), np.zeros(1))
    s = float(middle.pinion_place[0][0]) + met.depth * np.linspace(-0.7, 0.7, 12)
    s = s[(s > flank.toe) & (s < flank.heel)]
    limit = np.asarray(angle_field(flank).lowest.bounds(s)[0])
    share = np.array([1e-3, 0.02, 0.3, 0.6, 0.95])
    height = (limit + np.outer(share, flank.tip.at(s) - limit)).ravel()
    exact = flank.at_cone(np.tile(s, len(share)), height)
    place = np.array(to_wheel(contact.mount, met.phi, tuple((exact.position * flank.hand).T))).T
    assert exact.ok.mean() > 0.9
    a, b, _ = ((place - met.origin) @ met.axes.T).T
    found = met.surface(a, b)
    np.testing.assert_allclose(found.point[exact.ok], place[exact.ok], atol=1e-4)
    assert not np.isnan(found.normal[exact.ok]).any()
