"""From the blades of a summary sheet to the heads that cut."""

from __future__ import annotations

from hypoid.cutter import (
    BladeCurve,
    BladeName,
    BladeToprem,
    CircularProfile,
    FaceMillHead,
    Flankrem,
    MillBlade,
    ParabolicProfile,
    Toprem,
    TriAcBlade,
    TriAcHead,
)
from hypoid.flank import Side
from hypoid.pair import Head

from ._sheet_spec import BladeSpec, MemberSpec, StickBladeSpec


def sheet_head(name: str, member: MemberSpec, side: Side, reach: float) -> Head:
    """Head that cuts a flank of the member of that name; ``reach`` mm of blade serve in any case.

    Raises
    ------
    DesignError
        With every fault of the head and its blades.
    """
    paths = f"{name}.concave.blade", f"{name}.convex.blade"
    outer, inner = member.concave.blade, member.convex.blade
    if isinstance(outer, StickBladeSpec) and isinstance(inner, StickBladeSpec):
        sticks = _stick("outer", outer, reach), _stick("inner", inner, reach)
        assert member.blade_groups is not None
        head = TriAcHead(member.blade_groups, *sticks, spacing=member.spacing)
        return head.checked(f"{name}.cutter", paths)
    assert isinstance(outer, BladeSpec)
    assert isinstance(inner, BladeSpec)
    together = (outer if side == "concave" else inner).land is not None
    return FaceMillHead(
        outer=_mill("outer", outer, reach) if together or side == "concave" else None,
        inner=_mill("inner", inner, reach) if together or side == "convex" else None,
    ).checked(f"{name}.cutter", paths)


def _stick(name: BladeName, spec: StickBladeSpec, reach: float) -> TriAcBlade:
    return TriAcBlade(
        name,
        radius=spec.radius,
        blade_angle=spec.angle,
        height=spec.reference_height,
        edge_radius=spec.edge_radius,
        shank_height=(spec.height or spec.reference_height + reach) - spec.reference_height,
        eccentric_angle=spec.eccentric_angle,
        hook_angle=spec.hook_angle,
        rake_angle=spec.side_rake_angle,
        curve_radius=spec.curve_radius,
        toprem=spec.toprem and BladeToprem(spec.toprem[1], spec.toprem[0], spec.toprem[2]),
    )


def _mill(name: BladeName, spec: BladeSpec, reach: float) -> MillBlade:
    return MillBlade(
        name=name,
        point_radius=spec.point_radius,
        angle=spec.angle,
        edge_radius=spec.edge_radius,
        land=_land(spec),
        height=spec.height or reach,
        profile=_curve(spec),
        toprem=None if spec.toprem is None else Toprem(*spec.toprem),
        flankrem=None if spec.flankrem is None else Flankrem(*spec.flankrem),
    )


def _curve(blade: BladeSpec) -> BladeCurve | None:
    if blade.curve == "circular-arc":
        return CircularProfile(blade.curve_radius, blade.reference_height)
    if blade.curve == "parabola":
        return ParabolicProfile(blade.curve_coefficient, blade.reference_height)
    return None


def _land(blade: BladeSpec) -> float:
    """Flat at the tips, mm: half the point width, or all that an edge arc may want of a blade alone."""
    if blade.land is not None:
        return blade.land
    return max(0.5 * blade.point_radius, 1.2 * blade.edge_radius)
