"""Tensor polynomials read by powers (NumPy) and by Horner (everything else): one value."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest

from hypoid.geometry import horner, horner_line


@pytest.mark.parametrize("shape", [(1, 1), (2, 5), (16, 16)])
def test_numpy_and_jax_read_the_same(shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(sum(shape))
    powers = rng.normal(size=shape)
    x, y = rng.uniform(-1.0, 1.0, (2, 40))
    expected = np.polynomial.polynomial.polyval2d(x, y, powers)
    np.testing.assert_allclose(horner(powers, x, y), expected, atol=1e-13)
    traced = horner(jnp.asarray(powers), jnp.asarray(x), jnp.asarray(y))
    np.testing.assert_allclose(horner(powers, x, y), traced, atol=1e-13)
    line = powers[0]
    np.testing.assert_allclose(
        horner_line(line, x), np.polynomial.polynomial.polyval(x, line), atol=1e-13
    )
    assert horner(powers, 0.3, -0.2) == pytest.approx(
        np.polynomial.polynomial.polyval2d(0.3, -0.2, powers), abs=1e-13
    )
