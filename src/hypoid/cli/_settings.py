"""`hypoid settings`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from math import degrees
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from ._options import AsJson, DesignPath
from ._output import report_faults, say, write_json, write_members, write_table

if TYPE_CHECKING:
    from hypoid.design import Dialled
    from hypoid.machine import AxisTable, Machine, SummarySheet
    from hypoid.pair import GearPair

SIX_AXIS = "six-axis"
AXES = ("roll_deg", "x_mm", "y_mm", "z_mm", "a_deg", "b_deg", "c_deg")


def settings(
    file: DesignPath,
    /,
    *,
    machine: str = "basic",
    increments: Annotated[bool, Parameter(negative=())] = False,
    positions: int = 21,
    json: AsJson = False,
) -> int:
    """Machine settings of the four flanks, as on a summary sheet or on a machine's dials.

    Parameters
    ----------
    machine
        "basic", "gleason-106", "gleason-122", "gleason-463", or "six-axis" for an axis table.
    increments
        Round to the dials' steps, and say what that does to the flanks.
    positions
        Roll positions of a six-axis table.
    """
    import hypoid

    pair = hypoid.read(file)
    if machine == SIX_AXIS:
        shown: dict[str, Any] = _six_axis(pair, positions, json)
    elif machine != "basic":
        shown = _dials(pair, machine, increments, json)
    else:
        shown = settings_tables(pair)
        if not json:
            write_members(pair.title, _columns(shown))
            if any(m.flank(s).settings.cam for m in (pair.pinion, pair.wheel) for s in m.heads):
                say("Work roll by a cam: ratio and series are those at its centre of roll.")
    if json:
        assumed = [asdict(a) for a in pair.assumed]
        write_json({**shown, "faults": list(pair.faults), "assumed": assumed})
    return report_faults(pair.faults)


def settings_tables(pair: GearPair) -> dict[str, dict[str, dict[str, Any]]]:
    """Settings by member and side, under the names that scripts rely on; mm and deg."""
    return {
        member.name: {side: _sheet(member.sheet(side)) for side in ("concave", "convex")}
        for member in (pair.pinion, pair.wheel)
    }


def _columns(tables: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    return {f"{m} {s}": values for m, sides in tables.items() for s, values in sides.items()}


def _sheet(sheet: SummarySheet) -> dict[str, Any]:
    shown: dict[str, Any] = {
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
        "generated": sheet.generated,
        "cutter_lead_mm_per_rad": sheet.cutter_lead,
    }
    for name in sheet.motions.moved():
        shown[f"{name}_motion"] = list(getattr(sheet.motions, name))
    if sheet.cam is not None:
        from hypoid.machine import roll_series

        series = roll_series(sheet.cam)
        shown |= {
            "ratio_of_roll": series.ratio_of_roll,
            "modified_roll": list(series.modified_roll),
            "work_roll": "cam",
        }
    return shown


def _dials(pair: GearPair, name: str, increments: bool, json: bool) -> dict[str, Any]:
    """Dials by member and side; with increments, what their steps do to the flank in um."""
    from hypoid.design import dialled, machine_named

    machine = machine_named(name)
    tables: dict[str, dict[str, Any]] = {"pinion": {}, "wheel": {}}
    words: dict[str, dict[str, Any]] = {"pinion": {}, "wheel": {}}
    for one in dialled(pair, name):
        dials = one.rounded if increments else one.dials
        values, spoken = _readings(machine, dials)
        if increments:
            values |= _rounding(one)
            spoken["rounding, largest [um]"] = f"{one.deviation.largest * 1e3:.3f}"
        tables[one.flank.member][one.flank.side] = values
        words[one.flank.member][one.flank.side] = spoken
    if not json:
        write_members(f"{pair.title} on {name}", _columns(words))
    return {"machine": name, **tables}


def _readings(machine: Machine, dials: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """Dials with units in their names, mm and deg; and as a person reads them."""
    values: dict[str, Any] = {}
    words: dict[str, Any] = {}
    for name, dial in machine.table.items():
        value = getattr(dials, name)
        words[name.replace("_", " ")] = dial.words(value)
        if dial.kind == "angle":
            values[f"{name}_deg"] = degrees(value)
        elif dial.kind == "length":
            values[f"{name}_mm"] = value
        else:
            values[name] = list(value) if dial.kind == "gears" else value
    return values, words


def _rounding(one: Dialled) -> dict[str, Any]:
    return {
        "rounding_largest_um": one.deviation.largest * 1e3,
        "rounding_um": one.deviation.normal * 1e3,  # rows root to tip, columns toe to heel
    }


def _six_axis(pair: GearPair, positions: int, json: bool) -> dict[str, Any]:
    """Axis tables by member and side over the roll that cuts each flank, in the member's own hand."""
    from hypoid.design import axis_tables

    tables: dict[str, Any] = {"machine": SIX_AXIS, "pinion": {}, "wheel": {}}
    for flank, table in axis_tables(pair, positions):
        columns = _axis_columns(table, -1.0 if flank.mirrored else 1.0)
        tables[flank.member][flank.side] = columns
        if not json:
            rows = zip(*columns.values(), strict=True)
            numbered = ((str(k), [float(v) for v in row]) for k, row in enumerate(rows))
            write_table(f"{pair.title}: {flank.name}", list(columns), numbered)
    return tables


def _axis_columns(table: AxisTable, hand: float) -> dict[str, Any]:
    """Columns by name; the other hand is the mirror image: roll, Y, A and C change sign."""
    roll, y, a, c = (hand * v for v in (table.roll, table.y, table.a, table.c))
    values = (roll, table.x, y, table.z, a, table.b, c)
    scale = degrees(1.0)
    return {
        name: v * scale if name.endswith("_deg") else v
        for name, v in zip(AXES, values, strict=True)
    }
