"""Charts: the angle and the parameters of a piece of flank as polynomials over the blank.

Coordinates are the cone distance S and the height H above the pitch cone. A piece covers S from toe
to heel and H between two of its own edge lines H_low(S) and H_high(S), so that its rectangle
(x, y) in [-1, 1]**2 never asks for a point the piece does not have. A fillet's chart begins at
its lowest line, where the edge runs along the root: at the root land, or on the arc of a tilted
cutter or its extension. H grows from there with the square of the edge length, so y counts the root
of the height. So it does for an undercut flank, which begins near where it would fold.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from numpy.polynomial import chebyshev

from hypoid.cutter import EdgePiece
from hypoid.geometry import (
    Batch,
    Batched,
    Scalar,
    fit,
    fit_line,
    horner,
    horner_line,
    namespace,
    nodes,
    on_unit,
)

from ._envelope import Surface, axial_radial_angle, newton_pair

COLUMNS, ROWS = 14, 12  # polynomial orders along S and across
ALONG_EDGE = 20  # nodes along an edge arc, to find its lowest point
TINY = 1e-300  # of a height: where derivatives of its root still are numbers
SHORT = 0.05  # mm by which an edge may miss that reserve
RESERVE = 0.5  # mm that a chart reaches beyond the tooth's tip, where the edge does


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class PitchCone:
    """Pitch cone of a member: apex at z = -apex_beyond (mm), half angle by sine and cosine."""

    apex_beyond: Scalar
    sine: Scalar
    cosine: Scalar

    def cone_distance_height(self, z: Batch, rho: Batch) -> tuple[Batch, Batch]:
        """(S, H) of points at axial position z and radius rho, mm."""
        along = z + self.apex_beyond
        return along * self.cosine + rho * self.sine, rho * self.cosine - along * self.sine

    def axial_radial(self, distance: Any, height: Any) -> tuple[Any, Any]:
        """(z, rho) of points at cone distance S and height H, mm."""
        z = distance * self.cosine - height * self.sine - self.apex_beyond
        return z, distance * self.sine + height * self.cosine


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Border:
    """Line of the face or root cone: height above the pitch cone (mm) against cone distance."""

    height: Scalar  # at S = 0, mm
    slope: Scalar

    def at(self, distance: Batch) -> Batch:
        """H, mm, at cone distances S."""
        return self.height + self.slope * distance


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Chart:
    """Polynomials of one piece: its edge lines and, over its rectangle, angle, s and theta."""

    toe: Scalar  # range of S, mm
    heel: Scalar
    low: Batch  # powers of H_low(x)
    high: Batch
    angle: Any  # powers (i, j)
    s: Any
    theta: Any
    first: Batch  # powers of the edge parameter (mm) along H_low
    rooted: Scalar  # 1 where y counts the root of the height (fillet, undercut), else 0
    sense: Scalar  # sign of the derivatives' determinant of (S, H) by (s, theta), mid-face
    error: Scalar  # greatest misfit of the angle seen, rad; infinite where the piece folds

    def bounds(self, distance: Batch) -> tuple[Batch, Batch]:
        """H_low and H_high (mm) at cone distance S."""
        x = on_unit(self.toe, self.heel, distance)
        return horner_line(self.low, x), horner_line(self.high, x)

    def coordinates(self, distance: Batch, height: Batch) -> tuple[Batch, Batch]:
        """(x, y) of (S, H); outside the rectangle where |x| or |y| passes 1."""
        x = on_unit(self.toe, self.heel, distance)
        low, high = horner_line(self.low, x), horner_line(self.high, x)
        t = (height - low) / (high - low)
        xp = namespace(distance, height)
        t = xp.where(self.rooted > 0.5, xp.sqrt(xp.maximum(t, TINY)), t)
        return x, 2.0 * t - 1.0


def _solve(
    surface: Surface,
    piece: EdgePiece,
    cone: PitchCone,
    distance: Batch,
    height: Batch,
    held: Batch,
    s: Batch,
    theta: Batch,
) -> tuple[Batch, ...]:
    """s, theta, H and angle where a piece reaches S and H (or, where s is held, S alone).

    With what is left of (S, H) and the determinant of their derivatives by (s, theta).
    """
    given = s

    def place(a: Batch, b: Batch) -> tuple[Batch, ...]:
        z, rho, angle = axial_radial_angle(surface, piece, a, b)
        reached, at = cone.cone_distance_height(z, rho)
        return reached - distance, jnp.where(held > 0.5, a - given, at - height), at, angle

    (s, theta), (f, g, at, angle), j = newton_pair(place, (s, theta), (0.3, 0.02), 25)
    return s, theta, at, angle, jnp.hypot(f, g), j[0] * j[3] - j[1] * j[2]


_solved = Batched(_solve, parameters=3, block=256)


def height_at(
    surface: Surface,
    piece: EdgePiece,
    cone: PitchCone,
    distance: Any,
    height: Any,
    s: Any,
    theta: Any,
) -> tuple[Any, ...]:
    """s, theta and angle of the point (S, H) of a piece, with what is left and the chart's sense."""
    held = np.zeros(np.shape(distance))
    s, theta, _, *rest = _solved(surface, piece, cone, distance, height, held, s, theta)
    return s, theta, *rest


