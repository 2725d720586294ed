"""Flank edges of face-mill and stick blades as functions of their measures, any of which may be traced."""

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


def stick_plane(
    eccentric_angle: Scalar, hook_angle: Scalar, rake_angle: Scalar, side: Scalar, phase: Scalar
) -> tuple[tuple[Scalar, Scalar], tuple[Scalar, Scalar]]:
    """What 1 mm across a stick blade, and 1 mm to its tip, moves in the cutter's x-y plane.

    As ``TriAcHead`` places its blades; ``phase`` (rad) turns the blade about the cutter's axis.
    """
    across = -jnp.tan(rake_angle) / jnp.cos(hook_angle)
    up = -jnp.tan(hook_angle)
    c, s = jnp.cos(eccentric_angle), jnp.sin(eccentric_angle)
    first, second = (side * c + across * s, across * c - side * s), (up * s, up * c)
    return _turned(first, phase), _turned(second, phase)


def _turned(v: tuple[Scalar, Scalar], angle: Scalar) -> tuple[Scalar, Scalar]:
    c, s = jnp.cos(angle), jnp.sin(angle)
    return c * v[0] - s * v[1], s * v[0] + c * v[1]


def stick_edges(
    radius: Scalar,
    blade_angle: Scalar,
    curvature: Scalar,
    *,
    height: Scalar,
    eccentric_angle: Scalar,
    hook_angle: Scalar,
    rake_angle: Scalar,
    side: Scalar,
    phase: Scalar,
) -> tuple[EdgePiece, EdgePiece]:
    """Flank and flat of a Tri-Ac stick blade in the cutter frame (mm, rad, 1/mm), without ends.

    The flank's s is 0 at the pitch point P, ``height`` above the tips, where the blade has its angle;
    the flat's s is 0 at the sharp corner of a straight edge. ``side`` is +1 for the outer blade, -1
    for the inner one [vimercati2005, Figs. 2-4; notes, items 6, 7].
    """
    across, up = stick_plane(eccentric_angle, hook_angle, rake_angle, side, phase)
    tangent = jnp.tan(blade_angle)
    twist = tangent * jnp.tan(rake_angle) * jnp.sin(hook_angle)
    lean = jnp.arctan2(tangent, jnp.cos(hook_angle) + twist)  # alpha_t, in the projection
    sine, cosine = jnp.sin(lean), jnp.cos(lean)
    x, y = _turned((radius, 0.0 * radius), phase)
    zero = 0.0 * radius

    def placed(a: Scalar, b: Scalar) -> tuple[Scalar, Scalar, Scalar]:
        return a * across[0] + b * up[0], a * across[1] + b * up[1], b + zero

    flank = EdgePiece(
        start=(x, y, zero - height),
        tangent=placed(sine, -cosine),
        metal=placed(cosine, sine),
        curvature=curvature + zero,
        relief=zero,
        relief_from=zero,
        low=zero,
        high=zero,
    )
    off = placed(-height * sine / cosine, height)
    flat = EdgePiece(
        start=(x + off[0], y + off[1], zero),
        tangent=placed(1.0, 0.0),
        metal=placed(0.0, 1.0),
        curvature=zero,
        relief=zero,
        relief_from=zero,
        low=zero,
        high=zero,
    )
    return flank, flat
