"""Sine, cosine and arctangent by arithmetic, against 40 digits and against their derivatives."""

from __future__ import annotations

import jax
import mpmath
import numpy as np
import pytest

from hypoid.geometry import sine_cosine, unit_angle

QUARTERS = np.arange(-41, 41) * np.pi / 2


def angles() -> np.ndarray:
    rng = np.random.default_rng(0)
    return np.concatenate([rng.uniform(-4, 4, 200), rng.uniform(-1e4, 1e4, 100), QUARTERS, [0.0]])


def test_sine_and_cosine_to_an_ulp_of_one(forty_digits: None) -> None:
    x = angles()
    sine, cosine = (np.asarray(v) for v in jax.jit(sine_cosine)(x))
    for k, angle in enumerate(x):
        assert abs(mpmath.sin(mpmath.mpf(angle)) - sine[k]) < 2e-16
        assert abs(mpmath.cos(mpmath.mpf(angle)) - cosine[k]) < 2e-16


def test_unit_angle_is_the_angle(forty_digits: None) -> None:
    x = np.concatenate([np.linspace(-3.14, 3.14, 301), [np.pi, 0.0, np.pi / 4, -np.pi / 2]])
    found = np.asarray(jax.jit(unit_angle)(np.cos(x), np.sin(x)))
    for k in range(len(x)):
        exact = mpmath.atan2(mpmath.mpf(np.sin(x[k])), mpmath.mpf(np.cos(x[k])))
        assert abs(exact - found[k]) < 5e-16


def test_derivatives() -> None:
    for x in (0.3, -2.0, 7.5):
        (s, c), (ds, dc) = jax.jvp(sine_cosine, (x,), (2.0,))
        assert (ds, dc) == pytest.approx((2.0 * np.cos(x), -2.0 * np.sin(x)), abs=1e-15)
        assert (s, c) == pytest.approx((np.sin(x), np.cos(x)), abs=1e-15)
        slope = jax.grad(lambda t: unit_angle(*sine_cosine(t)[::-1]))(x)
        assert slope == pytest.approx(1.0, abs=1e-14)
