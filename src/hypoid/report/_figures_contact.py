"""Contact: patterns, motion curves, ease-off, and what misalignment does to them."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hypoid.contact import Pattern, UnloadedContact
from hypoid.flank import Flank

from ._results import DirectionResult, Results
from ._style import BLACK, BLUE, COAST, DRIVE, GREY, MAP, ORANGE, SKY, STEEL, VERMILION, figure

ARCSEC = 180.0 * 3600.0 / np.pi
COLOURS = {"drive": DRIVE, "coast": COAST}
WORDS = {
    "offset": "offset", "pinion_axial": "pinion axial",
    "wheel_axial": "wheel axial", "shaft_angle": "shaft angle",
}  # fmt: skip


def pattern_figure(found: Results) -> Figure:
    """Patterns on both members, drive and coast, with the path of contact."""
    drawn = figure(6.2)
    axes = drawn.subplots(2, 2)
    for row, result in zip(axes, found.both, strict=True):
        contact, marked = result.contact, result.pattern
        if contact is None or marked is None:
            continue
        distance = np.broadcast_to(marked.distance, marked.gap.shape)
        colour = COLOURS[result.direction]
        flank_frame(row[0], contact.pinion_flank)
        _paint(row[0], distance, marked.height, marked, colour)
        row[0].plot(*contact.path, color=BLACK, linewidth=1.6, label="path of contact")
        flank_frame(row[1], contact.wheel_flank)
        _paint(row[1], marked.wheel_distance, marked.wheel_height, marked, colour)
        row[1].plot(*contact.wheel_path, color=BLACK, linewidth=1.6)
        row[0].set_title(f"{result.direction}: {contact.pinion_flank.name}")
        row[1].set_title(f"{result.direction}: {contact.wheel_flank.name}")
        row[0].legend(loc="lower left")
    return drawn


def _outline(axes: Axes, flank: Flank) -> tuple[Any, Any, Any]:
    """The tooth over (S, H), filled; its ends (toe, heel), tip and root heights there."""
    ends = np.array([flank.toe, flank.heel])
    tips, roots = flank.tip.at(ends), flank.root.at(ends)
    axes.fill([*ends, *ends[::-1]], [*roots, *tips[::-1]], color=STEEL, zorder=0)
    return ends, tips, roots


def flank_frame(axes: Axes, flank: Flank) -> None:
    """Outline of the tooth over (S, H), toe and heel, tip and root named."""
    ends, tips, roots = _outline(axes, flank)
    (toe, heel), tip, root = ends, tips.max(), roots.min()
    limit = np.linspace(toe, heel, 60)
    low = np.asarray(flank.active_chart.bounds(limit)[0])
    axes.plot(limit, low, "--", color=GREY, linewidth=0.8)
    axes.annotate("fillet limit", (heel, low[-1]), xytext=(-4, 3), textcoords="offset points",
                  ha="right", fontsize=7, color="#5b6270")  # fmt: skip
    span = 0.06 * (tip - root)
    axes.text(0.5 * (toe + heel), tip + span, "tip", ha="center", fontsize=8)
    axes.text(0.5 * (toe + heel), root - 3 * span, "root", ha="center", fontsize=8)
    axes.text(toe, tip + span, "toe", ha="left", fontsize=8)
    axes.text(heel, tip + span, "heel", ha="right", fontsize=8)
    axes.set_ylim(root - 4 * span, tip + 3 * span)
    axes.set_xlabel("cone distance S [mm]")
    axes.set_ylabel("height H [mm]")


def _paint(axes: Axes, x: Any, y: Any, marked: Pattern, colour: str, alpha: float = 0.55) -> None:
    """The touched area: the gap is cut at the marking thickness, not cell by cell."""
    gap = np.where(np.isfinite(marked.gap), marked.gap, 10.0 * marked.thickness) * 1e3
    if (gap <= marked.thickness * 1e3).any() and np.isfinite(x).all() and np.isfinite(y).all():
        axes.contourf(
            x, y, gap, levels=[-1.0, marked.thickness * 1e3], colors=[colour], alpha=alpha
        )


def motion_figure(found: Results) -> Figure:
    """Motion curves of a pair and its neighbours; the wheel follows the envelope."""
    drawn = figure(3.6)
    for axes, result in zip(drawn.subplots(1, 2), found.both, strict=True):
        if result.contact is not None:
            _motion(axes, result.contact)
    return drawn


def _motion(axes: Axes, contact: UnloadedContact) -> None:
    phi = np.degrees(contact.phi[contact.cycle])
    curves = (contact.pair_curves - contact.index_shift) * ARCSEC
    middle = len(curves) // 2
    shades = {0: VERMILION, 1: BLUE, 2: SKY}
    for k, curve in enumerate(curves):
        apart = abs(k - middle)
        label = {0: "this pair", 1: "pairs before and after", 2: "two away"}.get(apart)
        own = np.where(np.isfinite(curve), curve, np.nan)
        axes.plot(phi, own, color=shades.get(apart, GREY), label=label if k <= middle else None)
    axes.plot(phi, contact.transmission_error * ARCSEC, color=BLACK, linewidth=2.6, alpha=0.5,
              label="wheel (envelope)", zorder=0)  # fmt: skip
    floor = max(15.0, 1.5 * float(np.nan_to_num(np.degrees(contact.peak_to_peak) * 3600.0)))
    axes.set_ylim(-floor, 0.12 * floor)
    axes.set_xlabel("pinion angle [deg]")
    axes.set_ylabel("transmission error [arcsec]")
    pp = np.degrees(contact.peak_to_peak) * 3600.0
    axes.set_title(
        f"{contact.direction}: peak to peak {pp:.3g} arcsec, contact ratio {contact.contact_ratio:.3f}"
    )
    axes.legend(loc="lower center", ncols=2)


def ease_off_figure(found: Results) -> Figure:
    """Ease-off of the pinion against the wheel's conjugate."""
    drawn = figure(3.4)
    for axes, result in zip(drawn.subplots(1, 2), found.both, strict=True):
        ease, contact = result.ease_off, result.contact
        if ease is None or contact is None or not np.isfinite(ease.value).any():
            continue
        flank_frame(axes, contact.pinion_flank)
        um = np.ma.masked_invalid(ease.value * 1e3)
        x = np.broadcast_to(ease.distance, um.shape)
        filled = axes.contourf(x, ease.height, um, levels=14, cmap=MAP)
        lines = axes.contour(
            x, ease.height, um, levels=filled.levels[1::3], colors="white", linewidths=0.6
        )
        axes.clabel(lines, fmt="%.0f", fontsize=7)
        axes.figure.colorbar(filled, ax=axes, label="ease-off [um]")
        axes.set_title(f"{result.direction}: {contact.pinion_flank.name}")
    return drawn


