"""Dials of the cradle machines: what they read, how far they go, and on which steps they stand.

A machine's dials are a frozen dataclass (mm, rad, tooth counts); a table of `Dial` says of each
field what it may be. Tables are data: a shop with another machine replaces an entry.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, TypeVar, cast

from hypoid.geometry import DesignError, Problem

Hand = Literal["left", "right"]
Kind = Literal["angle", "length", "gears", "count", "direction"]
Dials = TypeVar("Dials")

MINUTE = math.radians(1.0 / 60.0)
HUNDREDTH = 0.01  # mm
SLACK = 1e-9  # rad or mm beyond a range that is rounding, not a fault


@dataclass(frozen=True)
class Dial:
    """What one dial reads: range (mm, rad or teeth, both ends included) and increment."""

    kind: Kind
    low: float
    high: float
    increment: float = 0.0  # 0: none, as for gears
    cyclic: bool = False  # a full turn more or less is the same reading
    optional: bool = False  # gears that the machine can do without
    example: str = ""

    def admits(self, value: float) -> bool:
        """Whether a number lies in the range."""
        if not math.isfinite(value):
            return False
        if self.cyclic:
            value = self.low + (value - self.low) % math.tau
            if value - self.low > math.tau - SLACK:
                value = self.low
        return self.low - SLACK <= value <= self.high + SLACK

    def words(self, value: Any) -> str:
        """A reading as a person writes it."""
        if self.kind == "gears":
            return (
                " x ".join(f"{a}/{b}" for a, b in zip(value[::2], value[1::2], strict=True))
                or "none"
            )
        return shown(value, self.kind)

    def expected(self) -> str:
        """The admissible range in words."""
        if self.kind == "direction":
            return "1 (with the cradle roll) or -1 (against it)"
        low, high = shown(self.low, self.kind), shown(self.high, self.kind)
        if self.kind == "gears":
            none = ", or none" if self.optional else ""
            return f"four tooth numbers (driver, driven, driver, driven) from {low} to {high}{none}"
        if self.kind == "count":
            return f"a whole number from {low} to {high}"
        return f"{'an angle' if self.kind == 'angle' else 'a length'} from {low} to {high}"


def angle_dial(low: float, high: float, example: str, *, cyclic: bool = False) -> Dial:
    """An angle between low and high (deg), on steps of one minute."""
    return Dial("angle", math.radians(low), math.radians(high), MINUTE, cyclic, example=example)


def length_dial(reach: float, example: str) -> Dial:
    """A length of up to reach (mm) on either side of zero, on steps of 0.01 mm."""
    return Dial("length", -reach, reach, HUNDREDTH, example=example)


def gear_dial(example: str, *, optional: bool = False) -> Dial:
    """Four change gears."""
    return Dial("gears", 12, 200, optional=optional, example=example)


def shown(value: float, kind: Kind) -> str:
    """A reading as a person writes it: ``64 deg 29 min``, ``19.78 mm``, ``53``."""
    if kind == "length":
        return f"{value:.6g} mm"
    if kind != "angle" or not math.isfinite(value):
        return f"{value:g}"
    minutes = round(math.degrees(abs(value)) * 60.0, 2)
    sign = "-" if value < 0.0 and minutes else ""
    whole, rest = divmod(minutes, 60.0)
    return f"{sign}{whole:g} deg" + (f" {rest:.4g} min" if rest else "")


def faults(dials: object, table: Mapping[str, Dial], path: str = "settings") -> list[Problem]:
    """Every dial that stands out of its range, each with what it may be."""
    return [p for name, dial in table.items() for p in _faults_of(dials, name, dial, path)]


def check(dials: object, table: Mapping[str, Dial], path: str = "settings") -> None:
    """Raise a `DesignError` with all `faults`, if there are any."""
    found = faults(dials, table, path)
    if found:
        raise DesignError(found)


def _faults_of(dials: object, name: str, dial: Dial, path: str) -> Iterator[Problem]:
    value: Any = getattr(dials, name)
    where, expected = f"{path}.{name}", dial.expected()
    if dial.kind == "gears":
        teeth = tuple(value)
        if not teeth and dial.optional:
            return
        whole = all(isinstance(n, int) and dial.admits(n) for n in teeth)
        if len(teeth) != 4 or not whole:
            yield Problem(where, str(list(teeth)), expected, dial.example)
    elif dial.kind == "direction":
        if value not in (1, -1):
            yield Problem(where, str(value), expected, dial.example)
    elif not dial.admits(value) or (dial.kind == "count" and value != int(value)):
        yield Problem(where, shown(value, dial.kind), expected, dial.example)


def rounded(dials: Dials, table: Mapping[str, Dial]) -> Dials:
    """The same dials, each on its nearest increment; tooth counts stay as they are."""
    changed: dict[str, float] = {}
    for name, dial in table.items():
        if dial.increment:
            value = round(getattr(dials, name) / dial.increment) * dial.increment
            changed[name] = full_turn(value) if dial.cyclic else value
    return cast("Dials", replace(cast("Any", dials), **changed))


def increments(table: Mapping[str, Dial]) -> dict[str, float]:
    """Step of each dial that has one, mm or rad."""
    return {name: dial.increment for name, dial in table.items() if dial.increment}


def ranges(table: Mapping[str, Dial]) -> dict[str, tuple[float, float]]:
    """Least and greatest reading of each dial, mm, rad or teeth."""
    return {name: (dial.low, dial.high) for name, dial in table.items()}


def full_turn(angle: float) -> float:
    """An angle in [0, 2 pi), as dials read; a hair below a full turn is zero."""
    angle %= math.tau
    return 0.0 if math.tau - angle < 1e-13 else angle


def half_turn(angle: float) -> float:
    """An angle in (-pi, pi], as basic settings are read."""
    angle = full_turn(angle)
    return angle - math.tau if angle > math.pi else angle
