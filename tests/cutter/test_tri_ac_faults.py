"""A Tri-Ac head that cannot be drawn says everything that is wrong with it, and what would do."""

from __future__ import annotations

import re
from dataclasses import replace
from math import inf, nan, pi, radians
from typing import Any

import mpmath
import numpy as np
import pytest
from tri_ac import PINION_HEAD, SHAPES, WHEEL_HEAD, PaperBlade

from hypoid.cutter import BladeToprem, TriAcBlade, TriAcHead
from hypoid.geometry import DesignError, Problem

mpf = mpmath.mpf
OUTER, INNER = PINION_HEAD.outer, PINION_HEAD.inner
PATHS = ("pinion.concave.blade", "pinion.convex.blade")


def faults(**changes: Any) -> list[Problem]:
    """Faults of the pinion's head with its outer blade changed."""
    head = replace(PINION_HEAD, outer=replace(OUTER, **changes))
    return head.faults("pinion.cutter", PATHS)


def numbers(problem: Problem) -> list[float]:
    """The limits that are stated."""
    return [
        float(n)
        for n in re.findall(r"(?:at most|at least|above|below) (-?[\d.]+)", problem.expected)
    ]


def test_the_set_has_no_fault() -> None:
    assert WHEEL_HEAD.faults() == []
    assert PINION_HEAD.faults() == []
    assert PINION_HEAD.checked() is PINION_HEAD


CASES: list[tuple[dict[str, Any], str]] = [
    ({"radius": 0.0}, "radius"),
    ({"radius": 2.0}, "radius"),
    ({"height": -1.0}, "height"),
    ({"shank_height": inf}, "shank_height"),
    ({"edge_radius": -0.1}, "edge_radius"),
    ({"edge_radius": nan}, "edge_radius"),
    ({"edge_radius": 3.0}, "edge_radius"),
    ({"land": 0.0}, "land"),
    ({"land": 2.0}, "land"),
    ({"land": 0.2}, "land"),
    ({"blade_angle": radians(-11.0)}, "blade_angle"),
    ({"blade_angle": radians(62.0)}, "blade_angle"),
    ({"blade_angle": radians(190.0)}, "blade_angle"),
    ({"eccentric_angle": radians(-1.0)}, "eccentric_angle"),
    ({"eccentric_angle": radians(60.0)}, "eccentric_angle"),
    ({"hook_angle": radians(45.0)}, "hook_angle"),
    ({"rake_angle": nan}, "rake_angle"),
    ({"curve_radius": nan}, "curve_radius"),
    ({"curve_radius": 9.0}, "curve_radius"),
    ({"curve_radius": -9.0}, "curve_radius"),
    ({"toprem": BladeToprem(0.0, radians(2.5))}, "toprem.length"),
    ({"toprem": BladeToprem(5.0, radians(2.5))}, "toprem.length"),
    ({"toprem": BladeToprem(5.0, radians(2.5), "axial")}, "toprem.length"),
    ({"toprem": BladeToprem(5.0, radians(2.5), "straight-part")}, "toprem.length"),
    ({"toprem": BladeToprem(inf, radians(2.5))}, "toprem.length"),
    ({"toprem": BladeToprem(1.6, radians(-2.5))}, "toprem.angle"),
    ({"toprem": BladeToprem(1.6, radians(29.0))}, "toprem.angle"),
    ({"toprem": BladeToprem(1.6, radians(2.5), "over all")}, "toprem.measured"),  # pyright: ignore
    ({"toprem": BladeToprem(0.4, radians(2.5))}, "edge_radius"),
    ({"name": "inner"}, "name"),
]


@pytest.mark.parametrize(
    ("changes", "key"), CASES, ids=[f"{k}-{i}" for i, (_, k) in enumerate(CASES)]
)
def test_one_fault_is_named_by_its_own_path(changes: dict[str, Any], key: str) -> None:
    (problem,) = faults(**changes)
    assert problem.path == f"pinion.concave.blade.{key}"
    assert problem.example.startswith(key.split(".")[-1] + " = ")


@pytest.mark.parametrize(
    "shape", [k for k in SHAPES if "hollow" not in k] + ["Toprem, short"], ids=str
)
@pytest.mark.parametrize("blade", [OUTER, INNER], ids=["outer", "inner"])
def test_the_largest_edge_radius_fits_and_no_larger(blade: TriAcBlade, shape: str) -> None:
    changes = SHAPES.get(shape, {"toprem": BladeToprem(0.5, radians(2.5))})
    head = TriAcHead(1, OUTER, INNER, spacing=radians(100.0))  # room for any edge arc

    def found(radius: float) -> list[Problem]:
        changed = replace(blade, **changes, edge_radius=radius)
        return replace(head, **{blade.name: changed}).faults()

    (problem,) = found(50.0)
    assert problem.path.endswith(f"{blade.name}.edge_radius")
    (most,) = numbers(problem)
    assert found(most) == []
    assert found(most + 2e-4) != []
    paper = PaperBlade(replace(blade, **changes, edge_radius=most))
    if paper.blade.toprem is None:  # the arc ends at P
        lean = mpmath.sin(paper.alpha)
        assert most == pytest.approx(float(mpf(blade.height) / (1 - lean)), abs=1e-4)
    elif paper.blade.toprem.measured != "straight-part":  # nothing is left of Toprem
        assert 0.0 <= paper.lengths[1] < 2e-4


