"""What a tooth is like as it is cut: lands, depths, necks and points, each with its place."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._tooth import SIDES, Tooth, ToothGrid

Array = np.ndarray[Any, Any]
PLACES = ("toe", "mean", "heel")


@dataclass(frozen=True)
class ToothSection:
    """A tooth at one cone distance; lengths in mm, widths along the arc about the axis."""

    place: str
    cone_distance: float
    top_land: float
    thickness: float  # on the pitch cone
    slot_width: float  # on the pitch cone
    slot_bottom: float  # between the lowest lines of both fillets
    whole_depth: float  # tip to the lowest point, along the pitch cone's normal
    nominal_depth: float  # face cone to root cone


@dataclass(frozen=True)
class Neck:
    """Where a flank overhangs: the tooth is thinner below (undercut)."""

    flank: str
    cone_distance: float  # mm
    height: float  # mm, of the steepest overhang
    pressure_angle: float  # rad, negative


@dataclass(frozen=True)
class ToothFacts:
    """A tooth's sections at toe, mean and heel, and what is wrong with it and where."""

    sections: tuple[ToothSection, ...]
    necks: tuple[Neck, ...]  # the deepest of each flank, if any
    pointed: tuple[float, float] | None  # from which to which cone distance, mm
    secondary_face_angle: float | None  # rad, of the line along the tips of a pointed end


def tooth_facts(tooth: Tooth, grid: ToothGrid | None = None) -> ToothFacts:
    """Sections and faults of a tooth, read off its grid (61 x 61 by default)."""
    grid = grid or tooth.grid()
    middle = len(grid.distance) // 2
    sections = tuple(
        _section(tooth, grid, place, k)
        for place, k in zip(PLACES, (0, middle, len(grid.distance) - 1), strict=True)
    )
    necks = tuple(neck for side in SIDES if (neck := _neck(tooth, grid, side)) is not None)
    pointed = np.flatnonzero(grid.pointed)
    if not len(pointed):
        return ToothFacts(sections, necks, None, None)
    ends = float(grid.distance[pointed[0]]), float(grid.distance[pointed[-1]])
    if len(pointed) < 2:
        return ToothFacts(sections, necks, ends, None)
    slope = float(np.polyfit(grid.distance[pointed], grid.tip[pointed], 1)[0])
    cone = tooth.concave.cone
    pitch_angle = math.atan2(float(cone.sine), float(cone.cosine))
    return ToothFacts(sections, necks, ends, pitch_angle + math.atan(slope))


def _section(tooth: Tooth, grid: ToothGrid, place: str, k: int) -> ToothSection:
    distance, flank = float(grid.distance[k]), tooth.concave
    low = min(
        float(grid.bottom_height[k].min()), *(float(grid.side(s).height[k, 0]) for s in SIDES)
    )

    def across(angle: float, height: float) -> float:
        return angle * float(flank.cone.axial_radial(distance, height)[1])

    return ToothSection(
        place=place,
        cone_distance=distance,
        top_land=across(float(grid.convex.angle[k, -1] - grid.concave.angle[k, -1]), grid.tip[k]),
        thickness=float(tooth.thickness([distance])[0]),
        slot_width=float(tooth.slot_width([distance])[0]),
        slot_bottom=across(float(grid.bottom_angle[k, -1] - grid.bottom_angle[k, 0]), low),
        whole_depth=float(grid.tip[k]) - low,
        nominal_depth=float(flank.tip.at(distance) - flank.root.at(distance)),
    )


def _neck(tooth: Tooth, grid: ToothGrid, side: Any) -> Neck | None:
    """The place of a flank whose normal points deepest below the pitch cone; None if none does."""
    profile, flank = grid.side(side), tooth.flank(side)
    sine, cosine = float(flank.cone.sine), float(flank.cone.cosine)
    up = profile.normal[..., 0] * cosine - profile.normal[..., 2] * sine
    if np.isnan(up).all():
        return None
    k, row = np.unravel_index(int(np.nanargmin(up)), up.shape)
    if up[k, row] >= 0.0:
        return None
    return Neck(
        flank.name,
        float(grid.distance[k]),
        float(profile.height[k, row]),
        math.asin(float(up[k, row])),
    )
