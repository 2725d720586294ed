"""Gaps, the contact pattern and the ease-off, read off the leads of one contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._field import angle_field, lead_each
from ._mounting import to_wheel
from ._unloaded import UnloadedContact

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Pattern:
    """Where a marking compound would be wiped off, over the pinion's active flank (mm).

    Rows run from the fillet limit to the tip, columns from toe to heel; the same points are given
    on the wheel, where they come nearest to it.
    """

    gap: Array  # (rows, columns) least normal gap over all positions; inf where nothing comes near
    distance: Array  # (columns,) S of the pinion
    height: Array  # (rows, columns) H of the pinion
    wheel_distance: Array  # (rows, columns) S of the wheel at the nearest position
    wheel_height: Array
    thickness: float

    @property
    def touched(self) -> Array:
        return self.gap <= self.thickness

    @property
    def share(self) -> float:
        """Touched share of the active flank."""
        return float(self.touched.mean())

    @property
    def centre(self) -> tuple[float, float]:
        """Centre of the touched area as (S, H) of the pinion, mm; NaN if nothing is touched."""
        if not self.touched.any():
            return (np.nan, np.nan)
        distance = np.broadcast_to(self.distance, self.gap.shape)
        return float(distance[self.touched].mean()), float(self.height[self.touched].mean())


def _levers(contact: UnloadedContact, phi: Array) -> tuple[Array, Array, Array]:
    """Levers (mm) of the nodes at one pinion angle each, and their wheel z and rho.

    The lever (r x n) . axis turns an angle of the wheel into a normal distance.
    """
    nodes = contact.nodes
    x, y, z = (np.asarray(c) for c in to_wheel(contact.mount, phi, tuple(nodes.point)))
    nx, ny, _ = to_wheel(contact.mount, phi, tuple(nodes.normal), free=True)
    return np.abs(x * np.asarray(ny) - y * np.asarray(nx)), z, np.hypot(x, y)


def pattern(contact: UnloadedContact, thickness: float | None = None) -> Pattern:
    """Contact pattern at a marking thickness (mm; the pair's own by default) over all positions."""
    n = contact.sampling.positions_per_pitch
    period = contact.envelope[:n]
    lead = period[(np.arange(len(contact.phi)) - contact.cycle[0]) % n]
    leads = np.where(np.isfinite(contact.leads), contact.leads, np.nan)
    behind = np.nan_to_num(lead[:, None] - leads, nan=np.inf)
    best = behind.argmin(axis=0)
    lever, z, rho = _levers(contact, contact.phi[best])
    gap = behind[best, np.arange(len(best))] * lever
    wheel = contact.wheel_flank.cone.cone_distance_height(z, rho)
    shape = contact.nodes.height.shape
    gap = np.where(np.isfinite(gap), np.maximum(gap, 0.0), np.inf)
    return Pattern(
        gap.reshape(shape),
        contact.nodes.distance,
        contact.nodes.height,
        wheel[0].reshape(shape),
        wheel[1].reshape(shape),
        contact.pair.marking_thickness if thickness is None else thickness,
    )


@dataclass(frozen=True)
class EaseOff:
    """The pinion against the wheel's conjugate: normal distance, positive where material is missing.

    Split by least squares about the mean point into first and second orders; the crownings are the
    drops at half the face width and half the active depth from there, the bias that at a corner.
    """

    value: Array  # (rows, columns), mm; NaN where the conjugate leaves the mating tooth
    distance: Array  # (columns,)
    height: Array  # (rows, columns)
    pressure_angle: float  # rad, d(ease-off)/dH
    spiral_angle: float  # rad, d(ease-off)/dS
    lengthwise_crowning: float  # mm
    profile_crowning: float  # mm
    bias: float  # mm
    residual: float  # mm, rms of what the six terms leave


def vertices(contact: UnloadedContact) -> tuple[Array, Array]:
    """Pinion angle where each node's lead is greatest, rad, and whether that lies within the passage.

    The vertex of the parabola through the best position and its neighbours; the lead is stationary
    there, so that an error of the vertex counts squared.
    """
    leads, phi = contact.leads, contact.phi
    best, columns = leads.argmax(axis=0), np.arange(leads.shape[1])
    inner = (best > 0) & (best < len(phi) - 1)
    before, after = np.maximum(best - 1, 0), np.minimum(best + 1, len(phi) - 1)
    lower, top, upper = (leads[k, columns] for k in (before, best, after))
    inner &= np.isfinite(lower) & np.isfinite(upper)
    lower, top, upper = (
        np.where(inner, v, -float(k == 1)) for k, v in enumerate((lower, top, upper))
    )
    shift = 0.5 * (lower - upper) / (lower - 2.0 * top + upper)
    return phi[best] + np.where(inner, shift, 0.0) * (phi[1] - phi[0]), inner


def ease_off(contact: UnloadedContact) -> EaseOff:
    """Ease-off of a pair: for each pinion point the least gap over the whole roll, uniform motion."""
    vertex, inner = vertices(contact)
    point = tuple(contact.nodes.point)
    lead = np.asarray(lead_each(contact.mount, angle_field(contact.wheel_flank), vertex, point))
    value = np.where(inner, -lead * _levers(contact, vertex)[0], np.nan)
    value = value.reshape(contact.nodes.height.shape)
    return _split(value, contact)


def _split(value: Array, contact: UnloadedContact) -> EaseOff:
    nodes, cones = contact.nodes, contact.pair.blank.cones
    half_face = 0.5 * (nodes.distance[-1] - nodes.distance[0])
    half_depth = 0.5 * float((nodes.height[-1] - nodes.height[0]).mean())
    x = (nodes.distance - cones.pinion_mean_cone_distance) / half_face
    x, y = np.broadcast_to(x, value.shape), nodes.height / half_depth
    there = np.isfinite(value)
    if there.sum() < 6:
        nothing = (float("nan"),) * 6
        return EaseOff(value, nodes.distance, nodes.height, *nothing)
    fit, left = six_terms(value, x, y)
    return EaseOff(
        value,
        nodes.distance,
        nodes.height,
        pressure_angle=float(fit[2] / half_depth),
        spiral_angle=float(fit[1] / half_face),
        lengthwise_crowning=float(fit[3]),
        profile_crowning=float(fit[4]),
        bias=float(fit[5]),
        residual=float(np.sqrt(np.nanmean(left**2))),
    )


def six_terms(value: Array, x: Array, y: Array) -> tuple[Array, Array]:
    """Least-squares coefficients (6,) of 1, x, y, x**2, y**2, xy, and what they leave, NaN where no value is."""
    there = np.isfinite(value)
    terms = np.stack([np.ones_like(x), x, y, x * x, y * y, x * y], axis=-1)
    fit, *_ = np.linalg.lstsq(terms[there], value[there], rcond=None)
    return fit, value - terms @ fit
