"""What is wrong with a face-mill blade: every fault at once, each with the admissible range."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from hypoid.geometry import Problem

from ._mill_blade import CircularProfile, MillBlade, ParabolicProfile

LEAST, MOST = math.radians(-10.0), math.radians(60.0)  # every part of an edge leans between these
REMOVAL = math.radians(30.0)  # Toprem and Flankrem turn by less
LEANS = "-10 and 60 deg"


def _positive(value: float) -> bool:
    return math.isfinite(value) and value > 0.0


def _shown(angle: float) -> str:
    return f"{math.degrees(angle):.4g} deg"


def _below(angle: float) -> str:
    return f"an angle above 0 and below {round_down(math.degrees(angle), 2):g} deg"


def round_down(value: float, digits: int = 4) -> float:
    """A limit never above itself (but for 1e-6 of a digit), so that what is printed is admissible."""
    return math.floor(value * 10.0**digits + 1e-6) / 10.0**digits


def round_up(value: float, digits: int = 4) -> float:
    """A limit never below itself (but for 1e-6 of a digit), so that what is printed is admissible."""
    return -round_down(-value, digits)


class _Faults:
    """Problems of one blade as they are found, and which measures they are about."""

    def __init__(self, path: str) -> None:
        self.path = path
        self.problems: list[Problem] = []

    def need(self, ok: bool, key: str, given: str, expected: str, example: str) -> bool:
        if not ok:
            where = f"{self.path}.{key}"
            shown = example if example.startswith("{") else f'"{example}"'
            shown = f"{key.split('.')[-1]} = {shown}"
            self.problems.append(Problem(where, given, expected, shown))
        return ok

    def length(self, value: float, key: str, example: str, least_zero: bool = False) -> bool:
        ok = _positive(value) or (least_zero and value == 0.0)
        expected = "a length of at least 0 mm" if least_zero else "a length above 0 mm"
        return self.need(ok, key, f"{value:g} mm", expected, example)


def blade_faults(blade: MillBlade, path: str = "cutter") -> list[Problem]:
    """Every fault of a face-mill blade; empty where it can be drawn. ``path`` begins each path."""
    faults = _Faults(path)
    radius = faults.length(blade.point_radius, "point_radius", "114.3 mm")
    land = faults.length(blade.land, "land", "1 mm")
    edge = faults.length(blade.edge_radius, "edge_radius", "0.5 mm", least_zero=True)
    height = faults.length(blade.height, "height", "15 mm")
    angle = faults.need(
        LEAST < blade.angle < MOST,
        "angle",
        _shown(blade.angle),
        f"a blade angle between {LEANS}",
        "20 deg",
    )
    drawn = angle and height and _profile_faults(faults, blade)
    if not drawn:
        return faults.problems
    toprem, flankrem = _toprem_faults(faults, blade), _flankrem_faults(faults, blade)
    if toprem and edge and land:
        _edge_radius_fault(faults, blade if flankrem else replace(blade, flankrem=None))
    if toprem and flankrem and land and radius:
        _axis_fault(faults, replace(blade, edge_radius=0.0))
    return faults.problems


def _profile_faults(faults: _Faults, blade: MillBlade) -> bool:
    """Whether a curved profile keeps its lean from tip to shank."""
    curve, key = blade.profile, "profile.reference_height"
    if curve is None:
        return True
    at = curve.reference_height
    ok = faults.need(
        0.0 <= at <= blade.height,
        key,
        f"{at:g} mm",
        f"a height on the blade, 0 to {blade.height:g} mm above the tips",
        f"{0.5 * blade.height:.3g} mm",
    )
    circular = isinstance(curve, CircularProfile)
    value = curve.radius if circular else curve.coefficient
    key = "profile.radius" if circular else "profile.coefficient"
    unit, example = ("mm", "800 mm") if circular else ("/mm", "0.0005 /mm")
    known = math.isfinite(value) and not (circular and value == 0.0)
    known = faults.need(
        known,
        key,
        f"{value:g} {unit}",
        "a signed radius other than 0" if circular else "a signed number",
        example,
    )
    if not (ok and known):
        return False
    most = _most_bend(curve, blade.angle, blade.height, (1.0 / value if circular else value) > 0.0)
    if circular:
        limit = f"a radius of at least {round_up(1.0 / most):g} mm" if most else ""
        return faults.need(
            abs(value) * most > 1.0,
            key,
            f"{value:g} mm",
            f"{limit} in amount: the edge then leans between {LEANS} from tip to shank",
            example,
        )
    return faults.need(
        abs(value) < most,
        key,
        f"{value:g} /mm",
        f"less than {round_down(most, 7):g} /mm in amount: "
        f"the edge then leans between {LEANS} from tip to shank",
        example,
    )


def _most_bend(
    curve: CircularProfile | ParabolicProfile, angle: float, height: float, crowns: bool
) -> float:
    """Curvature, or parabola coefficient, at which some end of the edge leans too much, 1/mm.

    Along an arc the sine of the lean changes by curvature times depth; along a parabola the tangent
    of its turn is 2 c s.
    """

    def gain(lean: float) -> float:
        if isinstance(curve, CircularProfile):
            return abs(math.sin(lean) - math.sin(angle))
        turn = math.tan(lean - angle)
        return abs(0.5 * turn * math.cos(angle) - 0.25 * turn * turn * math.sin(angle))

    to_shank, to_tip = height - curve.reference_height, curve.reference_height
    at_shank, at_tip = (MOST, LEAST) if crowns else (LEAST, MOST)
    return min(
        gain(lean) / way for lean, way in ((at_shank, to_shank), (at_tip, to_tip)) if way > 0.0
    )


def _toprem_faults(faults: _Faults, blade: MillBlade) -> bool:
    """Whether Toprem, if any, can be drawn."""
    toprem = blade.toprem
    if toprem is None:
        return True
    end, what = blade.height, "the blade's height"
    if blade.flankrem and 0.0 < blade.flankrem.height < blade.height:
        end, what = blade.flankrem.height, "the start of Flankrem"
    ok = faults.need(
        0.0 < toprem.height < end,
        "toprem.height",
        f"{toprem.height:g} mm",
        f"a height above 0 and below {end:g} mm, {what}",
        f"{min(1.5, 0.2 * end):.3g} mm",
    )
    kink = min(max(toprem.height, 0.0), blade.height) if math.isfinite(toprem.height) else 0.0
    most = min(blade.line.at(blade.line.at_depth(kink)).lean - LEAST, REMOVAL)
    turned = faults.need(
        0.0 < toprem.angle < most,
        "toprem.angle",
        _shown(toprem.angle),
        _below(most),
        _shown(0.2 * most),
    )
    return ok and turned


def _flankrem_faults(faults: _Faults, blade: MillBlade) -> bool:
    """Whether Flankrem, if any, can be drawn."""
    flankrem = blade.flankrem
    if flankrem is None:
        return True
    begins = faults.need(
        0.0 < flankrem.height < blade.height,
        "flankrem.height",
        f"{flankrem.height:g} mm",
        f"a height above 0 and below {blade.height:g} mm, the blade's height",
        f"{0.7 * blade.height:.3g} mm",
    )
    angle, coefficient = flankrem.angle, flankrem.coefficient
    one = faults.need(
        (angle == 0.0) != (coefficient == 0.0),
        "flankrem",
        f"angle {_shown(angle)} and coefficient {coefficient:g} /mm",
        "an angle for a straight Flankrem, or a coefficient for a parabola, and not both",
        '{height = "10 mm", angle = "2 deg"}',
    )
    if not (begins and one):
        return False
    start = blade.line.at_depth(flankrem.height)
    if angle:
        most = min(MOST - blade.line.at(start).lean, REMOVAL)
        return faults.need(
            0.0 < angle < most,
            "flankrem.angle",
            _shown(angle),
            _below(most),
            _shown(0.2 * most),
        )

    def holds(value: float) -> bool:
        piece = replace(blade.line, relief=value, relief_from=start)
        end = piece.at_depth(blade.height)
        return math.isfinite(end) and LEAST < piece.at(end).lean < MOST

    ok = _positive(coefficient) and holds(coefficient)
    limit = _largest(holds, coefficient) if _positive(coefficient) and not ok else 0.0
    return faults.need(
        ok,
        "flankrem.coefficient",
        f"{coefficient:g} /mm",
        f"above 0 and at most {round_down(limit, 7):g} /mm: the edge then leans less than 60 deg at the shank"
        if limit
        else "a coefficient above 0",
        "0.004 /mm",
    )


def _largest(holds: Callable[[float], bool], top: float) -> float:
    """Greatest value below ``top``, which does not hold, that holds; 0 does."""
    low, high = 0.0, min(top, 1e6)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


def _fits(blade: MillBlade, radius: float) -> bool:
    """Whether the arc is tangent to the flat at the tip and to the edge that comes next."""
    land, *edge = replace(blade, edge_radius=radius, flankrem=None).outline
    after = edge[1] if radius else edge[0]
    end = after.high
    if blade.flankrem and not blade.toprem:
        end = min(end, after.at_depth(blade.flankrem.height))
    return land.low <= 1e-9 and after.low < end


def _edge_radius_fault(faults: _Faults, blade: MillBlade) -> None:
    """The edge radius that the land, the blade angle and Toprem leave room for."""
    least = round_up(-replace(blade, edge_radius=0.0).outline[0].start[0])
    if not faults.need(
        _fits(blade, 0.0),
        "land",
        f"{blade.land:g} mm",
        f"above {least:g} mm, where the curved flank meets the plane of the tips",
        f"{least + 0.5:g} mm",
    ):
        return
    fits = _fits(blade, blade.edge_radius)
    most = 0.0 if fits else round_down(_largest(lambda r: _fits(blade, r), blade.edge_radius))
    room = f"a land of {blade.land:g} mm (sharp corner to the middle of the slot)"
    if blade.toprem:
        room += f" and a Toprem {blade.toprem.height:g} mm high"
    faults.need(
        fits,
        "edge_radius",
        f"{blade.edge_radius:g} mm",
        f"at most {most:g} mm, the largest that fits {room} at {_shown(blade.angle)}",
        f"{most:g} mm",
    )


def _axis_fault(faults: _Faults, blade: MillBlade) -> None:
    """The edge must not reach the cutter's axis, neither at the tip nor at the shank."""
    across = [piece.at(s).x for piece in blade.outline for s in (piece.low, piece.high)]
    reach = max(across) if blade.name == "inner" else -min(across)
    faults.need(
        blade.point_radius > reach,
        "point_radius",
        f"{blade.point_radius:g} mm",
        f"above {round_up(reach):g} mm: the blade then keeps clear of the cutter's axis",
        "114.3 mm",
    )
