"""Values to start from where a design does not say: ISO 23509, annex C. Plain numbers, mm and rad."""

from __future__ import annotations

from math import cos

DEPTH_FACTOR = 2.0  # k_d
CLEARANCE_FACTOR = 0.125  # k_c


def mean_addendum_factor(teeth: tuple[int, int], pitch_angles: tuple[float, float]) -> float:
    """c_ham, the wheel's share of the working depth, of the pair's equivalent ratio u_a.

    Each pair is (pinion, wheel); 0.5 for a ratio of one.
    """
    equivalent = teeth[1] / teeth[0] * cos(pitch_angles[0]) / cos(pitch_angles[1])
    return 0.21 + 0.29 / equivalent


def thickness_factor(teeth: tuple[int, int]) -> float:
    """k_t by which the pinion tooth is thickened for balanced strength, never below zero."""
    z1, u = teeth[0], teeth[1] / teeth[0]
    value = -0.088 + 0.092 * u - 0.004 * u**2 + 0.0016 * (z1 - 30) * (u - 1.0)
    return max(value, 0.0)


def widest_face(outer_cone_distance: float, outer_transverse_module: float) -> float:
    """Face width of the wheel that practice does not pass, mm: 0.3 R_e2 or 10 m_et2."""
    return min(0.3 * outer_cone_distance, 10.0 * outer_transverse_module)
