"""The pair: members, flanks, mounting."""

from ._pair import Assumption as Assumption
from ._pair import Direction as Direction
from ._pair import GearPair as GearPair
from ._pair import Head as Head
from ._pair import Member as Member
