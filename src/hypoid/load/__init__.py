"""Loaded contact: compliance of the teeth, pressure, load sharing, root stress."""

from ._active_set import ContactSolution as ContactSolution
from ._active_set import Outcome as Outcome
from ._active_set import solve_contact as solve_contact
