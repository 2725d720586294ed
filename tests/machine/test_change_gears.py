"""Change gears against every train there is, and the trains that both papers print."""

from __future__ import annotations

from itertools import permutations, product
from math import inf, log, nan

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from hypoid.geometry import DesignError
from hypoid.machine._change_gears import SHOP, nearest_gears, reach, train

FEW = (24, 25, 31, 36, 48, 57, 71, 100)
PAIRS = np.array([(a, b) for a in SHOP for b in SHOP if a < b])


def nearest_of_all(ratio: float) -> float:
    """The least error of any train a/b * c/d of four different wheels of a full shop, all 8.5 million."""
    products, least = PAIRS[:, 0] * PAIRS[:, 1], inf
    for driven in PAIRS:
        apart = ~np.isin(PAIRS, driven).any(axis=1)
        off = np.abs(products[apart] / (driven[0] * driven[1]) - ratio).min()
        least = min(least, float(off))
    return least


@pytest.mark.parametrize("ratio", [np.pi / 4, 3.3, 0.0612, 16.2])
def test_no_train_of_a_full_shop_is_nearer(ratio: float) -> None:
    found = nearest_gears(ratio)
    assert len(set(found.teeth)) == 4
    assert set(found.teeth) <= set(SHOP)
    assert abs(found.residual) == pytest.approx(nearest_of_all(ratio), abs=1e-15)


@pytest.mark.parametrize("repeats", [False, True])
@settings(max_examples=100, deadline=None)
@given(ratio=st.floats(0.04, 25.0))
@example(ratio=0.2501)  # here the nearest product shares a wheel
def test_no_train_of_a_small_shop_is_nearer(repeats: bool, ratio: float) -> None:
    """Every choice of four wheels, one after the other."""
    choices = product(FEW, repeat=4) if repeats else permutations(FEW, 4)
    least = min(abs(a * c / (b * d) - ratio) for a, b, c, d in choices)
    found = nearest_gears(ratio, FEW, repeats=repeats)
    assert set(found.teeth) <= set(FEW)
    assert repeats or len(set(found.teeth)) == 4
    assert abs(found.residual) == pytest.approx(least, abs=1e-14 * ratio)
    assert found.residual == pytest.approx(train(found.teeth) - ratio, abs=1e-15)


@pytest.mark.parametrize("repeats", [False, True])
def test_gentlest_of_equally_near_trains(repeats: bool) -> None:
    """Of all trains with exactly 10/27, one whose steeper step is as near to one as can be."""
    wheels = range(24, 60)
    found = nearest_gears(10 / 27, wheels, repeats=repeats)
    assert found.exact

    def steep(a: int, b: int, c: int, d: int) -> float:
        return max(abs(log(a / b)), abs(log(c / d)))

    choices = [
        (a, b, c, d)
        for a, b, c in product(wheels, repeat=3)
        for d in [27 * a * c / (10 * b)]
        if d in wheels and (repeats or len({a, b, c, d}) == 4)
    ]
    assert steep(*found.teeth) == pytest.approx(min(steep(*t) for t in choices), abs=1e-12)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("teeth", "ratio"),
    [
        ((48, 80, 50, 81), 10 / 27),  # lin1996, Table 2
        ((42, 70, 45, 84), 9 / 28),
        ((53, 42, 48, 76), 6.641604 * 6 / 50),  # tsay1993, Table 1 and notes
        ((52, 66, 82, 49), 10.509163 / (0.313803110 * 25.4)),
    ],
)
def test_printed_trains(teeth: tuple[int, ...], ratio: float) -> None:
    """Driver, driven, driver, driven; each ratio has an exact train in a full shop."""
    assert train(teeth) == pytest.approx(ratio, abs=5e-7)
    found = nearest_gears(train(teeth))
    assert found.exact
    assert found.ratio == pytest.approx(train(teeth), rel=1e-15)


def test_a_ratio_between_trains_is_not_exact() -> None:
    found = nearest_gears(np.pi / 4)
    assert not found.exact
    assert found.wanted == np.pi / 4
    assert abs(found.residual) < 1e-6


def test_reach() -> None:
    """Both ends are trains, and what lies beyond comes out at the end."""
    low, high = reach()
    assert (low, high) == pytest.approx((24 * 25 / 9900, 9900 / 600))
    assert nearest_gears(high).exact
    assert nearest_gears(low).exact
    assert nearest_gears(40.0).ratio == pytest.approx(high)
    assert reach((10, 20, 30, 40)) == pytest.approx((1 / 6, 6.0))


@pytest.mark.parametrize("ratio", [0.0, -0.5, nan, inf])
def test_ratios_that_are_none(ratio: float) -> None:
    with pytest.raises(DesignError, match="a positive ratio") as caught:
        nearest_gears(ratio, path="pinion.settings.ratio_gears")
    assert [p.path for p in caught.value.problems] == ["pinion.settings.ratio_gears"]


@pytest.mark.parametrize("shop", [(), (24, 25, 26), (24, 24, 25, 26), (0, 24, 25, 26)])
def test_shops_that_are_none(shop: tuple[int, ...]) -> None:
    """Fewer than four different wheels, or one without teeth."""
    with pytest.raises(DesignError, match="at least four wheels, each with teeth"):
        nearest_gears(0.8, shop)
