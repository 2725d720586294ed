"""The field that contact reads, and its nodes, against the exact flank: every shape of active flank."""

import numpy as np
import pytest
from milled import CUTTERS, milled

from hypoid.contact._field import angle_field, flank_nodes


@pytest.mark.parametrize("cutter", CUTTERS)
def test_field_and_nodes_are_the_flank(cutter: str) -> None:
    flank = milled(cutter, "generated")
    nodes = flank_nodes(flank, 9, 7)
    distance = np.broadcast_to(nodes.distance, nodes.height.shape).ravel()
    exact = flank.at_cone(distance, nodes.height.ravel())
    assert exact.ok.all()
    apart = np.abs(nodes.point.T - exact.position).max(axis=1).reshape(nodes.height.shape)
    # A Toprem's corner removes a little above the place where the flank's own edge ends.
    assert apart[0].max() < (3e-3 if cutter == "toprem" else 2e-9)  # mm
    assert apart[1:].max() < 2e-9
    kink = 1e-6 if "flankrem" in cutter else 0.0  # where either part may be meant
    field = np.asarray(angle_field(flank).angle(distance, nodes.height.ravel() + kink))
    angle = np.arctan2(exact.position[:, 1], exact.position[:, 0])
    off = np.abs(np.angle(np.exp(1j * (field - angle)))).reshape(nodes.height.shape)
    assert off[1:].max() < 1e-7 + kink  # rad


@pytest.mark.parametrize("cutter", ["flankrem", "straight flankrem"])
def test_flankrem_relieves_the_tip_and_nothing_below(cutter: str) -> None:
    """Tip of a concave flank of a left-hand member: less tooth means a smaller angle."""
    plain, relieved = milled("straight", "generated"), milled(cutter, "generated")
    distance = np.full(2, 0.5 * (plain.toe + plain.heel))
    height = np.array([0.0, plain.tip.at(distance[0])])
    angles = [np.asarray(angle_field(f).angle(distance, height)) for f in (relieved, plain)]
    less = (angles[0] - angles[1]) * np.hypot(distance, height)
    assert abs(less[0]) < 1e-6
    assert less[1] != pytest.approx(0.0, abs=5e-3)
