"""Volume meshes as files: Abaqus and CalculiX input (.inp), and VTU for viewers (.vtu)."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from hypoid.geometry import DesignError, Problem
from hypoid.solid import HexMesh

from ._write import write_text

Array = np.ndarray[Any, Any]
ON_LINE = 16  # numbers on a line of an input file
TYPES = {8: ("C3D8", "hexahedron"), 20: ("C3D20", "hexahedron20")}


def write_hex(mesh: HexMesh, path: str | Path) -> Path:
    """Write a mesh as `.inp` or `.vtu`, whole or not at all; mm, in the member's frame."""
    suffix = Path(path).suffix.lower()
    if suffix not in (".inp", ".vtu"):
        given = f"the ending {suffix!r}" if suffix else "no ending"
        raise DesignError([Problem(str(path), given, "a .inp or .vtu file", "tooth.inp")])
    return write_text(path, inp_text(mesh) if suffix == ".inp" else vtu_text(mesh))


def inp_text(mesh: HexMesh) -> str:
    """Nodes, elements by teeth, node sets and surfaces by name; for `*INCLUDE` in an analysis."""
    return "\n".join(_inp_lines(mesh)) + "\n"


def _inp_lines(mesh: HexMesh) -> Iterator[str]:
    count = f"{mesh.teeth} {'tooth' if mesh.teeth == 1 else 'teeth'}"
    yield f"** {mesh.member}, {count}; lengths in mm, z along the axis from apex to heel"
    yield "*NODE, NSET=all_nodes"
    rows = zip(range(1, len(mesh.nodes) + 1), *mesh.nodes.T.tolist(), strict=True)
    yield from map("%d, %.13g, %.13g, %.13g".__mod__, rows)
    for tooth in range(mesh.teeth):
        yield f"*ELEMENT, TYPE={TYPES[mesh.elements.shape[1]][0]}, ELSET=tooth_{tooth + 1}"
        own = np.flatnonzero(mesh.tooth == tooth)
        yield from numbered(np.column_stack([own, mesh.elements[own]]) + 1)
    yield "*ELSET, ELSET=all_elements"
    yield from (f"tooth_{tooth + 1}" for tooth in range(mesh.teeth))
    for name, nodes in mesh.node_sets.items():
        yield f"*NSET, NSET={name}"
        yield from listed(nodes + 1)
    for name, faces in mesh.face_sets.items():
        yield f"*SURFACE, NAME={name}, TYPE=ELEMENT"
        yield from map("%d, S%d".__mod__, map(tuple, (faces + 1).tolist()))


def numbered(rows: Array) -> Iterable[str]:
    """Rows of numbers, each on as few lines as may be."""
    parts = np.split(rows, range(ON_LINE, rows.shape[1], ON_LINE), axis=1)
    form = ",\n".join(", ".join(["%d"] * part.shape[1]) for part in parts)
    return map(form.__mod__, map(tuple, rows.tolist()))


def listed(numbers: Array) -> Iterator[str]:
    for start in range(0, len(numbers), ON_LINE):
        yield ", ".join(map(str, numbers[start : start + ON_LINE].tolist()))


def vtu_text(mesh: HexMesh) -> str:
    """Node sets are point data (0 or 1), surfaces cell data (number of the face on it, 0 for none)."""
    import meshio  # takes a while, and is wanted here only

    points: dict[str, Any] = {}
    for name, nodes in mesh.node_sets.items():
        points[name] = np.zeros(len(mesh.nodes), dtype=np.int8)
        points[name][nodes] = 1
    cells: dict[str, Any] = {"tooth": [(mesh.tooth + 1).astype(np.int32)]}
    for name, faces in mesh.face_sets.items():
        which = np.zeros(len(mesh.elements), dtype=np.int8)
        which[faces[:, 0]] = faces[:, 1] + 1
        cells[name] = [which]
    made = meshio.Mesh(
        mesh.nodes,
        [(TYPES[mesh.elements.shape[1]][1], mesh.elements)],
        point_data=points,
        cell_data=cells,
    )
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "mesh.vtu")
        made.write(target)
        return target.read_text(encoding="utf-8")