def edge_line(
    surface: Surface, piece: EdgePiece, cone: PitchCone, distance: Any, s: Any, theta: Any
) -> tuple[Any, Any]:
    """Theta and H where the lines s = const of a piece reach the cone distances S."""
    distance, s = (a.ravel() for a in np.broadcast_arrays(distance, s))
    at = (distance, np.zeros(len(s)), np.ones(len(s)), s, np.full(len(s), theta))
    return tuple(_solved(surface, piece, cone, *at)[1:3])  # pyright: ignore[reportReturnType]


def _lowest(
    surface: Surface, piece: EdgePiece, cone: PitchCone, distance: Any, theta: float
) -> Any:
    """Edge parameter (mm) of the lowest point of an edge arc at each S, the arc extended below its end."""
    low, half = float(piece.low), 0.5 * (float(piece.high) - float(piece.low))
    x = nodes(ALONG_EDGE)
    _, height = edge_line(surface, piece, cone, distance[:, None], low + half * x, theta)
    slope = chebyshev.chebder(
        np.linalg.solve(chebyshev.chebvander(x, ALONG_EDGE - 1), height.reshape(-1, ALONG_EDGE).T)
    )
    return low + half * np.array([_nearest_minimum(column) for column in slope.T])


def _nearest_minimum(slope: Any) -> float:
    """Root in [-1, 1] nearest 0 of a Chebyshev series that rises through it; 0 if there is none."""
    roots = chebyshev.chebroots(slope)
    roots = roots[(np.abs(roots.imag) < 1e-9) & (np.abs(roots.real) < 1.0)].real
    roots = roots[chebyshev.chebval(roots, chebyshev.chebder(slope)) > 0.0]
    return float(roots[np.argmin(np.abs(roots))]) if len(roots) else 0.0


@dataclass(frozen=True)
class Floor:
    """Where a chart begins above its piece's own lower end, since that is cut away (undercut)."""

    height: Callable[[Any], Any]  # H, mm, at x
    start: Callable[[Any, Any], tuple[Any, Any]]  # s and theta near (S, H)


def chart(
    surface: Surface,
    piece: EdgePiece,
    cone: PitchCone,
    toe: float,
    heel: float,
    theta_start: float,
    rooted: bool,
    tip: Border | None = None,
    floor: Floor | None = None,
) -> Chart:
    """Chart of a piece between toe and heel (S, mm), not far beyond a tip; nodes that fail keep their start."""
    x, y = nodes(COLUMNS), nodes(ROWS)
    distance = 0.5 * (heel + toe) + 0.5 * (heel - toe) * x
    low, high = np.full(COLUMNS, float(piece.low)), float(piece.high)
    if rooted and floor is None:
        low = _lowest(surface, piece, cone, distance, theta_start)
    theta_low, height_low = edge_line(surface, piece, cone, distance, low, theta_start)
    theta_high, height_high = edge_line(surface, piece, cone, distance, high, theta_start)
    reach = 1.0  # share of the edge that is charted
    if tip is not None and np.all(height_high > tip.at(distance) + RESERVE - SHORT):
        wanted = tip.at(distance) + RESERVE
        reach = np.outer((wanted - height_low) / (height_high - height_low), np.ones(ROWS))
        height_high = wanted
    if floor is not None:
        height_low = floor.height(x)
    t = 0.5 * (1.0 + y)
    share = t**2 if rooted else t
    heights = height_low[:, None] + np.outer(height_high - height_low, share)
    along = reach * np.outer(np.ones(COLUMNS), t)
    s0 = low[:, None] + (high - low)[:, None] * along
    theta0 = theta_low[:, None] + (theta_high - theta_low)[:, None] * along
    if floor is not None:
        s0, theta0 = floor.start(np.outer(distance, np.ones(ROWS)).ravel(), heights.ravel())
        low = s0.reshape(heights.shape)[:, 0]
    shape = heights.shape
    s, theta, angle, left, sense = (
        part.reshape(shape)
        for part in height_at(
            surface, piece, cone, np.outer(distance, np.ones(ROWS)), heights, s0, theta0
        )
    )
    one_sense = bool(np.all(sense > 0.0) or np.all(sense < 0.0))
    sound = left.max() < 1e-8 and one_sense
    made = Chart(
        toe=toe,
        heel=heel,
        low=fit_line(height_low),
        high=fit_line(height_high),
        angle=fit(angle),
        s=fit(s),
        theta=fit(theta),
        first=fit_line(np.maximum(low, float(piece.low))),
        rooted=float(rooted),
        sense=float(np.sign(sense[COLUMNS // 2, ROWS // 2])),
        error=np.inf,
    )
    return replace(made, error=_misfit(made, surface, piece, cone)) if sound else made


def _misfit(made: Chart, surface: Surface, piece: EdgePiece, cone: PitchCone) -> float:
    """Greatest error of the chart's angle between its nodes, against the exact surface, rad."""
    x, y = (grid.ravel() for grid in np.meshgrid(np.linspace(-1, 1, 23), np.linspace(-0.98, 1, 19)))
    s, theta, angle = (np.asarray(horner(c, x, y)) for c in (made.s, made.theta, made.angle))
    distance = 0.5 * (made.heel + made.toe) + 0.5 * (made.heel - made.toe) * x
    low, high = (np.asarray(horner_line(c, x)) for c in (made.low, made.high))
    t = 0.5 * (1.0 + y)
    height = low + (high - low) * (t**2 if made.rooted else t)
    exact = height_at(surface, piece, cone, distance, height, s, theta)[2]
    return float(np.abs(exact - angle).max())
