"""One position under torque: windows that follow the contact, and the contact of all pairs at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ._active_set import ContactSolution, Outcome, solve_contact
from ._cells import Cells, Teeth, compliance, parts
from ._patch import COLUMNS, ROWS, Meeting, Patch, Window, patch
from ._strips import bearing, deeper, with_strips

Array = np.ndarray[Any, Any]
TRIES = 14  # windows that are tried
GROW, MARGIN = (
    0.3,
    0.1,
)  # of the contact's length: a side that is touched moves out, others stand off
USED = 0.55  # of a window's length that the contact fills, at least
EDGE = 0.3  # mm from tip, toe, heel or fillet limit: pressure there is an edge's, and moves with the cells
FILLED = 0.45  # share of a patch, nearest first, that is thought to touch


@dataclass(frozen=True, eq=False)
class Guess:
    """Where a pair is thought to touch: a window, and which of its cells, if that is known."""

    window: Window
    touching: Array | None = None  # (columns, rows) bool

    def scaled(self, by: float) -> Guess:
        return Guess(self.window.scaled(by), self.touching)

    def start(self, p: Patch) -> Array:
        """Cells (n,) of a patch that are thought to touch: by their places, or those with the least gaps."""
        if self.touching is None:
            return p.gap <= np.quantile(p.gap, FILLED)
        there, index = _places(self.window, p.plane, self.touching.shape)
        return there & self.touching[index]


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
        return parts(self.patches)

    @property
    def bounded_by_edges(self) -> float:
        """Share of the contacts' outlines where flanks end rather than part, by the pairs' forces."""
        shares = [
            _bounded_by_edges(p, self.solution.force[part])
            for p, part in zip(self.patches, self.parts, strict=True)
        ]
        total = float(self.solution.force.sum())
        return sum(share * force for share, force in shares) / total if total > 0.0 else 0.0

    @property
    def guesses(self) -> dict[int, Guess]:
        """By pair, for a contact that is much like this one."""
        return {
            p.meeting.pair: _guess(p, self.solution.force[part])
            for p, part in zip(self.patches, self.parts, strict=True)
        }


def position_contact(
    meetings: Sequence[Meeting],
    teeth: Teeth,
    torque: float,
    guesses: Mapping[int, Guess] | None = None,
) -> PositionContact:
    """Contact of all pairs that can touch under a torque on the pinion, N mm; `guesses` to start from, by pair."""
    known = dict(guesses or {})
    ranked = sorted(meetings, key=lambda m: m.gap)
    chosen = [m for m in ranked if m.gap <= ranked[0].gap + 1e-3 or m.pair in known]
    for m in ranked:
        if m.pair not in known:
            share = len(chosen) if m in chosen else len(ranked)
            known[m.pair] = Guess(_first_window(m, teeth, torque / share))
    cells = {m.pair: Cells(patch(m, known[m.pair].window), teeth) for m in chosen}
    blocks: dict[tuple[int, int], Array] = {}
    found: PositionContact | None = None
    for _ in range(TRIES):
        used = [c for c in cells.values() if c.patch.count]
        if not used:
            break
        blocks = {k: v for k, v in blocks.items() if {*k} <= {id(c) for c in used}}
        found = _contact(used, blocks, known, torque)
        patches, solution = found.patches, found.solution
        if solution.outcome is not Outcome.OK:
            break
        known.update(found.guesses)
        closing = {m.pair: solution.rotation * m.lever for m in ranked}
        late = [m for m in ranked if m.pair not in cells and m.gap < closing[m.pair]]
        moved = {
            p.meeting.pair: after
            for p, part in zip(patches, found.parts, strict=True)
            if (after := _moved(p, solution.force[part])) is not None
        }
        if not moved and not late:
            return _at_tips(replace(found, open_window=False), used, torque)
        for m in late:
            cells[m.pair] = Cells(patch(m, known[m.pair].window), teeth)
        for p in patches:
            if (window := moved.get(p.meeting.pair)) is not None:
                cells[p.meeting.pair] = Cells(patch(p.meeting, window), teeth)
    if found is None:
        nothing = ContactSolution(np.zeros(0), 0.0, np.zeros(0), 0, Outcome.NO_CONTACT)
        return PositionContact((), nothing, Outcome.NO_CONTACT, False)
    return found


def _contact(
    cells: Sequence[Cells],
    blocks: dict[tuple[int, int], Array],
    known: Mapping[int, Guess],
    torque: float,
) -> PositionContact:
    """Contact of these cells as they stand; `blocks` of compliance are kept for the next time."""
    patches = tuple(c.patch for c in cells)
    solution = solve_contact(
        compliance(cells, blocks),
        np.concatenate([p.gap for p in patches]),
        np.concatenate([p.pinion_lever for p in patches]),
        torque,
        np.concatenate([known[p.meeting.pair].start(p) for p in patches]),
    )
    return PositionContact(patches, solution, solution.outcome, True)


def _at_tips(found: PositionContact, cells: Sequence[Cells], torque: float) -> PositionContact:
    """The same contact with strips of cells where rounded tips bear, as deep as these need to be."""
    modulus = cells[0].teeth.plane_modulus
    depths = {
        i: found_there
        for i, (p, part) in enumerate(zip(found.patches, found.parts, strict=True))
        if (found_there := bearing(p, found.solution.force[part] / p.area, modulus))
    }
    changed = set(depths)
    now, blocks = list(cells), dict[tuple[int, int], Array]()
    for _ in range(TRIES):
        if not changed or found.outcome is not Outcome.OK:
            break
        # all are made before any is let go: `blocks` knows them by their ids
        now = [
            Cells(with_strips(cells[i].patch, depths[i]), c.teeth) if i in changed else c
            for i, c in enumerate(now)
        ]
        blocks = {k: v for k, v in blocks.items() if {*k} <= {id(c) for c in now}}
        found = replace(_contact(now, blocks, found.guesses, torque), open_window=False)
        changed = set()
        for i, (p, part) in enumerate(zip(found.patches, found.parts, strict=True)):
            if i in depths and (better := deeper(p, found.solution.force[part], depths[i])):
                depths[i] = {**depths[i], **better}
                changed.add(i)
    return found


def _guess(p: Patch, force: Array) -> Guess:
    touching = np.zeros(p.on.shape, dtype=bool)
    there, (column, row) = _places(p.window, p.plane, p.on.shape)
    loaded = there & (force > 0.0)
    touching[column[loaded], row[loaded]] = True
    return Guess(p.window, touching if touching.any() else None)


def _bounded_by_edges(p: Patch, force: Array) -> tuple[float, float]:
    """Share of one contact's outline that lies on edges of the flanks, and its force, N."""
    there, (column, row) = _places(p.window, p.plane, p.on.shape)
    flanks, touching = np.zeros((2, *(n + 2 for n in p.on.shape)), dtype=bool)
    flanks[column[there] + 1, row[there] + 1] = True
    there &= force > 0.0
    touching[column[there] + 1, row[there] + 1] = True
    on_edges, whole = 0.0, 0.0
    for axis, length in enumerate(p.size[::-1]):
        for way in (-1, 1):
            ends = touching & ~np.roll(touching, way, axis)
            whole += length * np.count_nonzero(ends)
            on_edges += length * np.count_nonzero(ends & ~np.roll(flanks, way, axis))
    return (on_edges / whole if whole else 0.0), float(force.sum())


