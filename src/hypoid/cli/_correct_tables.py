"""What `hypoid correct` says: steps and readings, what is undecided, and contacts side by side."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees
from typing import TYPE_CHECKING, Any

from ._inspect import UM
from ._output import say, write_members, write_table

if TYPE_CHECKING:
    from hypoid.flank import Side
    from hypoid.inspect import Comparison, ContactState, Correction

ARCSEC = 3600.0


def _shown_key(kind: str, name: str) -> tuple[str, float]:
    """Key with its unit, and what a value is multiplied by."""
    if kind == "angle":
        return f"{name}_deg", degrees(1.0)
    return (f"{name}_mm", 1.0) if kind == "length" else (name, 1.0)


def correction_table(c: Correction) -> dict[str, Any]:
    from hypoid.inspect import gears_after, readings

    steps: dict[str, float] = {}
    new: dict[str, float] = {}
    for one in readings(c):
        key, unit = _shown_key(one.adjustment.kind, one.adjustment.name)
        steps[key], new[key] = one.step * unit, one.value * unit
    return {
        "sides": c.setup.sides,
        "machine": c.setup.machine,
        "free": c.free,
        "steps": steps,
        "new_settings": new,
        "gears": gears_after(c),
        "rank": c.rank,
        "converged": c.converged,
        "at_bounds": c.at_bounds,
        "rms_before_um": c.rms_before * UM,
        "rms_predicted_um": c.rms_predicted * UM,
        "predicted_um": {s: m * UM for s, m in c.predicted.items()},
        "uncertainty_um": {s: m * UM for s, m in c.uncertainty.items()},
        "undecided": [n.words for n in c.null],
    }


def show_corrections(corrections: list[Correction], found: Comparison) -> None:
    from hypoid.inspect import gears_after, readings

    for c in corrections:
        lines = [(r.adjustment.name, r.words) for r in readings(c)]
        write_table(f"{c.setup.name} on {c.setup.machine}", ["step", "new reading"], lines)
        for name, teeth in gears_after(c).items():
            say(f"{name.replace('_', ' ')}: {teeth}.")
        say(
            f"{c.setup.name}: {c.rms_before * UM:.2f} um rms before, {c.rms_predicted * UM:.2f} um predicted; "
            f"{c.rank} of {len(c.free)} directions corrected, the noise leaves the rest undecided."
        )
        for name in c.at_bounds:
            say(f"{name} stands at its bound.")
        if not c.converged:
            say("Not converged: take it as a first step, cut, and measure again.")
        for null in c.null:
            say(f"Undecided: {null.words}.")
    alone: list[Side] = [s for c in corrections if len(c.setup.sides) == 1 for s in c.setup.sides]
    if found.thickness is not None and len(alone) == 2:
        turn = degrees(abs(found.thickness) / found.sides[alone[0]].nodes.radius) * 60.0
        say(
            f"Tooth thickness {found.thickness * UM:+.1f} um: the index's affair, a turn of the work by "
            f"{turn:.2f} min between both cuts."
        )


def contact_table(states: Mapping[str, Mapping[Any, ContactState]]) -> dict[str, Any]:
    return {
        name: {
            direction: {
                "transmission_error_peak_to_peak_arcsec": degrees(s.transmission_error) * ARCSEC,
                "contact_point": dict(
                    zip(("cone_distance_mm", "height_mm"), s.contact.contact_point, strict=True)
                ),
                "pattern_centre": dict(
                    zip(("cone_distance_mm", "height_mm"), s.centre, strict=True)
                ),
                "pattern_share": s.pattern.share,
                "edge_contact": s.contact.edge_contact,
            }
            for direction, s in both.items()
        }
        for name, both in states.items()
    }


def show_contact(states: Mapping[str, Mapping[Any, ContactState]]) -> None:
    columns = {
        f"{direction} {name}": {
            "TE peak to peak [arcsec]": degrees(s.transmission_error) * ARCSEC,
            "contact point S, H [mm]": tuple(round(v, 3) for v in s.contact.contact_point),
            "pattern's middle S, H [mm]": tuple(round(v, 3) for v in s.centre),
            "pattern, share of the flank": s.pattern.share,
            "edge contact": "yes" if s.contact.edge_contact else "no",
        }
        for name, both in states.items()
        for direction, s in both.items()
    }
    write_members("contact, unloaded", dict(sorted(columns.items())))
