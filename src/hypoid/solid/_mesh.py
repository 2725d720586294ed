"""Triangles of a solid's surface, and what a solid weighs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from jaxtyping import Float, Int

Array = np.ndarray[Any, Any]
STEEL = 7.85  # g/cm3
KILOGRAM = 1e-6  # a mm3 of 1 g/cm3
EXACT = ("concave", "convex", "fillets")  # groups whose vertices carry the surface's own normals


@dataclass(frozen=True, eq=False)
class SurfaceMesh:
    """A closed surface of triangles in the member's frame and hand, anticlockwise from outside."""

    member: str
    teeth: int  # in the mesh
    whole: bool  # the whole gear
    vertices: Float[Array, "n 3"]  # mm
    triangles: Int[Array, "m 3"]
    normals: Float[Array, "n 3"]  # unit, outward; exact on the flanks, up to their edges
    groups: Mapping[str, Int[Array, " k"]]  # triangles of each surface, by name
    chord_error: float  # mm, greatest distance of triangles from the exact surfaces, as measured

    @cached_property
    def watertight(self) -> bool:
        """Whether each edge joins two triangles that run along it in opposite senses."""
        a, b = self.triangles.ravel(), np.roll(self.triangles, -1, axis=1).ravel()
        count = len(self.vertices)
        forth = np.sort(a * count + b)
        return bool((np.diff(forth) > 0).all() and (forth == np.sort(b * count + a)).all())

    @cached_property
    def volume(self) -> float:
        """Volume, mm3."""
        return mass_properties(self).volume

    def mass(self, density: float = STEEL) -> float:
        """Mass, kg, of a solid of that density, g/cm3."""
        return self.volume * density * KILOGRAM

    def part(self, name: str) -> tuple[Array, Array, Array]:
        """Vertices (n, 3), triangles (m, 3) and vertex normals (n, 3) of one group, for shading."""
        used, local = np.unique(self.triangles[self.groups[name]], return_inverse=True)
        vertices, triangles = self.vertices[used], local.reshape(-1, 3)
        if name in EXACT:
            return vertices, triangles, self.normals[used]
        a, b, c = np.moveaxis(vertices[triangles], 1, 0)
        area = np.cross(b - a, c - a)
        normals = np.stack(
            [np.bincount(triangles.ravel(), np.repeat(area[:, k], 3), len(used)) for k in range(3)],
            axis=-1,
        )
        return vertices, triangles, normals / np.linalg.norm(normals, axis=1, keepdims=True)


@dataclass(frozen=True)
class MassProperties:
    """What a solid of one density weighs, and how it resists a turn."""

    volume: float  # mm3
    mass: float  # kg
    centre: tuple[float, float, float]  # mm, member's frame
    inertia: Float[Array, "3 3"]  # kg mm2, about the centre, member's axes


def mass_properties(mesh: SurfaceMesh, density: float = STEEL) -> MassProperties:
    """Volume, mass, centre and inertia of the solid that the triangles enclose; density in g/cm3."""
    origin = mesh.vertices.mean(axis=0)
    a, b, c = np.moveaxis((mesh.vertices - origin)[mesh.triangles], 1, 0)
    six = (a * np.cross(b, c)).sum(axis=1)  # six times the volume of each tetrahedron to the origin
    total = a + b + c
    volume = six.sum() / 6.0
    first = (six[:, None] * total).sum(axis=0) / 24.0
    second = np.zeros((3, 3))
    for vector in (a, b, c, total):
        second += (six[:, None] * vector).T @ vector / 120.0
    centre = first / volume
    second -= volume * np.outer(centre, centre)
    kilograms = density * KILOGRAM  # a mm3
    inertia = kilograms * (np.trace(second) * np.eye(3) - second)
    x, y, z = (float(v) for v in centre + origin)
    return MassProperties(float(volume), float(volume) * kilograms, (x, y, z), inertia)
