"""Measured against nominal: deviations along nominal normals, the part turned to fit, tooth against tooth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from hypoid.flank import SIDES, Side
from hypoid.geometry import DesignError, Problem

from ._grid import FlankNodes, MeasuringGrid, turned
from ._measured import Measured, MeasuredSide
from ._recognise import recognise
from ._response import nominal_distance
from ._robust import robust, smooth_terms
from ._topography import Topography, coordinates, topography

Array = np.ndarray[Any, Any]
Zero = Literal["reference", "best-fit"]
LEAST = 6  # points of a flank


@dataclass(frozen=True, eq=False)
class SideComparison:
    """One flank's deviations, mm along nominal normals, positive where material stands out."""

    nodes: FlankNodes
    teeth: tuple[int, ...]
    deviation: Array  # (t, n), each tooth turned to its zero
    turn: Array  # (t,) rad, left hand: how far each tooth stands past its nominal place
    outlier: Array  # (t, n) bool: marked, shown, and left out of mean and fits

    @cached_property
    def mean(self) -> Array:
        """(rows, columns) mean over teeth, outliers left out; NaN where nothing is left."""
        value = np.where(self.outlier, np.nan, self.deviation)
        there = np.isfinite(value).sum(axis=0)
        total = np.nansum(value, axis=0)
        return np.where(there > 0, total / np.maximum(there, 1), np.nan).reshape(self.nodes.shape)

    @cached_property
    def scatter(self) -> Array:
        """(rows, columns) standard deviation over teeth; NaN for one tooth."""
        value = np.where(self.outlier, np.nan, self.deviation)
        there = np.isfinite(value).sum(axis=0)
        off = np.nansum((value - self.mean.ravel()) ** 2, axis=0)
        found = np.where(there > 1, np.sqrt(off / np.maximum(there - 1, 1)), np.nan)
        return found.reshape(self.nodes.shape)

    @cached_property
    def topography(self) -> Topography:
        return topography(self.nodes, self.mean)

    @property
    def largest(self) -> float:
        """Greatest deviation of the mean either way, mm."""
        return float(np.nanmax(np.abs(self.mean)))

    @property
    def rms(self) -> float:
        return float(np.sqrt(np.nanmean(self.mean**2)))

    @property
    def outliers(self) -> tuple[str, ...]:
        """Outlying points by name and tooth."""
        shape = self.nodes.shape
        return tuple(
            f"tooth {self.teeth[t]}, {self.nodes.name(*divmod(int(k), shape[1]))} "
            f"({self.deviation[t, k] * 1e3:+.1f} um)"
            for t, k in zip(*np.nonzero(self.outlier), strict=True)
        )


@dataclass(frozen=True)
class PitchDeviations:
    """Pitch along the reference circle, mm: by tooth, from one measured tooth to the next, and in all."""

    teeth: tuple[int, ...]
    cumulative: tuple[float, ...]  # of each measured tooth, the first at zero
    single: float | None  # greatest between neighbours; None where none were measured
    total: float


@dataclass(frozen=True, eq=False)
class Comparison:
    """A member's measurement against its nominal grid."""

    grid: MeasuringGrid
    sides: Mapping[Side, SideComparison]
    thickness: (
        float | None
    )  # mm, deviation of the tooth thickness at the reference point, along the arc
    axial: float  # mm along the axis that was taken off
    pitch: Mapping[Side, PitchDeviations]
    runout: float | None  # mm, square to the pitch cone, of a ball between a slot's flanks

    @property
    def deviations(self) -> dict[Side, Array]:
        """Mean deviations by side, (rows, columns) mm: what a correction takes."""
        return {side: one.mean for side, one in self.sides.items()}


def compare(
    grid: MeasuringGrid,
    measured: Measured,
    *,
    axial: float | Literal["fit"] = 0.0,
    zero: Zero = "reference",
    others: Mapping[str, MeasuringGrid] | None = None,
) -> Comparison:
    """Compare a measurement with the exact nominal flanks.

    Each tooth is turned about the axis until its reference point, or its best fit, is at zero. ``axial`` (mm, apex to
    heel) is taken off the points, or fitted; ``others`` are grids of other members that it may be mistaken for.

    Raises
    ------
    DesignError
        For too few points, and for what looks like another side, hand, member, unit or order.
    """
    problems = [
        Problem(
            f"measured: {side}",
            f"{one.count} points",
            f"at least {LEAST}",
            "a grid of 5 x 9 points",
        )
        for side, one in measured.sides.items()
        if one.count < LEAST
    ]
    if not measured.sides:
        problems.append(Problem("measured", "no points", f"at least {LEAST} of one flank", "5 x 9"))
    problems = problems or recognise(grid, measured, others or {})
    if problems:
        raise DesignError(problems)
    shift = 0.0 if axial == "fit" else float(axial)
    sides = _sides(grid, measured, shift, zero)
    if axial == "fit":
        shift = _axial(sides)
        sides = _sides(grid, measured, shift, zero)
    by_points = all(one.position is not None for one in measured.sides.values())
    thickness = _thickness(sides) if by_points else measured.thickness
    pitch: dict[Side, PitchDeviations] = {}
    for side, one in sides.items() if by_points else ():
        found = _pitch(one, grid.pitch)
        if found is not None:
            pitch[side] = found
    runout = _runout(grid, sides) if by_points else None
    return Comparison(grid, sides, thickness, shift, pitch, runout)


def _sides(
    grid: MeasuringGrid, measured: Measured, axial: float, zero: Zero
) -> dict[Side, SideComparison]:
    return {side: _side(grid, side, one, axial, zero) for side, one in measured.sides.items()}


