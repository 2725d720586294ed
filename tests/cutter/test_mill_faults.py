"""A face-mill head that cannot be drawn says everything that is wrong with it, and what would do."""

from __future__ import annotations

import re
from dataclasses import replace
from math import cos, inf, nan, radians, sin
from typing import Any

import pytest

from hypoid.cutter import (
    CircularProfile,
    FaceMillHead,
    Flankrem,
    MillBlade,
    ParabolicProfile,
    Toprem,
)
from hypoid.geometry import DesignError, Problem

OUTER = MillBlade("outer", 115.57, radians(17.0), edge_radius=0.8, land=1.27, height=14.0)
INNER = MillBlade("inner", 113.03, radians(28.0), edge_radius=0.6, land=1.27, height=14.0)


def faults(blade: MillBlade) -> list[Problem]:
    head = FaceMillHead(outer=blade) if blade.name == "outer" else FaceMillHead(inner=blade)
    return head.faults("wheel.cutter", ("wheel.concave.blade", "wheel.convex.blade"))


def limit(problem: Problem) -> float:
    """The limit that is stated."""
    words = "at most" if "at most" in problem.expected else "(?:at least|above|below|less than)"
    number = re.search(rf"{words} (-?[\d.e-]+)", problem.expected)
    assert number, problem.expected
    return float(number.group(1))


def test_a_sound_head_has_none() -> None:
    assert FaceMillHead(OUTER, INNER).faults() == []


@pytest.mark.parametrize("blade", [OUTER, INNER], ids=["outer", "inner"])
def test_edge_radius_states_the_largest_that_fits(blade: MillBlade) -> None:
    """On a straight blade the arc takes r (1 - sin psi)/cos psi of the land [tsay1993, (1), (2)]."""
    (problem,) = faults(replace(blade, edge_radius=9.0))
    side = "concave" if blade.name == "outer" else "convex"
    assert problem.path == f"wheel.{side}.blade.edge_radius"
    assert problem.given == "9 mm"
    largest = 1.27 * cos(blade.angle) / (1.0 - sin(blade.angle))
    assert largest - 1e-4 <= limit(problem) <= largest
    assert faults(replace(blade, edge_radius=limit(problem))) == []
    assert faults(replace(blade, edge_radius=limit(problem) + 2e-4)) != []


@pytest.mark.parametrize(
    "changes",
    [
        {"toprem": Toprem(radians(4.0), 0.5)},
        {"toprem": Toprem(radians(8.0), 3.0)},
        {"profile": CircularProfile(60.0, 6.0)},
        {"profile": ParabolicProfile(-0.01, 6.0)},
        {"flankrem": Flankrem(0.9, coefficient=0.004)},
        {"profile": CircularProfile(-300.0, 6.0), "toprem": Toprem(radians(4.0), 0.5)},
    ],
    ids=repr,
)
def test_the_largest_edge_radius_fits_and_no_larger(changes: dict[str, Any]) -> None:
    blade = replace(OUTER, edge_radius=50.0, **changes)
    (problem,) = faults(blade)
    assert problem.path.endswith("edge_radius")
    assert faults(replace(blade, edge_radius=limit(problem))) == []
    assert faults(replace(blade, edge_radius=limit(problem) + 2e-4)) != []


CASES: list[tuple[dict[str, Any], str]] = [
    ({"point_radius": 0.0}, "point_radius"),
    ({"point_radius": 0.5}, "point_radius"),
    ({"angle": radians(-10.0)}, "angle"),
    ({"angle": radians(60.0)}, "angle"),
    ({"angle": nan}, "angle"),
    ({"edge_radius": -0.1}, "edge_radius"),
    ({"edge_radius": inf}, "edge_radius"),
    ({"land": 0.0}, "land"),
    ({"height": -1.0}, "height"),
    ({"toprem": Toprem(radians(4.0), 15.0)}, "toprem.height"),
    ({"toprem": Toprem(radians(4.0), inf)}, "toprem.height"),
    ({"toprem": Toprem(radians(-4.0), 1.5)}, "toprem.angle"),
    ({"toprem": Toprem(radians(27.5), 1.5)}, "toprem.angle"),
    ({"flankrem": Flankrem(14.5, radians(2.0))}, "flankrem.height"),
    ({"flankrem": Flankrem(nan, radians(2.0))}, "flankrem.height"),
    ({"flankrem": Flankrem(9.0)}, "flankrem"),
    ({"flankrem": Flankrem(9.0, radians(2.0), 0.004)}, "flankrem"),
    ({"flankrem": Flankrem(9.0, radians(-2.0))}, "flankrem.angle"),
    ({"flankrem": Flankrem(9.0, radians(31.0))}, "flankrem.angle"),
    ({"flankrem": Flankrem(9.0, coefficient=-0.004)}, "flankrem.coefficient"),
    ({"flankrem": Flankrem(9.0, coefficient=0.5)}, "flankrem.coefficient"),
    ({"flankrem": Flankrem(2.0, radians(2.0)), "toprem": Toprem(0.07, 2.5)}, "toprem.height"),
    ({"profile": CircularProfile(0.0, 6.0)}, "profile.radius"),
    ({"profile": CircularProfile(9.0, 6.0)}, "profile.radius"),
    ({"profile": CircularProfile(700.0, 14.1)}, "profile.reference_height"),
    ({"profile": ParabolicProfile(nan, 6.0)}, "profile.coefficient"),
    ({"profile": ParabolicProfile(-0.5, 6.0)}, "profile.coefficient"),
    ({"profile": CircularProfile(-60.0, 13.0), "land": 0.5}, "land"),
]


