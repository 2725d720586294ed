"""The blank that a design asks for: quick, no JAX needed."""

from __future__ import annotations

from hypoid.blank import PairBlank, given_pair_blank, iso_blank, pair_blank

from ._hobbed_request import HobbedRequest
from ._milled_request import MilledRequest
from ._sheet_spec import SummarySheetSpec
from ._spec import ExactFaceHobbedSpec

Spec = ExactFaceHobbedSpec | SummarySheetSpec | MilledRequest | HobbedRequest


def spec_blank(spec: Spec) -> PairBlank:
    """The blank alone, as far as the design gives it.

    Raises
    ------
    DesignError
        Where there are no pitch cones, with the violated limit.
    """
    if isinstance(spec, SummarySheetSpec):
        return sheet_blank(spec)
    if isinstance(spec, MilledRequest | HobbedRequest):
        return iso_blank(spec.blank)
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


def sheet_blank(spec: SummarySheetSpec) -> PairBlank:
    """The blank of a summary sheet; dedenda are NaN where its cutters say them."""
    return given_pair_blank(
        shaft_angle=spec.shaft_angle,
        offset=spec.offset,
        teeth=(spec.pinion.teeth, spec.wheel.teeth),
        pinion=spec.pinion.blank,
        wheel=spec.wheel.blank,
        pinion_hand=spec.pinion.hand,
    )
