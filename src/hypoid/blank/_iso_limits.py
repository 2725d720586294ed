"""What the numbers of a blank request must keep to, told all at once, with a value that would do."""

from __future__ import annotations

from collections.abc import Iterator
from math import acos, asin, cos, degrees, isfinite, pi, radians, sin
from typing import TYPE_CHECKING

from hypoid.geometry import Problem

from ._pitch_cones import PitchCones
from ._spiral_angles import crown_gear_tooth

if TYPE_CHECKING:
    from ._iso_blank import BlankRequest

LEAST_ANGLE = radians(1.0)
STEEPEST = radians(80.0)
SIZES = "wheel.outer_pitch_diameter, wheel.mean_pitch_diameter or wheel.outer_transverse_module"


def request_problems(request: BlankRequest) -> list[Problem]:
    """Every number of a request that is out of range by itself or beside another."""
    return [*_numbers(request), *_together(request)]


def _numbers(request: BlankRequest) -> Iterator[Problem]:
    lengths = {
        "wheel.face_width": request.wheel_face_width,
        "cutting.cutter_radius": request.cutter_radius,
        "wheel.outer_pitch_diameter": request.wheel_outer_diameter,
        "wheel.mean_pitch_diameter": request.wheel_mean_diameter,
    }
    for path, value in lengths.items():
        if value is not None and not (isfinite(value) and value > 0.0):
            yield Problem(path, f"{value:g} mm", "a length above zero", '"100 mm"')
    if request.z1 < 1 or request.z2 < request.z1:
        given = f"{request.z1} and {request.z2}"
        yield Problem("wheel.teeth", given, "as many teeth as the pinion, or more", "39")
    if not LEAST_ANGLE < request.shaft_angle < pi - LEAST_ANGLE:
        given = f"{degrees(request.shaft_angle):.6g} deg"
        yield Problem("pair.shaft_angle", given, "an angle from 1 to 179 deg", '"90 deg"')
    if not 0.0 <= request.spiral_angle < STEEPEST:
        path, given = (
            f"{request.spiral_of}.mean_spiral_angle",
            f"{degrees(request.spiral_angle):.6g} deg",
        )
        yield Problem(path, given, "an angle from 0 to below 80 deg", '"35 deg"')
    for side, angle in zip(("drive", "coast"), request.pressure_angles, strict=True):
        if not 0.0 < angle < radians(45.0):
            path = f"cutting.{side}_pressure_angle"
            given = f"{degrees(angle):.6g} deg"
            yield Problem(path, given, "an angle above 0 and below 45 deg", '"20 deg"')
    if request.blade_groups < 0:
        given = f"{request.blade_groups}"
        yield Problem("cutting.blade_groups", given, "0 (face milling) or more", "13")


def _together(request: BlankRequest) -> Iterator[Problem]:
    sizes = [request.wheel_outer_diameter, request.wheel_mean_diameter]
    if sum(size is not None for size in sizes) != 1:
        given = "nothing" if sizes == [None, None] else "more than one of them"
        yield Problem("wheel.outer_pitch_diameter", given, f"one of {SIZES}", '"170 mm"')
        return
    size = next(size for size in sizes if size is not None)
    if not isfinite(request.offset) or abs(request.offset) >= 0.5 * size:
        expected = f"less than {0.5 * size:.4g} mm: beyond that the pinion passes the wheel"
        example = f'"{0.1 * size:.2g} mm"'
        yield Problem("pair.offset", f"{request.offset:g} mm", expected, example)
    if request.method == 0 and request.offset:
        expected = "0 mm with method 0 (spiral bevel), or method 1, 2 or 3"
        yield Problem("pair.offset", f"{request.offset:g} mm", expected, '"0 mm"')


def no_cones(request: BlankRequest) -> Problem:
    """Why no pitch cones meet the method's condition."""
    z1, z2, sigma = request.z1, request.z2, request.shaft_angle
    if z1 / z2 + cos(sigma) <= 0.0:
        widest = degrees(pi - acos(z1 / z2))
        given = f"{degrees(sigma):.6g} deg"
        expected = f"below about {widest:.4g} deg for {z1}/{z2} teeth: the wheel would be internal"
        return Problem("pair.shaft_angle", given, expected, f'"{0.95 * widest:.3g} deg"')
    if request.spiral_of == "pinion" and request.offset:
        size = request.wheel_mean_diameter or request.wheel_outer_diameter or 1.0
        turn = degrees(asin(min(2.0 * request.offset / size, 1.0)))
        expected = (
            f"more than the offset angle of about {turn:.3g} deg, or a smaller offset: no pitch cones "
            f"meet the condition of method {request.method}"
        )
        given = f"{degrees(request.spiral_angle):.6g} deg"
        return Problem("pinion.mean_spiral_angle", given, expected, f'"{turn + 30.0:.2g} deg"')
    expected = (
        f"an offset with which pitch cones meet the condition of method {request.method}: a smaller one, "
        "or another cutter radius or spiral angle"
    )
    return Problem(
        "pair.offset", f"{request.offset:g} mm", expected, f'"{0.5 * request.offset:.3g} mm"'
    )


def solution_problems(request: BlankRequest, cones: PitchCones) -> list[Problem]:
    """What is wrong with cones that exist."""
    problems: list[Problem] = []
    radius, groups = request.cutter_radius, request.blade_groups
    if cones.mean_normal_module * groups > 2.0 * radius:
        least = 0.5 * cones.mean_normal_module * groups
        expected = f"at least m_mn z0/2 = {least:.4g} mm: the slope angle would pass 90 deg"
        problems.append(
            Problem("cutting.cutter_radius", f"{radius:g} mm", expected, f'"{1.5 * least:.3g} mm"')
        )
    if cones.wheel_spiral_angle < -1e-12 or cones.pinion_spiral_angle < -1e-12:
        turn = degrees(cones.offset_angle_pitch_plane)
        expected = f"more than the offset angle in the pitch plane, {turn:.4g} deg"
        path = f"{request.spiral_of}.mean_spiral_angle"
        given = f"{degrees(request.spiral_angle):.6g} deg"
        problems.append(Problem(path, given, expected, f'"{turn + 15.0:.2g} deg"'))
    if problems:
        return problems
    least, greatest = crown_gear_tooth(cones, radius, groups).reach
    outer = cones.wheel_mean_cone_distance + 0.5 * request.wheel_face_width
    if not least < outer < greatest:
        middle = cones.wheel_mean_cone_distance * sin(cones.wheel_pitch_angle)
        expected = (
            f"a cutter that sweeps the heel at {outer:.4g} mm; this one reaches {greatest:.4g} mm"
        )
        problems.append(
            Problem("cutting.cutter_radius", f"{radius:g} mm", expected, f'"{middle:.3g} mm"')
        )
    return problems
