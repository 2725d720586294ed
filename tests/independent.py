"""The blade and the machine once more, written plainly and apart from the package.

Everything here follows the papers and their notes, not `hypoid`'s own code: one function per motion,
no meshing condition where a search will do. It runs on NumPy arrays and, number by number, on mpmath.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import mpmath
import numpy as np

from hypoid.cutter import Blade, EdgePiece
from hypoid.flank import Flank, PitchCone
from hypoid.machine import MachineSettings
from hypoid.pair import Member

Array = np.ndarray[Any, Any]
BANDS = 5  # of a blade's outline, each searched by itself
WINDOW = 0.6  # rad of cutter turn in which one blade passes one slot


def carried(
    settings: MachineSettings, point: Any, theta: Any, phi: Any, m: ModuleType = np
) -> tuple[Any, Any, Any]:
    """A cutter point in the left-hand member's frame, motion by motion (2005 paper, errata 1-3)."""

    def turn(angle: Any, a: Any, b: Any) -> tuple[Any, Any]:
        c, s = m.cos(angle), m.sin(angle)
        return c * a - s * b, s * a + c * b

    if not settings.generated:
        phi = 0 * phi

    def moved(name: str) -> Any:
        powers = enumerate(getattr(settings.motions, name), start=1)
        return getattr(settings, name) + sum(c * phi**n for n, c in powers)

    x, y, z = point
    x, y = turn(-theta, x, y)  # head
    z = z + settings.cutter_lead * theta
    z, x = turn(moved("tilt_angle"), z, x)
    x, y = turn(moved("swivel_angle"), x, y)
    x, y = turn(m.pi / 2 - settings.cradle_angle, x, y - moved("radial_distance"))
    x, y = turn(phi, x, y)  # cradle
    y = y + moved("blank_offset")
    z = z - (moved("sliding_base") + settings.helical_motion * phi)
    z, x = turn(-(m.pi / 2 - moved("machine_root_angle")), z, x)
    z = z - moved("machine_center_to_back")
    work = settings.roll_to_blade_ratio * theta + work_roll(settings, phi, m)
    x, y = turn(-work, x, y)
    return x, y, z


def work_roll(settings: MachineSettings, phi: Any, m: ModuleType = np) -> Any:
    """Turn of the work with the cradle: a polynomial, or the cam of the 1996 paper by a plain search."""
    cam = settings.cam
    if cam is None:
        roll = phi
        for order, coefficient in enumerate(settings.modified_roll, start=2):
            roll = roll + coefficient * phi**order
        return settings.ratio_of_roll * roll
    c, r, delta, guide = cam.swivel_offset, cam.pitch_radius, cam.setting, cam.guide_angle

    def cradle(alpha: Any) -> Any:  # (24)
        return guide + mpmath.asin(
            delta / c * mpmath.sin(c * alpha / r) + mpmath.sin(alpha) - mpmath.sin(guide)
        )

    def one(angle: Any) -> Any:  # (25), from the centre of roll
        alpha = mpmath.findroot(lambda a: cradle(a) - angle, angle)
        return cam.index_ratio * (c * alpha / r + angle)

    if m is mpmath:
        return one(phi)
    # on arrays by bisection: (24) rises with alpha over the whole working range
    wanted = np.sin(phi - guide) + math.sin(guide)
    low, high = np.full(np.shape(phi), -1.2), np.full(np.shape(phi), 1.2)
    for _ in range(60):
        middle = 0.5 * (low + high)
        short = delta / c * np.sin(c * middle / r) + np.sin(middle) < wanted
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    return cam.index_ratio * (c * low / r + phi)


# --- the envelope in 40 digits ---------------------------------------------------------------


def edge_mp(piece: EdgePiece, s: Any) -> list[Any]:
    """Point of an edge piece: arc or line, and a parabola from `relief_from` on."""
    k, beyond = digits(piece.curvature), max(s - digits(piece.relief_from), 0)
    along = mpmath.sin(k * s) / k if k else s
    rise = (1 - mpmath.cos(k * s)) / k if k else mpmath.mpf(0)
    rise += digits(piece.relief) * beyond**2 + digits(piece.parabola) * s**2
    return [
        digits(p) + along * digits(t) + rise * digits(g)
        for p, t, g in zip(piece.start, piece.tangent, piece.metal, strict=True)
    ]


def digits(value: Any) -> mpmath.mpf:
    """A number of the package, or one that has more digits already."""
    return value if isinstance(value, mpmath.mpf) else mpmath.mpf(float(value))


