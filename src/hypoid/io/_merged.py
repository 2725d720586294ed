"""A flank's table of a summary sheet: the member's keys, and the flank's own before them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from hypoid.geometry import Problem

from ._document import Document, left_out, line, number_at, shown, table_at
from ._keys import Table, keys_of
from ._quantity import Kind

SIDES = ("concave", "convex")


@dataclass(frozen=True)
class Merged:
    """The table `settings` or `blade` of one flank, as the file writes it."""

    member: str
    side: str
    name: str
    model: type[Table]
    of_member: Document
    of_flank: Document
    of_mate: Document  # the same member's other flank

    def __contains__(self, key: str) -> bool:
        return key in self.of_flank or key in self.of_member

    def given(self) -> list[str]:
        """Every key that holds for this flank."""
        return list(dict.fromkeys([*self.of_member, *self.of_flank]))

    def get(self, key: str) -> Any:
        """What holds for this flank, None where nothing does."""
        return self.of_flank.get(key, self.of_member.get(key))

    def word(self, key: str) -> str:
        """What holds for this flank as a word, "" where nothing does."""
        value = self.get(key)
        return "" if value is None else value if isinstance(value, str) else shown(value)

    def number(self, key: str, kind: Kind) -> float | None:
        """The quantity under a key, None where there is none that can be read."""
        return number_at({key: self.get(key)}, key, kind)

    def path(self, key: str) -> str:
        """Where the key stands; a missing one is wanted at the member unless the mate has its own."""
        at_flank = key in self.of_flank or (key not in self.of_member and key in self.of_mate)
        where = f"{self.member}.{self.side}" if at_flank else self.member
        return f"{where}.{self.name}.{key}"

    def wanted(self, key: str, expected: str = "") -> Problem:
        """A fault of a key's value, or that it is missing; expected is what the key always wants."""
        expected = expected or str(keys_of(self.model)[key].description)
        return Problem(self.path(key), shown(self.get(key)), expected, line(self.model, key))

    def unwanted(self, key: str, why: str) -> Problem:
        """A key that must not stand here, and why."""
        given = self.get(key)
        return Problem(self.path(key), shown(given), f"nothing: {why}", left_out(key, given))


def merged(document: Document, member: str, side: str, name: str, model: type[Table]) -> Merged:
    """The table `settings` or `blade` of a flank, and the model of it."""
    mate = SIDES[1 - SIDES.index(side)]
    return Merged(
        member,
        side,
        name,
        model,
        table_at(document, f"{member}.{name}"),
        table_at(document, f"{member}.{side}.{name}"),
        table_at(document, f"{member}.{mate}.{name}"),
    )
