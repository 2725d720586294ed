"""What ties the keys of a cutter and its blades together: each kind of cutter has its own measures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from hypoid.geometry import Problem

from ._document import Document, left_out, line, number_at, shown, table_at
from ._keys import keys_of
from ._merged import Merged
from ._sheet_cutter import BladeTable, CutterTable

_PROFILES: dict[str, tuple[str, ...]] = {
    "straight": (),
    "circular-arc": ("radius", "reference_height"),
    "parabola": ("coefficient", "reference_height"),
}
# Keys that only one kind of cutter has, at its own table and at its blades.
_OF_MILL = ("diameter", "point_width"), ("point_diameter", "flankrem", "coefficient")
_OF_HOB = (
    ("blade_groups", "spacing"),
    ("blade_radius", "eccentric_angle", "hook_angle", "side_rake_angle"),
)
_HOBBED = ("generated", "formate", "modified-roll", "tilt")


def face_hobbed(document: Document, member: str) -> bool:
    """Whether a face-hob head cuts a member, the work turning on with the cutter."""
    return table_at(document, f"{member}.cutter").get("type") == "tri-ac"


def cutter_rules(document: Document, member: str) -> Iterator[Problem]:
    """Everything that is wrong between the keys of a member's cutter."""
    path, cutter = f"{member}.cutter", table_at(document, f"{member}.cutter")
    hob = face_hobbed(document, member)
    for key in (_OF_MILL if hob else _OF_HOB)[0]:
        if key in cutter:
            expected = (
                f'nothing: a cutter of type = "{cutter.get("type", "face-mill")}" has no {key}'
            )
            yield Problem(f"{path}.{key}", shown(cutter[key]), expected, left_out(key, cutter[key]))
    if hob:
        if "blade_groups" not in cutter:
            expected = f"{keys_of(CutterTable)['blade_groups'].description}"
            yield Problem(
                f"{path}.blade_groups", "nothing", expected, line(CutterTable, "blade_groups")
            )
        return
    given = [key for key in _OF_MILL[0] if key in cutter]
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


def hobbing_rules(document: Document, own: Merged) -> Iterator[Problem]:
    """What a face-hob head asks of the settings of a flank."""
    if not face_hobbed(document, own.member):
        return
    for key, can in (("method", _HOBBED), ("machine", ("basic",))):
        if key in own and own.word(key) not in can:
            expected = f'one of {", ".join(can)}: what a cutter of type = "tri-ac" is used with'
            yield Problem(own.path(key), shown(own.get(key)), expected, f'{key} = "{can[0]}"')


def blade_rules(document: Document, own: Merged) -> Iterator[Problem]:
    """Everything that is wrong between the keys of a flank's blade, its own and its member's."""
    hob = face_hobbed(document, own.member)
    if "angle" not in own:
        yield own.wanted("angle", "the blade angle against the cutter's axis")
    for key in (_OF_MILL if hob else _OF_HOB)[1]:
        if key in own:
            yield own.unwanted(key, f"{'stick' if hob else 'face-mill'} blades have no {key}")
    yield from _profile(own, hob)
    yield from _toprem(own, hob)
    yield from _stick(own) if hob else _mill(document, own)


def _stick(own: Merged) -> Iterator[Problem]:
    for key in ("blade_radius", "reference_height"):
        if key not in own:
            expected = f"{keys_of(BladeTable)[key].description}; stick blades need it"
            yield own.wanted(key, expected)


def _mill(document: Document, own: Merged) -> Iterator[Problem]:
    cutter = table_at(document, f"{own.member}.cutter")
    spread = any(key in cutter for key in _OF_MILL[0])
    if spread and "point_diameter" in own:
        why = "the cutter's diameter and point_width say where both blades stand"
        yield own.unwanted("point_diameter", why)
    if cutter and not spread and "point_diameter" not in own:
        path = f"{own.member}.{own.side}.blade.point_diameter"
        expected = f"a length above 0, or diameter and point_width in [{own.member}.cutter]"
        yield Problem(path, "nothing", expected, line(BladeTable, "point_diameter"))
    flankrem = own.get("flankrem")
    if isinstance(flankrem, Mapping) and ("angle" in flankrem) == ("coefficient" in flankrem):
        yield own.wanted("flankrem", "an angle (straight) or a coefficient (parabola), one of them")


def _toprem(own: Merged, hob: bool) -> Iterator[Problem]:
    """Its height, or on a stick blade its length and how that was measured."""
    toprem = own.get("toprem")
    if not isinstance(toprem, Mapping):
        return
    if not hob and ("height" not in toprem or "length" in toprem or "measured" in toprem):
        yield own.wanted("toprem", "angle and height of the kink, all that a face-mill blade has")
    elif hob and ("height" in toprem) == ("length" in toprem):
        yield own.wanted("toprem", "its angle, and its length or the height of its kink")
    elif "measured" in toprem and "length" not in toprem:
        yield own.wanted("toprem", "a length, where it says how that was measured")


def _profile(own: Merged, hob: bool) -> Iterator[Problem]:
    """The measures that a blade's profile has, and no others."""
    profile = own.word("profile") or "straight"
    if profile not in _PROFILES:
        return  # named already
    if hob and profile == "parabola":
        yield own.wanted("profile", '"straight" or "circular-arc": stick blades have no parabola')
        return
    for key in ("radius", "coefficient", "reference_height"):
        if key in _PROFILES[profile] and key not in own:
            expected = f'{keys_of(BladeTable)[key].description}; profile = "{profile}" needs it'
            yield own.wanted(key, expected)
        if key in own and key not in _PROFILES[profile] and not (hob and key != "radius"):
            yield own.unwanted(key, f'profile = "{profile}" has no {key}')
    if profile == "circular-arc" and own.number("radius", "length") == 0.0:
        yield own.wanted("radius")
