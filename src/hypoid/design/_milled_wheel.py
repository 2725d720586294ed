"""The wheel of a face-milled design: cutter, settings and flanks from the blank."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hypoid.blank import (
    EdgeRadii,
    PairBlank,
    SlotGeometry,
    crown_gear_tooth,
    edge_radii,
    slot_geometry,
)
from hypoid.cutter import FaceMillHead
from hypoid.flank import Border, Flank, PitchCone, Side, best_way, cut_flank, flank_angles
from hypoid.geometry import DesignError, Problem
from hypoid.machine import MachineSettings

from ._form_cut import form_cut
from ._milled_pair import form_turn
from ._milled_request import MilledRequest
from ._wheel_settings import WheelCut, wheel_cut

EDGE = 0.3  # of the mean normal module: the edge radius that practice does not pass
ROOM = 0.7  # of the clearance, that an edge arc may take
LEAST_EDGE = 0.15  # of the mean normal module: rather than a sharper edge a form cutter cuts deeper
SHARPEST = 0.05  # of the mean normal module: no blade has a sharper point, whatever it cuts away
LEAST_POINT = 0.15  # of the mean normal module: a blade's point must stand
LAND = 0.98  # of it, that both arcs take
CORRECTIONS = 2
SPARE = 1.6  # times both members' addenda: a blade surely longer than the tooth is deep


@dataclass(frozen=True)
class MilledWheel:
    """What cuts the wheel, and what it cuts."""

    cut: WheelCut
    settings: MachineSettings
    slots: SlotGeometry
    edges: tuple[EdgeRadii, EdgeRadii]  # largest, pinion and wheel
    edge_radius: float
    height: float  # of the blades, mm
    concave: Flank
    convex: Flank

    def flank(self, side: Side) -> Flank:
        return self.concave if side == "concave" else self.convex


def pitch_cone(blank: PairBlank, member: str) -> PitchCone:
    """The pitch cone of a member, as flanks take it."""
    own = blank.pinion if member == "pinion" else blank.wheel
    return PitchCone(
        own.pitch_apex_beyond_crossing_point, math.sin(own.pitch_angle), math.cos(own.pitch_angle)
    )


def milled_wheel(request: MilledRequest, blank: PairBlank) -> MilledWheel:
    """The wheel of a request on its blank.

    Raises
    ------
    DesignError
        Where the slot leaves no room for a blade.
    """
    generated = request.wheel_method == "generated"
    own, radius = blank.wheel, request.blank.cutter_radius
    angles, thickness = blank.pressure_angles, own.thickness
    assert angles is not None
    assert thickness is not None
    by_side = angles.coast, angles.drive  # concave, convex
    tooth = crown_gear_tooth(blank.cones, radius, 0)
    slots = slot_geometry(blank, tooth, wheel_generated=generated)
    edges = edge_radii(slots)
    edge = min(EDGE * blank.mean_normal_module, 0.9 * edges[1].largest)
    arc = 1.0 - math.sin(min(by_side))  # height of an edge arc over its radius
    lift = 0.0 if generated else max(slots.lift(crown) for crown in slots.ends[1])
    room = ROOM * (blank.clearance or 0.0)
    deeper = min(max(lift + LEAST_EDGE * blank.mean_normal_module * arc - room, 0.0), lift)
    edge = max(min(edge, (room - lift + deeper) / arc), 0.0)
    asked_edge = request.wheel_edge_radius
    height = SPARE * (blank.pinion.outer_addendum + own.outer_addendum)

    def cut_for(asked: tuple[float, float], spiral: float) -> WheelCut:
        if not generated:
            return form_cut(
                own,
                cutter_radius=radius,
                tooth_thickness=thickness.mean_normal,
                pressure_angles=by_side,
                deeper=deeper,
            )
        slot = math.pi * blank.mean_normal_module - thickness.mean_normal
        return wheel_cut(
            own,
            cutter_radius=radius,
            slot_width=slot,
            pressure_angles=asked,
            generated=True,
            spiral_angle=spiral,
        )

    asked, spiral = by_side, own.mean_spiral_angle
    cut = cut_for(asked, spiral)
    _check_point(blank, cut)
    edge = _on_land(edge, cut) if asked_edge is None else asked_edge
    settings, flanks = _flanks(blank, cut, height, edge, generated)
    for _ in range(
        CORRECTIONS if generated else 0
    ):  # what the roll about the root plane's normal turns
        seen = [flank_angles(flank, own.mean_cone_distance) for flank in flanks]
        if not math.isfinite(sum(at.pressure + at.spiral for at in seen)):
            break
        off = [w - at.pressure for w, at in zip(by_side, seen, strict=True)]
        asked = asked[0] + off[0], asked[1] + off[1]
        spiral += own.mean_spiral_angle - 0.5 * sum(at.spiral for at in seen)
        cut = cut_for(asked, spiral)
        _check_point(blank, cut)
        edge = _on_land(edge, cut) if asked_edge is None else asked_edge
        settings, flanks = _flanks(blank, cut, height, edge, generated)
    concave, convex = flanks
    if not all(math.isfinite(flank.active_chart.error) for flank in flanks):
        beta = math.degrees(own.mean_spiral_angle)
        given = f'"{request.wheel_method}" at a spiral angle of {beta:.3g} deg'
        expected = (
            "a wheel whose flanks undercut leaves standing from toe to heel: form cut it, or lower the depth or "
            "the taper"
        )
        raise DesignError([Problem("wheel.method", given, expected, 'method = "formate"')])
    return MilledWheel(cut, settings, slots, edges, edge, height, concave, convex)


def _check_point(blank: PairBlank, cut: WheelCut) -> None:
    """DesignError where the slot leaves no blade point."""
    least = LEAST_POINT * blank.mean_normal_module
    if cut.point_width > least:
        return
    expected = (
        f"a slot that is wider at its root: its point width is {cut.point_width:.3g} mm, at least "
        f"{least:.3g} mm is wanted; lower the depth or the pressure angle"
    )
    given = f"{blank.depths.whole_depth if blank.depths else 0.0:.4g} mm"
    raise DesignError([Problem("blank.depth_factor", given, expected, "depth_factor = 1.8")])


def _on_land(edge: float, cut: WheelCut) -> float:
    """An edge radius, mm, held to what half the point width has room for on either blade."""
    rooms = (math.cos(a) / (1.0 - math.sin(a)) for a in cut.blade_angles)
    return min(edge, LAND * 0.5 * cut.point_width * min(rooms))


def _flanks(
    blank: PairBlank, cut: WheelCut, height: float, edge: float, generated: bool
) -> tuple[MachineSettings, tuple[Flank, Flank]]:
    """Settings of a cut, and its flanks, concave and convex."""
    own = blank.wheel
    settings = MachineSettings(
        radial_distance=cut.radial_distance,
        cradle_angle=cut.cradle_angle,
        machine_root_angle=cut.machine_root_angle,
        ratio_of_roll=cut.ratio_of_roll,
        roll_to_blade_ratio=0.0,
        machine_center_to_back=cut.machine_center_to_back,
        sliding_base=cut.sliding_base,
        generated=generated,
    )
    head = FaceMillHead.spread_blade(
        sum(cut.point_radii), cut.point_width, *cut.blade_angles, height, edge_radius=edge
    )

    def flank(side: Side) -> Flank:
        pieces = head.pieces("outer" if side == "concave" else "inner")
        if not generated:  # theta = 0 where the blade passes the mean point
            turn = form_turn(settings, own)
            pieces = {name: piece.turned(turn) for name, piece in pieces.items()}
        slope = math.tan(own.addendum_angle)
        return cut_flank(
            "wheel",
            side,
            settings,
            pieces,
            pitch_cone(blank, "wheel"),
            mirrored=own.hand == "right",
            toe=own.inner_cone_distance,
            heel=own.outer_cone_distance,
            tip=Border(own.outer_addendum - slope * own.outer_cone_distance, slope),
            root=Border(-1.5 * height, 0.0),
            way=best_way(settings, revolution=True),
        )

    return settings, (flank("concave"), flank("convex"))
