"""Files: design files in, grids and texts out. Units and notation live here and nowhere else.

Names that need NumPy are loaded when first asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._examples import example_files as example_files
from ._quantity import Kind as Kind
from ._quantity import QuantityError as QuantityError
from ._quantity import parse as parse
from ._read import parse_spec as parse_spec
from ._read import read_spec as read_spec
from ._schema import json_schema as json_schema
from ._write import write_bytes as write_bytes
from ._write import write_text as write_text

if TYPE_CHECKING:
    from ._calculix import contact_text as contact_text
    from ._calculix import read_contact as read_contact
    from ._calculix import write_contact as write_contact
    from ._design_written import design_text as design_text
    from ._grid import FlankGrid as FlankGrid
    from ._grid import grid_csv as grid_csv
    from ._grid import grid_json as grid_json
    from ._hex_files import write_hex as write_hex
    from ._hobbed_written import exact_text as exact_text
    from ._hobbed_written import hobbed_text as hobbed_text
    from ._inspection_json import inspection_json as inspection_json
    from ._inspection_layout import Layout as Layout
    from ._inspection_layout import layouts as layouts
    from ._inspection_layout import read_layout as read_layout
    from ._inspection_layout import user_layouts as user_layouts
    from ._inspection_read import read_inspection as read_inspection
    from ._inspection_rewrite import corrected_design as corrected_design
    from ._inspection_write import inspection_text as inspection_text
    from ._mesh_files import write_mesh as write_mesh
    from ._points import point_files as point_files
    from ._points import tooth_points as tooth_points
    from ._points import write_points as write_points
    from ._step import StepReport as StepReport
    from ._step import write_step as write_step

_LAZY = {
    "contact_text": "_calculix",
    "read_contact": "_calculix",
    "write_contact": "_calculix",
    "design_text": "_design_written",
    "FlankGrid": "_grid",
    "grid_csv": "_grid",
    "grid_json": "_grid",
    "write_hex": "_hex_files",
    "Layout": "_inspection_layout",
    "layouts": "_inspection_layout",
    "read_layout": "_inspection_layout",
    "user_layouts": "_inspection_layout",
    "corrected_design": "_inspection_rewrite",
    "read_inspection": "_inspection_read",
    "exact_text": "_hobbed_written",
    "hobbed_text": "_hobbed_written",
    "inspection_json": "_inspection_json",
    "inspection_text": "_inspection_write",
    "write_mesh": "_mesh_files",
    "point_files": "_points",
    "tooth_points": "_points",
    "write_points": "_points",
    "StepReport": "_step",
    "write_step": "_step",
}


def __getattr__(name: str) -> Any:
    if name in _LAZY:
        return getattr(import_module(f".{_LAZY[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
