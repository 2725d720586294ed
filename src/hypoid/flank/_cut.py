"""From settings and an edge to a flank: which root of the meshing condition is the tooth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from hypoid.cutter import EdgePiece
from hypoid.geometry import horner
from hypoid.machine import MachineSettings, Way, generator

from ._chart import RESERVE, Border, PitchCone
from ._envelope import Surface
from ._flank import Flank, Side
from ._locate import roots_near

LOOK = 8.0  # rad of cradle turn that weigh as much as a cone distance, in choosing a root
SCAN = 361  # turns that are looked at
CRADLE_REACH = 1.2  # rad either way: a cradle rolls less than a cutter turns


def best_way(settings: MachineSettings, revolution: bool) -> Way:
    """How the meshing condition of a flank is best met; ``revolution`` for a face-mill cutter."""
    if not settings.generated:
        return "form"
    if revolution:
        return "cutter"
    return "cradle" if settings.plain_roll else "newton"


def cut_flank(
    member: str,
    side: Side,
    settings: MachineSettings,
    pieces: Mapping[str, EdgePiece],
    cone: PitchCone,
    *,
    mirrored: bool,
    toe: float,
    heel: float,
    tip: Border,
    root: Border,
    way: Way,
    theta_start: float | None = None,
) -> Flank:
    """The flank that an edge cuts under given settings, by one way of meeting the meshing condition.

    Of all roots the one that passes nearest the mean point of the face, near the centre of roll.
    ``theta_start`` is the turn that puts the mean point in place, where it is known. Where lines of
    contact run nearly along the tooth (low spiral angles) the coordinates of the way ``cutter`` fold
    though the flank does not: then the flank is written over the cutter's turn instead.
    """
    place = Surface(generator(settings), 1.0, 1.0, way)
    asked = Flank(member, side, settings, pieces, place, cone, mirrored, 0.0, toe, heel, tip, root)
    flank = _rooted(asked, way, theta_start)
    if way == "cutter" and not flank.generated:
        other = _rooted(asked, "cradle" if settings.plain_roll else "newton", theta_start)
        if _sounder(other) > _sounder(flank):
            return other
    return flank


def _sounder(flank: Flank) -> tuple[bool, int, float]:
    """Ways compared: a flank chart at all, how many pieces are whole, and what is left of an undercut flank."""
    whole = bool(np.isfinite(flank.charts["flank"].error))
    left = 0.0 if whole else float(flank.active_chart.error)
    return whole, -len(flank.cut_away), -left


def _rooted(asked: Flank, way: Way, theta_start: float | None) -> Flank:
    """The flank by that way and no other, on the root that is the tooth."""
    gen, piece, cone = asked.surface.generator, asked.pieces["flank"], asked.cone
    middle = 0.5 * (asked.toe + asked.heel)
    if theta_start is not None:
        s, turns = np.clip([0.0], float(piece.low), float(piece.high)), np.array([theta_start])
    else:
        s = float(piece.low) + (float(piece.high) - float(piece.low)) * np.array([0.25, 0.5, 0.75])
        reach = CRADLE_REACH if way == "cutter" else np.pi
        turns = np.linspace(-reach, reach, SCAN)
    a, t = (grid.ravel() for grid in np.meshgrid(s, turns))
    best, chosen, start = np.inf, Surface(gen, 1.0, 1.0, way), 0.0
    for branch in (1.0, -1.0):
        surface = Surface(gen, branch, 1.0, way)
        phi, discriminant, tangential, z, rho = roots_near(surface, piece, a, t)
        distance, height = cone.cone_distance_height(z, rho)
        score = np.hypot(distance - middle, height) / middle + np.abs(phi) / LOOK
        score = np.where(discriminant > 0.0, score, np.inf)
        k = int(np.argmin(score))
        if score[k] < best:
            # A left-hand member turns its concave flanks to falling angles, convex ones to rising.
            wanted = -1.0 if asked.side == "concave" else 1.0
            best, start = float(score[k]), float(t[k])
            chosen = Surface(gen, branch, float(np.sign(tangential[k]) * wanted), way)
    return replace(asked, surface=chosen, theta_start=start)


def lowest_line(flank: Flank) -> Border:
    """Line in the axial section through the lowest points of a flank's cut at toe and heel."""
    ends = np.array([flank.toe, flank.heel])
    low, high = np.asarray(flank.charts[flank.cut_pieces[-1]].bounds(ends)[0])
    slope = float((high - low) / (flank.heel - flank.toe))
    return Border(float(low) - slope * flank.toe, slope)


def trimmed(flank: Flank) -> Flank:
    """The same flank with its edge ended a little above the tooth's tip, where it reaches that far."""
    name = flank.cut_pieces[0]
    piece = flank.pieces[name]
    distance = np.linspace(flank.toe, flank.heel, 5)
    chart = flank.charts[name]
    wanted = flank.tip.at(distance) + RESERVE
    x, y = chart.coordinates(distance, wanted)
    s = np.asarray(horner(chart.s, x, np.clip(y, -1.0, 1.0)))
    high = float(s.max())
    if not (np.isfinite(high) and float(piece.low) < high < float(piece.high)):
        return flank
    return replace(flank, pieces={**flank.pieces, name: replace(piece, high=high)})


def recut(flank: Flank, settings: MachineSettings) -> Flank:
    """The flank that the same edge cuts under other settings."""
    face_milled = not flank.settings.roll_to_blade_ratio  # the work does not turn with the cutter
    start = None if face_milled else flank.theta_start
    return cut_flank(
        flank.member,
        flank.side,
        settings,
        flank.pieces,
        flank.cone,
        mirrored=flank.mirrored,
        toe=flank.toe,
        heel=flank.heel,
        tip=flank.tip,
        root=flank.root,
        way=best_way(settings, face_milled),
        theta_start=start,
    )


def roll_range(flank: Flank) -> tuple[float, float]:
    """Least and greatest cradle angle, rad, at which flank and fillet are cut, toe to heel."""
    ends: list[float] = [0.0]
    for name in flank.cut_pieces:
        chart, piece = flank.charts[name], flank.pieces[name]
        x, y = (g.ravel() for g in np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9)))
        s, turn = np.asarray(horner(chart.s, x, y)), np.asarray(horner(chart.theta, x, y))
        phi = roots_near(flank.surface, piece, s, turn)[0]
        ends += [float(np.nanmin(phi)), float(np.nanmax(phi))]
    return min(ends), max(ends)
