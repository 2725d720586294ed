"""`hypoid export`."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from hypoid.geometry import DesignError, Problem

from ._export_contact import Direction, Mesh, contact_request, write_model
from ._export_files import ENDINGS, Request, files_of, for_people, target, write_files
from ._options import AsJson, DesignPath, quantities
from ._output import report_faults, write_json, write_members
from ._staged import staged

if TYPE_CHECKING:
    from hypoid.pair import Assumption, GearPair, Member

Signed = Parameter(allow_leading_hyphen=True)


def export(
    file: DesignPath,
    /,
    *,
    stl: Path | None = None,
    ply: Path | None = None,
    obj: Path | None = None,
    glb: Path | None = None,
    step: Path | None = None,
    inp: Path | None = None,
    vtu: Path | None = None,
    points: Path | None = None,
    member: Literal["pinion", "wheel", "both"] = "both",
    teeth: Annotated[str | None, Signed] = None,
    chord_error: Annotated[str, Signed] = "5 um",
    bore: Annotated[str | None, Signed] = None,
    calculix: Path | None = None,
    torque: Annotated[str | None, Signed] = None,
    direction: Direction = "drive",
    position: Annotated[str, Signed] = "0 deg",
    mesh: Mesh = "coarse",
    finer: int = 1,
    youngs_modulus: str = "206 GPa",
    poissons_ratio: float = 0.3,
    json: AsJson = False,
) -> int:
    """Teeth with their body as files for CAD, printing, viewing and analysis, one or more a call.

    Of both members OUT.stl becomes OUT-pinion.stl and OUT-wheel.stl. Lengths in the files are mm, in GLB m.

    Parameters
    ----------
    stl
        Surface as triangles, binary STL.
    ply
        The same with normals, PLY.
    obj
        The same with normals, OBJ.
    glb
        Surfaces by name and colour for viewers, GLB.
    step
        Solid for CAD, STEP.
    inp
        Hexahedra for Abaqus and CalculiX.
    vtu
        Hexahedra for viewers, VTU.
    points
        Points and normals of both flanks of a tooth, CSV: OUT-concave.csv and OUT-convex.csv.
    member
        The member wanted.
    teeth
        How many teeth, or "all"; without it all of them as triangles, one as hexahedra or for CAD.
    chord_error
        How far triangles may stand off the exact surfaces: "5 um".
    bore
        Diameter of the bore: "40 mm"; not for a contact model, whose bodies are the design's.
    calculix
        Contact of both members under a torque, input of CalculiX; with as many teeth as it needs, or --teeth.
    torque
        Of a contact model, on the pinion: "110 N m"; the options below are of a contact model, too.
    direction
        The flanks that carry: drive is pinion concave on wheel convex.
    position
        Pinion angle: "12 deg".
    mesh
        How fine its elements are.
    finer
        Elements for one across the flanks where pairs bear: contacts are narrower than usual elements.
    youngs_modulus
        Of both members.
    poissons_ratio
        Of both members.
    """
    given = {"stl": stl, "ply": ply, "obj": obj, "glb": glb, "step": step}
    given |= {"inp": inp, "vtu": vtu, "points": points, "calculix": calculix}
    wanted = {kind: path for kind, path in given.items() if path is not None}
    names = ("pinion", "wheel") if member == "both" else (member,)
    problems = _path_problems(wanted, names)
    count = _teeth(teeth, problems)
    chords, diameter = _lengths(chord_error, bore, problems)
    asked = None
    if calculix is not None:
        material = youngs_modulus, poissons_ratio
        if bore is not None:
            expected = "none: bodies of a contact model are the design's"
            problems.append(Problem("--bore", f'"{bore}"', expected, 'bore_diameter = "40 mm"'))
        asked = contact_request(
            torque, direction, position, *material, mesh, finer, member, problems
        )
    elif torque is not None:
        problems.append(
            Problem(
                "--torque", f'"{torque}"', "a contact model to go with it", "--calculix contact.inp"
            )
        )
    pair = _pair(file, problems)
    members = [] if pair is None else [getattr(pair, name) for name in names]
    if pair is not None:
        sectors = [pair.wheel] if wanted.keys() == {"calculix"} else members
        problems += _request_problems(sectors, count, chords, diameter)
    if problems or pair is None:
        raise DesignError(problems)
    request = Request(count, chords, None if diameter is None else 0.5 * diameter)
    results: list[dict[str, Any]] = []
    faults = list(pair.faults)
    with staged(path.parent for path in wanted.values()) as place:
        if asked is not None and calculix is not None:
            sector = request.of_triangles if request.teeth != "all" else pair.wheel.teeth
            results.append(write_model(pair, asked, sector, place(calculix)))
        for name in names:
            targets = {
                kind: place(target(path, name, names))
                for kind, path in wanted.items()
                if kind != "calculix"
            }
            found, wrong = write_files(getattr(pair, name), targets, request)
            results += found
            faults += wrong
    for result in results:  # where the files were moved to
        result["file"] = str(wanted[result["format"]].parent / Path(result["file"]).name)
    rims = _assumed_rims(members, diameter)
    if json:
        assumed = [asdict(a) for a in (*pair.assumed, *rims)]
        write_json({"files": results, "faults": faults, "assumed": assumed})
    else:
        for title, columns in for_people(results).items():
            write_members(title, columns)
        for rim in rims if wanted.keys() - {"points"} else []:
            print(f"Assumed {rim.value}: {rim.reason}")
    return report_faults(faults)


def _assumed_rims(members: Sequence[Member], bore: float | None) -> list[Assumption]:
    """What the program put in for the bodies below the teeth."""
    from hypoid.pair import Assumption
    from hypoid.solid import RIM, body

    found: list[Assumption] = []
    for member in members:
        ring = body(member)
        for key, given, value in (
            ("bore_diameter", bore or member.bore, 2.0 * ring.bore),
            ("mounting_distance", member.mounting_distance, ring.back),
        ):
            if given is None:
                reason = f"not given; {value:.5g} mm leaves a rim of {RIM:g} whole depths"
                found.append(Assumption(f"{member.name}.body.{key}", reason))
    return found


def _path_problems(wanted: Mapping[str, Path], names: Sequence[str]) -> list[Problem]:
    if not wanted:
        options = ", ".join(f"--{kind}" for kind in ENDINGS)
        expected = f"one or more of {options}"
        return [Problem("command line", "no file to write", expected, "--stl gear.stl")]
    problems: list[Problem] = []
    for kind, path in wanted.items():
        expected = ""
        if path.suffix.lower() not in ENDINGS[kind]:
            expected = f"a file that ends in {' or '.join(ENDINGS[kind])}"
        elif not path.parent.is_dir():
            expected = "a file in a folder that exists"
        elif not os.access(path.parent, os.W_OK) or any(
            os.path.isdir(file)
            for name in names
            for file in files_of(kind, target(path, name, names))
        ):
            expected = "a file that can be written"
        if expected:
            example = f"--{kind} gear{ENDINGS[kind][0]}"
            problems.append(Problem(f"--{kind}", str(path), expected, example))
    return problems


def _teeth(text: str | None, problems: list[Problem]) -> int | Literal["all"] | None:
    if text is None:
        return None
    if text == "all":
        return "all"
    if re.fullmatch(r"[+-]?[0-9]{1,9}", text):
        return int(text)
    problems.append(Problem("--teeth", f'"{text}"', 'a whole number, or "all"', "--teeth 1"))
    return None


def _lengths(
    chord_error: str, bore: str | None, problems: list[Problem]
) -> tuple[float, float | None]:
    """Chord error and bore diameter, mm; of what cannot be read a problem each."""
    found: dict[str, float] = {}
    for option, text in (("--chord-error", chord_error), ("--bore", bore)):
        if text is None:
            continue
        try:
            found |= quantities({option: (text, "length")})
        except DesignError as error:
            problems += error.problems
    return found.get("--chord-error", inf), found.get("--bore")


def _pair(file: Path, problems: list[Problem]) -> GearPair | None:
    import hypoid

    try:
        return hypoid.read(file)
    except DesignError as error:
        problems += error.problems
        return None


def _request_problems(
    members: Sequence[Member], teeth: int | str | None, chords: float, bore: float | None
) -> list[Problem]:
    """What cannot be asked of these members; lengths in mm, an infinite one is one that was not read."""
    from hypoid.solid import chord_problems, largest_bore, ring_problems

    found = [] if chords == inf else chord_problems(chords)
    number = teeth if isinstance(teeth, int) else None
    for member in members:
        found += ring_problems(member, number)
        most = 2.0 * largest_bore(member)
        if bore is not None and not 0.0 < bore < most:
            expected = f"a diameter between 0 and {most:.4g} mm for the {member.name}"
            found.append(Problem("bore", f"{bore:g} mm", expected, f'"{0.6 * most:.3g} mm"'))
    named = {"chord_error": "--chord-error", "teeth": "--teeth", "bore": "--bore"}
    return [
        replace(p, path=named[p.path], example=f"{named[p.path]} {p.example}")
        if p.path in named
        else replace(p, example=f"{p.path.split('.')[-1]} = {p.example}")
        for p in found
    ]
