"""What a pair's numbers must keep to, and which one to change when no pitch cones exist."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from enum import Enum
from math import acos, atan2, cos, degrees, floor, isfinite, log, log10, pi, radians, sin

from hypoid.geometry import Problem

from ._alignment import FaceHobbedInputs, nearest_blade_slope, wants_internal_wheel
from ._pitch_cones import PitchCones

# how far a value is moved, up and down, in the search for one that works
GROWTH = tuple(1.1**power for power in (1, 2, 3, 4, 6, 8, 11, 15, 20, 27))

Works = Callable[[FaceHobbedInputs], bool]
Limit = tuple[str, str, Callable[[float], bool], str, str]


class PitchConeFault(Enum):
    """Why a set of numbers has no useful pitch cones; the value says what to do."""

    NO_SOLUTION = (
        "no pitch cones turn with the tooth ratio and keep the cutter centre in line with both "
        "pitch apexes; change offset, pinion spiral angle or cutter radius"
    )
    BEYOND_THE_WHEEL = "the pinion axis passes beyond the wheel; lower the offset"
    INTERNAL_WHEEL = (
        "the wheel would be an internal gear, its pitch angle above 90 deg; lower the shaft angle, "
        "or change offset, pinion spiral angle or cutter radius"
    )
    SLOPE_ANGLE = (
        "the cutter is smaller than its slope angle allows, m_b z0 > 2 r_c0; take a larger cutter "
        "or fewer blade groups"
    )
    WHEEL_SPIRAL = (
        "the wheel would have the pinion's hand of spiral; raise the pinion spiral angle or lower "
        "the offset"
    )


def check_ranges(values: dict[str, float]) -> list[Problem]:
    """Problems of single numbers, all at once; keys are `pair_blank`'s keyword names."""
    problems: list[Problem] = []
    for name, path, allowed, expected, example in _LIMITS:
        value = values[name]
        if not isfinite(value) or not allowed(value):
            problems.append(Problem(path, _as_given(name, value), expected, example))
    return problems


def diagnose(given: FaceHobbedInputs, cones: PitchCones | None) -> PitchConeFault | None:
    """What is wrong with the outcome of `solve_aligned_cones`, if anything."""
    if cones is None:
        if abs(given.offset) >= given.wheel_mean_radius:
            return PitchConeFault.BEYOND_THE_WHEEL
        if nearest_blade_slope(given)[0] > 1.0:
            return PitchConeFault.SLOPE_ANGLE
        if _bevel_wheel_angle(given) >= 0.5 * pi or wants_internal_wheel(given):
            return PitchConeFault.INTERNAL_WHEEL
        return PitchConeFault.NO_SOLUTION
    if cones.mean_normal_module * given.blade_groups > 2.0 * given.cutter_radius:
        return PitchConeFault.SLOPE_ANGLE
    if cones.wheel_spiral_angle < -1.0e-12:
        return PitchConeFault.WHEEL_SPIRAL
    return None


def explain(
    given: FaceHobbedInputs, cones: PitchCones | None, fault: PitchConeFault, works: Works
) -> Problem:
    """The one number to change, and a value near the given one with which a blank exists."""
    if fault is PitchConeFault.SLOPE_ANGLE:
        m_b = cones.mean_normal_module if cones else nearest_blade_slope(given)[1]
        limit = (
            f"at least m_b z0/2 = {0.5 * m_b * given.blade_groups:.4g} mm "
            f"(blade module {m_b:.4g} mm, {given.blade_groups} blade groups)"
        )
        return _problem(given, "cutter_radius", limit, fault, works)
    if fault is PitchConeFault.WHEEL_SPIRAL and cones is not None:
        turn = degrees(cones.offset_angle_pitch_plane)
        limit = f"more than the offset angle in the pitch plane ({turn:.4g} deg here)"
        return _problem(given, "pinion_spiral_angle", limit, fault, works)
    if fault is PitchConeFault.INTERNAL_WHEEL and _bevel_wheel_angle(given) >= 0.5 * pi:
        widest = degrees(pi - acos(given.z1 / given.z2))
        limit = f"about {widest:.4g} deg at most for {given.z1}/{given.z2} teeth without offset"
        return _problem(given, "shaft_angle", limit, fault, works)
    if fault is PitchConeFault.BEYOND_THE_WHEEL:
        limit = f"less than the wheel's mean radius, {given.wheel_mean_radius:g} mm"
        return _problem(given, "offset", limit, fault, works)
    return _least_change(given, fault, works)


def _bevel_wheel_angle(given: FaceHobbedInputs) -> float:
    """Wheel pitch angle that the pair would have without offset, rad (ISO 23509, (1)-(3))."""
    return atan2(sin(given.shaft_angle), given.z1 / given.z2 + cos(given.shaft_angle))


def nearest_working(given: FaceHobbedInputs, name: str, works: Works) -> float | None:
    """Nearest value of one input (mm or deg, two digits) that works, up or down; None if none."""
    start: float = getattr(given, name)
    is_angle = name in _ANGLES
    for growth in GROWTH:
        for factor in (1.0 / growth, growth):
            shown = round_off(degrees(start * factor) if is_angle else start * factor)
            value = radians(shown) if is_angle else shown
            too_wide = name == "pinion_spiral_angle" and value > max(radians(85.0), start)
            grown_offset = name == "offset" and factor > 1.0
            if not too_wide and not grown_offset and works(replace(given, **{name: value})):
                return shown
    return None


