"""Blanks: pitch cones, tooth depths, face and root cones. Plain floats, mm and rad; no JAX.

The mounting frame that the contact room relies on is described in `_pitch_cones`.
"""

from ._alignment import FaceHobbedInputs as FaceHobbedInputs
from ._alignment import alignment_residual as alignment_residual
from ._alignment import ratio_residual as ratio_residual
from ._alignment import solve_aligned_cones as solve_aligned_cones
from ._blank import BlankFault as BlankFault
from ._blank import MemberBlank as MemberBlank
from ._blank import OuterPinionReading as OuterPinionReading
from ._blank import OuterPinionReadings as OuterPinionReadings
from ._blank import PairBlank as PairBlank
from ._cones import FaceAndRootCones as FaceAndRootCones
from ._cones import face_and_root_cones as face_and_root_cones
from ._depths import DepthFactors as DepthFactors
from ._depths import EndDepths as EndDepths
from ._depths import MeanDepths as MeanDepths
from ._depths import depth_factors as depth_factors
from ._depths import end_depths as end_depths
from ._depths import mean_depths as mean_depths
from ._face_width import EqualFaceWidth as EqualFaceWidth
from ._face_width import FaceWidth as FaceWidth
from ._face_width import GleasonFaceWidth as GleasonFaceWidth
from ._face_width import KlingelnbergFaceWidth as KlingelnbergFaceWidth
from ._face_width import OerlikonFaceWidth as OerlikonFaceWidth
from ._face_width import PinionFaceWidth as PinionFaceWidth
from ._face_width import split_face_width as split_face_width
from ._given import GivenBlank as GivenBlank
from ._given import crown_point as crown_point
from ._given import given_pair_blank as given_pair_blank
from ._given import with_root_line as with_root_line
from ._limits import PitchConeFault as PitchConeFault
from ._pair_blank import blank_of_cones as blank_of_cones
from ._pair_blank import pair_blank as pair_blank
from ._pitch_cones import PitchCones as PitchCones
from ._pitch_cones import Tangency as Tangency
from ._pitch_cones import limit_pressure_angle as limit_pressure_angle
from ._pitch_cones import pitch_cones as pitch_cones
from ._pitch_cones import tangency as tangency
from ._spiral_angles import CrownGearTooth as CrownGearTooth
from ._spiral_angles import EndSpiralAngles as EndSpiralAngles
from ._spiral_angles import crown_gear_tooth as crown_gear_tooth
from ._spiral_angles import end_spiral_angles as end_spiral_angles
from ._thickness import ToothThickness as ToothThickness
from ._thickness import TopLand as TopLand
from ._thickness import mean_normal_thickness as mean_normal_thickness
from ._thickness import tooth_thickness as tooth_thickness
from ._thickness import top_land as top_land
