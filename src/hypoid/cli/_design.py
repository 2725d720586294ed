"""`hypoid design`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from math import degrees, isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hypoid.geometry import DesignError, Problem

from ._blank import blank_tables
from ._options import AsJson, DesignPath, Output
from ._output import report_faults, say, write_json, write_members
from ._settings import settings_tables

if TYPE_CHECKING:
    from hypoid.design import (
        ExactDesign,
        FlankFit,
        HobbedDesign,
        MilledDesign,
        SideFit,
        Spec,
    )
    from hypoid.flank import Side


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
    from hypoid.io import read_spec

    for path in (output, *([] if report is None else [report])):
        if path.is_dir() or not path.parent.is_dir():
            expected = "a file in a folder that exists"
            raise DesignError([Problem("--output", str(path), expected, "-o designed.toml")])
    spec = read_spec(file)
    from hypoid.design import build
    from hypoid.io import write_text

    made = _made(spec)
    pair = build(made.design.spec)
    write_text(output, made.text)
    if report is not None:
        from hypoid.report import FittedPinion, terminal_progress, write_report

        fitted = FittedPinion(made.sides, made.undetermined) if made.sides else None
        with terminal_progress() as progress:
            write_report(pair, report, progress, fitted=fitted)
        say(f"The report is {report}.")
    faults = list(dict.fromkeys([*made.design.faults, *pair.faults]))
    if json:
        write_json(
            {
                "output": str(output),
                "blank": blank_tables(made.design.blank),
                "settings": settings_tables(pair),
                **made.tables,
                "fits": made.fits,
                "faults": faults,
                "assumed": [asdict(a) for a in made.design.request.assumed],
            }
        )
    elif made.fits:
        write_members("Fit to the target", made.fits)
    say(f"The complete design is {output}.")
    return report_faults(faults)


@dataclass(frozen=True)
class _Made:
    """A design with its file's text and what is told of its fit."""

    design: MilledDesign | HobbedDesign | ExactDesign
    text: str
    fits: dict[str, dict[str, Any]]
    tables: dict[str, Any]
    sides: Mapping[Side, FlankFit | SideFit] = field(default_factory=dict)
    undetermined: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


def _made(spec: Spec) -> _Made:
    """The design of whichever kind of request a file holds."""
    from hypoid.design import (
        ExactFaceHobbedSpec,
        HobbedRequest,
        MilledRequest,
        design_exact,
        design_hobbed,
        design_milled,
    )
    from hypoid.io import design_text, exact_text, hobbed_text

    if isinstance(spec, MilledRequest):
        say("Blank, wheel and pinion: fitting settings to the target.")
        milled = design_milled(spec)
        fits = {f"pinion {side}": _fit(fit) for side, fit in milled.fits.items()}
        maps = {side: _map(fit) for side, fit in milled.fits.items()}
        tables = {"slots": slot_table(milled), "residual_maps": maps}
        words = {f"pinion {side}": fit.undetermined for side, fit in milled.fits.items()}
        return _Made(milled, design_text(milled), fits, tables, milled.fits, words)
    if isinstance(spec, HobbedRequest):
        say("Blank, wheel and pinion: fitting one setting-up to both targets.")
        hobbed = design_hobbed(spec)
        maps = {side: _map(fit) for side, fit in hobbed.fit.sides.items()}
        tables = {"slots": slot_table(hobbed), "residual_maps": maps}
        sides, words = hobbed.fit.sides, {"both flanks": hobbed.fit.undetermined}
        return _Made(hobbed, hobbed_text(hobbed), _hobbed_fits(hobbed), tables, sides, words)
    if isinstance(spec, ExactFaceHobbedSpec):
        exact = design_exact(spec)
        return _Made(exact, exact_text(exact), {}, {})
    given, expected = (
        "a design whose settings are given",
        'process = "face-milled" or "face-hobbed"',
    )
    raise DesignError([Problem("cutting.process", given, expected, 'process = "face-milled"')])


def _hobbed_fits(made: HobbedDesign) -> dict[str, dict[str, Any]]:
    """How near both flanks of one setting-up came."""
    fit, fits = made.fit, dict[str, dict[str, Any]]()
    for i, (side, own) in enumerate(fit.sides.items()):
        low, mean, high = (1e3 * float(v) for v in own.root_error)
        fits[f"pinion {side}"] = {
            "residual_rms_um": 1e3 * own.rms,
            "residual_largest_um": 1e3 * own.largest,
            "root_error_toe_um": low,
            "root_error_mean_um": mean,
            "root_error_heel_um": high,
            "blade_angle_deg": degrees(fit.angles[i]),
            "blade_radius_mm": fit.radii[i],
            "blade_curvature_per_mm": fit.curvatures[i],
            "mean_normal_thickness_mm": fit.thickness,
            "steps": fit.fit.steps,
            "free_settings": len(fit.free),
            "undetermined_directions": len(fit.undetermined),
        }
    return fits


def slot_table(made: MilledDesign | HobbedDesign) -> dict[str, Any]:
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


def _map(fit: FlankFit | SideFit) -> list[dict[str, float]]:
    """Residual map: where the flank stands off its target ease-off."""
    return [
        {"cone_distance_mm": float(s), "height_mm": float(h), "residual_um": 1e3 * float(r)}
        for s, h, r in zip(fit.distance, fit.height, fit.residual, strict=True)
        if isfinite(r)
    ]
