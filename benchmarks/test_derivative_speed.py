"""Speed of exact derivatives; run with `make bench`.

Target: the Jacobian of a 45-point ease-off grid with respect to 20 settings under 20 ms, warm.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import pytest

import hypoid
from hypoid.contact import traced_contact, unloaded_contact
from hypoid.geometry import jitted

EXAMPLES = Path(__file__).parent.parent / "examples"
SETTINGS = (
    "radial_distance", "cradle_angle", "machine_root_angle", "ratio_of_roll", "tilt_angle",
    "swivel_angle", "blank_offset", "machine_center_to_back", "sliding_base", "helical_motion",
)  # fmt: skip
ROLL, TILT = 5, 5  # coefficients beside them


@pytest.mark.parametrize("name", ["lin-tsay-fong-1996", "vimercati-piazza-2005"])
def test_jacobian_of_the_ease_off(benchmark: Any, name: str) -> None:
    """Ten settings, the roll to the sixth order and five coefficients of a moving tilt of the pinion."""
    one = traced_contact(unloaded_contact(hypoid.read(EXAMPLES / f"{name}.toml"), "drive"))

    def gaps(x: Any) -> Any:
        own = one.parameters.pinion
        settings = {**own.settings} | {n: own.settings[n] + x[k] for k, n in enumerate(SETTINGS)}
        tilt = jnp.asarray(own.motions["tilt_angle"]).at[:TILT].add(x[-TILT:])
        pinion = replace(
            own,
            settings=settings,
            roll=own.roll + x[len(SETTINGS) : -TILT],
            motions={**own.motions, "tilt_angle": tilt},
        )
        return one.ease_off(replace(one.parameters, pinion=pinion))

    jacobian, x = jitted(jax.jacfwd(gaps)), jnp.zeros(len(SETTINGS) + ROLL + TILT)
    found = benchmark(lambda: jacobian(x).block_until_ready())
    assert found.shape == (5, 9, 20)
