"""Face-mill heads: the blades of each member in the plane of the cutter axis, to scale."""

from __future__ import annotations

from math import degrees

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypoid.cutter import FaceMillHead, MillBlade, PlanePiece
from hypoid.flank import Flank
from hypoid.pair import GearPair, Member

from ._style import BLACK, GREY, ORANGE, PINION, VERMILION, WHEEL, dimension, figure

COLOURS = {"fillet": ORANGE, "toprem": VERMILION, "flankrem": VERMILION, "land": BLACK}


def mill_figure(pair: GearPair) -> Figure:
    """Both members' blades: outside blade (concave flank) and inside blade (convex flank)."""
    drawn = figure(3.8)
    row = drawn.subplots(1, 2)
    for axes, member, colour in zip(row, (pair.pinion, pair.wheel), (PINION, WHEEL), strict=True):
        _blades(axes, member, colour)
    return drawn


def plane_outline(piece: PlanePiece, high: float) -> np.ndarray:
    """Points (n, 2) of a profile piece up to s = high: x towards the metal, z to the tip, mm."""
    return np.array([piece.at(s)[:2] for s in np.linspace(piece.low, high, 40)])


def _blades(axes: Axes, member: Member, colour: str) -> None:
    """Outside blade to the right, inside blade to the left, their tips up, as far as the tooth needs."""
    together = member.heads["concave"] is member.heads["convex"]
    corners: list[float] = []
    for flank, blade in _blades_of(member):
        side = 1.0 if blade.name == "outer" else -1.0
        for piece in blade.outline:
            if piece.name == "land" and not together:
                continue
            made = flank.pieces.get(piece.name)
            high = piece.high if made is None else min(piece.high, float(made.high))
            x, z = plane_outline(piece, high).T
            axes.plot(
                blade.point_radius + side * x,
                z,
                color=COLOURS.get(piece.name, colour),
                linewidth=2.0,
            )
        corners.append(blade.point_radius)
        text = [
            f"{'outside' if side > 0 else 'inside'} blade, {flank.side} flank",
            f"{degrees(blade.angle):.4g} deg, edge {blade.edge_radius:.3g} mm",
        ]
        axes.annotate(
            "\n".join(text),
            (blade.point_radius, 0.0),
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
    axes.margins(0.3, 0.35)
    axes.set_xlabel("radius from the cutter axis [mm]")
    axes.set_ylabel("from the plane of the tips [mm]")
    words = "both flanks at once" if together else "each flank by its own cutter"
    axes.set_title(f"{member.name}, {words}: {corners[1]:.5g} and {corners[0]:.5g} mm")


def _blades_of(member: Member) -> list[tuple[Flank, MillBlade]]:
    found: list[tuple[Flank, MillBlade]] = []
    for flank in (member.concave, member.convex):
        head = member.heads[flank.side]
        assert isinstance(head, FaceMillHead)
        blade = head.outer if flank.side == "concave" else head.inner
        assert blade is not None
        found.append((flank, blade))
    return found
