"""Results under one torque: what each pair carries, each position, and the mesh cycle."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from hypoid.contact import Misalignment

from ._active_set import Outcome

Array = np.ndarray[Any, Any]
PAIRS = (9, 11, 13)  # tooth pairs that are looked at, more where the outermost carries load


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
    pairs_needed: int = (
        0  # to be looked at, where the outermost that was carries load; more than MOST_PAIRS
    )
    leaves_at: float = 0.0  # N mm, about: the contact leaves the flanks; 0 where it does not

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
        """Contact ratio under load: the mean number of pairs that touch, counted in whole positions."""
        return float(np.mean([len(p.pairs) for p in self.pitch]))

    @property
    def arc_of_contact(self) -> float:
        """Pitches over which one pair carries load; NaN where the cycle was cut short.

        The same as the contact ratio with ever more positions. Where contact comes and goes between two positions is
        read from the pair's next two forces, to the power 2/3 of which its approach grows; half-way where they say
        that it came before, as it does at an edge.
        """
        if len(self.pitch) < self.per_pitch:
            return float("nan")
        approach = {
            k - load.pair * self.per_pitch: load.force ** (2.0 / 3.0)
            for k, at in enumerate(self.pitch)
            for load in at.pairs
        }
        steps = 0.0
        for k, here in approach.items():
            for way in (-1, 1):
                if k + way in approach:
                    steps += 0.5
                else:
                    rise = approach.get(k - way, 0.0) - here
                    steps += here / rise if here < rise else 0.5
        return steps / self.per_pitch

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
        words = list(dict.fromkeys(p.outcome.value for p in self.positions if p.outcome.value))
        words = [f"{w}{self._advice(w)}" for w in words]
        at_edges = [
            p for p in self.positions if p.edge_contact and p.outcome is not Outcome.LEFT_FLANKS
        ]
        names = sorted(
            {p.edge for at in at_edges for p in at.pairs if p.edge_pressure > at.max_pressure}
        )
        if at_edges and self.max_pressure == 0.0:
            words.append(f"Edges ({', '.join(names)}) bear all of the load.")
        elif at_edges:
            words.append(
                f"Edge contact ({', '.join(names)}) at {len(at_edges)} of {len(self.positions)} positions: more "
                "relief or crowning, or less torque; pressure at an edge is not reported as the greatest."
            )
        if any(p.open_window for p in self.positions):
            words.append(
                "A contact did not fit its cells' window; its pressure is not to be trusted."
            )
        return tuple(f"At {self.torque * 1e-3:g} N m: {w}" for w in words)

    def _advice(self, words: str) -> str:
        if words == Outcome.MORE_PAIRS.value and self.pairs_needed:
            if self.pairs_needed > PAIRS[-1]:
                return f" More than the {PAIRS[-1]} that can be are needed: less torque."
            return f" {self.pairs_needed} are needed."
        if words == Outcome.LEFT_FLANKS.value:
            count = sum(p.outcome is Outcome.LEFT_FLANKS for p in self.positions)
            begins = f"from about {self.leaves_at * 1e-3:.2g} N m on, " if self.leaves_at else ""
            return (
                f" This is so {begins}here at {count} of {len(self.positions)} positions. Pressure and stress "
                "mean nothing there: less torque."
            )
        return ""


def _spline_range(values: Array) -> float:
    """Greatest less least of a periodic cubic spline through even steps of a period."""
    line = CubicSpline(np.arange(len(values) + 1), np.append(values, values[0]), bc_type="periodic")
    turns = line.derivative().roots(extrapolate=False)
    return float(np.ptp(np.concatenate([values, line(turns[np.isfinite(turns)])])))
