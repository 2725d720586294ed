"""A pinion tooth against fine elements, for docs/validation/loaded-contact.md; run by hand.

    python benchmarks/fine_tooth.py 2 6

with torques in N m. The mate is rigid and stands where the unloaded contact puts it; gaps are those
of the exact surfaces for both. The reference knows no half-space: a block of 20-node bricks lies along the contact, its
upper face on the exact flank, finer than the contact is wide; its sides move as those of the whole tooth, whose own
elements are as fine as memory allows there. Both carry the same load, hat by hat.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import KDTree

import hypoid
from hypoid.contact import Sampling, to_pinion, unloaded_contact
from hypoid.flank import PitchCone
from hypoid.load import STEEL, Elements, Material, ToothCompliance, solve_contact
from hypoid.load._bricks import stiffness
from hypoid.load._hats import Hats, _loads, bilinear, hat_loads, shapes
from hypoid.load._patch import Meeting, meeting
from hypoid.load._position import Teeth, position_contact
from hypoid.load._superelement import factorised
from hypoid.pair import GearPair, Member
from hypoid.solid import body, hex_mesh, shape_gradients
from hypoid.solid._hex_cell import face_nodes
from hypoid.solid._hex_mesh import ACROSS, ROWS, _one

Array = np.ndarray[Any, Any]
EXAMPLE = Path(__file__).parent.parent / "examples" / "gonzalez-fuentes-2022-relief.toml"
SIDES = ("concave", "convex")
SIZES = Elements(along=24, profile=8, fillet=4, through=4, below=2, rim=2)  # of the method's tooth
ZONE = 3.2  # mm of S either side of the contact point where the whole tooth is fine
CORNERS = np.array(
    [
        [-1, -1, -1],
        [1, -1, -1],
        [1, 1, -1],
        [-1, 1, -1],
        [-1, -1, 1],
        [1, -1, 1],
        [1, 1, 1],
        [-1, 1, 1],
    ]
)
EDGES = np.array(
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]]
)
PLACES = np.concatenate([CORNERS, CORNERS[EDGES].mean(axis=1)]).astype(float)


def shape_values(at: Array) -> Array:
    """Shape functions (m, 20) of a brick at (m, 3)."""
    made = np.ones((len(at), 20))
    for k, place in enumerate(PLACES):
        for d in range(3):
            x = at[:, d]
            made[:, k] *= 1.0 - x * x if place[d] == 0.0 else 0.5 * (1.0 + x * place[d])
        if k < 8:
            made[:, k] *= at @ place - 2.0
    return made


@dataclass(frozen=True, eq=False)
class Tooth:
    """One tooth, its cuts free, its bore held."""

    nodes: Array
    elements: Array
    faces: Array  # (f, 8) of the flank
    free: Array  # degrees of freedom
    factor: Any

    def moved(self, load: Any) -> Array:
        """Displacements (3n, k) under loads (3n, k)."""
        out = np.zeros(load.shape)
        for start in range(0, load.shape[1], 48):
            part = slice(start, start + 48)
            right = load[:, part]
            right = right if isinstance(right, np.ndarray) else right.toarray()
            out[self.free, part] = self.factor.solve(np.ascontiguousarray(right[self.free]))
        return out


def tooth_of(nodes: Array, elements: Array, faces: Array, held: Array) -> Tooth:
    """A tooth ready to be loaded."""
    fixed = (3 * held[:, None] + np.arange(3)).ravel()
    free = np.setdiff1d(np.arange(3 * len(nodes)), fixed)
    matrix = stiffness(nodes, elements, STEEL)
    return Tooth(nodes, elements, faces, free, factorised(matrix[free][:, free]))


def fine_tooth(
    member: Member, side: str, middle: float, fine: int, profile: int, through: int
) -> Tooth:
    """The whole tooth, with `fine` sections within `ZONE` of S = middle and wider ones beyond."""
    flank = member.concave
    low, high = middle - ZONE, middle + ZONE
    inner = np.linspace(low, high, fine + 1)
    step, outer = inner[1] - inner[0], []
    for start, end in ((low, flank.toe), (high, flank.heel)):
        at, size = [start], step
        while abs(end - at[-1]) > 1.5 * size:
            size = min(1.5 * size, 2.5)
            at.append(at[-1] + np.sign(end - start) * size)
        outer.append(np.array([*at[1:-1], end]))
    ends = np.concatenate([outer[0][::-1], inner, outer[1]])
    every = np.sort(np.concatenate([ends, 0.5 * (ends[1:] + ends[:-1])]))
    grid = member.tooth.grid(every, ROWS, ACROSS)
    counts = {
        "along": len(ends) - 1,
        "profile": profile,
        "fillet": 4,
        "through": through,
        "below": 2,
    }
    made = _one(member, grid, body(member), counts, 2, True)
    held = np.unique(face_nodes(made.elements, made.faces["bore"]))
    print(f"whole tooth: {len(made.nodes)} nodes, {len(ends) - 1} sections")
    return tooth_of(
        made.nodes, made.elements, face_nodes(made.elements, made.faces[f"{side}_flank"]), held
    )


@dataclass(frozen=True, eq=False)
class Block:
    """Bricks along the contact: nodes (n, 3) in the pinion's frame; faces of the top in rows along and across."""

    nodes: Array
    elements: Array
    faces: Array  # (f, 8)
    number: Array  # (f, 4) hat of each corner: those of the top's corner nodes, along by across
    a: Array  # (hats,) place of the hats in the tangent plane, mm
    b: Array
    border: Array  # nodes on the five inner faces


