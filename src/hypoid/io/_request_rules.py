"""What ties keys together in a file that asks for a pair by its blank."""

from __future__ import annotations

from collections.abc import Iterator

from hypoid.design import BLADES_APART, BLADES_HOBBED, BLADES_TOGETHER, FREE, TOGETHER
from hypoid.geometry import Problem

from ._document import Document, assigned, left_out, number_at, shown, table_at, value_at
from ._keys import MOST_TEETH
from ._request_hobbed import hobbing_rules

SIZES = ("outer_pitch_diameter", "mean_pitch_diameter", "outer_transverse_module")
TYPE_II = ("mean_addendum_factor", "depth_factor", "clearance_factor", "thickness_factor")
TYPE_I = ("addendum_coefficient", "dedendum_coefficient", "profile_shift", "thickness_modification")
EASE_OFF = (
    "lengthwise_crowning", "profile_crowning", "bias", "pressure_angle", "spiral_angle", "tip_relief",
    "relief_from",
)  # fmt: skip
MOTION = ("transmission_error", "pattern_length", "place", "path_tilt")
BLADE_KEYS = tuple(
    key for keys, _ in (BLADES_APART, BLADES_TOGETHER, BLADES_HOBBED) for key in keys
)
_TAPERS = ("wheel_addendum_angle", "wheel_dedendum_angle")


def request_rules(document: Document) -> Iterator[Problem]:
    """Every fault between keys."""
    few, many = (value_at(document, (member, "teeth")) for member in ("pinion", "wheel"))
    if isinstance(few, int) and isinstance(many, int) and 1 <= many < few <= MOST_TEETH:
        expected = f"as many teeth as the pinion, which has {few}, or more"
        yield Problem("wheel.teeth", str(many), expected, assigned("teeth", few))
    yield from _one_of(document, "wheel", SIZES, "the wheel's size", "170 mm")
    yield from _spiral(document)
    yield from _tooth_data(document)
    given = [name for name in _TAPERS if name in table_at(document, "blank")]
    if len(given) == 1:
        lacking = next(name for name in _TAPERS if name not in given)
        expected = "both angles of the wheel's taper, or neither"
        yield Problem(f"blank.{lacking}", "nothing", expected, assigned(lacking, "2 deg"))
    method, offset = (
        value_at(document, ("blank", "method")),
        number_at(document, "pair.offset", "length"),
    )
    if method == 0 and offset:
        expected = "0 mm with method 0 (spiral bevel), or blank.method 1, 2 or 3"
        yield Problem(
            "pair.offset",
            shown(value_at(document, ("pair", "offset"))),
            expected,
            assigned("offset", "0 mm"),
        )
    yield from _pinion_limits(document)
    for side in ("drive", "coast"):
        yield from _target(document, f"contact.{side}")
    yield from hobbing_rules(document)


def _one_of(
    document: Document, table: str, keys: tuple[str, ...], what: str, example: str
) -> Iterator[Problem]:
    """Exactly one of several keys: each alone suffices, two contradict each other."""
    given = [name for name in keys if name in table_at(document, table)]
    if len(given) == 1:
        return
    sets = ", ".join(keys[:-1]) + f" or {keys[-1]}"
    if not given:
        expected = f"{what}: one of {sets}"
        yield Problem(f"{table}.{keys[0]}", "nothing", expected, assigned(keys[0], example))
        return
    for name in given[1:]:
        value = table_at(document, table)[name]
        expected = (
            f"{what} once: {given[0]} is given, too, and with the teeth either says the other"
        )
        yield Problem(f"{table}.{name}", shown(value), expected, left_out(name, value))


def _spiral(document: Document) -> Iterator[Problem]:
    given = [m for m in ("pinion", "wheel") if "mean_spiral_angle" in table_at(document, m)]
    if len(given) == 1:
        return
    if not given:
        expected = "the spiral angle of the pinion or of the wheel at the mean point"
        yield Problem(
            "pinion.mean_spiral_angle", "nothing", expected, assigned("mean_spiral_angle", "50 deg")
        )
        return
    value = table_at(document, "wheel")["mean_spiral_angle"]
    expected = "one of both: the offset ties the wheel's to the pinion's"
    yield Problem(
        "wheel.mean_spiral_angle", shown(value), expected, left_out("mean_spiral_angle", value)
    )


def _tooth_data(document: Document) -> Iterator[Problem]:
    table = table_at(document, "blank")
    first = [name for name in TYPE_I if name in table]
    second = [name for name in TYPE_II if name in table]
    if first and second:
        expected = f"tooth data of one type: {', '.join(TYPE_I)}, or {', '.join(TYPE_II)}"
        for name in second:
            yield Problem(
                f"blank.{name}", shown(table[name]), expected, left_out(name, table[name])
            )
    for name in TYPE_I[:3] if first else ():
        if name not in table:
            expected = f"all of {', '.join(TYPE_I[:3])}, which make type I"
            example = {"addendum_coefficient": 1.0, "dedendum_coefficient": 1.25}.get(name, 0.3)
            yield Problem(f"blank.{name}", "nothing", expected, assigned(name, example))


def _target(document: Document, path: str) -> Iterator[Problem]:
    table = table_at(document, path)
    parts, motion = ([n for n in names if n in table] for names in (EASE_OFF, MOTION))
    if parts and motion:
        expected = (
            f"an ease-off by its parts ({', '.join(EASE_OFF)}) or a motion ({', '.join(MOTION)})"
        )
        for name in motion:
            yield Problem(
                f"{path}.{name}", shown(table[name]), expected, left_out(name, table[name])
            )


def _pinion_limits(document: Document) -> Iterator[Problem]:
    """Which settings may move: names that there are, and blades as they are placed."""
    pinion = table_at(document, "pinion")
    free = pinion.get("free")
    for name in free if isinstance(free, list) else ():
        if name not in FREE:
            expected = "names among " + ", ".join(FREE)
            yield Problem("pinion.free", shown(name), expected, 'free = ["blade_curvature"]')
    blades = BLADES_TOGETHER if pinion.get("method") in TOGETHER else BLADES_APART
    if value_at(document, ("cutting", "process")) == "face-hobbed":
        blades = BLADES_HOBBED
    keys, why = blades
    for table in ("fixed", "range"):
        for name in BLADE_KEYS:
            value = table_at(document, f"pinion.{table}").get(name)
            if value is not None and name not in keys:
                expected = f"{' and '.join(keys)}: {why}"
                yield Problem(
                    f"pinion.{table}.{name}", shown(value), expected, left_out(name, value)
                )
