"""From a face-milled request to a complete spec: blank, wheel, both pinion flanks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, sin
from typing import Any

from hypoid.blank import (
    DepthFactors,
    PairBlank,
    UndercutLimit,
    crown_gear_tooth,
    iso_blank,
    tooth_factors,
    undercut_limits,
)
from hypoid.flank import SIDES, Side
from hypoid.geometry import DesignError, Problem
from hypoid.machine import MachineSettings, to_sheet

from ._flank_fit import FlankFit
from ._member_blanks import given_blank
from ._milled_request import TOGETHER, MilledRequest
from ._milled_wheel import EDGE, ROOM, MilledWheel, milled_wheel
from ._pinion_fit import fit_pinion
from ._pinion_task import pinion_task
from ._sheet_spec import BladeSpec, FlankSpec, MemberSpec, Method, SummarySheetSpec

SHEET_METHODS: dict[str, Method] = {
    "tilt": "tilt",
    "modified-roll": "modified-roll",
    "generated": "generated",
    "fixed-setting": "modified-roll",
    "helical": "tilt",
    "universal": "tilt",
    "completing": "duplex",
    "duplex-helical": "helical-duplex",
}


@dataclass(frozen=True)
class MilledDesign:
    """A face-milled pair as designed; the spec alone makes its flanks."""

    request: MilledRequest
    blank: PairBlank
    wheel: MilledWheel
    fits: Mapping[Side, FlankFit]
    spec: SummarySheetSpec
    undercut: tuple[UndercutLimit, ...]

    @property
    def faults(self) -> tuple[str, ...]:
        """What keeps the design from what was asked, in words."""
        found = [fault.value for fault in self.blank.faults]
        for limit in self.undercut:
            if not limit.kept:
                bound = "below its least" if limit.member == "pinion" else "above its greatest"
                found.append(
                    f"Undercut is likely at the {limit.member}'s {limit.place}: the profile shift x_hm1 = "
                    f"{limit.profile_shift:.3f} is {bound} of {limit.limit:.3f} (ISO 23509, clause 8)."
                )
        for side, fit in self.fits.items():
            if fit.largest > self.request.tolerance:
                found.append(self._short(side, fit))
        return tuple(found)

    def _short(self, side: Side, fit: FlankFit) -> str:
        """A flank that does not reach its target: how near it came, and what would help."""
        words = (
            f"The pinion's {side} flank keeps {1e3 * fit.largest:.1f} um from its target ease-off "
            f"(rms {1e3 * fit.rms:.1f} um; tolerance {1e3 * self.request.tolerance:g} um) with method "
            f'"{self.request.pinion_method}"'
        )
        if fit.held:
            words += f"; {', '.join(fit.held)}"
        helpful = [
            f"{name} (rms {1e3 * rms:.1f} um)" for name, rms in fit.helpful if rms < 0.8 * fit.rms
        ]
        return words + (
            f"; free as well, these would help: {', '.join(helpful)}." if helpful else "."
        )


def design_milled(request: MilledRequest) -> MilledDesign:
    """Blank, cutters and settings of a face-milled pair.

    Raises
    ------
    DesignError
        With every number that makes no sense, or the limit that leaves no pair.
    """
    if problems := request.problems():
        raise DesignError(problems)
    blank = iso_blank(request.blank)
    wheel = milled_wheel(request, blank)
    fits = fit_pinion(pinion_task(request, blank, wheel))
    lost = [side for side in SIDES if side not in fits]
    if lost:
        given = f'"{request.pinion_method}" ({" and ".join(lost)})'
        expected = (
            "a pinion flank that the wheel can generate over its face: lower the offset, the spiral angle "
            "or the depth, or take more pinion teeth"
        )
        raise DesignError([Problem("pinion.method", given, expected, 'method = "tilt"')])
    return MilledDesign(
        request, blank, wheel, fits, _spec(request, blank, wheel, fits), _undercut(request, blank)
    )


def _undercut(request: MilledRequest, blank: PairBlank) -> tuple[UndercutLimit, ...]:
    cones = blank.cones
    angles = cones.pinion_pitch_angle, cones.wheel_pitch_angle
    factors: DepthFactors = tooth_factors(request.blank.tooth, cones.teeth, angles)[0]
    tooth = crown_gear_tooth(cones, request.blank.cutter_radius, 0)
    generated = request.wheel_method == "generated"
    return undercut_limits(blank, factors, tooth, wheel_generated=generated)


def _spec(
    request: MilledRequest, blank: PairBlank, wheel: MilledWheel, fits: Mapping[Side, FlankFit]
) -> SummarySheetSpec:
    """The complete file of what was found."""
    cut, land = wheel.cut, 0.5 * wheel.cut.point_width
    edge = request.pinion_edge_radius
    together = request.pinion_method in TOGETHER
    own_land = 0.5 * (fits["concave"].point_radius - fits["convex"].point_radius)
    if edge is None:
        edge = _pinion_edge(blank, wheel, fits)
        if together:  # both arcs have room on one cutter's point
            edge = min(edge, *(_arc(own_land, fit.blade_angle) for fit in fits.values()))

    def wheel_flank(side: Side) -> FlankSpec:
        i = 0 if side == "concave" else 1
        blade = BladeSpec(cut.point_radii[i], cut.blade_angles[i], wheel.edge_radius, land)
        dials = _dials(wheel.settings, blank.wheel.pitch_apex_beyond_crossing_point)
        return FlankSpec(request.wheel_method, "basic", dials, blade, _AT_WHEEL)

    def pinion_flank(side: Side) -> FlankSpec:
        fit = fits[side]
        blade = BladeSpec(
            fit.point_radius, fit.blade_angle, edge, own_land if together else None, **_curve(fit)
        )
        dials = _dials(fit.settings, blank.pinion.pitch_apex_beyond_crossing_point)
        method = SHEET_METHODS[request.pinion_method]
        at_flank = (
            _AT_WHEEL if together else frozenset(f"settings.{name}" for name in dials) | _AT_PINION
        )
        return FlankSpec(method, "basic", dials, blade, at_flank)

    return SummarySheetSpec(
        title=request.title,
        source=request.source,
        assumed=request.assumed,
        shaft_angle=blank.shaft_angle,
        offset=blank.offset,
        pinion=MemberSpec(
            blank.pinion.teeth,
            blank.pinion.hand,
            given_blank(blank.pinion),
            pinion_flank("concave"),
            pinion_flank("convex"),
        ),
        wheel=MemberSpec(
            blank.wheel.teeth,
            blank.wheel.hand,
            given_blank(blank.wheel, wheel.cut.deeper),
            wheel_flank("concave"),
            wheel_flank("convex"),
        ),
        marking_thickness=request.marking_thickness,
        normal_backlash=None if together else request.normal_backlash,
    )


def _curve(fit: FlankFit) -> dict[str, Any]:
    """How a curved blade is written; it has its angle at the tips."""
    if not fit.blade_curvature:
        return {}
    return {"curve": "circular-arc", "curve_radius": 1.0 / fit.blade_curvature}


def _arc(length: float, angle: float) -> float:
    """Edge radius, mm, whose arc takes so much of a blade from its sharp corner, mm."""
    return 0.98 * max(length, 0.0) * cos(angle) / (1.0 - sin(angle))


def _pinion_edge(blank: PairBlank, wheel: MilledWheel, fits: Mapping[Side, FlankFit]) -> float:
    """Edge radius of the pinion's blades, mm: its arc ends below where the wheel's tip comes by."""
    usual = min(EDGE * blank.mean_normal_module, 0.9 * wheel.edges[0].largest)
    for fit in fits.values():
        room = ROOM * (blank.clearance or 0.0) - max(0.0, float(fit.root_error.max()))
        usual = min(usual, room / (1.0 - sin(fit.blade_angle)))
        usual = min(
            usual, _arc(fit.least_edge, fit.blade_angle)
        )  # below all that the wheel touches
    return max(usual, 0.0)


_AT_WHEEL = frozenset({"blade.angle"})
_AT_PINION = frozenset({"blade.angle", "blade.point_diameter"})
_PLAIN = (
    "radial_distance", "cradle_angle", "tilt_angle", "swivel_angle", "blank_offset",
    "machine_root_angle", "machine_center_to_back", "sliding_base",
)  # fmt: skip


def _dials(settings: MachineSettings, apex: float) -> dict[str, Any]:
    """Basic settings as the file takes them, signs of the sheet: what rests is left out."""
    sheet = to_sheet(settings, apex)
    dials: dict[str, Any] = {name: float(getattr(sheet, name)) for name in _PLAIN}
    if settings.generated:
        dials["ratio_of_roll"] = float(sheet.ratio_of_roll)
        if sheet.helical_motion:
            dials["helical_motion"] = float(sheet.helical_motion)
        if any(sheet.modified_roll):
            dials["modified_roll"] = tuple(float(c) for c in sheet.modified_roll)
    else:
        dials["ratio_of_roll"] = 0.0
    motions = {
        name: tuple(float(c) for c in getattr(sheet.motions, name))
        for name in sheet.motions.moved()
    }
    if motions:
        dials["motions"] = motions
    return dials
