"""A contact model as input of CalculiX (.inp), and what CalculiX printed (.dat) read back.

Written for version 2.20. Surface-to-surface contact of C3D20: pressures at points within the faces. The pinion's
hub turns as a rigid body; a first step turns it until the teeth bear, a second lets go and puts the torque on.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from hypoid.geometry import DesignError, Problem
from hypoid.load import ContactAnswer, ContactModel, contact_answer
from hypoid.solid import SplitMesh

from ._hex_files import listed, numbered
from ._write import write_text

Array = np.ndarray[Any, Any]
STIFFNESS = 1e7  # N/mm3, pressure per overlap: see `_contact`


def write_contact(model: ContactModel, path: str | Path, *, stiffness: float = STIFFNESS) -> Path:
    """Write a model as `.inp`, whole or not at all; run it with `ccx NAME` (without the ending).

    `stiffness` is pressure per overlap, N/mm3: a lower one than the usual evens the pressures of small elements out.
    """
    suffix = Path(path).suffix.lower()
    if suffix != ".inp":
        given = f"the ending {suffix!r}" if suffix else "no ending"
        raise DesignError([Problem(str(path), given, "a .inp file", "contact.inp")])
    return write_text(path, contact_text(model, stiffness))


def contact_text(model: ContactModel, stiffness: float = STIFFNESS) -> str:
    """The whole input."""
    parts = _heading(model), _bodies(model), _contact(model, stiffness), _steps(model)
    return "\n".join(line for part in parts for line in part) + "\n"


def _heading(model: ContactModel) -> Iterator[str]:
    yield f"** {model.gears.title}: {model.direction}, {model.torque * 1e-3:g} N m on the pinion"
    yield f"** at pinion angle {np.degrees(model.position):g} deg; mm, N, MPa"
    yield "** frame: the pinion's, z along its axis from apex to heel, turned with it to this position"
    yield "** rotation and torque: node rotation, direction 3; by pair: *CONTACT PRINT, moment about z"
    yield (
        f"** faces stand off the exact flanks by at most {model.surface_error[0] * 1e3:.2f} um (pinion) and "
        f"{model.surface_error[1] * 1e3:.2f} um (wheel)"
    )


def _bodies(model: ContactModel) -> Iterator[str]:
    first = 0, len(model.pinion.nodes)
    element = 0, len(model.pinion.elements)
    places = model.pinion.nodes, model.wheel_nodes
    meshes = model.pinion, model.wheel
    for name, mesh, nodes, n, e in zip(
        ("pinion", "wheel"), meshes, places, first, element, strict=True
    ):
        yield f"*NODE, NSET={name}_nodes"
        rows = zip(range(n + 1, n + len(nodes) + 1), *nodes.T.tolist(), strict=True)
        yield from map("%d, %.13g, %.13g, %.13g".__mod__, rows)
        yield f"*ELEMENT, TYPE=C3D20, ELSET={name}"
        own = np.arange(e + 1, e + len(mesh.elements) + 1)
        yield from numbered(np.column_stack([own, mesh.elements + n + 1]))
    turning, rotation = _hub(model)
    yield "*NODE, NSET=hub_centre"
    yield f"{turning}, 0., 0., 0."
    yield "*NODE, NSET=rotation"
    yield f"{rotation}, 0., 0., 0."
    for name, nodes, n in zip(("hub", "held"), model.held, first, strict=True):
        yield f"*NSET, NSET={name}"
        yield from listed(nodes + n + 1)
    yield "*MATERIAL, NAME=gear"
    yield "*ELASTIC"
    yield f"{model.made_of.youngs_modulus:.10g}, {model.made_of.poissons_ratio:.10g}"
    yield "*SOLID SECTION, ELSET=pinion, MATERIAL=gear"
    yield "*SOLID SECTION, ELSET=wheel, MATERIAL=gear"
    for divided, n in zip(model.split, first, strict=True):
        if divided is not None:
            yield from _equations(divided, n)
    yield f"*RIGID BODY, NSET=hub, REF NODE={turning}, ROT NODE={rotation}"


def _equations(split: SplitMesh, after: int) -> Iterator[str]:
    """Nodes, counted from `after` on, that move with others."""
    yield "*EQUATION"
    for node, on, share in zip(split.hung.tolist(), split.on, split.share, strict=True):
        there = np.flatnonzero(share)
        others = list(zip((on[there] + after + 1).tolist(), (-share[there]).tolist(), strict=True))
        for direction in (1, 2, 3):
            terms = [(node + after + 1, 1.0), *others]
            yield f"{len(terms)}"
            for k in range(0, len(terms), 4):
                part = (f"{n}, {direction}, {v:.15g}" for n, v in terms[k : k + 4])
                yield ", ".join(part)


def _contact(model: ContactModel, stiffness: float) -> Iterator[str]:
    """Surfaces and pairs; under 1000 MPa they usually overlap by 0.1 um, a hundredth of what teeth approach by."""
    after = len(model.pinion.elements)
    for met in model.pairs:
        for member, faces, e in (("p", met.pinion_faces, 0), ("w", met.wheel_faces, after)):
            yield from _surface(_named(member, met.pair), faces, e)
    yield "*SURFACE INTERACTION, NAME=flanks"
    yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"
    yield f"{stiffness:.6g}"
    for met in model.pairs:
        yield "*CONTACT PAIR, INTERACTION=flanks, TYPE=SURFACE TO SURFACE"
        yield f"{_named('p', met.pair)}, {_named('w', met.pair)}"


def _surface(name: str, faces: Array, after: int) -> Iterator[str]:
    """Faces (k, 2) of elements that are counted from `after` on."""
    yield f"*SURFACE, NAME={name}, TYPE=ELEMENT"
    yield from map("%d, S%d".__mod__, map(tuple, (faces + np.array([after + 1, 1])).tolist()))


def _steps(model: ContactModel) -> Iterator[str]:
    centre, rotation = _hub(model)
    fixed = "held, 1, 3", f"{centre}, 1, 3", f"{rotation}, 1, 2"
    yield "*BOUNDARY"
    yield from fixed
    yield "*STEP, INC=100"
    yield "*STATIC"
    yield "1., 1., 1.e-3"
    yield "*BOUNDARY"
    yield f"{rotation}, 3, 3, {model.turn * model.guess:.10g}"
    yield "*NODE FILE, FREQUENCY=0"
    yield "U"
    yield "*END STEP"
    yield "*STEP, INC=100"
    yield "*STATIC"
    yield "1., 1., 1.e-3"
    yield "*BOUNDARY, OP=NEW"
    yield from fixed
    yield "*CLOAD"
    yield f"{rotation}, 3, {model.turn * model.torque:.10g}"
    yield "*NODE PRINT, NSET=rotation"
    yield "U, RF"
    yield "*NODE PRINT, NSET=wheel_nodes"
    yield "U"
    for met in model.pairs:
        yield f"*CONTACT PRINT, SLAVE={_named('p', met.pair)}, MASTER={_named('w', met.pair)}"
        yield "CF"
    yield "*CONTACT PRINT"
    yield "CSTR"
    yield "*NODE FILE"
    yield "U"
    yield "*EL FILE"
    yield "S"
    yield "*CONTACT FILE"
    yield "CDIS, CSTR"
    yield "*END STEP"


def _hub(model: ContactModel) -> tuple[int, int]:
    last = len(model.pinion.nodes) + len(model.wheel_nodes)
    return last + 1, last + 2


def _named(member: str, pair: int) -> str:
    return f"{member}{'m' if pair < 0 else ''}{abs(pair)}"


def read_contact(path: str | Path, model: ContactModel) -> ContactAnswer:
    """What CalculiX printed (`.dat`) for a model, in the terms of `loaded_contact`.

    Raises DesignError where the file is not there, or its last step did not end.
    """
    example = "the .dat file of a finished run of this model"
    try:
        text = Path(path).read_text(encoding="ascii", errors="replace")
    except OSError as error:
        given = f"a file that cannot be read ({error.strerror})"
        raise DesignError([Problem(str(path), given, example, "ccx contact")]) from None
    moved = _table(text, "displacements", "WHEEL_NODES", 3)
    turned, force = (_table(text, what, "ROTATION", 3) for what in ("displacements", "forces"))
    loads = {met.pair: _load(text, met.pair) for met in model.pairs}
    lacking = [
        name for name, found in (("displacements", moved), ("rotation", turned)) if not len(found)
    ]
    lacking += [f"pair {k}" for k, found in loads.items() if found is None]
    if lacking or len(moved) != len(model.wheel_nodes):
        given = f"no {', '.join(lacking)}" if lacking else f"{len(moved)} nodes of the wheel"
        raise DesignError([Problem(str(path), given, example, "ccx contact")])
    return contact_answer(
        model,
        moved,
        float(turned[-1, 2]),
        float(force[-1, 2]),
        {k: found for k, found in loads.items() if found is not None},
        _peaks(text, model),
    )


def _table(text: str, what: str, name: str, columns: int) -> Array:
    """The last table (n, columns) of a node set, by node."""
    starts = list(re.finditer(rf"^ {what} .* for set {name} and time.*$", text, re.MULTILINE))
    if not starts:
        return np.zeros((0, columns))
    rows: list[list[float]] = []
    for line in text[starts[-1].end() :].lstrip().splitlines():
        words = line.split()
        if len(words) != columns + 1:
            break
        rows.append([float(w) for w in words[1:]])
    return np.array(rows).reshape(-1, columns)


def _load(text: str, pair: int) -> tuple[float, float] | None:
    """Moment about z (N mm) of a pair's contact on the pinion, and the size of its normal force (N)."""
    slave = _named("p", pair).upper()
    found = text.rfind(f"statistics for slave set {slave},")
    if found < 0:
        return None
    part = text[found:].split("statistics for slave set", 2)[1]
    forces = re.search(r"about the origin[^\n]*\s+([^\n]+)", part)
    normal = re.search(r"normal force[^\n]*\s+([^\n]+)", part)
    if forces is None or normal is None:
        return None
    moment, size = float(forces[1].split()[5]), float(normal[1].split()[1])
    return moment, abs(size) if np.isfinite(size) else 0.0


def _peaks(text: str, model: ContactModel) -> dict[int, float]:
    """Greatest pressure, MPa, of each pair at the contact's points."""
    start = text.rfind("contact stress (slave element+face")
    by_element = {int(e): met.pair for met in model.pairs for e in met.pinion_faces[:, 0] + 1}
    found: dict[int, float] = {}
    for line in text[start:].splitlines()[1:] if start >= 0 else ():
        words = line.split()
        if len(words) != 5:
            if words:
                break
            continue
        pair = by_element.get(int(words[0]))
        if pair is not None:
            found[pair] = max(found.get(pair, 0.0), float(words[2]))
    return found
