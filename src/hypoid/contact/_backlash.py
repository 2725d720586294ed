"""Backlash of a mounted pair from its flanks: how far the wheel turns between both contacts.

The pinion stands still. Driving, its concave flank stops the wheel's convex one; coasting, its convex
flank the wheel's concave one. What the wheel may turn in between is the play.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hypoid.flank import flank_angles
from hypoid.pair import Direction, GearPair

from ._unloaded import UnloadedContact, unloaded_contact


@dataclass(frozen=True)
class Backlash:
    """Play of the wheel, pinion held; negative where the pair jams (rad, mm)."""

    wheel_angle: float
    mean_transverse: float  # along the wheel's mean pitch circle
    outer_transverse: float  # along its outer pitch circle
    mean_normal: float  # square to the flanks at the mean point
    outer_normal: float


def backlash(drive: UnloadedContact, coast: UnloadedContact, pinion_angle: float = 0.0) -> Backlash:
    """Backlash at a pinion angle (rad, of drive) from both contacts of one pair under one mounting."""
    pair = drive.pair
    pinion_pitch, wheel_pitch = (2.0 * math.pi / m.teeth for m in (pair.pinion, pair.wheel))
    # The pinion as it stands in drive, and at which angle of coast its convex flank stands so.
    stands = drive.mount.pinion_zero - pinion_angle
    back = stands + pair.pinion.stock_turn - coast.mount.pinion_zero
    back -= pinion_pitch * round(back / pinion_pitch)
    stop = -_turned(drive, pinion_angle) - pair.wheel.stock_turn
    other = -_turned(coast, back)
    play = stop - other
    play -= wheel_pitch * round(play / wheel_pitch)
    wheel = pair.wheel.blank
    angles = flank_angles(pair.wheel.convex)
    square = math.cos(angles.pressure) * math.cos(angles.spiral)
    mean, outer = 0.5 * wheel.mean_pitch_diameter, 0.5 * wheel.outer_pitch_diameter
    return Backlash(play, play * mean, play * outer, play * mean * square, play * outer * square)


def _turned(contact: UnloadedContact, angle: float) -> float:
    """How far the wheel has turned back at a pinion angle, rad, as a left-hand member."""
    n = contact.sampling.positions_per_pitch
    one = np.append(contact.envelope[:n], contact.envelope[0])
    share = (angle - contact.phi[contact.cycle[0]]) / contact.pitch % 1.0
    lead = float(np.interp(share * n, np.arange(n + 1), one))
    mount = contact.mount
    return float(mount.sense) * (lead + float(mount.wheel_zero) + float(mount.ratio) * angle)


def pair_backlash(pair: GearPair) -> Backlash:
    """Backlash of a pair as it is meant to be mounted, at pinion angle zero."""
    directions: tuple[Direction, Direction] = ("drive", "coast")
    drive, coast = (unloaded_contact(pair, d) for d in directions)
    return backlash(drive, coast)
