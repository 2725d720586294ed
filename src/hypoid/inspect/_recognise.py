"""What a measurement looks like when it does not fit: another side, hand, member, unit, axis or order."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any

import numpy as np

from hypoid.flank import SIDES, Side
from hypoid.geometry import Problem

from ._grid import FlankNodes, MeasuringGrid
from ._measured import Measured

Array = np.ndarray[Any, Any]
FITS = 0.1  # mm rms: closer than this, nothing else is looked for
NOWHERE = (
    0.02  # of the face width: further off than this, and like nothing else, it is no such flank
)
BETTER = 0.3  # share of the misfit that another reading must come below
AXES = {
    "": (0, 1, 2),
    "with the axis along x, not z": (1, 2, 0),
    "with the axis along y, not z": (2, 0, 1),
}
SCALES = {
    "": 1.0,
    "in inches, not mm": 25.4,
    "in metres, not mm": 1000.0,
    "in micrometres, not mm": 0.001,
}
LARGE = 1.0  # mm: no deviation is so large
Reading = tuple[str, float]


def recognise(
    grid: MeasuringGrid, measured: Measured, others: Mapping[str, MeasuringGrid]
) -> list[Problem]:
    """Problems of a measurement, each saying what it looks like; none where it fits."""
    found: list[Problem] = []
    for side, one in measured.sides.items():
        nodes = grid.flanks[side]
        if one.position is None:
            found += _sizes(side, one.deviation)
            continue
        points = one.position[0]
        here = misfit(nodes, points * nodes.flank.hand)
        if here > FITS:
            found += _problem(grid, nodes, points, here, others)
        elif one.normal is not None:
            expected = np.broadcast_to(nodes.normal, one.normal.shape)
            same = (one.normal * _to_tooth(nodes, one.position, expected)).sum(axis=-1)
            same = same[np.isfinite(same)]
            if same.size and np.median(same) < 0.0:
                words = "normals that point out of the tooth (these point into it)"
                found.append(
                    Problem(
                        f"measured: {side}", "reversed normals", words, 'normals = "into-tooth"'
                    )
                )
    return found


def misfit(nodes: FlankNodes, points: Array) -> float:
    """Root mean square distance, mm, of points (n, 3; left hand) from nominal ones after the best turn."""
    nominal = nodes.own[0]
    there = np.isfinite(points).all(axis=1) & np.isfinite(nominal).all(axis=1)
    if not there.any():
        return float("inf")
    a, b = nominal[there], points[there]
    p, q = a @ [1.0, 1j, 0.0], b @ [1.0, 1j, 0.0]
    turn = np.vdot(p, q)
    turn = turn / abs(turn) if abs(turn) else 1.0
    return float(np.sqrt(np.mean(np.abs(q - turn * p) ** 2 + (a[:, 2] - b[:, 2]) ** 2)))


def _problem(
    grid: MeasuringGrid,
    nodes: FlankNodes,
    points: Array,
    here: float,
    others: Mapping[str, MeasuringGrid],
) -> list[Problem]:
    """What points that lie off their flank look like; nothing where they are merely badly cut."""
    words, least = min(
        _readings(grid, nodes, points, others), key=lambda r: (round(r[1], 2), len(r[0]))
    )
    where, example = (
        f"measured: {nodes.side}",
        "the points of hypoid inspect FILE --nominal OUT.csv",
    )
    given = f"points {here:.3g} mm rms off the {nodes.flank.name} flank, however the part is turned"
    if least < BETTER * here:
        order = "rows root to tip, columns toe to heel, in mm, z along the axis"
        expected = f"points of the {nodes.flank.name} flank, {order}"
        return [Problem(where, f"{given}; {words}", expected, example)]
    if here < NOWHERE * (nodes.flank.heel - nodes.flank.toe):
        return []
    expected = "points of this design's grid (same rows, columns and borders)"
    return [Problem(where, given, expected, example)]


def _readings(
    grid: MeasuringGrid, nodes: FlankNodes, points: Array, others: Mapping[str, MeasuringGrid]
) -> Iterator[Reading]:
    """Every other reading of the points, in words, with its misfit."""
    targets: list[tuple[str, FlankNodes]] = [
        ("" if side == nodes.side else f"the {side} flank", grid.flanks[side]) for side in SIDES
    ]
    for name, other in others.items():
        if other.rows == grid.rows and other.columns == grid.columns and name != grid.member.name:
            targets += [(f"the {name}'s {side} flank", other.flanks[side]) for side in SIDES]
    rows, columns = nodes.shape
    table = points.reshape(rows, columns, 3)
    orders = {
        "": table,
        "with rows from tip to root": table[::-1],
        "with columns from heel to toe": table[:, ::-1],
        "with rows from tip to root and columns from heel to toe": table[::-1, ::-1],
        "with rows and columns swapped": points.reshape(columns, rows, 3).swapaxes(0, 1),
    }
    for (which, target), (order, sorted_), (axis, turn), (unit, scale), mirror, back in product(
        targets, orders.items(), AXES.items(), SCALES.items(), (False, True), (False, True)
    ):
        read = sorted_.reshape(-1, 3)[:, turn] * scale * target.flank.hand
        read = read * np.array([1.0, -1.0 if mirror else 1.0, -1.0 if back else 1.0])
        hand = "of the other hand" if mirror else ""
        way = "with the axis from heel to apex" if back else ""
        parts = [w for w in (which, order, axis, unit, hand, way) if w]
        if parts:
            yield f"these look like {_joined(parts, nodes)}", misfit(target, read)


def _joined(parts: list[str], nodes: FlankNodes) -> str:
    first = parts[0] if parts[0].startswith("the ") else f"the {nodes.side} flank"
    rest = parts[1:] if parts[0].startswith("the ") else parts
    return ", ".join([first, *rest])


def _to_tooth(nodes: FlankNodes, position: Array, normal: Array) -> Array:
    """Nominal normals turned to where each measured tooth stands."""
    made: list[Array] = []
    for points, n in zip(position, normal, strict=True):
        there = np.isfinite(points).all(axis=1)
        turn = np.vdot(nodes.position[there] @ [1.0, 1j, 0.0], points[there] @ [1.0, 1j, 0.0])
        c, s = turn.real / abs(turn), turn.imag / abs(turn)
        made.append(
            np.stack([c * n[:, 0] - s * n[:, 1], s * n[:, 0] + c * n[:, 1], n[:, 2]], axis=-1)
        )
    return np.array(made)


def _sizes(side: Side, deviation: Any) -> list[Problem]:
    value = np.abs(deviation[np.isfinite(deviation)])
    if not value.size or np.median(value) < LARGE:
        return []
    given = f"deviations of {np.median(value):.3g} mm in the middle"
    return [
        Problem(
            f"measured: {side}",
            given,
            "deviations below 1 mm: these look like micrometres",
            'deviation = "um"',
        )
    ]
