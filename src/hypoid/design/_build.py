"""From any design to its pair."""

from __future__ import annotations

from hypoid.pair import GearPair

from ._blank import Spec
from ._exact_face_hobbed import build_exact
from ._milled_design import design_milled
from ._milled_pair import build_milled
from ._milled_request import MilledRequest
from ._sheet_spec import SummarySheetSpec


def build(spec: Spec) -> GearPair:
    """The pair of a design: blank, heads, settings and flanks.

    Raises
    ------
    DesignError
        Where no such pair exists, with the violated limit.
    """
    if isinstance(spec, MilledRequest):
        spec = design_milled(spec).spec
    return build_milled(spec) if isinstance(spec, SummarySheetSpec) else build_exact(spec)
