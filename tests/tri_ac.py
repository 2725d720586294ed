"""The 2005 paper's blade and machine once more, written plainly, and the consistent set of its notes.

The blade is (2.a)-(2.d) with items 4-7 of the notes, the machine appendix A with items 1-3, as they
stand there: on mpmath, with the implicit equation of each reading of L_T solved by a search.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, cached_property
from math import asin, cos, hypot, pi, radians, sin, tan
from typing import Any

import mpmath
import numpy as np
from independent import Sweep, carried
from scipy.optimize import fsolve

from hypoid.cutter import BladeToprem, TriAcBlade, TriAcHead
from hypoid.flank import Border, Flank, PitchCone, Side, best_way, cut_flank
from hypoid.machine import MachineSettings

Array = np.ndarray[Any, Any]
mpf = mpmath.mpf


@dataclass(frozen=True)
class PaperBlade:
    """Auxiliary values of (2) in as many digits as mpmath is set to."""

    blade: TriAcBlade

    @property
    def upper(self) -> int:
        """Sign of +- in (2): the upper one is the outer blade's."""
        return 1 if self.blade.name == "outer" else -1

    @property
    def alpha(self) -> Any:
        b = self.blade
        e, g, k = (mpf(v) for v in (b.blade_angle, b.hook_angle, b.rake_angle))
        return mpmath.atan(
            mpmath.tan(e) / (mpmath.cos(g) + mpmath.tan(e) * mpmath.tan(k) * mpmath.sin(g))
        )

    @property
    def tau(self) -> Any:
        return mpf(self.blade.toprem.angle) if self.blade.toprem else mpf(0)

    def kink(self, delta: Any) -> Any:
        """H by the reading of L_T."""
        toprem, r_e = self.blade.toprem, mpf(self.blade.edge_radius)
        if toprem is None:
            return r_e * (1 - mpmath.sin(delta))
        length, lean = mpf(toprem.length), delta - self.tau
        return {
            "axial": length,
            "along-flank": length * mpmath.cos(lean),
            "straight-part": r_e * (1 - mpmath.sin(lean)) + length * mpmath.cos(lean),
        }[toprem.measured]

    @property
    def delta(self) -> Any:
        rho, h_f, a = mpf(self.blade.curve_radius), mpf(self.blade.height), self.alpha
        if not rho:
            return a
        return mpmath.findroot(
            lambda d: h_f - rho * (mpmath.sin(a) - mpmath.sin(d)) - self.kink(d), a
        )

    @property
    def gamma(self) -> Any:
        return mpmath.pi / 2 - self.delta + self.tau

    @property
    def lengths(self) -> tuple[Any, Any]:
        """L1 and L2."""
        r_e, d = mpf(self.blade.edge_radius), self.delta
        arc = r_e * (1 - mpmath.cos(self.gamma))
        return r_e * self.gamma, (self.kink(d) - arc) / mpmath.cos(d - self.tau)

    @property
    def x_r(self) -> Any:
        rho, r_e = mpf(self.blade.curve_radius), mpf(self.blade.edge_radius)
        d, a = self.delta, self.alpha
        to_kink = rho * (mpmath.cos(a) - mpmath.cos(d))
        if not rho:
            to_kink = -(mpf(self.blade.height) - self.kink(d)) * mpmath.tan(a)
        inward = self.lengths[1] * mpmath.sin(d - self.tau) + r_e * mpmath.sin(self.gamma)
        return self.upper * (to_kink - inward)

    def projection(self, s: Any) -> tuple[Any, Any]:
        """x_t and z_t, (2.a)-(2.d)."""
        up, r_e, d = self.upper, mpf(self.blade.edge_radius), self.delta
        first, second = self.lengths
        if s <= 0:
            return up * s + self.x_r, mpf(0)
        if s <= first:
            return self.x_r + up * r_e * mpmath.sin(s / r_e), -r_e * (1 - mpmath.cos(s / r_e))
        x = self.x_r + up * r_e * mpmath.sin(self.gamma)
        z, run = -r_e * (1 - mpmath.cos(self.gamma)), min(s - first, second)
        x, z = x + up * run * mpmath.sin(d - self.tau), z - run * mpmath.cos(d - self.tau)
        run = s - first - run
        rho, a = mpf(self.blade.curve_radius), self.alpha
        if not rho:
            return x + up * run * mpmath.sin(a), z - run * mpmath.cos(a)
        if run <= 0:
            return x, z
        x_o, z_o = up * rho * mpmath.cos(a), -mpf(self.blade.height) + rho * mpmath.sin(a)
        return x_o - up * rho * mpmath.cos(d + run / rho), z_o - rho * mpmath.sin(d + run / rho)

    def tool(self, s: Any) -> list[Any]:
        """r_t: with y_t, so that the edge lies in the rake plane (item 6)."""
        x, z = self.projection(s)
        g, k = mpf(self.blade.hook_angle), mpf(self.blade.rake_angle)
        y = -self.upper * x * mpmath.tan(k) / mpmath.cos(g) - z * mpmath.tan(g)
        return [x, y, z]

    def head(self, s: Any) -> list[Any]:
        """r_h = Rz(-eps_b)(r_t - y_P e_y) + r_b e_x (item 7)."""
        x, y, z = self.tool(s)
        y -= mpf(self.blade.height) * mpmath.tan(mpf(self.blade.hook_angle))
        turn = mpf(self.blade.eccentric_angle)
        c, e = mpmath.cos(turn), mpmath.sin(turn)
        return [c * x + e * y + mpf(self.blade.radius), c * y - e * x, z]


