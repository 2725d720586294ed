"""Surface meshes as files: STL, PLY, OBJ and GLB."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from hypoid.geometry import DesignError, Problem
from hypoid.solid import SurfaceMesh

from ._write import write_bytes

SUFFIXES = (".stl", ".ply", ".obj", ".glb")
METRE = 1e-3  # of a mm: GLB's unit, by its standard
TOOTH, CUT, RING = (0.62, 0.66, 0.72), (0.86, 0.55, 0.30), (0.45, 0.48, 0.53)
COLOURS = {
    "concave": (0.27, 0.50, 0.77), "convex": (0.36, 0.66, 0.45), "fillets": (0.85, 0.73, 0.35),
    "top_land": TOOTH, "bottom": TOOTH, "start": CUT, "end": CUT,
}  # fmt: skip


def write_mesh(mesh: SurfaceMesh, path: str | Path) -> Path:
    """Write a mesh whole or not at all, in the format of the path's ending; member's frame.

    STL (binary), PLY and OBJ hold one closed surface in mm, the last two with the vertices' normals. GLB
    holds the surfaces one by one, each shaded by its own normals and named, in metres.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        given = f"the ending {suffix!r}" if suffix else "no ending"
        expected = f"a file that ends in {', '.join(SUFFIXES)}"
        raise DesignError([Problem(str(path), given, expected, "tooth.stl")])
    return write_bytes(path, mesh_bytes(mesh, suffix[1:]), f"tooth{suffix}")


def mesh_bytes(mesh: SurfaceMesh, kind: str) -> bytes:
    """The mesh as the content of a file of one of these kinds: stl, ply, obj, glb."""
    if kind == "glb":
        return _scene(mesh).export(file_type="glb")
    made = _trimesh(mesh.vertices, mesh.triangles, None if kind == "stl" else mesh.normals)
    if kind == "obj":
        header = f"{_title(mesh)}; mm"
        text = made.export(file_type="obj", digits=9, header=header, include_normals=True)
        return text.encode("ascii")
    if kind == "ply":
        return made.export(file_type="ply", vertex_normal=True)
    return made.export(file_type="stl")


def _title(mesh: SurfaceMesh) -> str:
    count = "whole gear" if mesh.whole else f"{mesh.teeth} of its teeth"
    return f"{mesh.member}, {count}, chord error {mesh.chord_error * 1e3:.3g} um"


def _trimesh(vertices: Any, triangles: Any, normals: Any = None) -> Any:
    import trimesh  # takes a while, and is wanted here only

    return trimesh.Trimesh(vertices, triangles, vertex_normals=normals, process=False)


def _scene(mesh: SurfaceMesh) -> Any:
    """Each surface by name, shaded by its own normals, one colour a kind."""
    import trimesh
    from trimesh.visual import TextureVisuals
    from trimesh.visual.material import PBRMaterial

    scene = trimesh.Scene(metadata={"title": _title(mesh)})
    for name in mesh.groups:
        part = _trimesh(*mesh.part(name))
        colour = [round(255 * c) for c in COLOURS.get(name, RING)]
        material = PBRMaterial(
            name=name, baseColorFactor=[*colour, 255], metallicFactor=0.3, roughnessFactor=0.6
        )
        part.visual = TextureVisuals(material=material)
        scale = np.diag([METRE, METRE, METRE, 1.0])
        scene.add_geometry(part, node_name=name, geom_name=name, transform=scale)
    return scene
