"""Loaded contact: pressure on the flanks, load sharing, transmission error; stress in the root fillets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.ndimage import maximum_filter

from hypoid.flank import Flank
from hypoid.load import LoadCase, LoadedContact, RootStress

from ._figures_contact import flank_frame
from ._style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    MAP,
    ORANGE,
    PINION,
    PURPLE,
    SKY,
    VERMILION,
    WHEEL,
    figure,
)

PAIRS = (BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY)
URAD = 1e6
BINS = (90, 40)  # of a flank's map, along and across


def loaded_contact_figure(loaded: LoadedContact) -> Figure:
    """Pressure over both flanks, Harris map, pressure and share by pair; the last three at the highest torque."""
    drawn = figure(8.4)
    axes = drawn.subplots(3, 2)
    case = loaded.cases[-1]
    words = f"{case.torque * 1e-3:g} N m, {loaded.direction}"
    pinion, wheel = loaded.pair.mates(loaded.direction)
    shown = _pressures(axes[0, 0], pinion, case, "")
    _pressures(axes[0, 1], wheel, case, "wheel_")
    axes[0, 0].set_title(f"Pressure on the {pinion.name} flank, {words}")
    axes[0, 1].set_title(f"Pressure on the {wheel.name} flank")
    drawn.colorbar(shown, ax=axes[0, 1], label="pressure [MPa]", pad=0.01)
    _harris(axes[1, 0], loaded)
    _histories(axes[1, 1], case)
    _by_pair(axes[2, 0], case, lambda load: 100.0 * load.share, "share of the torque [%]")
    axes[2, 0].set_title(f"Load sharing, {words}")
    _by_pair(axes[2, 1], case, lambda load: load.max_pressure, "greatest pressure [MPa]")
    angle = np.degrees([p.pinion_angle for p in case.positions])
    envelope = [p.max_pressure for p in case.positions]
    axes[2, 1].plot(angle, envelope, color=BLACK, linewidth=2.2, label="envelope", zorder=0)
    axes[2, 1].set_title("Greatest pressure by pair, 0.3 mm and more from edges")
    axes[2, 1].legend(loc="lower right")
    return drawn


def _pressures(axes: Axes, flank: Flank, case: LoadCase, member: str) -> Any:
    """Cells of all positions over (S, H), the greatest pressure on top."""
    flank_frame(axes, flank)
    loads = [p for at in case.pitch for p in at.pairs]
    s, h = (
        np.concatenate([getattr(p, f"{member}{name}") for p in loads])
        for name in ("distance", "height")
    )
    pressure = np.concatenate([p.pressure for p in loads])
    columns = np.linspace(flank.toe, flank.heel, BINS[0] + 1)
    rows = np.linspace(
        float(flank.root.at(flank.heel)), float(flank.tip.at(flank.heel)), BINS[1] + 1
    )
    i, j = (
        np.clip(np.searchsorted(edges, v) - 1, 0, len(edges) - 2)
        for edges, v in ((columns, s), (rows, h))
    )
    most = np.zeros(BINS)
    np.maximum.at(most, (i, j), pressure)
    most = maximum_filter(most, 3)  # positions are steps apart: the swept area, not its stripes
    return axes.pcolormesh(
        columns, rows, np.where(most > 0.0, most, np.nan).T, cmap=MAP, vmin=0.0, vmax=case.max_pressure,
        rasterized=True,
    )  # fmt: skip


def _harris(axes: Axes, loaded: LoadedContact) -> None:
    """Transmission error against pinion angle, unloaded and per torque."""
    shades = np.linspace(0.75, 0.0, len(loaded.cases))
    first = loaded.cases[0].positions
    angle = np.degrees([p.pinion_angle for p in first])
    axes.plot(angle, [p.unloaded * URAD for p in first], "--", color=GREY, label="unloaded")
    for case, shade in zip(loaded.cases, shades, strict=True):
        axes.plot(
            np.degrees([p.pinion_angle for p in case.positions]),
            case.transmission_error * URAD,
            color=(*_rgb(BLUE, shade),),
            label=f"{case.torque * 1e-3:g} N m",
        )
    axes.set_xlabel("pinion angle [deg]")
    axes.set_ylabel("wheel's lead [µrad]")
    axes.set_title("Transmission error under load (Harris map)")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def _rgb(colour: str, lighter: float) -> tuple[float, float, float]:
    parts = [int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]
    r, g, b = (c + lighter * (1.0 - c) for c in parts)
    return r, g, b


def _histories(axes: Axes, case: LoadCase) -> None:
    """Transmission error less its mean, with the number of pairs that touch."""
    angle = np.degrees([p.pinion_angle for p in case.positions])
    own = (case.transmission_error - case.transmission_error.mean()) * URAD
    unloaded = np.array([p.unloaded for p in case.positions]) * URAD
    axes.plot(angle, unloaded - unloaded.mean(), "--", color=GREY, label="unloaded")
    axes.plot(angle, own, color=BLUE, label="under load")
    axes.set_xlabel("pinion angle [deg]")
    axes.set_ylabel("TE less its mean [µrad]")
    count = axes.twinx()
    count.step(
        angle, [len(p.pairs) for p in case.positions], where="mid", color=ORANGE, linewidth=1.0
    )
    count.set_ylabel("pairs in contact", color=ORANGE)
    count.set_ylim(0.0, max(len(p.pairs) for p in case.positions) + 1.5)
    count.spines["right"].set_visible(True)
    axes.set_ylim(axes.get_ylim()[0] - 0.4 * np.ptp(axes.get_ylim()))
    axes.set_title(f"At {case.torque * 1e-3:g} N m: contact ratio {case.contact_ratio:.2f}")
    axes.legend(loc="lower left")


def _by_pair(axes: Axes, case: LoadCase, value: Any, label: str) -> None:
    """One line a tooth pair, with its number."""
    pairs = sorted({p.pair for at in case.positions for p in at.pairs})
    for k in pairs:
        found = [
            (np.degrees(at.pinion_angle), value(p))
            for at in case.positions
            for p in at.pairs
            if p.pair == k
        ]
        axes.plot(*zip(*found, strict=True), "o-", markersize=2.5, color=PAIRS[k % len(PAIRS)])
        middle = found[len(found) // 2]
        axes.annotate(f"{k}", middle, xytext=(0, 4), textcoords="offset points", fontsize=7.5,
                      ha="center", color="#444b57")  # fmt: skip
    axes.set_xlabel("pinion angle [deg]")
    axes.set_ylabel(label)
    axes.set_ylim(bottom=0.0)


def root_stress_figure(torque: float, stress: Mapping[str, RootStress]) -> Figure:
    """Greatest tension below the loaded flank, greatest compression opposite, and both against pinion angle."""
    drawn = figure(5.6)
    grid = drawn.subplots(2, 3, width_ratios=(1.0, 1.0, 1.1))
    for row, (name, found) in zip(grid, stress.items(), strict=True):
        loaded = found.loaded_side
        tension, compression = found.greatest.max(axis=0), -found.least.min(axis=0)
        for axes, side, value, kind in (
            (row[0], loaded, tension, "greatest tension"),
            (row[1], 1 - loaded, compression, "greatest compression"),
        ):
            own = found.side == side
            at = found.distance[own], found.height[own]
            levels = np.linspace(0.0, max(float(value[own].max()), 1e-9), 13)
            painted = axes.tricontourf(*at, np.maximum(value[own], 0.0), levels=levels, cmap=MAP)
            flank = "concave" if side == 0 else "convex"
            which = "loaded side" if side == loaded else "opposite"
            axes.set_title(f"{name} {flank} fillet, {which}")
            axes.set_xlabel("cone distance S [mm], toe to heel")
            axes.set_ylabel("height H [mm], root to flank")
            drawn.colorbar(painted, ax=axes, label=f"{kind} [MPa]", format="%.0f")
            if side == found.side[found.critical]:
                k = found.critical
                axes.plot(found.distance[k], found.height[k], "x", color=VERMILION)
        _over_time(row[2], found, PINION if name == "pinion" else WHEEL)
        row[2].set_title(f"{name}: at the cross, {torque * 1e-3:g} N m")
    return drawn


def _over_time(axes: Axes, found: RootStress, colour: str) -> None:
    k, angle = found.critical, np.degrees(found.pinion_angle)
    axes.plot(angle, found.greatest[:, k], color=colour, label="maximum principal")
    axes.plot(angle, found.least[:, k], "--", color=colour, label="minimum principal")
    axes.plot(angle, found.von_mises[:, k], ":", color=GREY, label="von Mises")
    if (pressed := found.most_pressed) >= 0:
        axes.plot(
            angle, found.least[:, pressed], "-.", color=BLACK, label="opposite fillet, minimum"
        )
    axes.axhline(0.0, color=BLACK, linewidth=0.6)
    strained = angle[found.von_mises[:, k] > 0.01 * found.von_mises[:, k].max()]
    axes.set_xlim(strained.min(), strained.max())
    axes.set_xlabel("pinion angle of this tooth's pair [deg]")
    axes.set_ylabel("stress [MPa]")
    axes.legend(loc="upper left")
