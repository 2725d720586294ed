"""One position under torque: windows that follow the contact, and the contact of all pairs at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from scipy import sparse

from ._active_set import ContactSolution, Outcome, solve_contact
from ._compliance import ToothCompliance
from ._hats import IMAGE
from ._love import mirrored_grid, regular_grid
from ._patch import COLUMNS, ROWS, Meeting, Patch, Window, patch

Array = np.ndarray[Any, Any]
TRIES = 14  # windows that are tried
GROW, MARGIN = (
    0.3,
    0.1,
)  # of the contact's length: a side that is touched moves out, others stand off
USED = 0.55  # of a window's length that the contact fills, at least
EDGE = 0.3  # mm from tip, toe, heel or fillet limit: pressure there is an edge's, and moves with the cells
FILLED = 0.45  # share of a patch, nearest first, that is thought to touch


@dataclass(frozen=True)
class Teeth:
    """Compliance of both members, and what half-spaces of both give together."""

    pinion: ToothCompliance
    wheel: ToothCompliance
    sense: int  # teeth of pair k stand k times this many teeth on, by rising left-hand angle

    @property
    def plane_modulus(self) -> float:
        """E* of both, MPa."""
        moduli = (self.pinion.made_of.plane_modulus, self.wheel.made_of.plane_modulus)
        return 1.0 / sum(1.0 / e for e in moduli)


@dataclass(frozen=True, eq=False)
class PositionContact:
    """Loaded contact at one position under one torque."""

    patches: tuple[Patch, ...]
    solution: ContactSolution
    outcome: Outcome
    open_window: bool  # a contact still ends at a window's border that is no edge

    @property
    def parts(self) -> tuple[slice, ...]:
        """Which cells of the solution are each patch's."""
        return _parts(self.patches)

    @property
    def windows(self) -> dict[int, Window]:
        return {p.meeting.pair: p.window for p in self.patches}


def position_contact(
    meetings: Sequence[Meeting],
    teeth: Teeth,
    torque: float,
    windows: Mapping[int, Window] | None = None,
) -> PositionContact:
    """Contact of all pairs that can touch under a torque on the pinion, N mm; `windows` to start from, by pair."""
    known = dict(windows or {})
    ranked = sorted(meetings, key=lambda m: m.gap)
    chosen = [m for m in ranked if m.gap <= ranked[0].gap + 1e-3 or m.pair in known]
    patches = {
        m.pair: patch(m, known.get(m.pair) or _first_window(m, teeth, torque / len(chosen)))
        for m in chosen
    }
    touched: dict[int, Array] = {}
    found: PositionContact | None = None
    for _ in range(TRIES):
        used = [p for p in patches.values() if p.count]
        if not used:
            break
        solution = _solve(used, teeth, torque, touched)
        touched = {
            p.meeting.pair: solution.touching[part]
            for p, part in zip(used, _parts(used), strict=True)
        }
        found = PositionContact(tuple(used), solution, solution.outcome, True)
        if solution.outcome is not Outcome.OK:
            break
        closing = {m.pair: solution.rotation * m.lever for m in ranked}
        late = [m for m in ranked if m.pair not in patches and m.gap < closing[m.pair]]
        moved = {
            p.meeting.pair: after
            for p, part in zip(used, found.parts, strict=True)
            if (after := _moved(p, solution.force[part])) is not None
        }
        if not moved and not late:
            return PositionContact(tuple(used), solution, Outcome.OK, False)
        for m in late:
            patches[m.pair] = patch(
                m, known.get(m.pair) or _first_window(m, teeth, torque / len(ranked))
            )
        for p in used:
            if (window := moved.get(p.meeting.pair)) is not None:
                patches[p.meeting.pair] = patch(p.meeting, window)
                del touched[p.meeting.pair]
    if found is None:
        nothing = ContactSolution(np.zeros(0), 0.0, np.zeros(0), 0, Outcome.NO_CONTACT)
        return PositionContact((), nothing, Outcome.NO_CONTACT, False)
    return found


