"""Contact as a pure function of all that makes it, for JAX to differentiate.

At a contact that was found, points are held to their cutter turns and cradle angles, where a change of
anything is a rigid motion. That they must meet again, and mesh, moves them besides; both are linear,
and how they are is known from the slopes at the contact (the implicit function theorem). So a function
here costs one rigid motion a point and searches nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from hypoid.flank import Flank, FlankParameters, HeldPoints, flank_parameters, held_points
from hypoid.geometry import Batch

from ._mounting import Mounting, to_wheel
from ._pattern import ease_off, vertices
from ._unloaded import UnloadedContact

Array = np.ndarray[Any, Any]
# What is seen of both members' points (7, n each) under a mounting: conditions (rows, n), then quantities.
Rows = Callable[[Mounting, Batch, Batch], tuple[Batch, Batch]]
SLACK = 1e-9  # mm that a point may lie beyond the blade's flank piece


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class ContactParameters:
    """What a contact depends on: both flanks, and offset, pinion axial, wheel axial and shaft angle errors."""

    pinion: FlankParameters
    wheel: FlankParameters
    misalignment: Batch  # (4,) dE, dP, dG (mm), dSigma (rad), beside those of the contact


@dataclass(frozen=True)
class TracedContact:
    """One direction's contact with its parameters; every method is a pure function of them.

    Values and first derivatives are exact at the contact's own parameters, and linear about them.
    """

    contact: UnloadedContact
    parameters: ContactParameters

    @property
    def pinion_angle(self) -> Array:
        """(n,) pinion angles of the path, rad, at which this pair's flanks meet inside."""
        return self.contact.phi[self.contact.on_path]

    def transmission_error(self, parameters: ContactParameters) -> Batch:
        """(n,) wheel angle minus z1/z2 pinion angle along the path, rad, less its value at zero.

        Empty, as the path, where the flanks never meet inside.
        """
        lead = self.contact.points.lead[self.contact.on_path] + self._path(parameters)[0]
        nearest = np.argsort(np.abs(self.pinion_angle), kind="stable")[:1]  # none without a path
        return lead - lead[nearest].sum()

    def path(self, parameters: ContactParameters) -> Batch:
        """(n, 2) path of contact on the pinion as (S, H), mm."""
        return jnp.stack(self.contact.path, axis=1) + self._path(parameters)[1:].T

    def ease_off(self, parameters: ContactParameters, rows: int = 5, columns: int = 9) -> Batch:
        """(rows, columns) ease-off over the pinion's active flank, mm, uniform motion.

        At fixed places (S, H), root to tip and toe to heel; NaN where the conjugate leaves the mate. The
        lead of each node is stationary in the pinion angle, which is therefore held.
        """
        value, there, moving = self._nodes(rows, columns)
        lead, lever = self._moved(moving, parameters)
        held = moving.quantities
        change = -(held[0] * lever + lead * held[1])
        made = jnp.full(value.size, jnp.nan).at[there].set(value[there] + change)
        return made.reshape(rows, columns)

    def _path(self, parameters: ContactParameters) -> Batch:
        """(3, n): change of lead, S and H of the pinion along the path."""
        return self._moved(self._meeting, parameters)

    @cached_property
    @jax.ensure_compile_time_eval()
    def _meeting(self) -> _Moving:
        contact, points = self.contact, self.contact.points
        on = contact.on_path
        cone, phi = contact.pinion_flank.cone, self.pinion_angle

        def rows(mount: Mounting, pinion: Batch, wheel: Batch) -> tuple[Batch, Batch]:
            z, rho, radial, axial, _, angle = _about_wheel(_carried(mount, phi, pinion))
            z2, rho2, radial2, axial2, _, angle2 = _about_wheel(wheel)
            conditions = (z - z2, rho - rho2, radial + radial2, axial + axial2, pinion[6], wheel[6])
            place = cone.cone_distance_height(pinion[2], jnp.hypot(pinion[0], pinion[1]))
            lead = mount.sense * (angle2 - angle) - mount.wheel_zero
            return jnp.stack(conditions), jnp.stack((lead, *place))

        pinion = points.s1[on], points.theta1[on]
        return self._moving(rows, phi, pinion, (points.s2[on], points.theta2[on]))

    @jax.ensure_compile_time_eval()
    def _nodes(self, rows: int, columns: int) -> tuple[Array, Array, _Moving]:
        """Ease-off of nodes, indices of those that count, and how their lead and lever move."""
        contact, nodes = self.contact, self.contact.nodes
        i = np.linspace(0, nodes.height.shape[0] - 1, rows).round().astype(int)
        j = np.linspace(0, nodes.height.shape[1] - 1, columns).round().astype(int)
        index = (i[:, None] * nodes.height.shape[1] + j).ravel()
        value = ease_off(contact).value.ravel()[index]
        phi = vertices(contact)[0][index]
        piece = contact.pinion_flank.pieces["flank"]
        there = np.isfinite(value) & (nodes.s[index] <= float(piece.high) + SLACK)
        # the wheel's points that stand at the same z and rho
        x, y, z = (
            np.asarray(c) for c in to_wheel(contact.mount, phi, tuple(nodes.point[:, index]))
        )  # pyright: ignore
        flank = contact.wheel_flank
        s, turn, _ = flank.parameters(*flank.cone.cone_distance_height(z, np.hypot(x, y)))
        there = np.flatnonzero(there & np.isfinite(s))
        phi, index, s, turn = phi[there], index[there], s[there], turn[there]
        cone = contact.pinion_flank.cone
        own = np.stack(
            cone.axial_radial(
                nodes.distance[index % len(nodes.distance)], nodes.height.ravel()[index]
            )
        )

        def seen(mount: Mounting, pinion: Batch, wheel: Batch) -> tuple[Batch, Batch]:
            z, rho, _, _, lever, angle = _about_wheel(_carried(mount, phi, pinion))
            z2, rho2, *_, angle2 = _about_wheel(wheel)
            stay = pinion[2] - own[0], jnp.hypot(pinion[0], pinion[1]) - own[1]
            conditions = (*stay, z2 - z, rho2 - rho, pinion[6], wheel[6])
            lead = mount.sense * (angle2 - angle) - mount.wheel_zero - mount.ratio * phi
            return jnp.stack(conditions), jnp.stack((lead, jnp.abs(lever)))

        return (
            value,
            there,
            self._moving(seen, phi, (nodes.s[index], nodes.theta[index]), (s, turn)),
        )

    def _moving(
        self, rows: Rows, phi: Array, pinion: tuple[Array, Array], wheel: tuple[Array, Array]
    ) -> _Moving:
        """Points of both flanks at (s, turn), their pitch points behind them, and what follows what."""
        contact, cones = self.contact, self.contact.pair.blank.cones

        def held(flank: Flank, at: tuple[Array, Array], distance: float) -> HeldPoints:
            pitch = flank.parameters([distance], [0.0])[:2]
            return held_points(flank, *(np.append(a, p) for a, p in zip(at, pitch, strict=True)))

        first = held(contact.pinion_flank, pinion, cones.pinion_mean_cone_distance)
        second = held(contact.wheel_flank, wheel, cones.wheel_mean_cone_distance)
        at = jnp.asarray(first.own[:, :-1]), jnp.asarray(second.own[:, :-1])

        def seen(*both: Batch) -> tuple[Batch, Batch]:
            return rows(contact.mount, *both)

        still = jnp.zeros_like(at[0])
        ways = [(jnp.asarray(way), still) for way in first.slopes[:, :, :-1]]
        ways += [(still, jnp.asarray(way)) for way in second.slopes[:, :, :-1]]
        slopes = [jax.jvp(seen, at, way)[1] for way in ways]
        # (n, rows, 6) by the points' own parameters
        conditions, quantities = (
            np.stack([np.asarray(s[k]) for s in slopes], axis=-1).transpose(1, 0, 2) for k in (0, 1)
        )
        follow = np.linalg.solve(conditions.transpose(0, 2, 1), quantities.transpose(0, 2, 1))
        still_met, own = (np.asarray(v) for v in seen(*at))
        return _Moving(rows, phi, first, second, still_met, own, follow.transpose(0, 2, 1))

    def _moved(self, moving: _Moving, parameters: ContactParameters) -> Batch:
        """(rows, n): how quantities change under parameters, with all that must stay met."""
        first = moving.pinion.seen(parameters.pinion)
        second = moving.wheel.seen(parameters.wheel)
        turns = _turn(moving.pinion.own, first), _turn(moving.wheel.own, second)
        mount = self._mount(parameters.misalignment, *turns)
        conditions, quantities = moving.rows(mount, first[:, :-1], second[:, :-1])
        left, change = conditions - moving.conditions, quantities - moving.quantities
        return change - jnp.einsum("nqc,cn->qn", moving.follow, left)

    def _mount(self, misalignment: Batch, pinion_turn: Batch, wheel_turn: Batch) -> Mounting:
        """The contact's mounting with errors on top; pitch points that turned (rad) meet at zero again."""
        contact, own = self.contact, self.contact.misalignment
        mount, cones = contact.mount, contact.pair.blank.cones
        offset, out, back, angle = (misalignment[k] for k in range(4))
        sigma = cones.shaft_angle + own.shaft_angle + angle
        c, s = jnp.cos(sigma), jnp.sin(sigma)
        out, zero = own.pinion_axial + out, 0.0 * c
        return replace(
            mount,
            axes=((-c, zero, s), (zero, 1.0 + zero, zero), (s, zero, c)),
            shift=(
                out * s,
                -(cones.offset + own.offset + offset),
                out * c - own.wheel_axial - back,
            ),
            pinion_zero=mount.pinion_zero - pinion_turn,
            wheel_zero=mount.wheel_zero + mount.sense * wheel_turn,
        )


