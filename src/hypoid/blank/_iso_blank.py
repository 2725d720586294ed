"""Blanks by ISO 23509, methods 0 to 3: any shaft angle, face milled or face hobbed, every taper."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin
from typing import Literal

from hypoid.geometry import DesignError

from ._blank import FlankPressureAngles, Hand, PairBlank
from ._cone_solver import ConeInputs, Trial, solve_cones
from ._cones import face_and_root_cones
from ._depths import DepthFactors, depth_factors, mean_depths
from ._face_width import (
    EqualFaceWidth,
    GleasonFaceWidth,
    KlingelnbergFaceWidth,
    OerlikonFaceWidth,
    PinionFaceWidth,
)
from ._guide_values import CLEARANCE_FACTOR, DEPTH_FACTOR, mean_addendum_factor, thickness_factor
from ._iso_limits import no_cones, request_problems, solution_problems
from ._methods import condition, first_wheel_angle
from ._pair_blank import blank_of_cones
from ._pitch_cones import PitchCones, limit_pressure_angle
from ._printed_chains import printed_method_1, printed_method_2, printed_method_3
from ._spiral_angles import crown_gear_tooth
from ._taper import Taper, TaperAngles, taper_angles

BacklashKind = Literal["outer-normal", "outer-transverse", "mean-normal", "mean-transverse"]


@dataclass(frozen=True)
class TypeII:
    """Tooth data of type II; None takes the guide value of annex C (ISO 23509, tables 3 and 4)."""

    mean_addendum_factor: float | None = None  # c_ham
    depth_factor: float = DEPTH_FACTOR  # k_d
    clearance_factor: float = CLEARANCE_FACTOR  # k_c
    thickness_factor: float | None = None  # k_t


@dataclass(frozen=True)
class TypeI:
    """Tooth data of type I, in mean normal modules (ISO 23509, table 3)."""

    factors: DepthFactors  # k_hap, k_hfp, x_hm1
    thickness: float = 0.0  # x_smn


@dataclass(frozen=True)
class Backlash:
    """Backlash and where it is measured, mm (ISO 23509, (205)-(208))."""

    value: float
    kind: BacklashKind = "outer-normal"


@dataclass(frozen=True)
class BlankRequest:
    """What ISO 23509 asks of a designer, table 2; mm and rad, signs of the canonical pair.

    The wheel's size is its outer or its mean pitch diameter, one of them; the spiral angle is that of
    the pinion or the wheel at the mean point. Method 1 usually goes with the pinion's, the others with
    the wheel's. Blade groups 0 is face milling.
    """

    method: Literal[0, 1, 2, 3]
    z1: int
    z2: int
    shaft_angle: float
    offset: float
    wheel_face_width: float
    cutter_radius: float
    spiral_angle: float
    spiral_of: Literal["pinion", "wheel"] = "wheel"
    wheel_outer_diameter: float | None = None  # d_e2
    wheel_mean_diameter: float | None = None  # d_m2
    blade_groups: int = 0
    pressure_angles: tuple[float, float] = (radians(20.0), radians(20.0))  # alpha_dD, alpha_dC
    limit_share: float = 1.0  # f_alim: 1 balances the sides about the limit pressure angle
    tooth: TypeI | TypeII = TypeII()
    taper: Taper | TaperAngles = "standard"
    backlash: Backlash = Backlash(0.0)
    pinion_hand: Hand = "left"
    printed: bool = False  # stop early, as the standard's own iterations do


def iso_blank(request: BlankRequest) -> PairBlank:
    """Blank of a pair by ISO 23509, clauses 6 and 7.

    Raises
    ------
    DesignError
        With every number out of range, or the limit that leaves no cones or no blank.
    """
    if problems := request_problems(request):
        raise DesignError(problems)
    given = cone_inputs(request)
    trial = _cones(request, given)
    if trial is None:
        raise DesignError([no_cones(request)])
    slope = trial.slope_angle(request.z2, request.cutter_radius, request.blade_groups)
    cones = trial.cones(given, slope)
    if problems := solution_problems(request, cones):
        raise DesignError(problems)
    return _blank(request, trial, cones)


def cone_inputs(request: BlankRequest) -> ConeInputs:
    """What the solver of cones takes of a request."""
    mean, outer = request.wheel_mean_diameter, request.wheel_outer_diameter
    first = first_wheel_angle(request.z1, request.z2, request.shaft_angle)

    def radius(delta2: float) -> float:
        if mean is not None or outer is None:
            return 0.5 * (mean or 0.0)
        # method 1 keeps the radius of its first guess (12), so that P is not at mid-face
        angle = first if request.method == 1 else delta2
        return 0.5 * (outer - request.wheel_face_width * sin(angle))

    return ConeInputs(
        request.z1,
        request.z2,
        request.shaft_angle,
        request.offset,
        radius,
        request.spiral_angle,
        request.spiral_of,
    )


def _cones(request: BlankRequest, given: ConeInputs) -> Trial | None:
    cutter = request.cutter_radius, request.blade_groups
    if request.printed and request.method and request.offset:
        chains = printed_method_1, printed_method_2, printed_method_3
        return chains[request.method - 1](given, *cutter)
    return solve_cones(given, condition(request.method, request.z2, *cutter))


def tooth_factors(
    tooth: TypeI | TypeII, teeth: tuple[int, int], pitch_angles: tuple[float, float]
) -> tuple[DepthFactors, float]:
    """Depth factors and thickness factor x_smn of tooth data of either type; angles rad."""
    if isinstance(tooth, TypeI):
        return tooth.factors, tooth.thickness
    c_ham, k_t = tooth.mean_addendum_factor, tooth.thickness_factor
    factors = depth_factors(
        mean_addendum_factor=mean_addendum_factor(teeth, pitch_angles) if c_ham is None else c_ham,
        depth_factor=tooth.depth_factor,
        clearance_factor=tooth.clearance_factor,
    )
    return factors, 0.5 * (thickness_factor(teeth) if k_t is None else k_t)


def _blank(request: BlankRequest, trial: Trial, cones: PitchCones) -> PairBlank:
    factors, x_smn = tooth_factors(
        request.tooth, cones.teeth, (cones.pinion_pitch_angle, cones.wheel_pitch_angle)
    )
    limit = limit_pressure_angle(
        (trial.delta1, trial.delta2),
        (trial.big_r_m1, trial.big_r_m2),
        (trial.beta_m1, trial.beta_m2),
        cones.offset_angle_pitch_plane,
    )
    shift = request.limit_share * limit
    angles = FlankPressureAngles(
        request.pressure_angles[0] + shift, request.pressure_angles[1] - shift, limit
    )
    mean_angle = 0.5 * (angles.drive + angles.coast)
    face, distance = request.wheel_face_width, cones.wheel_mean_cone_distance
    share = 0.5
    if request.wheel_outer_diameter is not None:  # (41)
        reach = request.wheel_outer_diameter / (2.0 * sin(cones.wheel_pitch_angle))
        share = (reach - distance) / face
    outer_distance = distance + share * face
    depths = mean_depths(cones.mean_normal_module, factors)
    taper = request.taper
    if not isinstance(taper, TaperAngles):
        taper = taper_angles(
            taper,
            cones,
            depths,
            outer_transverse_module=2.0
            * outer_distance
            * sin(cones.wheel_pitch_angle)
            / request.z2,
            outer_cone_distance=outer_distance,
            pressure_angle=mean_angle,
            cutter_radius=request.cutter_radius,
        )
    q = _backlash_factor(request, cones, mean_angle, outer_distance)
    return blank_of_cones(
        cones,
        wheel_face_width=face,
        cutter_radius=request.cutter_radius,
        blade_groups=request.blade_groups,
        factors=factors,
        pinion_hand=request.pinion_hand,
        pressure_angle=mean_angle,
        wheel_addendum_angle=taper.addendum,
        wheel_dedendum_angle=taper.dedendum,
        outer_share=share,
        pinion_width=_pinion_width(request, cones, factors, taper),
        thickness_factors=(x_smn - q, -x_smn - q),
        pressure_angles=angles,
    )


def _pinion_width(
    request: BlankRequest, cones: PitchCones, factors: DepthFactors, taper: TaperAngles
) -> PinionFaceWidth:
    if request.method == 0 or not request.offset:
        return EqualFaceWidth()
    if request.method == 2:
        return OerlikonFaceWidth()
    if request.method == 3:
        return KlingelnbergFaceWidth()
    depths = mean_depths(cones.mean_normal_module, factors)
    face_root = face_and_root_cones(
        cones,
        depths,
        wheel_addendum_angle=taper.addendum,
        wheel_dedendum_angle=taper.dedendum,
    )
    return GleasonFaceWidth(depths, face_root)


def _backlash_factor(
    request: BlankRequest, cones: PitchCones, pressure_angle: float, outer_distance: float
) -> float:
    """What the backlash takes off either thickness factor (205)-(208)."""
    j, module = request.backlash.value, cones.mean_normal_module
    beta = cones.wheel_spiral_angle
    if not j:
        return 0.0
    tooth = crown_gear_tooth(cones, request.cutter_radius, request.blade_groups)
    pitches = cones.wheel_mean_cone_distance * cos(beta) / outer_distance
    match request.backlash.kind:
        case "outer-normal":
            across = cos(pressure_angle) * cos(tooth.spiral_angle(outer_distance))
            return j * pitches / (4.0 * module * across)
        case "outer-transverse":
            return j * pitches / (4.0 * module)
        case "mean-normal":
            return j / (4.0 * module * cos(pressure_angle))
        case "mean-transverse":
            return j * cos(beta) / (4.0 * module)