def _least_change(given: FaceHobbedInputs, fault: PitchConeFault, works: Works) -> Problem:
    """The one of the searched numbers that needs the least change to find cones."""
    found: list[tuple[float, str, float]] = []
    for name in _PATHS:
        start: float = getattr(given, name)
        best = nearest_working(given, name, works) if start else None
        if best is not None:
            shown = degrees(start) if name in _ANGLES else start
            found.append((abs(log(best / shown)), name, best))
    if not found:
        return _problem(given, "offset", "a smaller offset", fault, works)
    _, name, best = min(found)
    start = getattr(given, name)
    side = (
        "at least" if abs(best) > abs(degrees(start) if name in _ANGLES else start) else "at most"
    )
    unit = "deg" if name in _ANGLES else "mm"
    limit = f"{side} about {best:g} {unit} with the other values as they are"
    return Problem(
        _PATHS[name], _as_given(name, start), f"{limit} ({fault.value})", f'"{best:g} {unit}"'
    )


def _problem(
    given: FaceHobbedInputs, name: str, limit: str, fault: PitchConeFault, works: Works
) -> Problem:
    """Problem of one named input, with a tested example where there is one."""
    best = nearest_working(given, name, works)
    unit = "deg" if name in _ANGLES else "mm"
    if best is None:
        best = _USUAL[name] * (given.wheel_mean_radius if name in _LENGTHS else 1.0)
    value: float = getattr(given, name)
    return Problem(
        _PATHS[name],
        _as_given(name, value),
        f"{limit} ({fault.value})",
        f'"{round_off(best):g} {unit}"',
    )


def round_off(value: float) -> float:
    """Two significant digits, for a value in a message."""
    if value == 0.0:
        return 0.0
    return round(value, 1 - floor(log10(abs(value))))


def _as_given(name: str, value: float) -> str:
    """A value as the user thinks of it."""
    if not isfinite(value):
        return str(value)
    if name in _ANGLES:
        return _degrees(value)
    return f"{value:g} mm" if name in _LENGTHS else f"{value:g}"


def _degrees(angle: float) -> str:
    return f"{degrees(angle):.6g} deg"


def _positive(value: float) -> bool:
    return value > 0.0


def _whole(least: int) -> Callable[[float], bool]:
    return lambda value: value >= least and value == int(value)


def _within(low: float, high: float) -> Callable[[float], bool]:
    return lambda value: low < value < high


_ANGLES = {"shaft_angle", "pinion_spiral_angle", "pressure_angle"}
_LENGTHS = {"offset", "wheel_mean_radius", "wheel_face_width", "cutter_radius"}
_PATHS = {
    "offset": "pair.offset",
    "shaft_angle": "pair.shaft_angle",
    "cutter_radius": "cutting.cutter_radius",
    "pinion_spiral_angle": "pinion.mean_spiral_angle",
}
_USUAL = {"offset": 0.4, "cutter_radius": 0.8, "pinion_spiral_angle": 50.0, "shaft_angle": 90.0}
_LIMITS: tuple[Limit, ...] = (
    ("z1", "pinion.teeth", _whole(1), "a whole number of teeth, 1 or more", "6"),
    ("z2", "wheel.teeth", _whole(3), "a whole number of teeth, 3 or more", "73"),
    (
        "shaft_angle",
        "pair.shaft_angle",
        _within(radians(1.0), radians(179.0)),
        "an angle above 1 deg and below 179 deg",
        '"90 deg"',
    ),
    ("offset", "pair.offset", lambda _: True, "a finite length", '"55 mm"'),
    ("wheel_mean_radius", "wheel.mean_pitch_radius", _positive, "a length above zero", '"130 mm"'),
    ("wheel_face_width", "wheel.face_width", _positive, "a length above zero", '"35 mm"'),
    (
        "pinion_spiral_angle",
        "pinion.mean_spiral_angle",
        lambda value: 0.0 <= value < radians(89.0),
        "an angle from 0 deg to below 89 deg",
        '"65 deg"',
    ),
    ("cutter_radius", "cutting.cutter_radius", _positive, "a length above zero", '"100 mm"'),
    ("blade_groups", "cutting.blade_groups", _whole(1), "a whole number, 1 or more", "5"),
    (
        "mean_addendum_factor",
        "blank.mean_addendum_factor",
        lambda value: 0.0 <= value <= 1.0,
        "a number from 0 to 1 (c_ham, share of the wheel in the working depth)",
        "0.5",
    ),
    ("depth_factor", "blank.depth_factor", _within(0.0, 5.0), "a number above 0, below 5", "1.75"),
    (
        "clearance_factor",
        "blank.clearance_factor",
        lambda value: 0.0 <= value < 1.0,
        "a number from 0 to below 1",
        "0.125",
    ),
    (
        "pressure_angle",
        "cutting.pressure_angle",
        _within(0.0, radians(45.0)),
        "an angle above 0 deg and below 45 deg",
        '"20 deg"',
    ),
)
