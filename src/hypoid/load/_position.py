"""One position under torque: windows that follow the contact, and the contact of all pairs at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ._active_set import ContactSolution, Outcome, solve_contact
from ._cells import Cells, Teeth, compliance, parts
from ._dense import on_one_thread
from ._guess import Guess, first_rotation, first_window, guessed, places
from ._meeting import Meeting
from ._patch import Patch, patch
from ._strips import bearing, deeper, with_strips

Array = np.ndarray[Any, Any]
TRIES = 14  # windows that are tried
EDGE = 0.3  # mm from tip, toe, heel or fillet limit: pressure there is an edge's, and moves with the cells


@dataclass(frozen=True, eq=False)
class PositionContact:
    """Loaded contact at one position under one torque."""

    patches: tuple[Patch, ...]
    solution: ContactSolution
    open_window: bool  # a contact still ends at a window's border that is no edge

    @property
    def outcome(self) -> Outcome:
        """How the contact of these cells ended."""
        return self.solution.outcome

    @property
    def rotation(self) -> float:
        """Of the pinion against the wheel, rad."""
        return self.solution.rotation

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

    @cached_property
    def guesses(self) -> dict[int, Guess]:
        """By pair, for a contact that is much like this one."""
        return {
            p.meeting.pair: guessed(p, self.solution.force[part], self.rotation)
            for p, part in zip(self.patches, self.parts, strict=True)
        }


NOWHERE = PositionContact(
    (), ContactSolution(np.zeros(0), 0.0, np.zeros(0), 0, Outcome.NO_CONTACT), False
)


@on_one_thread
def position_contact(
    meetings: Sequence[Meeting],
    teeth: Teeth,
    torque: float,
    guesses: Mapping[int, Guess] | None = None,
    rotation: float = 0.0,
) -> PositionContact:
    """Contact of all pairs that can touch under a torque on the pinion, N mm.

    `guesses` to start from, by pair, and about the `rotation`, rad, if they are known.
    """
    if not rotation > 0.0:
        rotation = first_rotation(meetings, teeth, torque)
    ranked = sorted(meetings, key=lambda m: m.gap - rotation * m.lever)
    foretold = set(guesses or {})
    chosen = [m for m in ranked if m.gap < rotation * m.lever or m.pair in foretold] or ranked[:1]

    def fresh(m: Meeting) -> Guess:
        return Guess(first_window(m, teeth, rotation))

    known = {m.pair: fresh(m) for m in chosen if m.pair not in foretold} | dict(guesses or {})
    cells = {m.pair: Cells(patch(m, known[m.pair].window), teeth) for m in chosen}
    blocks: dict[tuple[int, int], Array] = {}
    found: PositionContact | None = None
    for _ in range(TRIES):
        used = [c for c in cells.values() if c.patch.count]
        if not used:
            break
        blocks = {k: v for k, v in blocks.items() if {*k} <= {id(c) for c in used}}
        found = _contact(used, blocks, known, torque)
        solution = found.solution
        if solution.outcome is not Outcome.OK:
            break
        seen = found.guesses
        known.update(seen)
        bearing = {pair for pair, guess in seen.items() if guess.touching is not None}
        moved = {pair: to for pair, guess in seen.items() if (to := guess.moved()) is not None}
        # late ones, and those whose foretold window may lie beside their contact
        rotation = solution.rotation
        looked = cells.keys() - (foretold - bearing)
        late = [m for m in ranked if m.pair not in looked and m.gap < rotation * m.lever]
        if not moved and not late:
            return _at_tips(replace(found, open_window=False), used, torque)
        for m in late:
            foretold.discard(m.pair)
            known[m.pair] = fresh(m)
            cells[m.pair] = Cells(patch(m, known[m.pair].window), teeth)
        for p in found.patches:
            if (window := moved.get(p.meeting.pair)) is not None:
                cells[p.meeting.pair] = Cells(patch(p.meeting, window), teeth)
    if guesses and (found is None or found.outcome is not Outcome.OK):
        return position_contact(meetings, teeth, torque)  # not where it was foretold
    return found or NOWHERE


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
    return PositionContact(patches, solution, True)


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


def _bounded_by_edges(p: Patch, force: Array) -> tuple[float, float]:
    """Share of one contact's outline that lies on edges of the flanks, and its force, N."""
    there, (column, row) = places(p.window, p.plane, p.on.shape)
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
