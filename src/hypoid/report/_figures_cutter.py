"""The face-hob head along its axis, and the profile of its blades."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypoid.cutter import Blade, FaceHobHead

from ._style import BLACK, GREY, ORANGE, PINION, VERMILION, WHEEL, dimension, figure

RELIEF_SCALE = 50.0  # how much the tip relief is drawn larger than it is


def cutter_figure(pinion: FaceHobHead, wheel: FaceHobHead) -> Figure:
    """Head with slope angle, and both members' blades (outer blade; the inner one mirrors it)."""
    drawn = figure(4.4)
    row = drawn.subplots(1, 3, width_ratios=(1.2, 1.0, 1.0))
    _head(row[0], wheel)
    _blade(row[1], pinion.outer, "pinion, outer blade", PINION)
    _blade(row[2], wheel.inner, "wheel, inner blade", WHEEL)
    return drawn


def _head(axes: Axes, head: FaceHobHead) -> None:
    angle = np.linspace(0.0, 2.0 * pi, 200)
    base = head.radius * sin(head.slope_angle)
    for radius, style in ((head.radius, "-"), (base, "--")):
        axes.plot(radius * np.cos(angle), radius * np.sin(angle), style, color=GREY, linewidth=0.9)
    for k in range(2 * head.blade_groups):
        turn = k * pi / head.blade_groups
        outer = k % 2 == 0
        x, y = head.radius * cos(turn), head.radius * sin(turn)
        dx, dy = cos(turn - head.slope_angle), sin(turn - head.slope_angle)
        reach = 0.16 * head.radius
        colour = VERMILION if outer else BLACK
        axes.plot(
            [x - reach * dx, x + reach * dx],
            [y - reach * dy, y + reach * dy],
            color=colour,
            linewidth=3,
        )
    axes.plot([], [], color=VERMILION, linewidth=3, label="outer blades (concave flanks)")
    axes.plot([], [], color=BLACK, linewidth=3, label="inner blades (convex flanks)")
    axes.plot([0.0, head.radius], [0.0, 0.0], color=GREY, linewidth=0.7)
    axes.annotate(f"$r_{{c0}}$ = {head.radius:g} mm", (0.3 * head.radius, 3), fontsize=8)
    axes.annotate(
        f"$r_b$ = {base:.2f} mm, $\\nu$ = {np.degrees(head.slope_angle):.3f} deg",
        (0.0, -0.25 * head.radius),
        fontsize=8,
        ha="center",
    )
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(f"head, {head.blade_groups} blade groups, seen along its axis")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0))


def outline(blade: Blade, relief_scale: float = 1.0) -> np.ndarray:
    """Profile (n, 2) of a blade in its front plane: x towards the metal, z to the tip, mm."""
    land, _, flank = blade.profile
    x0, z0 = land.start
    turn = np.linspace(0.0, pi / 2 - blade.pressure_angle, 40)
    radius = blade.edge_radius
    rows = [[x0 + land.low, z0]]
    rows += [[x0 + radius * sin(t), z0 - radius * (1.0 - cos(t))] for t in turn]
    c, s = cos(blade.pressure_angle), sin(blade.pressure_angle)
    for u in np.linspace(flank.low, flank.high, 80):
        rise = relief_scale * flank.relief * max(u - flank.relief_from, 0.0) ** 2
        rows.append([u * s + rise * c, -u * c + rise * s])
    return np.array(rows)


def _blade(axes: Axes, blade: Blade, title: str, colour: str) -> None:
    side = 1.0 if blade.name == "outer" else -1.0
    line = outline(blade, RELIEF_SCALE)
    axes.plot(side * line[:, 0], line[:, 1], color=colour, linewidth=2.0)
    axes.plot([0.0], [0.0], "o", color=BLACK, markersize=4)
    axes.annotate("P", (0, 0), xytext=(5, 4), textcoords="offset points")
    axes.axhline(0.0, color=GREY, linewidth=0.6, dashes=(6, 3))
    low = side * (line[:, 0].min() - 0.5)
    dimension(
        axes,
        (low, 0.0),
        (low, blade.reference_height),
        f"$h_r$ {blade.reference_height:.3f}",
        offset=(side * -4.0, 0.0),
    )
    centre = (blade.profile[1].start[0] * side, blade.reference_height - blade.edge_radius)
    axes.plot(*centre, "+", color=GREY)
    axes.annotate(
        f"$r_t$ {blade.edge_radius:.3f}",
        centre,
        xytext=(4, -10),
        textcoords="offset points",
        fontsize=7.5,
    )
    if blade.relief is not None:
        start = blade.relief.start
        at = (side * start * sin(blade.pressure_angle), -start * cos(blade.pressure_angle))
        axes.plot(*at, "s", color=ORANGE, markersize=4)
        axes.annotate(
            f"relief {blade.relief.coefficient:g}/mm from here,\ndrawn {RELIEF_SCALE:g} times larger",
            at, xytext=(-10 * side, -20), textcoords="offset points", fontsize=7.5,
            ha="right" if side > 0 else "left",
        )  # fmt: skip
    axes.set_aspect("equal")
    axes.margins(0.12)
    axes.set_xlabel("in the front plane [mm]")
    axes.set_ylabel("towards the blade tip [mm]")
    axes.set_title(f"{title}, {np.degrees(blade.pressure_angle):g} deg")
