"""Where a pinion's fit starts: the wheel's exact conjugate, or a bevel pinion of the blank's angles."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import Side
from hypoid.machine import MachineSettings, generator

from ._conjugate import Conjugate, facing_settings
from ._milled_wheel import MilledWheel
from ._settings_model import INDEX, settings_of, vector_of
from ._wheel_settings import wheel_cut

Array = np.ndarray[Any, Any]
Places = tuple[Array, Array, Array]  # edge parameter (mm), cutter's and cradle's turn (rad)


def conjugate_start(wheel: MilledWheel, blank: PairBlank, side: Side) -> Array:
    """The vector of the pinion flank that a form-cut wheel flank generates exactly.

    Its blade is the wheel's cone, of the opposite kind.
    """
    cut = wheel.cut
    height = cut.depth + blank.wheel.mean_addendum + (blank.clearance or 0.0)
    settings = facing_settings(cut, blank, height)
    i = 1 if side == "concave" else 0  # the pinion's outside blade is the wheel's inside cone
    angle = cut.blade_angles[i]
    sign = -1.0 if side == "concave" else 1.0
    radius = cut.point_radii[i] + sign * height * math.tan(angle)
    blade = {"point_radius": radius, "blade_angle": angle, "blade_curvature": 0.0}
    return vector_of(settings, blade)


def conjugate_places(conjugate: Conjugate, vector: Array) -> Places:
    """Edge parameters and turns of the conjugate's points on a cutter that stands as the wheel's."""
    gen = generator(settings_of(vector))
    head = np.array([[float(v) for v in row] for row in gen.head])
    centre = np.array([float(v) for v in gen.centre])
    centre[2] -= vector[INDEX["sliding_base"]]
    x, y, z = ((conjugate.cradle_point - centre) @ head).T
    return (
        -z / math.cos(vector[INDEX["blade_angle"]]),
        -np.arctan2(y, x),
        conjugate.roll,
    )


def plain_start(blank: PairBlank, cutter_radius: float, side: Side) -> Array:
    """The vector of a pinion flank that a crown gear in its root plane generates, as a bevel pinion's.

    It has the blank's root, and its pressure and spiral angle at the mean point; no tilt. Both flanks
    start from one setting and a spread-blade cutter, whose slot leaves the wheel's tooth its room.
    """
    own, angles = blank.pinion, blank.pressure_angles
    assert angles is not None
    thickness = (
        own.thickness.mean_normal if own.thickness else 0.5 * math.pi * blank.mean_normal_module
    )
    cut = wheel_cut(
        own,
        cutter_radius=cutter_radius,
        slot_width=math.pi * blank.mean_normal_module - thickness,
        pressure_angles=(angles.drive, angles.coast),
        generated=True,
    )
    settings = MachineSettings(
        radial_distance=cut.radial_distance,
        cradle_angle=cut.cradle_angle,
        machine_root_angle=cut.machine_root_angle,
        ratio_of_roll=cut.ratio_of_roll,
        roll_to_blade_ratio=0.0,
        swivel_angle=cut.cradle_angle - 0.5 * math.pi,
        machine_center_to_back=cut.machine_center_to_back,
        sliding_base=cut.sliding_base,
    )
    i = 0 if side == "concave" else 1
    blade = {"point_radius": cut.point_radii[i], "blade_angle": cut.blade_angles[i]}
    return vector_of(settings, blade | {"blade_curvature": 0.0})


def plain_places(conjugate: Conjugate, blank: PairBlank, vector: Array, side: Side) -> Places:
    """Edge parameters and turns near which a plain start's cutter passes the conjugate's points.

    In the root plane each point lies where the cutter's circle has its distance along the tooth; the cradle
    has turned it onto the pinion's axial plane.
    """
    own, sign = blank.pinion, 1.0 if side == "concave" else -1.0
    read = {name: float(vector[k]) for name, k in INDEX.items()}
    depth = own.mean_dedendum + (conjugate.distance - own.mean_cone_distance) * math.tan(
        own.dedendum_angle
    )
    s = (conjugate.height + depth) / math.cos(read["blade_angle"])
    sine, cosine = math.sin(read["machine_root_angle"]), math.cos(read["machine_root_angle"])
    x = sine * conjugate.rho + cosine * (conjugate.z + read["machine_center_to_back"])
    radius = read["point_radius"] + sign * s * math.sin(read["blade_angle"])
    centre, q = read["radial_distance"], read["cradle_angle"]
    theta = -np.arccos(np.clip((x - centre * math.cos(q)) / radius, -1.0, 1.0))
    y = -centre * math.sin(q) - radius * np.sin(theta)
    return s, theta, -np.arctan2(y, x)