def misalignment_figure(result: DirectionResult) -> Figure:
    """Pattern under each error of mounting, against the aligned one (grey)."""
    drawn = figure(6.4)
    if result.contact is None or result.pattern is None:
        return drawn
    cells = drawn.subplots(3, 4, sharex=True, sharey=True)
    for k, bad in enumerate(result.misaligned):
        step = getattr(bad.numbers.misalignment, bad.error)
        value = f"{np.degrees(step):+.3f} deg" if bad.error == "shaft_angle" else f"{step:+.3f} mm"
        _small(cells[k % 2, k // 2], result, bad.pattern, f"{WORDS[bad.error]} {value}")
    for k, (place, moved) in enumerate(result.vh):
        error = place.misalignment
        title = f"V-H to {place.place}: V {error.offset:+.3f}, H {error.pinion_axial:+.3f} mm"
        if moved is not None:
            _small(cells[2, 2 * k], result, moved, title)
    for axes in cells.ravel():
        if not axes.has_data():
            axes.axis("off")
    for axes in cells[:, 0]:
        axes.set_ylabel("H [mm]")
    drawn.supxlabel(
        "cone distance S of the pinion [mm], toe left, heel right; tip above, root below",
        fontsize=9,
    )
    return drawn


def _small(axes: Axes, result: DirectionResult, moved: Pattern, title: str) -> None:
    aligned = result.pattern
    assert aligned is not None
    assert result.contact is not None
    flank = result.contact.pinion_flank
    _outline(axes, flank)
    distance = np.broadcast_to(aligned.distance, aligned.gap.shape)
    _paint(axes, distance, aligned.height, aligned, GREY, 0.5)
    _paint(axes, distance, moved.height, moved, COLOURS[result.direction], 0.6)
    axes.plot(*moved.centre, "o", color=BLACK, markersize=3)
    axes.plot(*aligned.centre, "x", color=ORANGE, markersize=4)
    axes.set_title(title, fontsize=7.5)
