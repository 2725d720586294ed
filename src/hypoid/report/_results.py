"""What a report shows: every result of a pair, each or the reason why it is missing."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TypeVar

import numpy as np

from hypoid.contact import (
    STEPS,
    Backlash,
    EaseOff,
    MisalignedContact,
    Misalignment,
    Pattern,
    TipInterference,
    UnloadedContact,
    VHResult,
    backlash,
    contacts,
    ease_off,
    faults,
    pattern,
    summary,
    tip_interference,
    unloaded_contact,
    vh_check,
)
from hypoid.flank import ToothFacts, tooth_facts
from hypoid.pair import Direction, GearPair

DIRECTIONS: tuple[Direction, ...] = ("drive", "coast")
ERRORS = ("offset", "pinion_axial", "wheel_axial", "shaft_angle")
Step = Callable[[str], None]
T = TypeVar("T")


@dataclass(frozen=True)
class Misaligned:
    """The contact under one error of mounting: its numbers and its pattern."""

    error: str  # field of Misalignment
    sign: int
    numbers: MisalignedContact
    pattern: Pattern


@dataclass
class DirectionResult:
    """Everything known of one direction of travel; None where it could not be computed."""

    direction: Direction
    contact: UnloadedContact | None = None
    pattern: Pattern | None = None
    ease_off: EaseOff | None = None
    cuts: tuple[TipInterference, ...] = ()
    misaligned: tuple[Misaligned, ...] = ()
    vh: tuple[tuple[VHResult, Pattern | None], ...] = ()
    faults: tuple[str, ...] = ()
    missing: list[str] = field(default_factory=list[str])

    def attempt(self, what: str, work: Callable[[], T]) -> T | None:
        """The result of some work, or None and a note where the design does not carry it."""
        try:
            return work()
        except (ArithmeticError, ValueError, IndexError, np.linalg.LinAlgError) as error:
            reason = str(error).splitlines()[0] if str(error) else type(error).__name__
            self.missing.append(f"{self.direction}: no {what} ({reason}).")
            return None


@dataclass(frozen=True)
class Results:
    """A pair and what was found, for both directions."""

    pair: GearPair
    drive: DirectionResult
    coast: DirectionResult

    @cached_property
    def teeth(self) -> Mapping[str, ToothFacts]:
        """What both members' teeth are like, by member."""
        members = (self.pair.pinion, self.pair.wheel)
        return {member.name: tooth_facts(member.tooth) for member in members}

    @cached_property
    def backlash(self) -> Backlash | None:
        """Backlash from both contacts; None without them."""
        if self.drive.contact is None or self.coast.contact is None:
            return None
        return backlash(self.drive.contact, self.coast.contact)

    @property
    def both(self) -> tuple[DirectionResult, DirectionResult]:
        return self.drive, self.coast

    @property
    def faults(self) -> tuple[str, ...]:
        """Everything that is wrong with the design, in words that say what to do."""
        found = list(self.pair.faults)
        for result in self.both:
            found += [*result.faults, *result.missing]
        return tuple(found)


STEPS_A_DIRECTION = 4  # calls of `step` in `_direction`


def results(pair: GearPair, step: Step) -> Results:
    """All results of a pair; `step` is called with what comes next."""
    drive, coast = (_direction(pair, direction, step) for direction in DIRECTIONS)
    return Results(pair, drive, coast)


def _direction(pair: GearPair, direction: Direction, step: Step) -> DirectionResult:
    out = DirectionResult(direction)
    step(f"{direction}: contact")
    contact = out.attempt("contact", lambda: unloaded_contact(pair, direction))
    if contact is None:
        return out
    out.contact = contact
    out.pattern = out.attempt("pattern", lambda: pattern(contact))
    out.ease_off = out.attempt("ease-off", lambda: ease_off(contact))
    step(f"{direction}: tip interference")
    out.cuts = out.attempt("check of the tips", lambda: tip_interference(contact)) or ()
    out.faults = faults(contact, out.cuts)
    step(f"{direction}: misalignments")
    out.misaligned = out.attempt("misalignments", lambda: _misaligned(contact)) or ()
    step(f"{direction}: V-H check")
    out.vh = out.attempt("V-H check", lambda: _vh(contact)) or ()
    return out


def _misaligned(contact: UnloadedContact) -> tuple[Misaligned, ...]:
    """Each of the four errors at its step, first minus then plus."""
    asked = [(error, sign) for error in ERRORS for sign in (-1, 1)]
    mountings = [replace(Misalignment(), **{e: s * float(getattr(STEPS, e))}) for e, s in asked]
    found = contacts(contact.pair, contact.direction, mountings)
    return tuple(
        Misaligned(error, sign, summary(result), pattern(result))
        for (error, sign), result in zip(asked, found, strict=True)
    )


def _vh(contact: UnloadedContact) -> tuple[tuple[VHResult, Pattern | None], ...]:
    """The V-H check, with the pattern that each of its mountings gives."""
    checked = vh_check(contact)
    places = [place.misalignment for place in checked if place.found]
    patterns = iter([pattern(c) for c in contacts(contact.pair, contact.direction, places)])
    return tuple((place, next(patterns) if place.found else None) for place in checked)
