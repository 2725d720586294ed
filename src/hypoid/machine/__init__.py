"""Machines: basic settings, the generator chain, and each physical machine's own signs."""

from ._generator import Meshing as Meshing
from ._generator import Placed as Placed
from ._generator import SweptEdge as SweptEdge
from ._generator import mesh_closed as mesh_closed
from ._generator import mesh_newton as mesh_newton
from ._generator import meshing_function as meshing_function
from ._generator import place as place
from ._generator import solve_meshing as solve_meshing
from ._generator import sweep as sweep
from ._settings import Generator as Generator
from ._settings import MachineSettings as MachineSettings
from ._settings import chain as chain
from ._settings import generator as generator
from ._summary_sheet import SummarySheet as SummarySheet
from ._summary_sheet import from_sheet as from_sheet
from ._summary_sheet import to_sheet as to_sheet
