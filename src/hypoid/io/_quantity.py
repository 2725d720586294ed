"""Quantities as engineers write them, `12 deg 30 min` or `9.075 in`, to mm, rad, N and MPa.

The kind of quantity decides what a unit means: ' is a minute in an angle, a foot in a length.
"""

from __future__ import annotations

import re
from math import isfinite, pi
from typing import Literal

Kind = Literal[
    "length", "angle", "per_length", "length_per_angle", "length_per_angle^2",
    "length_per_angle^3", "length_per_angle^4", "length_per_angle^5", "length_per_angle^6",
    "force", "torque", "stress",
]  # fmt: skip

_MM = {"mm": 1.0, "um": 1e-3, "m": 1e3, "cm": 10.0, "in": 25.4, "ft": 304.8}
_DEG = pi / 180
_RAD = {
    "deg": _DEG, "rad": 1.0, "min": _DEG / 60, "sec": _DEG / 3600,
    "arcmin": _DEG / 60, "arcsec": _DEG / 3600, "mrad": 1e-3, "urad": 1e-6,
}  # fmt: skip
_PER_POWER: tuple[Kind, ...] = (
    "length_per_angle^2", "length_per_angle^3", "length_per_angle^4", "length_per_angle^5",
    "length_per_angle^6",
)  # fmt: skip
_INCH_POUND = 112.98482902761668  # N mm

# Unit -> its size in the program's own unit. A space may be left out, or written as * or a dot.
_UNITS: dict[Kind, dict[str, float]] = {
    "length": _MM | {"'": 304.8, '"': 25.4},
    "angle": _RAD | {"°": _DEG, "'": _DEG / 60, '"': _DEG / 3600},
    "per_length": {f"{one}/{unit}": 1 / mm for unit, mm in _MM.items() for one in ("", "1")},
    "length_per_angle": {f"{a}/{b}": _MM[a] / _RAD[b] for a in _MM for b in ("rad", "deg")},
    **{
        kind: {f"{a}/{b}^{n}": _MM[a] / _RAD[b] ** n for a in _MM for b in ("rad", "deg")}
        for n, kind in enumerate(_PER_POWER, start=2)
    },
    "force": {"N": 1.0, "kN": 1e3, "lbf": 4.4482216152605},
    "torque": {
        "N m": 1e3, "kN m": 1e6, "N mm": 1.0, "lbf in": _INCH_POUND, "lbf ft": 12 * _INCH_POUND
    },
    "stress": {
        "MPa": 1.0, "GPa": 1e3, "kPa": 1e-3, "Pa": 1e-6, "N/mm^2": 1.0, "N/mm2": 1.0,
        "psi": 6.894757293168361e-3, "ksi": 6.894757293168361,
    },
}  # fmt: skip
_EXAMPLES: dict[Kind, str] = {
    "length": "55 mm",
    "angle": "12 deg 30 min",
    "per_length": "0.004 /mm",
    "length_per_angle": "0.1 mm/rad",
    **{kind: f"0.01 mm/rad^{n}" for n, kind in enumerate(_PER_POWER, start=2)},
    "force": "1.5 kN",
    "torque": "110 N m",
    "stress": "206 GPa",
}
_SAME = str.maketrans({"µ": "u", "μ": "u", "′": "'", "’": "'", "″": '"', "”": '"', "−": "-"})
_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"


def _term(units: dict[str, float]) -> re.Pattern[str]:
    """One number with its unit, the longest unit first."""
    written = (re.escape(u).replace(r"\ ", r"[ *·]?") for u in sorted(units, key=len, reverse=True))
    return re.compile(rf"({_NUMBER})\s*({'|'.join(written)})(?![^\W\d])\s*")


_TERMS = {kind: _term(units) for kind, units in _UNITS.items()}


class QuantityError(ValueError):
    """Why a text is no quantity of the kind asked for; `example` is a text that is."""

    def __init__(self, given: str, expected: str, example: str) -> None:
        self.given, self.expected, self.example = given, expected, example
        super().__init__(f'got {given}; expected {expected}; for example "{example}"')


def written(value: object) -> str:
    """A value as text; Python writes no whole number of more than some thousand digits."""
    if isinstance(value, int) and value.bit_length() > 400:
        return f"a number of {value.bit_length()} bits"
    return str(value)


def parse(given: object, kind: Kind) -> float:
    """Value of a quantity in mm, rad, N, N mm or MPa; a sign holds for the whole of it."""
    text = given.translate(_SAME).replace("''", '"').strip() if isinstance(given, str) else ""
    reason = ""
    try:
        return _sum_of_terms(text, kind)
    except ValueError as error:
        reason = f"; {error}" if str(error) else ""
    name, units = kind.replace("_", " "), list(_UNITS[kind])
    article = "an" if name[0] in "aeiou" else "a"
    bare = text or written(given)  # a bare number is shown with the unit it lacks
    raise QuantityError(
        given=f'"{given}"' if isinstance(given, str) else written(given),
        expected=f"{article} {name} with its unit ({', '.join(units[:6])}){reason}",
        example=f"{bare} {units[0]}" if re.fullmatch(f"-?{_NUMBER}", bare) else _EXAMPLES[kind],
    )


def _sum_of_terms(text: str, kind: Kind) -> float:
    """`12 deg 30 min` is 12 deg and 30 min: ever smaller units, decimals in the last one only."""
    sign = -1.0 if text.startswith("-") else 1.0
    rest = text[1:].lstrip() if text[:1] in ("+", "-") else text
    sizes = {unit.replace(" ", ""): size for unit, size in _UNITS[kind].items()}
    total, above = 0.0, float("inf")
    while term := _TERMS[kind].match(rest):
        number, size = float(term[1]), sizes[re.sub(r"[ *·]", "", term[2])]
        rest = rest[term.end() :]
        if not isfinite(number * size):
            raise ValueError("the number must be finite")
        if rest and not number.is_integer():
            raise ValueError("only the last part may have decimals")
        if number * size >= above * (1 - 1e-12):
            raise ValueError(f"{term[0].strip()} is not less than one of the unit before it")
        total, above = total + number * size, size
    if rest or above == float("inf"):
        raise ValueError
    return sign * total + 0.0  # no negative zero
