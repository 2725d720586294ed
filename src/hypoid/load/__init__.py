"""Loaded contact: compliance of the teeth, pressure, load sharing, root stress."""

from ._active_set import ContactSolution as ContactSolution
from ._active_set import Outcome as Outcome
from ._active_set import solve_contact as solve_contact
from ._bearings import RIGID as RIGID
from ._bearings import Bearings as Bearings
from ._bearings import bearings_of as bearings_of
from ._compliance import Elements as Elements
from ._compliance import Support as Support
from ._compliance import ToothCompliance as ToothCompliance
from ._compliance import tooth_compliance as tooth_compliance
from ._loaded import LoadCase as LoadCase
from ._loaded import LoadedContact as LoadedContact
from ._loaded import LoadedPosition as LoadedPosition
from ._loaded import PairLoad as PairLoad
from ._loaded import loaded_contact as loaded_contact
from ._material import STEEL as STEEL
from ._material import Material as Material
from ._material import material as material
from ._root_stress import RootStress as RootStress
from ._root_stress import root_stress as root_stress
from ._setup import MESHES as MESHES
from ._setup import assumptions as assumptions
from ._setup import pair_compliance as pair_compliance
from ._setup import rim_thickness as rim_thickness
from ._setup import warnings as warnings