def _side(
    grid: MeasuringGrid, side: Side, one: MeasuredSide, axial: float, zero: Zero
) -> SideComparison:
    nodes = grid.flanks[side]
    point, normal = nodes.own
    found: list[tuple[Array, float, Array]] = []
    for t in range(len(one.teeth)):
        if one.position is not None:
            own = nodes.taken_back(one.position[t])
            own = own - np.array([0.0, 0.0, axial])
            angle = alignment(point, own)
            near = round(angle / grid.pitch) * grid.pitch
            turn, value = angle - near, nominal_distance(nodes, turned(own, -angle))
        else:
            assert one.deviation is not None
            turn, value = 0.0, one.deviation[t] - axial * normal[:, 2]
        value = np.where(nodes.there, value, np.nan)
        more, out = _zero(nodes, value, zero)
        found.append((value - more * nodes.lever, turn + more, out))
    value, turn, out = (np.array(v) for v in zip(*found, strict=True))
    return SideComparison(nodes, one.teeth, value, turn, out)


def alignment(nominal: Array, points: Array) -> float:
    """Turn about the axis, rad, that takes nominal points (n, 3) nearest to measured ones; NaNs take no part."""
    there = np.isfinite(points).all(axis=1) & np.isfinite(nominal).all(axis=1)
    a, b = nominal[there] @ [1.0, 1j, 0.0], points[there] @ [1.0, 1j, 0.0]
    return float(np.angle(np.vdot(a, b)))


def _zero(nodes: FlankNodes, value: Array, zero: Zero) -> tuple[float, Array]:
    """Turn (rad) of one tooth's zero, and its outliers: off a smooth map with a free turn."""
    x, y = (c.ravel() for c in coordinates(nodes))
    lever = nodes.lever / nodes.radius
    terms = np.column_stack([lever, smooth_terms(x, y, int(np.isfinite(value).sum()))])
    _, out = robust(terms, value)
    row, column = nodes.reference
    middle = row * nodes.shape[1] + column
    if zero == "reference" and np.isfinite(value[middle]) and not out[middle]:
        return float(value[middle] / nodes.lever[middle]), out
    keep = np.isfinite(value) & ~out
    turn = nodes.lever[keep] @ value[keep] / (nodes.lever[keep] @ nodes.lever[keep])
    return float(turn), out


def _axial(sides: Mapping[Side, SideComparison]) -> float:
    """Shift along the axis, mm, that leaves least on all flanks, each with a free turn."""
    top = bottom = 0.0
    for one in sides.values():
        value, lever, along = one.mean.ravel(), one.nodes.lever, one.nodes.own[1][:, 2]
        there = np.isfinite(value)
        value, lever, along = value[there], lever[there], along[there]
        rest = along - lever * (lever @ along) / (lever @ lever)
        top, bottom = top + float(rest @ value), bottom + float(rest @ along)
    return top / bottom


def _thickness(sides: Mapping[Side, SideComparison]) -> float | None:
    """A tooth reaches from its concave flank up to its convex one (left hand)."""
    if set(sides) != set(SIDES):
        return None
    concave, convex = (sides[s] for s in SIDES)
    return float(convex.turn.mean() - concave.turn.mean()) * concave.nodes.radius


def _pitch(one: SideComparison, pitch: float) -> PitchDeviations | None:
    if len(one.teeth) < 2:
        return None
    arc = (one.turn - one.turn[0]) * one.nodes.radius
    count = round(2.0 * np.pi / pitch)
    after = {tooth: k for k, tooth in enumerate(one.teeth)}
    steps = [
        abs(arc[after[tooth % count + 1]] - arc[k])
        for tooth, k in after.items()
        if tooth % count + 1 in after
    ]
    single = float(max(steps)) if steps else None
    return PitchDeviations(one.teeth, tuple(float(a) for a in arc), single, float(np.ptp(arc)))


def _runout(grid: MeasuringGrid, sides: Mapping[Side, SideComparison]) -> float | None:
    """Peak to peak, square to the pitch cone, of a ball between a slot's flanks at their reference points.

    A slot lies between its convex flank, of the tooth before, and its concave one; as it opens, the ball sinks.
    """
    if set(sides) != set(SIDES):
        return None
    concave, convex = (sides[s] for s in SIDES)
    middle = grid.reference[0] * grid.columns + grid.reference[1]
    lever = rise = 0.0
    at = [float(v[grid.reference]) for v in (concave.nodes.distance, concave.nodes.height)]
    half = 0.5 * float(grid.member.tooth.slot_angle([at[0]], [at[1]])[0])  # to the slot's middle
    for one in (concave, convex):
        (x, y, _), n = (v[middle] for v in one.nodes.own)
        cone = one.nodes.flank.cone
        radial = (n[0] * x + n[1] * y) / np.hypot(x, y)
        arm = abs(float(one.nodes.lever[middle]))
        radial = radial * np.cos(half) + arm / np.hypot(x, y) * np.sin(half)
        lever += 0.5 * arm
        rise += 0.5 * float(cone.cosine * radial - cone.sine * n[2])
    of = {tooth: k for k, tooth in enumerate(convex.teeth)}
    count = grid.member.teeth
    depth: list[float] = []
    for k, tooth in enumerate(concave.teeth):
        before = (tooth - 2) % count + 1
        if before in of:
            wider = float(concave.turn[k] - convex.turn[of[before]])
            depth.append(0.5 * wider * lever / rise)
    return float(np.ptp(depth)) if len(depth) > 1 else None
