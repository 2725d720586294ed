"""A complete design file of a pair that was designed: every value with where it came from.

Numbers are written with all their digits, so that the file reads back to the same flanks.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import degrees
from typing import Any

from hypoid.blank import GivenBlank
from hypoid.design import BladeSpec, FlankSpec, MemberSpec, SummarySheetSpec, cut_apart

from ._document import toml

COMMENT = 57  # column where comments begin
_ANGLES = {
    "cradle_angle", "tilt_angle", "swivel_angle", "machine_root_angle", "pitch_angle",
    "mean_spiral_angle", "face_angle", "root_angle",
}  # fmt: skip
_BLANK = (
    "pitch_angle", "mean_spiral_angle", "outer_cone_distance", "face_width", "outer_face_width",
    "outer_addendum", "face_angle", "outer_dedendum", "root_angle",
)  # fmt: skip
_SETTINGS = (
    "radial_distance", "cradle_angle", "tilt_angle", "swivel_angle", "blank_offset",
    "machine_root_angle", "machine_center_to_back", "sliding_base", "ratio_of_roll",
    "helical_motion", "modified_roll", "motions",
)  # fmt: skip
_ANGLE_MOTIONS = ("tilt_angle", "swivel_angle", "machine_root_angle")


@dataclass(frozen=True)
class Origins:
    """Where values came from, in words, as comments of the file show them."""

    blank: str
    wheel_settings: str
    wheel_cutter: str
    pinion_settings: Mapping[str, str]  # by side
    pinion_blade: str
    edge_radius: str


def sheet_text(spec: SummarySheetSpec, origins: Origins, remarks: tuple[str, ...] = ()) -> str:
    """The file of a face-milled pair: spread-blade wheel, pinion side by side, on basic settings."""
    lines = [*(f"# {line}" for line in remarks), "schema = 1"]
    lines += [f"title = {toml(spec.title)}", f"source = {toml(spec.source)}", ""]
    lines += ["[pair]", _line("shaft_angle", _angle(spec.shaft_angle))]
    lines += [_line("offset", _length(spec.offset))]
    if spec.normal_backlash is not None:
        why = "the pinion's flanks are divided for it"
        lines += [_line("normal_backlash", _length(spec.normal_backlash), why)]
    lines += ["", *_wheel(spec.wheel, origins), "", *_pinion(spec.pinion, origins)]
    lines += ["", "[contact]", _line("marking_thickness", _length(spec.marking_thickness)), ""]
    return "\n".join(lines)


def _member(name: str, member: MemberSpec, origins: Origins) -> Iterator[str]:
    yield f"[{name}]"
    yield _line("teeth", member.teeth)
    yield _line("hand", member.hand)
    yield ""
    yield f"[{name}.blank]  # {origins.blank}"
    yield from _blank(member.blank)
    yield ""


def _mill(flank: FlankSpec) -> BladeSpec:
    """A designed flank's blade: the program designs face-milled pairs alone."""
    assert isinstance(flank.blade, BladeSpec)
    return flank.blade


def _wheel(member: MemberSpec, origins: Origins) -> Iterator[str]:
    yield from _member("wheel", member, origins)
    outside, inside = _mill(member.concave), _mill(member.convex)
    yield "[wheel.cutter]"
    yield _line("type", "face-mill")
    diameter = outside.point_radius + inside.point_radius
    yield _line("diameter", _length(diameter), "as asked")
    yield _line("point_width", _length(2.0 * (outside.land or 0.0)), origins.wheel_cutter)
    yield ""
    yield f"[wheel.settings]  # {origins.wheel_settings}"
    yield from _settings(member.concave)
    yield ""
    yield "[wheel.blade]"
    yield _line("edge_radius", _length(outside.edge_radius), origins.edge_radius)
    for side, blade, what in (("concave", outside, "outside"), ("convex", inside, "inside")):
        yield ""
        yield f"[wheel.{side}.blade]  # {what} blade"
        yield _line("angle", _angle(blade.angle), origins.wheel_cutter)


def _pinion(member: MemberSpec, origins: Origins) -> Iterator[str]:
    yield from _member("pinion", member, origins)
    outside, inside = _mill(member.concave), _mill(member.convex)
    together = not cut_apart(member)
    yield "[pinion.cutter]"
    yield _line("type", "face-mill", "both flanks by one" if together else "one a flank")
    if together:
        yield _line(
            "diameter", _length(outside.point_radius + inside.point_radius), origins.pinion_blade
        )
        yield _line("point_width", _length(2.0 * (outside.land or 0.0)), origins.pinion_blade)
        yield ""
        yield f"[pinion.settings]  # {origins.pinion_settings['concave']}"
        yield from _settings(member.concave)
    yield ""
    yield "[pinion.blade]"
    yield _line("edge_radius", _length(outside.edge_radius), origins.edge_radius)
    for side, flank in (("concave", member.concave), ("convex", member.convex)):
        if not together:
            yield ""
            yield f"[pinion.{side}.settings]  # {origins.pinion_settings[side]}"
            yield from _settings(flank)
        yield ""
        yield f"[pinion.{side}.blade]  # {'outside' if side == 'concave' else 'inside'} blade"
        blade = _mill(flank)
        yield _line("angle", _angle(blade.angle), origins.pinion_blade)
        if not together:
            yield _line("point_diameter", _length(2.0 * blade.point_radius), origins.pinion_blade)
        if blade.curve != "straight":
            yield _line("profile", blade.curve)
            yield _line("radius", _length(blade.curve_radius), origins.pinion_blade)
            yield _line("reference_height", _length(blade.reference_height))


def _blank(blank: GivenBlank) -> Iterator[str]:
    for name in _BLANK:
        value = getattr(blank, name)
        if value is not None:
            why = "mean point to heel" if name == "outer_face_width" else ""
            yield _line(name, _quantity(name, value), why)


def _settings(flank: FlankSpec) -> Iterator[str]:
    yield _line("method", flank.method)
    for name in _SETTINGS:
        value: Any = flank.dials.get(name)
        if value is None or (name == "ratio_of_roll" and not value):
            continue
        if name in ("ratio_of_roll", "modified_roll"):
            why = "c2, c3, ... of W = R_a (phi + c2 phi^2 + ...)" if name == "modified_roll" else ""
            yield _line(name, list(value) if isinstance(value, tuple) else value, why)
        elif name == "helical_motion":
            yield _line(name, f"{value!r} mm/rad")
        elif name == "motions":
            yield _line(name, {axis: _powers(axis, powers) for axis, powers in value.items()})
        else:
            yield _line(name, _quantity(name, value))


def _powers(axis: str, powers: tuple[float, ...]) -> list[Any]:
    if axis in _ANGLE_MOTIONS:
        return list(powers)
    units = ["mm/rad", *(f"mm/rad^{n}" for n in range(2, 7))]
    return [f"{value!r} {unit}" for value, unit in zip(powers, units, strict=False)]


def _quantity(name: str, value: float) -> str:
    return _angle(value) if name in _ANGLES else _length(value)


def _angle(value: float) -> str:
    return f"{degrees(float(value))!r} deg"


def _length(value: float) -> str:
    return f"{float(value)!r} mm"


def _line(key: str, value: Any, why: str = "") -> str:
    text = f"{key} = {toml(value)}"
    return f"{text:<{COMMENT}} # {why}" if why else text
