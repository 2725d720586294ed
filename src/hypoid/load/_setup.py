"""From a pair to what a loaded contact needs: both members' compliance, and what was assumed on the way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import ceil, cos, pi

from hypoid.pair import Assumption, Direction, GearPair, Member
from hypoid.solid import RIM, body

from ._compliance import FACES, Elements, Support, ToothCompliance, tooth_compliance
from ._layers import Progress
from ._material import STEEL, Material

BASE_SHARE = (
    0.2  # whole depths from the slots down to the ring's base line (see `hypoid.solid.body`)
)
LONGEST = (
    3.5  # an element on the flank, along the tooth, over its height: beyond, line loads are off
)
MESHES: Mapping[str, Elements] = {
    "coarse": Elements(along=12, profile=5, fillet=2, through=2, below=1, rim=1),
    "usual": Elements(along=20, profile=8, fillet=6, through=4, below=2, rim=2),
    "fine": Elements(along=28, profile=10, fillet=8, through=6, below=3, rim=3),
}


def pair_compliance(
    pair: GearPair,
    direction: Direction,
    made_of: Material = STEEL,
    elements: Elements | None = None,
    progress: Progress = lambda *_: None,
    held: Mapping[str, str] | None = None,
) -> tuple[ToothCompliance, ToothCompliance]:
    """Compliance of pinion and wheel on the flanks of a direction; from the disk where it was computed before.

    `held` names by member the face, "bore" or "back", that its shaft holds, where it is not the design's. A tooth
    that is long for its depth has more elements along the face than `elements` says, see `elements_of`.
    """
    asked = elements or MESHES["usual"]
    flanks = zip((pair.pinion, pair.wheel), pair.mates(direction), strict=True)
    found = [
        tooth_compliance(
            member,
            flank.side,
            made_of,
            elements_of(member, asked),
            support(member, held),
            progress,
        )
        for member, flank in flanks
    ]
    return found[0], found[1]


def elements_of(member: Member, asked: Elements) -> Elements:
    """As `asked`, with so many along the face that none is longer than `LONGEST` heights, measured along the tooth.

    What lies between load hats is interpolated, and changes over a length of the tooth's depth: a 65 deg pinion's
    tooth is 19 times as long as deep, and with 20 elements line loads at a contact's ends were off by a fifth.
    """
    flank, blank = member.concave, member.blank
    length = (flank.heel - flank.toe) / cos(blank.mean_spiral_angle)
    height = (blank.outer_addendum + blank.outer_dedendum) / asked.profile
    return replace(asked, along=max(asked.along, ceil(length / (LONGEST * height))))


def support(member: Member, held: Mapping[str, str] | None = None) -> Support:
    """How a member is held: as asked, or else as the design says."""
    asked = (held or {}).get(member.name)
    return Support((FACES[asked],) if asked else Support().faces(member))


def rim_thickness(member: Member) -> float:
    """Metal (mm) between the deepest slot and the face by which the body is held."""
    ring, blank = body(member), member.blank
    bases = (ring.toe_base, ring.heel_base)
    extra = BASE_SHARE * (blank.outer_addendum + blank.outer_dedendum)
    if blank.pitch_angle > 0.25 * pi:
        return ring.back - max(z for z, _ in bases) + extra
    return min(rho for _, rho in bases) - ring.bore + extra


def warnings(pair: GearPair) -> tuple[str, ...]:
    """What makes results of a pair doubtful before anything is computed."""
    words: list[str] = []
    for member in (pair.pinion, pair.wheel):
        depth = member.blank.outer_addendum + member.blank.outer_dedendum
        rim = rim_thickness(member)
        if rim < depth:
            words.append(
                f"The {member.name}'s rim is {rim:.3g} mm thick, less than its teeth are deep ({depth:.3g} mm): "
                "how it is held then matters; check bore and mounting distance."
            )
    return tuple(words)


def assumptions(
    pair: GearPair, made_of: Material, held: Mapping[str, str] | None = None, rigid: bool = False
) -> tuple[Assumption, ...]:
    """What the design does not say and the loaded contact needs; `rigid` where its bearings are left out."""
    values = [
        Assumption(
            f"material: E = {made_of.youngs_modulus * 1e-3:g} GPa, nu = {made_of.poissons_ratio:g}",
            "Case-hardened steel where nothing else is asked for; no friction, no plastic flow.",
        )
    ]
    for member in (pair.pinion, pair.wheel):
        face = support(member, held).faces(member)[0].replace("_", " ")
        on_shaft = Assumption(f"{member.name} held at its {face}", "That face keeps its form.")
        if rigid or member.bearing_stiffness is None:
            on_shaft = replace(on_shaft, reason="Shaft and bearings count as rigid.")
        values.append(on_shaft)
        if member.bore is None or member.mounting_distance is None:
            values.append(
                Assumption(
                    f"{member.name} body",
                    f"Where bore or back face is not given, a rim of {RIM:g} whole depths is left.",
                )
            )
    return tuple(values)
