"""Settings of one pinion flank: from the wheel's exact conjugate to the method's closest, in stages."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.blank import PairBlank
from hypoid.flank import Side
from hypoid.machine import MachineSettings

from ._conjugate import conjugate
from ._fit import CUT, Fit, Look, gauss_newton
from ._milled_request import MilledRequest
from ._milled_wheel import MilledWheel, pitch_cone
from ._pinion_methods import BASE, HEAD, METHODS, Freedom, blade_wish, step_limits
from ._pinion_model import UM, PinionModel, Seen, Wish, lead_of, pinion_model
from ._settings_model import INDEX, MOTIONS, NAMES, ROLL, settings_of, vector_of
from ._wheel_settings import wheel_cut

Array = np.ndarray[Any, Any]
ROOT_SPREAD = 0.01  # mm
FEWEST = 20  # points of the conjugate that a fit needs
LEADING = math.radians(0.02)  # how firmly tilt is led to zero
ADVICE = (*HEAD, *ROLL[:3], "helical_motion", "blade_curvature", *MOTIONS)


@dataclass(frozen=True)
class FlankFit:
    """One pinion flank as fitted; mm and rad."""

    side: Side
    settings: MachineSettings
    point_radius: float
    blade_angle: float
    vector: Array  # all entries, as `_settings_model.NAMES`
    free: tuple[str, ...]
    distance: Array  # (n,) S of the residual map
    height: Array  # (n,) H
    residual: Array  # (n,) mm, ease-off less its target; NaN where nothing counts
    wanted: Array  # (n,) mm, the target ease-off
    root_error: Array  # (3,) mm, height of the root as cut less the blank's, toe to heel
    fit: Fit
    helpful: tuple[tuple[str, float], ...]  # entries not free, and the rms in mm that they promise

    @property
    def rms(self) -> float:
        """Root mean square of the residual map, mm."""
        return float(np.sqrt(np.nanmean(self.residual**2)))

    @property
    def largest(self) -> float:
        """Greatest residual either way, mm."""
        return float(np.nanmax(np.abs(self.residual)))

    @property
    def undetermined(self) -> tuple[str, ...]:
        """Directions that the target does not determine, and which were left alone, in words."""
        values, rows = self.fit.singular_values, self.fit.directions
        return tuple(
            ", ".join(
                f"{self.free[k]} {row[k]:+.2f}"
                for k in np.argsort(-np.abs(row))[:4]
                if abs(row[k]) > 0.1
            )
            for value, row in zip(values, rows, strict=True)
            if value <= CUT * values[0]
        )


def conjugate_start(wheel: MilledWheel, blank: PairBlank, side: Side) -> Array:
    """The vector of the pinion flank that a form-cut wheel flank generates exactly.

    The cutter stands on the wheel cutter's axis and faces it, on a cradle along the wheel's axis; its
    blade is the wheel's cone [notes on vimercati2005: blades of the opposite kind].
    """
    cut, own = wheel.cut, blank.wheel
    root = cut.machine_root_angle
    sine, cosine = math.sin(root), math.cos(root)
    height = cut.depth + own.mean_addendum + (blank.clearance or 0.0)
    along = cut.radial_distance * math.cos(cut.cradle_angle)
    x = sine * along - cosine * cut.deeper + height * cosine
    y = -cut.radial_distance * math.sin(cut.cradle_angle)
    z = height * sine - (cosine * along + sine * cut.deeper - cut.machine_center_to_back)
    q = math.atan2(-y, x)
    settings = MachineSettings(
        radial_distance=math.hypot(x, y),
        cradle_angle=q,
        machine_root_angle=blank.shaft_angle - 0.5 * math.pi,
        ratio_of_roll=own.teeth / blank.pinion.teeth,
        roll_to_blade_ratio=0.0,
        tilt_angle=0.5 * math.pi - root,
        swivel_angle=q - 0.5 * math.pi,
        blank_offset=blank.offset,
        sliding_base=-z,
    )
    i = 1 if side == "concave" else 0  # the pinion's outside blade is the wheel's inside cone
    angle = cut.blade_angles[i]
    sign = -1.0 if side == "concave" else 1.0
    radius = cut.point_radii[i] + sign * height * math.tan(angle)
    blade = {"point_radius": radius, "blade_angle": angle, "blade_curvature": 0.0}
    return vector_of(settings, blade)


def plain_start(request: MilledRequest, blank: PairBlank, side: Side) -> Array:
    """The vector of a pinion flank that a crown gear in its root plane generates, as a bevel pinion's.

    It has the blank's root, and its pressure and spiral angle at the mean point; no tilt.
    """
    own, angles = blank.pinion, blank.pressure_angles
    assert angles is not None
    cut = wheel_cut(
        own,
        cutter_radius=request.blank.cutter_radius,
        slot_width=0.5 * math.pi * blank.mean_normal_module,
        pressure_angles=(angles.drive, angles.coast),
        generated=True,
    )
    settings = MachineSettings(
        radial_distance=cut.radial_distance,
        cradle_angle=cut.cradle_angle,
        machine_root_angle=cut.machine_root_angle,
        ratio_of_roll=cut.ratio_of_roll,
        roll_to_blade_ratio=0.0,
        swivel_angle=cut.cradle_angle - 0.5 * math.pi,
        machine_center_to_back=cut.machine_center_to_back,
    )
    i = 0 if side == "concave" else 1
    blade = {"point_radius": cut.point_radii[i], "blade_angle": cut.blade_angles[i]}
    return vector_of(settings, blade | {"blade_curvature": 0.0})


def fit_pinion(
    request: MilledRequest, blank: PairBlank, wheel: MilledWheel, side: Side
) -> FlankFit | None:
    """Settings of a pinion flank for a request; None where there is nothing to start from.

    From the plain start for a generated wheel, from the exact conjugate for a form-cut one; where that
    does not reach the target, from the other, too.
    """
    drive = side == "concave"
    cone = pitch_cone(blank, "pinion")
    found = conjugate(blank, wheel.flank("convex" if drive else "concave"), cone)
    if found.there.sum() < FEWEST:
        return None
    target = request.drive if drive else request.coast
    angles = blank.pressure_angles
    assert angles is not None
    wish = blade_wish(angles.drive if drive else angles.coast)

    def work(start: Array, lead: Array, roll: Array) -> _Work:
        model = pinion_model(side, found, blank, cone, start, lead, roll, target, ROOT_SPREAD)
        return _Work(model, step_limits(blank, start[INDEX["ratio_of_roll"]]), wish)

    method = METHODS[request.pinion_method]

    def from_plain() -> FlankFit | None:
        start = plain_start(request, blank, side)
        along = found.distance - blank.pinion.mean_cone_distance
        depth = blank.pinion.mean_dedendum + along * math.tan(blank.pinion.dedendum_angle)
        lead = (found.height + depth) / math.cos(start[INDEX["blade_angle"]])
        return _from_plain(work(start, lead, np.zeros(len(lead))), start, method)

    def from_conjugate() -> FlankFit | None:
        start = conjugate_start(wheel, blank, side)
        return _from_conjugate(work(start, lead_of(found, start), found.roll), start, method)

    best: FlankFit | None = None
    starts = (from_plain, from_conjugate)
    for begin in starts if request.wheel_method == "generated" else starts[::-1]:
        fit = begin()
        if best is None or (fit is not None and fit.fit.cost < best.fit.cost):
            best = fit
        if best is not None and best.largest <= request.tolerance:
            break
    return best


def _from_plain(work: _Work, start: Array, method: Freedom) -> FlankFit | None:
    """The method's entries free at once, tilt resting where it starts or is not free."""
    if work.model.there.sum() < FEWEST:
        return None
    first = tuple(name for name in method.free if name in (*BASE, *HEAD))
    stage = work.run(start, first, {}, work.model.start_memory)
    return None if stage is None else _finished(work, *stage, first, method)


