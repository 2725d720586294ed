"""At the pitch point: 20 deg in the normal section and the blank's spiral angles, on both sides.

Zero transmission error does not see the sign of the slope angle; these angles do (notes of 2022).
"""

from __future__ import annotations

from dataclasses import replace
from math import degrees
from typing import Any

import numpy as np
import pytest

from hypoid.flank import Flank, cut_flank
from hypoid.pair import GearPair, Member

Array = np.ndarray[Any, Any]


def pitch_frame(member: Member, flank: Flank) -> tuple[Array, Array, Array, Array]:
    """Point and normal cut by the blade's pitch point, pitch cone's normal and generatrix there."""
    position, normal = flank.at_cutter([0.0], [flank.theta_start])
    x, y = position[0, :2] / np.hypot(*position[0, :2])
    delta = member.blank.pitch_angle
    up = np.array([np.cos(delta) * x, np.cos(delta) * y, -np.sin(delta)])
    along = np.array([np.sin(delta) * x, np.sin(delta) * y, np.cos(delta)])
    return position[0], normal[0], up, along


@pytest.mark.parametrize("side", ["concave", "convex"])
@pytest.mark.parametrize(("name", "spiral"), [("pinion", 65.0), ("wheel", 40.3077527)])
def test_pressure_and_spiral_angle(
    paper_pair: GearPair, relief_pair: GearPair, name: str, spiral: float, side: Any
) -> None:
    for pair in (paper_pair, relief_pair):
        member = getattr(pair, name)
        position, normal, up, along = pitch_frame(member, member.flank(side))
        z, rho = member.concave.cone.axial_radial(member.blank.mean_cone_distance, 0.0)
        assert position[2] == pytest.approx(z, abs=1e-9)
        assert np.hypot(*position[:2]) == pytest.approx(rho, abs=1e-9)
        assert degrees(np.arcsin(normal @ up)) == pytest.approx(20.0, abs=1e-9)
        line = np.cross(normal, up)
        line /= np.linalg.norm(line)
        assert degrees(np.arccos(abs(line @ along))) == pytest.approx(spiral, abs=6e-8)


@pytest.mark.parametrize("side", ["concave", "convex"])
@pytest.mark.parametrize("name", ["pinion", "wheel"])
def test_the_slope_angle_with_the_wrong_sign_would_show(
    paper_pair: GearPair, name: str, side: Any
) -> None:
    """Blades that face the other way: 19.830 deg (notes of 2022), though still conjugate."""
    member: Member = getattr(paper_pair, name)
    flank = member.flank(side)
    wrong = replace(member.head, slope_angle=-member.head.slope_angle)
    phase = flank.settings.cradle_angle - member.blank.mean_spiral_angle + member.head.slope_angle
    pieces = wrong.pieces("outer" if side == "concave" else "inner")
    turned = cut_flank(
        member.name,
        side,
        flank.settings,
        {key: piece.turned(phase) for key, piece in pieces.items()},
        flank.cone,
        mirrored=flank.mirrored,
        theta_start=flank.theta_start,
        toe=flank.toe,
        heel=flank.heel,
        tip=flank.tip,
        root=flank.root,
        way=flank.surface.way,
    )
    _, normal, up, _ = pitch_frame(member, turned)
    assert degrees(np.arcsin(normal @ up)) == pytest.approx(19.830, abs=5e-4)
