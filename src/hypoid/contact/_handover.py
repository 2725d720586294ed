"""Where one tooth pair hands on to the next, and the extremes of the motion curve in between.

A motion curve has its cusps where two pairs' curves cross, as a rule between the positions that are
looked at; its summits lie between them, too. Both are read from cubics through the nearest positions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

LEVEL = 1e-10  # rad: curves that part by less run together (conjugate pairs), and hand on nowhere


@dataclass(frozen=True)
class Handover:
    """A crossing of two neighbouring pairs' curves (rad)."""

    angle: float  # pinion angle
    lead: float


def handovers(phi: np.ndarray, curves: np.ndarray) -> list[Handover]:
    """Crossings at which the leader of curves (pairs, positions) changes, over even angles phi, rad."""
    found: list[Handover] = []
    known = np.isfinite(curves.max(axis=0))
    leader = np.where(known, np.argmax(curves, axis=0), -1)
    for i in np.flatnonzero((np.diff(leader) != 0) & known[1:] & known[:-1]):
        lines = [_through(phi, curves[k], int(i)) for k in (leader[i], leader[i + 1])]
        if lines[0] is None or lines[1] is None:
            continue  # one of them ends here: the flank's outline, not its neighbour, is the reason
        apart = lines[0] - lines[1]
        if np.abs(apart(np.array([0.0, 1.0]))).max() < LEVEL:
            continue
        inside = [r.real for r in apart.roots() if abs(r.imag) < 1e-9 and 0.0 <= r.real <= 1.0]
        if inside:
            at = float(inside[0])
            angle = phi[i] + at * (phi[i + 1] - phi[i])
            found.append(Handover(float(angle), float(lines[0](at))))
    return found


def peak_to_peak(phi: np.ndarray, curves: np.ndarray) -> float:
    """Of the greatest of curves (pairs, positions), rad: between its highest summit and deepest cusp."""
    envelope = curves.max(axis=0)
    lowest = min([float(envelope.min()), *(h.lead for h in handovers(phi, curves))])
    top = int(envelope.argmax())
    line = curves[int(curves[:, top].argmax())]
    return _summit(line, top) - lowest


def _summit(line: np.ndarray, top: int) -> float:
    """Greatest value of a curve near its position ``top``, by a parabola where both sides go on."""
    if not 0 < top < len(line) - 1 or not np.isfinite(line[top - 1 : top + 2]).all():
        return float(line[top])
    before, at, after = line[top - 1 : top + 2]
    bend = before - 2.0 * at + after
    return float(at - (after - before) ** 2 / (8.0 * bend) if bend < 0.0 else at)


def _through(phi: np.ndarray, line: np.ndarray, i: int) -> np.polynomial.Polynomial | None:
    """A curve between positions i and i + 1 as a polynomial of the share of the way; None if it ends."""
    near = [j for j in range(i - 1, i + 3) if 0 <= j < len(phi) and np.isfinite(line[j])]
    if i not in near or i + 1 not in near:
        return None
    at = np.array(near, dtype=float) - i
    return np.polynomial.Polynomial(np.polynomial.polynomial.polyfit(at, line[near], len(near) - 1))
