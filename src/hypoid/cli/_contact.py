"""`hypoid contact`."""

from __future__ import annotations

from dataclasses import asdict
from math import degrees
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from ._options import AsJson, DesignPath, quantities
from ._output import report_faults, write_json, write_members

if TYPE_CHECKING:
    from hypoid.contact import TipInterference, UnloadedContact

ARCSEC, URAD, UM = 3600.0, 1e6, 1e3


def contact(
    file: DesignPath,
    /,
    *,
    offset: Annotated[str, Parameter(allow_leading_hyphen=True)] = "0 mm",
    pinion_axial: Annotated[str, Parameter(allow_leading_hyphen=True)] = "0 mm",
    wheel_axial: Annotated[str, Parameter(allow_leading_hyphen=True)] = "0 mm",
    shaft_angle: Annotated[str, Parameter(allow_leading_hyphen=True)] = "0 deg",
    json: AsJson = False,
) -> int:
    """Unloaded contact of both directions: path, transmission error, contact ratio, pattern.

    Parameters
    ----------
    offset
        Error of the offset, positive where it grows: "0.254 mm".
    pinion_axial
        Axial error of the pinion, positive where it is withdrawn.
    wheel_axial
        Axial error of the wheel, positive where it is withdrawn.
    shaft_angle
        Error of the shaft angle, positive where it opens: "3 arcmin".
    """
    from hypoid.contact import Misalignment, faults, pattern, tip_interference, unloaded_contact

    error = Misalignment(
        *quantities(
            {
                "--offset": (offset, "length"),
                "--pinion-axial": (pinion_axial, "length"),
                "--wheel-axial": (wheel_axial, "length"),
                "--shaft-angle": (shaft_angle, "angle"),
            }
        ).values()
    )
    import hypoid

    pair = hypoid.read(file)
    results = {d: unloaded_contact(pair, d, error) for d in ("drive", "coast")}
    cuts = {d: tip_interference(result) for d, result in results.items()}
    if json:
        tables = {d: _result(r, pattern(r).share, cuts[d]) for d, r in results.items()}
        write_json({**tables, "assumed": [asdict(a) for a in pair.assumed]})
    else:
        write_members(pair.title, {d: _for_people(r, pattern(r).share) for d, r in results.items()})
    named = pair.faults + tuple(f for d, r in results.items() for f in faults(r, cuts[d]))
    return report_faults(named)


def _result(
    contact: UnloadedContact, share: float, cuts: tuple[TipInterference, ...]
) -> dict[str, Any]:
    """One direction under the names that scripts rely on."""
    own = contact.points.lead[contact.on_path] - contact.index_shift
    distance, height = contact.path
    return {
        "transmission_error_peak_to_peak_urad": contact.peak_to_peak * URAD,
        "transmission_error_peak_to_peak_arcsec": degrees(contact.peak_to_peak) * ARCSEC,
        "transmission_error_harmonics_urad": contact.harmonics() * URAD,
        "contact_ratio": contact.contact_ratio,
        "edge_contact": contact.edge_contact,
        "contact_point": {
            "cone_distance_mm": contact.contact_point[0],
            "height_mm": contact.contact_point[1],
        },
        "transfer_points_deg": [degrees(angle) for angle in contact.transfer_points],
        "pattern_thickness_mm": contact.pair.marking_thickness,
        "pattern_share": share,
        "index_shift_urad": contact.index_shift * URAD,
        "tip_interference": [
            {
                "tip_of": cut.tip_of,
                "into": cut.into,
                "depth_um": cut.depth * UM,
                "cone_distance_mm": cut.cone_distance,
                "height_mm": cut.height,
                "pinion_angle_deg": degrees(cut.pinion_angle),
            }
            for cut in cuts
            if cut.found
        ],
        "path": [
            {
                "pinion_angle_deg": degrees(angle),
                "transmission_error_urad": error * URAD,
                "cone_distance_mm": s,
                "height_mm": h,
            }
            for angle, error, s, h in zip(
                contact.phi[contact.on_path], own, distance, height, strict=True
            )
        ],
    }


def _for_people(contact: UnloadedContact, share: float) -> dict[str, Any]:
    start, end = contact.transfer_points
    return {
        "TE peak to peak [arcsec]": degrees(contact.peak_to_peak) * ARCSEC,
        "TE peak to peak [urad]": contact.peak_to_peak * URAD,
        "rigid contact ratio": contact.contact_ratio,
        "transfer points [deg]": (round(degrees(start), 3), round(degrees(end), 3)),
        "edge contact": "yes" if contact.edge_contact else "no",
        "contact point S, H [mm]": tuple(round(v, 4) for v in contact.contact_point),
        "pattern, share of the flank": share,
    }