def _first_window(met: Meeting, teeth: Teeth, torque: float) -> Window:
    """Where a line contact of this force would be: half lengths by the approach it needs."""
    force = max(torque, 1.0) / max(met.lever, 1e-3)
    low, high = met.curvature
    approach = (6.0 * force / (np.pi * teeth.plane_modulus * np.sqrt(8.0 / low))) ** (2.0 / 3.0)
    flank = met.contact.pinion_flank
    most = 2.0 * float(flank.tip.at(flank.heel) - flank.root.at(flank.heel))
    a, b = (min(1.2 * np.sqrt(2.0 * approach / c), most) for c in (low, high))
    return Window((-a, a), (-min(b, a), min(b, a)))


def _parts(patches: Sequence[Patch]) -> tuple[slice, ...]:
    ends = np.cumsum([0, *(p.count for p in patches)])
    return tuple(slice(a, b) for a, b in pairwise(ends.tolist()))


def _solve(
    patches: Sequence[Patch], teeth: Teeth, torque: float, touched: Mapping[int, Array]
) -> ContactSolution:
    """Contact of these cells; where it is not known which touch, those with the least gaps of their patch."""
    gap = np.concatenate([p.gap for p in patches])
    lever = np.concatenate([p.pinion_lever for p in patches])
    start = np.concatenate(
        [
            touched[p.meeting.pair]
            if p.meeting.pair in touched
            else p.gap <= np.quantile(p.gap, FILLED)
            for p in patches
        ]
    )
    return solve_contact(compliance(patches, teeth), gap, lever, torque, start)


def compliance(patches: Sequence[Patch], teeth: Teeth) -> Array:
    """Compliance (n, n), mm/N, of all cells: half-space in each pair, and the teeth."""
    total = np.zeros((0, 0))
    for member, places in (
        (teeth.pinion, [p.pinion_place for p in patches]),
        (teeth.wheel, [p.wheel_place for p in patches]),
    ):
        weights: Any = sparse.block_diag([member.hats.weights(*at) for at in places], format="csr")
        pairs = [p.meeting.pair for p in patches]
        full = np.block(
            [[_between(member, k, other, teeth.sense) for other in pairs] for k in pairs]
        )
        own = weights @ (weights @ full).T
        total = own if not total.size else total + own
    at = 0
    for p in patches:
        on = p.on.ravel()
        cells = regular_grid(COLUMNS, ROWS, *p.size)[np.ix_(on, on)] / teeth.plane_modulus
        for member, tip in zip((teeth.pinion, teeth.wheel), p.tips, strict=True):
            image = mirrored_grid(p.plane[:, 0], p.plane[:, 1], tip, *p.size)
            cells += IMAGE * image / member.made_of.plane_modulus
        block = slice(at, at + p.count)
        total[block, block] += cells / (np.pi * p.size[0] * p.size[1])
        at += p.count
    return 0.5 * (total + total.T)


def _between(member: ToothCompliance, k: int, other: int, sense: int) -> Array:
    """Displacement on pair k's tooth by hats on the other pair's; the half-space is left to a pair's own cells."""
    if k == other:
        return member.difference(0)
    return member.elastic[sense * (k - other) % member.teeth]


def _moved(p: Patch, force: Array) -> Window | None:
    """The window that fits the contact better, None where this one does."""
    touching = np.zeros(p.on.shape, dtype=bool)
    touching[p.on] = force > 0.0
    if not touching.any():
        return None
    there = []
    for axis, (window, count) in enumerate(((p.window.along, COLUMNS), (p.window.across, ROWS))):
        used = np.flatnonzero(touching.any(axis=1 - axis))
        size = (window[1] - window[0]) / count
        first, last = int(used[0]), int(used[-1])
        length = (last + 1 - first) * size
        low, high = window[0] + first * size, window[0] + (last + 1) * size
        touched = first == 0 or last == count - 1
        loose = last + 1 - first < USED * count
        there.append((low, high, length, first == 0, last == count - 1, touched or loose))
    if not any(t[-1] for t in there):
        return None
    made = []
    for low, high, length, at_low, at_high, _ in there:
        made.append(
            (
                low - (GROW if at_low else MARGIN) * length,
                high + (GROW if at_high else MARGIN) * length,
            )
        )
    return Window(*made)