@dataclass(frozen=True)
class Envelope:
    """The envelope of one edge piece with 40 digits, by differences of the plain chain alone."""

    settings: MachineSettings
    piece: EdgePiece
    step: float = 1e-12

    def swept(self, s: Any, theta: Any, phi: Any) -> mpmath.matrix:
        return mpmath.matrix(carried(self.settings, edge_mp(self.piece, s), theta, phi, mpmath))

    def tangents(self, s: Any, theta: Any, phi: Any) -> list[mpmath.matrix]:
        """Derivatives by s, theta and phi, central differences (error 1e-24)."""
        h = mpmath.mpf(self.step)
        ends = [
            (self.swept(s + h, theta, phi), self.swept(s - h, theta, phi)),
            (self.swept(s, theta + h, phi), self.swept(s, theta - h, phi)),
            (self.swept(s, theta, phi + h), self.swept(s, theta, phi - h)),
        ]
        return [(after - before) / (2 * h) for after, before in ends]

    def meshing(self, s: Any, theta: Any, phi: Any) -> tuple[Any, Any]:
        """n . dr/dphi, and the product of both lengths as its scale."""
        by_s, by_theta, by_phi = self.tangents(s, theta, phi)
        n = cross(by_s, by_theta)
        return dot(n, by_phi), mpmath.norm(n) * mpmath.norm(by_phi)

    def root(self, s: Any, theta: Any, near: Any) -> Any:
        """The cradle angle of meshing next to `near`."""
        return mpmath.findroot(lambda p: self.meshing(s, theta, p)[0], (near, near + 1e-6))

    def patch(self, s: Any, theta: Any, near: Any) -> tuple[mpmath.matrix, mpmath.matrix]:
        """Point and unit normal of the generated surface (the swept surface's at the root)."""
        phi = self.root(s, theta, near)
        by_s, by_theta, _ = self.tangents(s, theta, phi)
        n = cross(by_s, by_theta)
        return self.swept(s, theta, phi), n / mpmath.norm(n)


