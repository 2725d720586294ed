"""The summary sheet of the 2022 paper (Tables 4 and 5): its own signs and its own zero.

Two things differ from the generator chain. The blank offset dE_m is negative where the pinion axis
lies on the cutter's side (chain: E_m positive there), and the machine centre to back dX_D counts to
the pitch apex (chain: to the crossing point). A test shows that both are the same rigid motion.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from ._cam import Cam
from ._settings import NO_MOTIONS, MachineSettings, Motions


@dataclass(frozen=True)
class SummarySheet:
    """Settings as the 2022 paper prints them; mm and rad [gonzalez2022, Tables 4 and 5]."""

    radial_distance: float  # S_r
    cradle_angle: float  # q_0
    tilt_angle: float
    swivel_angle: float
    blank_offset: float  # dE_m = -E_m
    machine_root_angle: float  # gamma_m
    machine_center_to_back: float  # dX_D, to the pitch apex
    sliding_base: float  # dX_B
    ratio_of_roll: float  # m_c
    roll_to_blade_ratio: float  # m_b
    helical_motion: float = 0.0  # mm/rad
    modified_roll: tuple[float, ...] = ()
    motions: Motions = NO_MOTIONS
    cam: Cam | None = None
    generated: bool = True
    cutter_lead: float = 0.0  # mm/rad


def to_sheet(settings: MachineSettings, apex_beyond_crossing: float) -> SummarySheet:
    """The sheet of basic settings, for a member whose pitch apex lies at z = -apex_beyond_crossing."""
    return SummarySheet(
        radial_distance=settings.radial_distance,
        cradle_angle=settings.cradle_angle,
        tilt_angle=settings.tilt_angle,
        swivel_angle=settings.swivel_angle,
        blank_offset=-settings.blank_offset,
        machine_root_angle=settings.machine_root_angle,
        machine_center_to_back=settings.machine_center_to_back - apex_beyond_crossing,
        sliding_base=settings.sliding_base,
        ratio_of_roll=settings.ratio_of_roll,
        roll_to_blade_ratio=settings.roll_to_blade_ratio,
        helical_motion=settings.helical_motion,
        modified_roll=tuple(settings.modified_roll),
        motions=_other_sign(settings.motions),
        cam=settings.cam,
        generated=settings.generated,
        cutter_lead=settings.cutter_lead,
    )


def from_sheet(sheet: SummarySheet, apex_beyond_crossing: float) -> MachineSettings:
    """Basic settings (signs of the chain) of a sheet."""
    return MachineSettings(
        radial_distance=sheet.radial_distance,
        cradle_angle=sheet.cradle_angle,
        tilt_angle=sheet.tilt_angle,
        swivel_angle=sheet.swivel_angle,
        blank_offset=-sheet.blank_offset,
        machine_root_angle=sheet.machine_root_angle,
        machine_center_to_back=sheet.machine_center_to_back + apex_beyond_crossing,
        sliding_base=sheet.sliding_base,
        ratio_of_roll=sheet.ratio_of_roll,
        roll_to_blade_ratio=sheet.roll_to_blade_ratio,
        helical_motion=sheet.helical_motion,
        modified_roll=sheet.modified_roll,
        motions=_other_sign(sheet.motions),
        cam=sheet.cam,
        generated=sheet.generated,
        cutter_lead=sheet.cutter_lead,
    )


def _other_sign(motions: Motions) -> Motions:
    """Motions with the other sign of the blank offset."""
    return replace(motions, blank_offset=tuple(-c for c in motions.blank_offset))
