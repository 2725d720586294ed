"""From what is asked to a pair: blank, cutter and machine settings by each method.

Names that need JAX are loaded when first asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._blank import spec_blank as spec_blank
from ._spec import Assumption as Assumption
from ._spec import ExactFaceHobbedSpec as ExactFaceHobbedSpec
from ._spec import Hand as Hand
from ._spec import SettingValue as SettingValue
from ._spec import TipRelief as TipRelief

if TYPE_CHECKING:
    from ._exact_face_hobbed import build as build
    from ._exact_face_hobbed import exact_settings as exact_settings

_LAZY = ("build", "exact_settings")


def __getattr__(name: str) -> Any:
    if name in _LAZY:
        return getattr(import_module("._exact_face_hobbed", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
