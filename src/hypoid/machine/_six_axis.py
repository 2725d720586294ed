"""A free-form six-axis bevel machine: an NC axis table from any basic settings with motions, and back.

The machine, as modelled here: the tool spindle stands still in direction, its axis is z of the machine
frame, positive to the blade tips. The work head carries the work spindle, whose axis lies in the x-z plane,

* X, Y, Z: the member's crossing point as seen from the cutter's centre, mm;
* B: swing of the work head, the angle between work axis and the plane of the tips, rad;
* A: turn of the work, C: turn of the tool spindle, rad.

A cutter point t stands at Rz(-A) Ry(B - 90 deg) (Rz(C) t - (X, Y, Z)) in the member's frame (left hand).
On an untilted cradle machine B is the machine root angle. A real machine adds constant distances from its own
zero points to these numbers. Face milling leaves C free, since its tool is a surface of revolution; it is given
so that the motion is the same point by point. In face hobbing the cutter turns on by theta: C - theta and
A + R_b theta at every position.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev, polynomial

from hypoid.geometry import DesignError, Problem

from ._cam import cam_roll
from ._settings import ORDERS, MachineSettings, Motions

Array = np.ndarray[Any, Any]
PARALLEL = 1e-9  # cos(B) below which work and tool axis count as parallel
ARCSEC = np.degrees(1.0) * 3600.0


@dataclass(frozen=True)
class AxisTable:
    """Axis positions against the roll (the cradle's angle); (n,) each, mm and rad."""

    roll: Array
    x: Array
    y: Array
    z: Array
    a: Array
    b: Array
    c: Array
    roll_to_blade_ratio: float = 0.0  # R_b: what A gains per turn of the cutter

    def pose(self, index: int, theta: float = 0.0) -> Array:
        """The 4 x 4 motion from the cutter to the member's frame at one position."""
        a = self.a[index] + self.roll_to_blade_ratio * theta
        turned = _turn_z(-a) @ _turn_y(self.b[index] - np.pi / 2)
        made = np.eye(4)
        made[:3, :3] = turned @ _turn_z(self.c[index] - theta)
        made[:3, 3] = -turned @ [self.x[index], self.y[index], self.z[index]]
        return made


def axis_table(settings: MachineSettings, roll: Array) -> AxisTable:
    """Axis positions of basic settings at cradle angles ``roll`` (n,), rad; for a form cut they rest.

    Where work and tool axis are parallel, A and C turn about one line: the tool then keeps C = 0.

    Raises
    ------
    DesignError
        For a roll that is not a row of finite numbers.
    """
    roll = np.asarray(roll, float)
    if roll.ndim != 1 or not len(roll) or not np.isfinite(roll).all():
        given = f"{roll.size} numbers, {int((~np.isfinite(roll)).sum())} of them not finite"
        raise DesignError([Problem("roll", given, "a row of finite cradle angles", "[-0.3, 0.3]")])
    phi = roll if settings.generated else np.zeros_like(roll)
    at = {name: _moved(settings, name, phi) for name in Motions.__dataclass_fields__}
    base = at["sliding_base"] + settings.helical_motion * phi
    work = _work_roll(settings, phi)
    # the cutter's axis and centre in the machine frame of the cradle, work's zero turn
    turn = phi + np.pi / 2 - settings.cradle_angle + at["swivel_angle"]
    ct, st = np.cos(turn), np.sin(turn)
    ci, si = np.cos(at["tilt_angle"]), np.sin(at["tilt_angle"])
    sg, cg = np.sin(at["machine_root_angle"]), np.cos(at["machine_root_angle"])
    place = phi - settings.cradle_angle
    radial = at["radial_distance"]
    centre = radial * np.cos(place), radial * np.sin(place) + at["blank_offset"], -base

    def to_work(v: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
        return sg * v[0] - cg * v[2], v[1], cg * v[0] + sg * v[2]

    axis = to_work((ct * si, st * si, ci))
    sideways = to_work((-st, ct, 0.0 * ct))  # the cutter's y; its x completes them
    forward = to_work((ct * ci, st * ci, -si))
    px, py, pz = to_work(centre)
    pz = pz - at["machine_center_to_back"]
    sin_b = np.clip(axis[2], -1.0, 1.0)
    cos_b = np.hypot(axis[0], axis[1])
    single = cos_b < PARALLEL
    up = np.sign(sin_b)
    spin = up * np.arctan2(-forward[1], up * forward[0])  # of A alone, where C is kept at 0
    a = np.unwrap(np.where(single, spin, np.arctan2(axis[1], -axis[0])))
    c = np.unwrap(np.where(single, 0.0, np.arctan2(-sideways[2], forward[2])))
    b = np.arctan2(sin_b, cos_b)
    u, v = np.cos(a) * px - np.sin(a) * py, np.sin(a) * px + np.cos(a) * py
    x, y, z = -(sin_b * u + cos_b * pz), -v, -(-cos_b * u + sin_b * pz)
    return AxisTable(roll, x, y, z, a + work, b, c, settings.roll_to_blade_ratio)


@dataclass(frozen=True)
class BasicFit:
    """Basic settings that reproduce an axis table, and how well."""

    settings: MachineSettings
    centre_error: float  # mm, greatest distance of the cutter's centre from the table's
    axis_error: float  # arcsec, greatest angle of the cutter's axis to the table's


def basic_of(table: AxisTable, like: MachineSettings) -> BasicFit:
    """Basic settings of an axis table: many give one motion; this takes the constants of ``like``.

    Cradle angle, swivel angle, machine root angle and machine centre to back are those of ``like`` and
    do not move. Work roll, tilt, radial distance, blank offset and sliding base follow from the table in
    closed form at every position, each as a polynomial of up to sixth order of the roll (fewer if the
    table is short).

    Raises
    ------
    DesignError
        For a table that is too short, not finite or not in the order of its roll, and where ``like``
        cannot reach an axis position at all.
    """
    _check(table)
    poses = np.array([table.pose(k) for k in range(len(table.roll))])
    turn = table.roll + np.pi / 2 - like.cradle_angle + like.swivel_angle
    rolls = _rolls(poses[:, :3, 2], turn, like.machine_root_angle)
    fits = (_fitted(table, like, poses, turn, work) for work in rolls)
    return min(fits, key=lambda fit: fit.centre_error + _unlike(fit.settings, like))


def _unlike(settings: MachineSettings, like: MachineSettings) -> float:
    """How far the roll's root leads away: one turns the cutter to the other side of the cradle."""
    apart = settings.radial_distance - like.radial_distance
    return abs(apart) / max(like.radial_distance, 1.0) + abs(settings.tilt_angle - like.tilt_angle)


def _fitted(
    table: AxisTable, like: MachineSettings, poses: Array, turn: Array, work: Array
) -> BasicFit:
    """Basic settings for one root of the work roll."""
    phi, gamma, q = table.roll, like.machine_root_angle, like.cradle_angle
    sg, cg = np.sin(gamma), np.cos(gamma)

    def to_machine(v: Array) -> tuple[Array, Array, Array]:
        x = np.cos(work) * v[:, 0] - np.sin(work) * v[:, 1]
        y = np.sin(work) * v[:, 0] + np.cos(work) * v[:, 1]
        return sg * x + cg * v[:, 2], y, -cg * x + sg * v[:, 2]

    ax, ay, az = to_machine(poses[:, :3, 2])
    tilt = np.arctan2(ax * np.cos(turn) + ay * np.sin(turn), az)
    px, py, pz = to_machine(poses[:, :3, 3] + [0.0, 0.0, like.machine_center_to_back])
    radial = px / np.cos(q - phi)
    offset = py + radial * np.sin(q - phi)
    order = min(ORDERS, len(phi) - 1)
    fits = [_fit(phi, values, order) for values in (work, tilt, radial, offset, -pz)]
    roll, tilts, radials, offsets, bases = fits
    settings = replace(
        like,
        ratio_of_roll=roll[1],
        modified_roll=tuple(c / roll[1] for c in roll[2:]),
        tilt_angle=tilts[0],
        radial_distance=radials[0],
        blank_offset=offsets[0],
        sliding_base=bases[0],
        helical_motion=bases[1],
        roll_to_blade_ratio=table.roll_to_blade_ratio,
        cam=None,
        generated=True,
        motions=Motions(
            radial_distance=radials[1:],
            tilt_angle=tilts[1:],
            blank_offset=offsets[1:],
            sliding_base=(0.0, *bases[2:]),
        ),
    )
    again = axis_table(settings, phi)
    made = np.array([again.pose(k) for k in range(len(phi))])[:, :3]
    made = _turn_z(-roll[0]) @ made  # the table's own zero of A
    apart = np.linalg.norm(made[:, :, 3] - poses[:, :3, 3], axis=1)
    lean = np.linalg.norm(np.cross(made[:, :, 2], poses[:, :3, 2]), axis=1)
    return BasicFit(settings, float(apart.max()), float(np.arcsin(lean.max()) * ARCSEC))


def _rolls(axis: Array, turn: Array, gamma: float) -> tuple[Array, Array]:
    """Both work turns W that bring the cutter's axis into the cradle's plane of tilt."""
    sg, cg = np.sin(gamma), np.cos(gamma)
    s, c = -np.sin(turn), np.cos(turn)  # across the plane of tilt
    first = s * sg * axis[:, 0] + c * axis[:, 1]
    second = -s * sg * axis[:, 1] + c * axis[:, 0]
    rest = s * cg * axis[:, 2]
    size = np.hypot(first, second)
    if np.any(np.abs(rest) > size * (1.0 + 1e-9)):
        given = f"a machine root angle of {np.degrees(gamma):.6g} deg"
        expected = "one from which a tilt in the plane of the swivel reaches every position"
        raise DesignError([Problem("machine_root_angle", given, expected, "B at roll 0")])
    middle = np.arctan2(second, first)
    half = np.arccos(np.clip(-rest / size, -1.0, 1.0))
    roots = np.stack([middle + half, middle - half])
    return _followed(roots, 0), _followed(roots, 1)


def _followed(roots: Array, start: int) -> Array:
    """One of two roots (2, n), angles, followed both ways from the middle, straight on where they cross."""
    count = roots.shape[1]
    middle = count // 2
    path = np.zeros(count)
    path[middle] = roots[start, middle]
    for step in (1, -1):
        last, slope = path[middle], 0.0
        for k in range(middle + step, count if step > 0 else -1, step):
            off = np.remainder(roots[:, k] - last - slope + np.pi, 2.0 * np.pi) - np.pi
            now = last + slope + off[np.argmin(np.abs(off))]
            last, slope = now, now - last
            path[k] = now
    return path


def _fit(phi: Array, values: Array, order: int) -> tuple[float, ...]:
    """Coefficients of phi**0 ... phi**order by least squares in Chebyshev's basis."""
    middle, half = 0.5 * (phi[0] + phi[-1]), 0.5 * (phi[-1] - phi[0])
    series = chebyshev.chebfit((phi - middle) / half, values, order)
    powers, total = chebyshev.cheb2poly(series), np.zeros(1)
    for c in powers[::-1]:
        total = polynomial.polyadd(polynomial.polymul(total, [-middle / half, 1.0 / half]), [c])
    return tuple(float(c) for c in np.resize(np.append(total, np.zeros(ORDERS)), order + 1))


def _check(table: AxisTable) -> None:
    problems: list[Problem] = []
    columns = np.array([table.roll, table.x, table.y, table.z, table.a, table.b, table.c])
    if len(table.roll) < 2:
        given = f"{len(table.roll)} positions"
        problems.append(Problem("table", given, "at least 2 positions", "21 positions"))
    elif not np.isfinite(columns).all():
        where = int(np.argmax(~np.isfinite(columns).all(axis=0)))
        problems.append(Problem(f"table row {where}", "not a number", "finite numbers", "0.0"))
    elif not (np.diff(table.roll) > 0.0).all():
        where = int(np.argmax(np.diff(table.roll) <= 0.0)) + 1
        given = f"roll {table.roll[where]:.6g} after {table.roll[where - 1]:.6g}"
        problems.append(Problem(f"table row {where}", given, "a growing roll", "-0.1, 0.0, 0.1"))
    if problems:
        raise DesignError(problems)


def _moved(settings: MachineSettings, name: str, phi: Array) -> Array:
    powers = [getattr(settings, name), *getattr(settings.motions, name)]
    return polynomial.polyval(phi, powers)


def _work_roll(settings: MachineSettings, phi: Array) -> Array:
    if settings.cam is not None:
        return np.asarray(cam_roll(settings.cam, phi)[0])
    return settings.ratio_of_roll * polynomial.polyval(phi, [0.0, 1.0, *settings.modified_roll])


def _turn_z(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _turn_y(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
