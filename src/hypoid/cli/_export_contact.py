"""`hypoid export --calculix`: what is asked of a contact model, and the file."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from hypoid.geometry import DesignError, Problem
from hypoid.io import QuantityError, parse

from ._load_options import pinion_torque
from ._output import say

if TYPE_CHECKING:
    from hypoid.pair import GearPair

Direction = Literal["drive", "coast"]
Mesh = Literal["coarse", "usual", "fine"]
NM, UM, URAD = 1e-3, 1e3, 1e6
EXAMPLE = '--calculix contact.inp --torque "110 N m"'


@dataclass(frozen=True)
class ContactRequest:
    """A contact model as it is wanted; N mm, rad, MPa."""

    torque: float
    direction: Direction
    position: float
    made_of: Any
    mesh: Mesh
    finer: int


def contact_request(
    torque: str | None,
    direction: Direction,
    position: str,
    youngs_modulus: str,
    poissons_ratio: float,
    mesh: Mesh,
    finer: int,
    member: str,
    problems: list[Problem],
) -> ContactRequest:
    """The request; of what is wrong with it a problem each."""
    from hypoid.load import STEEL, material

    if member != "both":
        expected = "both: a contact model holds pinion and wheel"
        problems.append(Problem("--member", member, expected, EXAMPLE))
    if torque is None:
        problems.append(Problem("--torque", "none", "a torque on the pinion", EXAMPLE))
    value = 0.0 if torque is None else pinion_torque(torque, direction, problems)
    angle = _read("--position", position, "angle", problems)
    if finer < 1:
        problems.append(Problem("--finer", str(finer), "1 or more elements for one", "--finer 4"))
    modulus = _read("--youngs-modulus", youngs_modulus, "stress", problems)
    made_of = STEEL
    try:
        made_of = material("--", modulus, poissons_ratio)
    except DesignError as error:
        problems += error.problems
    return ContactRequest(value, direction, angle, made_of, mesh, finer)


def _read(option: str, text: str, kind: Any, problems: list[Problem]) -> float:
    """A quantity; 1 of what cannot be read, which is a problem."""
    try:
        return parse(text, kind)
    except QuantityError as error:
        example = f'{option} "{error.example}"'
        problems.append(Problem(option, error.given, error.expected, example))
        return 1.0


def write_model(
    pair: GearPair, asked: ContactRequest, teeth: int | None, path: Path
) -> dict[str, Any]:
    """Write the model: what is known of it."""
    from hypoid.io import write_contact
    from hypoid.load import MESHES, contact_model
    from hypoid.report import terminal_progress

    say("Contact model of both members")
    try:
        with terminal_progress() as progress:
            model = contact_model(
                pair,
                asked.direction,
                asked.torque,
                position=asked.position,
                teeth=teeth,
                made_of=asked.made_of,
                elements=MESHES[asked.mesh],
                finer=asked.finer,
                progress=progress,
            )
    except DesignError as error:
        raise DesignError([_by_option(p) for p in error.problems]) from None
    written = write_contact(model, path)
    return {
        "file": str(written),
        "format": "calculix",
        "member": "both",
        "direction": asked.direction,
        "torque_Nm": asked.torque * NM,
        "pinion_angle_deg": degrees(asked.position),
        "teeth_pinion": model.pinion.teeth,
        "teeth_wheel": model.wheel.teeth,
        "nodes": len(model.pinion.nodes) + len(model.wheel.nodes),
        "elements": len(model.pinion.elements) + len(model.wheel.elements),
        "pairs": [met.pair for met in model.pairs],
        "surface_error_um": max(model.surface_error) * UM,
        "expected_rotation_urad": model.guess * URAD,
    }


def _by_option(problem: Problem) -> Problem:
    """A problem of the model by the option that it comes from."""
    if problem.path not in ("teeth", "position", "torque"):
        return problem
    option = f"--{problem.path}"
    example = problem.example if problem.example.startswith("--") else f"{option} {problem.example}"
    return replace(problem, path=option, example=example)
