"""One pitch of a gear, from a slot's bottom over the tooth to the next slot, as patches of points.

Every surface of the cell is a patch of p x q quadrangles whose sides q run around the axis and whose
sides p follow the outline of the axial section: along the teeth from toe to heel, down the heel, over
the rim and the back face, along the bore, over the front face and up the toe. Turned by the pitch, the
start of each patch's sides q is the end of another cell's.

The end faces lie on the cones S = toe and S = heel, whose straight lines are those of constant angle:
below row ``level`` of the flanks each place of the profile is joined with the base line at its own angle,
above it each row of the concave flank is joined with that of the convex one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.flank import SIDES, PitchCone, Tooth, ToothGrid

from ._body import Body
from ._division import Division

Array = np.ndarray[Any, Any]
Line = tuple[Array, Array]  # heights (mm) and angles (rad, left hand) of places


@dataclass(frozen=True, eq=False)
class Cell:
    """Exact points of one pitch: radius, angle (left hand) and z, at the mesh's places and half-way between."""

    grid: ToothGrid
    division: Division
    level: int
    patches: dict[str, Array]  # (2 p + 1, 2 q + 1, 3)

    @property
    def around(self) -> int:
        """Segments of the base line, of the faces and of the bore."""
        return self.division.bottom + 2 * self.level + self.division.land


def cell(tooth: Tooth, grid: ToothGrid, division: Division, body: Body) -> Cell:
    """The cell of a tooth that is given at the division's lines and half-way between them."""
    cone, level = tooth.concave.cone, level_row(grid)
    profile = _profile(grid, division.land)
    patches = {"teeth": _placed(cone, grid.distance[:, None], profile)}
    below = _below(profile, grid, division, level)
    ring = below[1]  # angles of base line and bore, by column
    for column, end in ((-1, "heel"), (0, "toe")):
        ordered = slice(None, None, 1 if end == "toe" else -1)  # the heel is climbed down
        top = below[0][column]
        across = [
            _between(grid, r, division.land) for r in range(2 * level, len(grid.concave.height[0]))
        ]
        strip = tuple(np.stack([line[k][column] for line in across]) for k in (0, 1))
        base = np.full_like(top, body.base_height[column])
        lines = np.stack([base, 0.5 * (base + top), top])
        distance = grid.distance[column]
        patches[f"{end} above"] = _placed(cone, distance, strip)[ordered]
        patches[f"{end} below"] = _placed(cone, distance, (lines, ring[column][None, :]))[ordered]
    toe_base, front, back, corner, heel_base = body.outline
    share = (grid.distance - grid.distance[0]) / (grid.distance[-1] - grid.distance[0])
    along = (front[0] + share * (back[0] - front[0]))[:, None]
    patches |= {
        "rim": _turned(ring[-1], heel_base, corner),
        "back": _turned(ring[-1], corner, back),
        "bore": _stacked(body.bore, ring, along)[::-1],
        "front": _turned(ring[0], front, toe_base),
    }
    return Cell(grid, division, level, patches)


def level_row(grid: ToothGrid) -> int:
    """Lowest row above which the rows' lines across the end faces do not cross each other."""
    rows = (grid.concave.height.shape[1] - 1) // 2
    for level in range(rows):
        if _uncrossed(grid, slice(2 * level, None, 2)):
            return level
    return rows - 1


def _uncrossed(grid: ToothGrid, rows: slice) -> bool:
    """Whether the quadrangles between lines from flank to flank are convex at toe and heel."""
    for column in (0, -1):
        a, d = (
            np.stack([p.angle[column, rows], p.height[column, rows]])
            for p in (grid.concave, grid.convex)
        )
        corners = a[:, :-1], d[:, :-1], d[:, 1:], a[:, 1:]
        for k in range(4):
            before, here, after = corners[k - 1], corners[k], corners[(k + 1) % 4]
            (x, y), (u, v) = here - before, after - here
            if not (x * v - y * u > 0.0).all():
                return False
    return True


def _profile(grid: ToothGrid, land: int) -> Line:
    """Bottom, concave flank, top land and convex flank of each column (doubled)."""
    height, angle = _between(grid, -1, land)
    up, down = slice(1, -1), slice(-2, None, -1)
    return (
        np.hstack([grid.bottom_height, grid.concave.height[:, up], height, grid.convex.height[:, down]]),
        np.hstack([grid.bottom_angle, grid.concave.angle[:, up], angle, grid.convex.angle[:, down]]),
    )  # fmt: skip


def _below(profile: Line, grid: ToothGrid, division: Division, level: int) -> Line:
    """The profile cut off at the level row: its places below, and the line across the tooth."""
    first = grid.bottom_height.shape[1] + 2 * level - 1
    last = profile[0].shape[1] - 2 * level - 1
    across = _between(grid, 2 * level, division.land)
    return (
        np.hstack([profile[0][:, :first], across[0], profile[0][:, last + 1 :]]),
        np.hstack([profile[1][:, :first], across[1], profile[1][:, last + 1 :]]),
    )


def _between(grid: ToothGrid, row: int, land: int) -> Line:
    """The line (columns, 2 land + 1) from the concave to the convex flank at one row."""
    share = np.linspace(0.0, 1.0, 2 * land + 1)
    start, end = (
        np.stack([p.height[:, row], p.angle[:, row]])[..., None]
        for p in (grid.side(s) for s in SIDES)
    )
    height, angle = start + (end - start) * share
    return height, angle


def _placed(cone: PitchCone, distance: Any, line: Any) -> Array:
    """Radius, angle, z of places (S, H) at angles."""
    z, radius = cone.axial_radial(distance, line[0])
    return _stacked(radius, line[1], z)


def _turned(angle: Array, start: tuple[float, float], end: tuple[float, float]) -> Array:
    """A line (z, radius) of the axial section turned about the axis: a face or a cylinder."""
    z, radius = (np.linspace(a, b, 3)[:, None] for a, b in zip(start, end, strict=True))
    return _stacked(radius, angle[None, :], z)


def _stacked(radius: Any, angle: Any, z: Any) -> Array:
    return np.stack(np.broadcast_arrays(radius, angle, z), axis=-1)
