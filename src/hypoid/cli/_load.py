"""`hypoid load`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from hypoid.geometry import DesignError, Problem
from hypoid.io import QuantityError, parse

from ._options import AsJson, DesignPath, quantities
from ._output import report_faults, say, write_json, write_table

if TYPE_CHECKING:
    from hypoid.load import LoadCase, LoadedContact, LoadedPosition, RootStress
    from hypoid.pair import Assumption

URAD, NM = 1e6, 1e-3
INTERRUPTED = 130
Direction = Literal["drive", "coast"]
Mesh = Literal["coarse", "usual", "fine"]
Signed = Parameter(allow_leading_hyphen=True)
Torques = Annotated[
    list[str] | None,
    Parameter(
        allow_leading_hyphen=True,
        negative=(),
        help='Torque on the pinion: "110 N m"; may be repeated.',
    ),
]
Figure = Annotated[
    Path | None, Parameter(name=["--figure"], help="A drawing of the results, .svg or .png.")
]


def load(
    file: DesignPath,
    /,
    *,
    torque: Torques = None,
    direction: Direction = "drive",
    positions: int = 21,
    youngs_modulus: str = "206 GPa",
    poissons_ratio: float = 0.3,
    mesh: Mesh = "usual",
    offset: Annotated[str, Signed] = "0 mm",
    pinion_axial: Annotated[str, Signed] = "0 mm",
    wheel_axial: Annotated[str, Signed] = "0 mm",
    shaft_angle: Annotated[str, Signed] = "0 deg",
    figure: Figure = None,
    json: AsJson = False,
) -> int:
    """Loaded contact per torque: pressure, load sharing, transmission error, root stress.

    An interrupt (Ctrl-C) keeps the positions that are finished.

    Parameters
    ----------
    direction
        The flanks that carry: drive is pinion concave on wheel convex.
    positions
        Positions over two pinion pitches, an odd number.
    youngs_modulus
        Of both members.
    poissons_ratio
        Of both members.
    mesh
        How fine the finite elements are; the first run of a design takes a minute or more, later ones read it back.
    offset
        Error of the offset, as of `hypoid contact`; the other three alike.
    """
    asked = request(
        torque,
        direction,
        positions,
        youngs_modulus,
        poissons_ratio,
        mesh,
        {
            "--offset": offset,
            "--pinion-axial": pinion_axial,
            "--wheel-axial": wheel_axial,
            "--shaft-angle": shaft_angle,
        },
        figure,
    )
    found = computed(file, asked)
    if figure is not None:
        from hypoid.report import loaded_contact_figure

        write_figure(lambda: loaded_contact_figure(found.loaded), figure)
    cases = [
        _case(case, stress) for case, stress in zip(found.loaded.cases, found.stress, strict=True)
    ]
    if json:
        write_json(
            {
                "direction": direction,
                "complete": found.loaded.complete,
                "cases": cases,
                "assumed": [asdict(a) for a in found.assumed],
            }
        )
    else:
        _show(found)
    return ended(found)


@dataclass(frozen=True)
class Request:
    """What was asked for, read and checked as far as that goes without the design."""

    torques: tuple[float, ...]
    direction: Direction
    positions: int
    made_of: Any
    mesh: Mesh
    misalignment: tuple[float, ...]


def request(
    torque: list[str] | None,
    direction: Direction,
    positions: int,
    youngs_modulus: str,
    poissons_ratio: float,
    mesh: Mesh,
    errors: dict[str, str],
    figure: Path | None,
) -> Request:
    """The request, or one DesignError with all that is wrong with it."""
    from hypoid.load import STEEL, material

    problems: list[Problem] = []
    torques: list[float] = []
    other = "coast" if direction == "drive" else "drive"
    if not torque:
        problems.append(Problem("--torque", "none", "a torque on the pinion", '--torque "110 N m"'))
    for text in torque or []:
        try:
            torques.append(parse(text, "torque"))
        except QuantityError as error:
            problems.append(
                Problem("--torque", error.given, error.expected, f'--torque "{error.example}"')
            )
            continue
        if not torques[-1] > 0.0:
            expected = "a torque greater than 0"
            example = '--torque "110 N m"'
            if torques[-1] < 0.0:
                expected += f"; the other way round is the other direction, {other}"
                example = f'--direction {other} --torque "{text.strip().lstrip("-− ")}"'
            problems.append(Problem("--torque", f'"{text}"', expected, example))
    if positions < 5 or positions % 2 == 0:
        expected = "an odd number, 5 or more"
        problems.append(Problem("--positions", str(positions), expected, "--positions 21"))
    made_of, error = STEEL, ()
    try:
        made_of = material("--", parse(youngs_modulus, "stress"), poissons_ratio)
    except QuantityError as wrong:
        example = f'--youngs-modulus "{wrong.example}"'
        problems.append(Problem("--youngs-modulus", wrong.given, wrong.expected, example))
    except DesignError as wrong:
        problems += wrong.problems
    try:
        kinds = {name: "angle" if name == "--shaft-angle" else "length" for name in errors}
        error = tuple(quantities({n: (t, kinds[n]) for n, t in errors.items()}).values())  # pyright: ignore
    except DesignError as wrong:
        problems += wrong.problems
    if figure is not None and (
        figure.suffix.lower() not in (".svg", ".png") or not figure.absolute().parent.is_dir()
    ):
        expected = "a .svg or .png file in a folder that exists"
        problems.append(Problem("--figure", str(figure), expected, "--figure load.svg"))
    if problems:
        raise DesignError(problems)
    return Request(tuple(torques), direction, positions, made_of, mesh, error)


@dataclass(frozen=True)
class Computed:
    """Loaded contact of a request, with the root stress of each case."""

    loaded: LoadedContact
    stress: tuple[dict[str, RootStress], ...]
    assumed: tuple[Assumption, ...]
    faults: tuple[str, ...]


def computed(file: Path, asked: Request) -> Computed:
    """Everything of a request; progress on standard error."""
    import hypoid
    from hypoid.contact import Misalignment
    from hypoid.load import (
        MESHES,
        assumptions,
        loaded_contact,
        pair_compliance,
        root_stress,
        warnings,
    )
    from hypoid.report import terminal_progress

    pair = hypoid.read(file)
    for words in warnings(pair):
        say(f"Warning: {words}")
    with terminal_progress() as progress:
        teeth = pair_compliance(pair, asked.direction, asked.made_of, MESHES[asked.mesh], progress)
        loaded = loaded_contact(
            pair,
            asked.direction,
            asked.torques,
            *teeth,
            positions=asked.positions,
            misalignment=Misalignment(*asked.misalignment),
            progress=progress,
        )
    stress = tuple(
        {m: root_stress(loaded, case, m) for m in ("pinion", "wheel")} for case in loaded.cases
    )
    faults = (*pair.faults, *(f for case in loaded.cases for f in case.faults))
    return Computed(loaded, stress, (*pair.assumed, *assumptions(pair, asked.made_of)), faults)


def ended(found: Computed) -> int:
    """Exit status, with words for what is wrong or missing."""
    status = report_faults(found.faults)
    if found.loaded.complete:
        return status
    done, all_ = len(found.loaded.cases[0].positions), found.loaded.cases[0].per_pitch
    say(f"Interrupted: {done} of {all_} positions of a pitch are finished, and shown.")
    return INTERRUPTED


def write_figure(draw: Callable[[], Any], path: Path) -> None:
    """A figure as .svg or .png, whole or not at all."""
    from hypoid.report import look, to_png, to_svg

    from ._staged import staged

    with look(), staged([path.parent]) as place:
        if path.suffix.lower() == ".png":
            place(path).write_bytes(to_png(draw()))
        else:
            place(path).write_text(to_svg(draw()), encoding="utf-8")
    say(f"The figure is {path}.")


def _case(case: LoadCase, stress: dict[str, RootStress]) -> dict[str, Any]:
    """One torque under the names that scripts rely on."""
    return {
        "torque_Nm": case.torque * NM,
        "max_pressure_MPa": case.max_pressure,
        "edge_contact": case.edge_contact,
        "contact_ratio_under_load": case.contact_ratio,
        "transmission_error_peak_to_peak_urad": case.peak_to_peak * URAD,
        "transmission_error_harmonics_urad": case.harmonics() * URAD,
        "max_root_stress_MPa": {name: s.max_principal for name, s in stress.items()},
        "max_root_von_mises_MPa": {name: s.max_von_mises for name, s in stress.items()},
        "positions": [_position(p) for p in case.positions],
    }


def _position(at: LoadedPosition) -> dict[str, Any]:
    return {
        "pinion_angle_deg": degrees(at.pinion_angle),
        "max_pressure_MPa": at.max_pressure,
        "pairs_in_contact": len(at.pairs),
        "pairs": [p.pair for p in at.pairs],
        "load_share": [p.share for p in at.pairs],
        "pair_force_N": [p.force for p in at.pairs],
        "pair_max_pressure_MPa": [p.max_pressure for p in at.pairs],
        "edge_contact": at.edge_contact,
        "edges": sorted({p.edge for p in at.pairs if p.edge}),
        "edge_force_N": sum(p.edge_force for p in at.pairs),
        "transmission_error_urad": at.transmission_error * URAD,
        "unloaded_transmission_error_urad": at.unloaded * URAD,
        "stiffness_Nm_per_mrad": at.stiffness * NM * 1e-3,
        "wheel_torque_Nm": at.wheel_torque * NM,
        "pinion_axial_force_N": at.pinion_axial,
        "pinion_radial_force_N": at.pinion_radial,
        "wheel_axial_force_N": at.wheel_axial,
        "wheel_radial_force_N": at.wheel_radial,
        "outcome": at.outcome.value or "ok",
    }


def _show(found: Computed) -> None:
    cases = found.loaded.cases
    rows: list[tuple[str, list[float | int | str]]] = [
        ("greatest pressure [MPa]", [c.max_pressure for c in cases]),
        ("edge contact", ["yes" if c.edge_contact else "no" for c in cases]),
        ("contact ratio under load", [c.contact_ratio for c in cases]),
        ("pairs in contact", [_range([len(p.pairs) for p in c.positions]) for c in cases]),
        ("TE under load, peak to peak [urad]", [c.peak_to_peak * URAD for c in cases]),
        ("TE under load, mean [urad]", [float(c.transmission_error.mean()) * URAD for c in cases]),
        ("root stress, pinion [MPa]", [s["pinion"].max_principal for s in found.stress]),
        ("root stress, wheel [MPa]", [s["wheel"].max_principal for s in found.stress]),
    ]
    title = f"{found.loaded.pair.title}: {found.loaded.direction}"
    write_table(title, [f"{c.torque * NM:g} N m" for c in cases], rows)
    for a in found.assumed:
        print(f"Assumed {a.value}: {a.reason}")


def _range(values: list[int]) -> str:
    low, high = min(values), max(values)
    return str(low) if low == high else f"{low}-{high}"
