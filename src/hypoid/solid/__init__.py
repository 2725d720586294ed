"""Solids: a tooth, a sector or a gear with its body, as meshes of its exact surfaces.

Names that need SciPy are loaded when first asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._body import RIM as RIM
from ._body import Body as Body
from ._body import body as body
from ._mesh import STEEL as STEEL
from ._mesh import MassProperties as MassProperties
from ._mesh import SurfaceMesh as SurfaceMesh
from ._mesh import mass_properties as mass_properties
from ._request import chord_problems as chord_problems
from ._request import largest_bore as largest_bore
from ._request import ring_problems as ring_problems
from ._request import tooth_problems as tooth_problems

if TYPE_CHECKING:
    from ._brep import Arc as Arc
    from ._brep import Brep as Brep
    from ._brep import Flat as Flat
    from ._brep import Segment as Segment
    from ._brep import SplineSurface as SplineSurface
    from ._brep import Turned as Turned
    from ._gear_brep import gear_brep as gear_brep
    from ._hex_cell import face_nodes as face_nodes
    from ._hex_mesh import HexMesh as HexMesh
    from ._hex_mesh import hex_mesh as hex_mesh
    from ._hex_quality import Quality as Quality
    from ._hex_quality import shape_gradients as shape_gradients
    from ._probes import probes as probes
    from ._splines import SplineCurve as SplineCurve
    from ._splines import tooth_splines as tooth_splines
    from ._split import SplitMesh as SplitMesh
    from ._split import split_under as split_under
    from ._surface_mesh import surface_mesh as surface_mesh

_LAZY = {
    "HexMesh": "_hex_mesh",
    "face_nodes": "_hex_cell",
    "hex_mesh": "_hex_mesh",
    **dict.fromkeys(("Quality", "shape_gradients"), "_hex_quality"),
    "surface_mesh": "_surface_mesh",
    **dict.fromkeys(("Arc", "Brep", "Flat", "Segment", "SplineSurface", "Turned"), "_brep"),
    "SplineCurve": "_splines",
    "gear_brep": "_gear_brep",
    "probes": "_probes",
    **dict.fromkeys(("SplitMesh", "split_under"), "_split"),
    "tooth_splines": "_splines",
}


def __getattr__(name: str) -> Any:
    if name in _LAZY:
        return getattr(import_module(f".{_LAZY[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
