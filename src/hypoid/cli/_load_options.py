"""What `hypoid load`, `hypoid stress` and a report under torque are asked for, and what they compute."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from hypoid.geometry import DesignError, Problem
from hypoid.io import QuantityError, parse

from ._options import quantities
from ._output import report_faults, say

if TYPE_CHECKING:
    from hypoid.load import LoadedContact, RootStress
    from hypoid.pair import Assumption, GearPair

NM = 1e-3
INTERRUPTED = 130
MOST_ROUNDING = 1.0  # mm
Direction = Literal["drive", "coast"]
Mesh = Literal["coarse", "usual", "fine"]
Face = Literal["bore", "back"]


def _signed(help: str) -> Parameter:
    return Parameter(allow_leading_hyphen=True, help=help)


TORQUE = Parameter(
    allow_leading_hyphen=True,
    negative=(),
    help='Torque on the pinion: "110 N m"; may be repeated.',
)
Figure = Annotated[
    Path | None, Parameter(name=["--figure"], help="A drawing of the results, .svg or .png.")
]
Torques = Annotated[list[str] | None, TORQUE]


ENOUGH = '--torque "110 N m"'


def pinion_torque(text: str, direction: Direction, problems: list[Problem]) -> float:
    """A torque on the pinion, N mm; of what is wrong with it a problem."""
    try:
        value = parse(text, "torque")
    except QuantityError as error:
        example = ENOUGH
        with suppress(QuantityError):  # a number that is too large is none with a unit either
            if parse(error.example, "torque") > 0.0:
                example = f'--torque "{error.example}"'
        problems.append(Problem("--torque", error.given, error.expected, example))
        return 0.0
    if not value > 0.0:
        expected, example = "a torque greater than 0", ENOUGH
        if value < 0.0:
            other = "coast" if direction == "drive" else "drive"
            expected += f"; the other way round is the other direction, {other}"
            example = f'--direction {other} --torque "{text.strip().lstrip("-− ")}"'
        problems.append(Problem("--torque", f'"{text}"', expected, example))
    return value


@Parameter(name="*")
@dataclass(frozen=True)
class LoadOptions:
    """Options of every command that loads a pair."""

    torque: Torques = None
    direction: Annotated[
        Direction,
        Parameter(help="The flanks that carry: drive is pinion concave on wheel convex."),
    ] = "drive"
    positions: Annotated[
        int, Parameter(help="Positions over two pinion pitches, an odd number.")
    ] = 21
    youngs_modulus: Annotated[str, Parameter(help="Of both members.")] = "206 GPa"
    poissons_ratio: Annotated[float, Parameter(help="Of both members.")] = 0.3
    mesh: Annotated[
        Mesh,
        Parameter(
            help="How fine the finite elements are; a design's first run takes half a minute, later ones read it back."
        ),
    ] = "usual"
    pinion_held: Annotated[
        Face | None, Parameter(help="Face that the pinion's shaft holds, where not the design's.")
    ] = None
    wheel_held: Annotated[Face | None, Parameter(help="The same of the wheel.")] = None
    rigid_bearings: Annotated[
        bool,
        Parameter(negative=(), help="Leave out the stiffness of bearings that the design gives."),
    ] = False
    tip_rounding: Annotated[
        str | None,
        _signed("Radius of both members' tips, where not the design's: \"0.2 mm\"."),
    ] = None
    offset: Annotated[
        str, _signed("Error of the offset, as of `hypoid contact`; the other three alike.")
    ] = "0 mm"
    pinion_axial: Annotated[
        str, _signed("Axial error of the pinion, positive where it is withdrawn.")
    ] = "0 mm"
    wheel_axial: Annotated[
        str, _signed("Axial error of the wheel, positive where it is withdrawn.")
    ] = "0 mm"
    shaft_angle: Annotated[str, _signed("Error of the shaft angle, positive where it opens.")] = (
        "0 deg"
    )


@dataclass(frozen=True)
class Request:
    """What was asked for, read and checked as far as that goes without the design."""

    torques: tuple[float, ...]
    direction: Direction
    positions: int
    made_of: Any
    mesh: Mesh
    misalignment: tuple[float, ...]
    held: dict[str, str]  # by member, where not the design's
    rigid: bool  # whether bearings are left out
    tip_rounding: float | None  # mm, where not the design's


def request(options: LoadOptions, figure: Path | None = None) -> Request:
    """The request, or one DesignError with all that is wrong with it."""
    from hypoid.load import STEEL, material

    problems: list[Problem] = []
    direction, positions = options.direction, options.positions
    errors = {
        "--offset": options.offset,
        "--pinion-axial": options.pinion_axial,
        "--wheel-axial": options.wheel_axial,
        "--shaft-angle": options.shaft_angle,
    }
    if not options.torque:
        problems.append(Problem("--torque", "none", "a torque on the pinion", ENOUGH))
    torques = [pinion_torque(text, direction, problems) for text in options.torque or []]
    if positions < 5 or positions % 2 == 0:
        expected = "an odd number, 5 or more"
        problems.append(Problem("--positions", str(positions), expected, "--positions 21"))
    made_of, error = STEEL, ()
    try:
        made_of = material("--", parse(options.youngs_modulus, "stress"), options.poissons_ratio)
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
    rounding = None
    if options.tip_rounding is not None:
        try:
            (rounding,) = quantities({"--tip-rounding": (options.tip_rounding, "length")}).values()
        except DesignError as wrong:
            problems += wrong.problems
        if rounding is not None and not 0.0 <= rounding <= MOST_ROUNDING:
            expected = f"a length from 0 to {MOST_ROUNDING:g} mm"
            example = '--tip-rounding "0.2 mm"'
            problems.append(Problem("--tip-rounding", options.tip_rounding, expected, example))
    if figure is not None and (
        figure.suffix.lower() not in (".svg", ".png") or not figure.absolute().parent.is_dir()
    ):
        expected = "a .svg or .png file in a folder that exists"
        problems.append(Problem("--figure", str(figure), expected, "--figure load.svg"))
    if problems:
        raise DesignError(problems)
    held = {"pinion": options.pinion_held, "wheel": options.wheel_held}
    return Request(
        tuple(torques),
        direction,
        positions,
        made_of,
        options.mesh,
        error,
        {name: face for name, face in held.items() if face},
        options.rigid_bearings,
        rounding,
    )


@dataclass(frozen=True)
class Computed:
    """Loaded contact of a request, with the root stress of each case."""

    loaded: LoadedContact
    stress: tuple[dict[str, RootStress], ...]
    assumed: tuple[Assumption, ...]
    faults: tuple[str, ...]


def computed(pair: GearPair, asked: Request, progress: Callable[[str, int, int], None]) -> Computed:
    """Everything of a request."""
    from hypoid.contact import Misalignment
    from hypoid.load import (
        MESHES,
        RIGID,
        assumptions,
        bearings_of,
        loaded_contact,
        pair_compliance,
        root_stress,
        warnings,
    )

    if asked.tip_rounding is not None:
        pinion, wheel = (
            replace(m, tip_rounding=asked.tip_rounding) for m in (pair.pinion, pair.wheel)
        )
        pair = replace(pair, pinion=pinion, wheel=wheel)
    for words in warnings(pair):
        say(f"Warning: {words}")
    bearings = RIGID if asked.rigid else bearings_of(pair)
    teeth = pair_compliance(
        pair, asked.direction, asked.made_of, MESHES[asked.mesh], progress, asked.held
    )
    loaded = loaded_contact(
        pair,
        asked.direction,
        asked.torques,
        *teeth,
        positions=asked.positions,
        misalignment=Misalignment(*asked.misalignment),
        bearings=bearings,
        progress=progress,
    )
    stress = tuple(
        {m: root_stress(loaded, case, m) for m in ("pinion", "wheel")} for case in loaded.cases
    )
    faults = (*pair.faults, *(f for case in loaded.cases for f in case.faults))
    assumed = assumptions(pair, asked.made_of, asked.held, asked.rigid)
    return Computed(loaded, stress, (*pair.assumed, *assumed), faults)


def computed_for(file: Path, options: LoadOptions, figure: Path | None) -> Computed:
    """Everything that a command line asks for; progress on standard error."""
    asked = request(options, figure)
    import hypoid
    from hypoid.report import terminal_progress

    pair = hypoid.read(file)
    with terminal_progress() as progress:
        return computed(pair, asked, progress)


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
