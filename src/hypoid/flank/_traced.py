"""A flank as a function of everything that makes it, for derivatives: settings, motions and edge."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import jax
import jax.numpy as jnp

from hypoid.cutter import EdgePiece
from hypoid.geometry import Batch, Scalar
from hypoid.machine import MachineSettings, Motions, generator

from ._envelope import Surface
from ._flank import Flank

ORDERS = 6  # of the cradle angle, in every motion
SETTINGS = (
    "radial_distance", "cradle_angle", "machine_root_angle", "ratio_of_roll",
    "roll_to_blade_ratio", "tilt_angle", "swivel_angle", "blank_offset",
    "machine_center_to_back", "sliding_base", "helical_motion", "cutter_lead",
)  # fmt: skip


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class FlankParameters:
    """Everything that makes one flank, as a tree of numbers to differentiate by (mm, rad).

    ``settings`` are the basic ones by name, in the signs of the generator chain; ``roll`` holds c2 to
    c6; ``motions`` six coefficients an axis; ``edge`` the piece of the blade that cuts the flank.
    """

    settings: Mapping[str, Scalar]
    roll: Batch  # (5,)
    motions: Mapping[str, Batch]  # (6,) each
    edge: EdgePiece


def flank_parameters(flank: Flank) -> FlankParameters:
    """The parameters that a flank was cut with."""
    own = flank.settings
    moved = {
        name: jnp.array([*getattr(own.motions, name), *[0.0] * ORDERS][:ORDERS])
        for name in Motions.__dataclass_fields__
    }
    return FlankParameters(
        settings={name: jnp.float64(getattr(own, name)) for name in SETTINGS},
        roll=jnp.array([*own.modified_roll, *[0.0] * (ORDERS - 1)][: ORDERS - 1]),
        motions=moved,
        edge=jax.tree_util.tree_map(jnp.float64, flank.pieces["flank"]),
    )


def traced_surface(parameters: FlankParameters, flank: Flank) -> Surface:
    """The surface that parameters make, meshing at the same root as ``flank``; all may be traced.

    The closed way for a plain roll serves no other, so a face-hobbed flank meshes by Newton here.
    """
    settings: MachineSettings = replace(
        flank.settings,
        **parameters.settings,
        modified_roll=tuple(parameters.roll),
        motions=Motions(**{name: tuple(c) for name, c in parameters.motions.items()}),
    )
    own = flank.surface
    way = "newton" if own.way == "cradle" else own.way
    return Surface(generator(settings, axes_move=True), own.branch, own.outward, way)
