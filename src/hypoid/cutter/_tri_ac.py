"""Tri-Ac face-hob head: groups of an outer and an inner stick blade with hook and side rake.

Frame of the cutter: z along its axis, positive to the blade tips, z = 0 in the plane of the tips; the
pitch point P of an outer blade lies on the x axis at its blade radius. All is for a left-hand member:
its cutter turns by -theta, so rising theta moves P along -y, where a positive hook sends the tip ahead.
A right-hand member's head is the mirror image with the same numbers, as its settings are.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hypoid.geometry import DesignError, Problem

from ._edge import EdgePiece
from ._mill_faults import round_down, round_up
from ._profile import BladeName, placed
from ._tri_ac_blade import TriAcBlade
from ._tri_ac_faults import tri_ac_blade_faults


@dataclass(frozen=True)
class TriAcHead:
    """Tri-Ac face-hob head: its blade groups, each of an outer and an inner blade (mm, rad).

    A head built plainly is checked by ``checked`` and when its pieces are asked for.
    """

    blade_groups: int  # N_b
    outer: TriAcBlade
    inner: TriAcBlade
    spacing: float | None = None  # turn by which an inner blade follows its outer one; None: pi/N_b

    def blade(self, name: BladeName) -> TriAcBlade:
        """The blade of a side."""
        return self.outer if name == "outer" else self.inner

    @property
    def following(self) -> float:
        """Turn by which the inner blade of a group comes after the outer one, rad."""
        return math.pi / self.blade_groups if self.spacing is None else self.spacing

    @property
    def base_radius(self) -> float:
        """Distance of the blades' planes from the cutter axis, r_b sin(eps_b), mean of both, mm."""
        blades = (self.outer, self.inner)
        return 0.5 * sum(blade.radius * math.sin(blade.eccentric_angle) for blade in blades)

    @property
    def _apart(self) -> float:
        """How much further out along its plane the outer blade's P stands, mm."""
        outer, inner = (b.radius * math.cos(b.eccentric_angle) for b in (self.outer, self.inner))
        return outer - inner

    @property
    def pitch_slot(self) -> float:
        """Normal width of the slot between both blades' cuts at the height of P, mm.

        For work that passes square to the blades' planes, 2 r_b sin(eps_b) = N_b m_n, as it does
        about where the slope angle of a face-hob head is chosen for; it moves by r_b sin(eps_b) per
        radian of the cutter.
        """
        return self.following * self.base_radius + self._apart

    @property
    def tip_slot(self) -> float:
        """The same at the bottom, from edge to edge, mm: what both flats have to clear."""
        return self.pitch_slot + self.outer.tip + self.inner.tip

    def faults(
        self, path: str = "cutter", blade_paths: tuple[str, str] | None = None
    ) -> list[Problem]:
        """Every fault of the head and its blades; none where it can be drawn.

        ``path`` begins the head's own paths; ``blade_paths`` those of its outer and inner blade,
        else they are ``path.outer`` and ``path.inner``.
        """
        paths = blade_paths or (f"{path}.outer", f"{path}.inner")
        problems = self._own_faults(path)
        blades = zip((self.outer, self.inner), ("outer", "inner"), paths, strict=True)
        for blade, name, where in blades:
            if blade.name != name:
                problems.append(
                    Problem(f"{where}.name", repr(blade.name), repr(name), f'name = "{name}"')
                )
            problems += tri_ac_blade_faults(blade, where)
        return problems or _slot_faults(self, path, paths) or _land_faults(self, paths)

    def _own_faults(self, path: str) -> list[Problem]:
        if self.blade_groups < 1:
            given, example = str(self.blade_groups), "blade_groups = 13"
            return [Problem(f"{path}.blade_groups", given, "at least 1 blade group", example)]
        whole = 2.0 * math.pi / self.blade_groups
        if 0.0 < self.following < whole:
            return []
        return [
            Problem(
                f"{path}.spacing",
                _degrees(self.following),
                f"an angle above 0 and below {_degrees(whole)}, the turn from one group to the next",
                f'spacing = "{_degrees(0.5 * whole)}"',
            )
        ]

    def checked(
        self, path: str = "cutter", blade_paths: tuple[str, str] | None = None
    ) -> TriAcHead:
        """The head itself; DesignError with all its faults if it has any."""
        if problems := self.faults(path, blade_paths):
            raise DesignError(problems)
        return self

    def pieces(self, name: BladeName) -> dict[str, EdgePiece]:
        """Edge pieces of a blade in the cutter frame by name, from the tip to the shank (mm).

        The names are land, fillet (unless the corner is sharp), toprem (if any) and flank, whose s is 0
        at P. P, not the tip, stands at r_b (notes of 2005, item 7). The inner blade is that of the group
        before, so that both cut flanks of one tooth, as in ``FaceHobHead``. DesignError on faults.
        """
        blade = self.checked().blade(name)
        side = 1.0 if name == "outer" else -1.0
        across, up = blade.rake_plane
        cosine, sine = math.cos(blade.eccentric_angle), math.sin(blade.eccentric_angle)
        pieces = placed(
            blade.outline(0.5 * self.tip_slot if blade.land is None else blade.land),
            blade.radius,
            (side * cosine + across * sine, across * cosine - side * sine),
            lean=(up * sine, up * cosine),
            level=-blade.height,
        )
        if name == "outer":
            return pieces
        phase = self.following - 2.0 * math.pi / self.blade_groups
        return {key: piece.turned(phase) for key, piece in pieces.items()}


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.4g} deg"


