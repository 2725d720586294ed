"""Unloaded contact of a mounted pair: motion curve, path, pattern, ease-off, misalignment."""

from ._backlash import Backlash as Backlash
from ._backlash import backlash as backlash
from ._backlash import pair_backlash as pair_backlash
from ._faults import faults as faults
from ._interference import TipInterference as TipInterference
from ._interference import tip_interference as tip_interference
from ._misalignment import STEPS as STEPS
from ._misalignment import MisalignedContact as MisalignedContact
from ._misalignment import VHResult as VHResult
from ._misalignment import contacts as contacts
from ._misalignment import sensitivity as sensitivity
from ._misalignment import summary as summary
from ._misalignment import vh_check as vh_check
from ._mounting import Misalignment as Misalignment
from ._mounting import Mounting as Mounting
from ._mounting import mounting as mounting
from ._pattern import EaseOff as EaseOff
from ._pattern import Pattern as Pattern
from ._pattern import ease_off as ease_off
from ._pattern import pattern as pattern
from ._traced import ContactParameters as ContactParameters
from ._traced import TracedContact as TracedContact
from ._traced import traced_contact as traced_contact
from ._unloaded import Sampling as Sampling
from ._unloaded import UnloadedContact as UnloadedContact
from ._unloaded import unloaded_contact as unloaded_contact
