"""From the checked summary sheet to what is asked of the program."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from hypoid.blank import GivenBlank, crown_point
from hypoid.design import (
    Assumption,
    BladeSpec,
    FlankSpec,
    MemberSpec,
    StickBladeSpec,
    SummarySheetSpec,
    TopremReading,
    cut_apart,
)

from ._bodies import bodies_of
from ._defaults import defaults_used
from ._quantity import parse
from ._sheet_cutter import BladeTable, TopremTable
from ._sheet_dials import ROLL_TERMS, plain_roll
from ._sheet_file import GivenBlankTable, SheetFlank, SheetMember, SummarySheetFile
from ._sheet_settings import DIALS

BACKLASH = 0.15  # mm, normal, at the mean point
# What the program puts in where the file says nothing of a blade, as the file would write it.
_BLADE_DEFAULTS = {"edge_radius": "0 mm"}
_STICK_DEFAULTS = {
    **_BLADE_DEFAULTS,
    "eccentric_angle": "0 deg",
    "hook_angle": "0 deg",
    "side_rake_angle": "0 deg",
}
_BACKLASH = Assumption(
    "pair.normal_backlash",
    f"not given, and flanks cut one by one leave it open; the program's default is {BACKLASH} mm",
)


def sheet_spec_of(file: SummarySheetFile) -> SummarySheetSpec:
    """The numbers of a summary sheet, with all that the file or the program assumed."""
    grinder = file.machine.gleason_463
    constants = {} if grinder is None else {"gleason-463": grinder.model_dump(exclude_none=True)}
    pinion, wheel = _member(file.pinion), _member(file.wheel)
    backlash = file.pair.normal_backlash
    free = backlash is None and (cut_apart(pinion) or cut_apart(wheel))
    return SummarySheetSpec(
        title=file.title,
        source=file.source,
        assumed=(
            *(Assumption(a.value, a.reason) for a in file.assumed),
            *_put_in("pinion", file.pinion),
            *_put_in("wheel", file.wheel),
            *defaults_used({"contact": file.contact}),
            *([_BACKLASH] if free else []),
        ),
        shaft_angle=file.pair.shaft_angle,
        offset=file.pair.offset,
        pinion=pinion,
        wheel=wheel,
        marking_thickness=file.contact.marking_thickness,
        normal_backlash=BACKLASH if free else backlash,
        machine_constants=constants,
        bodies=bodies_of(file),
    )


def _member(member: SheetMember) -> MemberSpec:
    return MemberSpec(
        teeth=member.teeth,
        hand=member.hand,
        blank=_blank(member.blank),
        concave=_flank(member, member.concave, outside=True),
        convex=_flank(member, member.convex, outside=False),
        blade_groups=member.cutter.blade_groups,
        spacing=member.cutter.spacing,
    )


def _blank(blank: GivenBlankTable) -> GivenBlank:
    distance, addendum = blank.outer_cone_distance, blank.outer_addendum
    if blank.outside_diameter is not None and blank.pitch_apex_to_crown is not None:
        distance, addendum = crown_point(
            blank.outside_diameter, blank.pitch_apex_to_crown, blank.pitch_angle
        )
    assert distance is not None
    assert addendum is not None
    return GivenBlank(
        pitch_angle=blank.pitch_angle,
        outer_cone_distance=distance,
        face_width=blank.face_width,
        mean_spiral_angle=blank.mean_spiral_angle,
        outer_addendum=addendum,
        face_angle=blank.face_angle,
        outer_dedendum=blank.outer_dedendum,
        root_angle=blank.root_angle,
        outer_face_width=blank.outer_face_width,
    )


def _settings(member: SheetMember, flank: SheetFlank) -> dict[str, Any]:
    """What holds for a flank; its own keys go before its member's."""
    return member.settings.model_dump(exclude_none=True) | flank.settings.model_dump(
        exclude_none=True
    )


