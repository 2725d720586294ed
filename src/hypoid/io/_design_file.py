"""The design file of a pair that the program designs: a head-cutter and a method in [cutting].

What ties several keys together stands in `_design_rules.py`.
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
    PerLength,
    Settings,
    SupportTable,
    Table,
)
from ._keys import key as _key


class Flank(Table):
    """One flank of a member."""

    settings: Settings = _key("a table", {}, default=Settings())


class Member(Table):
    """What both members may carry."""

    settings: Settings = _key("a table", {}, default=Settings())
    concave: Flank = _key("a table", {}, default=Flank())
    convex: Flank = _key("a table", {}, default=Flank())
    body: BodyTable = _key("a table", {"bore_diameter": "40 mm"}, default=BodyTable())
    support: SupportTable = _key("a table", {"held": "bore"}, default=SupportTable())


class Pinion(Member):
    """[pinion]."""

    teeth: int = _key("a whole number from 1 to 1000", 6, ge=1, le=MOST_TEETH)
    hand: Literal["left", "right"] = _key('"left" or "right"', "left")
    mean_spiral_angle: Angle = _key(
        "an angle from 0 to below 80 deg", "65 deg", ge=0, lt=80 * DEG - EPS
    )


class Wheel(Member):
    """[wheel]; the mean pitch radius or the mean pitch diameter, one of them."""

    teeth: int = _key("a whole number from 1 to 1000, above pinion.teeth", 73, ge=1, le=MOST_TEETH)
    mean_pitch_radius: Length | None = _key(
        "a length above 0", "130 mm", default=None, gt=0, le=LARGEST
    )
    mean_pitch_diameter: Length | None = _key(
        "a length above 0", "260 mm", default=None, gt=0, le=2 * LARGEST
    )
    face_width: Length = _key("a length above 0", "35 mm", gt=0, le=LARGEST)


class Blank(Table):
    """[blank]: tooth depths in data type II of ISO 23509."""

    mean_addendum_factor: float = _key("a plain number from 0 to 1", 0.5, default=0.5, ge=0, le=1)
    depth_factor: float = _key("a plain number above 0, up to 4", 1.75, default=1.75, gt=0, le=4)
    clearance_factor: float = _key("a plain number from 0 to 1", 0.125, default=0.125, ge=0, le=1)


class Relief(Table):
    """tip_relief of the cutting edges."""

    coefficient: PerLength = _key("a number per length, 0 or more", "0.004 /mm", ge=0, le=LARGEST)
    height: Length = _key("a length above 0", "1.5 mm", gt=0, le=LARGEST)
    measured_from: Literal["tip", "pitch"] = _key(
        '"tip" or "pitch", where the height starts', "tip", default="tip", alias="from"
    )
    flanks: Literal["drive", "coast", "both"] = _key(
        '"drive", "coast" or "both"', "both", default="both"
    )


class Cutting(Table):
    """[cutting]: the method, and the head-cutter it uses."""

    method: Literal["exact-face-hobbed"] = _key('"exact-face-hobbed"', "exact-face-hobbed")
    cutter_radius: Length = _key("a length above 0", "100 mm", gt=0, le=LARGEST)
    blade_groups: int = _key("a whole number from 1 to 100", 5, ge=1, le=100)
    pressure_angle: Angle = _key(
        "an angle above 0 and below 45 deg", "20 deg", gt=0, lt=45 * DEG - EPS
    )
    tip_edge_radius_factor: float = _key(
        "a plain number of 0 or more, times the mean normal module",
        0.38, default=0.38, ge=0, le=4,
    )  # fmt: skip
    eccentricity: Length | None = _key(
        "a length, positive to crown the teeth: between the axes of a two-part head",
        "2 mm", default=None, ge=-LARGEST, le=LARGEST,
    )  # fmt: skip
    outer_share: float | None = _key(
        "a plain number from 0 to 1: how much of the eccentricity moves the outer blades",
        0.5, default=None, ge=0, le=1,
    )  # fmt: skip
    tip_relief: Relief | None = _key(
        "a table", {"coefficient": "0.004 /mm", "height": "1.5 mm"}, default=None
    )


class DesignFile(DesignTable):
    """A design file of schema 1 with a [cutting] table."""

    pair: Pair = _key("a table", {"shaft_angle": "90 deg", "offset": "55 mm"})
    pinion: Pinion = _key("a table", {"teeth": 6, "hand": "left", "mean_spiral_angle": "65 deg"})
    wheel: Wheel = _key(
        "a table", {"teeth": 73, "mean_pitch_radius": "130 mm", "face_width": "35 mm"}
    )
    blank: Blank = _key("a table", {"depth_factor": 1.75}, default=Blank())
    cutting: Cutting = _key(
        "a table",
        {
            "method": "exact-face-hobbed",
            "cutter_radius": "100 mm",
            "blade_groups": 5,
            "pressure_angle": "20 deg",
        },
    )
