"""Contact as a pure function of all that makes it, for JAX to differentiate.

At a contact that was found, one Newton step whose Jacobian is held carries the derivatives of the
contact point (the implicit function theorem); the lead follows. Values are those of
``unloaded_contact``, so a function here costs no search.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.flank import (
    Flank,
    FlankParameters,
    axial_radial_angle,
    flank_parameters,
    position_and_normal,
    traced_surface,
)
from hypoid.geometry import Batch, horner

from ._mounting import Mounting, to_wheel
from ._refine import pinion_seen, wheel_seen
from ._unloaded import UnloadedContact


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class ContactParameters:
    """What a contact depends on: both flanks, and offset, pinion axial, wheel axial and shaft angle errors."""

    pinion: FlankParameters
    wheel: FlankParameters
    misalignment: Batch  # (4,) dE, dP, dG (mm), dSigma (rad), beside those of the contact


@dataclass(frozen=True)
class TracedContact:
    """One direction's contact with its parameters; every method is a pure function of them."""

    contact: UnloadedContact
    parameters: ContactParameters

    @property
    def pinion_angle(self) -> np.ndarray:
        """(n,) pinion angles of the path, rad, at which this pair's flanks meet inside."""
        return self.contact.phi[self.contact.on_path]

    def transmission_error(self, parameters: ContactParameters) -> Batch:
        """(n,) wheel angle minus z1/z2 pinion angle along the path, rad, less its value at zero."""
        lead = self._met(parameters)[1]
        zero = int(np.argmin(np.abs(self.pinion_angle)))
        return lead - lead[zero]

    def path(self, parameters: ContactParameters) -> Batch:
        """(n, 2) path of contact on the pinion as (S, H), mm."""
        at, _ = self._met(parameters)
        pinion = self.contact.pinion_flank
        surface = traced_surface(parameters.pinion, pinion)
        point, _ = position_and_normal(surface, parameters.pinion.edge, at[:, 0], at[:, 1])
        rho = jnp.hypot(point[0], point[1])
        return jnp.stack(pinion.cone.cone_distance_height(point[2], rho), axis=1)

    def ease_off(self, parameters: ContactParameters, rows: int = 5, columns: int = 9) -> Batch:
        """(rows, columns) ease-off over the pinion's active flank, mm, uniform motion.

        At fixed places (S, H), root to tip and toe to heel; NaN where the conjugate leaves the mate. The
        lead of each node is stationary in the pinion angle, which is therefore held.
        """
        nodes = self.contact.nodes
        i = np.linspace(0, nodes.height.shape[0] - 1, rows).round().astype(int)
        j = np.linspace(0, nodes.height.shape[1] - 1, columns).round().astype(int)
        index = (i[:, None] * nodes.height.shape[1] + j).ravel()
        phi, found = self._vertices(index)
        place = np.stack(
            [
                np.broadcast_to(nodes.distance[j], (rows, columns)).ravel(),
                nodes.height[i][:, j].ravel(),
            ]
        )
        start = np.stack([nodes.s[index], nodes.theta[index]], axis=1)
        lead, lever = self._lead_at(parameters, place.T, start, phi)
        return jnp.where(found, -lead * lever, jnp.nan).reshape(rows, columns)

    def _mount(self, parameters: ContactParameters) -> Mounting:
        """The contact's mounting with the parameters' errors on top; both pitch points meet at zero."""
        contact, own = self.contact, self.contact.misalignment
        cones, sense = contact.pair.blank.cones, contact.mount.sense
        pinion_angle = _mean_angle(
            contact.pinion_flank, parameters.pinion, cones.pinion_mean_cone_distance
        )
        wheel_angle = _mean_angle(
            contact.wheel_flank, parameters.wheel, cones.wheel_mean_cone_distance
        )
        offset, pinion, wheel, angle = (parameters.misalignment[k] for k in range(4))
        sigma = contact.pair.blank.cones.shaft_angle + own.shaft_angle + angle
        c, s = jnp.cos(sigma), jnp.sin(sigma)
        out, zero = own.pinion_axial + pinion, 0.0 * c
        return replace(
            contact.mount,
            axes=((-c, zero, s), (zero, 1.0 + zero, zero), (s, zero, c)),
            shift=(
                out * s,
                -(contact.pair.blank.cones.offset + own.offset + offset),
                out * c - own.wheel_axial - wheel,
            ),
            pinion_zero=cones.pinion_azimuth - pinion_angle,
            wheel_zero=sense * (cones.wheel_azimuth + wheel_angle),
        )

    def _met(self, parameters: ContactParameters) -> tuple[Batch, Batch]:
        """(n, 4) edge parameters and turns of both flanks where they meet, and the lead (n,)."""
        contact, points = self.contact, self.contact.points
        on = contact.on_path
        start = np.stack([points.s1, points.theta1, points.s2, points.theta2], axis=1)[on]
        mount = self._mount(parameters)
        first = traced_surface(parameters.pinion, contact.pinion_flank)
        second = traced_surface(parameters.wheel, contact.wheel_flank)

        def seen(x: Batch, phi: Batch) -> tuple[Any, Any]:
            p = pinion_seen(mount, first, parameters.pinion.edge, phi, x[0], x[1])
            return p, wheel_seen(second, parameters.wheel.edge, x[2], x[3])

        def conditions(x: Batch, phi: Batch) -> Batch:
            p, w = seen(x, phi)
            return jnp.stack([p[0] - w[0], p[1] - w[1], p[2] + w[2], p[3] + w[3]])

        def one(x: Batch, phi: Batch) -> tuple[Batch, Batch]:
            x = implicit(lambda y: conditions(y, phi), x)
            p, w = seen(x, phi)
            return x, mount.sense * (w[5] - p[5]) - mount.wheel_zero - mount.ratio * phi

        return jax.vmap(one)(jnp.asarray(start), jnp.asarray(self.pinion_angle))

    def _lead_at(
        self, parameters: ContactParameters, place: Any, start: Any, phi: Any
    ) -> tuple[Batch, Batch]:
        """Lead that pinion places (n, 2) ask for at pinion angles (n,), and the wheel's levers (n,)."""
        contact, mount = self.contact, self._mount(parameters)
        pinion, wheel = contact.pinion_flank, contact.wheel_flank
        first = traced_surface(parameters.pinion, pinion)
        second = traced_surface(parameters.wheel, wheel)
        chart = wheel.charts["flank"]

        def on_pinion(x: Batch, at: Batch) -> Batch:
            point, _ = position_and_normal(first, parameters.pinion.edge, x[0], x[1])
            rho = jnp.hypot(point[0], point[1])
            return jnp.stack(pinion.cone.cone_distance_height(point[2], rho)) - at

        def one(at: Batch, x: Batch, phi: Batch, y: Batch) -> tuple[Batch, Batch]:
            x = implicit(lambda v: on_pinion(v, at), x, steps=2)
            p = pinion_seen(mount, first, parameters.pinion.edge, phi, x[0], x[1])

            def on_wheel(v: Batch) -> Batch:
                w = wheel_seen(second, parameters.wheel.edge, v[0], v[1])
                return jnp.stack([w[0] - p[0], w[1] - p[1]])

            y = implicit(on_wheel, y, steps=2)  # from the chart
            w = wheel_seen(second, parameters.wheel.edge, y[0], y[1])
            lead = mount.sense * (w[5] - p[5]) - mount.wheel_zero - mount.ratio * phi
            return lead, jnp.abs(p[1] * p[4])

        # where the wheel's own search begins: read from its chart at the parameters of the contact
        nodes = contact.nodes
        held = tuple(jnp.asarray(v) for v in self._held(nodes, place))
        x, y, z = to_wheel(contact.mount, jnp.asarray(phi), held)  # pyright: ignore[reportArgumentType]
        distance, height = wheel.cone.cone_distance_height(z, jnp.hypot(x, y))
        u, v = (jnp.clip(c, -1.0, 1.0) for c in chart.coordinates(distance, height))
        begin = jnp.stack([horner(chart.s, u, v), horner(chart.theta, u, v)], axis=1)
        return jax.vmap(one)(jnp.asarray(place), jnp.asarray(start), jnp.asarray(phi), begin)

    def _held(self, nodes: Any, place: Any) -> np.ndarray:
        """Pinion points at places, as the contact has them (left hand), mm (3, n)."""
        pinion = self.contact.pinion_flank
        points = pinion.at_cone(place[:, 0], place[:, 1])
        return (points.position * pinion.hand).T

    def _vertices(self, index: Any) -> tuple[np.ndarray, np.ndarray]:
        """Pinion angles where nodes' leads are greatest, and whether they are within the passage."""
        leads, phi = self.contact.leads[:, index], self.contact.phi
        best, columns = leads.argmax(axis=0), np.arange(leads.shape[1])
        inside = (best > 0) & (best < len(phi) - 1)
        k = np.clip(best, 1, len(phi) - 2)
        lower, top, upper = (leads[k + d, columns] for d in (-1, 0, 1))
        inside &= np.isfinite(lower) & np.isfinite(upper)
        lower, top, upper = (
            np.where(inside, v, d) for v, d in ((lower, 0.0), (top, 1.0), (upper, 0.0))
        )
        shift = 0.5 * (lower - upper) / (lower - 2.0 * top + upper)
        return phi[k] + shift * (phi[1] - phi[0]), inside


