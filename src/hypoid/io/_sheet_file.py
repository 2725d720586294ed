"""The design file of a summary sheet: blank, cutter and machine settings of both members.

A key at a flank goes before the same key at its member. What ties several keys together stands in
`_sheet_rules.py`, `_sheet_cutter_rules.py` and `_sheet_settings.py`.
"""

from __future__ import annotations

from typing import Literal

from ._keys import (
    DEG,
    EPS,
    LARGEST,
    MOST_TEETH,
    Angle,
    BodyTable,
    DesignTable,
    Length,
    Pair,
    SupportTable,
    Table,
    any_length,
    key,
)
from ._sheet_cutter import BladeTable, CutterTable
from ._sheet_dials import SheetSettings


class GivenBlankTable(Table):
    """[pinion.blank]: the numbers of a drawing; the heel by cone distance and addendum, or by crown."""

    pitch_angle: Angle = key(
        "an angle between 0 and 90 deg", "22 deg 4 min", gt=EPS, lt=90 * DEG - EPS
    )
    face_width: Length = key("a length above 0", "25 mm", gt=0, le=LARGEST)
    mean_spiral_angle: Angle = key(
        "an angle from 0 to below 80 deg", "35 deg", ge=0, lt=80 * DEG - EPS
    )
    face_angle: Angle = key("an angle between 0 and 120 deg", "23 deg 45 min", gt=0, lt=120 * DEG)
    outer_cone_distance: Length | None = key(
        "a length above 0", "155.55 mm", default=None, gt=0, le=LARGEST
    )
    outer_addendum: Length | None = key(
        "a length of 0 or more", "9.9 mm", default=None, ge=0, le=LARGEST
    )
    outside_diameter: Length | None = key(
        "a length above 0", "128.725 mm", default=None, gt=0, le=LARGEST
    )
    pitch_apex_to_crown: Length | None = any_length("148.381 mm")
    outer_dedendum: Length | None = key(
        "a length of 0 or more", "11.45 mm", default=None, ge=0, le=LARGEST
    )
    root_angle: Angle | None = key(
        "an angle between -30 and 90 deg", "76 deg 26 min", default=None, gt=-30 * DEG, lt=90 * DEG
    )
    outer_face_width: Length | None = key(
        "a length above 0, from the mean point to the heel, where that is not half the face width",
        "13 mm", default=None, gt=0, le=LARGEST,
    )  # fmt: skip


class SheetFlank(Table):
    """One flank of a member."""

    settings: SheetSettings = key(
        "a table", {"cradle_angle": "67 deg 3 min"}, default=SheetSettings()
    )
    blade: BladeTable = key("a table", {"angle": "20 deg"}, default=BladeTable())


class SheetMember(Table):
    """[pinion], [wheel]."""

    teeth: int = key("a whole number from 1 to 1000", 27, ge=1, le=MOST_TEETH)
    hand: Literal["left", "right"] = key('"left" or "right"', "left")
    blank: GivenBlankTable = key("a table", {"pitch_angle": "22 deg 4 min", "face_width": "25 mm"})
    cutter: CutterTable = key(
        'a table: type = "face-mill", with diameter and point_width if one cutter has both blades',
        {"type": "face-mill", "diameter": "9 in", "point_width": "0.1 in"},
    )
    settings: SheetSettings = key("a table", {"method": "generated"}, default=SheetSettings())
    blade: BladeTable = key("a table", {"edge_radius": "1 mm"}, default=BladeTable())
    concave: SheetFlank = key("a table", {}, default=SheetFlank())
    convex: SheetFlank = key("a table", {}, default=SheetFlank())
    body: BodyTable = key("a table", {"bore_diameter": "40 mm"}, default=BodyTable())
    support: SupportTable = key("a table", {"held": "bore"}, default=SupportTable())


class SheetPair(Pair):
    """[pair]."""

    offset: Length = key("a length of 0 or more", "20 mm", ge=0, le=LARGEST)
    normal_backlash: Length | None = key(
        "a length of 0 or more, at the mean point, where flanks are cut one by one",
        "0.15 mm",
        default=None,
        ge=0,
        le=LARGEST,
    )


class CamTable(Table):
    """One generating cam of a No. 463."""

    pitch_radius: Length = key("a length above 0", "70.302 mm", gt=0, le=LARGEST)
    nominal_setting: Length = key("a length", "101.6 mm", ge=-LARGEST, le=LARGEST)
    half_breadth: Length | None = key("a length above 0", "70 mm", default=None, gt=0, le=LARGEST)


_CAMS = {"23": {"pitch_radius": "70.302 mm", "nominal_setting": "101.6 mm"}}


class Grinder463Table(Table):
    """[machine.gleason-463]: what each grinder has of its own."""

    swivel_offset: Length = key("a length above 0", "381 mm", gt=0, le=LARGEST)
    cams: dict[str, CamTable] = key(
        "a table by cam number, a whole number from 1 to 999",
        _CAMS,
    )


class MachineTable(Table):
    """[machine]: what each machine of its kind has of its own."""

    gleason_463: Grinder463Table | None = key(
        "a table", {"swivel_offset": "381 mm", "cams": _CAMS}, default=None, alias="gleason-463"
    )


class SummarySheetFile(DesignTable):
    """A design file of schema 1 with a blank at each member: a summary sheet."""

    pair: SheetPair = key("a table", {"shaft_angle": "90 deg", "offset": "20 mm"})
    pinion: SheetMember = key("a table", {"teeth": 27, "hand": "right"})
    wheel: SheetMember = key("a table", {"teeth": 28, "hand": "left"})
    machine: MachineTable = key("a table", {}, default=MachineTable())
