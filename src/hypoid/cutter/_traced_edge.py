"""A face-mill blade's flank edge as a function of its measures, any of which may be traced."""

from __future__ import annotations

import jax.numpy as jnp

from hypoid.geometry import Scalar

from ._edge import EdgePiece


def mill_edge(
    point_radius: Scalar,
    angle: Scalar,
    curvature: Scalar = 0.0,
    *,
    side: Scalar = 1.0,
    reference_height: Scalar = 0.0,
    low: Scalar = 0.0,
    high: Scalar = 0.0,
) -> EdgePiece:
    """Straight or circular flank edge of a blade in the cutter frame (mm, rad, 1/mm).

    ``side`` is +1 for the outside blade, -1 for the inside blade. The blade has its angle, and s its
    zero, at ``reference_height`` above the tips, as ``MillBlade`` has it; a positive curvature crowns
    the tooth.
    """
    sine, cosine = jnp.sin(angle), jnp.cos(angle)
    zero = 0.0 * point_radius
    return EdgePiece(
        start=(
            point_radius + side * reference_height * sine / cosine,
            zero,
            zero - reference_height,
        ),
        tangent=(side * sine, zero, -cosine),
        metal=(side * cosine, zero, sine),
        curvature=curvature + zero,
        relief=zero,
        relief_from=zero,
        low=low + zero,
        high=high + zero,
    )
