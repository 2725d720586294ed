"""`hypoid correct`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from hypoid.geometry import DesignError, Problem

from ._inspect import UM, Listed, MemberName, comparison_table
from ._options import AsJson, DesignPath, quantities
from ._output import report_faults, say, write_json, write_members, write_table

if TYPE_CHECKING:
    from hypoid.flank import Side
    from hypoid.inspect import Comparison, ContactState, Correction, Wish

ARCSEC = 3600.0


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
        Steps dialled before, as --save wrote them: the part was cut with these.
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

    wish = _wish(free, noise, rank, exact, bounds, increment)
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
    wish = replace(wish, target=_targets(pair, found, other, target))
    before = _steps_before(on_machine)
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
    if figure is not None:
        _draw(figure, corrections, found)
    if save is not None:
        _save(save, corrections)
    if output is not None:
        _write_design(output, file, corrections)
    if json:
        write_json(
            {
                "measured": comparison_table(found),
                "setups": [_table(c) for c in corrections],
                "contact": None if states is None else _contact_table(states),
            }
        )
    else:
        _show(corrections, found)
        if states is not None:
            _show_contact(states)
    return report_faults(())


def _wish(
    free: tuple[str, ...],
    noise: str,
    rank: int | None,
    exact: bool,
    bounds: tuple[str, ...],
    increment: tuple[str, ...],
) -> Wish:
    from hypoid.inspect import Wish

    problems: list[Problem] = []
    if rank is not None and rank < 1:
        problems.append(Problem("--rank", str(rank), "at least 1", "--rank 3"))
    sigma = quantities({"--noise": (noise, "length")})["--noise"]
    if not 0.0 < sigma < 1.0:
        problems.append(Problem("--noise", noise, "above 0 and below 1 mm", '--noise "1.5 um"'))
    names = tuple(n for group in free for n in group.replace(",", " ").split())
    steps = {
        n: _value(n, v, "--increment", problems)
        for n, v in _pairs_of(increment, "--increment", problems)
    }
    ends: dict[str, tuple[float, float]] = {}
    for name, text in _pairs_of(bounds, "--bounds", problems):
        low, dots, high = text.partition("..")
        if not dots:
            problems.append(
                Problem(
                    "--bounds",
                    text,
                    "two readings with .. between",
                    '--bounds "cradle_angle=66 deg..68 deg"',
                )
            )
            continue
        ends[name] = (
            _value(name, low, "--bounds", problems),
            _value(name, high, "--bounds", problems),
        )
    if problems:
        raise DesignError(problems)
    return Wish(
        free=names, noise=sigma, rank=rank, rounded=not exact, bounds=ends, increments=steps
    )


def _pairs_of(
    given: tuple[str, ...], option: str, problems: list[Problem]
) -> list[tuple[str, str]]:
    made: list[tuple[str, str]] = []
    for text in given:
        name, equals, value = text.partition("=")
        if equals:
            made.append((name.strip(), value.strip()))
        else:
            problems.append(
                Problem(option, text, "a name and a value", f'{option} "cradle_angle=1 min"')
            )
    return made


def _value(name: str, text: str, option: str, problems: list[Problem]) -> float:
    """A quantity by what its name says: an angle, a plain number, else a length."""
    from hypoid.io import QuantityError, parse

    try:
        if name.startswith(("ratio", "modified", "motions", "helical")):
            return float(text)
        return parse(text, "angle" if name.endswith("angle") else "length")
    except QuantityError as error:
        problems.append(
            Problem(option, error.given, error.expected, f'{option} "{name}={error.example}"')
        )
    except ValueError:
        problems.append(Problem(option, text, "a number", f'{option} "{name}=0.001"'))
    return 0.0


def _targets(
    pair: Any, found: Comparison, other: Comparison | None, target: tuple[str, ...]
) -> Any:
    from hypoid.inspect import form, mates_ease_off

    problems: list[Problem] = []
    known = ("profile_crowning", "lengthwise_crowning", "bias")
    forms: dict[str, float] = {}
    for name, text in _pairs_of(target, "--target", problems):
        if name not in known:
            problems.append(
                Problem("--target", name, f"one of {', '.join(known)}", '--target "bias=3 um"')
            )
        else:
            forms[name] = _value(name, text, "--target", problems)
    if problems:
        raise DesignError(problems)
    made: dict[Any, Any] = {}
    for side, one in found.sides.items():
        made[side] = form(one.nodes, **forms)
        mate_side = "convex" if side == "concave" else "concave"
        if other is not None and mate_side in other.sides:
            mate = other.sides[mate_side]
            made[side] = made[side] + mates_ease_off(pair, one.nodes, mate.nodes, mate.mean)
    return made


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


def _steps_before(path: Path | None) -> dict[str, dict[str, float]]:
    import json

    if path is None:
        return {}
    try:
        given = json.loads(path.read_text(encoding="utf-8"))
        return {
            name: {n: float(v) for n, v in steps.items()} for name, steps in given["total"].items()
        }
    except (OSError, ValueError, KeyError, AttributeError, TypeError) as error:
        said = f"{path} ({error})"
        raise DesignError(
            [Problem("--on-machine", said, "a file that --save wrote", "--on-machine steps.json")]
        ) from None


def _save(path: Path, corrections: list[Correction]) -> None:
    import json

    from hypoid.io import write_text

    total = {" ".join(c.setup.sides): dict(c.total) for c in corrections}
    text = json.dumps({"units": "mm, rad, plain", "total": total}, indent=1)
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


def _shown_key(kind: str, name: str) -> tuple[str, float]:
    """Key with its unit, and what a value is multiplied by."""
    if kind == "angle":
        return f"{name}_deg", degrees(1.0)
    return (f"{name}_mm", 1.0) if kind == "length" else (name, 1.0)


def _table(c: Correction) -> dict[str, Any]:
    from hypoid.inspect import gears_after, readings

    steps: dict[str, float] = {}
    new: dict[str, float] = {}
    for one in readings(c):
        key, unit = _shown_key(one.adjustment.kind, one.adjustment.name)
        steps[key], new[key] = one.step * unit, one.value * unit
    return {
        "sides": c.setup.sides,
        "machine": c.setup.machine,
        "free": c.free,
        "steps": steps,
        "new_settings": new,
        "gears": gears_after(c),
        "rank": c.rank,
        "converged": c.converged,
        "at_bounds": c.at_bounds,
        "rms_before_um": c.rms_before * UM,
        "rms_predicted_um": c.rms_predicted * UM,
        "predicted_um": {s: m * UM for s, m in c.predicted.items()},
        "uncertainty_um": {s: m * UM for s, m in c.uncertainty.items()},
        "undecided": [n.words for n in c.null],
    }


def _show(corrections: list[Correction], found: Comparison) -> None:
    from hypoid.inspect import gears_after, readings

    for c in corrections:
        lines = [(r.adjustment.name, r.words) for r in readings(c)]
        write_table(f"{c.setup.name} on {c.setup.machine}", ["step", "new reading"], lines)
        for name, teeth in gears_after(c).items():
            say(f"{name.replace('_', ' ')}: {teeth}.")
        say(
            f"{c.setup.name}: {c.rms_before * UM:.2f} um rms before, {c.rms_predicted * UM:.2f} um predicted; "
            f"{c.rank} of {len(c.free)} directions corrected, the noise leaves the rest undecided."
        )
        for name in c.at_bounds:
            say(f"{name} stands at its bound.")
        if not c.converged:
            say("Not converged: take it as a first step, cut, and measure again.")
        for null in c.null:
            say(f"Undecided: {null.words}.")
    alone: list[Side] = [s for c in corrections if len(c.setup.sides) == 1 for s in c.setup.sides]
    if found.thickness is not None and len(alone) == 2:
        turn = degrees(abs(found.thickness) / found.sides[alone[0]].nodes.radius) * 60.0
        say(
            f"Tooth thickness {found.thickness * UM:+.1f} um: the index's affair, a turn of the work by "
            f"{turn:.2f} min between both cuts."
        )


def _contact_table(states: Mapping[str, Mapping[Any, ContactState]]) -> dict[str, Any]:
    return {
        name: {
            direction: {
                "transmission_error_peak_to_peak_arcsec": degrees(s.transmission_error) * ARCSEC,
                "contact_point": dict(
                    zip(("cone_distance_mm", "height_mm"), s.contact.contact_point, strict=True)
                ),
                "pattern_centre": dict(
                    zip(("cone_distance_mm", "height_mm"), s.centre, strict=True)
                ),
                "pattern_share": s.pattern.share,
                "edge_contact": s.contact.edge_contact,
            }
            for direction, s in both.items()
        }
        for name, both in states.items()
    }


def _show_contact(states: Mapping[str, Mapping[Any, ContactState]]) -> None:
    columns = {
        f"{direction} {name}": {
            "TE peak to peak [arcsec]": degrees(s.transmission_error) * ARCSEC,
            "contact point S, H [mm]": tuple(round(v, 3) for v in s.contact.contact_point),
            "pattern's middle S, H [mm]": tuple(round(v, 3) for v in s.centre),
            "pattern, share of the flank": s.pattern.share,
            "edge contact": "yes" if s.contact.edge_contact else "no",
        }
        for name, both in states.items()
        for direction, s in both.items()
    }
    write_members("contact, unloaded", dict(sorted(columns.items())))