def _places(
    window: Window, plane: Array, shape: tuple[int, ...]
) -> tuple[Array, tuple[Array, Array]]:
    """Which of the places (n, 2) lie in a window, and the column and row (n,) of its grid they are in."""
    there = np.ones(len(plane), dtype=bool)
    index: list[Array] = []
    ends = (window.along, window.across)
    for axis, ((low, high), count) in enumerate(zip(ends, shape, strict=True)):
        place = np.floor((plane[:, axis] - low) / (high - low) * count).astype(int)
        there &= (place >= 0) & (place < count)
        index.append(np.clip(place, 0, count - 1))
    return there, (index[0], index[1])


def _first_window(met: Meeting, teeth: Teeth, torque: float) -> Window:
    """Where a line contact of this force would be: half lengths by the approach it needs."""
    force = max(torque, 1.0) / max(met.lever, 1e-3)
    low, high = met.curvature
    approach = (6.0 * force / (np.pi * teeth.plane_modulus * np.sqrt(8.0 / low))) ** (2.0 / 3.0)
    flank = met.contact.pinion_flank
    most = 2.0 * float(flank.tip.at(flank.heel) - flank.root.at(flank.heel))
    a, b = (min(1.2 * np.sqrt(2.0 * approach / c), most) for c in (low, high))
    return Window((-a, a), (-min(b, a), min(b, a)))


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