def traced_contact(contact: UnloadedContact) -> TracedContact:
    """A contact that was found, as functions of its parameters."""
    flanks = contact.pinion_flank, contact.wheel_flank
    return TracedContact(contact, ContactParameters(*map(flank_parameters, flanks), jnp.zeros(4)))  # pyright: ignore


@dataclass(frozen=True, eq=False)
class _Moving:
    """Points of both members, what is looked at there, and how it follows what must stay met."""

    rows: Rows
    phi: Array  # (n,) pinion angles, rad
    pinion: HeldPoints
    wheel: HeldPoints
    conditions: Array  # (6, n) as held
    quantities: Array  # (q, n) as held
    follow: Array  # (n, q, 6) change of the quantities per unit of what the conditions leave


def _carried(mount: Mounting, phi: Batch, seen: Batch) -> Batch:
    """Points and normals (6, n) of the pinion in the wheel's frame at pinion angles phi."""
    point = to_wheel(mount, phi, (seen[0], seen[1], seen[2]))
    normal = to_wheel(mount, phi, (seen[3], seen[4], seen[5]), free=True)
    return jnp.stack((*point, *normal))


def _about_wheel(seen: Batch) -> tuple[Batch, ...]:
    """z, rho, normal (radial, axial), lever (mm) and angle of points about the wheel's axis."""
    x, y, z, nx, ny, nz = seen[:6]
    rho = jnp.hypot(x, y)
    return z, rho, (x * nx + y * ny) / rho, nz, x * ny - y * nx, jnp.arctan2(y, x)


def _turn(own: Array, seen: Batch) -> Batch:
    """Angle by which the flank at its last point's place turns about its axis, rad, left hand."""
    x, y, _, nx, ny, nz, _ = own[:, -1]
    moved = (seen[:3, -1] - own[:3, -1]) @ np.array([nx, ny, nz])
    return moved / (x * ny - y * nx)
