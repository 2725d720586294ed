"""Stock division: where a slot's second flank stands when each flank is cut by itself.

Its settings leave that open: the work is turned between both cuts until the tooth is as thick as the
backlash asks [notes on lin1996: stock division is an extra input].
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from hypoid.flank import flank_angles
from hypoid.geometry import DesignError, Problem
from hypoid.pair import Member

from ._sheet_spec import SummarySheetSpec, cut_apart


def divided(
    spec: SummarySheetSpec, pinion: Member, wheel: Member, normal_module: float
) -> tuple[Member, Member]:
    """Both members, the first that is cut flank by flank turned for the normal backlash that is asked.

    At the mean point tooth, mating tooth and backlash fill one pitch, all square to the flanks.

    Raises
    ------
    DesignError
        Where backlash is asked of slots that are each cut at once.
    """
    asked = spec.normal_backlash
    apart = [cut_apart(spec.pinion), cut_apart(spec.wheel)]
    if not any(apart):
        if asked is None:
            return pinion, wheel
        given = f"{asked:g} mm"
        expected = "nothing: each member's slot is cut at once, as wide as its point width makes it"
        raise DesignError([Problem("pair.normal_backlash", given, expected, "# normal_backlash")])
    own, mate = (pinion, wheel) if apart[0] else (wheel, pinion)
    room = math.pi * normal_module - (asked or 0.0) - _normal_thickness(mate)
    _, radius = own.blank.position(own.blank.mean_cone_distance, 0.0)
    turn = (room - _normal_thickness(own)) / (_square(own) * radius)
    own = replace(own, stock_turn=turn if np.isfinite(turn) else 0.0)
    return (own, mate) if apart[0] else (mate, own)


def _normal_thickness(member: Member) -> float:
    thickness = member.tooth.thickness([member.blank.mean_cone_distance])
    return float(thickness[0]) * _square(member)


def _square(member: Member) -> float:
    """Cosine of the mean spiral angle, as cut."""
    at = member.blank.mean_cone_distance
    return float(
        np.mean([math.cos(flank_angles(f, at).spiral) for f in (member.concave, member.convex)])
    )
