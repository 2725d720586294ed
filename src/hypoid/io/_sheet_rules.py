"""What ties keys together in a summary sheet, as far as each of them can be read by itself."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, radians

from hypoid.blank import crown_point
from hypoid.geometry import Problem

from ._document import Document, line, number_at, shown, table_at, value_at
from ._keys import keys_of
from ._merged import MEMBERS, SIDES, Merged, merged
from ._sheet_file import (
    BladeTable,
    CutterTable,
    GivenBlankTable,
    Grinder463Table,
    MachineTable,
    SheetSettings,
)
from ._sheet_settings import DUPLEX, settings_rules

_TAPER = radians(30.0)  # between pitch cone and face or root cone; more is a slip
_MIXED = (
    "either outer_cone_distance and outer_addendum, or outside_diameter and pitch_apex_to_crown"
)


def sheet_rules(document: Document) -> Iterator[Problem]:
    """Every fault between keys, each path once."""
    told: set[str] = set()
    for problem in _all(document):
        if problem.path not in told:
            told.add(problem.path)
            yield problem


def _all(document: Document) -> Iterator[Problem]:
    few, many = (value_at(document, (member, "teeth")) for member in MEMBERS)
    if isinstance(few, int) and isinstance(many, int) and 1 <= many < few:
        expected = f"at least as many teeth as the pinion, which has {few}"
        yield Problem("wheel.teeth", str(many), expected, f"teeth = {few}")
    hands = [value_at(document, (member, "hand")) for member in MEMBERS]
    if hands[0] == hands[1] and hands[0] in ("left", "right"):
        other = "right" if hands[0] == "left" else "left"
        expected = f'"{other}": the hand opposite to the pinion\'s'
        yield Problem("wheel.hand", shown(hands[1]), expected, f'hand = "{other}"')
    machines: set[object] = set()
    for member in MEMBERS:
        yield from _blank(document, member)
        yield from _cutter(document, member)
        methods: list[object] = []
        for side in SIDES:
            own = merged(document, member, side, "settings")
            methods.append(own.get("method"))
            machines.add(own.get("machine"))
            yield from settings_rules(document, own)
            yield from _blade(document, merged(document, member, side, "blade"))
        duplex = next((method for method in methods if method in DUPLEX), None)
        if duplex:
            yield from _both_at_once(document, member, str(duplex))
    cams = table_at(document, "machine.gleason-463.cams")
    for number in cams:
        if not (number.isascii() and number.isdecimal() and str(int(number)) == number):
            expected = str(keys_of(Grinder463Table)["cams"].description)
            example = line(Grinder463Table, "cams")
            yield Problem(f"machine.gleason-463.cams.{number}", "a name", expected, example)
    if "gleason-463" in machines and not table_at(document, "machine.gleason-463"):
        expected = (
            "swivel_offset and the cams of this very machine: they differ from one to the next"
        )
        example = line(MachineTable, "gleason-463").removeprefix("gleason-463 = ")
        yield Problem("machine.gleason-463", "nothing", expected, f"gleason-463 = {example}")


def _both_at_once(document: Document, member: str, method: str) -> Iterator[Problem]:
    """One cutter cuts both flanks with one setting."""
    for side in SIDES:
        for key, given in table_at(document, f"{member}.{side}.settings").items():
            expected = (
                f'settings at [{member}.settings]: method = "{method}" cuts both flanks at once'
            )
            example = line(SheetSettings, key) if key in keys_of(SheetSettings) else ""
            yield Problem(f"{member}.{side}.settings.{key}", shown(given), expected, example)
    cutter = table_at(document, f"{member}.cutter")
    for key in ("diameter", "point_width"):
        if cutter and key not in cutter:
            what = f'a spread-blade cutter for method = "{method}": diameter and point_width'
            yield Problem(f"{member}.cutter.{key}", "nothing", what, line(CutterTable, key))


def _blank(document: Document, member: str) -> Iterator[Problem]:
    path = f"{member}.blank"
    table = table_at(document, path)
    if not table:
        return
    by_cone = [key for key in ("outer_cone_distance", "outer_addendum") if key in table]
    by_crown = [key for key in ("outside_diameter", "pitch_apex_to_crown") if key in table]
    if (len(by_cone), len(by_crown)) not in ((2, 0), (0, 2)):
        given = ", ".join(by_cone + by_crown) or "nothing"
        example = line(GivenBlankTable, "outer_cone_distance")
        yield Problem(f"{path}.outer_cone_distance", given, _MIXED, example)
    depth = [key for key in ("outer_dedendum", "root_angle") if key in table]
    if len(depth) == 1:
        other = "root_angle" if depth[0] == "outer_dedendum" else "outer_dedendum"
        expected = (
            "outer_dedendum and root_angle, or neither: the root is then where the cutter leaves it"
        )
        yield Problem(f"{path}.{other}", "nothing", expected, line(GivenBlankTable, other))
    pitch = number_at(document, f"{path}.pitch_angle", "angle")
    if pitch is None:
        return
    for key in ("face_angle", "root_angle"):
        angle = number_at(document, f"{path}.{key}", "angle")
        if angle is not None and abs(angle - pitch) > _TAPER:
            expected = f"an angle within 30 deg of the pitch angle of {degrees(pitch):.5g} deg"
            example = f'{key} = "{degrees(pitch):.4g} deg"'
            yield Problem(f"{path}.{key}", shown(table[key]), expected, example)
    yield from _heel(document, member, pitch)


def _heel(document: Document, member: str, pitch: float) -> Iterator[Problem]:
    """A heel that can be: the crown on or above the pitch cone, the face shorter than the cone."""
    path = f"{member}.blank"
    distance = number_at(document, f"{path}.outer_cone_distance", "length")
    diameter = number_at(document, f"{path}.outside_diameter", "length")
    crown = number_at(document, f"{path}.pitch_apex_to_crown", "length")
    if diameter is not None and crown is not None:
        distance, addendum = crown_point(diameter, crown, pitch)
        if not 0.0 <= addendum < 0.5 * abs(distance):
            expected = (
                f"a crown above the pitch cone of {degrees(pitch):.5g} deg: with an outside "
                f"diameter of {diameter:g} mm it lies {addendum:.4g} mm above"
            )
            given = shown(value_at(document, (member, "blank", "pitch_apex_to_crown")))
            example = line(GivenBlankTable, "pitch_apex_to_crown")
            yield Problem(f"{path}.pitch_apex_to_crown", given, expected, example)
            return
    width = number_at(document, f"{path}.face_width", "length")
    if distance is not None and width is not None and 0.0 < distance <= width:
        given = shown(value_at(document, (member, "blank", "face_width")))
        expected = f"a face narrower than the outer cone distance of {distance:.5g} mm"
        example = f'face_width = "{0.3 * distance:.3g} mm"'
        yield Problem(f"{path}.face_width", given, expected, example)


def _cutter(document: Document, member: str) -> Iterator[Problem]:
    path = f"{member}.cutter"
    cutter = table_at(document, path)
    given = [key for key in ("diameter", "point_width") if key in cutter]
    if len(given) == 1:
        other = "point_width" if given == ["diameter"] else "diameter"
        expected = "diameter and point_width of a spread-blade cutter, or neither"
        yield Problem(f"{path}.{other}", "nothing", expected, line(CutterTable, other))
    diameter = number_at(document, f"{path}.diameter", "length")
    width = number_at(document, f"{path}.point_width", "length")
    if diameter is not None and width is not None and 0.0 < diameter <= width:
        expected = f"less than the cutter's diameter of {diameter:g} mm"
        yield Problem(
            f"{path}.point_width", shown(cutter["point_width"]), expected, 'point_width = "0.1 in"'
        )


def _blade(document: Document, own: Merged) -> Iterator[Problem]:
    cutter = table_at(document, f"{own.member}.cutter")

    def fault(key: str, expected: str) -> Problem:
        return Problem(own.path(key), shown(own.get(key)), expected, line(BladeTable, key))

    if "angle" not in own:
        yield fault("angle", "the blade angle against the cutter's axis")
    spread = "diameter" in cutter or "point_width" in cutter
    if spread and "point_diameter" in own:
        expected = "nothing: the cutter's diameter and point_width say where both blades stand"
        yield fault("point_diameter", expected)
    if not spread and "point_diameter" not in own:
        expected = "a length above 0, or diameter and point_width in " + f"[{own.member}.cutter]"
        yield Problem(
            f"{own.member}.{own.side}.blade.point_diameter", "nothing", expected,
            line(BladeTable, "point_diameter"),
        )  # fmt: skip
    profile = own.get("profile")
    profile = "straight" if profile is None else profile
    wanted = {"circular-arc": "radius", "parabola": "coefficient"}.get(str(profile), "")
    for key in ("radius", "coefficient", "reference_height"):
        needed = key == wanted or (key == "reference_height" and bool(wanted))
        if needed and key not in own:
            expected = str(keys_of(BladeTable)[key].description)
            yield fault(key, f'{expected}; profile = "{profile}" needs it')
        if not needed and key in own:
            yield fault(key, f'nothing: profile = "{profile}" has no {key}')
    if wanted == "radius" and own.number("radius", "length") == 0.0:
        yield fault("radius", str(keys_of(BladeTable)["radius"].description))
    flankrem = own.get("flankrem")
    if isinstance(flankrem, dict) and ("angle" in flankrem) == ("coefficient" in flankrem):
        expected = "an angle (straight) or a coefficient (parabola), one of them"
        yield fault("flankrem", expected)
