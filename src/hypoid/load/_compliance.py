"""Elastic response of a member's teeth to loads on one flank, from its exact tooth with the body below it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hypoid.flank import Side
from hypoid.geometry import DesignError, Problem
from hypoid.pair import Member
from hypoid.solid import hex_mesh

from ._bricks import nodal_stress, stiffness
from ._hats import Hats, hat_loads
from ._material import STEEL, Material
from ._superelement import Progress, condense, matched, ring

Array = np.ndarray[Any, Any]
REACH = 6  # teeth either way whose response is kept


@dataclass(frozen=True)
class Elements:
    """Numbers of elements of a tooth (see `hypoid.solid.hex_mesh`); hats stand on the flank's corner nodes."""

    along: int = 24
    profile: int = 8
    fillet: int = 6
    through: int = 6
    below: int = 3
    rim: int = 2

    def counts(self) -> dict[str, int]:
        return dict(vars(self))


@dataclass(frozen=True)
class Support:
    """How a tooth's body is made and held: faces of `HexMesh` whose nodes do not move in the member's frame."""

    held: tuple[
        str, ...
    ] = ()  # empty: the bore of a pinion-like member, the back face of a wheel-like one

    def faces(self, member: Member) -> tuple[str, ...]:
        steep = member.blank.pitch_angle > 0.25 * np.pi
        return self.held or (("back_face",) if steep else ("bore",))


@dataclass(frozen=True, eq=False)
class ToothCompliance:
    """Response of all teeth of a member to normal loads on one flank; teeth count by rising left-hand angle."""

    member: str
    side: Side
    teeth: int
    made_of: Material
    hats: Hats
    elastic: Mapping[int, Array]  # by tooth: (h, h) mm/N, finite elements
    half_space: Array  # (h, h) mm/N: what a half-space would do on the same tooth
    stress: Mapping[int, Array]  # by tooth: (6 p, h) MPa/N at the fillets' points
    fillet_points: Array  # (p, 3) mm, left hand, at the middle tooth
    fillet_side: Array  # (p,) 0 concave, 1 convex
    nodes: int = field(default=0)  # of the finite elements of a tooth

    def difference(self, away: int) -> Array:
        """K_FE - K_HS (h, h), mm/N: what the cells' own half-space leaves out; K_FE on another tooth."""
        elastic = self.elastic[away % self.teeth]
        return elastic - self.half_space if away == 0 else elastic


def tooth_compliance(
    member: Member,
    side: Side,
    made_of: Material = STEEL,
    elements: Elements | None = None,
    support: Support | None = None,
    progress: Progress = lambda *_: None,
) -> ToothCompliance:
    """Compliance of a member's closed ring of teeth under loads on its `side` flanks.

    20-node bricks on the exact tooth and fillet. Raises DesignError where the tooth cannot be meshed.
    """
    counts = (elements or Elements()).counts()
    mesh = hex_mesh(member, teeth=1, quadratic=True, **counts)  # pyright: ignore[reportArgumentType]
    held = np.unique(
        np.concatenate([_held(mesh.node_sets, f) for f in (support or Support()).faces(member)])
    )
    flank = member.flank(side)
    nodes = mesh.nodes * flank.hand
    cuts = (mesh.node_sets["side_minus"], mesh.node_sets["side_plus"])
    if flank.mirrored:
        cuts = cuts[::-1]
    low, high = cuts[0], matched(nodes, cuts[0], cuts[1], mesh.pitch)
    faces = mesh.face_nodes(f"{side}_flank")
    loads = hat_loads(nodes, faces, flank.cone, -1.0 if flank.mirrored else 1.0)
    points, which = _fillet_nodes(mesh)
    one = condense(
        stiffness(nodes, mesh.elements, made_of),
        loads.load,
        nodal_stress(nodes, mesh.elements, points, made_of),
        (low, high),
        held,
        mesh.pitch,
        progress,
    )
    whole = ring(one, member.teeth, REACH)
    return ToothCompliance(
        member=member.name,
        side=side,
        teeth=member.teeth,
        made_of=made_of,
        hats=loads.hats,
        elastic=whole.compliance,
        half_space=loads.half_space / (np.pi * made_of.plane_modulus),
        stress=whole.seen,
        fillet_points=nodes[points],
        fillet_side=which,
        nodes=len(nodes),
    )


def _held(sets: Mapping[str, Array], name: str) -> Array:
    if name not in sets:
        raise DesignError([Problem("held", name, f"a face of the mesh: {', '.join(sets)}", "bore")])
    return sets[name]


def _fillet_nodes(mesh: Any) -> tuple[Array, Array]:
    """Corner nodes of both fillets, and 0 where the fillet is the concave flank's, else 1."""
    made = [
        np.unique(mesh.face_nodes(f"{s}_fillet")[:, :4])
        for s in ("concave", "convex")
        if f"{s}_fillet" in mesh.face_sets
    ]
    sides = [np.full(len(v), k) for k, v in enumerate(made)]
    if not made:
        return np.zeros(0, dtype=int), np.zeros(0, dtype=int)
    return np.concatenate(made), np.concatenate(sides)
