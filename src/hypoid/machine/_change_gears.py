"""Change gears: four wheels a/b * c/d for a wanted ratio, from the wheels that a shop has."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from hypoid.geometry import DesignError, Problem

SHOP = range(24, 101)  # teeth of the wheels that a set usually holds, one of each
EXACT = 1e-12  # relative: a train closer than this is the ratio
NEIGHBOURS = 8  # products looked at on each side of the wanted one


@dataclass(frozen=True)
class ChangeGears:
    """Four wheels (a, b, c, d) of the train a/b * c/d, and how far it is off what was wanted."""

    teeth: tuple[int, int, int, int]
    wanted: float

    @property
    def ratio(self) -> float:
        """What the train gives."""
        return train(self.teeth)

    @property
    def residual(self) -> float:
        """Ratio minus what was wanted."""
        return self.ratio - self.wanted

    @property
    def exact(self) -> bool:
        """Whether nothing but rounding of floats is left."""
        return abs(self.residual) <= EXACT * abs(self.wanted)


def train(teeth: Iterable[int]) -> float:
    """Ratio a/b * c/d of four change gears (the lists' order: driver, driven, driver, driven)."""
    a, b, c, d = teeth
    return a * c / (b * d)


def reach(available: Iterable[int] = SHOP) -> tuple[float, float]:
    """Least and greatest ratio of four different wheels."""
    wheels = sorted(set(available))
    top = wheels[-1] * wheels[-2] / (wheels[0] * wheels[1])
    return 1.0 / top, top


def nearest_gears(
    ratio: float,
    available: Iterable[int] = SHOP,
    *,
    repeats: bool = False,
    path: str = "change_gears",
) -> ChangeGears:
    """The four wheels whose train comes nearest to a positive ratio; a few ms for 77 wheels.

    ``repeats`` allows a wheel twice. Among equally near trains the one with the gentlest steps
    (both a/b and c/d near one) is taken. A ratio that is no positive number, or fewer than four
    wheels, is a `DesignError` at ``path``.
    """
    wheels = np.array(sorted(set(available)))
    if len(wheels) < 4 or wheels[0] < 1:
        given = f"{len(wheels)} wheels, the smallest with {wheels[0] if len(wheels) else 0} teeth"
        raise DesignError(
            [Problem(path, given, "at least four wheels, each with teeth", "range(24, 101)")]
        )
    if not (math.isfinite(ratio) and ratio > 0.0):
        raise DesignError([Problem(path, f"a ratio of {ratio}", "a positive ratio", "0.7970")])
    first, second = np.triu_indices(len(wheels), k=0 if repeats else 1)
    products = wheels[first] * wheels[second]
    order = np.argsort(products, kind="stable")
    low, high, products = wheels[first][order], wheels[second][order], products[order]

    at = np.searchsorted(products, ratio * products)  # of each driven pair, its best drivers
    near = np.clip(at[:, None] + np.arange(-NEIGHBOURS, NEIGHBOURS), 0, len(products) - 1)
    off = np.abs(products[near] / products[:, None] - ratio)
    if not repeats:
        shared = (low[near] == low[:, None]) | (high[near] == high[:, None])
        shared |= (low[near] == high[:, None]) | (high[near] == low[:, None])
        off = np.where(shared, np.inf, off)
    best = np.argwhere(off <= off.min() + 1e-15 * ratio)
    driven = best[:, 0]
    drivers = near[driven, best[:, 1]]
    steps = np.stack([low[drivers] / low[driven], high[drivers] / high[driven]])
    pick = int(np.argmin(np.abs(np.log(steps)).max(axis=0)))
    i, j = drivers[pick], driven[pick]
    return ChangeGears((int(low[i]), int(low[j]), int(high[i]), int(high[j])), ratio)
