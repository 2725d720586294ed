"""A tooth, a sector of teeth or a gear of structured hexahedra, with middle nodes on the exact flanks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from hypoid.flank import SIDES, Side, ToothGrid
from hypoid.geometry import DesignError, Problem
from hypoid.pair import Member

from ._body import Body, body
from ._hex_cell import PARTS, Cell, cell, face_nodes
from ._hex_layout import Layout, Root
from ._hex_outline import arc_lengths, bottom_lines, flank_line, has_fillet, joint, tips
from ._hex_quality import Quality, quality
from ._hex_ring import ring
from ._hex_section import Outline, depths, sections
from ._hex_sector import sector
from ._request import ring_problems, tooth_problems

Array = np.ndarray[Any, Any]
ROWS = 61  # of the profiles whose length is measured
ACROSS = 33  # points of a slot's bottom that is looked at
BOTTOM = 4  # most elements of half a slot's bottom
LAND = 0.02  # whole depths: a tooth that comes to a point is meshed up to a land so wide
TURN = 1.0  # rad about the axis, from one end of an element to the other
FILLET = 2  # fewest elements of a fillet: its halves lie on root and tooth
USUAL = {"along": 24, "profile": 8, "fillet": 6, "through": 6, "below": 4, "rim": 5}


@dataclass(frozen=True, eq=False)
class HexMesh:
    """Hexahedra in the member's frame and hand: nodes mm, elements in the order of C3D8 or C3D20.

    Face sets hold elements and the number of their face less one (S1 is 0); together they cover the boundary once.
    Names: concave_flank, convex_flank, concave_fillet, convex_fillet, top_land, slot_bottom, bore, back_face,
    front_face, rim (the ring's outside behind the heel), toe, heel, and where the gear is not whole side_minus and
    side_plus, the one of which is the other turned by the teeth's pitches about z. Node sets are their nodes.
    """

    member: str
    teeth: int  # in the mesh
    whole: bool  # the whole gear
    pitch: float  # rad
    nodes: Float[Array, "n 3"]
    elements: Int[Array, "m k"]
    tooth: Int[Array, " m"]  # of each element, by rising angle about z
    face_sets: Mapping[str, Int[Array, "k 2"]]
    node_sets: Mapping[str, Int[Array, " k"]]
    quality: Quality

    @property
    def quadratic(self) -> bool:
        """Whether elements have 20 nodes."""
        return self.elements.shape[1] == 20

    def face_nodes(self, name: str) -> Int[Array, "k n"]:
        """Nodes of a set's faces: four corners anticlockwise from outside, then the nodes between them."""
        return face_nodes(self.elements, self.face_sets[name])


def hex_mesh(
    member: Member,
    *,
    teeth: int | None = 1,
    along: int = 24,
    profile: int = 8,
    fillet: int = 6,
    through: int = 6,
    below: int = 4,
    rim: int | None = None,
    quadratic: bool = True,
    bore: float | None = None,
    back: float | None = None,
) -> HexMesh:
    """Structured hexahedra of some teeth with their body, conforming; all of them where `teeth` is None.

    Elements are counted along the face, over each flank's profile and fillet, through the tooth, from the slot's
    bottom down to the ring (`below`) and down the ring (`rim`; by default as many as layers that double need).
    `bore` is a radius and `back` the back face's z, mm (see `body`). Middle nodes lie on the exact flanks and fillets.
    A tooth that comes to a point ends where its land would be narrower than 0.02 of the whole depth. Raises
    DesignError where the member has no solid tooth or an element would be turned inside out.
    """
    counts = {
        "along": along,
        "profile": profile,
        "fillet": fillet,
        "through": through,
        "below": below,
    }
    problems = _count_problems(counts, rim) + ring_problems(member, teeth, bore, back)
    if problems:
        raise DesignError(problems)
    tooth, solid = member.tooth, body(member, bore, back)
    grid = tooth.grid(2 * along + 1, ROWS, ACROSS)
    problems = tooth_problems(grid, tooth.pitch, solid, member.name) + _turn_problems(grid, along)
    if problems:
        raise DesignError(problems)
    one = _one(member, grid, solid, counts, rim, quadratic)
    found = quality(one.nodes, one.elements, np.array(PARTS)[one.part])
    if not found.scaled_jacobian > 0.0:
        raise DesignError([_folded(member, found, counts)])
    count = member.teeth if teeth is None else teeth
    whole = count == member.teeth
    made = sector(one, count, tooth.pitch, whole, member.concave.mirrored)
    return HexMesh(
        member=member.name,
        teeth=count,
        whole=whole,
        pitch=tooth.pitch,
        nodes=made.nodes,
        elements=made.elements,
        tooth=made.tooth,
        face_sets=made.face_sets,
        node_sets=made.node_sets,
        quality=found,
    )


def _one(
    member: Member,
    grid: ToothGrid,
    solid: Body,
    counts: dict[str, int],
    rim: int | None,
    quadratic: bool,
) -> Cell:
    """One tooth, in its member's hand."""
    tooth, cone, mirrored = member.tooth, member.concave.cone, member.concave.mirrored
    share = (grid.distance - grid.distance[0]) / np.ptp(grid.distance)
    base = solid.base_height[0] + share * (solid.base_height[1] - solid.base_height[0])
    deep = float((grid.bottom_height - base[:, None]).mean())
    below = ring(solid, share, deep * depths(counts["below"])[1], rim)
    low, high = (_root(member, grid, side, counts) for side in SIDES)
    plan = Layout(
        low, high, counts["through"], counts["profile"], counts["below"], below.z.shape[1] // 2
    )
    depth = member.blank.outer_addendum + member.blank.outer_dedendum
    tip = tips(cone, grid, LAND * depth)
    left, right = bottom_lines(tooth, grid, (low.bottom, high.bottom))
    outline = Outline(
        distance=grid.distance,
        base=base,
        concave_bottom=left,
        concave=flank_line(tooth, grid, "concave", low, plan.height, tip),
        convex=flank_line(tooth, grid, "convex", high, plan.height, tip),
        convex_bottom=right,
        pitch=tooth.pitch,
    )
    line, there = sections(plan, outline, cone)
    made = cell(plan, line, there, below, quadratic, mirrored)
    return replace(made, nodes=made.nodes * member.concave.hand)


def _root(member: Member, grid: ToothGrid, side: Side, counts: dict[str, int]) -> Root:
    """Elements of a root: those of the bottom are about as long as the fillet's, or the flank's."""
    flank, own = member.flank(side), grid.side(side)
    radius = flank.cone.axial_radial(grid.distance, 0.0)[1]
    half = 0.5 * np.ptp(grid.bottom_angle, axis=1) * radius
    count = counts["fillet"] if has_fillet(flank) else 0
    lengths = arc_lengths(flank.cone, grid, side)
    end = joint(flank, grid, side) if count else grid.tip
    long = [np.interp(e, h, s) for e, h, s in zip(end, own.height, lengths, strict=True)]
    element = np.mean(long) / (count or counts["profile"])
    return Root(int(np.clip(round(float(np.mean(half) / element)), 1, BOTTOM)), count)


def _count_problems(counts: dict[str, int], rim: int | None) -> list[Problem]:
    least = {name: FILLET if name == "fillet" else 1 for name in counts}
    given = {**counts, **({} if rim is None else {"rim": rim})}
    return [
        Problem(name, str(count), f"at least {least.get(name, 1)} elements", str(USUAL[name]))
        for name, count in given.items()
        if count < least.get(name, 1)
    ]


def _turn_problems(grid: ToothGrid, along: int) -> list[Problem]:
    """What is wrong with a tooth that winds too far about its axis along one element."""
    turns = [np.abs(grid.side(side).angle[2::2] - grid.side(side).angle[:-2:2]) for side in SIDES]
    turn = float(np.max(turns))
    if not turn > TURN:
        return []
    least = int(np.ceil(along * turn / TURN))
    expected = (
        f"elements along the face that turn by less than {TURN:g} rad each, not {turn:.2f} rad"
    )
    return [Problem("along", str(along), expected, f"along = {least}")]


def _folded(member: Member, found: Quality, counts: dict[str, int]) -> Problem:
    x, y, z = found.scaled_jacobian_place
    distance, height = member.concave.cone.cone_distance_height(z, float(np.hypot(x, y)))
    return Problem(
        f"{member.name} mesh",
        f"an element of the {found.scaled_jacobian_part} turned inside out near S = {distance:.2f} mm, "
        f"H = {height:.2f} mm",
        "a positive Jacobian everywhere; more elements along the face, a greater bore or less undercut",
        f"along = {2 * counts['along']}",
    )
