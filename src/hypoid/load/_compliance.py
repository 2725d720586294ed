"""Elastic response of a member's teeth to loads on one flank, from its exact tooth with the body below it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from hypoid.flank import SIDES, Side
from hypoid.geometry import DesignError, Problem
from hypoid.pair import Member
from hypoid.solid import HexMesh, hex_mesh

from ._bricks import nodal_stress, stiffness
from ._hats import Hats, hat_loads
from ._kept import kept
from ._layers import Progress, node_places
from ._material import STEEL, Material
from ._superelement import condense, matched, ring

Array = np.ndarray[Any, Any]
FACES = {"bore": "bore", "back": "back_face"}  # by what a design calls them
REACH, SIGHT = 12, 2  # teeth either way whose displacement and whose stress are kept


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
    """Faces of `HexMesh` whose nodes do not move in the member's frame.

    None named: what the design says, else the bore of a pinion-like member, the back face of a wheel-like one.
    """

    held: tuple[str, ...] = ()

    def faces(self, member: Member) -> tuple[str, ...]:
        steep = member.blank.pitch_angle > 0.25 * np.pi
        usual = FACES[member.held or ("back" if steep else "bore")]
        return self.held or (usual,)


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
        return self._own if away == 0 else self.elastic[away % self.teeth]

    @cached_property
    def _own(self) -> Array:
        return self.elastic[0] - self.half_space


def tooth_compliance(
    member: Member,
    side: Side,
    made_of: Material = STEEL,
    elements: Elements | None = None,
    support: Support | None = None,
    progress: Progress = lambda *_: None,
    cache: Path | None = None,
) -> ToothCompliance:
    """Compliance of a member's closed ring of teeth under loads on its `side` flanks.

    20-node bricks on the exact tooth and fillet; computed once and kept on disk, in `cache` or the user's cache
    folder. Raises DesignError where the tooth cannot be meshed or `support` names a face that it does not have.
    """
    counts = (elements or Elements()).counts()
    mesh = hex_mesh(member, teeth=1, quadratic=True, **counts)  # pyright: ignore[reportArgumentType]
    held = _held(mesh, (support or Support()).faces(member))
    nodes = mesh.nodes * member.flank(side).hand
    points, which = _fillet_nodes(mesh)

    def make() -> Mapping[str, Array]:
        return _answers(member, side, mesh, nodes, held, points, made_of, progress)

    contents = (nodes, mesh.elements, mesh.face_nodes(f"{side}_flank"), held, member.teeth, made_of)
    found = kept(contents, make, cache)
    return ToothCompliance(
        member=member.name,
        side=side,
        teeth=member.teeth,
        made_of=made_of,
        hats=Hats(found["distance"], found["height"]),
        elastic={int(n): v for n, v in zip(found["away"], found["elastic"], strict=True)},
        half_space=found["half_space"] / (np.pi * made_of.plane_modulus),
        stress={int(n): v for n, v in zip(found["seen_away"], found["seen"], strict=True)},
        fillet_points=nodes[points],
        fillet_side=which,
        nodes=len(nodes),
    )


def _answers(
    member: Member,
    side: Side,
    mesh: HexMesh,
    nodes: Array,
    held: Array,
    points: Array,
    made_of: Material,
    progress: Progress,
) -> Mapping[str, Array]:
    """Everything that takes time, as arrays."""
    flank = member.flank(side)
    cuts = (mesh.node_sets["side_minus"], mesh.node_sets["side_plus"])
    if flank.mirrored:
        cuts = cuts[::-1]
    loads = hat_loads(
        nodes,
        mesh.face_nodes(f"{side}_flank"),
        flank.cone,
        -1.0 if flank.mirrored else 1.0,
    )
    one = condense(
        stiffness(nodes, mesh.elements, made_of),
        loads.load,
        nodal_stress(nodes, mesh.elements, points, made_of),
        (cuts[0], matched(nodes, cuts[0], cuts[1], mesh.pitch)),
        held,
        node_places(len(nodes), mesh.elements),
        mesh.pitch,
        progress,
    )
    whole = ring(one, member.teeth, REACH, SIGHT)
    return {
        "distance": loads.hats.distance,
        "height": loads.hats.height,
        "half_space": loads.half_space,
        "away": np.array(list(whole.compliance)),
        "elastic": np.array(list(whole.compliance.values())),
        "seen_away": np.array(list(whole.seen)),
        "seen": np.array(list(whole.seen.values())),
    }


def _held(mesh: HexMesh, names: tuple[str, ...]) -> Array:
    unknown = [name for name in names if name not in mesh.node_sets]
    expected = f"a face of the mesh: {', '.join(mesh.node_sets)}"
    if unknown:
        raise DesignError([Problem("held", name, expected, "bore") for name in unknown])
    return np.unique(np.concatenate([mesh.node_sets[name] for name in names]))


def _fillet_nodes(mesh: HexMesh) -> tuple[Array, Array]:
    """Corner nodes of both fillets, and 0 where the fillet is the concave flank's, else 1."""
    made = [
        np.unique(mesh.face_nodes(f"{side}_fillet")[:, :4])
        if f"{side}_fillet" in mesh.face_sets
        else np.zeros(0, dtype=int)
        for side in SIDES
    ]
    return np.concatenate(made), np.repeat([0, 1], [len(nodes) for nodes in made])
