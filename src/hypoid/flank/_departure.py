"""A smooth departure of a flank from the one that its edge generates: an angle over (S, H) that is added to its own.

Place (z, rho) stays, so whatever asks a flank at a place, or meets it in contact, takes the departed one as any other.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import jax
import jax.numpy as jnp

from hypoid.geometry import Batch, horner, on_unit
from hypoid.machine import Placed

if TYPE_CHECKING:
    from ._chart import Border, PitchCone


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Departure:
    """Polynomial (i, j) in x from toe to heel and y from low to high, rad; straight on beyond [-1, 1]."""

    powers: Batch
    toe: Batch  # S, mm
    heel: Batch
    low: Border
    high: Border
    cone: PitchCone

    def angle(self, distance: Batch, height: Batch) -> Batch:
        """Angle (rad, left hand) that is added at (S, H), mm."""
        x = on_unit(self.toe, self.heel, distance)
        y = on_unit(self.low.at(distance), self.high.at(distance), height)
        u, v = jnp.clip(x, -1.0, 1.0), jnp.clip(y, -1.0, 1.0)

        def value(a: Batch, b: Batch) -> Batch:
            return horner(self.powers, a, b)

        at, beyond = jax.jvp(value, (u, v), (x - u, y - v))
        return at + beyond


def departed(at: Placed, departure: Departure) -> Placed:
    """Points turned by the departure, and the normals that go with it.

    A flank is angle = f(z, rho), so its normal runs with grad(angle - f): the departure's gradient is taken off.
    """
    x, y, z = at.point
    rho = jnp.sqrt(x * x + y * y)

    def added(a: Batch, b: Batch) -> Batch:
        return departure.angle(*departure.cone.cone_distance_height(a, b))

    one, zero = jnp.ones_like(z), jnp.zeros_like(z)
    angle, by_z = jax.jvp(added, (z, rho), (one, zero))
    _, by_rho = jax.jvp(added, (z, rho), (zero, one))
    nx, ny, nz = at.normal
    lever = x * ny - y * nx
    out = lever * by_rho / rho
    normal = (nx - out * x, ny - out * y, nz - lever * by_z)
    return replace(at, normal=normal, turn=at.turn - angle)
