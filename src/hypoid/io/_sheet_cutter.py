"""Cutters and blades of a summary sheet: face mills, cup wheels and Tri-Ac heads.

One table holds the keys of every blade; which of them a cutter has stands in
`_sheet_cutter_rules.py`.
"""

from __future__ import annotations

from typing import Literal

from ._keys import DEG, LARGEST, Angle, Length, PerLength, Table, key

STEEPEST = 10.0  # 1/mm, of a parabola on a blade
LEANING = 45 * DEG  # hook and side rake stay below


class TopremTable(Table):
    """toprem of a blade, by the height of its kink or, on a stick blade, by its length."""

    angle: Angle = key(
        "an angle above 0 and below 30 deg, off the flank", "7 deg", gt=0, lt=30 * DEG
    )
    height: Length | None = key(
        "a length above 0, from the tips to the kink", "1.5 mm", default=None, gt=0, le=LARGEST
    )
    length: Length | None = key(
        "a length above 0, of the Toprem of a stick blade",
        "1.6 mm", default=None, gt=0, le=LARGEST,
    )  # fmt: skip
    measured: Literal["along-flank", "straight-part"] | None = key(
        'what the length counts: "along-flank", from the line of the tips, or "straight-part", '
        "from the end of the edge arc",
        "along-flank",
        default=None,
    )


class FlankremTable(Table):
    """flankrem of a blade: straight by its angle, or a parabola by its coefficient."""

    height: Length = key("a length above 0, from the tips", "10 mm", gt=0, le=LARGEST)
    angle: Angle | None = key(
        "an angle above 0 and below 30 deg, off the flank", "2 deg", default=None, gt=0, lt=30 * DEG
    )
    coefficient: PerLength | None = key(
        f"a number per length, above 0 and up to {STEEPEST:g} /mm",
        "0.004 /mm", default=None, gt=0, le=STEEPEST,
    )  # fmt: skip


class BladeTable(Table):
    """The blade of a flank; the outside blade cuts the concave one."""

    angle: Angle | None = key(
        "an angle from above -10 to below 60 deg", "20 deg", default=None, gt=-10 * DEG, lt=60 * DEG
    )
    edge_radius: Length | None = key(
        "a length of 0 or more", "1 mm", default=None, ge=0, le=LARGEST
    )
    point_diameter: Length | None = key(
        "a length above 0", "250.952 mm", default=None, gt=0, le=LARGEST
    )
    profile: Literal["straight", "circular-arc", "parabola"] | None = key(
        '"straight", "circular-arc" or "parabola"', "straight", default=None
    )
    radius: Length | None = key(
        "a length other than 0, positive to crown the tooth",
        "800 mm", default=None, ge=-LARGEST, le=LARGEST,
    )  # fmt: skip
    coefficient: PerLength | None = key(
        f"a number per length of up to {STEEPEST:g} /mm either way, positive to crown the tooth",
        "0.0005 /mm", default=None, ge=-STEEPEST, le=STEEPEST,
    )  # fmt: skip
    reference_height: Length | None = key(
        "a length of 0 or more above the tips, where a curved blade has its angle and a stick "
        "blade its pitch point",
        "5 mm",
        default=None,
        ge=0,
        le=LARGEST,
    )
    toprem: TopremTable | None = key(
        "a table", {"angle": "7 deg", "height": "1.5 mm"}, default=None
    )
    flankrem: FlankremTable | None = key(
        "a table", {"height": "10 mm", "angle": "2 deg"}, default=None
    )

    blade_radius: Length | None = key(
        "a length above 0, from the cutter's axis to the pitch point of a stick blade",
        "76.4 mm", default=None, gt=0, le=LARGEST,
    )  # fmt: skip
    eccentric_angle: Angle | None = key(
        "an angle from 0 to below 60 deg, by which a stick blade is turned about its pitch point",
        "18.85 deg", default=None, ge=0, lt=60 * DEG,
    )  # fmt: skip
    hook_angle: Angle | None = key(
        "an angle between -45 and 45 deg, positive where the tip of a stick blade leads",
        "4.42 deg", default=None, gt=-LEANING, lt=LEANING,
    )  # fmt: skip
    side_rake_angle: Angle | None = key(
        "an angle between -45 and 45 deg, of a stick blade",
        "12 deg", default=None, gt=-LEANING, lt=LEANING,
    )  # fmt: skip


class CutterTable(Table):
    """[pinion.cutter]: diameter and point width of a spread-blade cutter, groups of a face-hob head."""

    type: Literal["face-mill", "cup-wheel", "tri-ac"] = key(
        '"face-mill", "cup-wheel" for a grinding wheel of that meridian, or "tri-ac" for a '
        "face-hob head of stick blades",
        "face-mill",
    )
    blade_groups: int | None = key(
        "a whole number from 1 to 100, of a face-hob head", 13, default=None, ge=1, le=100
    )
    spacing: Angle | None = key(
        "an angle above 0, by which an inner blade of a face-hob head follows its outer one",
        "13.846 deg", default=None, gt=0, lt=360 * DEG,
    )  # fmt: skip
    diameter: Length | None = key(
        "a length above 0, to the middle of the point width", "9 in", default=None, gt=0, le=LARGEST
    )
    point_width: Length | None = key("a length above 0", "0.1 in", default=None, gt=0, le=LARGEST)
    height: Length | None = key(
        "a length above 0, of the blades from their tips", "15 mm", default=None, gt=0, le=LARGEST
    )
