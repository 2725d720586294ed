"""Robust fits over a grid: the part's turn, a smooth map, and which points do not belong."""

from __future__ import annotations

from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
ROUNDS = 12
HUBER = 1.5  # times the scatter
OUT = 5.0  # times the scatter: an outlier
LEAST_OUT = 0.003  # mm: nothing closer to the smooth map is one
MAD = 1.4826  # median of absolute values to standard deviation of a normal distribution


def smooth_terms(x: Array, y: Array, points: int) -> Array:
    """Polynomial terms (n, k) without the constant, as high as so many points carry: cubic at most."""
    order = 3 if points >= 24 else 2 if points >= 12 else 1
    powers = [(i, j) for i in range(order + 1) for j in range(order + 1 - i) if i + j]
    return np.stack([x**i * y**j for i, j in powers], axis=1)


def robust(columns: Array, value: Array) -> tuple[Array, Array]:
    """Coefficients (k,) by Huber's weights, and which values (n,) lie out; NaN values take no part.

    Outliers lie further off the fit than five times its scatter (by the median) and 3 um.
    """
    there = np.isfinite(value)
    a, v = columns[there], value[there]
    weight = np.ones(len(v))
    fit = np.zeros(columns.shape[1])
    left, scatter = v, np.inf
    for _ in range(ROUNDS):
        root = np.sqrt(weight)
        fit, *_ = np.linalg.lstsq(root[:, None] * a, root * v, rcond=None)
        left = v - a @ fit
        free = max(1, len(v) - columns.shape[1])
        scatter = MAD * float(np.median(np.abs(left))) * np.sqrt(len(v) / free)
        weight = np.minimum(1.0, HUBER * max(scatter, 1e-12) / np.maximum(np.abs(left), 1e-300))
    out = np.zeros(len(value), dtype=bool)
    out[there] = np.abs(left) > max(OUT * scatter, LEAST_OUT)
    if out.any() and (there & ~out).sum() > columns.shape[1]:
        keep = ~out[there]
        fit, *_ = np.linalg.lstsq(a[keep], v[keep], rcond=None)
    return fit, out
