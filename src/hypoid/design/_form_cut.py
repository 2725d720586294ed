"""Where a form-cut wheel's flanks pass the mean point, in plain floats: its angles and its slot.

Rolled with nothing, each side of the slot stands half a slot off the plane of the mean point, so that
pressure and spiral angle there are not quite those of the blades: the angles of a blade and the
cutter's place are corrected until they are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import asin, atan2, cos, hypot, pi, sin

import numpy as np

from hypoid.blank import MemberBlank

from ._wheel_settings import WheelCut, wheel_cut

Vector = tuple[float, float, float]
PASSES, NEWTON = 12, 30
SETTLED = 1e-12


@dataclass(frozen=True)
class FormPoint:
    """A form-cut flank at the mean cone distance, on the pitch cone (left hand); rad."""

    pressure: float
    spiral: float
    angle: float  # about the axis


def form_point(cut: WheelCut, blank: MemberBlank, outside: bool) -> FormPoint:
    """Angles of the flank that a blade cuts, at the mean point's cone distance."""
    side, i = (1.0, 0) if outside else (-1.0, 1)
    radius, alpha = cut.point_radii[i], cut.blade_angles[i]
    sine, cosine = sin(cut.machine_root_angle), cos(cut.machine_root_angle)
    x0, back = cut.radial_distance * cos(cut.cradle_angle), cut.machine_center_to_back
    y0 = -cut.radial_distance * sin(cut.cradle_angle)

    def member(v: Vector, withdrawn: float) -> Vector:
        return sine * v[0] - cosine * v[2], v[1], cosine * v[0] + sine * v[2] - withdrawn

    def surface(u: float, t: float) -> tuple[Vector, Vector, Vector]:
        r, c, s = radius + side * u * sin(alpha), cos(t), sin(t)
        point = member((x0 + r * c, y0 + r * s, cut.deeper - u * cos(alpha)), back)
        by_u = member((side * sin(alpha) * c, side * sin(alpha) * s, -cos(alpha)), 0.0)
        return point, by_u, member((-r * s, r * c, 0.0), 0.0)

    delta = blank.pitch_angle
    apex = blank.pitch_apex_beyond_crossing_point

    def cone(v: Vector, rho: float, radial: float) -> tuple[float, float]:
        return v[2] * cos(delta) + radial * sin(delta), radial * cos(delta) - v[2] * sin(delta)

    along, depth = cut.radial_distance * cos(cut.cradle_angle), cut.depth
    z, rho = blank.position(blank.mean_cone_distance, 0.0)
    u = depth / cos(alpha)
    t = atan2(-y0, sine * rho + cosine * (z + back) - along)
    for _ in range(NEWTON):
        p, by_u, by_t = surface(u, t)
        rho = hypot(p[0], p[1])
        radials = [(p[0] * d[0] + p[1] * d[1]) / rho for d in (by_u, by_t)]
        at = cone((0.0, 0.0, p[2] + apex), rho, rho)
        f, g = at[0] - blank.mean_cone_distance, at[1]
        (fu, gu), (ft, gt) = (cone(d, rho, r) for d, r in zip((by_u, by_t), radials, strict=True))
        determinant = fu * gt - ft * gu
        du, dt = (gt * f - ft * g) / determinant, (fu * g - gu * f) / determinant
        u, t = u - du, t - max(-0.1, min(0.1, dt))
        if abs(du) + abs(dt) < SETTLED:
            break
    p, _, _ = surface(u, t)
    n = member((-side * cos(alpha) * cos(t), -side * cos(alpha) * sin(t), -sin(alpha)), 0.0)
    rho = hypot(p[0], p[1])
    radial, around = (p[0] * n[0] + p[1] * n[1]) / rho, (p[0] * n[1] - p[1] * n[0]) / rho
    distance, up = cone(n, rho, radial)
    return FormPoint(asin(up), atan2(abs(distance), abs(around)), atan2(p[1], p[0]))


def form_cut(
    blank: MemberBlank,
    *,
    cutter_radius: float,
    tooth_thickness: float,
    pressure_angles: tuple[float, float],
    deeper: float = 0.0,
) -> WheelCut:
    """Formate wheel whose flanks have the blank's angles and its tooth (s_mn, mm) at the mean point.

    ``pressure_angles`` are those of the concave and the convex flank against the pitch plane, rad.
    """
    beta = blank.mean_spiral_angle
    pitch = pi * blank.mean_pitch_diameter / blank.teeth * cos(beta)
    wanted = np.array([*pressure_angles, beta, pitch - tooth_thickness])

    def made(x: np.ndarray) -> WheelCut:
        return wheel_cut(
            blank,
            cutter_radius=cutter_radius,
            slot_width=float(x[3]),
            pressure_angles=(float(x[0]), float(x[1])),
            generated=False,
            spiral_angle=float(x[2]),
            deeper=deeper,
        )

    def seen(x: np.ndarray) -> np.ndarray:
        cut = made(x)
        concave, convex = (form_point(cut, blank, outside) for outside in (True, False))
        slot = (concave.angle - convex.angle) * 0.5 * blank.mean_pitch_diameter * cos(beta)
        spiral = 0.5 * (concave.spiral + convex.spiral)
        return np.array([concave.pressure, convex.pressure, spiral, slot])

    return made(_corrected(seen, wanted))


def _corrected(seen: Callable[[np.ndarray], np.ndarray], wanted: np.ndarray) -> np.ndarray:
    """What to ask for so that the wanted is seen: fixed point, since one is nearly the other."""
    x = wanted.copy()
    for _ in range(PASSES):
        left = wanted - seen(x)
        x = x + left
        if np.abs(left).max() < SETTLED:
            break
    return x
