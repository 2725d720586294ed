"""Sections of all that an edge sweeps, and from them the tooth as it is cut.

At a cone distance S every piece of the edge, by either root of the meshing condition, traces curves of
height and angle. At each height the one that removes most is the tooth (design, section 2): that one rule joins
fillet and flank, and finds undercut, where curves turn back, cross or end. The curves are contours S = const over
(s, turn); they only say where to start: what is returned is exact.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
from contourpy import contour_generator

from hypoid.cutter import EdgePiece
from hypoid.geometry import Batch, Batched

from ._chart import PitchCone, height_at
from ._envelope import Surface, axial_radial_angle, placed, value_and_jacobian
from ._locate import from_cutter

if TYPE_CHECKING:
    from ._flank import Flank

Array = np.ndarray[Any, Any]
ALONG, TURNS = 48, 160  # looked at along a piece, and over its turns
TURN, ROLL = 0.9, 0.9  # rad either way: turns looked at, and cradle angles that a machine rolls
DEPTHS = 3.0  # a curve further than so many tooth depths from the flank is of another slot
SLACK = 1e-6  # mm, in height, where two curves meet
COLUMNS = 65  # sections for scattered places; a grid has one for each of its own columns
STEPS = 3


@dataclass(frozen=True)
class Curve:
    """A run of one section: where a piece passes the cone distance (left hand; mm, rad)."""

    piece: str
    other: bool  # by the root of the meshing condition that does not make the flank
    s: Array
    turn: Array
    height: Array
    angle: Array


def _look(
    surface: Surface, piece: EdgePiece, cone: PitchCone, s: Batch, turn: Batch
) -> tuple[Batch, ...]:
    at, discriminant = placed(surface, piece, s, turn)
    x, y, z = at.point
    distance, height = cone.cone_distance_height(z, jnp.sqrt(x * x + y * y))
    angle = jnp.arctan2(y, x) - at.turn
    return distance, height, angle, at.phi, discriminant


def _onto(
    surface: Surface, piece: EdgePiece, cone: PitchCone, distance: Batch, s: Batch, turn: Batch
) -> tuple[Batch, ...]:
    """Turn, height and angle where the line s passes the cone distance next to a turn."""

    def place(a: Batch, b: Batch) -> tuple[Batch, ...]:
        z, rho, angle = axial_radial_angle(surface, piece, a, b)
        return *cone.cone_distance_height(z, rho), angle

    for _ in range(STEPS):
        (reached, *_), slopes = value_and_jacobian(place, s, turn)
        step = (distance - reached) / slopes[1]
        turn = turn + jnp.clip(jnp.nan_to_num(step), -0.01, 0.01)
    reached, height, angle = place(s, turn)
    return turn, height, angle, jnp.abs(reached - distance)


look = Batched(_look, parameters=3)
_passing = Batched(_onto, parameters=3)


def sections(flank: Flank, distances: Any, names: Sequence[str] | None = None) -> list[list[Curve]]:
    """All curves at each cone distance (mm), of the pieces named; of every piece but the land else."""
    found: list[list[Curve]] = [[] for _ in distances]
    surfaces = roots(flank.surface)
    for name in names or flank.cut_pieces:
        for other, surface in enumerate(surfaces):
            piece = flank.pieces[name]
            for column, curve in _of_piece(flank, surface, name, piece, bool(other), distances):
                found[column].append(curve)
    return found


def roots(surface: Surface) -> list[Surface]:
    """The surface, and that of the meshing condition's other root, if there is one."""
    if surface.way == "form":
        return [surface]
    return [surface, replace(surface, branch=-surface.branch)]


def _of_piece(
    flank: Flank, surface: Surface, name: str, piece: EdgePiece, other: bool, distances: Any
) -> Iterator[tuple[int, Curve]]:
    low, high = float(piece.low), float(piece.high)
    along = 0.5 * (low + high) - 0.5 * (high - low) * np.cos(np.linspace(0.0, np.pi, ALONG))
    turns = flank.theta_start + np.linspace(-TURN, TURN, TURNS)
    s, turn = np.meshgrid(along, turns, indexing="ij")
    distance, height, angle, phi, discriminant = (
        row.reshape(s.shape) for row in look(surface, piece, flank.cone, s, turn)
    )
    there = (discriminant > 0.0) & (np.abs(phi) < ROLL) & np.isfinite(distance)
    lines = contour_generator(turns, along, np.ma.array(distance, mask=~there))
    runs: list[tuple[int, Array]] = [
        (k, np.asarray(run)) for k, d in enumerate(distances) for run in lines.lines(float(d))
    ]
    if not runs:
        return
    sizes = [len(run) for _, run in runs]
    starts = np.concatenate([run for _, run in runs])
    wanted = np.repeat([distances[k] for k, _ in runs], sizes)
    s, start = starts[:, 1], starts[:, 0]
    turn, height, angle, left = _passing(surface, piece, flank.cone, wanted, s, start)
    split = np.cumsum(sizes)[:-1]
    parts = [np.split(a, split) for a in (s, turn, height, angle, left)]
    for (column, _), *own in zip(runs, *parts, strict=True):
        reached = own[4] < 1e-6
        yield column, Curve(name, other, *(np.where(reached, a, np.nan) for a in own[:4]))