def block(met: Meeting, along: Array, across: Array, deep: Array) -> Block:
    """The block on tangent-plane lines a and b, at depths from 0 on; all corner places, mm."""

    def halves(ends: Array) -> Array:
        out = np.repeat(np.asarray(ends, float), 2)[:-1]
        out[1::2] = 0.5 * (out[:-1:2] + out[2::2])
        return out

    a, b, t = (halves(v) for v in (along, across, deep))
    shape = (len(a), len(b), len(t))
    i, j, k = np.indices(shape)
    keep = (i % 2) + (j % 2) + (k % 2) <= 1
    index = np.full(shape, -1)
    index[keep] = np.arange(keep.sum())
    flat_a, flat_b = (v.ravel() for v in np.meshgrid(a, b, indexing="ij"))
    top = met.surface(flat_a, flat_b).point.reshape(len(a), len(b), 3)
    place = top[:, :, None] - t[:, None] * met.axes[2]
    mount = met.contact.mount
    nodes = to_pinion(mount, np.full(keep.sum(), met.phi), place[keep])
    # corners of a brick, local z down into the metal: a, b, outward normal are a right-hand system or not
    flip = (
        np.linalg.det(
            to_pinion(mount, np.zeros(3), met.axes)
            - to_pinion(mount, np.zeros(3), np.zeros((3, 3)))
        )
        < 0
    )
    elements, faces = [], []
    for e, f, g in product(range(len(along) - 1), range(len(across) - 1), range(len(deep) - 1)):
        around = PLACES if not flip else PLACES * [1, -1, 1]
        at = np.array([2 * e + 1, 2 * f + 1, 2 * g + 1]) + around.astype(int) * [1, 1, -1]
        own = index[at[:, 0], at[:, 1], at[:, 2]]
        elements.append(own)
        if g == 0:  # S2, local z = +1
            faces.append(own[[4, 5, 6, 7, 12, 13, 14, 15]])
    corner = index[::2, ::2, 0].ravel()
    hat = np.full(keep.sum(), -1)
    hat[corner] = np.arange(len(corner))
    made = np.array(faces)
    hat_a, hat_b = (v.ravel() for v in np.meshgrid(along, across, indexing="ij"))
    inner = (i > 0) & (i < len(a) - 1) & (j > 0) & (j < len(b) - 1) & (k < len(t) - 1)  # top too
    return Block(
        nodes, np.array(elements), made, hat[made[:, :4]], hat_a, hat_b, index[keep & ~inner]
    )


def located(tooth: Tooth, points: Array) -> tuple[Array, Array]:
    """Element (m,) of the whole tooth and shape functions (m, 20) at points that may stand a little off it."""
    middles = tooth.nodes[tooth.elements[:, :8]].mean(axis=1)
    _, near = KDTree(middles).query(
        points, k=min(200, len(middles))
    )  # sheared elements reach far from their middles
    best = np.full(len(points), np.inf)
    element, value = np.zeros(len(points), dtype=int), np.zeros((len(points), 20))
    for k in range(near.shape[1]):
        todo = np.flatnonzero(best > 1.0 + 1e-6)
        if not len(todo):
            break
        own = tooth.nodes[tooth.elements[near[todo, k]]]
        at = np.zeros((len(todo), 3))
        for _ in range(12):
            miss = points[todo] - np.einsum("mn,mnd->md", shape_values(at), own)
            slope = np.einsum("mkn,mnd->mkd", shape_gradients(at), own)
            at = np.clip(
                at + np.linalg.solve(slope.transpose(0, 2, 1), miss[..., None])[..., 0], -3, 3
            )
        size = np.abs(at).max(axis=1)
        better = size < best[todo]
        best[todo[better]] = size[better]
        element[todo[better]], value[todo[better]] = near[todo, k][better], shape_values(at)[better]
    out = best > 1.01
    print(
        f"{out.sum()} of {len(points)} points outside every element, by at most {best.max() - 1.0:.1e} half lengths"
    )
    return element, value


