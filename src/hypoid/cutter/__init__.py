"""Cutters: a blade's edge as plane pieces, and the heads that carry blades."""

from ._edge import EdgePiece as EdgePiece
from ._edge import edge_point as edge_point
from ._face_hob import Blade as Blade
from ._face_hob import BladeRelief as BladeRelief
from ._face_hob import FaceHobHead as FaceHobHead
