"""Newton in the three parameters of a sweep: edge parameter, cutter's turn and cradle's turn, side by side."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp

from hypoid.geometry import Batch, cross, dot, once

Turns = tuple[Batch, Batch, Batch]  # edge parameter (mm), cutter's turn and cradle's turn (rad)
STEPS = 40
ARRIVED = 1e-11  # mm


def determinant(rows: Any) -> Batch:
    """Of 3 x 3 systems, a tuple or an array of three rows each."""
    return dot(tuple(rows[0]), cross(tuple(rows[1]), tuple(rows[2])))


def solved(rows: Any, values: Any) -> Turns:
    """Solutions of 3 x 3 systems: the first three rows, and right-hand sides."""
    f, g, h = (tuple(row) for row in rows[:3])
    first, second, third = cross(g, h), cross(h, f), cross(f, g)
    share = 1.0 / dot(f, first)
    return tuple(  # pyright: ignore[reportReturnType]
        share * (values[0] * a + values[1] * b + values[2] * c)
        for a, b, c in zip(first, second, third, strict=True)
    )


def newton_sweep(
    function: Callable[..., tuple[Batch, ...]],
    start: Turns,
    limits: tuple[float, float, float],
) -> tuple[Turns, tuple[Batch, ...], Any]:
    """Newton towards the zero of a function's first three values, steps limited (mm, rad, rad).

    Returns where it ended, all values there, and their slopes: value i by unknown k is [i][k].
    """

    def look(at: Turns) -> tuple[tuple[Batch, ...], Any]:
        directions = jnp.eye(3)[:, :, None] * jnp.ones_like(at[0])

        def push(direction: Any) -> Any:
            return jax.jvp(function, at, (direction[0], direction[1], direction[2]))

        values, slopes = jax.vmap(push, out_axes=(None, 0))(directions)
        return values, once(slopes)

    def step_of(values: Any, slopes: Any) -> Turns:
        step = solved(slopes, values)
        size = jnp.max(jnp.stack([jnp.abs(d) / n for d, n in zip(step, limits, strict=True)]), 0)
        share = jnp.where(jnp.isfinite(size), 1.0 / jnp.maximum(1.0, size), 0.0)
        return tuple(share * jnp.nan_to_num(d) for d in step)  # pyright: ignore[reportReturnType]

    def go_on(state: Any) -> Any:
        count, _, _, values, _ = state
        left = jnp.abs(values[0]) + jnp.abs(values[1]) + jnp.abs(values[2])
        return (count < STEPS) & jnp.any(left > ARRIVED)

    # Each turn moves first and looks then, so that what is seen last needs no compiling of its own.
    def again(state: Any) -> Any:
        count, at, step, *_ = state
        at = tuple(a - d for a, d in zip(at, step, strict=True))
        values, slopes = look(at)
        return count + 1, at, step_of(values, slopes), values, slopes

    zero = jnp.zeros_like(start[0])
    seen = (jnp.full_like(zero, jnp.inf),) * len(jax.eval_shape(function, *start))
    rows = (jnp.zeros((3, *zero.shape)),) * len(seen)
    _, at, _, values, slopes = jax.lax.while_loop(go_on, again, (0, start, (zero,) * 3, seen, rows))
    return at, values, slopes
