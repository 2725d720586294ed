"""Compliance of the cells of all pairs: half-space in each pair, teeth and bodies between all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from ._bearings import RIGID, Bearings, wrenches
from ._compliance import ToothCompliance
from ._hats import IMAGE
from ._love import mirrored, mirrored_grid, regular_grid, unlike
from ._patch import Patch

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Teeth:
    """Compliance of both members, and what half-spaces of both give together."""

    pinion: ToothCompliance
    wheel: ToothCompliance
    sense: int  # teeth of pair k stand k times this many teeth on, by rising left-hand angle
    bearings: Bearings = RIGID

    @property
    def plane_modulus(self) -> float:
        """E* of both, MPa."""
        moduli = (self.pinion.made_of.plane_modulus, self.wheel.made_of.plane_modulus)
        return 1.0 / sum(1.0 / e for e in moduli)


@dataclass(frozen=True, eq=False)
class Cells:
    """A patch whose cells know what they do to each other, and to the hats."""

    patch: Patch
    teeth: Teeth

    @cached_property
    def weights(self) -> tuple[tuple[Array, Array], ...]:
        """Of pinion and wheel, the hats (m,) that these cells lie under, and their weights (n, m)."""
        p, members = self.patch, (self.teeth.pinion, self.teeth.wheel)
        places = (p.pinion_place, p.wheel_place)
        return tuple(m.hats.over(*at) for m, at in zip(members, places, strict=True))

    @cached_property
    def half_space(self) -> Array:
        """Displacement (n, n), mm/N, of half-spaces with each cell's images beyond tips and ends."""
        p, whole = self.patch, self.patch.whole
        moduli = [m.made_of.plane_modulus for m in (self.teeth.pinion, self.teeth.wheel)]
        lines, weights = np.concatenate(p.lines), np.repeat(IMAGE / np.array(moduli), 3)
        (columns, rows), on = p.on.shape, p.on.ravel()
        grid = mirrored_grid(p.plane[:whole], lines, weights, *p.size)
        grid += regular_grid(columns, rows, *p.size)[np.ix_(on, on)] / self.teeth.plane_modulus
        grid *= 1.0 / (np.pi * p.size[0] * p.size[1])
        if not len(p.cut):
            return grid
        rest = unlike(p.plane, p.plane, p.corners, p.flat, whole) / self.teeth.plane_modulus
        for line, weight in zip(lines, weights, strict=True):
            if line[1:].any():
                rest += weight * unlike(mirrored(p.plane, line), p.plane, p.corners, p.flat, whole)
        rest *= 1.0 / np.pi
        return np.block([[grid, rest[:whole]], [rest[:whole].T, rest[whole:]]])

    @cached_property
    def wrenches(self) -> tuple[Array, Array]:
        """Wrenches (n, 6) on pinion and wheel of each cell's unit force."""
        contact = self.patch.meeting.contact
        mirrored = contact.pinion_flank.mirrored
        return wrenches(contact.mount, mirrored, self.patch.point, self.patch.normal)

    def by(self, other: Cells) -> Array:
        """Displacement (n, m), mm/N, of this pair's cells by forces on the other's."""
        here, there = self.patch.meeting.pair, other.patch.meeting.pair
        total = np.zeros((0, 0))
        members = (self.teeth.pinion, self.teeth.wheel)
        for member, (mine, weight), (others, by) in zip(
            members, self.weights, other.weights, strict=True
        ):
            moved = _between(member, here, there, self.teeth.sense)[np.ix_(mine, others)]
            own = weight @ (moved @ by.T)
            total = total + own if total.size else own
        bearings = self.teeth.bearings
        if not bearings.rigid:
            for held, mine, others in zip(
                (bearings.pinion, bearings.wheel), self.wrenches, other.wrenches, strict=True
            ):
                total += (mine @ held) @ others.T
        if here == there:
            total += self.half_space
        return total


def compliance(cells: Sequence[Cells], known: dict[tuple[int, int], Array] | None = None) -> Array:
    """Compliance (n, n), mm/N, of all cells; blocks that `known` has, by the cells' ids, are not computed again."""
    blocks = {} if known is None else known
    total = np.zeros((sum(c.patch.count for c in cells),) * 2)
    ends = parts([c.patch for c in cells])
    for i, one in enumerate(cells):
        for j, other in enumerate(cells[: i + 1]):
            key = id(one), id(other)
            if key not in blocks:
                blocks[key] = one.by(other)
            total[ends[i], ends[j]] = blocks[key]
            if i != j:
                total[ends[j], ends[i]] = blocks[key].T
    return total


def parts(patches: Sequence[Patch]) -> tuple[slice, ...]:
    """Which cells, counted through all patches, are each one's."""
    ends = np.cumsum([0, *(p.count for p in patches)])
    return tuple(slice(a, b) for a, b in pairwise(ends.tolist()))


def _between(member: ToothCompliance, k: int, other: int, sense: int) -> Array:
    """Displacement on pair k's tooth by hats on the other pair's; the half-space is left to a pair's own cells."""
    if k == other:
        return member.difference(0)
    return member.elastic[sense * (k - other) % member.teeth]
