"""From a face-hobbed request to a complete spec: blank, wheel, and the pinion of one setting-up."""

from __future__ import annotations

from dataclasses import dataclass
from math import sin
from typing import Any

from hypoid.blank import PairBlank, UndercutLimit, iso_blank
from hypoid.flank import SIDES, Side
from hypoid.geometry import DesignError, Problem

from ._design_faults import blank_faults, likely_undercut, short_of_target, wider
from ._designed_sheet import SHEET_METHODS, sheet_dials
from ._hobbed_fit import HobbedFit, fit_hobbed
from ._hobbed_request import HobbedRequest
from ._hobbed_wheel import HobbedWheel, hobbed_wheel
from ._member_blanks import given_blank
from ._milled_wheel import EDGE, ROOM, SHARPEST
from ._sheet_spec import FlankSpec, MemberSpec, StickBladeSpec, SummarySheetSpec
from ._target import Target

_AT_FLANK = frozenset({"blade.angle", "blade.blade_radius"})


@dataclass(frozen=True)
class HobbedDesign:
    """A face-hobbed pair as designed; the spec alone makes its flanks."""

    request: HobbedRequest
    blank: PairBlank
    wheel: HobbedWheel
    fit: HobbedFit
    spec: SummarySheetSpec
    undercut: tuple[UndercutLimit, ...]

    @property
    def faults(self) -> tuple[str, ...]:
        """What keeps the design from what was asked, in words."""
        found = blank_faults(self.blank, self.undercut)
        found += [self._short(side) for side in SIDES if self._misses(side)]
        return tuple(found)

    def _misses(self, side: Side) -> bool:
        return self.fit.sides[side].largest > self.request.tolerance

    def _short(self, side: Side) -> str:
        """A flank that does not reach its target: how near it came, and what would help."""
        words = short_of_target(side, self.fit.sides[side], self.request)
        words += ", both flanks cut in one setting-up"
        if self.fit.held:
            words += f"; {', '.join(self.fit.held)}"
        helpful = [
            f"{name} (rms {1e3 * rms:.1f} um)"
            for name, rms in self.fit.helpful
            if rms < 0.8 * self.fit.rms
        ]
        if not helpful:
            return words + "."
        return f"{words}; free as well, these would help both: {', '.join(helpful)}."


def design_hobbed(request: HobbedRequest) -> HobbedDesign:
    """Blank, heads and settings of a face-hobbed pair on Tri-Ac heads.

    Raises
    ------
    DesignError
        With every number that makes no sense, or the limit that leaves no pair.
    """
    if problems := request.problems():
        raise DesignError(problems)
    blank = iso_blank(request.blank)
    wheel = hobbed_wheel(request, blank)
    targets: dict[Side, Target] = {"concave": request.drive, "convex": request.coast}
    fit = fit_hobbed(request, blank, wheel, targets)
    if fit is None:
        given = f'"{request.pinion_method}"'
        expected = (
            "a pinion that the wheel can generate over its face, both flanks in one setting-up: lower the "
            "offset, the spiral angle or the depth, or take more pinion teeth" + wider(request)
        )
        raise DesignError([Problem("pinion.method", given, expected, 'method = "tilt"')])
    spec = _spec(request, blank, wheel, fit)
    return HobbedDesign(request, blank, wheel, fit, spec, likely_undercut(request, blank))


def _spec(
    request: HobbedRequest, blank: PairBlank, wheel: HobbedWheel, fit: HobbedFit
) -> SummarySheetSpec:
    """The complete file of what was found."""
    edge = request.pinion_edge_radius
    if edge is None:
        edge = _pinion_edge(blank, wheel, fit)
    return SummarySheetSpec(
        title=request.title,
        source=request.source,
        assumed=request.assumed,
        shaft_angle=blank.shaft_angle,
        offset=blank.offset,
        pinion=_pinion(request, blank, wheel, fit, edge),
        wheel=_wheel(request, blank, wheel),
        marking_thickness=request.marking_thickness,
    )


def _wheel(request: HobbedRequest, blank: PairBlank, wheel: HobbedWheel) -> MemberSpec:
    cut, plan = wheel.cut, wheel.plan
    bend = 1.0 / plan.curvature if plan.curvature else 0.0
    dials = sheet_dials(cut.settings, blank.wheel.pitch_apex_beyond_crossing_point)

    def flank(i: int) -> FlankSpec:
        blade = _stick(request, plan.eccentric_angle, cut.radii[i], cut.angles[i])
        blade = StickBladeSpec(
            **blade, edge_radius=wheel.edge_radius, reference_height=cut.height, curve_radius=bend
        )
        return FlankSpec(request.wheel_method, "basic", dials, blade, _AT_FLANK)

    own = blank.wheel
    given = given_blank(own, wheel.deeper)
    return MemberSpec(
        own.teeth,
        own.hand,
        given,
        flank(0),
        flank(1),
        blade_groups=plan.groups,
        spacing=plan.spacing,
    )


def _pinion(
    request: HobbedRequest, blank: PairBlank, wheel: HobbedWheel, fit: HobbedFit, edge: float
) -> MemberSpec:
    plan, own, toprem = wheel.plan, blank.pinion, request.grind.pinion_toprem
    dials = sheet_dials(fit.settings, own.pitch_apex_beyond_crossing_point)
    method = SHEET_METHODS[request.pinion_method]

    def flank(i: int) -> FlankSpec:
        bend = fit.curvatures[i]
        blade = _stick(request, plan.eccentric_angle, fit.radii[i], fit.angles[i])
        blade = StickBladeSpec(
            **blade,
            edge_radius=edge,
            reference_height=fit.height,
            curve_radius=1.0 / bend if bend else 0.0,
            toprem=toprem and (*toprem, "along-flank"),
        )
        more = (
            {"blade.profile", "blade.radius"} if request.grind.pinion_curve_radius is None else ()
        )
        return FlankSpec(method, "basic", dials, blade, _AT_FLANK | frozenset(more))

    return MemberSpec(
        own.teeth,
        own.hand,
        given_blank(own),
        flank(0),
        flank(1),
        blade_groups=plan.groups,
        spacing=plan.spacing if fit.spacing is None else fit.spacing,
    )


def _stick(request: HobbedRequest, eccentric: float, radius: float, angle: float) -> dict[str, Any]:
    grind = request.grind
    return {
        "radius": radius,
        "angle": angle,
        "eccentric_angle": eccentric,
        "hook_angle": grind.hook_angle,
        "side_rake_angle": grind.side_rake_angle,
    }


def _pinion_edge(blank: PairBlank, wheel: HobbedWheel, fit: HobbedFit) -> float:
    """Edge radius of the pinion's blades, mm: its arc ends below where the wheel's tip comes by, if it can."""
    usual = min(EDGE * blank.mean_normal_module, 0.9 * wheel.edges[0].largest)
    for side, angle in zip(SIDES, fit.angles, strict=True):
        high = max(0.0, float(fit.sides[side].root_error.max()))
        usual = min(usual, (ROOM * (blank.clearance or 0.0) - high) / (1.0 - sin(angle)))
    return max(usual, SHARPEST * blank.mean_normal_module)
