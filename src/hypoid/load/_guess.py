"""Where a pair is thought to touch: windows that follow its contact from try to try, and from position to position."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._cells import Teeth
from ._patch import Meeting, Patch, Window

Array = np.ndarray[Any, Any]
GROW = 0.3  # of a window's length by which a border moves out that the contact touches
MARGIN, CLEAR = (
    0.1,
    1.0,
)  # of a contact's length, and cells, at least: what it stands off the borders
USED = 0.55  # of a window's length that the contact fills, at least
SPARE = (2.5, 1.6)  # cells, along and across, that a contact foretold stands off every border
MOST = 0.3  # of a contact's length by which its ends are thought to move from position to position
FILLED = 0.45  # share of a patch, nearest first, that is thought to touch


@dataclass(frozen=True, eq=False)
class Guess:
    """Where a pair is thought to touch: a window, and which of its cells, if that is known."""

    window: Window
    touching: Array | None = None  # (columns, rows) bool, of `frame`
    frame: Window | None = None  # the window itself where None

    def scaled(self, by: float) -> Guess:
        """The same about each window's middle, `by` times as long and wide."""
        return Guess(self.window.scaled(by), self.touching, self.frame and self.frame.scaled(by))

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

    def after(self, earlier: Guess | None) -> Guess:
        """What is to be expected at the next position, from this one's contact and the `earlier` one's."""
        now, before = self.contact, earlier and earlier.contact
        if self.touching is None or now is None or before is None:
            return self
        window, frame = [], []
        for axis, (low, high) in enumerate(now.ends):
            length = high - low
            steps = np.clip(
                np.subtract((low, high), before.ends[axis]), -MOST * length, MOST * length
            )
            start, end = low + steps[0], high + steps[1]
            spare = SPARE[axis] / (self.touching.shape[axis] - 2.0 * SPARE[axis]) * (end - start)
            window.append((start - spare, end + spare))
            by = (end - start) / length
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


def _used(touching: Array, axis: int) -> tuple[int, int]:
    """First column or row in which cells touch, and the one after the last."""
    used = np.flatnonzero(touching.any(axis=1 - axis))
    return int(used[0]), int(used[-1]) + 1


def guessed(p: Patch, force: Array) -> Guess:
    """Where a contact is that was found with forces (n,)."""
    touching = np.zeros(p.on.shape, dtype=bool)
    there, (column, row) = places(p.window, p.plane, p.on.shape)
    loaded = there & (force > 0.0)
    touching[column[loaded], row[loaded]] = True
    return Guess(p.window, touching if touching.any() else None)


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


def first_window(met: Meeting, teeth: Teeth, torque: float) -> Window:
    """Where a line contact of this force would be: half lengths by the approach it needs."""
    force = max(torque, 1.0) / max(met.lever, 1e-3)
    low, high = met.curvature
    approach = (6.0 * force / (np.pi * teeth.plane_modulus * np.sqrt(8.0 / low))) ** (2.0 / 3.0)
    flank = met.contact.pinion_flank
    most = 2.0 * float(flank.tip.at(flank.heel) - flank.root.at(flank.heel))
    a, b = (min(1.2 * np.sqrt(2.0 * approach / c), most) for c in (low, high))
    return Window((-a, a), (-min(b, a), min(b, a)))
