"""`hypoid inspect`."""

from __future__ import annotations

from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from ._options import AsJson, DesignPath, quantities
from ._output import DONE, report_faults, say, write_json, write_members, write_table

if TYPE_CHECKING:
    from hypoid.inspect import Comparison, Measured, MeasuringGrid, SideComparison

UM = 1e3
MemberName = Literal["pinion", "wheel"]
Listed = Annotated[tuple[str, ...], Parameter(consume_multiple=True)]


def inspect(
    file: DesignPath,
    /,
    *,
    member: MemberName = "pinion",
    nominal: Path | None = None,
    measured: Annotated[Path | None, Parameter(name=["--measured", "-m"])] = None,
    layout: str | None = None,
    rows: int = 5,
    columns: int = 9,
    toe: float = 10.0,
    heel: float = 10.0,
    root: float = 30.0,
    tip: float = 10.0,
    axial: Annotated[str, Parameter(allow_leading_hyphen=True)] = "0 mm",
    zero: Literal["reference", "best-fit"] = "reference",
    identify: Annotated[bool, Parameter(negative=())] = False,
    free: Listed = (),
    noise: str = "1.5 um",
    figure: Path | None = None,
    json: AsJson = False,
) -> int:
    """Nominal grid of a member for a measuring machine, and what a measured one deviates by.

    Parameters
    ----------
    member
        The member that is measured.
    nominal
        Write the nominal points and normals here: .json, else text in the layout.
    measured
        A file of measured points or deviations, to compare.
    layout
        Layout of the files by name ("hypoid", "points", "points-axis-x", "deviations"), or a TOML file of one's own.
    rows
        Points from root to tip, 3 to 45.
    columns
        Points from toe to heel, 3 to 45.
    toe
        Border left free at the toe, per cent of the face width.
    heel
        Border left free at the heel.
    root
        Border left free at the root, per cent of the depth.
    tip
        Border left free at the tip.
    axial
        Axial place of the part on the machine less the nominal one ("0.02 mm"), or "fit".
    zero
        Turn the part until the reference point is at zero, or to the best fit.
    identify
        The gear is unknown and the design a rough guess: find the settings that cut the measured points.
    free
        What is to be found then: dials, "concave.blade_angle" and so on; the usual dials without it.
    noise
        Standard deviation of a measured point, for what is found.
    figure
        Draw the deviations: .svg or .png.
    """
    from hypoid.design import build
    from hypoid.inspect import Borders, compare, measuring_grid
    from hypoid.io import read_inspection, read_spec

    shift: Any = "fit" if axial == "fit" else quantities({"--axial": (axial, "length")})["--axial"]
    sigma = quantities({"--noise": (noise, "length")})["--noise"]
    spec = read_spec(file)
    pair = build(spec)
    borders = Borders(toe, heel, root, tip)
    grids = {
        m: measuring_grid(getattr(pair, m), rows, columns, borders) for m in ("pinion", "wheel")
    }
    grid = grids[member]
    if nominal is not None:
        write_nominal(nominal, grid, layout)
    if measured is None:
        _show_grid(pair.title, grid, json)
        return report_faults(grid.faults)
    read = read_inspection(measured, grid, layout)
    if identify:
        names = tuple(n for group in free for n in group.replace(",", " ").split())
        return _identify(pair, spec, grid, read, names, sigma, json)
    found = compare(grid, read, axial=shift, zero=zero, others=grids)
    if figure is not None:
        write_figure(figure, found)
    if json:
        write_json(comparison_table(found))
    else:
        show_comparison(found)
    return report_faults(grid.faults) if grid.faults else DONE


def _identify(
    pair: Any, spec: Any, grid: MeasuringGrid, read: Measured, names: Any, noise: float, json: bool
) -> int:
    from hypoid.inspect import identify, setups, shown_reading, shown_step

    tables: list[dict[str, Any]] = []
    unsettled: list[str] = []
    every = setups(pair, grid.member.name, spec)
    known = {n for setup in every for n in setup.adjustments}
    for setup in every:
        if not set(setup.sides) <= set(read.sides):
            continue
        mine = tuple(n for n in names if n in setup.adjustments or n not in known)
        found = identify(grid, setup, read, free=mine, noise=noise)
        own = setup.adjustments
        if not found.converged:
            unsettled.append(
                f"{setup.name}: not converged; a nearer guess, or fewer adjustments, may help."
            )
        tables.append(
            {
                "sides": setup.sides,
                "machine": setup.machine,
                "rms_um": found.rms * UM,
                "found": {n: found.value(n) for n in found.steps},
                "standard_error": found.standard_error,
                "undecided": [n.words for n in found.undecided],
                "units": "mm, rad, plain",
            }
        )
        if json:
            continue
        write_table(
            f"{setup.name} on {setup.machine}",
            ["guess", "found", "standard error"],
            (
                (
                    n,
                    [
                        shown_reading(own[n], own[n].value),
                        shown_reading(own[n], found.value(n)),
                        shown_step(own[n], found.standard_error[n]).lstrip("+"),
                    ],
                )
                for n in found.steps
            ),
        )
        say(
            f"{setup.name}: the points lie {found.rms * UM:.2f} um rms off the flanks that these settings cut."
        )
        for null in found.undecided:
            say(f"Undecided: {null.words}.")
    if json:
        write_json({"setups": tables})
    return report_faults(unsettled)


