"""Loaded contact of a pair over its mesh cycle: pressure, load sharing and transmission error per torque.

All teeth of a member are alike, so one pitch of positions is solved and the others are its copies, a pair on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.contact import Misalignment, Sampling, UnloadedContact, unloaded_contact
from hypoid.geometry import DesignError, Problem
from hypoid.pair import Direction, GearPair

from ._active_set import Outcome
from ._bearings import Bearings, bearings_of, moved_mounting, wrenches
from ._cells import Teeth
from ._compliance import ToothCompliance
from ._guess import UNKNOWN, Guess
from ._limits import has_left, has_left_at, leaves_at, needs_more, pairs_needed
from ._load_case import PAIRS, LoadCase, LoadedPosition, PairLoad
from ._meeting import Meeting, meeting
from ._patch import EDGES, Patch, greatest, nearest_edge, on_arcs
from ._position import EDGE, NOWHERE, PositionContact, position_contact

Array = np.ndarray[Any, Any]
Progress = Callable[[str, int, int], None]
FINE = 40  # positions a pitch of the unloaded contact, at least
EASED = 2.0 / 3.0  # power of the torque by which the rotation is thought to rise at least


@dataclass(frozen=True, eq=False)
class LoadedContact:
    """Loaded contact of one direction of travel, torques rising."""

    pair: GearPair
    direction: Direction
    unloaded: UnloadedContact
    teeth: Teeth
    cases: tuple[LoadCase, ...]
    complete: bool  # False where it was interrupted: finished positions only


def loaded_contact(
    pair: GearPair,
    direction: Direction,
    torques: Sequence[float],
    pinion: ToothCompliance,
    wheel: ToothCompliance,
    *,
    positions: int = 21,
    misalignment: Misalignment | None = None,
    bearings: Bearings | None = None,
    pairs: int | None = None,
    progress: Progress = lambda *_: None,
) -> LoadedContact:
    """Loaded contact under torques on the pinion (N mm, all positive), at positions over two pitches.

    `pinion` and `wheel` are the members' compliance on the flanks of this direction; `bearings` stand in for the
    design's. `positions` is odd. `pairs` tooth pairs are looked at; by default 9, and more where the outermost
    carries load. An interrupt keeps the positions that are done. Raises DesignError for torques or counts that mean
    nothing.
    """
    _check(torques, positions, PAIRS[0] if pairs is None else pairs, direction)
    held = bearings_of(pair) if bearings is None else bearings
    per_pitch = (positions - 1) // 2
    fine = per_pitch * -(-FINE // per_pitch)
    first, *more = PAIRS if pairs is None else (pairs,)

    def attempt(count: int) -> tuple[UnloadedContact, Teeth, tuple[LoadCase, ...]]:
        sampling = Sampling(positions_per_pitch=fine, pairs=count)
        unloaded = unloaded_contact(pair, direction, misalignment, sampling)
        teeth = Teeth(pinion, wheel, round(float(unloaded.mount.sense)), held)
        return unloaded, teeth, _solved(unloaded, teeth, sorted(set(torques)), per_pitch, progress)

    unloaded, teeth, found = attempt(first)
    for count in more:
        if not any(needs_more(case) for case in found) or not _complete(found, per_pitch):
            break
        unloaded, teeth, found = attempt(count)
    with suppress(KeyboardInterrupt):  # what is solved is kept without its explanation
        if any(needs_more(case) for case in found):
            wide = found if pairs is None else attempt(PAIRS[-1])[-1]
            found = tuple(
                replace(case, pairs_needed=pairs_needed(w)) if needs_more(case) else case
                for case, w in zip(found, wide, strict=True)
            )
        gone = [case for case in found if has_left_at(case)]
        if gone:
            torque = leaves_at(unloaded, teeth, gone[0], progress)
            found = tuple(replace(c, leaves_at=torque) if c in gone else c for c in found)
    return LoadedContact(pair, direction, unloaded, teeth, found, _complete(found, per_pitch))


def _complete(found: tuple[LoadCase, ...], per_pitch: int) -> bool:
    return len(found[0].positions) > per_pitch


def _solved(
    unloaded: UnloadedContact,
    teeth: Teeth,
    torques: Sequence[float],
    per_pitch: int,
    progress: Progress,
) -> tuple[LoadCase, ...]:
    """Cases of rising torques; an interrupt after the first position keeps what is done."""
    done: list[list[LoadedPosition]] = []
    try:
        for found in solved_positions(unloaded, teeth, torques, per_pitch):
            done.append(found)
            progress("loaded contact", len(done), per_pitch)
    except KeyboardInterrupt:
        if not done:
            raise
    complete = len(done) == per_pitch
    return tuple(
        LoadCase(torque, _spread([d[k] for d in done], unloaded.pitch, complete), per_pitch)
        for k, torque in enumerate(torques)
    )


def solved_positions(
    unloaded: UnloadedContact, teeth: Teeth, torques: Sequence[float], per_pitch: int
) -> Iterator[list[LoadedPosition]]:
    """Position by position over one pitch from pinion angle zero on: all torques, rising, each from the last."""
    step = unloaded.sampling.positions_per_pitch // per_pitch
    half = unloaded.sampling.pairs // 2
    start = len(unloaded.phi) // 2
    before: list[PositionContact] = []
    for k in range(per_pitch):
        at = start + k * step
        found = (meeting(unloaded, at, n) for n in range(-half, half + 1))
        meetings = [m for m in found if m is not None]
        now: list[PositionContact] = []
        for t, torque in enumerate(torques):
            foretold = _foretold(before, now, torque / torques[max(t - 1, 0)], meetings)
            now.append(position_contact(meetings, teeth, torque, *foretold))
        before = now
        yield [
            _position(unloaded, teeth, at, torque, contact)
            for torque, contact in zip(torques, now, strict=True)
        ]


def _foretold(
    before: Sequence[PositionContact],
    now: Sequence[PositionContact],
    by: float,
    meetings: Sequence[Meeting],
) -> tuple[dict[int, Guess], float]:
    """Where pairs are thought to touch under the next torque, `by` times the last, and the rotation, rad.

    From this position's contacts so far and those one position `before`, by torque: a contact changes as that rise of
    the torque changed it before; else it grows with its approach.
    """
    here = now[-1] if now else NOWHERE
    last = before[len(now)] if before else NOWHERE
    lower = before[len(now) - 1] if before and now else NOWHERE
    rotation = here.rotation * by**EASED
    if before:
        rotation = last.rotation + here.rotation - lower.rotation
    known: dict[int, Guess] = {}
    for m in meetings:
        less, then, was = (c.guesses.get(m.pair, UNKNOWN) for c in (here, last, lower))
        approach = rotation * m.lever - m.gap
        guess = less.changed(was, then) or less.grown(approach) or then.grown(approach)
        if guess:
            known[m.pair] = guess
    return known, rotation


def _position(
    unloaded: UnloadedContact, teeth: Teeth, at: int, torque: float, found: PositionContact
) -> LoadedPosition:
    n, half = unloaded.sampling.positions_per_pitch, unloaded.sampling.pairs // 2
    rigid = float(unloaded.curve[at - n * np.arange(-half, half + 1)].max())
    error = rigid - unloaded.index_shift
    mount, rotation = unloaded.mount, found.rotation
    mirrored = unloaded.pinion_flank.mirrored
    on_pinion, on_wheel, wheel_torque = np.zeros(6), np.zeros(6), 0.0
    loads: list[PairLoad] = []
    for p, part in zip(found.patches, found.parts, strict=True):
        force = found.solution.force[part]
        if force.sum() > 0.0:
            loads.append(_pair_load(p, force, torque, teeth))
            one, other = wrenches(mount, mirrored, p.point, p.normal)
            on_pinion += force @ one
            on_wheel += force @ other
            wheel_torque += float(p.wheel_lever @ force)
    outcome = found.outcome
    if outcome is Outcome.OK and has_left(found):
        outcome = Outcome.LEFT_FLANKS
    if outcome is Outcome.OK and any(abs(load.pair) == half for load in loads):
        outcome = Outcome.MORE_PAIRS
    motions = teeth.bearings.pinion @ on_pinion, teeth.bearings.wheel @ on_wheel
    return LoadedPosition(
        float(unloaded.phi[at]),
        rotation,
        error,
        error - float(mount.ratio) * rotation,
        found.solution.stiffness,
        wheel_torque,
        on_pinion,
        on_wheel,
        *motions,
        moved_mounting(mount, mirrored, *motions),
        tuple(sorted(loads, key=lambda load: load.pair)),
        outcome,
        found.open_window,
    )


def _pair_load(p: Patch, force: Array, torque: float, teeth: Teeth) -> PairLoad:
    pressure = force / p.area
    apart, name = nearest_edge(p, force)
    inner = apart > EDGE
    peak, sharp = int(pressure.argmax()), int(np.where(inner, 0.0, pressure).argmax())
    return PairLoad(
        pair=p.meeting.pair,
        share=float(p.pinion_lever @ force) / torque,
        force=float(force.sum()),
        max_pressure=greatest(p, pressure, inner),
        tip_pressure=float(pressure[inner & on_arcs(p)].max(initial=0.0)),
        edge_pressure=float(pressure[~inner].max(initial=0.0)),
        edge_force=float(force[~inner].sum()),
        edge=EDGES[name[sharp]] if not inner[sharp] and force[sharp] > 0.0 else "",
        place=(float(p.pinion_place[0][peak]), float(p.pinion_place[1][peak])),
        distance=p.pinion_place[0],
        height=p.pinion_place[1],
        wheel_distance=p.wheel_place[0],
        wheel_height=p.wheel_place[1],
        pressure=pressure,
        area=p.area,
        pinion_hats=teeth.pinion.hats.weights(*p.pinion_place).T @ force,
        wheel_hats=teeth.wheel.hats.weights(*p.wheel_place).T @ force,
    )


def _spread(
    one: Sequence[LoadedPosition], pitch: float, complete: bool
) -> tuple[LoadedPosition, ...]:
    """Positions over two pitches about pinion angle zero, from those of one pitch."""
    if not complete:
        return tuple(one)
    count, made = len(one), []
    for k in range(-count, count + 1):
        turns, own = divmod(k, count)
        moved = tuple(replace(p, pair=p.pair + turns) for p in one[own].pairs)
        angle = one[own].pinion_angle + turns * pitch
        made.append(replace(one[own], pinion_angle=angle, pairs=moved))
    return tuple(made)


def _check(torques: Sequence[float], positions: int, pairs: int, direction: Direction) -> None:
    problems: list[Problem] = []
    if not torques:
        problems.append(Problem("torque", "none", "a torque on the pinion", '--torque "110 N m"'))
    other = "coast" if direction == "drive" else "drive"
    for torque in torques:
        if not (torque > 0.0 and np.isfinite(torque)):
            expected = f"more than 0; the other way round it is the direction {other!r}"
            problems.append(
                Problem("torque", f"{torque * 1e-3:g} N m", expected, '--torque "110 N m"')
            )
    if positions < 5 or positions % 2 == 0:
        problems.append(
            Problem("positions", str(positions), "an odd number, 5 or more, over two pitches", "21")
        )
    if pairs < 3 or pairs % 2 == 0 or pairs > PAIRS[-1]:
        expected = f"an odd number from 3 to {PAIRS[-1]}"
        problems.append(Problem("pairs", str(pairs), expected, "9"))
    if problems:
        raise DesignError(problems)
