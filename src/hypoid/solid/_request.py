"""What can be asked of a solid, and what is wrong with what was asked."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import Any

import numpy as np

from hypoid.flank import ToothGrid
from hypoid.geometry import Problem
from hypoid.pair import Member

from ._body import Body, body

Array = np.ndarray[Any, Any]
FINEST, COARSEST = 1e-4, 0.5  # mm, chord errors that a mesh can be asked for


def chord_problems(chord_error: float) -> list[Problem]:
    """What is wrong with a chord error, mm."""
    if FINEST <= chord_error <= COARSEST:
        return []
    expected = f"a length from {FINEST * 1e3:g} um to {COARSEST:g} mm"
    return [Problem("chord_error", f"{chord_error:g} mm", expected, '"5 um"')]


def largest_bore(member: Member) -> float:
    """Radius, mm, that the bore of a member's ring must stay below: that of its base line."""
    usual = body(member)
    return min(usual.toe_base[1], usual.heel_base[1])


def ring_problems(
    member: Member, teeth: int | None = None, bore: float | None = None, back: float | None = None
) -> list[Problem]:
    """What is wrong with a number of teeth, and with bore radius and back face (mm) of a member's ring."""
    problems: list[Problem] = []
    if teeth is not None and not 1 <= teeth <= member.teeth:
        expected = f"1 to {member.teeth} teeth of the {member.name}"
        problems.append(Problem("teeth", str(teeth), expected, "1"))
    own = replace(member, bore=None, mounting_distance=None)
    usual, most = body(own), largest_bore(own)
    if bore is not None and not 0.0 < bore < most:
        expected = f"a radius between 0 and {most:.4g} mm for the {member.name}"
        problems.append(Problem("bore", f"{bore:g} mm", expected, f"{usual.bore:.3g} mm"))
    elif bore is None and member.bore is not None and not 0.0 < member.bore < most:
        expected = f"a diameter between 0 and {2.0 * most:.4g} mm: the slots end there"
        path, example = f"{member.name}.body.bore_diameter", f'"{2.0 * usual.bore:.3g} mm"'
        problems.append(Problem(path, f"{2.0 * member.bore:g} mm", expected, example))
    least = max(usual.toe_base[0], usual.heel_base[0])
    asked = member.mounting_distance if back is None else back
    if asked is not None and not least < asked < inf:
        path = "back" if back is not None else f"{member.name}.body.mounting_distance"
        expected = f"z beyond {least:.6g} mm, where the {member.name}'s teeth end"
        problems.append(Problem(path, f"{asked:g} mm", expected, f'"{usual.back:.4g} mm"'))
    if teeth is not None and 1 <= teeth < member.teeth and usual.heel_base[0] <= usual.toe_base[0]:
        given = f"{teeth} teeth of a {member.name} whose root cone opens towards its back"
        expected = f"all {member.teeth} teeth: between two slots such a body has no sides"
        problems.append(Problem("teeth", given, expected, "all"))
    return problems


def tooth_problems(grid: ToothGrid, pitch: float, ring: Body, name: str) -> list[Problem]:
    """Why a tooth encloses no solid, if it does not."""
    concave, convex = grid.concave, grid.convex
    thickness = convex.angle - concave.angle
    expected = "a tooth and a slot from toe to heel, root to tip"
    faults = {
        "a flank that the edge does not cut everywhere": not np.isfinite(thickness).all(),
        "a tooth without thickness": bool((thickness <= 0.0).any()),
        "a slot without width": bool((thickness >= pitch).any())
        or bool((np.diff(grid.bottom_angle, axis=1) <= 0.0).any()),
        "a slot below the ring's base line": bool(
            (grid.bottom_height.min(axis=1) <= _base(grid, ring)).any()
        ),
    }
    advice = "`hypoid check` on its design file"
    return [
        Problem(f"{name} tooth", given, expected, advice)
        for given, found in faults.items()
        if found
    ][:1]


def _base(grid: ToothGrid, ring: Body) -> Array:
    """Height of the base line at each cone distance, mm."""
    return np.interp(grid.distance, grid.distance[[0, -1]], ring.base_height)
