"""Unloaded contact of a pair: motion curve, path, edges, from one gap field (rigid teeth).

The lead of the wheel that each pinion point asks for is laid out over a grid of points and pinion
angles of one tooth pair; its other pairs are the same curve a pitch on. The greatest lead is the
contact: inside the flanks it is refined on the exact surfaces, on their edges by zooming in
(methods of contact, 2-4).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hypoid.flank import Flank
from hypoid.geometry import horner
from hypoid.pair import Direction, GearPair

from ._edges import zoom
from ._field import FlankNodes, angle_field, flank_nodes, lead_grid, on_flank
from ._handover import handovers, peak_to_peak
from ._mounting import Misalignment, Mounting, mounting, to_wheel
from ._refine import ContactPoints, refine

EDGE_WINS = 1e-8  # rad: an edge counts as contact where it leads the flanks by more (2 milliarcsec)
GRID_BIAS = 5e-5  # rad: how far a grid may misplace an edge's lead (methods: 5 arcsec), twice
GAP = 1e-3  # pitches: contacts of the flanks themselves that leave out more leave it to an edge
INSIDE = 1.0 - 1e-6  # of a chart: nearer its border a place is on an edge
TOUCHING = 1e-9  # rad: pairs within this of the leader touch, too


@dataclass(frozen=True)
class Sampling:
    """How finely contact is looked at."""

    positions_per_pitch: int = 40
    pitches: int = 2  # pinion pitches that the motion curve spans
    pairs: int = 5  # tooth pairs that can touch at once
    columns: int = 61
    rows: int = 31
    every_edge: bool = True  # refine edges that trail far behind, too: smooth curves, more time


@dataclass(frozen=True)
class UnloadedContact:
    """Contact of one direction of travel; angles rad, lengths mm.

    ``curve`` is the motion curve of one pair over all its positions; pair k of the pair's curve is
    the same one pitch further. Transmission error counts from its value at pinion angle zero.
    """

    pair: GearPair
    direction: Direction
    misalignment: Misalignment
    sampling: Sampling
    mount: Mounting
    nodes: FlankNodes
    phi: np.ndarray  # (m,) pinion angles of one tooth pair's whole passage
    leads: np.ndarray  # (m, n) lead that every node asks for, -inf off the mate
    curve: np.ndarray  # (m,) greatest lead of this pair
    interior: np.ndarray  # (m,) bool: a true contact of both flanks, refined
    points: ContactPoints  # refined points, (m,)

    @property
    def pitch(self) -> float:
        """Pinion pitch, rad."""
        return 2.0 * np.pi / self.pair.pinion.teeth

    def pair_teeth(self, member: str) -> int:
        return self.pair.pinion.teeth if member == "pinion" else self.pair.wheel.teeth

    @cached_property
    def cycle(self) -> np.ndarray:
        """Indices into ``phi`` of the reported positions, centred on pinion angle zero."""
        half = self.sampling.positions_per_pitch * self.sampling.pitches // 2
        middle = len(self.phi) // 2
        return np.arange(middle - half, middle + half + 1)

    @cached_property
    def pair_curves(self) -> np.ndarray:
        """(pairs, positions) lead of each pair over the reported positions; the middle one is pair 0."""
        n, reach = self.sampling.positions_per_pitch, self.sampling.pairs // 2
        return np.array([self.curve[self.cycle - k * n] for k in range(-reach, reach + 1)])

    @cached_property
    def envelope(self) -> np.ndarray:
        """(positions,) lead of the wheel: the greatest over all pairs."""
        return self.pair_curves.max(axis=0)

    @cached_property
    def index_shift(self) -> float:
        """Lead at pinion angle zero, taken off the transmission error, rad (0 if well mounted)."""
        return float(self.envelope[len(self.envelope) // 2])

    @property
    def transmission_error(self) -> np.ndarray:
        """(positions,) wheel angle minus z1/z2 pinion angle, rad, positive when the wheel leads."""
        return self.envelope - self.index_shift

    @property
    def peak_to_peak(self) -> float:
        """Peak to peak transmission error over one pitch, rad; NaN where the flanks do not always meet."""
        if not self.touched:
            return float("nan")
        return peak_to_peak(self.phi[self.cycle], self.pair_curves)

    @cached_property
    def touched(self) -> bool:
        """Whether the flanks meet at all at every position."""
        return bool(np.isfinite(self.envelope).all())

    @cached_property
    def edge_contact(self) -> bool:
        """Whether an edge leads every contact of the flanks themselves, at some position or between."""
        n, reach = self.sampling.positions_per_pitch, self.sampling.pairs // 2
        inside = np.where(self.interior, self.points.lead, -np.inf)
        best = np.max([inside[self.cycle - k * n] for k in range(-reach, reach + 1)], axis=0)
        led = bool((self.envelope > best + EDGE_WINS).any())
        return led or (self.touched and self.contact_ratio < 1.0 - GAP)

    @cached_property
    def on_path(self) -> np.ndarray:
        """Indices into ``phi`` where this tooth pair has a true contact of both flanks."""
        found = np.flatnonzero(self.interior)
        if not len(found):
            return found
        middle = found[np.argmin(np.abs(self.phi[found]))]
        gap = np.flatnonzero(~self.interior)
        first = gap[gap < middle].max(initial=-1) + 1
        last = gap[gap > middle].min(initial=len(self.phi)) - 1
        return np.arange(first, last + 1)

    @property
    def pinion_flank(self) -> Flank:
        return self.pair.mates(self.direction)[0]

    @property
    def wheel_flank(self) -> Flank:
        return self.pair.mates(self.direction)[1]

    @cached_property
    def path(self) -> tuple[np.ndarray, np.ndarray]:
        """Path of contact on the pinion as (S, H), mm, over ``on_path``."""
        position, _ = self.pinion_flank.at_cutter(
            self.points.s1[self.on_path], self.points.theta1[self.on_path]
        )
        rho = np.hypot(position[:, 0], position[:, 1])
        return self.pinion_flank.cone.cone_distance_height(position[:, 2], rho)

    @cached_property
    def wheel_path(self) -> tuple[np.ndarray, np.ndarray]:
        """The same path on the wheel as (S, H), mm."""
        z, rho = self.points.wheel_z[self.on_path], self.points.wheel_rho[self.on_path]
        return self.wheel_flank.cone.cone_distance_height(z, rho)

    @cached_property
    def contact_point(self) -> tuple[float, float]:
        """(S, H) of the pinion, mm, at pinion angle zero; NaN if the flanks do not meet there."""
        here = np.flatnonzero(self.on_path == len(self.phi) // 2)
        if not len(here):
            return (np.nan, np.nan)
        distance, height = self.path
        return float(distance[here[0]]), float(height[here[0]])

    @cached_property
    def leading(self) -> np.ndarray:
        """Indices into ``phi``, an unbroken run, where this pair is in contact and none leads it."""
        n = self.sampling.positions_per_pitch
        path = self.on_path
        period = self.envelope[:n]  # the envelope repeats with the pitch
        start = self.cycle[0]
        behind = period[(path - start) % n] - self.points.lead[path]
        touching = path[behind < TOUCHING]
        if not len(touching):
            return touching
        breaks = np.flatnonzero(np.diff(touching) > 1)
        runs = np.split(touching, breaks + 1)
        return max(runs, key=len)

    @cached_property
    def transfer_points(self) -> tuple[float, float]:
        """Pinion angles (rad) where a pair takes up the contact of the flanks and hands it on."""
        if not len(self.leading):
            return (0.0, 0.0)
        return self._transfer(-1), self._transfer(+1)

    @property
    def contact_ratio(self) -> float:
        """Rigid contact ratio: the angle over which a pair is in contact and none leads it, in pitches.

        Above 1 only for teeth that are conjugate somewhere; 1 where pairs relieve each other.
        """
        start, end = self.transfer_points
        return (end - start) / self.pitch

    def harmonics(self, count: int = 5) -> np.ndarray:
        """Amplitudes (count,) of the first harmonics of tooth mesh in the motion curve, rad.

        NaN where the flanks do not meet at every position.
        """
        if not self.touched:
            return np.full(count, np.nan)
        n = self.sampling.positions_per_pitch
        one = self.envelope[:n]
        return 2.0 * np.abs(np.fft.rfft(one))[1 : count + 1] / n

    def _transfer(self, side: int) -> float:
        """Where the leading run ends: on the outline of a flank, or where a neighbour takes over.

        Margins and leads are read as smooth functions along the run's last points.
        """
        index = int(self.leading[0] if side < 0 else self.leading[-1])
        step = float(self.phi[1] - self.phi[0])
        inward = index - side * np.arange(4)
        inward = np.sort(inward[np.isin(inward, self.leading)])
        at = float(self.phi[index])
        if index + side not in self.on_path and len(inward) >= 3:
            outline = self.margins(inward).T
            ends = [self._crossing(self.phi[inward], line, at, side) for line in outline]
            return at + side * min(*(abs(end - at) for end in ends), step)
        n, nothing = self.sampling.positions_per_pitch, np.full_like(self.curve, -np.inf)
        after, before = nothing.copy(), nothing.copy()
        after[n:], before[:-n] = self.curve[:-n], self.curve[n:]
        passed = handovers(self.phi, np.array([before, self.curve, after]))
        near = [h.angle for h in passed if -1e-9 <= (h.angle - at) * side <= step + 1e-9]
        return near[0] if near else at + side * 0.5 * step

    @staticmethod
    def _crossing(phi: np.ndarray, margin: np.ndarray, at: float, side: int) -> float:
        """First zero of a margin beyond ``at``; infinity if it has none."""
        roots = np.polynomial.Polynomial.fit(phi, margin, len(phi) - 1).roots()
        real = roots[np.abs(roots.imag) < 1e-12].real
        beyond = real[(real - at) * side >= 0.0]
        return float(beyond[np.argmin(np.abs(beyond - at))]) if len(beyond) else np.inf

    def margins(self, index: np.ndarray) -> np.ndarray:
        """Distances (n, 8), mm, of refined points from tip, toe, heel and fillet limit of both."""
        columns: list[np.ndarray] = []
        flanks = (self.pinion_flank, self.wheel_flank)
        parameters = ((self.points.s1, self.points.theta1), (self.points.s2, self.points.theta2))
        for flank, (s, theta) in zip(flanks, parameters, strict=True):
            position, _ = flank.at_cutter(s[index], theta[index])
            rho = np.hypot(position[:, 0], position[:, 1])
            distance, height = flank.cone.cone_distance_height(position[:, 2], rho)
            columns += [
                flank.tip.at(distance) - height,
                distance - flank.toe,
                flank.heel - distance,
                _above_limit(flank, distance, height, s[index]),
            ]
        return np.array(columns).T


def unloaded_contact(
    pair: GearPair,
    direction: Direction,
    misalignment: Misalignment | None = None,
    sampling: Sampling | None = None,
) -> UnloadedContact:
    """Unloaded contact of a pair in one direction of travel, under errors of mounting if any."""
    how = sampling or Sampling()
    error = misalignment or Misalignment()
    mount = mounting(pair, direction, error)
    pinion, wheel = pair.mates(direction)
    nodes = flank_nodes(pinion, how.columns, how.rows)
    field = angle_field(wheel)
    pitch = 2.0 * np.pi / pair.pinion.teeth
    reach = how.positions_per_pitch * how.pitches // 2 + how.positions_per_pitch * (how.pairs // 2)
    phi = np.arange(-reach, reach + 1) * (pitch / how.positions_per_pitch)
    leads = np.asarray(lead_grid(mount, field, phi, tuple(nodes.point)))
    best = leads.argmax(axis=1)
    top = leads[np.arange(len(phi)), best]
    points = _refined(mount, pinion, wheel, phi, nodes.s[best], nodes.theta[best])
    interior = points.met & _within(pinion, wheel, points) & (points.lead > top - 1e-7)
    curve = np.where(interior, points.lead, top)
    edges = np.flatnonzero(np.isfinite(top) & ~interior)
    if not how.every_edge:
        n, phase = how.positions_per_pitch, np.arange(len(phi)) % how.positions_per_pitch
        leader = np.array([curve[phase == k].max() for k in range(n)])
        edges = edges[top[edges] > leader[phase[edges]] - GRID_BIAS]
    own = angle_field(pinion)
    x, y, curve[edges] = zoom(mount, own, field, nodes, phi[edges], best[edges], top[edges])
    # within the outline after all: on a ridge, say, which Newton has left from the node
    place = np.maximum(np.abs(x), np.abs(y)) < INSIDE
    missed = edges[place]
    if len(missed):
        s, theta, _ = pinion.parameters(*on_flank(own, x[place], y[place]))
        again = _refined(mount, pinion, wheel, phi[missed], s, theta)
        met = again.met & _within(pinion, wheel, again) & (again.lead > curve[missed] - 1e-7)
        points = points.changed(missed[met], again, met)
        interior[missed[met]], curve[missed[met]] = True, again.lead[met]
    return UnloadedContact(
        pair, direction, error, how, mount, nodes, phi, leads, curve, interior, points
    )


def _refined(
    mount: Mounting,
    pinion: Flank,
    wheel: Flank,
    phi: np.ndarray,
    s: np.ndarray,
    theta: np.ndarray,
) -> ContactPoints:
    """Refined from the pinion's points at edge parameters s (mm) and turns theta (rad)."""
    point = (pinion.at_cutter(s, theta)[0] * pinion.hand).T
    x, y, z = (np.asarray(c) for c in to_wheel(mount, phi, tuple(point)))
    chart = wheel.active_chart
    at = chart.coordinates(*wheel.cone.cone_distance_height(z, np.hypot(x, y)))
    u, v = (np.clip(np.asarray(c), -1.0, 1.0) for c in at)
    out = refine(
        mount,
        (pinion.surface, wheel.surface),
        (pinion.pieces["flank"], wheel.pieces["flank"]),
        phi,
        s,
        theta,
        np.asarray(horner(chart.s, u, v)),
        np.asarray(horner(chart.theta, u, v)),
    )
    s1, theta1, s2, theta2, lead, left, first, determinant, z2, rho2 = out
    extreme = (determinant > 0.0) & (first < 0.0)
    return ContactPoints(s1, theta1, s2, theta2, lead, left, determinant, extreme, z2, rho2)


