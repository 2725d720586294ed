"""A flank as a function of everything that makes it, for derivatives: settings, motions, cam and edge."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

import jax
import numpy as np

from hypoid.cutter import EdgePiece
from hypoid.geometry import Batch, Scalar
from hypoid.machine import Cam, Generator, MachineSettings, Motions, generator

from ._flank import Flank

ORDERS = 6  # of the cradle angle, in every motion
SETTINGS = tuple(
    f.name
    for f in fields(MachineSettings)
    if f.name not in ("modified_roll", "motions", "cam", "generated")
)


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class FlankParameters:
    """Everything that makes one flank, as a tree of numbers to differentiate by (mm, rad).

    ``settings`` are the basic ones by name, in the signs of the generator chain; ``roll`` holds c2 to
    c6; ``motions`` six coefficients an axis; ``edge`` the piece of the blade that cuts.
    """

    settings: Mapping[str, Scalar]
    roll: Batch  # (5,)
    motions: Mapping[str, Batch]  # (6,) each
    cam: Cam | None
    edge: EdgePiece

    @classmethod
    def of(cls, settings: MachineSettings, edge: EdgePiece) -> FlankParameters:
        """Those of settings and of one edge piece."""

        def row(values: Any, length: int) -> np.ndarray:
            return np.array([*values, *[0.0] * length][:length], float)

        cam = settings.cam
        if cam is not None:  # never the seated cam's closed form: the seat may be what changes
            cam = Cam(*(np.asarray(float(getattr(cam, f.name))) for f in fields(cam)))
        return cls(
            settings={name: np.float64(getattr(settings, name)) for name in SETTINGS},
            roll=row(settings.modified_roll, ORDERS - 1),
            motions={
                f.name: row(getattr(settings.motions, f.name), ORDERS) for f in fields(Motions)
            },
            cam=cam,
            edge=jax.tree_util.tree_map(np.float64, edge),
        )

    @property
    def generator(self) -> Generator:
        """The generator, every axis free to move; all may be traced."""
        settings = MachineSettings(
            **self.settings,
            modified_roll=tuple(self.roll[k] for k in range(ORDERS - 1)),
            motions=Motions(
                **{n: tuple(c[k] for k in range(ORDERS)) for n, c in self.motions.items()}
            ),
            cam=self.cam,
        )
        return generator(settings, axes_move=True)


def flank_parameters(flank: Flank) -> FlankParameters:
    """The parameters that a flank was cut with, its flank piece the edge."""
    return FlankParameters.of(flank.settings, flank.pieces["flank"])