def _flank(member: SheetMember, flank: SheetFlank, *, outside: bool) -> FlankSpec:
    own = _settings(member, flank)
    method, machine = own.pop("method"), own.pop("machine", "basic")
    dials: dict[str, Any] = {
        name: tuple(value) if isinstance(value, list) else value for name, value in own.items()
    }
    if machine == "basic":
        for name, value in DIALS["basic"].defaults.items():
            dials.setdefault(name, parse(value, "angle" if "deg" in value else "length"))
        dials.setdefault("ratio_of_roll", 0.0)  # of a form cut, whose cradle stands still
        terms = {name: dials.pop(name) for name in ROLL_TERMS if name in dials}
        if terms:
            dials["modified_roll"] = plain_roll(terms)
        if "motions" in dials:
            moved: dict[str, list[float]] = dials["motions"]
            dials["motions"] = {name: tuple(powers) for name, powers in moved.items()}
    at_flank = frozenset(
        f"{table}.{name}"
        for table, keys in (("settings", flank.settings), ("blade", flank.blade))
        for name in keys.model_fields_set
    )
    return FlankSpec(method, machine, dials, _blade(member, flank, outside), at_flank)


def _blade(member: SheetMember, flank: SheetFlank, outside: bool) -> BladeSpec | StickBladeSpec:
    own = _blade_keys(member.blade) | _blade_keys(flank.blade)
    toprem: TopremTable | None = own.get("toprem")
    common: dict[str, Any] = {
        "angle": own["angle"],
        "edge_radius": own.get("edge_radius", 0.0),
        "height": member.cutter.height,
        "curve_radius": own.get("radius", 0.0),
        "reference_height": own.get("reference_height", 0.0),
    }
    if member.cutter.blade_groups is not None:
        return StickBladeSpec(
            radius=own["blade_radius"],
            eccentric_angle=own.get("eccentric_angle", 0.0),
            hook_angle=own.get("hook_angle", 0.0),
            side_rake_angle=own.get("side_rake_angle", 0.0),
            toprem=toprem and _stick_toprem(toprem),
            **common,
        )
    cutter, land = member.cutter, None
    if cutter.diameter is not None and cutter.point_width is not None:
        land = 0.5 * cutter.point_width
        radius = 0.5 * cutter.diameter + (land if outside else -land)
    else:
        radius = 0.5 * own["point_diameter"]
    flankrem = own.get("flankrem")
    return BladeSpec(
        point_radius=radius,
        land=land,
        curve=own.get("profile", "straight"),
        curve_coefficient=own.get("coefficient", 0.0),
        toprem=toprem and (toprem.angle, toprem.height or 0.0),
        flankrem=flankrem and (flankrem.height, flankrem.angle or 0.0, flankrem.coefficient or 0.0),
        **common,
    )


def _stick_toprem(toprem: TopremTable) -> tuple[float, float, TopremReading]:
    if toprem.length is None:
        return toprem.angle, toprem.height or 0.0, "axial"
    return toprem.angle, toprem.length, toprem.measured or "along-flank"


def _blade_keys(blade: BladeTable) -> dict[str, Any]:
    return {name: value for name, value in blade if value is not None}


def _put_in(name: str, member: SheetMember) -> Iterator[Assumption]:
    """Values that the program put in at a member, told once where both flanks lack them."""
    lacking: dict[tuple[str, str, str], list[str]] = {}
    for side, flank in (("concave", member.concave), ("convex", member.convex)):
        given = _settings(member, flank)
        defaults = dict(DIALS[given.get("machine", "basic")].defaults)
        if "helical_gears" in given:
            defaults["helical_direction"] = "1"
        for key, value in defaults.items():
            if key not in given:
                lacking.setdefault(("settings", key, value), []).append(side)
        blade, stick = (
            _blade_keys(member.blade) | _blade_keys(flank.blade),
            member.cutter.type == "tri-ac",
        )
        for key, value in (_STICK_DEFAULTS if stick else _BLADE_DEFAULTS).items():
            if key not in blade:
                lacking.setdefault(("blade", key, value), []).append(side)
    if member.cutter.blade_groups is not None and member.cutter.spacing is None:
        even = f"{180 / member.cutter.blade_groups:.6g} deg"
        yield Assumption(f"{name}.cutter.spacing", f"not given; blades spaced evenly, {even}")
    for (table, key, value), sides in lacking.items():
        for where in [name] if len(sides) == 2 else [f"{name}.{side}" for side in sides]:
            reason = f"not given; the program's default is {value}"
            yield Assumption(f"{where}.{table}.{key}", reason)