def _from_conjugate(work: _Work, start: Array, method: Freedom) -> FlankFit | None:
    """Tilt and swivel free; then, where the method has none, led to zero and kept there."""
    if work.model.there.sum() < FEWEST:
        return None
    free = (*BASE, *HEAD)
    stage = work.run(start, free, {}, work.model.start_memory)
    if stage is None:
        return None
    vector, fit = stage
    if method.rest:  # led there by a wish, then kept there
        lead = {"tilt_angle": Wish(0.0, LEADING)}
        lead |= {"swivel_angle": Wish(vector[INDEX["swivel_angle"]], math.radians(1.0))}
        stage = work.run(vector, (*method.free, *HEAD), lead, fit.look.memory, steps=80)
        if stage is None:
            return None
        vector, fit = stage
        vector = vector.copy()
        vector[[INDEX[name] for name in method.rest]] = 0.0
        free = ()
    return _finished(work, vector, fit, free, method)


def _finished(
    work: _Work, vector: Array, fit: Fit, free: tuple[str, ...], method: Freedom
) -> FlankFit | None:
    """The last stage, with all that the method moves."""
    if set(method.free) != set(free):
        wishes = {name: Wish(0.0, spread) for name, spread in method.spreads.items()}
        stage = work.run(vector, method.free, wishes, fit.look.memory)
        if stage is None:
            return None
        vector, fit = stage
    return _result(work, vector, fit, method.free)