@pytest.mark.parametrize("measured", ["along-flank", "axial", "straight-part"])
def test_the_longest_toprem_ends_at_the_pitch_point(measured: Any) -> None:
    changes: dict[str, Any] = {"edge_radius": 0.0}
    (problem,) = faults(toprem=BladeToprem(50.0, radians(2.5), measured), **changes)
    limit = numbers(problem)[1]
    assert faults(toprem=BladeToprem(limit - 1e-3, radians(2.5), measured), **changes) == []
    blade = replace(OUTER, toprem=BladeToprem(limit, radians(2.5), measured), **changes)
    assert blade.flank_start == pytest.approx(blade.height, abs=1e-4)


@pytest.mark.parametrize("angle", [radians(-20.0), radians(75.0)])
def test_stated_blade_angles_are_admissible(angle: float) -> None:
    blade = replace(OUTER, toprem=None, curve_radius=0.0, edge_radius=0.1)
    head = TriAcHead(1, OUTER, INNER, spacing=radians(100.0))  # room for any slot
    (problem,) = replace(head, outer=replace(blade, blade_angle=angle)).faults()
    low, high = re.findall(r"between (-?[\d.]+) and (-?[\d.]+) deg: ", problem.expected)[0]
    limit = radians(float(low if angle < 0.0 else high))
    assert replace(head, outer=replace(blade, blade_angle=limit)).faults() == []


@pytest.mark.parametrize("radius", [9.0, -9.0])
def test_the_stated_curve_radius_is_admissible(radius: float) -> None:
    (problem,) = faults(curve_radius=radius, toprem=None, edge_radius=0.1)
    limit = numbers(problem)[0]
    assert faults(curve_radius=np.copysign(limit, radius), toprem=None, edge_radius=0.1) == []


@pytest.mark.parametrize("spacing_deg", [4.0, 26.0])
def test_blades_that_leave_no_slot_or_no_tooth(spacing_deg: float) -> None:
    head = replace(PINION_HEAD, spacing=radians(spacing_deg))
    (problem,) = head.faults("pinion.cutter", PATHS)
    assert problem.path == "pinion.cutter.spacing"
    low, high = numbers(problem)
    assert low < 9.4 < high
    for limit in (low + 1e-3, high - 1e-3):
        assert replace(head, spacing=radians(limit)).faults() == []
    if spacing_deg < low:
        assert head.tip_slot < 0.0
    else:
        assert head.pitch_slot > 2.0 * pi / 13 * head.base_radius


@pytest.mark.parametrize(
    "changes",
    [{"radius": 60.0}, {"radius": 120.0}, {"eccentric_angle": 0.0, "radius": 74.0}],
    ids=repr,
)
def test_blades_that_stand_where_no_spacing_helps(changes: dict[str, Any]) -> None:
    outer = replace(OUTER, **changes)
    inner = replace(INNER, eccentric_angle=outer.eccentric_angle)
    (problem,) = replace(PINION_HEAD, outer=outer, inner=inner).faults()
    assert problem.path == "cutter.outer.radius"
    for limit in numbers(problem):
        inside = limit + (1e-3 if limit == numbers(problem)[0] else -1e-3)
        fixed = replace(outer, radius=inside)
        assert replace(PINION_HEAD, outer=fixed, inner=inner).faults() == []


def test_edges_that_take_a_whole_pitch() -> None:
    fine = replace(PINION_HEAD, blade_groups=60, spacing=None)
    (problem,) = fine.faults()
    assert problem.path == "cutter.outer.edge_radius"


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"blade_groups": 0}, "blade_groups"),
        ({"spacing": 0.0}, "spacing"),
        ({"spacing": 0.5}, "spacing"),
        ({"spacing": nan}, "spacing"),
    ],
    ids=repr,
)
def test_faults_of_the_head_itself(changes: dict[str, Any], key: str) -> None:
    (problem,) = replace(PINION_HEAD, **changes).faults("wheel.cutter")
    assert problem.path == f"wheel.cutter.{key}"


def test_every_problem_at_once() -> None:
    head = TriAcHead(0, replace(OUTER, radius=-1.0, height=0.0), replace(INNER, edge_radius=9.0))
    with pytest.raises(DesignError) as caught:
        head.pieces("outer")
    paths = [p.path for p in caught.value.problems]
    assert paths == [
        "cutter.blade_groups",
        "cutter.outer.radius",
        "cutter.outer.height",
        "cutter.inner.edge_radius",
    ]
