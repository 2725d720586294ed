"""What ties keys together in a summary sheet, as far as each of them can be read by itself."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import degrees, radians

from hypoid.blank import crown_point
from hypoid.geometry import Problem

from ._document import (
    MEMBERS,
    Document,
    assigned,
    left_out,
    line,
    number_at,
    shown,
    table_at,
    value_at,
)
from ._keys import MOST_TEETH, keys_of
from ._merged import SIDES, merged
from ._sheet_cutter import BladeTable, CutterTable
from ._sheet_cutter_rules import blade_rules, cutter_rules, face_hobbed, hobbing_rules
from ._sheet_file import GivenBlankTable, Grinder463Table
from ._sheet_settings import DUPLEX, settings_of, settings_rules

_TAPER = radians(30.0)  # between pitch cone and face or root cone; more is a slip
_CROWN = ("outside_diameter", "pitch_apex_to_crown")
_STEEP = 0.5  # addendum or dedendum per cone distance at the heel; more is a slip


def sheet_rules(document: Document) -> Iterator[Problem]:
    """Every fault between keys; what both flanks of a member share comes twice."""
    few, many = (value_at(document, (member, "teeth")) for member in MEMBERS)
    if isinstance(few, int) and isinstance(many, int) and 1 <= many < few <= MOST_TEETH:
        expected = f"at least as many teeth as the pinion, which has {few}"
        yield Problem("wheel.teeth", str(many), expected, assigned("teeth", few))
    hands = [value_at(document, (member, "hand")) for member in MEMBERS]
    if hands[0] == hands[1] and hands[0] in ("left", "right"):
        other = "right" if hands[0] == "left" else "left"
        expected = f'"{other}": the hand opposite to the pinion\'s'
        yield Problem("wheel.hand", shown(hands[1]), expected, f'hand = "{other}"')
    for member in MEMBERS:
        yield from _blank(document, member)
        yield from cutter_rules(document, member)
        flanks = [settings_of(document, member, side) for side in SIDES]
        for own in flanks:
            yield from settings_rules(document, own)
            yield from hobbing_rules(document, own)
            yield from blade_rules(
                document, merged(document, member, own.side, "blade", BladeTable)
            )
        duplex = [method for own in flanks if (method := own.word("method")) in DUPLEX]
        if duplex and not face_hobbed(document, member):
            yield from _both_at_once(document, member, duplex[0])
    for number in table_at(document, "machine.gleason-463.cams"):
        if not re.fullmatch("[1-9][0-9]{0,2}", number):
            yield Problem(
                f"machine.gleason-463.cams.{number}",
                "a name",
                str(keys_of(Grinder463Table)["cams"].description),
                line(Grinder463Table, "cams"),
            )


def _both_at_once(document: Document, member: str, method: str) -> Iterator[Problem]:
    """One cutter cuts both flanks with one setting."""
    for side in SIDES:
        for key, given in table_at(document, f"{member}.{side}.settings").items():
            expected = (
                f'settings at [{member}.settings]: method = "{method}" cuts both flanks at once'
            )
            path = f"{member}.{side}.settings.{key}"
            yield Problem(path, shown(given), expected, left_out(key, given))
    cutter = table_at(document, f"{member}.cutter")
    for key in ("diameter", "point_width"):
        if key not in cutter:
            what = f'a spread-blade cutter for method = "{method}": diameter and point_width'
            yield Problem(f"{member}.cutter.{key}", "nothing", what, line(CutterTable, key))


def _blank(document: Document, member: str) -> Iterator[Problem]:
    path = f"{member}.blank"
    table = table_at(document, path)
    yield from _together(member, table)
    pitch = number_at(document, f"{path}.pitch_angle", "angle")
    if pitch is None:
        return
    for key in ("face_angle", "root_angle"):
        angle = number_at(document, f"{path}.{key}", "angle")
        if angle is not None and abs(angle - pitch) > _TAPER:
            expected = f"an angle within 30 deg of the pitch angle of {degrees(pitch):.5g} deg"
            example = assigned(key, f"{degrees(pitch):.4g} deg")
            yield Problem(f"{path}.{key}", shown(table[key]), expected, example)
    yield from _heel(document, member, pitch)


def _together(member: str, table: Document) -> Iterator[Problem]:
    """Keys of a blank that come in pairs."""

    def missing(pair: tuple[str, str], expected: str) -> Iterator[Problem]:
        for key in pair:
            if key not in table:
                path = f"{member}.blank.{key}"
                yield Problem(path, "nothing", expected, line(GivenBlankTable, key))

    def given(pair: tuple[str, str]) -> int:
        return sum(key in table for key in pair)

    cone, crown = ("outer_cone_distance", "outer_addendum"), _CROWN
    either = f"either {' and '.join(cone)}, or {' and '.join(crown)}"
    if given(cone) and given(crown):
        key = next(key for key in crown if key in table)
        yield Problem(
            f"{member}.blank.{key}", "both", f"{either}: not both", left_out(key, table[key])
        )
    else:
        yield from missing(crown if given(crown) else cone, either)
    root = ("outer_dedendum", "root_angle")
    if given(root) == 1:
        expected = f"{' and '.join(root)}, or neither: the root is then where the cutter leaves it"
        yield from missing(root, expected)


def _heel(document: Document, member: str, pitch: float) -> Iterator[Problem]:
    """A heel that can be: the crown above the pitch cone but not far, the face shorter than the cone."""
    path = f"{member}.blank"

    def length(key: str) -> float | None:
        return number_at(document, f"{path}.{key}", "length")

    def fault(key: str, expected: str, example: str) -> Problem:
        given = shown(value_at(document, (member, "blank", key)))
        return Problem(f"{path}.{key}", given, expected, example)

    distance, heights = length("outer_cone_distance"), ["outer_addendum", "outer_dedendum"]
    diameter, crown = (length(key) for key in _CROWN)
    if diameter is not None and crown is not None:
        distance, addendum = crown_point(diameter, crown, pitch)
        if not 0.0 <= addendum < _STEEP * distance:
            expected = (
                f"a crown above the pitch cone of {degrees(pitch):.5g} deg: with an outside "
                f"diameter of {diameter:g} mm it lies {addendum:.4g} mm above"
            )
            yield fault(_CROWN[1], expected, line(GivenBlankTable, _CROWN[1]))
            return
    if distance is None or distance <= 0.0:
        return
    for key in heights:
        height = length(key)
        if height is not None and height >= _STEEP * distance:
            expected = f"less than half the outer cone distance of {distance:.5g} mm"
            yield fault(key, expected, assigned(key, f"{0.05 * distance:.3g} mm"))
    width = length("face_width")
    if width is not None and width >= distance:
        expected = f"a face narrower than the outer cone distance of {distance:.5g} mm"
        yield fault("face_width", expected, assigned("face_width", f"{0.3 * distance:.3g} mm"))
