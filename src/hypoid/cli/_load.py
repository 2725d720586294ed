"""`hypoid load`."""

from __future__ import annotations

from dataclasses import asdict
from math import degrees
from typing import TYPE_CHECKING, Any

from ._load_options import NM, Computed, Figure, LoadOptions, computed_for, ended, write_figure
from ._options import AsJson, DesignPath
from ._output import write_json, write_table

if TYPE_CHECKING:
    from hypoid.load import LoadCase, LoadedPosition, RootStress

URAD, UM = 1e6, 1e3
USUAL = LoadOptions()


def load(
    file: DesignPath,
    /,
    *,
    options: LoadOptions = USUAL,
    figure: Figure = None,
    json: AsJson = False,
) -> int:
    """Loaded contact per torque: pressure, load sharing, transmission error, root stress.

    An interrupt (Ctrl-C) keeps the positions that are finished.
    """
    found = computed_for(file, options, figure)
    if figure is not None:
        from hypoid.report import loaded_contact_figure

        write_figure(lambda: loaded_contact_figure(found.loaded), figure)
    cases = [
        _case(case, stress) for case, stress in zip(found.loaded.cases, found.stress, strict=True)
    ]
    if json:
        write_json(
            {
                "direction": options.direction,
                "complete": found.loaded.complete,
                "cases": cases,
                "assumed": [asdict(a) for a in found.assumed],
            }
        )
    else:
        _show(found)
    return ended(found)


def _case(case: LoadCase, stress: dict[str, RootStress]) -> dict[str, Any]:
    """One torque under the names that scripts rely on."""
    return {
        "torque_Nm": case.torque * NM,
        "max_pressure_MPa": case.max_pressure,
        "rounded_tip_pressure_MPa": case.tip_pressure,
        "edge_contact": case.edge_contact,
        "left_flanks_from_Nm": case.leaves_at * NM or None,
        "contact_ratio_under_load": case.contact_ratio,
        "arc_of_contact_pitches": case.arc_of_contact,
        "transmission_error_peak_to_peak_urad": case.peak_to_peak * URAD,
        "transmission_error_peak_to_peak_doubt_urad": case.peak_to_peak_doubt * URAD,
        "transmission_error_harmonics_urad": case.harmonics() * URAD,
        "max_root_stress_MPa": {name: s.max_principal for name, s in stress.items()},
        "max_root_von_mises_MPa": {name: s.max_von_mises for name, s in stress.items()},
        "positions": [_position(p) for p in case.positions],
    }


def _position(at: LoadedPosition) -> dict[str, Any]:
    return {
        "pinion_angle_deg": degrees(at.pinion_angle),
        "max_pressure_MPa": at.max_pressure,
        "rounded_tip_pressure_MPa": at.tip_pressure,
        "pairs_in_contact": len(at.pairs),
        "pairs": [p.pair for p in at.pairs],
        "load_share": [p.share for p in at.pairs],
        "pair_force_N": [p.force for p in at.pairs],
        "pair_max_pressure_MPa": [p.max_pressure for p in at.pairs],
        "edge_contact": at.edge_contact,
        "edges": sorted({p.edge for p in at.pairs if p.edge}),
        "edge_force_N": sum(p.edge_force for p in at.pairs),
        "transmission_error_urad": at.transmission_error * URAD,
        "unloaded_transmission_error_urad": at.unloaded * URAD,
        "stiffness_Nm_per_mrad": at.stiffness * NM * 1e-3,
        "wheel_torque_Nm": at.wheel_torque * NM,
        "pinion_axial_force_N": at.pinion_axial,
        "pinion_radial_force_N": at.pinion_radial,
        "wheel_axial_force_N": at.wheel_axial,
        "wheel_radial_force_N": at.wheel_radial,
        "bearings": {
            name: {
                "force_N": wrench[:3],
                "moment_Nm": wrench[3:] * NM,
                "displacement_mm": motion[:3],
                "turn_mrad": motion[3:] * 1e3,
            }
            for name, wrench, motion in (
                ("pinion", at.pinion_wrench, at.pinion_motion),
                ("wheel", at.wheel_wrench, at.wheel_motion),
            )
        },
        "bearing_misalignment": {
            "offset_um": at.misalignment.offset * UM,
            "pinion_axial_um": at.misalignment.pinion_axial * UM,
            "wheel_axial_um": at.misalignment.wheel_axial * UM,
            "shaft_angle_arcmin": degrees(at.misalignment.shaft_angle) * 60.0,
        },
        "outcome": at.outcome.value or "ok",
    }


def _show(found: Computed) -> None:
    cases = found.loaded.cases
    rows: list[tuple[str, list[float | int | str]]] = [
        ("greatest pressure [MPa]", [c.max_pressure for c in cases]),
        ("of that on rounded tips [MPa]", [c.tip_pressure for c in cases]),
        ("edge contact", ["yes" if c.edge_contact else "no" for c in cases]),
        ("contact ratio under load", [c.contact_ratio for c in cases]),
        ("arc of contact [pitches]", [c.arc_of_contact for c in cases]),
        ("pairs in contact", [_range([len(p.pairs) for p in c.positions]) for c in cases]),
        ("TE under load, peak to peak [urad]", [c.peak_to_peak * URAD for c in cases]),
        ("TE under load, mean [urad]", [float(c.transmission_error.mean()) * URAD for c in cases]),
        ("root stress, pinion [MPa]", [s["pinion"].max_principal for s in found.stress]),
        ("root stress, wheel [MPa]", [s["wheel"].max_principal for s in found.stress]),
    ]
    members = (found.loaded.pair.pinion, found.loaded.pair.wheel)
    if not any(m.tip_rounding > 0.0 for m in members):
        rows = [row for row in rows if "rounded tips" not in row[0]]
    title = f"{found.loaded.pair.title}: {found.loaded.direction}"
    write_table(title, [f"{c.torque * NM:g} N m" for c in cases], rows)
    for a in found.assumed:
        print(f"Assumed {a.value}: {a.reason}")


def _range(values: list[int]) -> str:
    low, high = min(values), max(values)
    return str(low) if low == high else f"{low}-{high}"
