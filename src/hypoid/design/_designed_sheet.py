"""What was designed, as a summary sheet takes it."""

from __future__ import annotations

from typing import Any

from hypoid.machine import MachineSettings, to_sheet

from ._sheet_spec import Method

SHEET_METHODS: dict[str, Method] = {
    "tilt": "tilt",
    "modified-roll": "modified-roll",
    "generated": "generated",
    "fixed-setting": "modified-roll",
    "helical": "tilt",
    "universal": "tilt",
    "completing": "duplex",
    "duplex-helical": "helical-duplex",
}
_PLAIN = (
    "radial_distance", "cradle_angle", "tilt_angle", "swivel_angle", "blank_offset",
    "machine_root_angle", "machine_center_to_back", "sliding_base",
)  # fmt: skip


def sheet_dials(settings: MachineSettings, apex: float) -> dict[str, Any]:
    """Basic settings as the file takes them, signs of the sheet: what rests is left out."""
    sheet = to_sheet(settings, apex)
    dials: dict[str, Any] = {name: float(getattr(sheet, name)) for name in _PLAIN}
    if settings.generated:
        dials["ratio_of_roll"] = float(sheet.ratio_of_roll)
        if sheet.helical_motion:
            dials["helical_motion"] = float(sheet.helical_motion)
        if any(sheet.modified_roll):
            dials["modified_roll"] = tuple(float(c) for c in sheet.modified_roll)
    else:
        dials["ratio_of_roll"] = 0.0
    motions = {
        name: tuple(float(c) for c in getattr(sheet.motions, name))
        for name in sheet.motions.moved()
    }
    if motions:
        dials["motions"] = motions
    return dials
