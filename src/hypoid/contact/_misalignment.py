"""What errors of mounting do to the contact: sensitivities, and the V-H check to toe and heel."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.pair import Direction, GearPair

from ._mounting import Misalignment, mounting, to_wheel
from ._pattern import pattern
from ._unloaded import Sampling, UnloadedContact, unloaded_contact

Array = np.ndarray[Any, Any]

# Steps of the sensitivity table: errors of a gearbox of this size [gonzalez2022, section 6.3].
STEPS = Misalignment(offset=0.05, pinion_axial=0.05, wheel_axial=0.05, shaft_angle=np.deg2rad(0.05))
NAMES = ("offset", "pinion_axial", "wheel_axial", "shaft_angle")


@dataclass(frozen=True)
class MisalignedContact:
    """The contact under one error of mounting, as numbers (mm, rad)."""

    misalignment: Misalignment
    peak_to_peak: float
    contact_ratio: float
    edge_contact: bool
    pattern_share: float
    pattern_centre: tuple[float, float]  # (S, H) on the pinion
    contact_point: tuple[float, float]  # (S, H) on the pinion at pinion angle zero, NaN if none


def summary(contact: UnloadedContact) -> MisalignedContact:
    """The numbers of one contact that a table of errors shows."""
    marked = pattern(contact)
    return MisalignedContact(
        contact.misalignment,
        contact.peak_to_peak,
        contact.contact_ratio,
        contact.edge_contact,
        marked.share,
        marked.centre,
        contact.contact_point,
    )


def contacts(
    pair: GearPair,
    direction: Direction,
    misalignments: Sequence[Misalignment],
    sampling: Sampling | None = None,
) -> Iterator[UnloadedContact]:
    """Unloaded contacts of many mountings, one after the other: charts and code are shared."""
    for error in misalignments:
        yield unloaded_contact(pair, direction, error, sampling)


def sensitivity(
    pair: GearPair,
    direction: Direction,
    steps: Misalignment = STEPS,
    sampling: Sampling | None = None,
    progress: Callable[[], None] = lambda: None,
) -> tuple[MisalignedContact, ...]:
    """The aligned contact, then each of the four errors at its step, first minus then plus."""
    errors = [Misalignment()]
    for name in NAMES:
        for sign in (-1.0, 1.0):
            errors.append(replace(Misalignment(), **{name: sign * getattr(steps, name)}))
    rows: list[MisalignedContact] = []
    for contact in contacts(pair, direction, errors, sampling):
        rows.append(summary(contact))
        progress()
    return tuple(rows)


@dataclass(frozen=True)
class VHResult:
    """Offset error V and pinion axial error H that bring the contact to a place on the pinion."""

    place: str
    target: tuple[float, float]  # (S, H) on the pinion, mm
    misalignment: Misalignment
    residual: float
    found: bool


def vh_check(contact: UnloadedContact, share: float = 0.25) -> tuple[VHResult, ...]:
    """V-H check: errors dE and dP that put the mean contact at toe and heel.

    The targets lie at ``share`` of the face width from toe and from heel, at mid height. There both
    normals coincide and the wheel keeps the mean ratio, the condition of a contact centred there.
    The given contact (aligned) tells at which pinion angle to start.
    """
    columns = len(contact.nodes.distance)
    row = len(contact.nodes.share) // 2
    side = round(share * (columns - 1))
    places = {"toe": row * columns + side, "heel": row * columns + columns - 1 - side}
    return tuple(_bring_to(contact, place, node) for place, node in places.items())


def _bring_to(contact: UnloadedContact, place: str, node: int) -> VHResult:
    from scipy.optimize import root

    pair, direction = contact.pair, contact.direction
    pinion, wheel = pair.mates(direction)
    distance, height = contact.nodes.distance, contact.nodes.height
    target = (float(distance[node % len(distance)]), float(height.ravel()[node]))
    start = float(contact.phi[contact.leads[:, node].argmax()])
    at = pinion.at_cone([target[0]], [target[1]])
    point, normal = (at.position * pinion.hand)[0], (at.normal * pinion.hand)[0]

    def conditions(unknown: Array) -> Array:
        phi, offset, axial = unknown
        mount = mounting(pair, direction, Misalignment(offset, axial))

        def seen(angle: float) -> Array:
            return np.array([float(c) for c in to_wheel(mount, angle, tuple(point))])  # type: ignore[arg-type]

        x, y, z = seen(phi)
        nx, ny, nz = (float(c) for c in to_wheel(mount, phi, tuple(normal), free=True))  # type: ignore[arg-type]
        rho = np.hypot(x, y)
        mate = wheel.at([z], [rho])
        if not mate.ok[0]:
            return np.full(3, 1e3)
        px, py, _ = mate.position[0]
        mx, my, mz = mate.normal[0]
        radial, tangential = (px * mx + py * my) / rho, (px * my - py * mx) / rho
        tangential *= -1.0 if wheel.mirrored else 1.0
        step = 1e-4
        dx, dy, dz = (seen(phi + step) - seen(phi - step)) / (2.0 * step)
        d_rho, d_angle = (x * dx + y * dy) / rho, (x * dy - y * dx) / rho**2
        field = -(mz * dz + radial * d_rho) / (rho * tangential)
        rate = float(mount.sense) * (field - d_angle) - pair.ratio
        return np.array([(x * nx + y * ny) / rho + radial, nz + mz, rate * rho])

    answer: Any = root(
        conditions, np.array([start, 0.0, 0.0]), method="hybr", options={"xtol": 1e-10}
    )
    left = float(np.abs(answer.fun).max())
    return VHResult(
        place,
        target,
        Misalignment(float(answer.x[1]), float(answer.x[2])),
        left,
        bool(np.isfinite(left) and left < 1e-7),
    )
