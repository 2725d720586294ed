"""`hypoid design`."""

from __future__ import annotations

from dataclasses import asdict
from math import degrees, isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hypoid.geometry import DesignError, Problem

from ._blank import blank_tables
from ._options import AsJson, DesignPath, Output
from ._output import report_faults, say, write_json, write_members
from ._settings import settings_tables

if TYPE_CHECKING:
    from hypoid.design import FlankFit, MilledDesign


def design(
    file: DesignPath,
    /,
    *,
    output: Output = Path("designed.toml"),
    report: Path | None = None,
    json: AsJson = False,
) -> int:
    """From blank and target to cutters and settings: a complete, commented design file.

    Parameters
    ----------
    report
        An HTML report of the designed pair beside it.
    """
    from hypoid.design import MilledRequest
    from hypoid.io import read_spec

    for path in (output, *([] if report is None else [report])):
        if path.is_dir() or not path.parent.is_dir():
            expected = "a file in a folder that exists"
            raise DesignError([Problem("--output", str(path), expected, "-o designed.toml")])
    request = read_spec(file)
    if not isinstance(request, MilledRequest):
        given, expected = (
            "a design whose settings are given",
            'process = "face-milled" in [cutting]',
        )
        raise DesignError([Problem("cutting.process", given, expected, 'process = "face-milled"')])
    from hypoid.design import build, design_milled
    from hypoid.io import design_text, write_text

    say("Blank, wheel and pinion: fitting settings to the target.")
    made = design_milled(request)
    pair = build(made.spec)
    write_text(output, design_text(made))
    if report is not None:
        from hypoid.report import terminal_progress, write_report

        with terminal_progress() as progress:
            write_report(pair, report, progress)
        say(f"The report is {report}.")
    faults = list(dict.fromkeys([*made.faults, *pair.faults]))
    fits = {f"pinion {side}": _fit(fit) for side, fit in made.fits.items()}
    if json:
        maps = {side: _map(fit) for side, fit in made.fits.items()}
        write_json(
            {
                "output": str(output),
                "blank": blank_tables(made.blank),
                "slots": slot_table(made),
                "settings": settings_tables(pair),
                "fits": fits,
                "residual_maps": maps,
                "faults": faults,
                "assumed": [asdict(a) for a in request.assumed],
            }
        )
    else:
        write_members("Fit to the target", fits)
    say(f"The complete design is {output}.")
    return report_faults(faults)


def slot_table(made: MilledDesign) -> dict[str, Any]:
    """Slots, blade points, top lands and edge radii by AGMA 929, mm."""
    slots = made.wheel.slots
    return {
        name: {
            "slot_widths_mm": slots.slots[i],
            "top_lands_mm": slots.top_lands()[i],
            "blade_point_mm": slots.blade_points()[i],
            "largest_edge_radius_mm": made.wheel.edges[i].largest,
        }
        for i, name in enumerate(("pinion", "wheel"))
    }


def _fit(fit: FlankFit) -> dict[str, Any]:
    low, mean, high = (1e3 * float(v) for v in fit.root_error)
    return {
        "residual_rms_um": 1e3 * fit.rms,
        "residual_largest_um": 1e3 * fit.largest,
        "root_error_toe_um": low,
        "root_error_mean_um": mean,
        "root_error_heel_um": high,
        "blade_angle_deg": degrees(fit.blade_angle),
        "point_diameter_mm": 2.0 * fit.point_radius,
        "steps": fit.fit.steps,
        "free_settings": len(fit.free),
        "undetermined_directions": len(fit.undetermined),
    }


def _map(fit: FlankFit) -> list[dict[str, float]]:
    """Residual map: where the flank stands off its target ease-off."""
    return [
        {"cone_distance_mm": float(s), "height_mm": float(h), "residual_um": 1e3 * float(r)}
        for s, h, r in zip(fit.distance, fit.height, fit.residual, strict=True)
        if isfinite(r)
    ]
