"""From the checked file that asks for a pair by its blank to what is asked of the program."""

from __future__ import annotations

from typing import Any

from hypoid.blank import BlankRequest, DepthFactors, TaperAngles, TypeI, TypeII
from hypoid.design import (
    Assumption,
    EaseOffTarget,
    ExactFaceHobbedSpec,
    HobbedRequest,
    MilledRequest,
    MotionTarget,
    PinionLimits,
    Target,
)

from ._defaults import defaults_used
from ._request_file import RequestBlank, RequestFile, RequestPinion, TargetTable
from ._request_hobbed import exact_of, grind_of, hobbing_assumed
from ._request_rules import MOTION, TYPE_I

_USUAL = EaseOffTarget()
_NO_VALUE = (
    "contact.drive", "contact.coast", "pinion.free", "pinion.fixed", "pinion.range", "pinion.machine",
)  # fmt: skip


def request_of(file: RequestFile) -> MilledRequest | HobbedRequest | ExactFaceHobbedSpec:
    """The numbers of the file, with all that the file or the program assumed."""
    pinion, wheel, cutting, contact = file.pinion, file.wheel, file.cutting, file.contact
    of_pinion = pinion.mean_spiral_angle is not None
    spiral = pinion.mean_spiral_angle if of_pinion else wheel.mean_spiral_angle
    outer = wheel.outer_pitch_diameter
    if wheel.outer_transverse_module is not None:
        outer = wheel.outer_transverse_module * wheel.teeth
    tables = {
        "pair": file.pair,
        "pinion": pinion,
        "wheel": wheel,
        "blank": file.blank,
        "cutting": cutting,
        "contact": contact,
    }
    assumed = [Assumption(a.value, a.reason) for a in file.assumed]
    assumed += [a for a in defaults_used(tables) if a.value not in _NO_VALUE]
    assumed += [*_guide_values(file.blank), *_usual_targets(file), *hobbing_assumed(file)]
    if cutting.process == "face-hobbed" and cutting.cutter == "exact":
        return exact_of(file, tuple(assumed))
    coast = cutting.coast_pressure_angle
    common: dict[str, Any] = {
        "title": file.title,
        "source": file.source,
        "assumed": tuple(assumed),
        "blank": BlankRequest(
            method=file.blank.method,
            z1=pinion.teeth,
            z2=wheel.teeth,
            shaft_angle=file.pair.shaft_angle,
            offset=file.pair.offset,
            wheel_face_width=wheel.face_width,
            cutter_radius=cutting.cutter_radius,
            spiral_angle=spiral or 0.0,
            spiral_of="pinion" if of_pinion else "wheel",
            wheel_outer_diameter=outer,
            wheel_mean_diameter=wheel.mean_pitch_diameter,
            blade_groups=cutting.blade_groups or 0,
            pressure_angles=(
                cutting.pressure_angle,
                cutting.pressure_angle if coast is None else coast,
            ),
            limit_share=cutting.limit_share,
            tooth=_tooth(file.blank),
            taper=_taper(file.blank),
            pinion_hand=pinion.hand,
        ),
        "wheel_method": wheel.method,
        "pinion_method": pinion.method,
        "drive": _target(contact.drive, contact.marking_thickness),
        "coast": _target(contact.coast, contact.marking_thickness),
        "tolerance": contact.tolerance,
        "wheel_edge_radius": wheel.edge_radius,
        "pinion_edge_radius": pinion.edge_radius,
        "limits": _limits(pinion),
        "normal_backlash": file.pair.normal_backlash,
        "marking_thickness": contact.marking_thickness,
    }
    if cutting.process == "face-hobbed":
        return HobbedRequest(
            **common, grind=grind_of(file), equal_spacing=cutting.equal_spacing is not False
        )
    return MilledRequest(**common)


def _limits(pinion: RequestPinion) -> PinionLimits:
    ranges = pinion.range.model_dump(exclude_none=True)
    return PinionLimits(
        machine=pinion.machine or "",
        free=tuple(pinion.free),
        fixed=pinion.fixed.model_dump(exclude_none=True),
        ranges={name: (low, high) for name, (low, high) in ranges.items()},
    )


def _taper(blank: RequestBlank) -> Any:
    if blank.wheel_addendum_angle is None or blank.wheel_dedendum_angle is None:
        return blank.taper
    return TaperAngles(blank.wheel_addendum_angle, blank.wheel_dedendum_angle)


def _tooth(blank: RequestBlank) -> TypeI | TypeII:
    given = blank.model_dump(exclude_none=True)
    if TYPE_I[0] in given:
        factors = DepthFactors(*(given[name] for name in TYPE_I[:3]))
        return TypeI(factors, given.get(TYPE_I[3], 0.0))
    usual = TypeII()
    return TypeII(
        mean_addendum_factor=blank.mean_addendum_factor,
        depth_factor=blank.depth_factor or usual.depth_factor,
        clearance_factor=usual.clearance_factor
        if blank.clearance_factor is None
        else blank.clearance_factor,
        thickness_factor=blank.thickness_factor,
    )


def _target(table: TargetTable, marking_thickness: float) -> Target:
    given = table.model_dump(exclude_none=True)
    if not any(name in given for name in MOTION):
        return EaseOffTarget(**given)
    if "place" in given:
        given["place"] = tuple(given["place"])
    return MotionTarget(marking_thickness=marking_thickness, **given)


def _guide_values(blank: RequestBlank) -> list[Assumption]:
    """Tooth data of annex C that stand where the file says nothing."""
    if blank.addendum_coefficient is not None:
        return []
    return [
        Assumption(f"blank.{name}", f"not given; the guide value of ISO 23509, annex C{value}")
        for name, value in (
            ("mean_addendum_factor", ""),
            ("depth_factor", ", 2.0"),
            ("clearance_factor", ", 0.125"),
            ("thickness_factor", ""),
        )
        if getattr(blank, name) is None
    ]


def _usual_targets(file: RequestFile) -> list[Assumption]:
    return [
        Assumption(
            f"contact.{side}",
            f"not given; {1e3 * _USUAL.lengthwise_crowning:g} um lengthwise and "
            f"{1e3 * _USUAL.profile_crowning:g} um profile crowning",
        )
        for side in ("drive", "coast")
        if not getattr(file.contact, side).model_fields_set
    ]
