"""The contact of a pair before, as cut now, and as it is predicted after a correction."""

from __future__ import annotations

from dataclasses import dataclass

from hypoid.contact import Pattern, UnloadedContact, pattern, unloaded_contact
from hypoid.pair import Direction, GearPair

DIRECTIONS: tuple[Direction, Direction] = ("drive", "coast")


@dataclass(frozen=True)
class ContactState:
    """Contact of one direction; transmission error peak to peak in rad."""

    contact: UnloadedContact
    pattern: Pattern

    @property
    def transmission_error(self) -> float:
        return self.contact.peak_to_peak

    @property
    def centre(self) -> tuple[float, float]:
        """(S, H) of the pattern's middle on the pinion, mm."""
        return self.pattern.centre


def contact_states(pairs: dict[str, GearPair]) -> dict[str, dict[Direction, ContactState]]:
    """Both directions' contact of every pair, by its name: "nominal", "now", "predicted"."""
    return {name: {d: _state(pair, d) for d in DIRECTIONS} for name, pair in pairs.items()}


def _state(pair: GearPair, direction: Direction) -> ContactState:
    contact = unloaded_contact(pair, direction)
    return ContactState(contact, pattern(contact))
