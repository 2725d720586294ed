"""Faults of a sheet that only its cutters, machines and cut flanks know, told at the file's own keys."""

from __future__ import annotations

import numpy as np
import pytest
from sheets import ON_122, ON_463, Changes, built, problems, repaired, sheet

SINGLE: Changes = {
    "wheel.cutter": {"type": "face-mill"},
    "wheel.concave.blade.point_diameter": "252.4 mm",
    "wheel.convex.blade.point_diameter": "247.6 mm",
}
BUILD: list[tuple[Changes, str, str, str]] = [
    ({"pair.offset": "115 mm"}, "pair.offset", "115 mm", "no pitch point lies on both cones"),
    (
        {**ON_122, "pinion.settings.cutter_spindle_rotation_angle": "200 deg"},
        "pinion.settings.cutter_spindle_rotation_angle", "200 deg", "from 0 deg to 180 deg",
    ),
    (
        {**ON_463, "pinion.convex.settings": {"cam_guide_angle": "50 deg"}},
        "pinion.convex.settings.cam_guide_angle", "50 deg", "from -45 deg to 45 deg",
    ),
    (
        {**ON_463, "pinion.settings.cam_setting": "300 mm"},
        "pinion.settings.cam_setting", "300 mm", "between 31.298 mm and 171.902 mm",
    ),
    (
        {**ON_463, "pinion.settings.index_gears": [44, 72, 50, 76]},
        "pinion.settings.index_gears", "44/72 x 50/76 = 0.402047", "11/27",
    ),
    (
        {"pinion.blade.edge_radius": "3 mm"},
        "pinion.blade.edge_radius", "3 mm", "at most 1.6823 mm, the largest that fits a land",
    ),
    (
        {"pinion.concave.blade.edge_radius": "3 mm"},
        "pinion.concave.blade.edge_radius", "3 mm", "at most 1.6823 mm",
    ),
    (
        {"pinion.blade.toprem": {"angle": "29.5 deg", "height": "1 mm"}},
        "pinion.blade.toprem.angle", "29.5 deg", "below 29 deg",
    ),
    (
        {"pinion.blade.toprem": {"angle": "2 deg", "height": "50 mm"}},
        "pinion.blade.toprem.height", "50 mm", "the blade's height",
    ),
    (
        {"pinion.blade": {"profile": "circular-arc", "radius": "9 mm", "reference_height": "4 mm"}},
        "pinion.blade.radius", "9 mm", "a radius of at least",
    ),
    (
        {"pinion.blade": {"profile": "circular-arc", "radius": "99 mm", "reference_height": "1 m"}},
        "pinion.blade.reference_height", "1000 mm", "a height on the blade",
    ),
    (
        {"pinion.cutter.point_width": "0.5 mm"},
        "pinion.blade.edge_radius", "0.6 mm", "largest that fits a land of 0.25 mm",
    ),
    (
        {"pinion.cutter": {"type": "face-mill", "diameter": "3 mm", "point_width": "2.4 mm"}},
        "pinion.cutter.diameter", "a point radius of 0.3 mm", "clear of the cutter's axis",
    ),
    (
        {**SINGLE, "wheel.blade.edge_radius": "40 mm"},
        "wheel.blade.edge_radius", "40 mm", "the largest that fits the blade at 19 deg",
    ),
    (
        {**SINGLE, "wheel.concave.blade.point_diameter": "1 mm"},
        "wheel.concave.blade.point_diameter", "a point radius of 0.5 mm", "a point radius above",
    ),
    (
        {"wheel.cutter.height": "4 mm"},
        "wheel.cutter.height", "4 mm", "below the tooth's tip",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "path", "given_text", "expected"), BUILD)
def test_faults_that_the_build_finds_are_told_at_the_files_keys(
    changes: Changes, path: str, given_text: str, expected: str
) -> None:
    document = sheet(changes)
    found = problems(document, building=True)
    assert len(set(found)) == len(found)
    problem = next(p for p in found if p.path == path)
    assert problem.given == given_text
    assert expected in problem.expected
    left = problems(repaired(document, problem), building=True)
    assert path not in {p.path for p in left}


def test_dials_and_blades_are_told_together() -> None:
    several = {
        **ON_122,
        "pinion.settings.eccentric_angle": "181 deg",
        "pinion.blade.edge_radius": "3 mm",
        "wheel.blade.toprem": {"angle": "2 deg", "height": "50 mm"},
    }
    assert {p.path for p in problems(sheet(several), building=True)} == {
        "pinion.settings.eccentric_angle",
        "pinion.blade.edge_radius",
        "wheel.blade.toprem.height",
    }


def test_a_cam_that_leaves_its_uniform_motion_is_named_with_its_range() -> None:
    """asin(40 C/(C**2 - r_u**2)) = 6.240 deg of the cam parameter (notes on lin1996, item 4), then (24)."""
    narrow = {**ON_463, "machine.gleason-463.cams.23.half_breadth": "40 mm"}
    found = problems(sheet(narrow), building=True)
    assert [p.path for p in found] == ["pinion.settings.cam_number"] * 2  # its two flanks
    assert all("from -6.14 deg to 6.11 deg" in p.expected for p in found)
    assert "pinion concave" in found[0].given
    wide = {**ON_463, "machine.gleason-463.cams.23.half_breadth": "80 mm"}
    assert problems(sheet(wide), building=True) == []


def test_a_blade_alone_may_have_a_sharp_corner_or_lean_the_other_way() -> None:
    """No other blade bounds its flat."""
    sharp = built(SINGLE, {"wheel.concave.blade.edge_radius": "0 mm"}).wheel
    assert "fillet" not in sharp.concave.pieces
    assert "fillet" in sharp.convex.pieces
    assert sharp.heads["concave"] is not sharp.heads["convex"]
    leaning = built(SINGLE, {"wheel.convex.blade.angle": "-2 deg"}).wheel.heads["convex"]
    assert leaning.faults() == []


def test_toprem_flankrem_and_profiles_reach_the_edge() -> None:
    pair = built(
        {
            "pinion.concave.blade": {
                "angle": "19 deg", "profile": "circular-arc", "radius": "500 mm",
                "reference_height": "4 mm", "toprem": {"angle": "2 deg", "height": "2.2 mm"},
            },
            "pinion.convex.blade": {
                "angle": "21 deg", "profile": "parabola", "coefficient": "0.002 /mm",
                "reference_height": "4 mm", "flankrem": {"angle": "1 deg", "height": "6 mm"},
            },
        }
    )  # fmt: skip
    concave, convex = pair.pinion.concave, pair.pinion.convex
    assert list(concave.pieces) == ["land", "fillet", "toprem", "flank"]
    assert list(convex.pieces) == ["land", "fillet", "flank", "flankrem"]
    assert float(concave.pieces["flank"].curvature) == pytest.approx(1 / 500.0)
    assert float(convex.pieces["flank"].parabola) == pytest.approx(0.002)
    for flank in (concave, convex):
        assert flank.generated
        assert np.isfinite(flank.at_cone([149.0] * 3, [-2.0, 0.0, 3.0]).position).all()
