"""From a summary sheet to a pair: face-milled flanks as their cutters and settings make them.

The blank gives toe, heel and face cone. Root, fillet and active flank are where the cutter leaves
them; where the sheet does not give a root cone, it is the line along the lowest points of the cut.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.blank import MemberBlank, with_root_line
from hypoid.cutter import (
    BladeCurve,
    CircularProfile,
    FaceMillHead,
    Flankrem,
    MillBlade,
    ParabolicProfile,
    Toprem,
)
from hypoid.flank import Border, Flank, PitchCone, Side, best_way, cut_flank, lowest_line, trimmed
from hypoid.geometry import DesignError, Problem
from hypoid.machine import (
    MACHINES,
    MachineSettings,
    Motions,
    SummarySheet,
    Workpiece,
    constants_of,
    from_sheet,
)
from hypoid.pair import Assumption, GearPair, Member

from ._blank import sheet_blank
from ._sheet_spec import BladeSpec, FlankSpec, MemberSpec, SummarySheetSpec

SIDES: tuple[Side, Side] = ("concave", "convex")
SPARE = 1.6  # times both members' addenda: a blade surely longer than the tooth is deep


@dataclass(frozen=True)
class Job:
    """One member to be cut: what was asked, its blank and its pitch cone."""

    spec: MemberSpec
    blank: MemberBlank
    cone: PitchCone
    tip: Border
    reach: float  # mm of blade height that serves in any case
    constants: Any

    @property
    def name(self) -> str:
        return self.blank.name


def build_milled(spec: SummarySheetSpec) -> GearPair:
    """The pair of a summary sheet.

    Raises
    ------
    DesignError
        With every dial, blade and blank that cannot be.
    """
    blank = sheet_blank(spec)
    reach = SPARE * (blank.pinion.outer_addendum + blank.wheel.outer_addendum)
    jobs = [
        _job(member, own, reach, spec.machine_constants)
        for member, own in ((spec.pinion, blank.pinion), (spec.wheel, blank.wheel))
    ]
    problems: list[Problem] = []
    ready: list[dict[Side, tuple[MachineSettings, FaceMillHead]]] = []
    for job in jobs:
        cuts: dict[Side, tuple[MachineSettings, FaceMillHead]] = {}
        for side in SIDES:
            try:
                cuts[side] = (_settings(job, side), _head(job, side))
            except DesignError as error:
                problems += [p for p in error.problems if p not in problems]
        ready.append(cuts)
    if problems:
        raise DesignError(problems)
    pinion, wheel = (_member(job, cuts) for job, cuts in zip(jobs, ready, strict=True))
    return GearPair(
        title=spec.title,
        source=spec.source,
        assumed=tuple(Assumption(a.value, a.reason) for a in spec.assumed),
        blank=replace(blank, pinion=pinion.blank, wheel=wheel.blank),
        pinion=pinion,
        wheel=wheel,
        marking_thickness=spec.marking_thickness,
    )


def _job(spec: MemberSpec, blank: MemberBlank, reach: float, constants: Any) -> Job:
    cone = PitchCone(
        blank.pitch_apex_beyond_crossing_point,
        math.sin(blank.pitch_angle),
        math.cos(blank.pitch_angle),
    )
    slope = math.tan(blank.face_angle - blank.pitch_angle)
    tip = Border(blank.outer_addendum - slope * blank.outer_cone_distance, slope)
    return Job(spec, blank, cone, tip, reach, constants)


def _settings(job: Job, side: Side) -> MachineSettings:
    """Basic settings of a flank, in the chain's signs."""
    flank: FlankSpec = getattr(job.spec, side)
    path = f"{job.name}.{side}.settings"
    if flank.machine == "basic":
        apex = job.blank.pitch_apex_beyond_crossing_point
        dials = dict(flank.dials)
        motions = Motions(**dials.pop("motions", {}))
        sheet = SummarySheet(roll_to_blade_ratio=0.0, motions=motions, **dials)
        settings = from_sheet(sheet, apex)
    else:
        machine = MACHINES[flank.machine]
        constants = constants_of(flank.machine, job.constants.get(flank.machine))
        work = Workpiece(job.spec.teeth, job.spec.hand, constants, path)
        dials = machine.dials(**flank.dials)
        machine.check(dials, path)
        settings = machine.to_basic(dials, work)
    formed = flank.method in ("formate", "helixform")
    return replace(settings, generated=settings.generated and not formed)


