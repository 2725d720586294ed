"""From the numbers of a design file to the blank of an exact face-hobbed pair."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import radians, sin

from hypoid.geometry import DesignError, Problem

from ._alignment import (
    FaceHobbedInputs,
    alignment_residual,
    ratio_residual,
    solve_aligned_cones,
)
from ._blank import FlankPressureAngles, Hand, OuterPinionReading, OuterPinionReadings, PairBlank
from ._cones import face_and_root_cones
from ._depths import DepthFactors, depth_factors, mean_depths
from ._face_width import (
    EqualFaceWidth,
    FaceWidth,
    KlingelnbergFaceWidth,
    PinionFaceWidth,
    split_face_width,
)
from ._limits import (
    PitchConeFault,
    check_ranges,
    diagnose,
    explain,
    nearest_working,
    round_off,
)
from ._member import MemberBuilder
from ._pitch_cones import PitchCones
from ._spiral_angles import CrownGearTooth, crown_gear_tooth, end_spiral_angles, pinion_boundaries


def pair_blank(
    *,
    z1: int,
    z2: int,
    shaft_angle: float,
    offset: float,
    wheel_mean_radius: float,
    wheel_face_width: float,
    pinion_spiral_angle: float,
    cutter_radius: float,
    blade_groups: int,
    mean_addendum_factor: float = 0.5,
    depth_factor: float = 1.75,
    clearance_factor: float = 0.125,
    pinion_hand: Hand = "left",
    pressure_angle: float = radians(20.0),
) -> PairBlank:
    """Blank of a pair cut by the exact face-hobbing system, uniform depth; mm and rad.

    Pitch cones by [gonzalez-fuentes-2022, (1), (2)], the rest by ISO 23509, clauses 7.2-7.8. The
    pinion face width is method 3's, or the wheel's own without offset. A positive offset makes
    the pinion's spiral angle the larger one, for either hand.

    Raises
    ------
    DesignError
        With every problem of the numbers, or the one that leaves no pitch cones.
    """
    numbers = {
        "z1": z1,
        "z2": z2,
        "shaft_angle": shaft_angle,
        "offset": offset,
        "wheel_mean_radius": wheel_mean_radius,
        "wheel_face_width": wheel_face_width,
        "pinion_spiral_angle": pinion_spiral_angle,
        "cutter_radius": cutter_radius,
        "blade_groups": blade_groups,
        "mean_addendum_factor": mean_addendum_factor,
        "depth_factor": depth_factor,
        "clearance_factor": clearance_factor,
        "pressure_angle": pressure_angle,
    }
    problems = check_ranges(numbers)
    if pinion_hand not in ("left", "right"):
        problems.append(Problem("pinion.hand", repr(pinion_hand), '"left" or "right"', '"left"'))
    if problems:
        raise DesignError(problems)

    def blank(cones: PitchCones, given: FaceHobbedInputs, face_width: float) -> PairBlank:
        return blank_of_cones(
            cones,
            wheel_face_width=face_width,
            cutter_radius=given.cutter_radius,
            blade_groups=blade_groups,
            factors=depth_factors(
                mean_addendum_factor=mean_addendum_factor,
                depth_factor=depth_factor,
                clearance_factor=clearance_factor,
            ),
            pinion_hand=pinion_hand,
            pressure_angle=pressure_angle,
        )

    def works(trial: FaceHobbedInputs, face_width: float = wheel_face_width) -> bool:
        cones = solve_aligned_cones(trial)
        if cones is None or diagnose(trial, cones) is not None:
            return False
        try:
            blank(cones, trial, face_width)
        except DesignError:
            return False
        return True

    given = FaceHobbedInputs(
        z1=z1,
        z2=z2,
        shaft_angle=shaft_angle,
        offset=offset,
        wheel_mean_radius=wheel_mean_radius,
        pinion_spiral_angle=pinion_spiral_angle,
        cutter_radius=cutter_radius,
        blade_groups=blade_groups,
    )
    cones = solve_aligned_cones(given)
    fault = diagnose(given, cones)
    if cones is None or fault is not None:
        raise DesignError([explain(given, cones, fault or PitchConeFault.NO_SOLUTION, works)])
    try:
        return blank(cones, given, wheel_face_width)
    except DesignError as error:
        raise DesignError(
            [
                _with_tested_example(problem, given, wheel_face_width, works)
                for problem in error.problems
            ]
        ) from None


def _with_tested_example(
    problem: Problem,
    given: FaceHobbedInputs,
    face_width: float,
    works: Callable[[FaceHobbedInputs, float], bool],
) -> Problem:
    """The same problem with an example that the other numbers of the design bear out."""
    best = None
    if problem.path == "cutting.cutter_radius":
        best = nearest_working(given, "cutter_radius", lambda trial: works(trial, face_width))
    elif problem.path == "wheel.face_width":
        widths = (round_off(face_width * 0.9**step) for step in range(1, 40))
        best = next((width for width in widths if works(given, width)), None)
    return problem if best is None else replace(problem, example=f'"{best:g} mm"')


def blank_of_cones(
    cones: PitchCones,
    *,
    wheel_face_width: float,
    cutter_radius: float,
    blade_groups: int,
    factors: DepthFactors,
    pinion_hand: Hand,
    pressure_angle: float,
    wheel_addendum_angle: float = 0.0,
    wheel_dedendum_angle: float = 0.0,
    outer_share: float = 0.5,
    pinion_width: PinionFaceWidth | None = None,
    thickness_factors: tuple[float, float] = (0.0, 0.0),
    pressure_angles: FlankPressureAngles | None = None,
) -> PairBlank:
    """Blank on given pitch cones, however they were found (ISO 23509, clauses 7.2-7.8).

    `outer_share` is c_be2; `pinion_width` None means method 3, or method 0 without offset. The
    thickness factors (pinion, wheel) have the backlash taken off.
    """
    depths = mean_depths(cones.mean_normal_module, factors)
    face_root = face_and_root_cones(
        cones,
        depths,
        wheel_addendum_angle=wheel_addendum_angle,
        wheel_dedendum_angle=wheel_dedendum_angle,
    )
    wheel = split_face_width(wheel_face_width, outer_share)
    _check_wheel_width(cones, wheel)
    if pinion_width is None:
        pinion_width = KlingelnbergFaceWidth() if cones.offset else EqualFaceWidth()
    pinion = pinion_width.widths(cones, wheel)
    tooth = crown_gear_tooth(cones, cutter_radius, blade_groups)
    _check_reach(cones, tooth, pinion, wheel)
    spirals = end_spiral_angles(cones, tooth, pinion, wheel)
    build = MemberBuilder(
        cones, depths, face_root, factors, spirals, tooth, pressure_angle, thickness_factors
    )
    opposite: Hand = "right" if pinion_hand == "left" else "left"
    wheel_outer_diameter = (
        2.0 * (cones.wheel_mean_cone_distance + wheel.outer) * sin(cones.wheel_pitch_angle)
    )
    return PairBlank(
        shaft_angle=cones.shaft_angle,
        offset=cones.offset,
        mean_normal_module=cones.mean_normal_module,
        outer_transverse_module=wheel_outer_diameter / cones.teeth[1],
        limit_pressure_angle=cones.limit_pressure_angle,
        slope_angle=cones.slope_angle,
        pressure_angle=pressure_angle,
        working_depth=depths.working_depth,
        clearance=depths.clearance,
        cones=cones,
        depths=depths,
        face_and_root=face_root,
        pinion=build.member("pinion", pinion_hand, pinion),
        wheel=build.member("wheel", opposite, wheel),
        outer_pinion_readings=_outer_readings(cones, wheel),
        ratio_residual=ratio_residual(cones),
        alignment_residual=alignment_residual(cones, cutter_radius),
        pressure_angles=pressure_angles,
    )


def _outer_readings(cones: PitchCones, wheel: FaceWidth) -> OuterPinionReadings:
    """R_e1 and d_e1 with a_p and with a in its place (ISO 23509, clause 7.5, method 3)."""

    def reading(source: str, a_p: float) -> OuterPinionReading:
        face = KlingelnbergFaceWidth(a_p).widths(cones, wheel) if cones.offset else wheel
        outer = cones.pinion_mean_cone_distance + face.outer
        diameter = 2.0 * outer * sin(cones.pinion_pitch_angle)
        return OuterPinionReading(source, a_p, outer, diameter)

    return OuterPinionReadings(
        conforming=reading("ISO 23509, clause 7.5: a_p", cones.pitch_plane_offset),
        printed_2022=reading("2022 paper, Table 2: a for a_p", cones.offset),
    )


def _check_wheel_width(cones: PitchCones, wheel: FaceWidth) -> None:
    """The wheel's toe must stay outside the circle that the pinion generatrix touches."""
    nearest = max(abs(cones.pitch_plane_offset), abs(cones.offset))
    room = cones.wheel_mean_cone_distance - nearest
    if wheel.inner < room:
        return
    widest = room * wheel.width / wheel.inner
    raise DesignError(
        [
            Problem(
                "wheel.face_width",
                f"{wheel.width:g} mm",
                f"less than {widest:.4g} mm, where the wheel's toe meets the pinion generatrix "
                f"(mean cone distance {cones.wheel_mean_cone_distance:.4g} mm)",
                f'"{round_off(0.4 * widest):g} mm"',
            )
        ]
    )


def _check_reach(
    cones: PitchCones, tooth: CrownGearTooth, pinion: FaceWidth, wheel: FaceWidth
) -> None:
    """The cutter must sweep the whole face of both members."""
    middle = cones.wheel_mean_cone_distance
    outer, inner = pinion_boundaries(cones, pinion)
    outer, inner = max(outer, middle + wheel.outer), min(inner, middle - wheel.inner)
    least, greatest = tooth.reach
    if least < inner and outer < greatest:
        return
    raise DesignError(
        [
            Problem(
                "cutting.cutter_radius",
                f"{tooth.cutter_radius:g} mm",
                f"a cutter that sweeps the face from cone distance {inner:.4g} to {outer:.4g} mm; "
                f"this one reaches from {least:.4g} to {greatest:.4g} mm (or a smaller "
                "wheel.face_width)",
                f'"{round_off(0.77 * cones.wheel_mean_radius):g} mm"',
            )
        ]
    )
