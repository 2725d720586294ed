"""Where a pair is thought to touch: windows that follow its contact from try to try, and from position to position."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

from . import _patch as patches
from ._cells import Teeth
from ._meeting import Meeting
from ._patch import Patch, Window

Array = np.ndarray[Any, Any]
GROW = 0.3  # of a window's length by which a border moves out that the contact touches
MARGIN, CLEAR = (
    0.1,
    1.0,
)  # of a contact's length, and cells, at least: what it stands off the borders
USED = 0.55  # of a window's length that the contact fills, at least
SPARE = (2.5, 1.6)  # cells, along and across, that a contact foretold stands off every border
MOST = 0.3  # of a contact's length by which one of its ends is thought to move
GROWN = 4.0  # times: the most that a contact is thought to grow or to shrink
OWN = 0.5  # of a pair's approach that its surfaces take: the rest bends teeth
SMALLEST = 1e-4  # mm: an approach that a first window is made for, at least
FILLED = 0.45  # share of a patch, nearest first, that is thought to touch


@dataclass(frozen=True, eq=False)
class Guess:
    """Where a pair is thought to touch: a window, and which of its cells, if that is known."""

    window: Window
    touching: Array | None = None  # (columns, rows) bool, of `frame`
    frame: Window | None = None  # the window itself where None
    approach: float = 0.0  # mm by which the surfaces would be in each other, were nothing to give

    @property
    def contact(self) -> Window | None:
        """The rectangle about what touches, None where that is not known."""
        if self.touching is None:
            return None
        ends: list[tuple[float, float]] = []
        for axis, (low, high) in enumerate(self._seen.ends):
            first, last = _used(self.touching, axis)
            size = (high - low) / self.touching.shape[axis]
            ends.append((low + first * size, low + last * size))
        return Window(*ends)

    def changed(self, first: Guess, then: Guess) -> Guess | None:
        """What becomes of this contact if its ends move as from `first` to `then`, None where one is not known."""
        now, before, after = self.contact, first.contact, then.contact
        if now is None or before is None or after is None:
            return None
        ends: list[tuple[float, float]] = []
        for (low, high), was, (start, end) in zip(now.ends, before.ends, after.ends, strict=True):
            most = MOST * max(high - low, end - start)
            steps = np.clip(np.subtract((start, end), was), -most, most)
            ends.append((low + steps[0], high + steps[1]))
            if ends[-1][1] - ends[-1][0] < (high - low) / GROWN:  # steps that are another's size
                return None
        return self._stretched(now, Window(*ends))

    def grown(self, approach: float) -> Guess | None:
        """What becomes of this contact under another approach, mm, None where that is not known."""
        now = self.contact
        if now is None or not min(approach, self.approach) > 0.0:
            return None
        by = float(np.clip(np.sqrt(approach / self.approach), 1.0 / GROWN, GROWN))
        return self._stretched(now, now.scaled(by))

    def _stretched(self, now: Window, then: Window) -> Guess:
        """The same with its contact, which fills the window `now`, stretched to fill another."""
        window, frame = [], []
        for axis, ((low, high), (start, end)) in enumerate(zip(now.ends, then.ends, strict=True)):
            spare = _room(axis) * (end - start)
            window.append((start - spare, end + spare))
            by = (end - start) / (high - low)
            frame.append(tuple(start + (v - low) * by for v in self._seen.ends[axis]))
        return Guess(Window(*window), self.touching, Window(*frame))

    def moved(self) -> Window | None:
        """The window that fits this contact better, None where its own does or nothing touches."""
        if self.touching is None:
            return None
        ends: list[tuple[float, float]] = []
        fits = True
        for axis, (low, high) in enumerate(self.window.ends):
            count = self.touching.shape[axis]
            first, last = _used(self.touching, axis)
            length, size = last - first, (high - low) / count
            touched = first == 0, last == count
            fits &= not any(touched) and length >= USED * count
            if any(touched):  # how far it goes is not known yet, so nothing is taken away
                start, end = -GROW * count * touched[0], count * (1.0 + GROW * touched[1])
            else:
                spare = max(MARGIN * length, CLEAR)
                start, end = first - spare, last + spare
            ends.append((low + start * size, low + end * size))
        return None if fits else Window(*ends)

    def start(self, p: Patch) -> Array:
        """Cells (n,) of a patch that are thought to touch: by their places, or those with the least gaps."""
        if self.touching is None:
            return p.gap <= np.quantile(p.gap, FILLED)
        there, index = places(self._seen, p.plane, self.touching.shape)
        return there & self.touching[index]

    @property
    def _seen(self) -> Window:
        return self.frame or self.window


UNKNOWN = Guess(Window((0.0, 0.0), (0.0, 0.0)))


def _used(touching: Array, axis: int) -> tuple[int, int]:
    """First column or row in which cells touch, and the one after the last."""
    used = np.flatnonzero(touching.any(axis=1 - axis))
    return int(used[0]), int(used[-1]) + 1


def _room(axis: int) -> float:
    """What a window leaves free at either end of a contact that is foretold, in its lengths."""
    return SPARE[axis] / ((patches.COLUMNS, patches.ROWS)[axis] - 2.0 * SPARE[axis])


def guessed(p: Patch, force: Array, rotation: float) -> Guess:
    """Where a contact is that was found with forces (n,) at a rotation, rad."""
    touching = np.zeros(p.on.shape, dtype=bool)
    there, (column, row) = places(p.window, p.plane, p.on.shape)
    loaded = there & (force > 0.0)
    touching[column[loaded], row[loaded]] = True
    approach = rotation * p.meeting.lever - p.meeting.gap
    return Guess(p.window, touching if touching.any() else None, None, approach)


def places(
    window: Window, plane: Array, shape: tuple[int, ...]
) -> tuple[Array, tuple[Array, Array]]:
    """Which of the places (n, 2) lie in a window, and the column and row (n,) of its grid they are in."""
    there = np.ones(len(plane), dtype=bool)
    index: list[Array] = []
    for axis, ((low, high), count) in enumerate(zip(window.ends, shape, strict=True)):
        place = np.floor((plane[:, axis] - low) / (high - low) * count).astype(int)
        there &= (place >= 0) & (place < count)
        index.append(np.clip(place, 0, count - 1))
    return there, (index[0], index[1])


def first_rotation(meetings: Sequence[Meeting], teeth: Teeth, torque: float) -> float:
    """Rotation, rad, at which contacts that nobody has seen yet would bear a torque, N mm."""
    met = [m for m in meetings if m.lever > 0.0]
    least = min((m.gap / m.lever for m in met), default=0.0)

    def missing(beyond: float) -> float:
        forces = (_line_force(m, teeth, _approach(m, least + beyond)) for m in met)
        return sum(m.lever * f for m, f in zip(met, forces, strict=True)) - torque

    most = 1e-6
    while met and missing(most) < 0.0:
        most *= 4.0
    return least + (float(brentq(missing, 0.0, most)) if met else 0.0)  # pyright: ignore


def first_window(met: Meeting, teeth: Teeth, rotation: float) -> Window:
    """Where a pair would touch at a rotation, rad: as long as its approach asks for, as wide as a line contact."""
    approach = max(_approach(met, rotation), SMALLEST)
    low, high = met.curvature
    length = np.sqrt(2.0 * approach / low)
    line_load = 2.0 * _line_force(met, teeth, approach) / (np.pi * length)
    width = np.sqrt(4.0 * line_load / (np.pi * teeth.plane_modulus * high))
    a, b = (
        min(half * (1.0 + 2.0 * _room(axis)), 2.0 * met.depth)
        for axis, half in enumerate((length, width))
    )
    return Window((-a, a), (-min(b, a), min(b, a)))


def _approach(met: Meeting, rotation: float) -> float:
    """How far, mm, the surfaces of a pair give way at a rotation, rad."""
    return OWN * max(rotation * met.lever - met.gap, 0.0)


def _line_force(met: Meeting, teeth: Teeth, approach: float) -> float:
    """Force, N, of a line contact whose surfaces give way by an approach, mm."""
    return np.pi * teeth.plane_modulus * np.sqrt(8.0 / met.curvature[0]) / 6.0 * approach**1.5
