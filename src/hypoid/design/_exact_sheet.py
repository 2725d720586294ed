"""An exact face-hobbed pair as a summary sheet: its heads are Tri-Ac heads with straight, unraked blades.

The exact system's cutter plane is the pitch plane, a Tri-Ac head's that of its tips: the sliding base
differs by the blades' reference height, all else is the paper's. The flanks are the same but for the
index of each member as a whole: the sheet does not say where the blades stand at the start.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi

from hypoid.blank import MemberBlank, PairBlank
from hypoid.cutter import FaceHobHead
from hypoid.geometry import DesignError, Problem
from hypoid.machine import MachineSettings

from ._blank import spec_blank
from ._designed_sheet import sheet_dials
from ._exact_face_hobbed import exact_head, exact_settings
from ._member_blanks import given_blank
from ._sheet_spec import FlankSpec, MemberSpec, StickBladeSpec, SummarySheetSpec
from ._spec import ExactFaceHobbedSpec


@dataclass(frozen=True)
class ExactDesign:
    """An exact face-hobbed pair as designed; the sheet alone makes its flanks."""

    request: ExactFaceHobbedSpec
    blank: PairBlank
    settings: tuple[MachineSettings, MachineSettings]  # of the paper, pinion and wheel
    spec: SummarySheetSpec

    @property
    def faults(self) -> tuple[str, ...]:
        """What keeps the design from what was asked, in words."""
        return tuple(fault.value for fault in self.blank.faults)


def design_exact(request: ExactFaceHobbedSpec) -> ExactDesign:
    """Blank, heads and settings of an exact face-hobbed pair, as a complete sheet.

    Raises
    ------
    DesignError
        Where no such pair exists, or a sheet cannot hold what the request sets itself.
    """
    beside = {
        "cutting.tip_relief": request.tip_relief is not None,
        "cutting.eccentricity": bool(request.eccentricity),
        "pinion.settings": bool(request.setting_changes),
    }
    problems = [
        Problem(path, "a value", "nothing: a sheet of Tri-Ac heads cannot hold it", f"# {path}")
        for path, there in beside.items()
        if there
    ]
    if problems:
        raise DesignError(problems)
    blank = spec_blank(request)
    settings = exact_settings(blank, request.cutter_radius)
    spec = SummarySheetSpec(
        title=request.title,
        source=request.source,
        assumed=request.assumed,
        shaft_angle=blank.shaft_angle,
        offset=blank.offset,
        pinion=_member(request, blank, blank.pinion, settings[0]),
        wheel=_member(request, blank, blank.wheel, settings[1]),
        marking_thickness=request.marking_thickness,
    )
    return ExactDesign(request, blank, (settings[0], settings[1]), spec)


def _member(
    request: ExactFaceHobbedSpec, blank: PairBlank, own: MemberBlank, exact: MachineSettings
) -> MemberSpec:
    head: FaceHobHead = exact_head(request, blank, own)
    height = head.outer.reference_height
    settings = replace(exact, sliding_base=exact.sliding_base - height)
    dials = sheet_dials(settings, own.pitch_apex_beyond_crossing_point)
    blade = StickBladeSpec(
        radius=head.radius,
        angle=head.outer.pressure_angle,
        edge_radius=head.outer.edge_radius,
        reference_height=height,
        eccentric_angle=head.slope_angle,
    )
    flank = FlankSpec("generated", "basic", dials, blade)
    return MemberSpec(
        own.teeth,
        own.hand,
        given_blank(own),
        flank,
        flank,
        blade_groups=head.blade_groups,
        spacing=pi / head.blade_groups,
    )
