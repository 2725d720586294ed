"""Blanks of both members as a complete file gives them, from a blank that was designed."""

from __future__ import annotations

from math import cos

from hypoid.blank import GivenBlank, MemberBlank


def given_blank(member: MemberBlank, deeper: float = 0.0) -> GivenBlank:
    """The numbers of a designed member's blank that a drawing would carry, its mean point among them.

    ``deeper`` is what the cutter runs below the designed root cone, mm.
    """
    return GivenBlank(
        pitch_angle=member.pitch_angle,
        outer_cone_distance=member.outer_cone_distance,
        face_width=member.face_width,
        mean_spiral_angle=member.mean_spiral_angle,
        outer_addendum=member.outer_addendum,
        face_angle=member.face_angle,
        outer_dedendum=member.outer_dedendum + deeper / cos(member.dedendum_angle),
        root_angle=member.root_angle,
        outer_face_width=member.outer_face_width,
    )
