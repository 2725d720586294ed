"""A face-hobbed pair that is asked for by its blank: what its file may say, and what that means."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, sin

from hypoid.design import CURVED, NO_HOBBER, Assumption, ExactFaceHobbedSpec, StickGrind
from hypoid.geometry import Problem

from ._document import Document, assigned, left_out, number_at, shown, table_at, value_at
from ._request_file import RequestFile

EDGE_FACTOR = 0.3  # of the exact system's blades, where the file gives none
_USUAL = StickGrind()
_HEAD = ("hook_angle", "side_rake_angle", "eccentric_angle", "equal_spacing")
_HOBBING = ("cutter", "blade_groups", *_HEAD, "tip_edge_radius_factor")
_STICKS = (("pinion", "curve_radius"), ("pinion", "toprem"), ("wheel", "curve_radius"))
_NOT_EXACT = (
    *(f"cutting.{key}" for key in (*_HEAD, "coast_pressure_angle", "limit_share")),
    *("pair.normal_backlash", "pinion.method", "wheel.method"),
    *("pinion.edge_radius", "wheel.edge_radius", "blank.thickness_factor"),
    *("blank.addendum_coefficient", "blank.dedendum_coefficient", "blank.profile_shift"),
    *("blank.thickness_modification", "blank.wheel_addendum_angle", "blank.wheel_dedendum_angle"),
    *("pinion.free", "pinion.fixed", "pinion.range"),
    *("contact.tolerance", "contact.drive", "contact.coast"),
)
_METHODS = ("tilt", "modified-roll", "generated", "helical", "universal")


def hobbing_rules(document: Document) -> Iterator[Problem]:
    """What ties the process, its cutter and their keys together."""
    cutting = table_at(document, "cutting")
    process = cutting.get("process")
    if process == "face-milled":
        for key in _HOBBING:
            if key in cutting:
                expected = f'nothing: face mills have no {key}; or process = "face-hobbed"'
                yield _unwanted(f"cutting.{key}", cutting[key], expected)
        yield from _no_sticks(document, "face-mill blades")
    if process != "face-hobbed":
        return
    if "blade_groups" not in cutting:
        expected = "a whole number from 1 to 100: the groups of the face-hob head"
        yield Problem("cutting.blade_groups", "nothing", expected, assigned("blade_groups", 13))
    method = value_at(document, ("pinion", "method"))
    if isinstance(method, str) and method not in _METHODS:
        expected = (
            f"one of {', '.join(_METHODS)}: a face-hob head cuts both flanks in one setting-up"
        )
        yield Problem("pinion.method", shown(method), expected, assigned("method", "tilt"))
    pinion = table_at(document, "pinion")
    if "machine" in pinion:
        yield _unwanted("pinion.machine", pinion["machine"], f"nothing: {NO_HOBBER}")
    free = pinion.get("free")
    if "curve_radius" in pinion and isinstance(free, list) and "blade_curvature" in free:
        yield _unwanted("pinion.free", free, f"no blade_curvature: {CURVED}")
    yield from _slope(document)
    for member in ("pinion", "wheel"):
        if number_at(document, f"{member}.curve_radius", "length") == 0.0:
            expected = "a length other than 0; a straight edge is no key at all"
            yield _unwanted(f"{member}.curve_radius", "0 mm", expected)
    if cutting.get("cutter", "tri-ac") == "exact":
        yield from _exact(document)
    elif "tip_edge_radius_factor" in cutting:
        expected = "nothing: on stick blades pinion.edge_radius and wheel.edge_radius say it"
        value = cutting["tip_edge_radius_factor"]
        yield _unwanted("cutting.tip_edge_radius_factor", value, expected)


def _slope(document: Document) -> Iterator[Problem]:
    """Blades cannot run along the teeth where the groups' module passes the cutter's diameter."""
    groups = value_at(document, ("cutting", "blade_groups"))
    radius = number_at(document, "cutting.cutter_radius", "length")
    if not (isinstance(groups, int) and groups > 0 and radius and radius > 0.0):
        return
    teeth = value_at(document, ("wheel", "teeth"))
    size = number_at(document, "wheel.mean_pitch_diameter", "length")
    if size is None:
        size = number_at(document, "wheel.outer_pitch_diameter", "length")
    if size is None or not isinstance(teeth, int) or teeth < 1:
        return
    most = 2.0 * radius * sin(1.2) * teeth / size  # cos(spiral) taken as one: a loose limit
    if 0.5 * groups > most:
        expected = (
            f"at most {int(2.0 * most)}: blades of this module pass {radius:g} mm no more often"
        )
        example = assigned("blade_groups", max(int(most), 1))
        yield Problem("cutting.blade_groups", str(groups), expected, example)


def _exact(document: Document) -> Iterator[Problem]:
    """What the exact system asks for, and what it leaves no room for."""
    for path in _NOT_EXACT:
        table, key = path.split(".")
        given = table_at(document, table)
        if key in given:
            expected = f'nothing: the exact system has no {key}; or cutter = "tri-ac"'
            yield _unwanted(path, given[key], expected)
    yield from _no_sticks(document, "blades of the exact system")
    why = "the exact system starts from it, as its paper does"
    for path, example in (
        ("pinion.mean_spiral_angle", "65 deg"), ("wheel.mean_pitch_diameter", "260 mm"),
    ):  # fmt: skip
        table, key = path.split(".")
        if key not in table_at(document, table):
            yield Problem(path, "nothing", f"given: {why}", assigned(key, example))
    for path, must in (("blank.method", 2), ("blank.taper", "uniform")):
        given = value_at(document, tuple(path.split(".")))
        if given is not None and given != must:
            expected = f"{shown(must)}: one crown gear cuts both members of the exact system"
            yield Problem(path, shown(given), expected, assigned(path.split(".")[1], must))


def _no_sticks(document: Document, of: str) -> Iterator[Problem]:
    for table, key in _STICKS:
        given = table_at(document, table)
        if key in given:
            yield _unwanted(f"{table}.{key}", given[key], f"nothing: {of} have no {key} here")


def _unwanted(path: str, value: object, expected: str) -> Problem:
    return Problem(path, shown(value), expected, left_out(path.split(".")[-1], value))


def grind_of(file: RequestFile) -> StickGrind:
    """How the stick blades of a file stand and are ground."""
    cutting, toprem = file.cutting, file.pinion.toprem
    hook, rake = cutting.hook_angle, cutting.side_rake_angle
    return StickGrind(
        hook_angle=_USUAL.hook_angle if hook is None else hook,
        side_rake_angle=_USUAL.side_rake_angle if rake is None else rake,
        eccentric_angle=cutting.eccentric_angle,
        wheel_curve_radius=file.wheel.curve_radius or 0.0,
        pinion_curve_radius=file.pinion.curve_radius,
        pinion_toprem=None if toprem is None else (toprem.angle, toprem.length),
    )


def hobbing_assumed(file: RequestFile) -> Iterator[Assumption]:
    """What the program puts in of a head that the file does not describe."""
    cutting = file.cutting
    if cutting.process != "face-hobbed":
        return
    if cutting.cutter == "exact":
        if cutting.tip_edge_radius_factor is None:
            reason = f"not given; the program's default is {EDGE_FACTOR:g}"
            yield Assumption("cutting.tip_edge_radius_factor", reason)
        return
    if cutting.cutter is None:
        yield Assumption("cutting.cutter", "not given; the program's default is tri-ac")
    for key in ("hook_angle", "side_rake_angle"):
        if getattr(cutting, key) is None:
            usual = f"{degrees(getattr(_USUAL, key)):.4g} deg"
            yield Assumption(f"cutting.{key}", f"not given; the program's default is {usual}")
    if cutting.eccentric_angle is None:
        yield Assumption("cutting.eccentric_angle", "not given; the slope angle of the blank")
    if cutting.equal_spacing is None:
        yield Assumption(
            "cutting.equal_spacing", "not given; inner blades midway between outer ones"
        )


def exact_of(file: RequestFile, assumed: tuple[Assumption, ...]) -> ExactFaceHobbedSpec:
    """The exact system's pair of a file."""
    blank, cutting, pinion, wheel = file.blank, file.cutting, file.pinion, file.wheel
    factor = cutting.tip_edge_radius_factor
    return ExactFaceHobbedSpec(
        title=file.title,
        source=file.source,
        assumed=tuple(a for a in assumed if a.value not in (*_NOT_EXACT, "blank.taper")),
        shaft_angle=file.pair.shaft_angle,
        offset=file.pair.offset,
        pinion_teeth=pinion.teeth,
        wheel_teeth=wheel.teeth,
        pinion_hand=pinion.hand,
        pinion_spiral_angle=pinion.mean_spiral_angle or 0.0,
        wheel_mean_radius=0.5 * (wheel.mean_pitch_diameter or 0.0),
        wheel_face_width=wheel.face_width,
        mean_addendum_factor=0.5
        if blank.mean_addendum_factor is None
        else blank.mean_addendum_factor,
        depth_factor=blank.depth_factor or 2.0,
        clearance_factor=0.125 if blank.clearance_factor is None else blank.clearance_factor,
        cutter_radius=cutting.cutter_radius,
        blade_groups=cutting.blade_groups or 1,
        pressure_angle=cutting.pressure_angle,
        tip_edge_radius_factor=EDGE_FACTOR if factor is None else factor,
        tip_relief=None,
        marking_thickness=file.contact.marking_thickness,
    )