def traced_contact(contact: UnloadedContact) -> TracedContact:
    """A contact that was found, as functions of its parameters."""
    parameters = ContactParameters(
        flank_parameters(contact.pinion_flank),
        flank_parameters(contact.wheel_flank),
        jnp.zeros(4),
    )
    return TracedContact(contact, parameters)


def _mean_angle(flank: Flank, parameters: FlankParameters, distance: float) -> Batch:
    """Angle of a flank's mean point about its axis, left hand, rad: what a mounting counts from."""
    surface = traced_surface(parameters, flank)
    wanted = jnp.array([distance, 0.0])

    def conditions(x: Batch) -> Batch:
        z, rho, _ = axial_radial_angle(surface, parameters.edge, x[0], x[1])
        return jnp.stack(flank.cone.cone_distance_height(z, rho)) - wanted

    s, turn, _ = flank.parameters([distance], [0.0])
    x = implicit(conditions, jnp.array([s[0], turn[0]]))
    return axial_radial_angle(surface, parameters.edge, x[0], x[1])[2]


def implicit(conditions: Callable[[Batch], Batch], start: Batch, steps: int = 1) -> Batch:
    """Root (k,) of k conditions near a start, with its derivatives by all that they close over."""
    held = jax.lax.stop_gradient

    def step(x: Batch) -> Batch:
        return x - jnp.linalg.solve(held(jax.jacfwd(conditions)(x)), conditions(x))

    x = held(start)
    for _ in range(steps - 1):
        x = held(step(x))
    return step(x)
