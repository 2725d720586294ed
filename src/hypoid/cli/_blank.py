"""`hypoid blank`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from math import degrees, isnan
from typing import TYPE_CHECKING, Any

from ._options import AsJson, DesignPath
from ._output import report_faults, write_json, write_members, write_table

if TYPE_CHECKING:
    from hypoid.blank import MemberBlank, PairBlank


def blank(file: DesignPath, /, *, json: AsJson = False) -> int:
    """Pitch cones, tooth depths, face and root cones of both members."""
    from hypoid.design import spec_blank
    from hypoid.io import read_spec

    spec = read_spec(file)
    result = spec_blank(spec)
    faults = [fault.value for fault in result.faults]
    tables = blank_tables(result)
    if json:
        write_json({**tables, "faults": faults, "assumed": [asdict(a) for a in spec.assumed]})
    else:
        write_table(spec.title, [""], ((key, [value]) for key, value in tables["pair"].items()))
        write_members("Members", {name: tables[name] for name in ("pinion", "wheel")})
        for name, reading in tables.get("outer_pinion_readings", {}).items():
            write_table(f"Pinion heel, {name}", [""], ((k, [v]) for k, v in reading.items()))
    return report_faults(faults)


def blank_tables(blank: PairBlank) -> dict[str, dict[str, Any]]:
    """The blank under the names that scripts rely on; lengths in mm, angles in deg."""
    tables: dict[str, dict[str, Any]] = {
        "pair": {
            "shaft_angle_deg": degrees(blank.shaft_angle),
            "offset_mm": blank.offset,
            "mean_normal_module_mm": blank.mean_normal_module,
            "outer_transverse_module_mm": blank.outer_transverse_module,
            "limit_pressure_angle_deg": degrees(blank.limit_pressure_angle),
            "slope_angle_deg": degrees(blank.slope_angle),
            "pinion_offset_angle_axial_deg": degrees(blank.cones.pinion_offset_angle_axial),
            "wheel_offset_angle_axial_deg": degrees(blank.cones.wheel_offset_angle_axial),
            "offset_angle_pitch_plane_deg": degrees(blank.cones.offset_angle_pitch_plane),
            "working_depth_mm": blank.working_depth,
            "clearance_mm": blank.clearance,
            "pitch_cones_miss_tangency_by_deg": degrees(blank.tangency_residual),
        },
        "pinion": _member(blank.pinion),
        "wheel": _member(blank.wheel),
    }
    readings = blank.outer_pinion_readings
    if readings is not None:
        tables["outer_pinion_readings"] = {
            name: {
                "source": reading.source,
                "outer_cone_distance_mm": reading.outer_cone_distance,
                "outer_pitch_diameter_mm": reading.outer_pitch_diameter,
            }
            for name, reading in (
                ("conforming", readings.conforming),
                ("printed_2022", readings.printed_2022),
            )
        }
    return tables


_ANGLES = (
    "pitch_angle", "mean_spiral_angle", "outer_spiral_angle", "inner_spiral_angle",
    "face_angle", "root_angle",
)  # fmt: skip
_LENGTHS = (
    "mean_pitch_diameter", "outer_pitch_diameter", "inner_pitch_diameter", "outer_tip_diameter",
    "mean_cone_distance", "outer_cone_distance", "inner_cone_distance", "face_width",
    "pitch_apex_beyond_crossing_point", "face_apex_beyond_crossing_point",
    "root_apex_beyond_crossing_point", "mean_addendum", "mean_dedendum", "outer_addendum",
    "outer_dedendum", "inner_addendum", "inner_dedendum",
)  # fmt: skip


def _member(member: MemberBlank) -> dict[str, Any]:
    """Every number of a member; None where a given blank does not say it."""
    angles = {f"{name}_deg": _known(getattr(member, name), degrees) for name in _ANGLES}
    lengths = {f"{name}_mm": _known(getattr(member, name)) for name in _LENGTHS}
    return {"teeth": member.teeth, "hand": member.hand, **angles, **lengths}


def _known(value: float | None, shown: Callable[[float], float] = float) -> float | None:
    return None if value is None or isnan(value) else shown(value)
