"""Root stress over the mesh cycle: stress at the fillets' nodes per unit hat, times the hats' forces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ._compliance import SIGHT, ToothCompliance
from ._loaded import LoadCase, LoadedContact

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class RootStress:
    """Stress in both fillets of one tooth of a member over its passage, MPa; points left hand, mm."""

    member: Literal["pinion", "wheel"]
    pinion_angle: Array  # (m,) rad: of this tooth's own pair, rising
    points: Array  # (p, 3)
    side: Array  # (p,) 0 concave fillet, 1 convex
    distance: Array  # (p,) S, mm
    height: Array  # (p,) H, mm
    greatest: Array  # (m, p) maximum principal stress
    least: Array  # (m, p) minimum principal stress
    von_mises: Array  # (m, p)
    loaded_side: int  # the fillet below the loaded flank: the tension side

    @property
    def max_principal(self) -> float:
        """Greatest tension anywhere in the fillets over the cycle, MPa."""
        return float(self.greatest.max(initial=0.0))

    @property
    def max_von_mises(self) -> float:
        return float(self.von_mises.max(initial=0.0))

    @property
    def most_compressed(self) -> float:
        """Most negative principal stress, MPa."""
        return float(self.least.min(initial=0.0))

    @property
    def critical(self) -> int:
        """Point of the greatest tension."""
        return int(self.greatest.max(axis=0).argmax())

    @property
    def most_pressed(self) -> int:
        """Point of the greatest compression in the fillet opposite the loaded flank; -1 where there is none."""
        opposite = np.flatnonzero(self.side != self.loaded_side)
        if not len(opposite):
            return -1
        return int(opposite[self.least[:, opposite].min(axis=0).argmin()])


def root_stress(
    loaded: LoadedContact, case: LoadCase, member: Literal["pinion", "wheel"]
) -> RootStress:
    """Stress in a member's fillets, of one tooth from before its contact until after it."""
    teeth: ToothCompliance = getattr(loaded.teeth, member)
    pitch, sense = loaded.unloaded.pitch, loaded.teeth.sense
    rows: list[tuple[float, Array]] = []
    for position in case.pitch:
        loads = {p.pair: getattr(p, f"{member}_hats") for p in position.pairs}
        if not loads:
            continue
        for k in range(min(loads) - SIGHT, max(loads) + SIGHT + 1):
            near = {n: f for n, f in loads.items() if abs(k - n) <= SIGHT}
            total = sum(
                (teeth.stress[sense * (k - n) % teeth.teeth] @ f for n, f in near.items()),
                np.zeros(6 * len(teeth.fillet_points)),
            )
            rows.append((position.pinion_angle - k * pitch, total.reshape(-1, 6)))
    rows.sort(key=lambda row: row[0])
    stress = np.array([row[1] for row in rows])
    principal = np.linalg.eigvalsh(tensor(stress))
    flank = loaded.pair.mates(loaded.direction)[0 if member == "pinion" else 1]
    x, y, z = teeth.fillet_points.T
    distance, height = flank.cone.cone_distance_height(z, np.hypot(x, y))
    a, b, c = np.moveaxis(principal, -1, 0)
    return RootStress(
        member,
        np.array([row[0] for row in rows]),
        teeth.fillet_points,
        teeth.fillet_side,
        np.asarray(distance),
        np.asarray(height),
        c,
        a,
        np.sqrt(0.5 * ((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2)),
        0 if teeth.side == "concave" else 1,
    )


def tensor(stress: Array) -> Array:
    """Symmetric tensors (..., 3, 3) from components (..., 6): xx, yy, zz, xy, yz, zx."""
    xx, yy, zz, xy, yz, zx = np.moveaxis(stress, -1, 0)
    rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