def cross(u: Any, v: Any) -> mpmath.matrix:
    return mpmath.matrix(
        [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    )


def dot(u: Any, v: Any) -> Any:
    return mpmath.fdot(list(u), list(v))


# --- the brute-force sweep ---------------------------------------------------------------------


def blade_outline(blade: Blade, lengths: Array) -> tuple[Array, Array]:
    """Outline of a blade at given lengths from the pitch point, positive to the shank.

    In its front plane: x towards the metal, z to the blade's tip [gonzalez2022, Fig. A.15].
    """
    sine, cosine = math.sin(blade.pressure_angle), math.cos(blade.pressure_angle)
    radius, top = blade.edge_radius, blade.reference_height
    straight = (top - radius * (1.0 - sine)) / cosine  # pitch point to the start of the arc
    centre_x, centre_z = -straight * sine - radius * cosine, top - radius
    x, z = lengths * sine, -lengths * cosine
    if blade.relief is not None:
        rise = blade.relief.coefficient * np.maximum(lengths - blade.relief.start, 0.0) ** 2
        x, z = x + rise * cosine, z + rise * sine
    angle = blade.pressure_angle + (-lengths - straight) / radius
    on_arc, on_land = lengths < -straight, angle > math.pi / 2
    x = np.where(on_arc, centre_x + radius * np.cos(angle), x)
    z = np.where(on_arc, centre_z + radius * np.sin(angle), z)
    run = (angle - math.pi / 2) * radius
    return np.where(on_land, centre_x - run, x), np.where(on_land, top, z)


@dataclass(frozen=True)
class Sweep:
    """One blade of a head, swept through a left-hand blank by plain motions."""

    settings: MachineSettings
    blade: Blade
    radius: float
    blade_groups: int
    slope_angle: float
    phase: float  # of the outer blade's pitch point about the cutter axis at theta = 0
    cone: PitchCone

    @property
    def theta_start(self) -> float:
        return 0.0 if self.blade.name == "outer" else -math.pi / self.blade_groups

    @property
    def ends(self) -> tuple[float, float]:
        """Outline lengths at the inner end of the land and at the shank, mm."""
        straight = self.blade.arc_height / math.cos(self.blade.pressure_angle)
        arc = self.blade.edge_radius * (math.pi / 2 - self.blade.pressure_angle)
        shank = self.blade.shank_height / math.cos(self.blade.pressure_angle)
        return -straight - arc - self.blade.land, shank

    def place(self, lengths: Array, theta: Array, phi: Array) -> tuple[Array, Array, Array]:
        """Cone distance, height above the pitch cone (mm) and angle (rad) of swept points."""
        x, z = blade_outline(self.blade, lengths)
        side = 1.0 if self.blade.name == "outer" else -1.0
        turn = self.phase + (0.0 if side > 0 else self.theta_start)
        # the front plane holds the cutter axis' direction and passes it at r_c0 sin(nu)
        in_plane = (self.radius + side * x * math.cos(self.slope_angle)) + 1j * (
            -side * x * math.sin(self.slope_angle)
        )
        at = in_plane * np.exp(1j * turn)
        px, py, pz = carried(self.settings, (at.real, at.imag, z), theta, phi)
        along, rho = pz + self.cone.apex_beyond, np.hypot(px, py)
        sine, cosine = float(self.cone.sine), float(self.cone.cosine)
        work = self.settings.roll_to_blade_ratio * theta + self.settings.ratio_of_roll * phi
        angle = np.angle((px + 1j * py) * np.exp(1j * work)) - work  # does not wrap
        return along * cosine + rho * sine, rho * cosine - along * sine, angle

    def reach(
        self, distance: float, lengths: Array, phi: Array, theta: Array
    ) -> tuple[Array, Array, Array]:
        """Turn every outline point until it stands at the cone distance: theta, height, angle."""
        for _ in range(25):
            here, ahead = (self.place(lengths, theta + h, phi)[0] for h in (0.0, 1e-7))
            step = (here - distance) * 1e-7 / (ahead - here)
            theta = theta - np.clip(step, -0.05, 0.05)
            if np.abs(step).max() < 1e-12:
                break
        reached, height, angle = self.place(lengths, theta, phi)
        passing = (np.abs(reached - distance) < 1e-9) & (np.abs(theta - self.theta_start) < WINDOW)
        height = np.where(passing, height, np.nan)
        return theta, height, angle

    def boundary(
        self, distance: float, heights: Array, side: str, roll: tuple[float, float] = (-0.36, 0.36)
    ) -> Array:
        """Extreme angle (greatest on concave flanks) of all that is swept at each height, rad.

        The outline is a polyline in the section S = distance for each of many cradle angles; the
        extreme over the cradle is searched on a grid, then on finer ones around the best.
        """
        sign = 1.0 if side == "concave" else -1.0
        low, shank = self.ends
        out = np.full(len(heights), np.nan)
        lengths, phi = np.linspace(low, shank, 161), np.linspace(*roll, 241)
        grid = np.meshgrid(lengths, phi, indexing="ij")
        theta, h, angle = self.reach(distance, *grid, np.full_like(grid[0], self.theta_start))
        bands = np.array_split(np.arange(len(lengths)), BANDS)  # fillet and flank compete
        for i, height in enumerate(heights):
            found = [
                self._refined(distance, grid, (theta, h, angle), height, sign, b) for b in bands
            ]
            out[i] = sign * np.nanmax(sign * np.array(found))
        return out

    def _refined(
        self,
        distance: float,
        grid: list[Array],
        reached: tuple[Array, Array, Array],
        height: float,
        sign: float,
        band: Array,
    ) -> float:
        """Extreme angle of one band of lengths, searched on finer and finer grids; NaN without any."""
        lengths, phi = grid[0][:, 0], grid[1][0]
        rows = slice(band[0], band[-1] + 2)
        theta, h, angle = (a[rows] for a in reached)
        part = [g[rows] for g in grid]
        best, s_best, p_best, t_best = self._extreme(part, theta, h, angle, height, sign)
        ds, dp = lengths[1] - lengths[0], phi[1] - phi[0]
        for _ in range(4):  # a wide window: polylines may put the extreme several steps off
            if not np.isfinite(best):
                return np.nan
            fine = np.meshgrid(
                np.clip(s_best + ds * np.linspace(-6, 6, 49), lengths[0], lengths[-1]),
                p_best + dp * np.linspace(-6, 6, 49),
                indexing="ij",
            )
            t, hh, a = self.reach(distance, *fine, np.full_like(fine[0], t_best))
            best, s_best, p_best, t_best = self._extreme(fine, t, hh, a, height, sign)
            ds, dp = ds / 4.0, dp / 4.0
        return best

    @staticmethod
    def _extreme(
        grid: list[Array], theta: Array, height: Array, angle: Array, target: float, sign: float
    ) -> tuple[float, float, float, float]:
        """Extreme angle where the polylines (columns) cross the target height, and where it is."""
        below, above = height[:-1], height[1:]
        crossing = (below - target) * (above - target) <= 0.0
        share = np.where(crossing, (target - below) / np.where(crossing, above - below, 1.0), 0.0)

        def between(a: Array) -> Array:
            return a[:-1] + share * (a[1:] - a[:-1])

        angles = np.where(crossing & np.isfinite(between(angle)), between(angle), -sign * np.inf)
        if not np.isfinite(angles).any():
            return np.nan, np.nan, np.nan, np.nan
        best = np.unravel_index(np.argmax(sign * angles), angles.shape)
        return tuple(float(between(a)[best]) for a in (angle, grid[0], grid[1], theta))  # type: ignore[return-value]


def sweep_of(member: Member, flank: Flank) -> Sweep:
    """The sweep that cuts a flank of an exactly face-hobbed member (left hand)."""
    head = member.head
    return Sweep(
        settings=flank.settings,
        blade=head.outer if flank.side == "concave" else head.inner,
        radius=head.radius,
        blade_groups=head.blade_groups,
        slope_angle=head.slope_angle,
        # notes of 2022, item 6: pi/2 - (beta - nu) + q from the line of centres, x_c at pi/2
        phase=flank.settings.cradle_angle - member.blank.mean_spiral_angle + head.slope_angle,
        cone=flank.cone,
    )
