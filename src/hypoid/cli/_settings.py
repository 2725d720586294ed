"""`hypoid settings`."""

from __future__ import annotations

from dataclasses import asdict
from math import degrees
from typing import TYPE_CHECKING, Any

from ._options import AsJson, DesignPath
from ._output import DONE, write_json, write_members

if TYPE_CHECKING:
    from hypoid.machine import SummarySheet
    from hypoid.pair import GearPair


def settings(file: DesignPath, /, *, json: AsJson = False) -> int:
    """Basic machine settings of the four flanks, as on a summary sheet."""
    import hypoid

    pair = hypoid.read(file)
    tables = settings_tables(pair)
    if json:
        write_json({**tables, "assumed": [asdict(a) for a in pair.assumed]})
    else:
        columns = {f"{m} {s}": sheet for m, sides in tables.items() for s, sheet in sides.items()}
        write_members(pair.title, columns)
    return DONE


def settings_tables(pair: GearPair) -> dict[str, dict[str, dict[str, Any]]]:
    """Settings by member and side, under the names that scripts rely on; mm and deg."""
    return {
        member.name: {side: _sheet(member.sheet(side)) for side in ("concave", "convex")}
        for member in (pair.pinion, pair.wheel)
    }


def _sheet(sheet: SummarySheet) -> dict[str, Any]:
    return {
        "radial_distance_mm": sheet.radial_distance,
        "cradle_angle_deg": degrees(sheet.cradle_angle),
        "tilt_angle_deg": degrees(sheet.tilt_angle),
        "swivel_angle_deg": degrees(sheet.swivel_angle),
        "blank_offset_mm": sheet.blank_offset,
        "machine_root_angle_deg": degrees(sheet.machine_root_angle),
        "machine_center_to_back_mm": sheet.machine_center_to_back,
        "sliding_base_mm": sheet.sliding_base,
        "ratio_of_roll": sheet.ratio_of_roll,
        "roll_to_blade_ratio": sheet.roll_to_blade_ratio,
        "helical_motion_mm_per_rad": sheet.helical_motion,
        "modified_roll": list(sheet.modified_roll),
    }