@dataclass(frozen=True, eq=False)
class Reference:
    """Fine elements' contact problem: hats by place in the tangent plane."""

    compliance: Array  # (h, h) mm/N
    gap: Array
    lever: Array
    area: Array
    a: Array
    b: Array
    uneven: float  # how far from symmetric the compliance came out, as a share of its greatest


def reference(met: Meeting, tooth: Tooth, made: Block, inside: Array) -> Reference:
    """Compliance of the hats `inside`, their gaps and levers: means under the hat."""
    count = len(made.a)
    load, area = _loads(made.nodes, made.faces, made.number, count, 1.0)
    load = (load / area).tocsc()[:, inside]
    x, w = np.polynomial.legendre.leggauss(4)
    at = np.stack([v.ravel() for v in np.meshgrid(x, x, indexing="ij")], axis=1)
    weight = np.outer(w, w).ravel()
    value, by_x, by_y = shapes(at)
    phi = bilinear(at)
    corner = made.nodes[made.faces]
    point = np.einsum("qk,fkd->fqd", value, corner)
    normal = np.cross(
        np.einsum("qk,fkd->fqd", by_x, corner), np.einsum("qk,fkd->fqd", by_y, corner)
    )
    size = weight * np.linalg.norm(normal, axis=-1)
    # the whole tooth under the same pressures
    flat = point.reshape(-1, 3)
    chosen = np.zeros(count, dtype=bool)
    chosen[inside] = True
    used = np.repeat(chosen[made.number].any(axis=1), len(at))
    element, shape = located(tooth, flat[used])
    inward = -(weight[:, None] * normal).reshape(-1, 3)[used]
    hats = np.repeat(made.number, len(at), axis=0)[used]
    share = np.tile(phi, (len(made.faces), 1))[used]
    whole = np.zeros((3 * len(tooth.nodes), count))
    for c in range(4):
        force = share[:, c, None, None] * shape[:, :, None] * inward[:, None, :]  # (m, 20, 3)
        dof = 3 * tooth.elements[element][:, :, None] + np.arange(3)
        np.add.at(whole, (dof.ravel(), np.repeat(hats[:, c], 60)), force.ravel())
    whole = whole[:, inside] / area[inside]
    start = time.process_time()
    far = tooth.moved(whole)
    print(f"whole tooth solved, {time.process_time() - start:.0f} s")
    own, shape = located(tooth, made.nodes[made.border])
    around = np.einsum("mn,mndh->mdh", shape, far.reshape(-1, 3, far.shape[1])[tooth.elements[own]])
    # the block: its border moves so
    edge = (3 * made.border[:, None] + np.arange(3)).ravel()
    free = np.setdiff1d(np.arange(3 * len(made.nodes)), edge)
    matrix = stiffness(made.nodes, made.elements, STEEL)
    right = load[free].toarray() - matrix[free][:, edge] @ around.reshape(len(edge), -1)
    moved = factorised(matrix[free][:, free]).solve(right)
    found = load[free].T @ moved + load[edge].T @ around.reshape(len(edge), -1)
    uneven = float(np.abs(found - found.T).max() / np.abs(found).max())
    # gaps and levers, on rays through the same points
    plane = []
    for k in range(2):
        plane.append(
            np.einsum("fc,qc->fq", np.stack([made.a, made.b])[k][made.number], phi).ravel()
        )
    surface = met.surface(*plane)
    gaps, levers = surface.gaps(), surface.levers[0]
    gaps = np.where(np.isfinite(gaps), gaps, 1.0)
    means = []
    for values in (gaps, levers):
        total = np.zeros(count)
        np.add.at(
            total,
            made.number.ravel(),
            np.einsum("fq,qc,fq->fc", size, phi, values.reshape(size.shape)).ravel(),
        )
        means.append((total / area)[inside])
    return Reference(
        0.5 * (found + found.T), *means, area[inside], made.a[inside], made.b[inside], uneven
    )


def graded(fine: float, to: float, until: float, growth: float) -> Array:
    """Places from 0 on: steps `fine` up to `to`, then growing to end at `until`."""
    at = list(np.linspace(0.0, to, max(1, round(to / fine)) + 1))
    size = fine
    while at[-1] < until - 1e-9:
        size *= growth
        left = until - at[-1]
        at.append(until if left < 1.6 * size else at[-1] + size)
    return np.array(at)