def _curve(blade: BladeSpec) -> BladeCurve | None:
    if blade.curve == "circular-arc":
        return CircularProfile(blade.curve_radius, blade.reference_height)
    if blade.curve == "parabola":
        return ParabolicProfile(blade.curve_coefficient, blade.reference_height)
    return None


def _head(job: Job, side: Side) -> FaceMillHead:
    """The head of a flank: one blade, or both where one cutter cuts both sides."""
    blades: dict[Side, MillBlade] = {}
    for of in SIDES:
        blade: BladeSpec = getattr(job.spec, of).blade
        blades[of] = MillBlade(
            name="outer" if of == "concave" else "inner",
            point_radius=blade.point_radius,
            angle=blade.angle,
            edge_radius=blade.edge_radius,
            land=blade.land if blade.land is not None else blade.edge_radius,
            height=blade.height or job.reach,
            profile=_curve(blade),
            toprem=None if blade.toprem is None else Toprem(*blade.toprem),
            flankrem=None if blade.flankrem is None else Flankrem(*blade.flankrem),
        )
    both = getattr(job.spec, side).blade.land is not None
    head = FaceMillHead(
        outer=blades["concave"] if both or side == "concave" else None,
        inner=blades["convex"] if both or side == "convex" else None,
    )
    return head.checked(
        f"{job.name}.cutter", (f"{job.name}.concave.blade", f"{job.name}.convex.blade")
    )


def _member(job: Job, cuts: dict[Side, tuple[MachineSettings, FaceMillHead]]) -> Member:
    flanks = {side: _flank(job, side, *cuts[side]) for side in SIDES}
    blank = job.blank
    if math.isnan(blank.mean_dedendum):
        lines = [flanks[side].root for side in SIDES]
        mean = -float(np.mean([line.at(blank.mean_cone_distance) for line in lines]))
        slope = float(np.mean([line.slope for line in lines]))
        blank = with_root_line(blank, mean, blank.pitch_angle + math.atan(slope))
    heads: dict[Side, FaceMillHead] = {side: cuts[side][1] for side in SIDES}
    if heads["convex"] == heads["concave"]:
        heads["convex"] = heads["concave"]
    return Member(blank, heads, flanks["concave"], flanks["convex"])


def _flank(job: Job, side: Side, settings: MachineSettings, head: FaceMillHead) -> Flank:
    pieces = head.pieces("outer" if side == "concave" else "inner")
    if not settings.generated:  # theta = 0 where the blade passes the mean point
        turn = form_turn(settings, job.blank)
        pieces = {name: piece.turned(turn) for name, piece in pieces.items()}
    blank = job.blank
    flank = cut_flank(
        job.name,
        side,
        settings,
        pieces,
        job.cone,
        mirrored=job.spec.hand == "right",
        toe=blank.inner_cone_distance,
        heel=blank.outer_cone_distance,
        tip=job.tip,
        root=Border(-1.5 * job.reach, 0.0),
        way=best_way(settings, revolution=True),
    )
    return replace(trimmed(flank), root=lowest_line(flank))


def form_turn(settings: MachineSettings, blank: MemberBlank) -> float:
    """Angle in the head, rad, of the blade that passes the mean point of a form-cut member."""
    z, rho = blank.position(blank.mean_cone_distance, 0.0)
    sine, cosine = (
        math.sin(settings.machine_root_angle),
        math.cos(settings.machine_root_angle),
    )
    along = sine * rho + cosine * (z + settings.machine_center_to_back)
    q, radial = settings.cradle_angle, settings.radial_distance
    place = math.atan2(radial * math.sin(q) - settings.blank_offset, along - radial * math.cos(q))
    return place - (math.pi / 2 - q + settings.swivel_angle)
