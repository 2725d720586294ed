"""The report of a pair: what was found first, then blank, cutter, settings, flanks and contact."""

from __future__ import annotations

import base64
import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from math import degrees
from pathlib import Path

import numpy as np

from hypoid.cutter import CycloPalloidHead, FaceHobHead
from hypoid.pair import GearPair

from ._figures_blank import blank_figure
from ._figures_contact import (
    ease_off_figure,
    misalignment_figure,
    motion_figure,
    pattern_figure,
)
from ._figures_cutter import cutter_figure
from ._figures_fit import FittedPinion, fit_section
from ._figures_mill import blades_figure
from ._figures_tooth import tooth_figure, tooth_notes, tooth_rows
from ._loaded import Loaded, loaded_section
from ._page import box, drawing, note, page
from ._progress import Progress, silent
from ._results import STEPS_A_DIRECTION, Results, results
from ._scene import Scene, scene
from ._still import draw_still
from ._style import figure, look, to_png, to_svg
from ._tables import (
    blank_table,
    contact_table,
    misalignment_table,
    pair_table,
    settings_table,
    table,
    vh_table,
)

STEPS = 2 * STEPS_A_DIRECTION + 3


@dataclass(frozen=True)
class ReportSummary:
    """What a report found wrong, in words; empty for a sound design."""

    faults: tuple[str, ...]


def write_report(
    pair: GearPair,
    path: str | Path,
    progress: Progress = silent,
    loaded: Loaded | None = None,
    fitted: FittedPinion | None = None,
) -> ReportSummary:
    """Write the report of a pair, `loaded` or `fitted` or neither, to one HTML file: whole, or not at all."""
    text, summary = report_html(pair, progress, loaded, fitted)
    path = Path(path)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=path.name, suffix=".part")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        Path(name).chmod(0o644)
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    return summary


def report_html(
    pair: GearPair,
    progress: Progress = silent,
    loaded: Loaded | None = None,
    fitted: FittedPinion | None = None,
) -> tuple[str, ReportSummary]:
    """The report as HTML text, and what it found wrong."""
    done = 0

    def step(what: str) -> None:
        nonlocal done
        progress(what, done, STEPS)
        done += 1

    found = results(pair, step)
    step("figures")
    with look():
        sections = _sections(found, loaded)
        if fitted is not None:
            sections.append(("Fit to the target", fit_section(pair, fitted)))
        step("3D view")
        sections.append(("In mesh", _in_mesh(found)))
    progress("done", STEPS, STEPS)
    return page(pair.title, pair.source, sections), ReportSummary(
        found.faults + (loaded.faults if loaded else ())
    )


def _sections(found: Results, loaded: Loaded | None) -> list[tuple[str, str]]:
    pair = found.pair
    shown: list[tuple[str, str]] = [
        ("What was found", _findings(found, loaded.faults if loaded else ())),
        (
            "Blank",
            drawing(to_svg(blank_figure(pair)), "Axial sections to scale; chain-dotted: pitch cones.")
            + f'<div class="side">{blank_table(pair)}{pair_table(pair)}</div>'
            + _heel_note(pair),
        ),
        (
            "Cutter",
            _cutter(pair),
        ),
        (
            "Machine settings",
            settings_table(pair)
            + note("Summary sheet in the 2022 paper's signs; machine center to back counts to the pitch apex."),
        ),
        ("Tooth surfaces", _surfaces(pair)),
        ("Tooth", _tooth(found)),
        (
            "Contact pattern",
            drawing(to_svg(pattern_figure(found)), f"Where a marking compound of {pair.marking_thickness * 1e3:g} um is wiped off, over all positions of all pairs; black: path of contact, refined on the exact surfaces.")
            + contact_table(found.both),
        ),
        (
            "Motion",
            drawing(to_svg(motion_figure(found)), "Wheel angle minus z1/z2 pinion angle, positive when the wheel leads. Neighbouring pairs follow a pitch apart; how far they lie below the envelope is how near they come to touching."),
        ),
        (
            "Ease-off",
            drawing(to_svg(ease_off_figure(found)), "Pinion against the wheel's conjugate, along the normal; positive where material is missing. Blank where the conjugate leaves the wheel's active flank."),
        ),
    ]  # fmt: skip
    if loaded is not None:
        shown.append(("Under load", loaded_section(loaded)))
    for result in found.both:
        shown.append((
            f"Misalignment {result.direction}",
            drawing(to_svg(misalignment_figure(result)), "Pattern under each error (colour) against the aligned one (grey); dot and cross: their centres. Below: V-H check, contact brought to toe and heel.")
            + misalignment_table(result)
            + vh_table(result),
        ))  # fmt: skip
    return shown


def _heel_note(pair: GearPair) -> str:
    if pair.blank.outer_pinion_readings is None:
        return ""
    return note(
        "Two readings of the pinion's heel: ISO 23509 has a_p where the 2022 paper's numbers need a."
    )


def _cutter(pair: GearPair) -> str:
    heads = pair.pinion.head, pair.wheel.head
    pinion, wheel = (h.head if isinstance(h, CycloPalloidHead) else h for h in heads)
    if isinstance(pinion, FaceHobHead) and isinstance(wheel, FaceHobHead):
        words = "Face-hob head and blade profiles; flat land, edge arc, straight edge, relief."
        if isinstance(heads[0], CycloPalloidHead):
            words += (
                f" The axes of outer and inner blades stand {heads[0].eccentricity:g} mm apart."
            )
        return drawing(to_svg(cutter_figure(pinion, wheel)), words)
    words = (
        "Blades in the plane of the cutter axis, tips up; orange: edge arc; red: Toprem, Flankrem."
    )
    return drawing(to_svg(blades_figure(pair)), words)


