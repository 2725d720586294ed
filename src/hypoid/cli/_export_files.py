"""The files of `hypoid export`: by the option that asks for them, who writes them and what is said of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from ._output import say

if TYPE_CHECKING:
    from hypoid.pair import Member
    from hypoid.solid import HexMesh, SurfaceMesh

Result = dict[str, Any]
ENDINGS = {
    "stl": (".stl",), "ply": (".ply",), "obj": (".obj",), "glb": (".glb",),
    "step": (".step", ".stp"), "inp": (".inp",), "vtu": (".vtu",), "points": (".csv",),
    "calculix": (".inp",),
}  # fmt: skip
SURFACES = ("stl", "ply", "obj", "glb")
UM = 1e3


def target(path: Path, member: str, members: Sequence[str]) -> Path:
    """The file of one member: its name is added where there are more."""
    return path.with_name(f"{path.stem}-{member}{path.suffix}") if len(members) > 1 else path


def files_of(kind: str, path: Path) -> list[Path]:
    """What an option writes: a file, or one for each flank."""
    if kind != "points":
        return [path]
    from hypoid.io import point_files

    return list(point_files(path).values())


@dataclass(frozen=True)
class Request:
    """What is wanted of each member: the number of teeth, None for the usual one, and lengths in mm."""

    teeth: int | Literal["all"] | None
    chord_error: float
    bore: float | None  # radius

    @property
    def of_triangles(self) -> int | None:
        """Teeth of a mesh of triangles, None for all."""
        return self.teeth if isinstance(self.teeth, int) else None

    @property
    def of_solids(self) -> int | None:
        """Teeth of a solid whose file grows with them, None for all."""
        return 1 if self.teeth is None else self.of_triangles


def write_files(
    member: Member, targets: Mapping[str, Path], request: Request
) -> tuple[list[Result], list[str]]:
    """Write what was asked of a member: what is known of each file, and what is wrong with it."""
    results: list[Result] = []
    faults: list[str] = []
    if "step" in targets:  # first, since it is the one that may lack what it needs
        from hypoid.io import write_step

        say(f"STEP solid of the {member.name}")
        found = write_step(member, targets["step"], teeth=request.of_solids, bore=request.bore)
        faults += found.faults
        known = {k: v for k, v in found.as_dict().items() if k != "path"}
        results.append({**_head("step", found.path, member), **known})
    surfaces = [kind for kind in SURFACES if kind in targets]
    if surfaces:
        from hypoid.io import write_mesh
        from hypoid.solid import surface_mesh

        say(f"Triangles of the {member.name}")
        mesh = surface_mesh(
            member,
            teeth=request.of_triangles,
            chord_error=request.chord_error,
            bore=request.bore,
        )
        for kind in surfaces:
            path = write_mesh(mesh, targets[kind])
            results.append({**_head(kind, path, member), **_surface(mesh)})
    hexahedra = [kind for kind in ("inp", "vtu") if kind in targets]
    if hexahedra:
        from hypoid.io import write_hex
        from hypoid.solid import hex_mesh

        say(f"Hexahedra of the {member.name}")
        solid = hex_mesh(member, teeth=request.of_solids, bore=request.bore)
        for kind in hexahedra:
            path = write_hex(solid, targets[kind])
            results.append({**_head(kind, path, member), **_hexahedra(solid)})
    if "points" in targets:
        from hypoid.io import tooth_points, write_points

        say(f"Points of the {member.name}")
        grids = tooth_points(member)
        paths = write_points(grids, targets["points"])
        for grid, path in zip(grids.values(), paths, strict=True):
            size = {"side": grid.side, "rows": grid.shape[0], "columns": grid.shape[1]}
            results.append({**_head("points", path, member), **size})
    return results, faults


def _head(kind: str, path: Path, member: Member) -> Result:
    return {"file": str(path), "format": kind, "member": member.name}


def _surface(mesh: SurfaceMesh) -> Result:
    from hypoid.solid import STEEL

    return {
        "teeth": mesh.teeth,
        "vertices": len(mesh.vertices),
        "triangles": len(mesh.triangles),
        "chord_error_um": mesh.chord_error * UM,
        "volume_mm3": mesh.volume,
        "mass_kg": mesh.mass(STEEL),
        "density_g_per_cm3": STEEL,
        "watertight": mesh.watertight,
    }


def _hexahedra(mesh: HexMesh) -> Result:
    return {
        "teeth": mesh.teeth,
        "nodes": len(mesh.nodes),
        "elements": len(mesh.elements),
        "least_scaled_jacobian": mesh.quality.scaled_jacobian,
    }


def for_people(results: Sequence[Result]) -> dict[str, dict[str, Result]]:
    """Results by kind of file, to be shown as a table each: file by file what is known of it."""
    titles = {**dict.fromkeys(SURFACES, "Surfaces"), "step": "STEP", "points": "Points"}
    titles["calculix"] = "Contact model"
    shown: dict[str, dict[str, Result]] = {}
    for result in results:
        columns = shown.setdefault(titles.get(result["format"], "Hexahedra"), {})
        flat = {k: v for k, v in result.items() if not isinstance(v, dict | list)}
        if "watertight" in flat:
            flat["watertight"] = "yes" if flat["watertight"] else "no"
        columns[flat.pop("file")] = flat
    return shown
