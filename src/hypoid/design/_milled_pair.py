"""From a summary sheet to a pair: flanks as their cutters and settings make them.

The blank gives toe, heel and face cone. Root, fillet and active flank are where the cutter leaves
them; where the sheet does not give a root cone, it is the line along the lowest points of the cut.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from hypoid.blank import MemberBlank, with_root_line
from hypoid.cutter import FaceMillHead
from hypoid.flank import (
    SIDES,
    Border,
    Flank,
    PitchCone,
    Side,
    best_way,
    cut_flank,
    lowest_line,
    trimmed,
)
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
from hypoid.pair import Assumption, GearPair, Head, Member

from ._blank import sheet_blank
from ._sheet_faults import at_file, cut_faults
from ._sheet_heads import sheet_head
from ._sheet_spec import FlankSpec, MemberSpec, SummarySheetSpec
from ._stock import divided

T = TypeVar("T")
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

    def flank(self, side: Side) -> FlankSpec:
        return self.spec.concave if side == "concave" else self.spec.convex

    def machine(self, flank: FlankSpec) -> Any:
        """Constants of the physical machine that cuts a flank."""
        return constants_of(flank.machine, self.constants.get(flank.machine))


@dataclass(frozen=True)
class Cut:
    """What cuts one flank of a member."""

    job: Job
    side: Side
    settings: MachineSettings
    head: Head

    @property
    def spec(self) -> FlankSpec:
        return self.job.flank(self.side)

    @property
    def half_breadth(self) -> float | None:
        """Of the cam, mm, where there is one and it is known."""
        if self.settings.cam is None:
            return None
        return self.job.machine(self.spec).cams[self.spec.dials["cam_number"]].half_breadth


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
    ready: list[Cut] = []
    for job in jobs:
        for side in SIDES:
            settings = _tried(_settings, job, side, problems)
            head = _tried(_head, job, side, problems)
            if settings is not None and head is not None:
                ready.append(Cut(job, side, settings, head))
    _raise(problems)
    flanks = [_flank(cut) for cut in ready]
    for cut, flank in zip(ready, flanks, strict=True):
        problems += cut_faults(flank, cut.spec, cut.half_breadth)
    _raise(problems)
    pinion, wheel = (
        _member(job, ready[n : n + 2], flanks[n : n + 2])
        for job, n in zip(jobs, (0, 2), strict=True)
    )
    pinion, wheel = divided(spec, pinion, wheel, blank.mean_normal_module)
    return GearPair(
        title=spec.title,
        source=spec.source,
        assumed=tuple(Assumption(a.value, a.reason) for a in spec.assumed),
        blank=replace(blank, pinion=pinion.blank, wheel=wheel.blank),
        pinion=pinion,
        wheel=wheel,
        marking_thickness=spec.marking_thickness,
        machine_constants=spec.machine_constants,
    )


def _tried(
    make: Callable[[Job, Side], T], job: Job, side: Side, problems: list[Problem]
) -> T | None:
    """What is made of a flank's sheet; its problems are added to those so far if it cannot be."""
    try:
        return make(job, side)
    except DesignError as error:
        problems += (at_file(p, job.name, job.spec) for p in error.problems)
        return None


def _raise(problems: list[Problem]) -> None:
    """DesignError with all problems, if there are any; what both flanks share is told once."""
    if problems:
        raise DesignError(dict.fromkeys(problems))


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
    flank = job.flank(side)
    path = f"{job.name}.{side}.settings"
    if flank.machine == "basic":
        apex = job.blank.pitch_apex_beyond_crossing_point
        dials = dict(flank.dials)
        motions = Motions(**dials.pop("motions", {}))
        ratio = (job.spec.blade_groups or 0) / job.spec.teeth
        sheet = SummarySheet(roll_to_blade_ratio=ratio, motions=motions, **dials)
        settings = from_sheet(sheet, apex)
    else:
        machine = MACHINES[flank.machine]
        work = Workpiece(job.spec.teeth, job.spec.hand, job.machine(flank), path)
        dials = machine.dials(**flank.dials)
        machine.check(dials, path)
        settings = machine.to_basic(dials, work)
    formed = flank.method in ("formate", "helixform")
    return replace(settings, generated=settings.generated and not formed)


def _head(job: Job, side: Side) -> Head:
    """The head of a flank: one blade, or both where one cutter cuts both sides."""
    return sheet_head(job.name, job.spec, side, job.reach)


def _member(job: Job, cuts: list[Cut], flanks: list[Flank]) -> Member:
    """A member of both its flanks, concave first; each flank's root is its own lowest line."""
    concave, convex = (replace(trimmed(flank), root=lowest_line(flank)) for flank in flanks)
    blank = job.blank
    if math.isnan(blank.mean_dedendum):
        roots = concave.root, convex.root
        mean = -float(np.mean([root.at(blank.mean_cone_distance) for root in roots]))
        slope = float(np.mean([root.slope for root in roots]))
        blank = with_root_line(blank, mean, blank.pitch_angle + math.atan(slope))
    outside, inside = (cut.head for cut in cuts)
    heads: dict[Side, Head] = {"concave": outside}
    heads["convex"] = outside if inside == outside else inside
    return Member(blank, heads, concave, convex)


def _flank(cut: Cut) -> Flank:
    job, settings = cut.job, cut.settings
    pieces = cut.head.pieces("outer" if cut.side == "concave" else "inner")
    milled = isinstance(cut.head, FaceMillHead)
    if milled and not settings.generated:  # theta = 0 where the blade passes the mean point
        turn = form_turn(settings, job.blank)
        pieces = {name: piece.turned(turn) for name, piece in pieces.items()}
    return cut_flank(
        job.name,
        cut.side,
        settings,
        pieces,
        job.cone,
        mirrored=job.spec.hand == "right",
        toe=job.blank.inner_cone_distance,
        heel=job.blank.outer_cone_distance,
        tip=job.tip,
        root=Border(-1.5 * job.reach, 0.0),
        way=best_way(settings, revolution=milled),
    )


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
