"""Both flanks of a pair along rays parallel to its common normal: where they meet the pinion, and the gap there.

Newton's method follows every ray to the pinion, point after point in one compiled function: patches are small, and
NumPy spends its time between them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.contact import AngleField, Mounting, lead, to_wheel
from hypoid.geometry import Batch, Batched, Scalar

from ._love import CELLS

Array = np.ndarray[Any, Any]
STEPS, ARRIVED = 8, 1e-13  # most of Newton's, and when they end, rad
MISSED = 1e-10  # rad by which a ray that meets the pinion is off it at most


@dataclass(frozen=True, eq=False)
class Surface:
    """Points of the pinion's flank as one pair sees them, in the contact's frame G, mm (see `hypoid.contact`)."""

    rows: Array  # (16, n), see `_met`

    def cut(self, on: Array) -> Surface:
        """Some of the points."""
        return Surface(self.rows[:, on])

    @property
    def point(self) -> Array:
        """(n, 3)."""
        return self.rows[:3].T

    @property
    def normal(self) -> Array:
        """(n, 3) out of the pinion's tooth."""
        return self.rows[3:6].T

    @property
    def upright(self) -> Array:
        """Cosine (n,) of the angle between normal and ray."""
        return self.rows[6]

    @property
    def gap(self) -> Array:
        """Gap (n,) along the normal with the wheel in its rigid place; infinite off either active flank."""
        return self.rows[7]

    @property
    def levers(self) -> tuple[Array, Array]:
        """Levers (n,) of pinion and wheel: normal motion of a flank a radian of its travel."""
        return self.rows[8], self.rows[9]

    @property
    def pinion_place(self) -> tuple[Array, Array]:
        """(S, H) on the pinion."""
        return self.rows[10], self.rows[11]

    @property
    def wheel_place(self) -> tuple[Array, Array]:
        """(S, H) on the wheel."""
        return self.rows[12], self.rows[13]

    @property
    def limits(self) -> tuple[Array, Array]:
        """H (n,) of the fillet limit there, on pinion and wheel."""
        return self.rows[14], self.rows[15]


def _met(
    mount: Mounting,
    pinion: AngleField,
    wheel: AngleField,
    stand: tuple[Scalar, Scalar, Scalar],
    zero: Batch,
    axes: Batch,
    a: Batch,
    b: Batch,
) -> tuple[Batch, ...]:
    """Rows of a `Surface` on rays at (a, b) of the tangent plane; its origin and axes are given in the pinion's frame.

    `stand` is where the members stand, the pinion's angle and the wheel's lead, rad, and Newton's longest step, mm.
    """
    phi, rigid, farthest = stand

    def at(height: Batch) -> tuple[Batch, ...]:
        return tuple(
            zero[i] + a * axes[0, i] + b * axes[1, i] + height * axes[2, i] for i in range(3)
        )

    def miss(height: Batch) -> Batch:
        x, y, z = at(height)
        place = pinion.cone.cone_distance_height(z, jnp.sqrt(x * x + y * y))
        off = jnp.arctan2(y, x) - pinion.angle(*place)
        return off - 2.0 * jnp.pi * jnp.round(off / (2.0 * jnp.pi))

    def missed(height: Batch) -> tuple[Batch, Batch]:
        return jax.jvp(miss, (height,), (jnp.ones_like(height),))

    def step(state: tuple[Any, ...]) -> tuple[Any, ...]:
        count, height, off, slope = state
        move = jnp.clip(jnp.nan_to_num(-off / slope), -farthest, farthest)
        return count + 1, height + move, *missed(height + move)

    def going(state: tuple[Any, ...]) -> Batch:
        return (state[0] < STEPS) & (jnp.abs(state[2]).max() > ARRIVED)

    start = jnp.zeros_like(a)
    _, height, off, _ = jax.lax.while_loop(going, step, (0, start, *missed(start)))
    own = at(height)
    x, y, z = own
    rho = jnp.sqrt(x * x + y * y)
    place = pinion.cone.cone_distance_height(z, rho)
    one, none = jnp.ones_like(a), jnp.zeros_like(a)
    along, across = (jax.jvp(pinion.angle, place, way)[1] for way in ((one, none), (none, one)))
    sine, cosine = pinion.cone.sine, pinion.cone.cosine
    outward, axial = along * sine + across * cosine, along * cosine - across * sine
    slopes = -y / rho**2 - outward * x / rho, x / rho**2 - outward * y / rho, -axial
    up = sum(slopes[i] * axes[2, i] for i in range(3))
    size = jnp.sign(up) / jnp.sqrt(sum(s * s for s in slopes))
    out = tuple(s * size for s in slopes)
    point, normal = to_wheel(mount, phi, own), to_wheel(mount, phi, out, free=True)
    pinion_lever = -mount.sense * (x * out[1] - y * out[0])
    wheel_lever = jnp.abs(point[0] * normal[1] - point[1] * normal[0])
    places = (
        place,
        wheel.cone.cone_distance_height(point[2], jnp.sqrt(point[0] ** 2 + point[1] ** 2)),
    )
    leads = lead(mount, wheel, phi, own)
    held = pinion.holds(*place) & jnp.isfinite(leads) & (jnp.abs(off) < MISSED)
    gap = jnp.where(held, (rigid - leads) * wheel_lever, jnp.inf)
    limits = (f.lowest.bounds(s)[0] for f, (s, _) in zip((pinion, wheel), places, strict=True))
    levers = pinion_lever, wheel_lever
    return *point, *normal, up * size, gap, *levers, *places[0], *places[1], *limits


rows_on = Batched(_met, parameters=6, block=CELLS, most=2 * CELLS)
