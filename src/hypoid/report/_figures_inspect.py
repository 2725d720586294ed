"""Topographies as the shop knows them: bars on the flank, both flanks side by side; before and after a correction."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypoid.flank import SIDES, Side
from hypoid.inspect import Comparison, Correction, FlankNodes

from ._style import BLACK, BLUE, GREY, STEEL, VERMILION, figure, look, to_png, to_svg

Array = np.ndarray[Any, Any]
TALLEST = 0.9  # of the distance between rows, for a bar of the scale
ROUND = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0)


def topography_figure(found: Comparison) -> Figure:
    """Mean deviations of a member's measured flanks, on one scale; outliers crossed."""
    drawn = figure(3.6)
    sides: list[Side] = [s for s in SIDES if s in found.sides]
    axes = drawn.subplots(1, 2)
    scale = _scale([found.sides[s].mean for s in sides])
    for ax, side in zip(axes, SIDES, strict=True):
        if side not in found.sides:
            ax.axis("off")
            continue
        one = found.sides[side]
        out = np.asarray(one.outlier.any(axis=0)).reshape(one.nodes.shape)
        _bars(ax, one.nodes, one.mean, scale, mirrored=side == "convex", marked=out)
        ax.set_title(f"{found.grid.member.name} {side}: {_words(one.mean)}")
    _legend(drawn, scale)
    return drawn


def correction_figure(
    corrections: Sequence[Correction], nodes: Mapping[Side, FlankNodes]
) -> Figure:
    """Deviations from the target as measured, and predicted after the correction; one scale."""
    drawn = figure(6.4)
    axes = drawn.subplots(2, 2)
    maps = [m for c in corrections for part in (c.before, c.predicted) for m in part.values()]
    scale = _scale(maps)
    shown = {s: c for c in corrections for s in c.setup.sides}
    for row, name in zip(axes, ("before", "predicted"), strict=True):
        for ax, side in zip(row, SIDES, strict=True):
            if side not in shown:
                ax.axis("off")
                continue
            value = (shown[side].before if name == "before" else shown[side].predicted)[side]
            _bars(ax, nodes[side], value, scale, mirrored=side == "convex")
            ax.set_title(f"{name}, {nodes[side].flank.name}: {_words(value)}")
    _legend(drawn, scale)
    return drawn


def topography_image(found: Comparison, suffix: str) -> bytes:
    """A comparison as the bytes of an SVG or PNG file."""
    return _image(lambda: topography_figure(found), suffix)


def correction_image(
    corrections: Sequence[Correction], nodes: Mapping[Side, FlankNodes], suffix: str
) -> bytes:
    """A correction as the bytes of an SVG or PNG file."""
    return _image(lambda: correction_figure(corrections, nodes), suffix)


def _image(draw: Any, suffix: str) -> bytes:
    with look():
        drawn = draw()
        return to_png(drawn) if suffix.lower() == ".png" else to_svg(drawn).encode()


def _scale(maps: Sequence[Array]) -> float:
    """A round deviation, mm, that the tallest bars come near to."""
    most = max((float(np.nanmax(np.abs(m))) for m in maps if np.isfinite(m).any()), default=1e-3)
    most = max(most, 1e-4)
    step = 10.0 ** np.floor(np.log10(most))
    return float(step * min(k for k in ROUND if k * step >= most - 1e-15))


def _words(value: Array) -> str:
    rms = float(np.sqrt(np.nanmean(value**2))) * 1e3
    return f"{rms:.1f} um rms, largest {float(np.nanmax(np.abs(value))) * 1e3:.1f} um"


def _bars(
    axes: Axes,
    nodes: FlankNodes,
    value: Array,
    scale: float,
    *,
    mirrored: bool,
    marked: Array | None = None,
) -> None:
    """Bars at the grid's points, up where material stands out; toes meet in the middle of both flanks."""
    flank, way = nodes.flank, -1.0 if mirrored else 1.0
    way = -way  # concave on the left with its heel outside, convex on the right
    ends = np.array([flank.toe, flank.heel])
    tips, roots = flank.tip.at(ends), flank.root.at(ends)
    axes.fill([*way * ends, *way * ends[::-1]], [*roots, *tips[::-1]], color=STEEL, zorder=0)
    x, y = way * nodes.distance, nodes.height
    rise = TALLEST * float((y[-1] - y[0]).mean()) / max(1, nodes.shape[0] - 1)
    for k in range(nodes.shape[0]):
        axes.plot(x[k], y[k], color=GREY, linewidth=0.5, zorder=1)
        axes.plot(x[k], y[k] + rise * value[k] / scale, color=BLACK, linewidth=0.8, zorder=3)
    there = np.isfinite(value)
    heights = rise * value / scale
    for out, colour in ((True, VERMILION), (False, BLUE)):
        mine = there & ((value > 0.0) == out)
        axes.vlines(x[mine], y[mine], (y + heights)[mine], color=colour, linewidth=2.6, zorder=2)
    if marked is not None and marked.any():
        axes.plot(x[marked], y[marked], "x", color=BLACK, markersize=8, zorder=4)
    row, column = nodes.reference
    axes.plot(
        x[row, column],
        y[row, column],
        "o",
        markerfacecolor="white",
        markeredgecolor=BLACK,
        markersize=5,
        zorder=5,
    )
    for k, (word, side) in enumerate((("toe", -1.0), ("heel", 1.0))):
        place = way * (ends[k] + 0.03 * side * np.ptp(ends)), 0.5 * float(tips[k] + roots[k])
        axes.text(*place, word, rotation=90, ha="center", va="center", fontsize=8)
    for i, j in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
        if there[i, j]:
            right = (way > 0.0) == (j == -1)
            axes.annotate(
                f"{value[i, j] * 1e3:+.1f}",
                (x[i, j], y[i, j]),
                xytext=(6 if right else -6, -3),
                textcoords="offset points",
                ha="left" if right else "right",
                fontsize=7,
            )
    middle = way * float(ends.mean())
    axes.annotate(
        "tip",
        (middle, float(tips.mean())),
        xytext=(0, 9),
        textcoords="offset points",
        ha="center",
        fontsize=8,
    )
    axes.annotate(
        "root",
        (middle, float(roots.mean())),
        xytext=(0, -14),
        textcoords="offset points",
        ha="center",
        fontsize=8,
    )
    width = float(np.ptp(ends))
    axes.set_xlim(way * ends.mean() - 0.6 * width, way * ends.mean() + 0.6 * width)
    depth = float(tips.max() - roots.min())
    axes.set_ylim(float(roots.min()) - 0.2 * depth, float(tips.max()) + 0.2 * depth)
    axes.set_xticks(way * ends, [f"{e:.1f}" for e in ends])
    axes.set_xlabel("S [mm]")
    axes.set_ylabel("H [mm]")


def _legend(drawn: Figure, scale: float) -> None:
    drawn.supxlabel(
        f"Bars: {TALLEST:.0%} of the space between rows is {scale * 1e3:.3g} um; numbers in um. "
        "Orange, up: material stands out; blue, down: it lacks; ring: reference; cross: outlier.",
        fontsize=8,
    )