def lowest(flank: Flank, distances: Any) -> tuple[Array, Array, Array, Array]:
    """Height and angle (left hand) of a flank's lowest point at each cone distance, its s and turn.

    On its lowest piece, by the flank's own root; NaN where that piece does not pass.
    """
    name = flank.cut_pieces[-1]
    found = np.full((3, len(distances)), np.nan)  # s, turn, distance
    for column, curves in enumerate(sections(flank, distances, [name])):
        own = [c for c in curves if not c.other and np.isfinite(c.height).any()]
        if not own:
            continue
        curve = min(own, key=lambda c: np.nanmin(c.height))
        k = int(np.nanargmin(curve.height))
        found[:, column] = _vertex(curve, k), curve.turn[k], distances[column]
    there = np.flatnonzero(np.isfinite(found[0]))
    answer = np.full((4, len(distances)), np.nan)
    if len(there):
        s, start, wanted = found[:, there]
        piece = flank.pieces[name]
        turn, height, angle, _ = _passing(flank.surface, piece, flank.cone, wanted, s, start)
        answer[:, there] = height, angle, s, turn
    return tuple(answer)  # pyright: ignore[reportReturnType]


def _vertex(curve: Curve, k: int) -> float:
    """Edge parameter of the minimum height next to vertex k, by a parabola through its neighbours."""
    near = slice(max(k - 1, 0), k + 2)
    s, height = curve.s[near], curve.height[near]
    if len(s) < 3 or not np.isfinite(height).all() or np.ptp(s) < 1e-9:
        return float(curve.s[k])
    a, b, _ = np.polyfit(s - curve.s[k], height, 2)
    return (
        float(np.clip(curve.s[k] - b / (2.0 * a), s.min(), s.max()))
        if a > 0.0
        else float(curve.s[k])
    )


def cut_points(flank: Flank, z: Array, rho: Array) -> tuple[Array, Array, Array]:
    """The tooth as it is cut at (z, rho): rows of values, the piece's index and whether by the other root.

    Values are position, normal, s and turn of a left-hand member; NaN where the edge passes no such place.
    """
    distance, height = flank.cone.cone_distance_height(z, rho)
    values = np.full((8, len(z)), np.nan)
    piece, other = np.zeros(len(z), dtype=np.int8), np.zeros(len(z), dtype=bool)
    deepest = np.full(len(z), -np.inf)
    side = 1.0 if flank.side == "concave" else -1.0  # to where angles fall, or rise
    for name, root, index, s, turn in _candidates(flank, distance, height):
        surface = roots(flank.surface)[root]
        s, turn, angle, left, _ = height_at(
            surface, flank.pieces[name], flank.cone, distance[index], height[index], s, turn
        )
        low, high = float(flank.pieces[name].low), float(flank.pieces[name].high)
        met = (left < 1e-9) & (s > low - 1e-7) & (s < high + 1e-7)
        met &= side * angle > deepest[index]
        # one place may have several candidates of one kind: the deepest comes last
        order = np.argsort(side * angle[met], kind="stable")
        index, s, turn, angle = (a[met][order] for a in (index, s, turn, angle))
        deepest[index] = side * angle
        values[6, index], values[7, index] = s, turn
        piece[index], other[index] = flank.cut_pieces.index(name), bool(root)
    for name_index, name in enumerate(flank.cut_pieces):
        for root, surface in enumerate(roots(flank.surface)):
            mine = np.flatnonzero((piece == name_index) & (other == root) & np.isfinite(values[6]))
            if len(mine):
                values[:6, mine] = from_cutter(
                    surface, flank.pieces[name], values[6, mine], values[7, mine]
                )
    around = (values[0] * values[4] - values[1] * values[3]) * side
    values[3:6, around > 0.0] *= -1.0
    return values, piece, other


def _candidates(
    flank: Flank, distance: Array, height: Array
) -> Iterator[tuple[str, int, Array, Array, Array]]:
    """Starts for each place, by piece and root: (name, root, places, s, turn)."""
    columns = np.unique(distance[np.isfinite(distance)])
    columns = columns[(columns >= flank.toe - SLACK) & (columns <= flank.heel + SLACK)]
    if len(columns) > COLUMNS:
        columns = np.linspace(flank.toe, flank.heel, COLUMNS)
    if not len(columns):
        return
    away = np.abs(columns[:, None] - distance[None, :])
    near = (
        away <= np.sort(away, axis=0)[min(1, len(columns) - 1)]
    )  # one of a grid, two around others
    near &= ~(away.min(axis=0) < SLACK) | (away < SLACK)
    depth = float(np.max(flank.tip.at(columns) - flank.root.at(columns)))
    starts: dict[tuple[str, int], list[tuple[Array, Array, Array]]] = {}
    for column, curves in enumerate(sections(flank, columns)):
        places = np.flatnonzero(near[column])
        own = [c for c in curves if c.piece == "flank" and not c.other] or curves
        angles = np.concatenate([[], *(c.angle[np.isfinite(c.angle)] for c in own)])
        middle = angles.mean() if len(angles) else 0.0
        reach = (
            DEPTHS
            * depth
            / np.nanmax(np.append(flank.cone.axial_radial(columns[column], 0.0)[1], 1.0))
        )
        for curve in curves:
            a, b = curve.height[:-1, None], curve.height[1:, None]
            asked = height[places][None, :]
            mine = np.abs(curve.angle[:-1, None] - middle) < reach
            crossing = (
                mine & (np.minimum(a, b) <= asked + SLACK) & (np.maximum(a, b) >= asked - SLACK)
            )
            segment, which = np.nonzero(crossing)
            if not len(which):
                continue
            span = (b - a)[segment, 0]
            share = np.clip(
                (asked[0, which] - a[segment, 0]) / np.where(span == 0.0, 1.0, span), 0.0, 1.0
            )

            def between(v: Array, at: Array = segment, f: Array = share) -> Array:
                return v[at] + f * (v[at + 1] - v[at])

            starts.setdefault((curve.piece, int(curve.other)), []).append(
                (places[which], between(curve.s), between(curve.turn))
            )
    for (name, root), parts in starts.items():
        index, s, turn = (np.concatenate(column) for column in zip(*parts, strict=True))
        yield name, root, index, s, turn
