"""Angle fields of two mates, and the lead of the wheel over a grid of pinion points.

At (z, rho) a flank is an angle. A pinion point carried into the wheel frame would touch the wheel's
flank if the wheel led by sense (field - angle); the greatest lead over all points is where the
wheel stands (methods of contact, 2). A field is split where the relief begins, so that each chart
is smooth.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.flank import Border, Chart, Flank, PitchCone
from hypoid.geometry import Batch, Vector, compiled_fused, horner, namespace

from ._mounting import Mounting, to_wheel


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class AngleField:
    """A left-hand flank as an angle over (S, H), between fillet limit, or what undercut leaves, and blade's end."""

    parts: tuple[Chart, ...]  # from the fillet limit up: a chart of each smooth part
    cone: PitchCone
    tip: Border  # the face cone

    def angle(self, distance: Batch, height: Batch) -> Batch:
        """Angle about the member's axis, rad, at cone distance S and height H."""
        xp = namespace(distance, height)
        value, *above = (horner(p.angle, *p.coordinates(distance, height)) for p in self.parts)
        for part, more in zip(self.parts, above, strict=False):
            value = xp.where(height < part.bounds(distance)[1], value, more)
        return value

    @property
    def lowest(self) -> Chart:
        """The chart that begins at the fillet limit, from toe to heel."""
        return self.parts[0]

    def holds(self, distance: Batch, height: Batch) -> Batch:
        """Whether (S, H) lies on the active flank."""
        slack = 1e-9
        inside = (distance >= self.lowest.toe - slack) & (distance <= self.lowest.heel + slack)
        inside &= height <= self.tip.at(distance) + slack
        return inside & (height >= self.lowest.bounds(distance)[0] - slack)


@lru_cache(maxsize=64)
def angle_field(flank: Flank) -> AngleField:
    """The angle field of a flank: its chart, or two that meet where its relief or Flankrem begins."""
    piece = flank.pieces["flank"]
    low, high, start = float(piece.low), float(piece.high), float(piece.relief_from)
    relieved = float(piece.relief) != 0.0 and low < start < high
    if not relieved:
        above = tuple(flank.charts[name] for name in active(flank)[1:])
        parts = (flank.active_chart, *above)
        return AngleField(parts, flank.cone, flank.tip)
    pieces = (replace(piece, high=start, relief=0.0), replace(piece, low=start))
    parts = tuple(flank.active_chart_of(p) for p in pieces)
    return AngleField(parts, flank.cone, flank.tip)


def active(flank: Flank) -> tuple[str, ...]:
    """Pieces of the active flank, upwards: a straight Flankrem ends it."""
    return tuple(name for name in ("flank", "flankrem") if name in flank.pieces)


@dataclass(frozen=True)
class FlankNodes:
    """A grid of points over the active flank of a pinion, between fillet limit and tip."""

    distance: np.ndarray  # (columns,) S, mm, toe to heel
    share: np.ndarray  # (rows,) 0 at the fillet limit, 1 at the tip
    height: np.ndarray  # (rows, columns) H, mm
    point: np.ndarray  # (3, rows * columns), left-hand pinion frame, mm
    normal: np.ndarray  # (3, rows * columns)
    s: np.ndarray
    theta: np.ndarray


@lru_cache(maxsize=64)
def flank_nodes(flank: Flank, columns: int, rows: int) -> FlankNodes:
    """Exact points of a flank over its active part."""
    distance = np.linspace(flank.toe, flank.heel, columns)
    share = np.linspace(0.0, 1.0, rows)
    low = np.asarray(angle_field(flank).lowest.bounds(distance)[0])
    height = low + np.outer(share, flank.tip.at(distance) - low)
    places = np.broadcast_to(distance, height.shape).ravel(), height.ravel()
    made = np.full((8, height.size), np.nan)  # position, normal, s, theta
    for name in active(flank):
        low = np.asarray(flank.charts[name].bounds(places[0])[0])
        mine = np.ones(height.size, dtype=bool) if name == "flank" else places[1] > low
        s, theta, _ = flank.parameters(places[0][mine], places[1][mine], name)
        made[:, mine] = np.vstack([*(a.T for a in flank.at_cutter(s, theta, name)), s, theta])
    point, normal = (part * flank.hand[:, None] for part in (made[:3], made[3:6]))
    return FlankNodes(distance, share, height, point, normal, made[6], made[7])


def lead(mount: Mounting, wheel: AngleField, phi: Batch, point: Vector) -> Batch:
    """Lead of the wheel (rad, beyond z1/z2 phi) that would touch each pinion point; -inf off the mate.

    The two angles are small and never wrap; a lead beyond half a pitch means that the point has
    turned away to where the wheel's surface is met from behind.
    """
    xp = namespace(phi, point)
    x, y, z = to_wheel(mount, phi, point)
    rho = xp.sqrt(x * x + y * y)
    distance, height = wheel.cone.cone_distance_height(z, rho)
    value = mount.sense * (wheel.angle(distance, height) - xp.arctan2(y, x))
    excess = value - mount.wheel_zero - mount.ratio * phi
    mine = wheel.holds(distance, height) & (xp.abs(excess) < mount.half_pitch)
    return xp.where(mine, excess, -xp.inf)


@compiled_fused
def lead_grid(mount: Mounting, wheel: AngleField, phi: Batch, point: Vector) -> Batch:
    """Leads (positions, points) for pinion angles phi (positions,) and points of (points,)."""
    return jax.vmap(lambda angle: lead(mount, wheel, angle, point))(phi)


lead_each = compiled_fused(lead)  # one pinion angle a point


def on_flank(field: AngleField, x: Batch, y: Batch) -> tuple[Batch, Batch]:
    """(S, H), mm, at x, y in [-1, 1] from toe to heel, and from where the flank begins to its tip."""
    distance = 0.5 * (field.lowest.toe + field.lowest.heel)
    distance = distance + 0.5 * (field.lowest.heel - field.lowest.toe) * x
    low = field.lowest.bounds(distance)[0]
    return distance, low + 0.5 * (1.0 + y) * (field.tip.at(distance) - low)


def lead_on_flank(
    mount: Mounting, pinion: AngleField, wheel: AngleField, phi: Batch, x: Batch, y: Batch
) -> Batch:
    """Leads at chart places of the pinion: x, y in [-1, 1] from toe to heel, fillet limit to tip."""
    distance, height = on_flank(pinion, x, y)
    z, rho = pinion.cone.axial_radial(distance, height)
    angle = pinion.angle(distance, height)
    return lead(mount, wheel, phi, (rho * jnp.cos(angle), rho * jnp.sin(angle), z))
