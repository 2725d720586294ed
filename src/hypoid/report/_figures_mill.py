"""Blades of face-mill and Tri-Ac heads in the plane of the cutter axis, to scale, and the Tri-Ac head."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, degrees, pi, sin

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypoid.cutter import FaceMillHead, PlanePiece, TriAcHead
from hypoid.pair import GearPair, Head, Member

from ._style import BLACK, GREY, ORANGE, PINION, VERMILION, WHEEL, dimension, figure

COLOURS = {"fillet": ORANGE, "toprem": VERMILION, "flankrem": VERMILION, "land": BLACK}


def blades_figure(pair: GearPair) -> Figure:
    """Both members' blades: outside blade (concave flank) and inside blade (convex flank)."""
    heads = any(isinstance(member.head, TriAcHead) for member in (pair.pinion, pair.wheel))
    drawn = figure(7.0 if heads else 3.8)
    rows = drawn.subplots(1 + heads, 2, squeeze=False)
    members = (pair.pinion, PINION), (pair.wheel, WHEEL)
    for column, (member, colour) in enumerate(members):
        _blades(rows[-1, column], member, colour)
        if isinstance(member.head, TriAcHead):
            _head(rows[0, column], member.head, member.name)
        elif heads:
            rows[0, column].axis("off")
    return drawn


def _head(axes: Axes, head: TriAcHead, name: str) -> None:
    """A Tri-Ac head along its axis: where its blades stand and how they are turned."""
    radius = head.outer.radius
    round_it = np.linspace(0.0, 2.0 * pi, 200)
    axes.plot(radius * np.cos(round_it), radius * np.sin(round_it), color=GREY, linewidth=0.9)
    for k in range(head.blade_groups):
        for blade, colour, behind in (
            (head.outer, VERMILION, 0.0),
            (head.inner, BLACK, head.following),
        ):
            turn = 2.0 * pi * k / head.blade_groups + behind
            lean, reach = turn - blade.eccentric_angle, 0.11 * radius
            x, y = blade.radius * cos(turn), blade.radius * sin(turn)
            axes.plot(
                [x - reach * cos(lean), x + reach * cos(lean)],
                [y - reach * sin(lean), y + reach * sin(lean)],
                color=colour,
                linewidth=2.5,
            )
    for colour, words in ((VERMILION, "outer (concave flank)"), (BLACK, "inner (convex flank)")):
        axes.plot([], [], color=colour, linewidth=2.5, label=words)
    axes.annotate(
        f"$r_b$ {head.outer.radius:.5g}, {head.inner.radius:.5g} mm\n"
        f"spacing {degrees(head.following):.5g} deg\n"
        f"eccentric angle {degrees(head.outer.eccentric_angle):.4g} deg",
        (0.0, 0.0),
        ha="center",
        va="center",
        fontsize=7.5,
    )
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(f"{name}, {head.blade_groups} groups, seen along the axis")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), fontsize=7.5)


def plane_outline(piece: PlanePiece, high: float) -> np.ndarray:
    """Points (n, 2) of a profile piece up to s = high: x towards the metal, z to the tip, mm."""
    return np.array([piece.at(s)[:2] for s in np.linspace(piece.low, high, 40)])


def _blades(axes: Axes, member: Member, colour: str) -> None:
    """Outside blade to the right, inside blade to the left, their tips up, as far as the tooth needs."""
    together = member.heads["concave"] is member.heads["convex"]
    corners: list[float] = []
    for flank in (member.concave, member.convex):
        blade = _drawn(member.heads[flank.side], outside=flank.side == "concave")
        side = 1.0 if flank.side == "concave" else -1.0
        for piece in blade.outline:
            if piece.name == "land" and not together:
                continue
            made = flank.pieces.get(piece.name)
            high = piece.high if made is None else min(piece.high, float(made.high))
            x, z = plane_outline(piece, high).T
            axes.plot(
                blade.radius + side * x,
                z,
                color=COLOURS.get(piece.name, colour),
                linewidth=2.0,
            )
        corners.append(blade.corner * side + blade.radius)
        text = f"{'outside' if side > 0 else 'inside'} blade, {flank.side} flank\n{blade.words}"
        axes.annotate(
            text,
            (corners[-1], 0.0),
            xytext=(side * 8, 12),
            textcoords="offset points",
            ha="left" if side > 0 else "right",
            fontsize=7.5,
        )
    axes.axhline(0.0, color=GREY, linewidth=0.6, dashes=(6, 3))
    low = axes.get_ylim()[0]
    if together:
        ends = (min(corners), low), (max(corners), low)
        dimension(
            axes, ends[0], ends[1], f"{abs(corners[0] - corners[1]):.4g}", offset=(0.0, -10.0)
        )
    axes.set_aspect("equal")
    axes.margins(0.6 if isinstance(member.head, TriAcHead) else 0.3, 0.35)
    hob = isinstance(member.head, TriAcHead)
    axes.set_xlabel("across the slot [mm]" if hob else "radius from the cutter axis [mm]")
    axes.set_ylabel("from the plane of the tips [mm]")
    words = "both flanks at once" if together else "each flank by its own cutter"
    ends = "" if hob else f": {corners[1]:.5g} and {corners[0]:.5g} mm"
    axes.set_title(f"{member.name}, {words}{ends}")


@dataclass(frozen=True)
class Drawn:
    """A blade as a figure shows it; mm."""

    outline: tuple[PlanePiece, ...]
    radius: float  # where x of the outline is 0
    corner: float  # x at which the flat ends
    words: str


def _drawn(head: Head, outside: bool) -> Drawn:
    if isinstance(head, TriAcHead):
        stick = head.outer if outside else head.inner
        words = f"{degrees(stick.blade_angle):.5g} deg, edge {stick.edge_radius:.3g} mm"
        outline = stick.outline(0.5 * head.tip_slot)
        apart = (0.5 if outside else -0.5) * head.pitch_slot  # as both cut one slot
        return Drawn(outline, apart, stick.tip, words)
    assert isinstance(head, FaceMillHead)
    blade = head.outer if outside else head.inner
    assert blade is not None
    words = f"{degrees(blade.angle):.4g} deg, edge {blade.edge_radius:.3g} mm"
    return Drawn(tuple(blade.outline), blade.point_radius, 0.0, words)
