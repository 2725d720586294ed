"""What is wrong with a Tri-Ac blade: every fault at once, each with the admissible range."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import get_args

from hypoid.geometry import Problem

from ._mill_blade import CircularProfile
from ._mill_faults import (
    LEANS,
    LEAST,
    MOST,
    REMOVAL,
    _below,
    _Faults,
    _largest,
    _most_bend,
    _shown,
    round_down,
    round_up,
)
from ._tri_ac_blade import BladeToprem, TopremReading, TriAcBlade

TILT = math.radians(45.0)  # hook and side rake stay below
ECCENTRIC = math.radians(60.0)


def tri_ac_blade_faults(blade: TriAcBlade, path: str = "cutter") -> list[Problem]:
    """Every fault of a Tri-Ac blade; empty where it can be drawn. ``path`` begins each path."""
    faults = _Faults(path)
    radius = faults.length(blade.radius, "radius", "76 mm")
    height = faults.length(blade.height, "height", "6 mm")
    shank = faults.length(blade.shank_height, "shank_height", "4 mm")
    edge = faults.length(blade.edge_radius, "edge_radius", "0.8 mm", least_zero=True)
    if blade.land is not None:
        faults.length(blade.land, "land", "1 mm")
    eccentric = faults.need(
        0.0 <= blade.eccentric_angle < ECCENTRIC,
        "eccentric_angle",
        _shown(blade.eccentric_angle),
        f"an angle of at least 0 and below {_shown(ECCENTRIC)}: that of a left-hand head",
        "19 deg",
    )
    raked = [
        faults.need(
            abs(angle) < TILT,
            key,
            _shown(angle),
            f"an angle between -{_shown(TILT)} and {_shown(TILT)}",
            example,
        )
        for key, angle, example in (
            ("hook_angle", blade.hook_angle, "4 deg"),
            ("rake_angle", blade.rake_angle, "12 deg"),
        )
    ]
    drawn = all(raked) and _angle_fault(faults, blade) and height and shank
    if not (drawn and _curve_fault(faults, blade)):
        return faults.problems
    toprem = _toprem_faults(faults, blade)
    if toprem and edge:
        edge = _edge_radius_fault(faults, blade)
    if toprem and edge and radius and eccentric:
        _axis_fault(faults, blade)
    return faults.problems


def _angle_fault(faults: _Faults, blade: TriAcBlade) -> bool:
    """The blade angle, by the lean that the projected edge may have."""
    hook, rake = blade.hook_angle, blade.rake_angle

    def ground(profile: float) -> float:
        tangent = math.tan(profile)
        across = 1.0 - tangent * math.tan(rake) * math.sin(hook)
        return math.degrees(math.atan2(tangent * math.cos(hook), across))

    low, high = round_up(ground(LEAST), 2), round_down(ground(MOST), 2)
    inside = abs(blade.blade_angle) < math.pi / 2
    return faults.need(
        inside and LEAST < blade.profile_angle < MOST,
        "blade_angle",
        _shown(blade.blade_angle),
        f"an angle between {low:g} and {high:g} deg: the edge then leans between {LEANS}",
        "20 deg",
    )


def _curve_fault(faults: _Faults, blade: TriAcBlade) -> bool:
    """Whether a curved edge keeps its lean from tip to shank."""
    radius, most = blade.curve_radius, math.inf
    if math.isfinite(radius) and radius:
        most = _most_bend(
            CircularProfile(radius, blade.height),
            blade.profile_angle,
            blade.height + blade.shank_height,
            radius > 0.0,
        )
    limit = f" of at least {round_up(1.0 / most):g} mm" if most < math.inf else ""
    example = 762.0 if most * 762.0 > 1.0 else math.ceil(1.2 / most)
    return faults.need(
        abs(blade.bend) < most,  # never of NaN
        "curve_radius",
        f"{radius:g} mm",
        f"a signed radius{limit} in amount: the edge then leans between {LEANS} from tip to shank; "
        "or 0 mm for a straight edge",
        f"{example:g} mm",
    )


def _toprem_faults(faults: _Faults, blade: TriAcBlade) -> bool:
    """Whether Toprem, if any, can be drawn on the blade with a sharp corner, below P."""
    toprem = blade.toprem
    if toprem is None:
        return True
    readings = get_args(TopremReading)
    read = faults.need(
        toprem.measured in readings,
        "toprem.measured",
        repr(toprem.measured),
        "one of " + ", ".join(f'"{name}"' for name in readings),
        readings[0],
    )
    kink = replace(blade, edge_radius=0.0).kink_angle if math.isfinite(toprem.length) else math.nan
    kink = kink if math.isfinite(kink) else blade.profile_angle
    most = min(kink - LEAST, REMOVAL)
    turned = faults.need(
        0.0 < toprem.angle < most,
        "toprem.angle",
        _shown(toprem.angle),
        _below(most),
        _shown(0.2 * most),
    )
    if not (read and turned):
        return False
    longest = _longest(blade, toprem)
    return faults.need(
        0.0 < toprem.length < longest,
        "toprem.length",
        f"{toprem.length:g} mm",
        f"a length above 0 and below {round_down(longest):g} mm, at which Toprem ends at the pitch point",
        f"{0.3 * longest:.3g} mm",
    )


def _longest(blade: TriAcBlade, toprem: BladeToprem) -> float:
    """Length, mm, of a Toprem that ends at P, on a blade with a sharp corner."""
    if toprem.measured == "axial":
        return blade.height
    return blade.height / math.cos(blade.profile_angle - toprem.angle)


def _fits(blade: TriAcBlade, radius: float) -> bool:
    """Whether an edge arc ends below Toprem's kink, if any, and leaves the flank to begin below P."""
    blade = replace(blade, edge_radius=radius)
    start = blade.flank_start  # NaN where nothing meets
    return start < blade.height and blade.arc_height <= start


def _edge_radius_fault(faults: _Faults, blade: TriAcBlade) -> bool:
    """The edge radius that Toprem, or the height of P, leaves room for."""
    fits = _fits(blade, blade.edge_radius)
    most = 0.0 if fits else round_down(_largest(lambda r: _fits(blade, r), blade.edge_radius))
    room = f"a pitch point {blade.height:g} mm over the tip"
    if blade.toprem:
        room += f" and a Toprem {blade.toprem.length:g} mm long"
    return faults.need(
        fits,
        "edge_radius",
        f"{blade.edge_radius:g} mm",
        f"at most {most:g} mm, the largest that fits {room}",
        f"{most:g} mm",
    )


def _axis_fault(faults: _Faults, blade: TriAcBlade) -> None:
    """The edge must not reach across the cutter's axis, neither at the tip nor at the shank."""
    across = [piece.at(s).x for piece in blade.outline(0.0) for s in (piece.low, piece.high)]
    reach = max(across) if blade.name == "inner" else -min(across)
    least = reach / math.cos(blade.eccentric_angle)
    faults.need(
        blade.radius > least,
        "radius",
        f"{blade.radius:g} mm",
        f"above {round_up(least):g} mm: the blade then keeps clear of the cutter's axis",
        "76 mm",
    )
