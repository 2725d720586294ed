"""NumPy for plain numbers and arrays, JAX for its own: small work never pays for a compilation."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np


def namespace(*values: Any) -> Any:
    """``jax.numpy`` if any value (or any leaf of it) belongs to JAX, else ``numpy``."""
    traced = any(isinstance(leaf, jax.Array) for leaf in jax.tree_util.tree_leaves(values))
    return jnp if traced else np
