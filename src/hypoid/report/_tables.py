"""Tables of the report, as HTML."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from math import degrees, isfinite
from typing import Any

from hypoid.blank import MemberBlank
from hypoid.machine import SummarySheet
from hypoid.pair import GearPair

from ._results import DirectionResult

ARCSEC = 3600.0


def number(value: Any, digits: int = 4) -> str:
    """A number for people; a dash where there is none."""
    if isinstance(value, str | bool | int):
        return escape(str(value))
    return f"{value:.{digits}f}" if isfinite(value) else "&ndash;"


def table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Rows under heads; the first cell of each row names it."""
    top = "".join(f"<th>{escape(word)}</th>" for word in head)
    body = "".join(
        f"<tr><th>{escape(str(first))}</th>"
        + "".join(f"<td>{number(c)}</td>" for c in rest)
        + "</tr>"
        for first, *rest in rows
    )
    return f"<table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table>"


_BLANK: tuple[tuple[str, str, bool], ...] = (
    ("pitch angle [deg]", "pitch_angle", True),
    ("mean spiral angle [deg]", "mean_spiral_angle", True),
    ("mean pitch diameter [mm]", "mean_pitch_diameter", False),
    ("outer pitch diameter [mm]", "outer_pitch_diameter", False),
    ("mean cone distance [mm]", "mean_cone_distance", False),
    ("outer cone distance [mm]", "outer_cone_distance", False),
    ("face width [mm]", "face_width", False),
    ("pitch apex beyond crossing point [mm]", "pitch_apex_beyond_crossing_point", False),
    ("addendum [mm]", "mean_addendum", False),
    ("dedendum [mm]", "mean_dedendum", False),
    ("face angle [deg]", "face_angle", True),
    ("root angle [deg]", "root_angle", True),
)


def blank_table(pair: GearPair) -> str:
    def value(member: MemberBlank, name: str, angle: bool) -> float:
        got = getattr(member, name)
        return degrees(got) if angle else got

    blank = pair.blank
    rows: list[Sequence[Any]] = [
        (t, value(blank.pinion, n, a), value(blank.wheel, n, a)) for t, n, a in _BLANK
    ]
    rows.insert(0, ("hand", blank.pinion.hand, blank.wheel.hand))
    rows.insert(0, ("teeth", blank.pinion.teeth, blank.wheel.teeth))
    return table(("", "pinion", "wheel"), rows)


def pair_table(pair: GearPair) -> str:
    blank = pair.blank
    readings = blank.outer_pinion_readings
    rows = [
        ("shaft angle [deg]", degrees(blank.shaft_angle)),
        ("offset [mm]", blank.offset),
        ("mean normal module [mm]", blank.mean_normal_module),
        ("limit pressure angle [deg]", degrees(blank.limit_pressure_angle)),
        ("slope angle of the blades [deg]", degrees(blank.slope_angle)),
    ]
    for name in ("conforming", "printed_2022") if readings is not None else ():
        reading = getattr(readings, name)
        rows.append((f"pinion R_e1 [mm], {reading.source}", reading.outer_cone_distance))
        rows.append((f"pinion d_e1 [mm], {reading.source}", reading.outer_pitch_diameter))
    return table(("", "value"), rows)


_SHEET: tuple[tuple[str, str, bool], ...] = (
    ("radial distance [mm]", "radial_distance", False),
    ("cradle angle [deg]", "cradle_angle", True),
    ("tilt angle [deg]", "tilt_angle", True),
    ("swivel angle [deg]", "swivel_angle", True),
    ("blank offset [mm]", "blank_offset", False),
    ("machine root angle [deg]", "machine_root_angle", True),
    ("machine center to back [mm]", "machine_center_to_back", False),
    ("sliding base [mm]", "sliding_base", False),
    ("velocity ratio (ratio of roll)", "ratio_of_roll", False),
    ("roll-to-blade ratio", "roll_to_blade_ratio", False),
    ("helical motion [mm/rad]", "helical_motion", False),
    ("advance of the cutter [mm/rad]", "cutter_lead", False),
)


