"""What keeps a design from what was asked, in words; face milled and face hobbed alike."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from hypoid.blank import (
    PairBlank,
    UndercutLimit,
    crown_gear_tooth,
    tooth_factors,
    undercut_limits,
)
from hypoid.flank import Side

from ._hobbed_request import HobbedRequest
from ._milled_request import MilledRequest


class Near(Protocol):
    """How near a flank came to its target, mm."""

    @property
    def rms(self) -> float: ...
    @property
    def largest(self) -> float: ...


def likely_undercut(
    request: MilledRequest | HobbedRequest, blank: PairBlank
) -> tuple[UndercutLimit, ...]:
    """The limits of ISO 23509, clause 8, kept and not kept."""
    asked, cones = request.blank, blank.cones
    angles = cones.pinion_pitch_angle, cones.wheel_pitch_angle
    factors = tooth_factors(asked.tooth, cones.teeth, angles)[0]
    tooth = crown_gear_tooth(cones, asked.cutter_radius, asked.blade_groups)
    generated = request.wheel_method == "generated"
    return undercut_limits(blank, factors, tooth, wheel_generated=generated)


def blank_faults(blank: PairBlank, undercut: Sequence[UndercutLimit]) -> list[str]:
    """What is wrong with a blank, undercut that is likely among it."""
    found = [fault.value for fault in blank.faults]
    for limit in undercut:
        if not limit.kept:
            bound = "below its least" if limit.member == "pinion" else "above its greatest"
            found.append(
                f"Undercut is likely at the {limit.member}'s {limit.place}: the profile shift x_hm1 = "
                f"{limit.profile_shift:.3f} is {bound} of {limit.limit:.3f} (ISO 23509, clause 8)."
            )
    return found


def wider(request: MilledRequest | HobbedRequest) -> str:
    """What else may keep a pinion from being there: bounds of the request, in words."""
    limits = request.limits
    parts = ("machine", limits.machine), ("fixed", limits.fixed), ("range", limits.ranges)
    given = [f"pinion.{name}" for name, value in parts if value]
    return f", or widen {' and '.join(given)}" if given else ""


def short_of_target(side: Side, fit: Near, request: MilledRequest | HobbedRequest) -> str:
    """How near a pinion flank came to its target, without a full stop."""
    return (
        f"The pinion's {side} flank keeps {1e3 * fit.largest:.1f} um from its target ease-off "
        f"(rms {1e3 * fit.rms:.1f} um; tolerance {1e3 * request.tolerance:g} um) with method "
        f'"{request.pinion_method}"'
    )
