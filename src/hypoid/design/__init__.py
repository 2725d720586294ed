"""From what is asked to a pair: blank, cutter and machine settings by each method.

Names that need JAX are loaded when first asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._bearings import STIFFNESS_EXAMPLE as STIFFNESS_EXAMPLE
from ._bearings import STIFFNESS_EXPECTED as STIFFNESS_EXPECTED
from ._bearings import bearing_compliance as bearing_compliance
from ._blank import Spec as Spec
from ._blank import sheet_blank as sheet_blank
from ._blank import spec_blank as spec_blank
from ._hobbed_request import CURVED as CURVED
from ._hobbed_request import NO_HOBBER as NO_HOBBER
from ._hobbed_request import HobbedRequest as HobbedRequest
from ._hobbed_request import StickGrind as StickGrind
from ._milled_request import TOGETHER as TOGETHER
from ._milled_request import MilledRequest as MilledRequest
from ._milled_request import PinionMethod as PinionMethod
from ._milled_request import WheelMethod as WheelMethod
from ._pinion_limits import BLADES_APART as BLADES_APART
from ._pinion_limits import BLADES_HOBBED as BLADES_HOBBED
from ._pinion_limits import BLADES_TOGETHER as BLADES_TOGETHER
from ._pinion_limits import FREE as FREE
from ._pinion_limits import PinionLimits as PinionLimits
from ._sheet_spec import BladeSpec as BladeSpec
from ._sheet_spec import FlankSpec as FlankSpec
from ._sheet_spec import MemberSpec as MemberSpec
from ._sheet_spec import Method as Method
from ._sheet_spec import StickBladeSpec as StickBladeSpec
from ._sheet_spec import SummarySheetSpec as SummarySheetSpec
from ._sheet_spec import TopremReading as TopremReading
from ._sheet_spec import cut_apart as cut_apart
from ._spec import Assumption as Assumption
from ._spec import BodySpec as BodySpec
from ._spec import ExactFaceHobbedSpec as ExactFaceHobbedSpec
from ._spec import Hand as Hand
from ._spec import SettingValue as SettingValue
from ._spec import TipRelief as TipRelief
from ._target import EaseOffTarget as EaseOffTarget
from ._target import MotionTarget as MotionTarget
from ._target import Target as Target

if TYPE_CHECKING:
    from ._build import build as build
    from ._dialled import Dialled as Dialled
    from ._dialled import axis_tables as axis_tables
    from ._dialled import dialled as dialled
    from ._dialled import machine_named as machine_named
    from ._exact_face_hobbed import exact_settings as exact_settings
    from ._exact_sheet import ExactDesign as ExactDesign
    from ._exact_sheet import design_exact as design_exact
    from ._flank_fit import FlankFit as FlankFit
    from ._hobbed_design import HobbedDesign as HobbedDesign
    from ._hobbed_design import design_hobbed as design_hobbed
    from ._hobbed_fit import HobbedFit as HobbedFit
    from ._hobbed_fit import SideFit as SideFit
    from ._milled_design import MilledDesign as MilledDesign
    from ._milled_design import design_milled as design_milled

_LAZY = {
    "axis_tables": "_dialled",
    "build": "_build",
    "Dialled": "_dialled",
    "dialled": "_dialled",
    "machine_named": "_dialled",
    "exact_settings": "_exact_face_hobbed",
    "FlankFit": "_flank_fit",
    "ExactDesign": "_exact_sheet",
    "design_exact": "_exact_sheet",
    "HobbedDesign": "_hobbed_design",
    "design_hobbed": "_hobbed_design",
    "HobbedFit": "_hobbed_fit",
    "SideFit": "_hobbed_fit",
    "MilledDesign": "_milled_design",
    "design_milled": "_milled_design",
}


def __getattr__(name: str) -> Any:
    if name in _LAZY:
        return getattr(import_module(f".{_LAZY[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