@dataclass(frozen=True)
class StickSweep(Sweep):
    """One stick blade of a Tri-Ac head swept through a left-hand blank, by the equations of the paper alone."""

    head: Any = None
    start: float = 0.0

    @property
    def theta_start(self) -> float:
        return self.start

    @cached_property
    def paper(self) -> PaperBlade:
        return PaperBlade(self.blade)  # pyright: ignore[reportArgumentType]

    @cached_property
    def measures(self) -> tuple[float, ...]:
        """L1, L2, delta, tau, x_R, alpha_t."""
        own = self.paper
        values = (*own.lengths, own.delta, own.tau, own.x_r, own.alpha)
        return tuple(float(v) for v in values)

    @property
    def ends(self) -> tuple[float, float]:
        first, second, *_, alpha = self.measures
        blade: Any = self.blade
        return -0.5 * self.head.tip_slot, first + second + (
            blade.height + blade.shank_height
        ) / cos(alpha)

    def place(self, lengths: Array, theta: Array, phi: Array) -> tuple[Array, Array, Array]:
        first, second, delta, tau, x_r, alpha = self.measures
        blade: Any = self.blade
        up, r_e, rho, h_f = self.paper.upper, blade.edge_radius, blade.curve_radius, blade.height
        on_arc = np.clip(lengths, 0.0, first) / r_e
        on_toprem = np.clip(lengths - first, 0.0, second)
        run = np.maximum(lengths - first - second, 0.0)  # (2.a)-(2.d), one after the other
        x = x_r + up * (
            np.minimum(lengths, 0.0) + r_e * np.sin(on_arc) + on_toprem * sin(delta - tau)
        )
        z = -r_e * (1.0 - np.cos(on_arc)) - on_toprem * cos(delta - tau)
        if rho:
            x = x - up * rho * (np.cos(delta + run / rho) - cos(delta))
            z = z - rho * (np.sin(delta + run / rho) - sin(delta))
        else:
            x, z = x + up * run * sin(alpha), z - run * cos(alpha)
        hook, rake, turn = blade.hook_angle, blade.rake_angle, blade.eccentric_angle
        y = -up * x * tan(rake) / cos(hook) - (z + h_f) * tan(hook)
        at = (x + 1j * y) * np.exp(-1j * turn) + blade.radius
        if up < 0:  # the inner blade of the group before
            at = at * np.exp(1j * (self.head.following - 2.0 * pi / self.head.blade_groups))
        px, py, pz = carried(self.settings, (at.real, at.imag, z), theta, phi)
        along, radius = pz + float(self.cone.apex_beyond), np.hypot(px, py)
        sine, cosine = float(self.cone.sine), float(self.cone.cosine)
        work = self.settings.roll_to_blade_ratio * theta + self.settings.ratio_of_roll * phi
        angle = np.angle((px + 1j * py) * np.exp(1j * work)) - work  # does not wrap
        return along * cosine + radius * sine, radius * cosine - along * sine, angle


