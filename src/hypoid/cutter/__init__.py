"""Cutters: a blade's edge as plane pieces, and the heads that carry blades."""

from ._cyclo_palloid import CycloPalloidHead as CycloPalloidHead
from ._cyclo_palloid import PartSetting as PartSetting
from ._cyclo_palloid import lengthwise_radius as lengthwise_radius
from ._edge import EdgePiece as EdgePiece
from ._edge import edge_point as edge_point
from ._face_hob import Blade as Blade
from ._face_hob import BladeRelief as BladeRelief
from ._face_hob import FaceHobHead as FaceHobHead
from ._face_mill import FaceMillHead as FaceMillHead
from ._mill_blade import BladeCurve as BladeCurve
from ._mill_blade import CircularProfile as CircularProfile
from ._mill_blade import Flankrem as Flankrem
from ._mill_blade import MillBlade as MillBlade
from ._mill_blade import ParabolicProfile as ParabolicProfile
from ._mill_blade import Toprem as Toprem
from ._profile import BladeName as BladeName
from ._profile import PlanePiece as PlanePiece
from ._traced_edge import mill_edge as mill_edge
from ._traced_edge import stick_edges as stick_edges
from ._tri_ac import TriAcHead as TriAcHead
from ._tri_ac_blade import BladeToprem as BladeToprem
from ._tri_ac_blade import TopremReading as TopremReading
from ._tri_ac_blade import TriAcBlade as TriAcBlade
