"""Face-mill head, and the cup-shaped grinding wheel: blades whose turn about the axis makes surfaces.

Frame of the cutter: z along its axis, positive to the blade tips, z = 0 in the plane of the tips; at
theta = 0 the edge lies in the x-z plane. With u from the sharp corner to the shank a straight edge is
(r_p + u sin(angle), 0, -u cos(angle)) on the outside blade and (r_p - u sin(angle), 0, -u cos(angle))
on the inside blade [tsay1993, (1)-(4); lin1996, (1)]. A grinding wheel has the same meridian.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias, TypeVar

from hypoid.geometry import DesignError, Problem

from ._edge import EdgePiece
from ._mill_blade import BladeCurve, Flankrem, MillBlade, Toprem
from ._mill_faults import blade_faults, round_up
from ._profile import BladeName, placed

T = TypeVar("T")
Both: TypeAlias = T | tuple[T, T]  # one value for both blades, or (outer, inner)


@dataclass(frozen=True)
class FaceMillHead:
    """Face-mill head or cup-shaped wheel: its outside and inside blade, or one of them (mm, rad).

    With both blades it may cut both flanks at once (spread blade); for fixed setting and single side
    each flank has a head of its own. ``spread_blade`` and ``from_point_diameters`` raise DesignError
    with every fault; a head built plainly is checked by ``checked`` and when its pieces are asked for.
    """

    outer: MillBlade | None = None
    inner: MillBlade | None = None

    @classmethod
    def spread_blade(
        cls,
        diameter: float,
        point_width: float,
        outer_angle: float,
        inner_angle: float,
        height: float,
        *,
        edge_radius: Both[float] = 0.0,
        profile: Both[BladeCurve | None] = None,
        toprem: Both[Toprem | None] = None,
        flankrem: Both[Flankrem | None] = None,
        path: str = "cutter",
        blade_paths: tuple[str, str] | None = None,
    ) -> FaceMillHead:
        """Head by its mean (nominal) diameter and point width, mm: point radii d/2 +- W/2.

        Each blade's land ends in the middle of the slot. ``path`` and ``blade_paths`` (outer, inner)
        begin the paths in a DesignError.
        """
        problems = [
            *_length_faults(path, "diameter", diameter, "228.6 mm"),
            *_length_faults(path, "point_width", point_width, "2 mm"),
        ]
        if not problems and point_width >= diameter:
            given, limit = f"{point_width:g} mm", f"below the cutter's diameter of {diameter:g} mm"
            problems.append(Problem(f"{path}.point_width", given, limit, 'point_width = "2 mm"'))
        return _head(
            problems,
            (0.5 * (diameter + point_width), 0.5 * (diameter - point_width)),
            (outer_angle, inner_angle),
            height,
            edge_radius,
            (profile, toprem, flankrem),
            (path, blade_paths),
        )

    @classmethod
    def from_point_diameters(
        cls,
        outer_point_diameter: float,
        inner_point_diameter: float,
        outer_angle: float,
        inner_angle: float,
        height: float,
        *,
        edge_radius: Both[float] = 0.0,
        profile: Both[BladeCurve | None] = None,
        toprem: Both[Toprem | None] = None,
        flankrem: Both[Flankrem | None] = None,
        path: str = "cutter",
        blade_paths: tuple[str, str] | None = None,
    ) -> FaceMillHead:
        """Head by the point diameters of both blades, mm; the rest as for ``spread_blade``."""
        outer, inner = outer_point_diameter, inner_point_diameter
        problems = [
            *_length_faults(path, "outer_point_diameter", outer, "230.6 mm"),
            *_length_faults(path, "inner_point_diameter", inner, "226.6 mm"),
        ]
        if not problems and outer <= inner:
            where, given = f"{path}.outer_point_diameter", f"{outer:g} mm"
            limit = f"above the inner point diameter of {inner:g} mm"
            problems.append(Problem(where, given, limit, 'outer_point_diameter = "230.6 mm"'))
        return _head(
            problems,
            (0.5 * outer, 0.5 * inner),
            (outer_angle, inner_angle),
            height,
            edge_radius,
            (profile, toprem, flankrem),
            (path, blade_paths),
        )

    def blade(self, name: BladeName) -> MillBlade | None:
        """The blade of a side, if the head has it."""
        return self.outer if name == "outer" else self.inner

    def faults(
        self, path: str = "cutter", blade_paths: tuple[str, str] | None = None
    ) -> list[Problem]:
        """Every fault of the head and its blades; none where it can be drawn.

        ``path`` begins the head's own paths; ``blade_paths`` those of its outer and inner blade,
        else they are ``path.outer`` and ``path.inner``.
        """
        paths = blade_paths or (f"{path}.outer", f"{path}.inner")
        problems: list[Problem] = []
        if self.outer is None and self.inner is None:
            problems.append(
                Problem(path, "no blade", "an outer or an inner blade, or both", "outer = {...}")
            )
        for blade, name, where in zip(
            (self.outer, self.inner), ("outer", "inner"), paths, strict=True
        ):
            if blade is None:
                continue
            if blade.name != name:
                problems.append(
                    Problem(f"{where}.name", repr(blade.name), repr(name), f'name = "{name}"')
                )
            problems += blade_faults(blade, where)
        if not problems and self.outer and self.inner:
            problems += _slot_faults(self.outer, self.inner, path, paths)
        return problems

    def checked(
        self, path: str = "cutter", blade_paths: tuple[str, str] | None = None
    ) -> FaceMillHead:
        """The same head; DesignError with all its faults if there are any."""
        if problems := self.faults(path, blade_paths):
            raise DesignError(problems)
        return self

    def pieces(self, name: BladeName) -> dict[str, EdgePiece]:
        """Edge pieces of a blade in the cutter frame by name, from the tip to the shank (mm).

        The names are land, fillet (unless the corner is sharp), toprem (if any), flank and flankrem
        (if straight); see ``MillBlade.outline`` for how each counts s. DesignError if the head has faults
        or no such blade.
        """
        blade = self.checked().blade(name)
        if blade is None:
            problem = Problem(
                f"cutter.{name}",
                "no blade",
                f"an {name} blade for the flank that it cuts",
                f"{name} = {{...}}",
            )
            raise DesignError([problem])
        side = 1.0 if name == "outer" else -1.0
        return placed(blade.outline, blade.point_radius, (side, 0.0))


def _head(
    problems: list[Problem],
    point_radii: tuple[float, float],
    angles: tuple[float, float],
    height: float,
    edge_radius: Both[float],
    shapes: tuple[Both[BladeCurve | None], Both[Toprem | None], Both[Flankrem | None]],
    paths: tuple[str, tuple[str, str] | None],
) -> FaceMillHead:
    """Head of two blades that share a slot, or DesignError with the problems so far and all others."""
    misplaced = bool(
        problems
    )  # a huge slot stands in, so that the blades' own faults are told, too
    outer, inner = (1e9, 0.5e9) if misplaced else point_radii

    def blade(name: BladeName, second: bool) -> MillBlade:
        radius = _of_side(edge_radius, second)
        return MillBlade(
            name,
            point_radius=inner if second else outer,
            angle=angles[second],
            edge_radius=min(radius, 0.0) if misplaced else radius,
            land=0.5 * (outer - inner),
            height=height,
            profile=_of_side(shapes[0], second),
            toprem=_of_side(shapes[1], second),
            flankrem=_of_side(shapes[2], second),
        )

    head = FaceMillHead(blade("outer", False), blade("inner", True))
    if problems := [*problems, *head.faults(*paths)]:
        raise DesignError(problems)
    return head


def _of_side(value: Both[T], second: bool) -> T:
    if isinstance(value, tuple):
        return value[second]
    return value


def _length_faults(path: str, key: str, value: float, example: str) -> list[Problem]:
    if math.isfinite(value) and value > 0.0:
        return []
    where = f"{path}.{key}"
    return [Problem(where, f"{value:g} mm", "a length above 0 mm", f'{key} = "{example}"')]


def _slot_faults(
    outer: MillBlade, inner: MillBlade, path: str, paths: tuple[str, str]
) -> list[Problem]:
    """Whether both blades fit one slot: their order, their lands and their edge arcs."""
    width = outer.point_radius - inner.point_radius
    if width <= 0.0:
        radii = f"point radii {outer.point_radius:g} mm outside, {inner.point_radius:g} mm inside"
        expected = "an outer point radius above the inner one"
        return [Problem(f"{path}.point_width", radii, expected, 'point_width = "2 mm"')]
    problems: list[Problem] = []
    for blade, where in zip((outer, inner), paths, strict=True):
        if blade.land > width + 1e-9:
            given, expected = f"{blade.land:g} mm", f"at most the point width of {width:g} mm"
            problems.append(
                Problem(f"{where}.land", given, expected, f'land = "{0.5 * width:g} mm"')
            )
    needed = -outer.outline[0].start[0] - inner.outline[0].start[0]  # flats begin at these
    if not problems and needed > width + 1e-9:
        given = f"{width:g} mm with edge radii {outer.edge_radius:g} and {inner.edge_radius:g} mm"
        expected = f"at least {round_up(needed):g} mm, so that the two edge arcs leave no fin"
        example = f'point_width = "{round_up(needed):g} mm"'
        problems.append(Problem(f"{path}.point_width", given, expected, example))
    return problems
