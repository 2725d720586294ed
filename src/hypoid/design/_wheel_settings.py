"""Face-milled wheel from its blank: spread-blade cutter and settings, closed form.

The cutter's tips run along the root cone and its axis stands square to it, through which the mean
point's slot has the blank's spiral angle. A blade then meets the pitch plane at an angle that differs
from its own by what the root line is tilted (theta_f2 sin beta): the outside and the inside blade
of one pressure angle differ by twice that.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, atan, atan2, cos, hypot, sin, tan

from hypoid.blank import MemberBlank


@dataclass(frozen=True)
class WheelCut:
    """Cutter and settings of a face-milled wheel; mm and rad, signs of the generator chain."""

    radial_distance: float
    cradle_angle: float
    machine_root_angle: float
    machine_center_to_back: float  # from the crossing point
    ratio_of_roll: float  # 0: form cut
    point_radii: tuple[float, float]  # outside, inside
    blade_angles: tuple[float, float]
    point_width: float
    depth: float  # of the tips below the mean point, square to the root line, mm
    deeper: float = 0.0  # of the tips below the blank's root cone there, mm
    root_base: float = 0.0  # sliding base that puts the tips on the blank's root cone, mm

    @property
    def sliding_base(self) -> float:
        """As set, mm."""
        return self.root_base - self.deeper


def wheel_cut(
    blank: MemberBlank,
    *,
    cutter_radius: float,
    slot_width: float,
    pressure_angles: tuple[float, float],
    generated: bool,
    spiral_angle: float | None = None,
    deeper: float = 0.0,
) -> WheelCut:
    """Cutter and settings of a wheel.

    Parameters
    ----------
    cutter_radius
        Mean radius r_c0, mm.
    slot_width
        Normal width of the slot at the mean point, mm: the normal pitch less the tooth.
    pressure_angles
        At the mean point against the pitch plane: of the concave (outside blade) and the convex flank.
    generated
        Rolled with a crown gear in the root plane, or form cut (Formate).
    spiral_angle
        Of the middle of the slot at the mean point, rad; None: the blank's.
    deeper
        How much deeper than the blank's root cone the tips run, mm.
    """
    root, taper = blank.root_angle, blank.dedendum_angle
    z, rho = blank.position(blank.mean_cone_distance, 0.0)
    root_apex = blank.root_apex_beyond_crossing_point
    depth = cos(root) * rho - sin(root) * (z + root_apex) + deeper
    # a roll is true where the cradle's axis meets the work's at the pitch apex; a form cut has none
    back = blank.pitch_apex_beyond_crossing_point if generated else root_apex
    along = sin(root) * rho + cos(root) * (z + back)
    asked = blank.mean_spiral_angle if spiral_angle is None else spiral_angle
    beta = atan(tan(asked) / cos(taper))  # in the root plane
    across, along_centre = cutter_radius * cos(beta), along - cutter_radius * sin(beta)
    lean = sin(beta) * sin(taper)
    size, turn = hypot(cos(taper), lean), atan2(lean, cos(taper))
    outside = asin(sin(pressure_angles[0]) / size) - turn
    inside = asin(sin(pressure_angles[1]) / size) + turn
    width = slot_width - depth * (tan(outside) + tan(inside))
    ratio = cos(taper) / sin(blank.pitch_angle) if generated else 0.0
    return WheelCut(
        radial_distance=hypot(across, along_centre),
        cradle_angle=atan2(across, along_centre),
        machine_root_angle=root,
        machine_center_to_back=back,
        ratio_of_roll=ratio,
        point_radii=(cutter_radius + 0.5 * width, cutter_radius - 0.5 * width),
        blade_angles=(outside, inside),
        point_width=width,
        depth=depth,
        deeper=deeper,
        root_base=sin(root) * (root_apex - back),
    )