@dataclass(frozen=True)
class _Work:
    model: PinionModel
    limits: Mapping[str, float]
    wishes: Mapping[str, Wish]

    def look(self, vector: Array, more: Mapping[str, Wish], memory: Any) -> Seen | None:
        return self.model.look(vector, {**self.wishes, **more}, memory)

    def run(
        self,
        vector: Array,
        free: tuple[str, ...],
        more: Mapping[str, Wish],
        memory: Any,
        steps: int = 60,
    ) -> tuple[Array, Fit] | None:
        """One stage: these entries free, with these wishes beside the blade's."""
        index = [INDEX[name] for name in free]

        def full(x: Array) -> Array:
            whole = vector.copy()
            whole[index] = x
            return whole

        def model(x: Array, memory: Any) -> Look | None:
            seen = self.look(full(x), more, memory)
            if seen is None:
                return None
            return Look(seen.residual, seen.jacobian[:, index], seen.memory)

        limits = np.array([self.limits[name] for name in free])
        fit = gauss_newton(model, vector[index], memory, limits, steps=steps)
        return None if fit is None else (full(fit.x), fit)


def _result(work: _Work, vector: Array, fit: Fit, free: tuple[str, ...]) -> FlankFit | None:
    model = work.model
    seen = work.look(vector, {}, fit.look.memory)
    if seen is None:
        return None
    count = int(model.there.sum())
    residual = np.full(len(model.there), np.nan)
    residual[model.there] = seen.residual[:count] * UM
    return FlankFit(
        side=model.side,
        settings=plain_settings(vector),
        point_radius=float(vector[INDEX["point_radius"]]),
        blade_angle=float(vector[INDEX["blade_angle"]]),
        vector=vector,
        free=free,
        distance=model.conjugate.distance,
        height=model.conjugate.height,
        residual=residual,
        wanted=model.wanted,
        root_error=seen.residual[count : count + 3] * model.root_spread,
        fit=fit,
        helpful=_helpful(seen, count, free, work.limits),
    )


def _helpful(
    seen: Seen, count: int, free: tuple[str, ...], limits: Mapping[str, float]
) -> tuple[tuple[str, float], ...]:
    """What one more free entry would leave of the residual, by one linear step, the best first."""
    scale = np.array([limits[name] for name in NAMES])
    jacobian = seen.jacobian * scale
    index = [INDEX[name] for name in free]
    basis, values, _ = np.linalg.svd(jacobian[:, index], full_matrices=False)
    basis = basis[:, values > CUT * values[0]]

    def off(v: Array) -> Array:
        return v - basis @ (basis.T @ v)

    left = off(seen.residual)
    found: list[tuple[str, float]] = []
    for name in ADVICE:
        if name in free:
            continue
        column = off(jacobian[:, INDEX[name]])
        size = float(column @ column)
        if size < 1e-12:
            continue
        rest = left - column * (column @ left) / size
        found.append((name, float(np.sqrt(np.mean(rest[:count] ** 2)) * UM)))
    return tuple(sorted(found, key=lambda entry: entry[1])[:3])


def plain_settings(vector: Array) -> MachineSettings:
    """The settings of a vector as plain numbers, with no motion where there is none."""
    held = settings_of([float(v) for v in vector])
    moved = held.motions
    names = type(moved).__dataclass_fields__
    kept = {n: getattr(moved, n) if any(getattr(moved, n)) else () for n in names}
    roll = tuple(held.modified_roll)
    while roll and not roll[-1]:
        roll = roll[:-1]
    return replace(held, modified_roll=roll, motions=replace(moved, **kept))
