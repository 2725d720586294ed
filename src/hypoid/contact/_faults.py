"""What is wrong with a contact, in words that say what to do."""

from __future__ import annotations

from collections.abc import Iterable

from ._interference import TipInterference
from ._unloaded import UnloadedContact


def faults(contact: UnloadedContact, cuts: Iterable[TipInterference]) -> tuple[str, ...]:
    """Faults of one direction: no contact, and tips that cut into the mating fillet."""
    named = [
        f"{contact.direction}: the {cut.tip_of} tip cuts {cut.depth * 1e3:.2f} um into the fillet "
        f"of the {cut.into} (S {cut.cone_distance:.2f} mm, H {cut.height:.3f} mm); relieve the "
        "tip, lower the addendum or make the cutter's edge radius smaller."
        for cut in cuts
        if cut.found
    ]
    if not contact.touched:
        named.insert(
            0,
            f"{contact.direction}: at some positions no point of the flanks meets the mate; "
            "check the settings, or the errors of mounting.",
        )
    return tuple(named)
