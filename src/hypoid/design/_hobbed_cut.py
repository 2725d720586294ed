"""A face-hobbed member from its blank: head and settings without tilt, tips along the root cone.

The cutter's axis stands square to the root plane. Seen along it the blade passes the mean point along
the tooth, if its radius there stands off the tooth's normal by the slope angle nu [iso23509, 7.6]:

    sin nu = N_b m_n/(2 r_c),  S_r**2 = R**2 + r_c**2 - 2 R r_c sin(beta - nu).

Blades, spiral angle and slot are then corrected until the exact flanks have the blank's pressure
angles, spiral angle and tooth at the mean point.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, atan, atan2, cos, hypot, pi, sin, tan

import numpy as np

from hypoid.blank import MemberBlank
from hypoid.machine import MachineSettings

from ._hobbed_model import FORMED_AT, ROLLED_AT, Stick
from ._settings_model import vector_of

PASSES, SETTLED = 30, 1e-11
MET = 1e-9  # mm that Newton may leave


@dataclass(frozen=True)
class HeadPlan:
    """A head before its blades are ground: what both members' have in common; mm and rad."""

    radius: float  # r_c, mean of outer and inner P
    groups: int
    hook_angle: float
    rake_angle: float
    eccentric_angle: float
    curvature: float  # 1/mm, of the blades, positive crowns the tooth

    @property
    def spacing(self) -> float:
        """Turn by which an inner blade follows its outer one when spaced evenly, rad."""
        return pi / self.groups


@dataclass(frozen=True)
class HobbedCut:
    """Head and settings of a member; mm and rad, signs of the generator chain."""

    settings: MachineSettings
    radii: tuple[float, float]  # of P, outer and inner blade
    angles: tuple[float, float]  # blade angles
    height: float  # of P above the tips
    turns: tuple[float, float]  # cutter's turn where either blade passes the mean point
    miss: float  # greatest angle or width off the blank's, rad or mm


def stick(plan: HeadPlan, teeth: int, height: float, side: float) -> Stick:
    """The fixed measures of the outer (side +1) or inner blade of an evenly spaced head."""
    phase = 0.0 if side > 0.0 else -plan.spacing  # the inner blade of the group before
    return Stick(
        plan.groups / teeth,
        height,
        plan.eccentric_angle,
        plan.hook_angle,
        plan.rake_angle,
        side,
        phase,
    )


def hobbed_cut(
    blank: MemberBlank,
    plan: HeadPlan,
    *,
    tooth_thickness: float,
    pressure_angles: tuple[float, float],
    generated: bool,
    deeper: float = 0.0,
) -> HobbedCut | None:
    """Head and settings of a member; None where its flanks do not pass the mean point.

    Parameters
    ----------
    tooth_thickness
        Normal thickness at the mean point, mm.
    pressure_angles
        At the mean point against the pitch cone: of the concave (outer blade) and the convex flank.
    generated
        Rolled with a crown gear in the root plane, or form cut.
    deeper
        How much deeper than the blank's root cone the tips run, mm.
    """
    root, taper = blank.root_angle, blank.dedendum_angle
    z, rho = blank.position(blank.mean_cone_distance, 0.0)
    apex = blank.pitch_apex_beyond_crossing_point
    along = sin(root) * rho + cos(root) * (z + apex)
    # the cradle's axis meets the work's in the pitch apex, below which the tips run by `base`
    base = sin(root) * (apex - blank.root_apex_beyond_crossing_point) + deeper
    height = cos(root) * rho - sin(root) * (z + apex) + base
    beta, r_m = blank.mean_spiral_angle, 0.5 * blank.mean_pitch_diameter
    pitch = 2.0 * pi * r_m * cos(beta) / blank.teeth
    share = min(plan.groups * pitch / (2.0 * pi * plan.radius), 0.95)
    nu = asin(share)
    # a blade's lean against the pitch plane differs by what the root line is tilted
    lean = sin(beta) * sin(taper)
    size, turned = hypot(cos(taper), lean), atan2(lean, cos(taper))
    first = asin(sin(pressure_angles[0]) / size) - turned
    second = asin(sin(pressure_angles[1]) / size) + turned
    slot = pitch - tooth_thickness
    wanted = np.array([*pressure_angles, beta, slot / r_m])
    x = np.array([first, second, atan(tan(beta) / cos(taper)), slot / r_m])
    even = plan.spacing * plan.radius * sin(plan.eccentric_angle)
    sticks = [stick(plan, blank.teeth, height, side) for side in (1.0, -1.0)]
    flank_at = ROLLED_AT if generated else FORMED_AT
    turns: list[float] | None = None
    made: HobbedCut | None = None
    for _ in range(PASSES):
        across = plan.radius * cos(x[2] - nu)
        along_centre = along - plan.radius * sin(x[2] - nu)
        q = atan2(across, along_centre)
        settings = MachineSettings(
            radial_distance=hypot(across, along_centre),
            cradle_angle=q,
            machine_root_angle=root,
            machine_center_to_back=apex,
            sliding_base=-base,
            ratio_of_roll=cos(taper) / sin(blank.pitch_angle) if generated else 1.0,
            roll_to_blade_ratio=plan.groups / blank.teeth,
            generated=generated,
        )
        half = 0.5 * (float(x[3]) * r_m - even) / cos(plan.eccentric_angle)
        radii = plan.radius + half, plan.radius - half
        if turns is None:
            start = float(x[2]) - nu - q
            turns = [start, start - plan.spacing]
        seen: list[np.ndarray] = []
        for i in (0, 1):
            blade = {
                "point_radius": radii[i],
                "blade_angle": float(x[i]),
                "blade_curvature": plan.curvature,
            }
            vector = vector_of(settings, blade)
            seen.append(flank_at(vector, sticks[i], [z], [rho], [0.0], [turns[i]], [0.0])[:, 0])
        if not all(found[4] < MET for found in seen):
            return None
        turns = [float(found[1]) for found in seen]
        at = [_angles(found, blank.pitch_angle) for found in seen]
        thick = float(np.mod(seen[1][3] - seen[0][3], 2.0 * pi / blank.teeth))
        got = np.array(
            [
                at[0][0],
                at[1][0],
                0.5 * (at[0][1] + at[1][1]),
                (2.0 * pi / blank.teeth - thick) * cos(beta),
            ]
        )
        left = wanted - got
        made = HobbedCut(
            settings,
            radii,
            (float(x[0]), float(x[1])),
            height,
            (turns[0], turns[1]),
            float(np.abs(left).max()),
        )
        if made.miss < SETTLED:
            break
        x = x + left
    return made


def _angles(found: np.ndarray, pitch_angle: float) -> tuple[float, float]:
    """Pressure and spiral angle from a normal's radial, tangential and axial parts, rad."""
    radial, around, axial = (float(v) for v in found[7:10])
    along = sin(pitch_angle) * radial + cos(pitch_angle) * axial
    up = cos(pitch_angle) * radial - sin(pitch_angle) * axial
    sign = 1.0 if up > 0.0 else -1.0  # the root's side, not the way round, is what is not known
    turned = along if around > 0.0 else -along  # zerol teeth may lean either way
    return asin(max(-1.0, min(1.0, sign * up))), atan2(turned, abs(around))