def settings_table(pair: GearPair) -> str:
    """Summary sheet of the four flanks, signs of the 2022 paper."""
    members = ((m, s) for m in (pair.pinion, pair.wheel) for s in ("concave", "convex"))
    columns: dict[str, SummarySheet] = {f"{m.name} {s}": m.sheet(s) for m, s in members}  # type: ignore[arg-type]
    rows: list[Sequence[Any]] = []
    for title, name, angle in _SHEET:
        values = [getattr(sheet, name) for sheet in columns.values()]
        rows.append((title, *(f"{degrees(v) if angle else v:.6f}" for v in values)))
    roll = [
        ", ".join(f"{c:g}" for c in sheet.modified_roll) or "none" for sheet in columns.values()
    ]
    rows.append(("modified roll c2, c3, ...", *roll))
    rows.append(
        ("cutting", *("generated" if s.generated else "form cut" for s in columns.values()))
    )
    rows.append(("axes that move", *(_moving(sheet) for sheet in columns.values())))
    return table(("", *columns), rows)


def _moving(sheet: SummarySheet) -> str:
    moved = [name.replace("_", " ") for name in sheet.motions.moved()]
    return ", ".join([*moved, *(["work roll by a cam"] if sheet.cam else [])]) or "none"


def contact_table(results: Sequence[DirectionResult]) -> str:
    there = [r for r in results if r.contact is not None]
    rows: list[list[Any]] = [[name] for name in (
        "transmission error, peak to peak [arcsec]", "rigid contact ratio", "edge contact",
        "pattern, share of the pinion flank", "ease-off: pressure angle [arcmin]",
        "ease-off: spiral angle [arcmin]", "ease-off: lengthwise crowning [um]",
        "ease-off: profile crowning [um]", "ease-off: bias [um]", "deepest tip interference [um]",
    )]  # fmt: skip
    for result in there:
        contact, ease, nan = result.contact, result.ease_off, float("nan")
        assert contact is not None
        cells = [
            f"{degrees(contact.peak_to_peak) * ARCSEC:.3g}",
            contact.contact_ratio,
            "yes" if contact.edge_contact else "no",
            result.pattern.share if result.pattern else nan,
            degrees(ease.pressure_angle) * 60 if ease else nan,
            degrees(ease.spiral_angle) * 60 if ease else nan,
            ease.lengthwise_crowning * 1e3 if ease else nan,
            ease.profile_crowning * 1e3 if ease else nan,
            ease.bias * 1e3 if ease else nan,
            max((cut.depth * 1e3 for cut in result.cuts), default=nan),
        ]
        for row, cell in zip(rows, cells, strict=True):
            row.append(cell)
    return table(("", *(r.direction for r in there)), rows)


def misalignment_table(result: DirectionResult) -> str:
    contact, marked = result.contact, result.pattern
    if contact is None or marked is None:
        return "<p>Not computed.</p>"
    head = ("error", "step", "TE p-p [arcsec]", "edge contact", "pattern share",
            "pattern centre moves dS [mm]", "dH [mm]")  # fmt: skip
    aligned, rows = marked.centre, []
    for bad in result.misaligned:
        step, n = getattr(bad.numbers.misalignment, bad.error), bad.numbers
        angle = bad.error == "shaft_angle"
        rows.append((
            bad.error.replace("_", " "),
            f"{degrees(step):+.3f} deg" if angle else f"{step:+.3f} mm",
            degrees(n.peak_to_peak) * ARCSEC,
            "yes" if n.edge_contact else "no",
            n.pattern_share,
            n.pattern_centre[0] - aligned[0],
            n.pattern_centre[1] - aligned[1],
        ))  # fmt: skip
    return table(head, rows)


def vh_table(result: DirectionResult) -> str:
    rows = [
        (v.place, *v.target, v.misalignment.offset, v.misalignment.pinion_axial,
         "yes" if v.found else "no")
        for v, _ in result.vh
    ]  # fmt: skip
    return table(("contact to", "S [mm]", "H [mm]", "V = dE [mm]", "H = dP [mm]", "found"), rows)