@pytest.mark.parametrize(
    ("changes", "key"), CASES, ids=[f"{k}-{i}" for i, (_, k) in enumerate(CASES)]
)
def test_one_fault_is_named_by_its_own_path(changes: dict[str, Any], key: str) -> None:
    (problem,) = faults(replace(OUTER, **{"edge_radius": 0.2} | changes))
    assert problem.path == f"wheel.concave.blade.{key}"
    assert problem.example.startswith(key.split(".")[-1] + " = ")


@pytest.mark.parametrize(
    ("field", "value", "make"),
    [
        ("profile", 9.0, lambda v: CircularProfile(v, 6.0)),
        ("profile", -9.0, lambda v: CircularProfile(-abs(v), 6.0)),
        ("profile", 0.5, lambda v: ParabolicProfile(v, 6.0)),
        ("profile", -0.5, lambda v: ParabolicProfile(-abs(v), 6.0)),
        ("flankrem", 0.5, lambda v: Flankrem(9.0, coefficient=v)),
    ],
)
def test_a_stated_limit_is_admissible(field: str, value: float, make: Any) -> None:
    """And the edge leans to within 0.1 deg of the limits of -10 and 60 deg there."""
    blade = replace(OUTER, edge_radius=0.0, land=9.0)
    (problem,) = faults(replace(blade, **{field: make(value)}))
    at_limit = replace(blade, **{field: make(limit(problem))})
    assert faults(at_limit) == []
    leans = [p.at(s).lean for p in at_limit.outline[1:] for s in (p.low, p.high)]
    nearest = min(min(leans) - radians(-10.0), radians(60.0) - max(leans))
    assert 0.0 < nearest < radians(0.1)


def test_inner_blade_keeps_clear_of_the_axis() -> None:
    (problem,) = faults(replace(INNER, point_radius=5.0))
    assert problem.path == "wheel.convex.blade.point_radius"
    assert limit(problem) == pytest.approx(14.0 * sin(radians(28.0)) / cos(radians(28.0)), abs=1e-4)


def test_every_problem_at_once() -> None:
    with pytest.raises(DesignError) as caught:
        FaceMillHead.spread_blade(
            228.6,
            2.54,
            radians(17.0),
            radians(65.0),
            14.0,
            edge_radius=(9.0, -1.0),
            toprem=(None, Toprem(radians(4.0), 20.0)),
            flankrem=(Flankrem(20.0, radians(2.0)), None),
            path="pinion.cutter",
        )
    paths = {p.path for p in caught.value.problems}
    assert paths == {
        "pinion.cutter.outer.edge_radius",
        "pinion.cutter.outer.flankrem.height",
        "pinion.cutter.inner.angle",
        "pinion.cutter.inner.edge_radius",
    }  # the inner blade's Toprem cannot be judged before its angle


def test_a_bad_diameter_does_not_hide_the_blades_faults() -> None:
    with pytest.raises(DesignError) as caught:
        FaceMillHead.spread_blade(0.0, -2.0, radians(17.0), radians(65.0), 14.0, edge_radius=0.5)
    paths = [p.path for p in caught.value.problems]
    assert paths == ["cutter.diameter", "cutter.point_width", "cutter.inner.angle"]


@pytest.mark.parametrize(
    ("outer", "inner", "path"),
    [
        (226.0, 230.0, "cutter.outer_point_diameter"),
        (230.0, 0.0, "cutter.inner_point_diameter"),
        (nan, 226.0, "cutter.outer_point_diameter"),
    ],
)
def test_point_diameters(outer: float, inner: float, path: str) -> None:
    with pytest.raises(DesignError) as caught:
        FaceMillHead.from_point_diameters(outer, inner, 0.3, 0.3, 14.0)
    assert [p.path for p in caught.value.problems] == [path]


def test_point_width_below_the_diameter() -> None:
    with pytest.raises(DesignError) as caught:
        FaceMillHead.spread_blade(8.0, 9.0, 0.3, 0.3, 14.0)
    assert [p.path for p in caught.value.problems] == ["cutter.point_width"]


def test_the_head_as_a_whole() -> None:
    """No blade; a blade on the wrong side; outside inside; lands and edge arcs beyond the slot."""

    def paths(head: FaceMillHead) -> list[str]:
        return [p.path for p in head.faults()]

    assert paths(FaceMillHead()) == ["cutter"]
    assert paths(FaceMillHead(outer=replace(INNER, name="inner"))) == ["cutter.outer.name"]
    inside = FaceMillHead(replace(OUTER, point_radius=113.0), INNER)
    assert paths(inside) == ["cutter.point_width"]
    assert paths(FaceMillHead(replace(OUTER, land=2.6), INNER)) == ["cutter.outer.land"]
    arcs = FaceMillHead(
        replace(OUTER, land=2.54, edge_radius=2.0), replace(INNER, land=2.54, edge_radius=2.5)
    )
    (problem,) = arcs.faults()
    assert problem.path == "cutter.point_width"
    least = sum(r * (1.0 - sin(a)) / cos(a) for r, a in ((2.0, OUTER.angle), (2.5, INNER.angle)))
    assert limit(problem) == pytest.approx(least, abs=1e-4)


def test_pieces_are_never_those_of_a_faulty_head() -> None:
    with pytest.raises(DesignError, match=r"edge_radius: got 9 mm"):
        FaceMillHead(outer=replace(OUTER, edge_radius=9.0)).pieces("outer")
