"""Ground floor: errors, vectors, interpolation, compiled batches. Nothing here knows a gear.

Names that need JAX are loaded when first asked for: a command that only reads a file stays quick.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._errors import DesignError as DesignError
from ._errors import Problem as Problem

if TYPE_CHECKING:
    from ._chebyshev import fit as fit
    from ._chebyshev import fit_line as fit_line
    from ._chebyshev import horner as horner
    from ._chebyshev import horner_line as horner_line
    from ._chebyshev import nodes as nodes
    from ._chebyshev import on_unit as on_unit
    from ._jax import Batch as Batch
    from ._jax import Batched as Batched
    from ._jax import Rows as Rows
    from ._jax import Scalar as Scalar
    from ._jax import Vector as Vector
    from ._jax import compiled as compiled
    from ._jax import compiled_fused as compiled_fused
    from ._jax import jitted as jitted
    from ._jax import once as once
    from ._namespace import namespace as namespace
    from ._polynomial import polynomial as polynomial
    from ._trig import sine_cosine as sine_cosine
    from ._trig import unit_angle as unit_angle
    from ._vector import add as add
    from ._vector import cross as cross
    from ._vector import dot as dot
    from ._vector import scale as scale
    from ._vector import turn_z as turn_z
    from ._vector import unit as unit

_HOMES = {
    "_chebyshev": ("fit", "fit_line", "horner", "horner_line", "nodes", "on_unit"),
    "_jax": (
        "Batch",
        "Batched",
        "Rows",
        "Scalar",
        "Vector",
        "compiled",
        "compiled_fused",
        "jitted",
        "once",
    ),
    "_namespace": ("namespace",),
    "_polynomial": ("polynomial",),
    "_trig": ("sine_cosine", "unit_angle"),
    "_vector": ("add", "cross", "dot", "scale", "turn_z", "unit"),
}
_HOME = {name: module for module, names in _HOMES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(f".{_HOME[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