def _slot_faults(head: TriAcHead, path: str, paths: tuple[str, str]) -> list[Problem]:
    """Whether both blades leave a slot between their edges and a tooth from one slot to the next."""
    outer, base, turn = head.outer, head.base_radius, head.following
    needed, whole = -outer.tip - head.inner.tip, 2.0 * math.pi / head.blade_groups
    pitch = whole * base if base > 1e-3 * outer.radius else math.inf  # inf: radial blades, any work
    if needed < head.pitch_slot < pitch:
        return []
    given = f"a slot of {head.pitch_slot:.4g} mm at the pitch points"
    if pitch <= needed:
        given = f"{outer.edge_radius:g} and {head.inner.edge_radius:g} mm"
        taken = f"the edges take {needed:.4g} mm of a pitch of {pitch:.4g} mm"
        return [
            Problem(
                f"{paths[0]}.edge_radius",
                given,
                f"smaller edge radii or a lower pitch point: {taken}",
                f'edge_radius = "{0.5 * outer.edge_radius:g} mm"',
            )
        ]
    why = "both edges then leave a slot and a tooth"
    if pitch < math.inf:
        low = round_up(math.degrees(max(0.0, (needed - head._apart) / base)), 3)
        high = round_down(math.degrees(min(whole, whole - head._apart / base)), 3)
        if low < high:
            return [
                Problem(
                    f"{path}.spacing",
                    f"{_degrees(turn)}, {given}",
                    f"an angle above {low:g} and below {high:g} deg: {why}",
                    f'spacing = "{0.5 * (low + high):.4g} deg"',
                )
            ]
    # what 1 mm of radius adds to the slot, and to the slot less the pitch
    sine, cosine = math.sin(outer.eccentric_angle), math.cos(outer.eccentric_angle)
    low = outer.radius + (needed - head.pitch_slot) / (cosine + 0.5 * turn * sine)
    high = outer.radius + (pitch - head.pitch_slot) / (cosine - 0.5 * (whole - turn) * sine)
    limit = f"above {round_up(low):g} mm"
    if high < math.inf:
        limit += f" and below {round_down(high):g} mm"
    return [
        Problem(
            f"{paths[0]}.radius",
            f"{outer.radius:g} mm with {head.inner.radius:g} mm inside, {given}",
            f"{limit}: {why}",
            f'radius = "{0.5 * (low + min(high, low + 2.0)):.6g} mm"',
        )
    ]


def _land_faults(head: TriAcHead, paths: tuple[str, str]) -> list[Problem]:
    """Whether the flats stay clear of the slot's other side, and leave no fin between them."""
    width, problems = head.tip_slot, list[Problem]()
    lands = [blade.land for blade in (head.outer, head.inner)]
    for land, where in zip(lands, paths, strict=True):
        if land is not None and land > width + 1e-9:
            limit = f"at most {round_down(width):g} mm, the width of the slot's bottom"
            example = f'land = "{0.6 * width:.3g} mm"'
            problems.append(Problem(f"{where}.land", f"{land:g} mm", limit, example))
    covered = sum(0.5 * width if land is None else land for land in lands)
    if not problems and covered < width - 1e-9:
        shorter, other = sorted(0.5 * width if land is None else land for land in lands)
        side = 0 if lands[0] == shorter else 1
        limit = f"at least {round_up(width - other):g} mm, so that both flats leave no fin"
        example = f'land = "{round_up(width - other):g} mm"'
        problems.append(Problem(f"{paths[side]}.land", f"{shorter:g} mm", limit, example))
    return problems
