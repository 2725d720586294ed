"""Face-milled flanks of every cutter, motion and method, for tests of what holds for all of them.

A left-hand spiral bevel wheel and pinion 27 x 28 at 45 deg, near the 1996 pair, from settings that the
textbook rule gives: cutter tangent to the mean spiral, blade tips on the root line.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from math import atan2, cos, hypot, pi, radians, sin, tan
from typing import Any

import numpy as np
from independent import Array, Sweep, carried, sweep_of, work_roll
from tri_ac import stick_sweep

from hypoid.cutter import (
    CircularProfile,
    EdgePiece,
    FaceMillHead,
    Flankrem,
    ParabolicProfile,
    Toprem,
    TriAcHead,
)
from hypoid.flank import Border, Flank, PitchCone, Side, best_way, cut_flank
from hypoid.machine import Cam, MachineSettings, Motions, Way
from hypoid.pair import Member

HEEL, FACE, SPIRAL = 161.69, 25.0, radians(35.0)
ADDENDUM, DEDENDUM, TAPER = 3.8, 4.6, radians(1.63)  # at the heel
PITCH_ANGLE = radians(22.0 + 4 / 60)

CUTTERS: dict[str, dict[str, Any]] = {
    "straight": {},
    "circular arc": {"profile": CircularProfile(500.0, 4.0)},
    "parabola": {"profile": ParabolicProfile(0.002, 4.0)},
    "toprem": {"toprem": Toprem(radians(2.0), 2.2)},
    "flankrem": {"flankrem": Flankrem(6.0, coefficient=0.004)},
    "straight flankrem": {"flankrem": Flankrem(6.0, angle=radians(2.0))},
}
METHODS: dict[str, dict[str, Any]] = {
    "generated": {},
    "formate": {"generated": False},
    "helixform": {"generated": False, "cutter_lead": 0.8},
    "modified roll": {"modified_roll": (0.03, -0.01, 0.02)},
    "cam": {"cam": Cam(381.0, 61.6, 2.0, radians(5.0), 10 / 27)},
    "tilt": {"tilt_angle": radians(0.5), "swivel_angle": radians(-35.0)},
    "helical duplex": {"helical_motion": 4.0},
    "all axes": {
        "helical_motion": 1.0,
        "modified_roll": (0.02,),
        "tilt_angle": radians(0.3),
        "motions": Motions(
            radial_distance=(1.0, 0.3),
            tilt_angle=(0.02,),
            swivel_angle=(0.03, 0.01),
            blank_offset=(0.5, -0.4),
            machine_root_angle=(0.02, 0.01),
            machine_center_to_back=(0.6,),
            sliding_base=(0.3, 0.8, -0.2),
        ),
    },
}


def settings_of(method: str, size: float = 1.0) -> MachineSettings:
    """Settings of one method, all lengths times ``size``."""
    mean, radius = HEEL - 0.5 * FACE, 125.0
    across, along = radius * cos(SPIRAL), mean - radius * sin(SPIRAL)
    root = PITCH_ANGLE - TAPER
    plain = MachineSettings(
        radial_distance=hypot(across, along),
        cradle_angle=atan2(across, along),
        machine_root_angle=root,
        ratio_of_roll=cos(TAPER) / sin(PITCH_ANGLE),
        roll_to_blade_ratio=0.0,
        **METHODS[method],
    )
    return scaled(plain, size)


def scaled(settings: MachineSettings, k: float) -> MachineSettings:
    """Settings of a pair k times as large."""
    lengths = ("radial_distance", "blank_offset", "machine_center_to_back", "sliding_base")
    lengths = (*lengths, "helical_motion", "cutter_lead")
    moved = settings.motions
    linear = ("radial_distance", "blank_offset", "machine_center_to_back", "sliding_base")
    motions = replace(moved, **{n: tuple(k * c for c in getattr(moved, n)) for n in linear})
    cam = settings.cam
    if cam is not None:
        cam = replace(
            cam,
            swivel_offset=k * cam.swivel_offset,
            pitch_radius=k * cam.pitch_radius,
            setting=k * cam.setting,
        )
    return replace(
        settings, **{n: k * getattr(settings, n) for n in lengths}, motions=motions, cam=cam
    )


def head_of(cutter: str, size: float = 1.0) -> FaceMillHead:
    """Spread-blade head, all lengths times ``size``."""
    shape: dict[str, Any] = {}
    for name, value in CUTTERS[cutter].items():
        if isinstance(value, CircularProfile):
            value = CircularProfile(size * value.radius, size * value.reference_height)
        elif isinstance(value, ParabolicProfile):
            value = ParabolicProfile(value.coefficient / size, size * value.reference_height)
        elif isinstance(value, Toprem):
            value = replace(value, height=size * value.height)
        else:
            value = replace(value, height=size * value.height, coefficient=value.coefficient / size)
        shape[name] = value
    return FaceMillHead.spread_blade(
        size * 250.0,
        size * 2.4,
        radians(19.0),
        radians(21.0),
        size * 10.0,
        edge_radius=size * 0.6,
        **shape,
    )


@cache
def milled(
    cutter: str,
    method: str,
    side: Side = "concave",
    *,
    mirrored: bool = False,
    size: float = 1.0,
    way: Way | None = None,
) -> Flank:
    """One flank; ``way`` None takes the best."""
    settings, heel, toe = settings_of(method, size), size * HEEL, size * (HEEL - FACE)
    slope = tan(TAPER)
    pieces = head_of(cutter, size).pieces("outer" if side == "concave" else "inner")
    if not settings.generated:
        pieces = {name: piece.turned(0.9) for name, piece in pieces.items()}
    return cut_flank(
        "pinion",
        side,
        settings,
        pieces,
        PitchCone(0.0, sin(PITCH_ANGLE), cos(PITCH_ANGLE)),
        mirrored=mirrored,
        toe=toe,
        heel=heel,
        tip=Border(size * ADDENDUM - slope * heel, slope),
        root=Border(-size * DEDENDUM + slope * heel, -slope),
        way=way or best_way(settings, revolution=True),
    )


def plain_edge(pieces: dict[str, EdgePiece], lengths: Array) -> tuple[Array, Array]:
    """Radius and z of a blade's outline at lengths from the start of its land, piece after piece, mm."""
    rho, z, start = np.zeros_like(lengths), np.zeros_like(lengths), 0.0
    for piece in pieces.values():
        low, high = float(piece.low), float(piece.high)
        s = lengths - start + low
        mine = (s >= low - 1e-12) & (s <= high + 1e-12)
        k, beyond = float(piece.curvature), np.maximum(s - float(piece.relief_from), 0.0)
        along, rise = (np.sin(k * s) / k, (1.0 - np.cos(k * s)) / k) if k else (s, 0.0 * s)
        rise = rise + float(piece.parabola) * s**2 + float(piece.relief) * beyond**2
        at = [
            p + along * t + rise * m
            for p, t, m in zip(piece.start, piece.tangent, piece.metal, strict=True)
        ]
        rho, z = np.where(mine, at[0], rho), np.where(mine, at[2], z)
        start += high - low
    return rho, z


