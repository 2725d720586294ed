"""What a shaft's and its bearings' stiffness must be to hold a member.

A 6 x 6 matrix K at the crossing point: forces (N) and moments (N mm) of the bearings' frame over displacements (mm)
and turns (rad) of the member, three each. Its axes are fixed in space: z along the member's axis to the heel, x square
to it in the plane of both axes' directions, to where the other member's axis points, y along the common perpendicular.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
SYMMETRIC, POSITIVE = 1e-6, 1e-10
STIFFNESS_EXPECTED = (
    "6 rows of 6 plain numbers in N/mm, N and N mm/rad, symmetric, with every displacement held; row and "
    "column 6, the turn about the axis, may be zero: then the drive holds it"
)
STIFFNESS_EXAMPLE = [
    [2e5, 0, 0, 0, 0, 0],
    [0, 2e5, 0, 0, 0, 0],
    [0, 0, 1e5, 0, 0, 0],
    [0, 0, 0, 1e9, 0, 0],
    [0, 0, 0, 0, 1e9, 0],
    [0, 0, 0, 0, 0, 0],
]


def bearing_compliance(stiffness: Sequence[Sequence[float]]) -> Array:
    """Compliance (6, 6), mm and rad over N and N mm, of a stiffness; a turn that the drive holds has none.

    Raises ValueError, which says why, for what is no stiffness of a held member.
    """
    try:
        given = np.array(stiffness, dtype=float)
    except (TypeError, ValueError):
        given = np.zeros(0)
    if given.shape != (6, 6) or not np.isfinite(given).all():
        raise ValueError("not 6 rows of 6 numbers")
    scale = np.sqrt(np.abs(np.diagonal(given)))
    driven = not given[5].any() and not given[:, 5].any()
    kept = np.arange(5 if driven else 6)
    if not (np.diagonal(given)[kept] > 0.0).all():
        raise ValueError("a displacement that nothing holds: the diagonal must be above zero")
    own = given[np.ix_(kept, kept)] / np.outer(scale[kept], scale[kept])
    if np.abs(own - own.T).max() > SYMMETRIC:
        raise ValueError("not symmetric")
    own = 0.5 * (own + own.T)
    if np.linalg.eigvalsh(own)[0] < POSITIVE:
        raise ValueError("not positive definite: some displacement is held by nothing")
    made = np.zeros((6, 6))
    made[np.ix_(kept, kept)] = np.linalg.inv(own) / np.outer(scale[kept], scale[kept])
    return made
