"""The tooth as it is cut: sections at toe, mean and heel of both members, to scale."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypoid.flank import SIDES, ToothFacts, ToothGrid
from hypoid.pair import GearPair, Member

from ._style import BLACK, GREY, PINION, STEEL, VERMILION, WHEEL, figure

PLACES = ("toe", "mean", "heel")


def tooth_figure(pair: GearPair) -> Figure:
    """Sections S = const of one tooth and its slots: pinion above, wheel below."""
    drawn = figure(5.0)
    axes = drawn.subplots(2, 3)
    for row, member, colour in zip(axes, (pair.pinion, pair.wheel), (PINION, WHEEL), strict=True):
        grid = member.tooth.grid(3, 81)
        for k, (ax, place) in enumerate(zip(row, PLACES, strict=True)):
            _section(ax, member, grid, k, colour)
            ax.set_title(f"{member.name}, {place}: S = {grid.distance[k]:.5g} mm")
    return drawn


def _section(axes: Axes, member: Member, grid: ToothGrid, k: int, colour: str) -> None:
    """One section, unrolled along the arc about the axis; H upwards."""
    cone, distance = member.concave.cone, float(grid.distance[k])
    middle = 0.5 * float(grid.concave.angle[k, -1] + grid.convex.angle[k, -1])
    _, pitch_radius = cone.axial_radial(distance, 0.0)

    def across(angle: np.ndarray) -> np.ndarray:
        return (angle - middle) * pitch_radius

    pitch = 2.0 * np.pi / member.teeth
    left = across(grid.bottom_angle[k]), grid.bottom_height[k]
    right = across(grid.bottom_angle[k] + pitch), grid.bottom_height[k]
    concave = across(grid.concave.angle[k]), grid.concave.height[k]
    convex = across(grid.convex.angle[k]), grid.convex.height[k]
    outline = np.concatenate(
        [np.array(left), np.array(concave), np.array(convex)[:, ::-1], np.array(right)], axis=1
    )
    floor = outline[1].min() - 0.25 * np.ptp(outline[1])
    axes.fill_between(outline[0], outline[1], floor, color=STEEL, linewidth=0)
    for side, line in zip(SIDES, (concave, convex), strict=True):
        flank = member.flank(side)
        last = len(flank.cut_pieces) - 1
        fillet = (grid.side(side).piece[k] == last) & ("fillet" in flank.pieces)
        axes.plot(*line, color=colour, linewidth=1.8)
        axes.plot(*(np.where(fillet, v, np.nan) for v in line), color=VERMILION, linewidth=1.8)
        axes.annotate(
            side,
            (float(line[0][-1]), float(line[1][-1])),
            xytext=(-7 if side == "concave" else 7, -10),
            textcoords="offset points",
            ha="right" if side == "concave" else "left",
            fontsize=7.5,
        )
    for line in (left, right):
        axes.plot(*line, color=BLACK, linewidth=1.2)
    axes.plot([concave[0][-1], convex[0][-1]], [concave[1][-1], convex[1][-1]], color=BLACK, lw=1.2)
    axes.axhline(0.0, color=GREY, linewidth=0.6, dashes=(6, 3))
    axes.text(0.0, float(grid.tip[k]), "tip", ha="center", va="bottom", fontsize=7.5)
    axes.text(0.0, floor, "root", ha="center", va="bottom", fontsize=7.5)
    axes.set_aspect("equal")
    axes.set_xlabel("along the arc at the pitch cone [mm]")
    axes.set_ylabel("H [mm]")


def tooth_rows(teeth: Mapping[str, ToothFacts]) -> list[tuple[object, ...]]:
    """Lands, thickness and depths of both members at toe, mean and heel, mm."""
    rows: list[tuple[object, ...]] = []
    for member, facts in teeth.items():
        for s in facts.sections:
            widths = (s.top_land, s.thickness, s.slot_width, s.slot_bottom)
            depths = (s.whole_depth, s.nominal_depth)
            rows.append((f"{member}, {s.place}", *(f"{v:.3f}" for v in (*widths, *depths))))
    return rows


def tooth_notes(teeth: Mapping[str, ToothFacts]) -> list[str]:
    """Necks and pointed ends of both members, in words."""
    words: list[str] = []
    for member, facts in teeth.items():
        words += [
            f"{neck.flank}: undercut, a neck with a pressure angle of {degrees(neck.pressure_angle):.2f} deg "
            f"at S = {neck.cone_distance:.2f} mm, H = {neck.height:.3f} mm."
            for neck in facts.necks
        ]
        if facts.pointed:
            start, end = facts.pointed
            more = ""
            if facts.secondary_face_angle is not None:
                more = f"; a secondary face angle of {degrees(facts.secondary_face_angle):.2f} deg follows the tips"
            words.append(
                f"{member}: pointed from S = {start:.2f} to {end:.2f} mm, below the face cone{more}."
            )
    return words
