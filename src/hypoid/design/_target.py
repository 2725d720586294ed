"""What contact is asked for: an ease-off over the pinion's flank, or the motion and pattern it makes.

Ease-off is positive where the pinion lacks material against the wheel's conjugate. Places are the
pinion's: x runs from -1 at the toe to 1 at the heel about the mean point, y is the height over half
the working depth, positive to the tip.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.geometry import Problem

Array = np.ndarray[Any, Any]
KEPT = 0.85  # of the flank's height and half its length, on which a path is kept
NEAR = 0.35  # of x about its place, where the flank's height is read


@dataclass(frozen=True)
class TargetPlaces:
    """Where a target is asked for, (n,) each: x, y, and the pinion's turn and lever there."""

    x: Array
    y: Array
    height: Array  # mm above the pitch cone
    along: Array  # mm from the mean point, towards the heel
    turn: Array  # wheel's turn from the mean point's, rad
    wheel_lever: Array  # mm, turns a wheel angle into a normal distance
    wheel_pitch: Array | float  # rad


@dataclass(frozen=True)
class EaseOffTarget:
    """Ease-off by its parts; mm and rad. Crownings are drops at x = 1 and y = 1, bias that at a corner."""

    lengthwise_crowning: float = 0.015
    profile_crowning: float = 0.010
    bias: float = 0.0
    pressure_angle: float = 0.0  # d(ease-off)/dH
    spiral_angle: float = 0.0  # d(ease-off)/dS
    tip_relief: float = 0.0  # mm at y = 1, a parabola from `relief_from` on
    relief_from: float = 0.5  # y

    def at(self, places: TargetPlaces) -> Array:
        """Ease-off at places, mm (n,)."""
        x, y = places.x, places.y
        second = self.lengthwise_crowning * x**2 + self.profile_crowning * y**2 + self.bias * x * y
        first = self.pressure_angle * places.height + self.spiral_angle * places.along
        beyond = np.maximum(y - self.relief_from, 0.0) / (1.0 - self.relief_from)
        return second + first + self.tip_relief * beyond**2

    def problems(self, path: str) -> list[Problem]:
        """What makes no sense; the crownings must keep the contact off the edges."""
        found: list[Problem] = []
        for name in ("lengthwise_crowning", "profile_crowning"):
            if getattr(self, name) < 0.0:
                given = f"{1e3 * getattr(self, name):g} um"
                expected = "a length of 0 or more: a hollow flank touches at its ends"
                found.append(Problem(f"{path}.{name}", given, expected, f'{name} = "15 um"'))
        if self.tip_relief < 0.0:
            given, expected = f"{1e3 * self.tip_relief:g} um", "a length of 0 or more"
            found.append(Problem(f"{path}.tip_relief", given, expected, 'tip_relief = "10 um"'))
        if not -1.0 <= self.relief_from < 1.0:
            given, expected = f"{self.relief_from:g}", "from -1 (root) to below 1 (tip)"
            found.append(Problem(f"{path}.relief_from", given, expected, "relief_from = 0.5"))
        return found


@dataclass(frozen=True)
class MotionTarget:
    """A transmission error that is a parabola, and a pattern of a given length; mm and rad.

    Along each line of contact the ease-off grows with the square of the distance from the path, so
    that the path runs through ``place`` and a compound of ``marking_thickness`` is wiped off over
    ``pattern_length`` of the face. ``path_tilt`` leans the path: how far it moves lengthwise, in x,
    while it climbs by one y; None leans it just as far as keeps it on the flank over the whole pitch.
    """

    transmission_error: float = 50e-6  # rad peak to peak over one pitch, wheel
    pattern_length: float = 0.5  # of the face width
    marking_thickness: float = 0.00635
    place: tuple[float, float] = (0.0, 0.0)  # (x, y)
    path_tilt: float | None = None

    def at(self, places: TargetPlaces) -> Array:
        """Ease-off at places, mm (n,)."""
        x0, y0 = self.place
        x, y = places.x - x0, places.y - y0
        # turn at the place itself, from the plane through all of them
        middle, by_x, by_y = _plane(x, y, places.turn)
        half = 0.5 * np.asarray(places.wheel_pitch)
        along_path = ((places.turn - middle) / half) ** 2
        tilt = self.path_tilt
        if tilt is None:
            tilt = _least_tilt(places, (x0, y0), (by_x, by_y))
        off_path = x - tilt * y
        across = self.marking_thickness * (off_path / self.pattern_length) ** 2
        return self.transmission_error * places.wheel_lever * along_path + across

    def problems(self, path: str) -> list[Problem]:
        """What makes no sense."""
        found: list[Problem] = []
        if not 0.0 < self.pattern_length <= 1.0:
            given = f"{100.0 * self.pattern_length:g} %"
            expected = "above 0, up to 1: a share of the face width"
            example = "pattern_length = 0.5"
            found.append(Problem(f"{path}.pattern_length", given, expected, example))
        if self.transmission_error < 0.0:
            given = f"{1e6 * self.transmission_error:g} urad"
            expected = "an angle of 0 or more, peak to peak"
            example = 'transmission_error = "50 urad"'
            found.append(Problem(f"{path}.transmission_error", given, expected, example))
        if max(abs(self.place[0]), abs(self.place[1])) >= 1.0:
            given, expected = f"{list(self.place)}", "two numbers between -1 and 1, on the flank"
            found.append(Problem(f"{path}.place", given, expected, "place = [0.0, 0.0]"))
        return found


def _plane(x: Array, y: Array, turn: Array) -> tuple[float, float, float]:
    """Value, and slopes by x and y, of the plane through turns at places about (0, 0)."""
    there = np.isfinite(turn)
    basis = np.stack([np.ones_like(x), x, y], axis=1)[there]
    value, by_x, by_y = np.linalg.lstsq(basis, turn[there], rcond=None)[0]
    return float(value), float(by_x), float(by_y)


def _least_tilt(
    places: TargetPlaces, place: tuple[float, float], slopes: tuple[float, float]
) -> float:
    """The least lean of a path that keeps it on the flank for half a pitch either way of its place."""
    there = np.isfinite(places.turn)
    (x0, y0), (by_x, by_y) = place, slopes
    near = there & (np.abs(places.x - x0) < NEAR)
    tall = KEPT * min(float(places.y[near].max()) - y0, y0 - float(places.y[near].min()))
    half = 0.5 * float(np.mean(places.wheel_pitch))
    if tall <= 0.0 or abs(by_x) < 1e-6 * abs(by_y):
        return 0.0
    wanted = half / tall - abs(by_y)  # turn that the path must gain lengthwise, per y
    tilt = max(0.0, wanted / abs(by_x))
    wide = KEPT * (1.0 - abs(x0))
    return float(np.copysign(min(tilt, wide / tall), by_x * by_y))


Target = EaseOffTarget | MotionTarget