def ours(pair: GearPair, met: Meeting, sizes: Elements) -> Teeth:
    """The method's compliance of the same tooth alone, against a rigid wheel."""
    member, flank = pair.pinion, met.contact.pinion_flank
    mesh = hex_mesh(member, teeth=1, quadratic=True, **sizes.counts())
    tooth = tooth_of(
        mesh.nodes, mesh.elements, mesh.face_nodes(f"{flank.side}_flank"), mesh.node_sets["bore"]
    )
    cone: PitchCone = flank.cone
    loads = hat_loads(mesh.nodes, tooth.faces, cone, 1.0)
    elastic = loads.load.T @ tooth.moved(loads.load)
    nothing: dict[str, Any] = {
        "stress": {},
        "fillet_points": np.zeros((0, 3)),
        "fillet_side": np.zeros(0),
    }
    one = ToothCompliance(
        "pinion", flank.side, 1, STEEL, loads.hats, {0: 0.5 * (elastic + elastic.T)},
        loads.half_space / (np.pi * STEEL.plane_modulus), **nothing,
    )  # fmt: skip
    mate = met.contact.wheel_flank
    wide = Hats(np.array([mate.toe, mate.heel]), np.array([[-9.0, 9.0], [-9.0, 9.0]]))
    zero = np.zeros((4, 4))
    rigid = ToothCompliance("wheel", mate.side, 1, Material(1e15), wide, {0: zero}, zero, **nothing)
    return Teeth(one, rigid, round(float(met.contact.mount.sense)))


def main() -> None:
    """Print both for each torque."""
    given = argparse.ArgumentParser(description=__doc__)
    given.add_argument("torque", type=float, nargs="+", help="N m")
    given.add_argument("--whole", default="44,14,5", help="elements: in the zone, profile, through")
    given.add_argument("--across", type=int, default=5, help="of the block, over half the contact")
    asked = given.parse_args()
    torques = [t * 1e3 for t in asked.torque]
    pair = hypoid.read(EXAMPLE)
    contact = unloaded_contact(pair, "drive", None, Sampling(positions_per_pitch=40, pairs=9))
    met = meeting(contact, len(contact.phi) // 2, 0)
    assert met is not None
    middle = float(met.surface(np.zeros(1), np.zeros(1)).pinion_place[0][0])
    teeth = ours(pair, met, SIZES)
    by_torque = {}
    for torque in torques:
        found = position_contact([met], teeth, torque)
        (p,) = found.patches
        on = found.solution.force > 0.0
        by_torque[torque] = (found, p, np.abs(p.plane[on]).max(axis=0))
        print(f"{torque * 1e-3:g} N m: contact to {by_torque[torque][2]} mm")
    tooth = fine_tooth(pair.pinion, "concave", middle, *map(int, asked.whole.split(",")))
    for torque, (found, p, half) in by_torque.items():
        compare(met, tooth, torque, found, p, half, asked.across)


def compare(
    met: Meeting, tooth: Tooth, torque: float, found: Any, p: Any, half: Array, count: int
) -> None:
    """One torque: the block is made for its contact."""
    long, wide = 1.15 * half[0] + 0.1, 1.3 * half[1]
    size = half[1] / count
    side = graded(size, wide, max(0.5, 2.5 * wide), 1.6)
    line = graded(long / 8.0, long, long + 0.5, 1.3)
    made = block(
        met,
        np.concatenate([-line[:0:-1], line]),
        np.concatenate([-side[:0:-1], side]),
        graded(size, 2.0 * size, 0.8, 1.7),
    )
    inside = np.flatnonzero((np.abs(made.a) < long + 1e-9) & (np.abs(made.b) < wide + 1e-9))
    print(f"block: {len(made.nodes)} nodes, {len(inside)} hats, across {size:.3f} mm")
    fine = reference(met, tooth, made, inside)
    answer = solve_contact(fine.compliance, fine.gap, fine.lever, torque)
    pressure = answer.force / fine.area
    ours_pressure = found.solution.force / p.area
    print(f"{torque * 1e-3:g} N m ({answer.outcome.name}); compliance uneven by {fine.uneven:.1e}")
    print(f"  rotation {1e6 * answer.rotation:.2f}, here {1e6 * found.solution.rotation:.2f} urad")
    print(
        f"  peak {pressure.max():.1f}, here {ours_pressure.max():.1f} MPa; "
        f"force {answer.force.sum():.1f}, {found.solution.force.sum():.1f} N"
    )
    rows = np.unique(fine.a)
    columns = np.unique(p.plane[:, 0])
    line_ours = [found.solution.force[p.plane[:, 0] == c].sum() / p.size[0] for c in columns]
    width = np.gradient(rows)
    for a, w in zip(rows, width, strict=True):
        own = fine.a == a
        theirs = answer.force[own].sum() / w
        if theirs > 1.0:
            print(
                f"  a = {a:6.3f} mm: {theirs:7.1f}, {np.interp(a, columns, line_ours):7.1f} N/mm; "
                f"{pressure[own].max():7.1f} MPa"
            )


if __name__ == "__main__":
    main()