@dataclass(frozen=True)
class MillSweep(Sweep):
    """One blade of a face-mill head swept through a left-hand blank, with no meshing condition."""

    pieces: Any = None
    mean: float = HEEL - 0.5 * FACE  # cone distance of the mean point, mm

    @property
    def theta_start(self) -> float:
        """Cutter turn that points from the cutter's centre to the mean point, rad (no tilt)."""
        own = self.settings
        q, radial, root = own.cradle_angle, own.radial_distance, own.machine_root_angle
        z, rho = self.cone.axial_radial(self.mean, 0.0)
        along = sin(root) * rho + cos(root) * (z + own.machine_center_to_back)
        turn = atan2(radial * sin(q) - own.blank_offset, along - radial * cos(q))
        return -(turn - (pi / 2 - q + own.swivel_angle))

    @property
    def ends(self) -> tuple[float, float]:
        return 0.0, sum(float(p.high) - float(p.low) for p in self.pieces.values())

    def place(self, lengths: Array, theta: Array, phi: Array) -> tuple[Array, Array, Array]:
        rho, z = plain_edge(self.pieces, lengths)
        px, py, pz = carried(self.settings, (rho, 0.0 * rho, z), theta, phi)
        along, radius = pz + float(self.cone.apex_beyond), np.hypot(px, py)
        sine, cosine = float(self.cone.sine), float(self.cone.cosine)
        work = work_roll(self.settings, phi)
        angle = np.angle((px + 1j * py) * np.exp(1j * work)) - work  # does not wrap
        return along * cosine + radius * sine, radius * cosine - along * sine, angle


def mill_sweep(cutter: str, flank: Flank) -> MillSweep:
    """The sweep that cuts a flank of ``milled``."""
    head = head_of(cutter)
    blade = "outer" if flank.side == "concave" else "inner"
    unused: Any = None
    return MillSweep(
        flank.settings, unused, 0.0, 1, 0.0, 0.0, flank.cone, pieces=head.pieces(blade)
    )


def member_sweep(member: Member, flank: Flank) -> Sweep:
    """The sweep that cuts a flank of any member, whatever its head."""
    head = member.heads[flank.side]
    if isinstance(head, TriAcHead):
        return stick_sweep(head, flank)
    if not isinstance(head, FaceMillHead):
        return sweep_of(member, flank)
    blade = "outer" if flank.side == "concave" else "inner"
    unused: Any = None
    return MillSweep(
        flank.settings,
        unused,
        0.0,
        1,
        0.0,
        0.0,
        flank.cone,
        pieces=head.pieces(blade),
        mean=member.blank.mean_cone_distance,
    )
