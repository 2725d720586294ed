"""`hypoid correct`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from hypoid.geometry import DesignError, Problem

from ._correct_options import steps_before, targets_of, weights_of, wish_of
from ._correct_tables import contact_table, correction_table, show_contact, show_corrections
from ._inspect import Listed, MemberName, comparison_table
from ._options import AsJson, DesignPath
from ._output import report_faults, say, write_json

if TYPE_CHECKING:
    from hypoid.flank import Side
    from hypoid.inspect import Comparison, Correction, Wish


def correct(
    file: DesignPath,
    /,
    *,
    measured: Annotated[Path, Parameter(name=["--measured", "-m"])],
    member: MemberName = "pinion",
    layout: str | None = None,
    machine: str | None = None,
    free: Listed = (),
    noise: str = "1.5 um",
    rank: int | None = None,
    bounds: Listed = (),
    increment: Listed = (),
    exact: Annotated[bool, Parameter(negative=())] = False,
    on_machine: Path | None = None,
    weight: Listed = (),
    target: Listed = (),
    mate: Path | None = None,
    rows: int = 5,
    columns: int = 9,
    toe: float = 10.0,
    heel: float = 10.0,
    root: float = 30.0,
    tip: float = 10.0,
    contact: bool = True,
    figure: Path | None = None,
    save: Path | None = None,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    json: AsJson = False,
) -> int:
    """New machine settings from a measured member, and the contact before, now and after.

    Parameters
    ----------
    measured
        File of the measured points or deviations of the member.
    member
        The member that is corrected.
    layout
        Layout of the measured file, by name or a TOML file.
    machine
        Dials to correct by: the sheet's own machine, "basic", "gleason-106", "gleason-122", "gleason-463".
    free
        What may be moved: dials, "ratio_of_roll", "modified_roll.2", "motions.sliding_base.1", "concave.blade_angle",
        "concave.point_radius" and so on; the usual dials without it.
    noise
        Standard deviation of a measured point: what cannot be told from it is left alone.
    rank
        Correct along so many directions, the strongest first, whatever the noise.
    bounds
        "cradle_angle=66 deg..68 deg": ends of a dial's reading.
    increment
        "cradle_angle=0.5 min": steps of a dial other than the machine's.
    exact
        Do not round to increments.
    on_machine
        Steps dialled before, as --save wrote them: the part was cut with these. What was measured then still counts.
    weight
        "A=0.5", "1=0", "C3=2": how much a row, a column or a point counts, 1 without it.
    target
        "lengthwise_crowning=5 um", "profile_crowning=...", "bias=...": a form other than the nominal flank's.
    mate
        Measured file of the other member: correct towards the pair's ease-off, not towards the nominal flank.
    rows
        Rows of the grid, as measured.
    columns
        Columns of the grid.
    toe
        Border at the toe, per cent of the face width.
    heel
        Border at the heel.
    root
        Border at the root, per cent of the depth.
    tip
        Border at the tip.
    contact
        Contact of the pair before, now and predicted.
    figure
        Draw the deviations before and after: .svg or .png.
    save
        Write the steps here (JSON), for --on-machine of the next loop.
    output
        Write the design file with the new settings here.
    """
    from hypoid.design import build
    from hypoid.inspect import Borders, compare, contact_states, measuring_grid
    from hypoid.io import read_inspection, read_spec

    wish = wish_of(free, noise, rank, exact, bounds, increment)
    spec = read_spec(file)
    pair = build(spec)
    borders = Borders(toe, heel, root, tip)
    grids = {
        m: measuring_grid(getattr(pair, m), rows, columns, borders) for m in ("pinion", "wheel")
    }
    found = compare(grids[member], read_inspection(measured, grids[member], layout), others=grids)
    other = None
    if mate is not None:
        name = "wheel" if member == "pinion" else "pinion"
        other = compare(grids[name], read_inspection(mate, grids[name], layout), others=grids)
    wish = replace(
        wish,
        target=targets_of(pair, found, other, target),
        weights=weights_of(grids[member], weight),
    )
    before, earlier, measurements = steps_before(on_machine, (rows, columns))
    wish = replace(wish, earlier=earlier, measurements=measurements)
    corrections = _corrections(pair, spec, member, machine, found, wish, before)
    if not corrections:
        raise DesignError(
            [
                Problem(
                    "measured", "no flank that is cut", "concave, convex or both", "-m measured.csv"
                )
            ]
        )
    states = None
    if contact:
        states = contact_states(_pairs(pair, found, corrections, other))
    if output is not None:  # first: it may find that it cannot
        _write_design(output, file, corrections)
    if figure is not None:
        _draw(figure, corrections, found)
    if save is not None:
        _save(save, corrections, wish.measurements + 1)
    if json:
        write_json(
            {
                "measured": comparison_table(found),
                "setups": [correction_table(c) for c in corrections],
                "contact": None if states is None else contact_table(states),
            }
        )
    else:
        show_corrections(corrections, found)
        if states is not None:
            show_contact(states)
    return report_faults(())


def _corrections(
    pair: Any,
    spec: Any,
    member: str,
    machine: str | None,
    found: Comparison,
    wish: Wish,
    before: Mapping[str, Mapping[str, float]],
) -> list[Correction]:
    """One correction a setup; what is free of another setup's is no fault of this one's."""
    from hypoid.inspect import Response, correction, setups

    made: list[Correction] = []
    every = setups(pair, member, spec, machine)
    known = {n for setup in every for n in setup.adjustments}
    for setup in every:
        if not any(side in found.sides for side in setup.sides):
            continue
        mine = tuple(n for n in wish.free if n in setup.adjustments or n not in known)
        own = replace(wish, free=mine, on_machine=before.get(" ".join(setup.sides), {}))
        made.append(correction(Response(setup, found.grid), found.deviations, own, found.thickness))
    return made


def _save(path: Path, corrections: list[Correction], measurements: int) -> None:
    import json

    from hypoid.io import write_text

    total = {" ".join(c.setup.sides): dict(c.total) for c in corrections}
    after = {
        side: [[v if math.isfinite(v) else None for v in row] for row in deviation.tolist()]
        for c in corrections
        for side, deviation in c.deviations_after.items()
    }
    known: dict[str, Any] = {"units": "mm, rad, plain", "total": total}
    known |= {"measurements": measurements, "predicted_deviations_mm": after}
    text = json.dumps(known, indent=1)
    say(f"The steps are in {write_text(path, text + chr(10))}, for --on-machine.")


def _pairs(
    pair: Any, found: Comparison, corrections: list[Correction], other: Comparison | None
) -> dict[str, Any]:
    from hypoid.inspect import pair_as_measured

    after: dict[Side, Any] = {s: m for c in corrections for s, m in c.deviations_after.items()}
    now, predicted = pair, pair
    if other is not None:
        now, _ = pair_as_measured(pair, other.grid, other.deviations)
        predicted = now
    now, _ = pair_as_measured(now, found.grid, found.deviations)
    predicted, _ = pair_as_measured(predicted, found.grid, after)
    return {"nominal": pair, "now": now, "predicted": predicted}


def _draw(path: Path, corrections: list[Correction], found: Comparison) -> None:
    from hypoid.io import write_bytes
    from hypoid.report import correction_image

    drawn = correction_image(corrections, found.grid.flanks, path.suffix)
    say(f"Before and after are in {write_bytes(path, drawn, '--figure correction.svg')}.")


def _write_design(path: Path, file: Path, corrections: list[Correction]) -> None:
    from hypoid.io import corrected_design, write_text

    text = corrected_design(file, corrections)
    say(f"The design with the new settings is {write_text(path, text)}.")
