"""The blank of both members in axial section, to scale."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypoid.blank import MemberBlank
from hypoid.pair import GearPair

from ._style import BLACK, GREY, PINION, STEEL, WHEEL, figure


def blank_figure(pair: GearPair) -> Figure:
    """Axial sections of pinion and wheel: pitch, face and root cones, each to scale."""
    drawn = figure(4.6)
    axes = drawn.subplots(1, 2)
    for one, member, colour in zip(axes, (pair.pinion, pair.wheel), (PINION, WHEEL), strict=True):
        _section(one, member.blank, colour)
    return drawn


def _section(axes: Axes, blank: MemberBlank, colour: str) -> None:
    corners = [*blank.axial_section, blank.axial_section[0]]
    for sign in (1.0, -1.0):
        z, rho = zip(*corners, strict=True)
        axes.fill(z, [sign * r for r in rho], facecolor=STEEL, edgecolor=colour, linewidth=1.3)
        apex = -blank.pitch_apex_beyond_crossing_point
        z_heel, rho_heel = blank.position(blank.outer_cone_distance, 0.0)
        axes.plot([apex, z_heel], [0.0, sign * rho_heel], "-.", color=colour, linewidth=0.9)
    axes.axhline(0.0, color=GREY, linewidth=0.7, dashes=(8, 3, 2, 3))
    axes.plot([0.0], [0.0], "+", color=BLACK, markersize=9)
    axes.annotate("crossing point", (0, 0), xytext=(4, 5), textcoords="offset points", fontsize=7.5)
    axes.plot([apex], [0.0], ".", color=colour)
    axes.annotate(
        "pitch apex", (apex, 0), xytext=(4, -10), textcoords="offset points", fontsize=7.5
    )
    toe = blank.position(blank.inner_cone_distance, blank.inner_addendum)
    heel = blank.position(blank.outer_cone_distance, blank.outer_addendum)
    for place, word, shift in ((toe, "toe", (-14, 6)), (heel, "heel", (3, 6))):
        axes.annotate(word, place, xytext=shift, textcoords="offset points", fontsize=8)
    axes.set_aspect("equal")
    axes.set_xlabel("axial position z [mm]")
    axes.set_ylabel("radius [mm]")
    axes.set_title(f"{blank.name}: {blank.teeth} teeth, {blank.hand} hand")
    axes.margins(0.08)
