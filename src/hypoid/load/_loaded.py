"""Loaded contact of a pair over its mesh cycle: pressure, load sharing and transmission error per torque.

All teeth of a member are alike, so one pitch of positions is solved and the others are its copies, a pair on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from hypoid.contact import Misalignment, Sampling, UnloadedContact, unloaded_contact
from hypoid.geometry import DesignError, Problem
from hypoid.pair import Direction, GearPair

from ._active_set import Outcome
from ._bearings import Bearings, bearings_of, moved_mounting, wrenches
from ._cells import Teeth
from ._compliance import ToothCompliance
from ._patch import EDGES, Patch, greatest, meeting, nearest_edge, on_arcs
from ._position import EDGE, Guess, PositionContact, position_contact

Array = np.ndarray[Any, Any]
Progress = Callable[[str, int, int], None]
FINE = 40  # positions a pitch of the unloaded contact, at least
PAIRS = (9, 11, 13)  # tooth pairs that are looked at, more where the outermost carries load
GROWN = 2.0  # times: the most that a contact is thought to grow from one torque to the next


@dataclass(frozen=True, eq=False)
class PairLoad:
    """What one tooth pair carries at one position."""

    pair: int  # stands this many pitches behind pair 0
    share: float  # of the torque
    force: float  # N, normal
    max_pressure: (
        float  # MPa, more than 0.3 mm from sharp tip, toe, heel and fillet limit of both members
    )
    tip_pressure: float  # MPa, the greatest of that on rounded tips
    edge_pressure: float  # MPa, nearer: moves with the cells
    edge_force: float  # N, on these cells
    edge: str  # the edge beside the greatest of that, "wheel heel", or none
    place: tuple[float, float]  # (S, H) of the greatest pressure on the pinion, mm
    distance: Array  # (n,) S of cells on the pinion, mm
    height: Array  # (n,) H
    wheel_distance: Array
    wheel_height: Array
    pressure: Array  # (n,) MPa
    area: Array  # (n,) mm2
    pinion_hats: Array  # (h,) N: the same load on the members' hats
    wheel_hats: Array

    @property
    def touching(self) -> bool:
        return self.force > 0.0


@dataclass(frozen=True, eq=False)
class LoadedPosition:
    """Loaded contact at one pinion angle."""

    pinion_angle: float  # rad
    rotation: float  # rad, of the pinion against the wheel beyond the unloaded contact
    unloaded: float  # rad, transmission error without load
    transmission_error: float  # rad, wheel minus z1/z2 pinion, positive where the wheel leads
    stiffness: float  # N mm/rad, of the pinion's rotation at this torque
    wheel_torque: float  # N mm
    pinion_wrench: (
        Array  # (6,) N, N mm of the contact on the pinion, in its bearings' frame (see `Bearings`)
    )
    wheel_wrench: Array
    pinion_motion: Array  # (6,) mm, rad of the pinion on its bearings
    wheel_motion: Array
    misalignment: Misalignment  # that these motions amount to, beyond the one asked for
    pairs: tuple[PairLoad, ...]  # by pair, touching ones only
    outcome: Outcome
    open_window: bool

    @property
    def pinion_axial(self) -> float:
        """Force of the contact on the pinion along its axis, N, positive to the heel."""
        return float(self.pinion_wrench[2])

    @property
    def pinion_radial(self) -> float:
        """Force square to the axis, N."""
        return float(np.hypot(*self.pinion_wrench[:2]))

    @property
    def wheel_axial(self) -> float:
        return float(self.wheel_wrench[2])

    @property
    def wheel_radial(self) -> float:
        return float(np.hypot(*self.wheel_wrench[:2]))

    @property
    def max_pressure(self) -> float:
        """Greatest pressure, MPa, away from edges."""
        return max((p.max_pressure for p in self.pairs), default=0.0)

    @property
    def tip_pressure(self) -> float:
        """Greatest pressure on rounded tips, MPa, which `max_pressure` counts."""
        return max((p.tip_pressure for p in self.pairs), default=0.0)

    @property
    def edge_contact(self) -> bool:
        """Whether the pressure is greatest at a tip, at toe or heel, or where a fillet begins."""
        edge = max((p.edge_pressure for p in self.pairs), default=0.0)
        return edge > self.max_pressure


@dataclass(frozen=True, eq=False)
class LoadCase:
    """One torque over the mesh cycle."""

    torque: float  # N mm, on the pinion
    positions: tuple[LoadedPosition, ...]
    per_pitch: int  # positions a pitch

    @property
    def transmission_error(self) -> Array:
        """Transmission error under load (positions,), rad."""
        return np.array([p.transmission_error for p in self.positions])

    @property
    def peak_to_peak(self) -> float:
        """Peak to peak of the transmission error under load, between positions, too, rad.

        That of a periodic cubic spline through one pitch of them; of the positions alone where the cycle was cut short.
        """
        own = self.transmission_error[: self.per_pitch]
        return _spline_range(own) if len(own) == self.per_pitch else float(np.ptp(own))

    @property
    def peak_to_peak_doubt(self) -> float:
        """How far every second position alone would put the peak to peak elsewhere, rad; NaN for odd counts."""
        own = self.transmission_error[: self.per_pitch]
        if len(own) < self.per_pitch or len(own) % 2 or len(own) < 6:
            return float("nan")
        return abs(_spline_range(own) - _spline_range(own[::2]))

    @property
    def max_pressure(self) -> float:
        """Greatest pressure, MPa, away from edges."""
        return max(p.max_pressure for p in self.positions)

    @property
    def tip_pressure(self) -> float:
        """Greatest pressure on rounded tips, MPa, which `max_pressure` counts."""
        return max(p.tip_pressure for p in self.positions)

    @property
    def edge_contact(self) -> bool:
        return any(p.edge_contact for p in self.positions)

    @property
    def pitch(self) -> tuple[LoadedPosition, ...]:
        """One pitch of positions, the first not twice; all there are where the cycle was cut short."""
        return self.positions[: self.per_pitch]

    @property
    def contact_ratio(self) -> float:
        """Contact ratio under load: the mean number of pairs that touch."""
        return float(np.mean([len(p.pairs) for p in self.pitch]))

    def harmonics(self, count: int = 4) -> Array:
        """Amplitudes (count,) of the tooth mesh's harmonics in the transmission error under load, rad."""
        made = np.full(count, np.nan)
        if len(self.positions) >= self.per_pitch:
            own = self.transmission_error[: self.per_pitch]
            found = 2.0 * np.abs(np.fft.rfft(own)) / len(own)
            made[: min(count, len(found) - 1)] = found[1 : count + 1]
        return made

    @cached_property
    def faults(self) -> tuple[str, ...]:
        """What is wrong with these results, in words."""
        at_edges = [p for p in self.positions if p.edge_contact]
        names = sorted(
            {p.edge for at in at_edges for p in at.pairs if p.edge_pressure > at.max_pressure}
        )
        words = list(dict.fromkeys(p.outcome.value for p in self.positions if p.outcome.value))
        where = f"{self.torque * 1e-3:g} N m"
        if self.max_pressure == 0.0:
            words.append("The contact has left the flanks: edges bear all of the load.")
        elif at_edges:
            words.append(
                f"Edge contact ({', '.join(names)}) at {len(at_edges)} of {len(self.positions)} positions: more "
                "relief or crowning, or less torque; pressure at an edge is not reported as the greatest."
            )
        if any(p.open_window for p in self.positions):
            words.append(
                "A contact did not fit its cells' window; its pressure is not to be trusted."
            )
        return tuple(f"At {where}: {w}" for w in words)


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
        if not any(at.outcome is Outcome.MORE_PAIRS for case in found for at in case.positions):
            break
        unloaded, teeth, found = attempt(count)
    complete = len(found[0].positions) > per_pitch
    return LoadedContact(pair, direction, unloaded, teeth, found, complete)


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
    before: list[dict[int, Guess]] = []  # of the last position, by torque
    for k in range(per_pitch):
        at = start + k * step
        found = (meeting(unloaded, at, n) for n in range(-half, half + 1))
        meetings = [m for m in found if m is not None]
        after: list[dict[int, Guess]] = []
        row: list[LoadedPosition] = []
        for t, torque in enumerate(torques):
            guesses: dict[int, Guess] = {}
            if before:
                guesses = before[t]
            elif t:
                grown = min((torque / torques[t - 1]) ** (1.0 / 3.0), GROWN)
                guesses = {n: g.scaled(grown) for n, g in after[-1].items()}
            contact = position_contact(meetings, teeth, torque, guesses)
            after.append(contact.guesses)
            row.append(_position(unloaded, teeth, at, torque, contact))
        before = after
        yield row


def _position(
    unloaded: UnloadedContact, teeth: Teeth, at: int, torque: float, found: PositionContact
) -> LoadedPosition:
    n, half = unloaded.sampling.positions_per_pitch, unloaded.sampling.pairs // 2
    rigid = float(unloaded.curve[at - n * np.arange(-half, half + 1)].max())
    error = rigid - unloaded.index_shift
    mount, rotation = unloaded.mount, found.solution.rotation
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


def _spline_range(values: Array) -> float:
    """Greatest less least of a periodic cubic spline through even steps of a period."""
    line = CubicSpline(np.arange(len(values) + 1), np.append(values, values[0]), bc_type="periodic")
    turns = line.derivative().roots(extrapolate=False)
    return float(np.ptp(np.concatenate([values, line(turns[np.isfinite(turns)])])))


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
