"""Faults that only cutters, machines and cut flanks know, told at the keys of the summary sheet."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from hypoid.flank import Flank, roll_range
from hypoid.geometry import DesignError, Problem
from hypoid.machine import check_roll

from ._sheet_spec import BladeSpec, FlankSpec, MemberSpec, StickBladeSpec

_BLADE_KEYS = {
    "profile.radius": "radius",
    "profile.coefficient": "coefficient",
    "profile.reference_height": "reference_height",
}
_STICK_KEYS = {
    "radius": "blade_radius",
    "blade_angle": "angle",
    "height": "reference_height",
    "rake_angle": "side_rake_angle",
    "curve_radius": "radius",
}


def place(name: str, side: str, flank: FlankSpec, table: str, key: str) -> str:
    """Path in the file of a key that holds for a flank of the member of that name."""
    first = f"{table}.{key.split('.')[0]}"
    return f"{name}{f'.{side}' if first in flank.at_flank else ''}.{table}.{key}"


def at_file(problem: Problem, name: str, member: MemberSpec) -> Problem:
    """A fault at a flank's blade or dial, ``pinion.concave.blade.land``, told where the file has its key."""
    found = re.fullmatch(rf"{name}\.(concave|convex)\.(settings|blade)\.(.+)", problem.path)
    if found is None:
        return problem
    side, table, key = found.groups()
    flank = member.concave if side == "concave" else member.convex
    if table == "blade":
        return _at_blade(problem, name, side, flank, key)
    value = problem.example
    value = value if re.fullmatch(r"-?\d+|\[.*\]", value) else f'"{value}"'
    path = place(name, side, flank, table, key)
    return replace(problem, path=path, example=f"{key} = {value}")


def _at_blade(problem: Problem, name: str, side: str, flank: FlankSpec, key: str) -> Problem:
    """Radii become diameters, the land half the point width; a blade alone has all the land it wants."""
    if not isinstance(flank.blade, BladeSpec):
        return _at_stick_blade(problem, name, side, flank, flank.blade, key)
    spread = flank.blade.land is not None
    if key == "point_radius":
        given, expected = f"a point radius of {problem.given}", f"a point radius {problem.expected}"
        if spread:
            return Problem(f"{name}.cutter.diameter", given, expected, 'diameter = "9 in"')
        path = place(name, side, flank, "blade", "point_diameter")
        return Problem(path, given, expected, 'point_diameter = "228.6 mm"')
    if key == "land":
        given, expected = f"half of it {problem.given}", f"half of it {problem.expected}"
        least = 2.0 * float(problem.example.split('"')[1].split()[0])
        example = f'point_width = "{least:g} mm"'
        return Problem(f"{name}.cutter.point_width", given, expected, example)
    if key == "height":
        return replace(problem, path=f"{name}.cutter.height")
    expected = problem.expected
    if key == "edge_radius" and not spread:
        expected = re.sub(r"a land of .* slot\)", "the blade", expected)
    path = place(name, side, flank, "blade", _BLADE_KEYS.get(key, key))
    return replace(problem, path=path, expected=expected)


def _at_stick_blade(
    problem: Problem, name: str, side: str, flank: FlankSpec, blade: StickBladeSpec, key: str
) -> Problem:
    """The paper's measures by the keys of the file; what the shank wants is the blade's whole height."""
    if key == "shank_height":
        expected = f"more than its reference height: above the pitch point, {problem.expected}"
        example = f'height = "{blade.reference_height + 6.0:g} mm"'
        return replace(problem, path=f"{name}.cutter.height", expected=expected, example=example)
    axial = blade.toprem is not None and blade.toprem[2] == "axial"
    own = "toprem.height" if axial and key == "toprem.length" else _STICK_KEYS.get(key, key)
    example = re.sub(r"^\w+", own.split(".")[-1], problem.example)
    return replace(problem, path=place(name, side, flank, "blade", own), example=example)


def cut_faults(flank: Flank, spec: FlankSpec, half_breadth: float | None) -> list[Problem]:
    """What shows when a flank is cut: a cam beyond its uniform motion, blades too short for the tooth.

    ``half_breadth`` is that of the cam, mm, if there is one and it is known.
    """
    problems: list[Problem] = []
    cam = flank.settings.cam
    charts = [flank.charts[name] for name in flank.cut_pieces]
    if cam is not None and all(np.isfinite(chart.s).all() for chart in charts):
        path = place(flank.member, flank.side, spec, "settings", "cam_number")
        try:
            check_roll(cam, half_breadth, *roll_range(flank), path)
        except DesignError as error:
            problems += (
                replace(p, given=f"{p.given} for the {flank.name} flank") for p in error.problems
            )
    height = spec.blade.height
    if height is not None and np.isfinite(charts[0].error):
        ends = np.array([flank.toe, flank.heel])
        top = charts[0].bounds(ends)[1]
        lacking = float(np.max(flank.tip.at(ends) - top))
        if lacking > 0.0:
            least = np.ceil(10.0 * (height + lacking)) / 10.0
            expected = (
                f"about {least:g} mm or more: the edge ends {lacking:.3g} mm below the tooth's tip"
            )
            example = f'height = "{least + 1.0:g} mm"'
            path = f"{flank.member}.cutter.height"
            problems.append(Problem(path, f"{height:g} mm", expected, example))
    return problems