def _findings(found: Results, under_load: tuple[str, ...]) -> str:
    lines: list[str] = []
    for result in found.both:
        contact = result.contact
        if contact is None:
            continue
        edge = "with edge contact" if contact.edge_contact else "no edge contact"
        lines.append(
            f"{result.direction}: transmission error {degrees(contact.peak_to_peak) * 3600:.3g} arcsec "
            f"peak to peak, rigid contact ratio {contact.contact_ratio:.3f}, {edge}."
        )
    parts = [box("Contact", lines, bad=False)]
    if faults := [*found.faults, *under_load]:
        parts.append(box("Faults", faults, bad=True))
    if found.pair.assumed:
        given = [f"{a.value}: {a.reason}" for a in found.pair.assumed]
        parts.append(box("Assumed, not given by the source", given, bad=False))
    return "".join(parts)


def _surfaces(pair: GearPair) -> str:
    """A few points of every flank with curvatures, and how good the charts are."""
    rows: list[tuple[object, ...]] = []
    for flank in pair.flanks():
        middle = 0.5 * (flank.toe + flank.heel)
        at = flank.at_cone([flank.toe, middle, flank.heel], [0.0, 0.0, 0.0])
        for k, place in enumerate(("toe", "middle", "heel")):
            first, second = at.principal_curvatures[k] if at.ok[k] else (np.nan, np.nan)
            rows.append(
                (
                    f"{flank.name}, {place}",
                    *at.position[k],
                    *at.normal[k],
                    f"{first:.6f}",
                    f"{second:.6f}",
                )
            )
    head = (
        "on the pitch cone",
        "x [mm]",
        "y [mm]",
        "z [mm]",
        "n_x",
        "n_y",
        "n_z",
        "k1 [1/mm]",
        "k2 [1/mm]",
    )
    worst = max(chart.error for flank in pair.flanks() for chart in flank.charts.values())
    return table(head, rows) + note(
        "Points are exact: Newton leaves below 1e-9 mm. Curvatures are positive where the tooth is convex. "
        f"Charts (start values, gap field) are within {worst:.1e} rad of the surfaces."
    )  # fmt: skip


def _tooth(found: Results) -> str:
    """Sections of both members as they are cut, their lands and depths, and the pair's backlash."""
    pair = found.pair
    head = (
        "along the arc",
        "top land [mm]",
        "tooth [mm]",
        "slot [mm]",
        "slot bottom [mm]",
        "whole depth [mm]",
        "nominal [mm]",
    )
    words = tooth_notes(found.teeth)
    if found.backlash is not None and np.isfinite(found.backlash.wheel_angle):
        b = found.backlash
        words.append(
            f"Backlash at the mean point {b.mean_normal:.4f} mm normal, {b.mean_transverse:.4f} mm transverse; "
            f"at the outer pitch circle {b.outer_normal:.4f} and {b.outer_transverse:.4f} mm."
        )
    return (
        drawing(to_svg(tooth_figure(pair)), "Sections S = const, unrolled about the axis; red: fillets; black: top land and slot bottom; dashed: pitch cone.")
        + table(head, tooth_rows(found.teeth))
        + "".join(note(line) for line in words)
    )  # fmt: skip


def _in_mesh(found: Results) -> str:
    drive = found.drive
    shown = scene(found.pair, drive.contact, drive.pattern)
    still = figure(6.4, 8.2)
    draw_still(still.add_subplot(), shown)
    picture = base64.b64encode(to_png(still, dpi=110)).decode()
    img = f'<figure class="still"><img alt="the pair in mesh" src="data:image/png;base64,{picture}"></figure>'
    return (
        f'<div id="scene">{_interactive(shown)}</div><div class="print-only">{img}</div>'
        f"<noscript>{img}</noscript>"
        + note(
            "Drag to turn, scroll to zoom; painted: the drive pattern. Shaft and rim are drawn for the eye only."
        )
    )


def _interactive(shown: Scene) -> str:
    """The scene as a plotly view with its script inside: no network."""
    import plotly.graph_objects as go  # type: ignore[import-untyped]

    traces = [
        go.Mesh3d(
            **dict(zip("xyz", np.round(mesh.vertices.T, 3).astype(np.float32), strict=True)),
            **dict(zip("ijk", mesh.triangles.T.astype(np.int32), strict=True)),
            color=mesh.colour,
            name=mesh.name,
            flatshading=False,
            lighting={"ambient": 0.45, "diffuse": 0.75, "specular": 0.25, "roughness": 0.6},
            hoverinfo="name",
        )
        for mesh in shown.meshes
    ]
    hidden = {"visible": False}
    layout = go.Layout(
        scene={
            "aspectmode": "data", "xaxis": hidden, "yaxis": hidden, "zaxis": hidden,
            "camera": {"eye": {"x": 0.9, "y": 0.9, "z": -1.3}, "up": {"x": 0, "y": 1, "z": 0}},
        },
        margin={"l": 0, "r": 0, "t": 0, "b": 0},
        height=560,
    )  # fmt: skip
    made: Callable[..., str] = go.Figure(traces, layout).to_html
    return made(full_html=False, include_plotlyjs=True, config={"displaylogo": False})
