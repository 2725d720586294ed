"""What carries the teeth: a ring with bore and back face, in the member's axial section.

Below the slots the solid is a body of revolution. Its outline runs from the toe, where the teeth end on
the cone S = toe, down to a base line below every slot's bottom, over the front face to the bore, along the
bore to the back face, and up to the heel.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hypoid.pair import Member

RIM = 1.5  # whole depths of metal between the slots and bore or back face, where nothing is given
BASE = 0.2  # whole depths between the deepest slot bottom and the base line


@dataclass(frozen=True)
class Body:
    """The ring below the teeth: z and radius (mm) of its corners in the member's frame."""

    toe_base: tuple[float, float]  # on the cone S = toe, below the slots
    heel_base: tuple[float, float]  # on the cone S = heel
    front: float  # z of the front face
    back: float  # z of the back face
    bore: float  # radius
    base_height: tuple[float, float]  # H of the base line at toe and heel, mm

    @property
    def outline(self) -> tuple[tuple[float, float], ...]:
        """Corners (z, radius) from the toe's base by front face, bore and back face to the heel's base."""
        return (
            self.toe_base,
            (self.front, self.bore),
            (self.back, self.bore),
            (self.back, self.heel_base[1]),
            self.heel_base,
        )


def body(member: Member, bore: float | None = None, back: float | None = None) -> Body:
    """The ring of a member by its bore radius and back face's z (mm).

    What is not given is the design's, and where that has none, it leaves a rim of 1.5 whole depths.
    """
    bore = member.bore if bore is None else bore
    back = member.mounting_distance if back is None else back
    flank, blank = member.concave, member.blank
    lines = [member.flank(side).root for side in ("concave", "convex")]
    depth = blank.outer_addendum + blank.outer_dedendum
    heights = [
        min(float(line.at(end)) for line in lines) - BASE * depth for end in (flank.toe, flank.heel)
    ]
    toe, heel = (
        tuple(float(v) for v in flank.cone.axial_radial(end, height))
        for end, height in zip((flank.toe, flank.heel), heights, strict=True)
    )
    # the rim stands square to the pitch cone: mostly inwards on a pinion, mostly backwards on a wheel
    sine, cosine = math.sin(blank.pitch_angle), math.cos(blank.pitch_angle)
    inner = toe[1] - RIM * depth * cosine
    return Body(
        toe_base=toe,  # pyright: ignore[reportArgumentType]
        heel_base=heel,  # pyright: ignore[reportArgumentType]
        front=toe[0],
        back=heel[0] + RIM * depth * sine if back is None else back,
        bore=max(0.3 * toe[1], inner) if bore is None else bore,
        base_height=(heights[0], heights[1]),
    )
