"""How far a torque is beyond what was looked at: pairs that carry load, and contact that has left the flanks."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hypoid.contact import UnloadedContact

from ._active_set import Outcome
from ._cells import Teeth
from ._load_case import LoadCase
from ._meeting import meeting
from ._position import PositionContact, position_contact

Progress = Callable[[str, int, int], None]
LEFT = 0.5  # of the contacts' outlines on edges: from there on they have left the flanks
NEARER = 1.1  # times: how near the torque is found at which they do


def needs_more(case: LoadCase) -> bool:
    """Whether the outermost of the pairs that were looked at carries load."""
    return any(at.outcome is Outcome.MORE_PAIRS for at in case.positions)


def pairs_needed(case: LoadCase) -> int:
    """How many pairs a case asks for: those that touch, and one more either way that does not."""
    solved = case.positions[
        -1 - case.per_pitch : -1
    ]  # from pinion angle zero on; others are copies
    return 2 * max(abs(p.pair) for at in solved for p in at.pairs) + 3


def has_left(found: PositionContact) -> bool:
    """Whether edges bound more than half of the contacts: flanks end there, and do not part."""
    return found.outcome is Outcome.OK and found.bounded_by_edges > LEFT


def has_left_at(case: LoadCase) -> bool:
    """Whether the contact has left the flanks at any position."""
    return any(at.outcome is Outcome.LEFT_FLANKS for at in case.positions)


def leaves_at(unloaded: UnloadedContact, teeth: Teeth, case: LoadCase, progress: Progress) -> float:
    """About the torque, N mm, at which the contact leaves the flanks where it first does in a case."""
    where = next(k for k, at in enumerate(case.pitch) if at.outcome is Outcome.LEFT_FLANKS)
    n, half = unloaded.sampling.positions_per_pitch, unloaded.sampling.pairs // 2
    at = len(unloaded.phi) // 2 + where * (n // case.per_pitch)
    meetings = [m for k in range(-half, half + 1) if (m := meeting(unloaded, at, k)) is not None]
    low, high, count = 0.0, case.torque, 0
    while high > NEARER * low:
        middle = float(np.sqrt(low * high)) if low else 0.5 * high
        if has_left(position_contact(meetings, teeth, middle)):
            high = middle
        else:
            low = middle
        count += 1
        progress("torque at which contact leaves the flanks", count, count)
    return float(np.sqrt(low * high))
