"""What a flank says of points off the blank, undefined or beyond what an edge can generate."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from independent import sweep_of

from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.flank import PointStatus
from hypoid.pair import GearPair


def test_points_off_the_blank(paper_pair: GearPair) -> None:
    for flank in paper_pair.flanks():
        middle = 0.5 * (flank.toe + flank.heel)
        distance = [flank.toe - 0.01, flank.heel + 0.01, middle, middle, middle]
        height = [0.0, 0.0, flank.tip.at(0.0) + 0.01, flank.root.at(0.0) - 0.01, 0.0]
        status = flank.at_cone(distance, height).status
        assert status.tolist() == 4 * [PointStatus.OUTSIDE_BLANK] + [PointStatus.OK]


def test_undefined_points_give_a_status_and_no_exception(paper_pair: GearPair) -> None:
    for flank in paper_pair.flanks():
        z, rho = flank.cone.axial_radial(0.5 * (flank.toe + flank.heel), 0.0)
        points = flank.at([np.nan, z, np.inf, z], [rho, np.nan, rho, rho])
        assert (points.status[:3] != PointStatus.OK).all()
        assert points.status[3] == PointStatus.OK
        assert np.isnan(points.position[:3]).all()
        assert np.isnan(points.normal[:3]).all()
        assert np.isnan(points.principal_curvatures[:3]).all()
        assert len(flank.at([], []).status) == 0


def test_every_status_but_ok_says_what_to_do() -> None:
    for status in PointStatus:
        assert bool(status.message) == (status != PointStatus.OK)


def test_a_sound_design_is_generated_whole(paper_pair: GearPair, relief_pair: GearPair) -> None:
    for pair in (paper_pair, relief_pair):
        assert all(flank.generated for flank in pair.flanks())


@pytest.mark.parametrize(
    ("angle", "depth", "edge"),
    [
        pytest.param(10.0, 1.75, 0.38, id="at the toe"),
        pytest.param(5.0, 2.2, 0.2, id="all along"),
    ],
)
def test_undercut_is_found_and_no_point_pretends(
    table_1_spec: ExactFaceHobbedSpec, angle: float, depth: float, edge: float
) -> None:
    """Low pressure angles undercut the pinion: the height along the edge is not monotone.

    Every point is the tooth as a brute-force sweep of the blade shows it.
    """
    spec = replace(
        table_1_spec,
        pressure_angle=radians(angle),
        depth_factor=depth,
        tip_edge_radius_factor=edge,
    )
    member = build(spec).pinion
    for flank in (member.concave, member.convex):
        assert not flank.generated
        for share in (0.0, 0.5):
            distance = flank.toe + share * (flank.heel - flank.toe)
            height = np.linspace(flank.root.at(0.0) + 0.03, flank.tip.at(0.0), 10)
            points = flank.at_cone(np.full(10, distance), height)
            cut = sweep_of(member, flank).boundary(distance, height, flank.side)
            angle_at = np.arctan2(points.position[:, 1], points.position[:, 0])
            apart = np.angle(np.exp(1j * (cut - angle_at)))
            rho = np.hypot(*points.position[:, :2].T)
            assert points.ok.all()
            assert np.abs(apart * rho).max() < 1e-5  # mm