def write_nominal(path: Path, grid: MeasuringGrid, layout: str | None) -> None:
    """Write the nominal grid: JSON by the file's name, else text in a layout."""
    from hypoid.io import inspection_json, inspection_text, read_layout, write_text

    plain = path.suffix != ".json"
    text = (
        inspection_text(grid, read_layout(layout or "hypoid")) if plain else inspection_json(grid)
    )
    count = grid.rows * grid.columns
    say(f"{count} nominal points of each {grid.member.name} flank are in {write_text(path, text)}.")


def write_figure(path: Path, found: Comparison) -> None:
    """Draw a comparison to an SVG or PNG file."""
    from hypoid.io import write_bytes
    from hypoid.report import topography_image

    say(
        f"The topography is in {write_bytes(path, topography_image(found, path.suffix), '--figure map.svg')}."
    )


def _show_grid(title: str, grid: MeasuringGrid, json: bool) -> None:
    nodes = grid.flanks["concave"]
    facts = {
        "member": grid.member.name,
        "rows": grid.rows,
        "columns": grid.columns,
        "reference_point": nodes.name(*grid.reference),
        "reference_cone_distance_mm": float(nodes.distance[grid.reference]),
        "reference_height_mm": float(nodes.height[grid.reference]),
        "tooth_thickness_mm": grid.thickness,
        "pitch_deg": degrees(grid.pitch),
    }
    if json:
        write_json(facts)
    else:
        write_table(f"{title}: measuring grid", ["value"], [(k, [v]) for k, v in facts.items()])


def comparison_table(found: Comparison) -> dict[str, Any]:
    """A comparison under the names that scripts rely on; rows root to tip, columns toe to heel."""
    return {
        "member": found.grid.member.name,
        "thickness_deviation_um": None if found.thickness is None else found.thickness * UM,
        "axial_mm": found.axial,
        "runout_um": None if found.runout is None else found.runout * UM,
        **{side: _side(found, side, one) for side, one in found.sides.items()},
    }


def _side(found: Comparison, side: Any, one: SideComparison) -> dict[str, Any]:
    parts, pitch = one.topography, found.pitch.get(side)
    return {
        "teeth": one.teeth,
        "largest_um": one.largest * UM,
        "rms_um": one.rms * UM,
        "deviation_um": one.mean * UM,
        "scatter_um": one.scatter * UM,
        "outliers": one.outliers,
        "pressure_angle_arcmin": degrees(parts.pressure_angle) * 60.0,
        "spiral_angle_arcmin": degrees(parts.spiral_angle) * 60.0,
        "profile_crowning_um": parts.profile_crowning * UM,
        "lengthwise_crowning_um": parts.lengthwise_crowning * UM,
        "bias_um": parts.bias * UM,
        "residual_um": parts.residual * UM,
        "pitch": None
        if pitch is None
        else {
            "teeth": pitch.teeth,
            "cumulative_um": [c * UM for c in pitch.cumulative],
            "greatest_single_um": None if pitch.single is None else pitch.single * UM,
            "total_um": pitch.total * UM,
        },
    }


def show_comparison(found: Comparison) -> None:
    """A comparison for a person: a map of each flank, tip above, and its parts."""
    table = comparison_table(found)
    for side, one in found.sides.items():
        rows, columns = one.nodes.shape
        names = [one.nodes.name(0, c)[:-1] for c in range(columns)]
        lines = [
            (
                f"{r + 1}{' tip' if r == rows - 1 else ' root' if r == 0 else ''}",
                [_um(v) for v in one.mean[r]],
            )
            for r in range(rows)[::-1]
        ]
        title = f"{found.grid.member.name} {side}: deviation [um], toe to heel; + stands out"
        write_table(title, names, lines)
    labels = {
        "largest_um": "largest [um]",
        "rms_um": "rms [um]",
        "pressure_angle_arcmin": "pressure angle [min]",
        "spiral_angle_arcmin": "spiral angle [min]",
        "profile_crowning_um": "profile crowning [um]",
        "lengthwise_crowning_um": "lengthwise crowning [um]",
        "bias_um": "bias [um]",
        "residual_um": "left by these [um rms]",
    }
    write_members(
        "parts of the deviation",
        {s: {label: f"{table[s][key]:+.2f}" for key, label in labels.items()} for s in found.sides},
    )
    if found.thickness is not None:
        say(
            f"Tooth thickness {found.thickness * UM:+.1f} um at the reference point, along the arc."
        )
    for side, pitch in found.pitch.items():
        single = "" if pitch.single is None else f", greatest single {pitch.single * UM:.1f} um"
        say(
            f"{side}: total pitch deviation {pitch.total * UM:.1f} um over {len(pitch.teeth)} teeth{single}."
        )
    if found.runout is not None:
        say(f"Runout {found.runout * UM:.1f} um.")
    if found.axial:
        say(f"Taken off along the axis: {found.axial:+.4f} mm.")
    for side, one in found.sides.items():
        for name in one.outliers:
            say(f"Outlier, left out of mean and fits: {side}, {name}.")


def _um(value: float) -> str:
    return f"{value * UM:+.1f}" if value == value else "-"
