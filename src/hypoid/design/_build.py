"""From any design to its pair."""

from __future__ import annotations

from dataclasses import replace

from hypoid.pair import GearPair, Member

from ._blank import Spec
from ._exact_face_hobbed import build_exact
from ._hobbed_design import design_hobbed
from ._hobbed_request import HobbedRequest
from ._milled_design import design_milled
from ._milled_pair import build_milled
from ._milled_request import MilledRequest
from ._sheet_spec import SummarySheetSpec
from ._spec import BodySpec


def build(spec: Spec) -> GearPair:
    """The pair of a design: blank, heads, settings and flanks.

    Raises
    ------
    DesignError
        Where no such pair exists, with the violated limit.
    """
    if isinstance(spec, MilledRequest):
        spec = design_milled(spec).spec
    elif isinstance(spec, HobbedRequest):
        spec = design_hobbed(spec).spec
    pair = build_milled(spec) if isinstance(spec, SummarySheetSpec) else build_exact(spec)
    members = {name: _carried(getattr(pair, name), body) for name, body in spec.bodies.items()}
    return replace(pair, **members)


def _carried(member: Member, body: BodySpec) -> Member:
    bore = None if body.bore_diameter is None else 0.5 * body.bore_diameter
    return replace(
        member,
        bore=bore,
        mounting_distance=body.mounting_distance,
        tip_rounding=body.tip_rounding,
        held=body.held,
        bearing_stiffness=body.stiffness,
    )
