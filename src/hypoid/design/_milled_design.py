"""From a face-milled request to a complete spec: blank, wheel, both pinion flanks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, sin
from typing import Any

from hypoid.blank import PairBlank, UndercutLimit, iso_blank
from hypoid.flank import SIDES, Side
from hypoid.geometry import DesignError, Problem

from ._design_faults import blank_faults, likely_undercut, short_of_target, wider
from ._designed_sheet import SHEET_METHODS, sheet_dials
from ._flank_fit import FlankFit
from ._member_blanks import given_blank
from ._milled_request import TOGETHER, MilledRequest
from ._milled_wheel import EDGE, ROOM, SHARPEST, MilledWheel, milled_wheel
from ._pinion_fit import fit_pinion
from ._pinion_task import pinion_task
from ._sheet_spec import BladeSpec, FlankSpec, MemberSpec, SummarySheetSpec


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
        found = blank_faults(self.blank, self.undercut)
        for side, fit in self.fits.items():
            if fit.largest > self.request.tolerance:
                found.append(self._short(side, fit))
        return tuple(found)

    def _short(self, side: Side, fit: FlankFit) -> str:
        """A flank that does not reach its target: how near it came, and what would help."""
        words = short_of_target(side, fit, self.request)
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
            "or the depth, or take more pinion teeth" + wider(request)
        )
        raise DesignError([Problem("pinion.method", given, expected, 'method = "tilt"')])
    return MilledDesign(
        request,
        blank,
        wheel,
        fits,
        _spec(request, blank, wheel, fits),
        likely_undercut(request, blank),
    )


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
        dials = sheet_dials(wheel.settings, blank.wheel.pitch_apex_beyond_crossing_point)
        return FlankSpec(request.wheel_method, "basic", dials, blade, _AT_WHEEL)

    def pinion_flank(side: Side) -> FlankSpec:
        fit = fits[side]
        blade = BladeSpec(
            fit.point_radius, fit.blade_angle, edge, own_land if together else None, **_curve(fit)
        )
        dials = sheet_dials(fit.settings, blank.pinion.pitch_apex_beyond_crossing_point)
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
    """Edge radius of the pinion's blades, mm: its arc ends below where the wheel's tip comes by, if it can."""
    usual = min(EDGE * blank.mean_normal_module, 0.9 * wheel.edges[0].largest)
    for fit in fits.values():
        room = ROOM * (blank.clearance or 0.0) - max(0.0, float(fit.root_error.max()))
        usual = min(usual, room / (1.0 - sin(fit.blade_angle)))
        usual = min(
            usual, _arc(fit.least_edge, fit.blade_angle)
        )  # below all that the wheel touches
    return max(usual, SHARPEST * blank.mean_normal_module)


_AT_WHEEL = frozenset({"blade.angle"})
_AT_PINION = frozenset({"blade.angle", "blade.point_diameter"})
