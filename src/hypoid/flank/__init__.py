"""Flanks: the envelope of a swept edge, its pieces, and points of it on demand."""

from ._angles import FlankAngles as FlankAngles
from ._angles import flank_angles as flank_angles
from ._chart import Border as Border
from ._chart import Chart as Chart
from ._chart import PitchCone as PitchCone
from ._chart import chart as chart
from ._cut import best_way as best_way
from ._cut import cut_flank as cut_flank
from ._cut import lowest_line as lowest_line
from ._cut import recut as recut
from ._cut import roll_range as roll_range
from ._cut import trimmed as trimmed
from ._deviation import Deviation as Deviation
from ._deviation import deviation as deviation
from ._envelope import Surface as Surface
from ._envelope import axial_radial_angle as axial_radial_angle
from ._envelope import placed as placed
from ._envelope import position_and_normal as position_and_normal
from ._envelope import solve_pair as solve_pair
from ._flank import Flank as Flank
from ._flank import FlankPoints as FlankPoints
from ._flank import Side as Side
from ._status import PointStatus as PointStatus
from ._tooth import Profile as Profile
from ._tooth import Tooth as Tooth
from ._tooth import ToothGrid as ToothGrid
