"""From the checked file with [cutting] to what is asked of the program."""

from __future__ import annotations

from collections.abc import Mapping

from hypoid.design import Assumption, ExactFaceHobbedSpec, SettingValue, TipRelief

from ._bodies import bodies_of
from ._defaults import defaults_used
from ._design_file import DesignFile, Relief, Settings

OUTER_SHARE = 0.5
_SHARED = Assumption(
    "cutting.outer_share", f"not given; the program's default is {OUTER_SHARE:g}: evenly"
)


def spec_of(file: DesignFile) -> ExactFaceHobbedSpec:
    """The numbers of a design file, with all that the file or the program assumed."""
    pair, pinion, wheel = file.pair, file.pinion, file.wheel
    blank, cutting = file.blank, file.cutting
    with_defaults = {
        "blank": blank,
        "cutting": cutting,
        "cutting.tip_relief": cutting.tip_relief,
        "contact": file.contact,
    }
    radius = wheel.mean_pitch_radius or (wheel.mean_pitch_diameter or 0.0) / 2
    return ExactFaceHobbedSpec(
        title=file.title,
        source=file.source,
        assumed=(
            *(Assumption(a.value, a.reason) for a in file.assumed),
            *defaults_used(with_defaults),
            *([_SHARED] if cutting.eccentricity and cutting.outer_share is None else []),
        ),
        shaft_angle=pair.shaft_angle,
        offset=pair.offset,
        pinion_teeth=pinion.teeth,
        wheel_teeth=wheel.teeth,
        pinion_hand=pinion.hand,
        pinion_spiral_angle=pinion.mean_spiral_angle,
        wheel_mean_radius=radius,
        wheel_face_width=wheel.face_width,
        mean_addendum_factor=blank.mean_addendum_factor,
        depth_factor=blank.depth_factor,
        clearance_factor=blank.clearance_factor,
        cutter_radius=cutting.cutter_radius,
        blade_groups=cutting.blade_groups,
        pressure_angle=cutting.pressure_angle,
        tip_edge_radius_factor=cutting.tip_edge_radius_factor,
        tip_relief=_relief(cutting.tip_relief),
        marking_thickness=file.contact.marking_thickness,
        eccentricity=cutting.eccentricity or 0.0,
        outer_share=OUTER_SHARE if cutting.outer_share is None else cutting.outer_share,
        setting_changes=_setting_changes(file),
        bodies=bodies_of(file),
    )


def _relief(relief: Relief | None) -> TipRelief | None:
    if relief is None:
        return None
    return TipRelief(relief.coefficient, relief.height, relief.measured_from, relief.flanks)


def _setting_changes(file: DesignFile) -> dict[str, Mapping[str, SettingValue]]:
    """By flank; what stands at a flank goes before what stands at its member."""
    changes: dict[str, Mapping[str, SettingValue]] = {}
    for name, member in (("pinion", file.pinion), ("wheel", file.wheel)):
        for side, flank in (("concave", member.concave), ("convex", member.convex)):
            if change := _given(member.settings) | _given(flank.settings):
                changes[f"{name}.{side}"] = change
    return changes


def _given(settings: Settings) -> dict[str, SettingValue]:
    return {
        name: tuple(value) if isinstance(value, list) else value
        for name, value in settings.model_dump(exclude_none=True).items()
    }