def stick_sweep(head: TriAcHead, flank: Flank) -> StickSweep:
    """The sweep that cuts a flank of a Tri-Ac member."""
    blade: Any = head.outer if flank.side == "concave" else head.inner
    return StickSweep(
        flank.settings, blade, 0.0, 1, 0.0, 0.0, flank.cone, head=head, start=flank.theta_start
    )


def appendix_a(settings: MachineSettings, theta: Any, phi: Any) -> mpmath.matrix:
    """M_w5 M_54 M_4m M_mc M_c3 M_32 M_21 M_1h, (A.1)-(A.8), M_54 and M_c3 as corrected (items 1, 2)."""

    def of(angle: Any) -> tuple[Any, Any]:
        return mpmath.cos(angle), mpmath.sin(angle)

    s = {
        name: mpf(float(getattr(settings, name)))
        for name in (
            *("radial_distance", "cradle_angle", "machine_root_angle", "ratio_of_roll"),
            *("roll_to_blade_ratio", "tilt_angle", "swivel_angle", "blank_offset"),
            *("machine_center_to_back", "sliding_base"),
        )
    }
    phi = mpf(phi) if settings.generated else mpf(0)
    c, e = of(mpf(theta))
    m_1h = mpmath.matrix([[c, e, 0, 0], [-e, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    c, e = of(s["tilt_angle"])
    m_21 = mpmath.matrix([[c, 0, e, 0], [0, 1, 0, 0], [-e, 0, c, 0], [0, 0, 0, 1]])
    c, e = of(s["swivel_angle"])
    m_32 = mpmath.matrix([[c, -e, 0, 0], [e, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    c, e = of(mpmath.pi / 2 - s["cradle_angle"])
    s_r = s["radial_distance"]  # Rz(pi/2 - q) Trans(0, -S_r, 0)
    m_c3 = mpmath.matrix([[c, -e, 0, e * s_r], [e, c, 0, -c * s_r], [0, 0, 1, 0], [0, 0, 0, 1]])
    c, e = of(phi)
    m_mc = mpmath.matrix([[c, -e, 0, 0], [e, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    offset, base = s["blank_offset"], s["sliding_base"]
    m_4m = mpmath.matrix([[1, 0, 0, 0], [0, 1, 0, offset], [0, 0, 1, -base], [0, 0, 0, 1]])
    c, e = of(mpmath.pi / 2 - s["machine_root_angle"])
    back = s["machine_center_to_back"]
    m_54 = mpmath.matrix([[c, 0, -e, 0], [0, 1, 0, 0], [e, 0, c, -back], [0, 0, 0, 1]])
    c, e = of(s["roll_to_blade_ratio"] * mpf(theta) + s["ratio_of_roll"] * phi)
    m_w5 = mpmath.matrix([[c, e, 0, 0], [-e, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    return m_w5 * m_54 * m_4m * m_mc * m_c3 * m_32 * m_21 * m_1h


# --- Table 1 and the notes' consistent set -------------------------------------------------------

OFFSET = 25.0
TEETH = (15, 44)
ECCENTRIC = {"eccentric_angle": radians(18.85)}
GROUND: dict[str, Any] = {
    **ECCENTRIC,
    "hook_angle": radians(4.42),
    "rake_angle": radians(12.0),
    "curve_radius": 762.0,
}
TOPREM = BladeToprem(1.6, radians(2.5))
WHEEL_HEAD = TriAcHead(
    13,
    TriAcBlade("outer", 76.3888, radians(23.0825), 6.04, 1.2, 4.0, **GROUND),
    TriAcBlade("inner", 75.6112, radians(17.0327), 6.04, 1.2, 4.0, **GROUND),
)
PINION_HEAD = TriAcHead(
    13,
    TriAcBlade("outer", 76.80715, radians(16.13598), 3.91, 0.9, 6.5, **GROUND, toprem=TOPREM),
    TriAcBlade("inner", 75.61733, radians(23.27338), 3.91, 0.9, 6.5, **GROUND, toprem=TOPREM),
    spacing=radians(9.4),
)
# the pinion's blades in every shape there is: changes of a blade
SHAPES: dict[str, dict[str, Any]] = {
    "curved with Toprem": {},
    "Toprem, axial": {"toprem": replace(TOPREM, measured="axial")},
    "Toprem, straight part": {"toprem": replace(TOPREM, measured="straight-part")},
    "curved": {"toprem": None},
    "straight with Toprem": {"curve_radius": 0.0},
    "straight, straight part": {
        "curve_radius": 0.0,
        "toprem": replace(TOPREM, measured="straight-part"),
    },
    "straight": {"curve_radius": 0.0, "toprem": None},
    "hollow, tight": {"curve_radius": -60.0, "toprem": BladeToprem(2.0, radians(4.0))},
}
WHEEL = MachineSettings(
    radial_distance=120.0207,
    cradle_angle=radians(38.57245),
    machine_root_angle=radians(62.41),
    ratio_of_roll=1.0,
    roll_to_blade_ratio=13 / 44,
    machine_center_to_back=11.11408,
    sliding_base=-6.04,
    generated=False,
)
PINION = MachineSettings(
    radial_distance=112.82038,
    cradle_angle=radians(53.9209),
    machine_root_angle=radians(0.3751),
    ratio_of_roll=2.9258015,
    roll_to_blade_ratio=13 / 15,
    tilt_angle=radians(26.7102),
    swivel_angle=radians(-49.13726),
    blank_offset=24.454,
    machine_center_to_back=-0.09933,
    sliding_base=28.67217,
)


@dataclass(frozen=True)
class Table1:
    """Pitch cones that Table 1 and the offset imply; mm and rad, wheel axis z, pinion axis x."""

    point: tuple[float, float, float]  # common mean point, on the wheel axis' frame
    pinion: PitchCone
    wheel: PitchCone
    pinion_angle: float
    pinion_radius: float


@cache
def table_1() -> Table1:
    """The normal at the mean point meets both axes; pinion radius by the ratio and both spirals."""
    wheel_angle, radius = radians(62.41), (126.10 - 0.5 * 38.0) * sin(radians(62.41))
    pinion_radius = radius * 15 / 44 * cos(radians(28.90)) / cos(radians(43.0))

    def place(azimuth: float, z: float) -> tuple[Array, Array]:
        c, s = cos(azimuth), sin(azimuth)
        normal = [cos(wheel_angle) * c, cos(wheel_angle) * s, -sin(wheel_angle)]
        return np.array([radius * c, radius * s, z]), np.array(normal)

    def left(unknown: Array) -> list[float]:
        point, normal = place(*unknown)
        arm = point - np.array([0.0, OFFSET, 0.0])
        meets = np.cross(normal, np.array([1.0, 0.0, 0.0])) @ arm
        return [float(meets), hypot(arm[1], arm[2]) - pinion_radius]

    point, normal = place(*fsolve(left, [0.2, 38.0], xtol=1e-13))
    angle = asin(abs(normal[0]))
    apex = point[0] - pinion_radius / tan(angle)
    beyond = radius / tan(wheel_angle) - point[2]
    return Table1(
        tuple(float(v) for v in point),  # pyright: ignore
        PitchCone(-float(apex), sin(angle), cos(angle)),
        PitchCone(float(beyond), sin(wheel_angle), cos(wheel_angle)),
        angle,
        pinion_radius,
    )


def cut(
    member: str, side: Side, head: TriAcHead | None = None, settings: MachineSettings | None = None
) -> Flank:
    """A flank of the set, or what another head or other settings make of it."""
    wheel = member == "wheel"
    outer, width = (126.10, 38.0) if wheel else (106.40, 41.43)
    addendum, dedendum = (2.96, 6.04) if wheel else (5.09, 3.91)
    settings = settings or (WHEEL if wheel else PINION)
    head = head or (WHEEL_HEAD if wheel else PINION_HEAD)
    return cut_flank(
        member,
        side,
        settings,
        head.pieces("outer" if side == "concave" else "inner"),
        table_1().wheel if wheel else table_1().pinion,
        mirrored=wheel,
        toe=outer - width,
        heel=outer,
        tip=Border(addendum, 0.0),
        root=Border(-dedendum, 0.0),
        way=best_way(settings, revolution=False),
    )


@cache
def flank_of_set(member: str, side: Side, spacing_deg: float = 9.4) -> Flank:
    """A flank of the consistent set."""
    head = replace(PINION_HEAD, spacing=radians(spacing_deg)) if member == "pinion" else None
    return cut(member, side, head)


def left_hand(flank: Flank, points: Array) -> Array:
    """Points or normals (n, 3) of a member read as a left-hand one."""
    return points * np.array([1.0, -1.0 if flank.mirrored else 1.0, 1.0])