def _within(pinion: Flank, wheel: Flank, points: ContactPoints) -> np.ndarray:
    """Whether refined points lie on both active flanks (tip, toe, heel, fillet limit)."""
    slack = 1e-9
    inside = np.ones(len(points.s1), dtype=bool)
    for flank, s, theta in ((pinion, points.s1, points.theta1), (wheel, points.s2, points.theta2)):
        position, _ = flank.at_cutter(s, theta)
        rho = np.hypot(position[:, 0], position[:, 1])
        distance, height = flank.cone.cone_distance_height(position[:, 2], rho)
        inside &= (distance >= flank.toe - slack) & (distance <= flank.heel + slack)
        piece = flank.pieces["flank"]
        inside &= height <= flank.tip.at(distance) + slack
        inside &= _above_limit(flank, distance, height, s) >= -slack
        inside &= s <= float(piece.high) + slack
    return inside


def _above_limit(
    flank: Flank, distance: np.ndarray, height: np.ndarray, s: np.ndarray
) -> np.ndarray:
    """How far, mm, points stand above the fillet limit along the edge, or above what undercut takes away."""
    above = s - float(flank.pieces["flank"].low)
    if "flank" not in flank.cut_away:
        return above
    return np.minimum(above, height - np.asarray(flank.active_chart.bounds(distance)[0]))
