"""A flank's points from its cutter parameters, by whichever way its meshing condition is met."""

from __future__ import annotations

import jax.numpy as jnp

from hypoid.cutter import EdgePiece
from hypoid.geometry import Batch, unit_angle

from ._generator import Placed, Way, mesh_closed, mesh_newton, place, place_plain, sweep, to_cradle
from ._pose import Generator
from ._revolution import mesh_cutter


def meshed(
    gen: Generator, piece: EdgePiece, s: Batch, turn: Batch, branch: Batch, way: Way
) -> tuple[Placed, Batch]:
    """Points at edge parameters s (mm) and turns (rad), and the meshing condition's discriminant.

    The turn is the cradle's angle for the way ``cutter``, else the cutter's theta. A negative
    discriminant says that the edge never meshes there.
    """
    if way == "cutter":
        at, mesh = mesh_cutter(gen, piece, s, turn, branch)
        return at, mesh.discriminant
    edge = sweep(gen, piece, s, turn)
    if way == "form":
        return place(gen, edge, turn, 0.0 * turn), jnp.ones_like(turn)
    if way == "cradle":
        edge = to_cradle(gen, edge)
        mesh = mesh_closed(gen, edge, branch)
        return place_plain(gen, edge, turn, mesh), mesh.discriminant
    mesh = mesh_newton(gen, edge, branch)
    return place(gen, edge, turn, unit_angle(mesh.cosine, mesh.sine)), mesh.discriminant
