"""The blank that a design asks for."""

from __future__ import annotations

from hypoid.blank import PairBlank, pair_blank

from ._spec import ExactFaceHobbedSpec


def spec_blank(spec: ExactFaceHobbedSpec) -> PairBlank:
    """The blank alone: quick, no JAX needed.

    Raises
    ------
    DesignError
        Where there are no pitch cones, with the violated limit.
    """
    return pair_blank(
        z1=spec.pinion_teeth,
        z2=spec.wheel_teeth,
        shaft_angle=spec.shaft_angle,
        offset=spec.offset,
        wheel_mean_radius=spec.wheel_mean_radius,
        wheel_face_width=spec.wheel_face_width,
        pinion_spiral_angle=spec.pinion_spiral_angle,
        cutter_radius=spec.cutter_radius,
        blade_groups=spec.blade_groups,
        mean_addendum_factor=spec.mean_addendum_factor,
        depth_factor=spec.depth_factor,
        clearance_factor=spec.clearance_factor,
        pinion_hand=spec.pinion_hand,
        pressure_angle=spec.pressure_angle,
    )
