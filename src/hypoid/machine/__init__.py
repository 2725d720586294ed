"""Machines: basic settings, the generator chain, and each physical machine's own signs."""

from ._cam import Cam as Cam
from ._cam import cam_roll as cam_roll
from ._generator import Meshing as Meshing
from ._generator import Placed as Placed
from ._generator import SweptEdge as SweptEdge
from ._generator import Way as Way
from ._generator import mesh_closed as mesh_closed
from ._generator import mesh_newton as mesh_newton
from ._generator import meshing_function as meshing_function
from ._generator import place as place
from ._generator import place_plain as place_plain
from ._generator import sweep as sweep
from ._generator import to_cradle as to_cradle
from ._meshed import meshed as meshed
from ._pose import Generator as Generator
from ._pose import generator as generator
from ._revolution import mesh_cutter as mesh_cutter
from ._revolution import mesh_straight as mesh_straight
from ._settings import MachineSettings as MachineSettings
from ._settings import Motions as Motions
from ._settings import chain as chain
from ._summary_sheet import SummarySheet as SummarySheet
from ._summary_sheet import from_sheet as from_sheet
from ._summary_sheet import to_sheet as to_sheet
