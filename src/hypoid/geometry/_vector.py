"""Vectors as triples of arrays: what the hot paths are written in, component by component."""

from __future__ import annotations

import jax.numpy as jnp

from ._jax import Batch, Scalar, Vector


def cross(u: Vector, v: Vector) -> Vector:
    return (
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    )


def dot(u: Vector, v: Vector) -> Batch:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def add(u: Vector, v: Vector) -> Vector:
    return (u[0] + v[0], u[1] + v[1], u[2] + v[2])


def scale(k: Batch | Scalar, u: Vector) -> Vector:
    return (k * u[0], k * u[1], k * u[2])


def unit(u: Vector) -> Vector:
    return scale(1.0 / jnp.sqrt(dot(u, u)), u)


def turn_z(cosine: Batch, sine: Batch, u: Vector) -> Vector:
    """Turn about z by the angle whose cosine and sine are given."""
    return (cosine * u[0] - sine * u[1], sine * u[0] + cosine * u[1], u[2])
