"""The wheel of a face-hobbed design on Tri-Ac heads: head, settings and flanks from the blank."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from hypoid.blank import (
    EdgeRadii,
    MemberBlank,
    PairBlank,
    SlotGeometry,
    crown_gear_tooth,
    edge_radii,
    slot_geometry,
)
from hypoid.cutter import BladeName, TriAcBlade, TriAcHead
from hypoid.flank import SIDES, Border, Flank, PitchCone, Side, best_way, cut_flank
from hypoid.geometry import DesignError, Problem
from hypoid.machine import MachineSettings

from ._hobbed_cut import HeadPlan, HobbedCut, hobbed_cut
from ._hobbed_request import HobbedRequest
from ._milled_pair import SPARE
from ._milled_wheel import EDGE, LEAST_EDGE, LEAST_POINT, ROOM, pitch_cone


@dataclass(frozen=True)
class HobbedWheel:
    """What cuts the wheel, and what it cuts."""

    cut: HobbedCut
    plan: HeadPlan
    slots: SlotGeometry
    edges: tuple[EdgeRadii, EdgeRadii]  # largest, pinion and wheel
    edge_radius: float
    deeper: float  # of the tips below the blank's root cone, mm
    head: TriAcHead
    flanks: Mapping[Side, Flank]

    def flank(self, side: Side) -> Flank:
        return self.flanks[side]


def head_plan(request: HobbedRequest, blank: PairBlank, curve_radius: float) -> HeadPlan:
    """The head of a member before its blades are ground."""
    radius, groups = request.blank.cutter_radius, request.blank.blade_groups
    return HeadPlan(
        radius,
        groups,
        request.grind.hook_angle,
        request.grind.side_rake_angle,
        request.grind.eccentric(blank.mean_normal_module, groups, radius),
        1.0 / curve_radius if curve_radius else 0.0,
    )


def reach_of(blank: PairBlank) -> float:
    """Blade beyond the pitch point that serves in any case, mm."""
    return SPARE * (blank.pinion.outer_addendum + blank.wheel.outer_addendum)


def planned_head(
    plan: HeadPlan, cut: HobbedCut, edge_radius: float, reach: float, spacing: float | None = None
) -> TriAcHead:
    """The head of a cut."""

    def blade(name: BladeName, i: int) -> TriAcBlade:
        return TriAcBlade(
            name,
            radius=cut.radii[i],
            blade_angle=cut.angles[i],
            height=cut.height,
            edge_radius=edge_radius,
            shank_height=reach,
            eccentric_angle=plan.eccentric_angle,
            hook_angle=plan.hook_angle,
            rake_angle=plan.rake_angle,
            curve_radius=1.0 / plan.curvature if plan.curvature else 0.0,
        )

    return TriAcHead(plan.groups, blade("outer", 0), blade("inner", 1), spacing)


def hobbed_flanks(
    blank: MemberBlank,
    cone: PitchCone,
    settings: MachineSettings,
    head: TriAcHead,
    reach: float,
    *,
    starts: tuple[float, float] | None = None,
) -> dict[Side, Flank]:
    """Both flanks that a head cuts on a member; ``starts`` are turns that put the mean point in place."""
    slope = math.tan(blank.addendum_angle)
    made: dict[Side, Flank] = {}
    for i, side in enumerate(SIDES):
        made[side] = cut_flank(
            blank.name,
            side,
            settings,
            head.pieces("outer" if side == "concave" else "inner"),
            cone,
            mirrored=blank.hand == "right",
            toe=blank.inner_cone_distance,
            heel=blank.outer_cone_distance,
            tip=Border(blank.outer_addendum - slope * blank.outer_cone_distance, slope),
            root=Border(-1.5 * reach, 0.0),
            way=best_way(settings, revolution=False),
            theta_start=None if starts is None else starts[i],
        )
    return made


def hobbed_wheel(request: HobbedRequest, blank: PairBlank) -> HobbedWheel:
    """The wheel of a request on its blank.

    Raises
    ------
    DesignError
        Where the slot leaves no room for the blades, or no such flanks are cut.
    """
    own, generated = blank.wheel, request.wheel_method == "generated"
    angles, thickness = blank.pressure_angles, own.thickness
    assert angles is not None
    assert thickness is not None
    by_side = angles.coast, angles.drive  # concave, convex
    plan = head_plan(request, blank, request.grind.wheel_curve_radius)
    tooth = crown_gear_tooth(blank.cones, plan.radius, plan.groups)
    slots = slot_geometry(blank, tooth, wheel_generated=generated, rotation_factor=1.0)
    edges = edge_radii(slots)
    module = blank.mean_normal_module
    edge = min(EDGE * module, 0.9 * edges[1].largest)
    arc = 1.0 - math.sin(min(by_side))  # height of an edge arc over its radius
    lift = 0.0 if generated else max(max(slots.lift(crown) for crown in slots.ends[1]), 0.0)
    room = ROOM * (blank.clearance or 0.0)
    deeper = min(max(lift + LEAST_EDGE * module * arc - room, 0.0), lift)
    edge = max(min(edge, (room - lift + deeper) / arc), 0.0)
    if request.wheel_edge_radius is not None:
        edge = request.wheel_edge_radius
    cut = hobbed_cut(
        own,
        plan,
        tooth_thickness=thickness.mean_normal,
        pressure_angles=by_side,
        generated=generated,
        deeper=deeper,
    )
    if cut is None or not cut.miss < 1e-6:
        raise DesignError([_no_wheel(request)])
    reach = reach_of(blank)
    head = planned_head(plan, cut, 0.0, reach)
    least = LEAST_POINT * module
    if not head.tip_slot > least:
        given = f"{blank.depths.whole_depth if blank.depths else 0.0:.4g} mm of whole depth"
        expected = (
            f"a slot that is wider at its root: {head.tip_slot:.3g} mm between the blades' edges, at "
            f"least {least:.3g} mm is wanted; lower the depth or the pressure angle"
        )
        raise DesignError([Problem("blank.depth_factor", given, expected, "depth_factor = 1.8")])
    if request.wheel_edge_radius is None:  # both edges fit the slot
        lean = math.tan(math.pi / 4 - 0.5 * min(by_side))
        edge = min(edge, 0.45 * head.tip_slot / lean)
    head = replace(
        head,
        outer=replace(head.outer, edge_radius=edge),
        inner=replace(head.inner, edge_radius=edge),
    ).checked("wheel")
    flanks = hobbed_flanks(
        own, pitch_cone(blank, "wheel"), cut.settings, head, reach, starts=cut.turns
    )
    if not all(math.isfinite(flank.active_chart.error) for flank in flanks.values()):
        raise DesignError([_no_wheel(request)])
    return HobbedWheel(cut, plan, slots, edges, edge, deeper, head, flanks)


def _no_wheel(request: HobbedRequest) -> Problem:
    given = f'"{request.wheel_method}" with a cutter of {request.blank.cutter_radius:g} mm'
    expected = (
        "a wheel whose flanks are cut whole between toe and heel: another cutter radius or number of "
        "blade groups, a lower depth, or form cut"
    )
    return Problem("wheel.method", given, expected, 'method = "formate"')
