"""A tooth's compliance under a fine block of elements that lies over the whole tooth's: no half-space in it.

The displacement is the whole tooth's plus the block's, which is zero on the block's inner faces [Fish 1992, Computers
& Structures 43, the s-version of the finite element method]. Both answer one Galerkin problem: compliance is
symmetric, and a block or finer elements can only make it greater. Left-hand members.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from scipy import sparse
from scipy.interpolate import RegularGridInterpolator
from scipy.linalg import eigvalsh
from scipy.spatial import KDTree

from hypoid.contact import to_pinion
from hypoid.flank import Side
from hypoid.load import STEEL, Elements
from hypoid.load._bricks import gauss, gradients, stiffness
from hypoid.load._dense import factored, lower_solved
from hypoid.load._hats import _loads as pressed
from hypoid.load._hats import bilinear, hat_loads, shapes
from hypoid.load._layers import node_places, through
from hypoid.load._meeting import Meeting
from hypoid.pair import Member
from hypoid.solid import body, shape_gradients
from hypoid.solid._hex_cell import face_nodes
from hypoid.solid._hex_mesh import ACROSS, ROWS, _one
from hypoid.solid._hex_quality import CORNERS, EDGES, FACE_EDGES, FACES

Array = np.ndarray[Any, Any]
PLACES = np.concatenate([CORNERS, CORNERS[EDGES].mean(axis=1)]).astype(float)
TOP = np.concatenate([FACES[1], FACE_EDGES[1]])  # of a block's element: local z = 1
NEWTON, NEAREST = 12, 250  # steps to a place in an element; elements that are looked at
CELLS = 4  # of an element each way, where the block leaves a part of it


def shape_values(at: Array) -> Array:
    """Shape functions (m, 20) of a brick at (m, 3)."""
    made = np.ones((len(at), 20))
    for k, place in enumerate(PLACES):
        for d, x in enumerate(at.T):
            made[:, k] *= 1.0 - x * x if place[d] == 0.0 else 0.5 * (1.0 + x * place[d])
        if k < 8:
            made[:, k] *= at @ place - 2.0
    return made


@dataclass(frozen=True, eq=False)
class Tooth:
    """One tooth, its cuts free, its bore held."""

    nodes: Array
    elements: Array
    free: Array  # degrees of freedom
    matrix: Any  # (free, free)
    place: Array  # (free,) along the face, see `node_places`
    hats: Any  # `HatLoads` of the flank

    @property
    def by_hats(self) -> Array:
        """Compliance (h, h), mm/N, between the flank's own hats."""
        return _answered(self.matrix, self.place, self.hats.load.tocsr()[self.free])


def _answered(matrix: Any, place: Array, load: Any) -> Array:
    """`load`' K^-1 `load` (r, r)."""
    made, _ = through(matrix, place, load, sparse.csr_array((load.shape[0], 0)))
    return 0.5 * (made + made.T)


def tooth(member: Member, side: Side, sizes: Elements, ends: Array | None = None) -> Tooth:
    """A tooth ready to be loaded, its sections at S = `ends`, mm, evenly spread where none are given."""
    flank = member.flank(side)
    if ends is None:
        ends = np.linspace(flank.toe, flank.heel, sizes.along + 1)
    counts = {**sizes.counts(), "along": len(ends) - 1}
    grid = member.tooth.grid(_halved(ends), ROWS, ACROSS)
    made = _one(member, grid, body(member), counts, sizes.rim, True)
    held = np.unique(face_nodes(made.elements, made.faces["bore"]))
    free = np.setdiff1d(np.arange(3 * len(made.nodes)), 3 * held[:, None] + np.arange(3))
    matrix = stiffness(made.nodes, made.elements, STEEL)[free][:, free]
    place = node_places(len(made.nodes), made.elements)[free // 3]
    faces = face_nodes(made.elements, made.faces[f"{side}_flank"])
    hats = hat_loads(made.nodes, faces, flank.cone, 1.0)
    return Tooth(made.nodes, made.elements, free, matrix, place, hats)


def _halved(ends: Array) -> Array:
    """Places with one more between every two."""
    out = np.repeat(np.asarray(ends, float), 2)[:-1]
    out[1::2] = 0.5 * (out[:-1:2] + out[2::2])
    return out


def located(whole: Tooth, points: Array) -> tuple[Array, Array]:
    """Element (m,) of the whole tooth and place (m, 3) in it of points that may stand a little off it."""
    middles = whole.nodes[whole.elements[:, :8]].mean(axis=1)
    near = np.array(KDTree(middles).query(points, k=min(NEAREST, len(middles)))[1])
    best = np.full(len(points), np.inf)
    element, place = np.zeros(len(points), dtype=int), np.zeros((len(points), 3))
    for k in range(near.shape[1]):
        todo = np.flatnonzero(best > 1.0 + 1e-9)
        if not len(todo):
            break
        corners = whole.nodes[whole.elements[near[todo, k]]]
        at = np.zeros((len(todo), 3))
        for _ in range(NEWTON):
            miss = points[todo] - np.einsum("mn,mnd->md", shape_values(at), corners)
            slope = np.einsum("mkn,mnd->mkd", shape_gradients(at), corners)
            step = np.linalg.solve(slope.transpose(0, 2, 1), miss[..., None])[..., 0]
            at = np.clip(at + step, -3.0, 3.0)
            if np.abs(step).max() < 1e-10:
                break
        size = np.abs(at).max(axis=1)
        better = size < best[todo]
        chosen = todo[better]
        best[chosen], element[chosen], place[chosen] = (
            size[better],
            near[chosen, k],
            at[better],
        )
    if not best.max() < 1.05:
        raise ValueError(f"{(best > 1.05).sum()} points of the block stand outside the tooth")
    return element, place


@dataclass(frozen=True, eq=False)
class Block:
    """Bricks along a contact, in the pinion's frame; loads on its upper face are hats at its corner nodes."""

    nodes: Array
    elements: Array
    faces: Array  # (f, 8) of the upper face
    number: Array  # (f, 4) hat of each corner
    a: Array  # (hats,) place of the hats in the tangent plane, mm
    b: Array
    free: Array  # degrees of freedom: all but those of the inner faces
    place: Array  # (free,) along a
    ends: tuple[Array, Array, float]  # places of its corners along a and b, and its depth, mm
    height: Array  # (along, across) of the upper face's corners above the tangent plane

    def holds(self, met: Meeting, points: Array) -> Array:
        """Whether points (n, 3) of the pinion's frame are within it."""
        zero, axes = met.frame
        a, b, height = ((points - zero) @ axes.T).T
        top = RegularGridInterpolator(self.ends[:2], self.height, bounds_error=False)
        return height > top((a, b)) - self.ends[2]  # never where outside, NaN


def block(met: Meeting, along: Array, across: Array, deep: Array) -> Block:
    """The block on tangent-plane lines a and b, at depths from 0 on; all places of corners, mm."""
    a, b, t = (_halved(v) for v in (along, across, deep))
    shape = (len(a), len(b), len(t))
    i, j, k = np.indices(shape)
    keep = (i % 2) + (j % 2) + (k % 2) <= 1
    index = np.full(shape, -1)
    index[keep] = np.arange(keep.sum())
    flat_a, flat_b = (v.ravel() for v in np.meshgrid(a, b, indexing="ij"))
    top = met.surface(flat_a, flat_b).point.reshape(len(a), len(b), 3)
    place = top[:, :, None] - t[:, None] * met.axes[2]
    nodes = to_pinion(met.contact.mount, np.full(keep.sum(), met.phi), place[keep])
    turn = np.array([1.0, np.sign(np.linalg.det(met.frame[1])), 1.0])
    cells = list(product(*(range(len(v) - 1) for v in (along, across, deep))))
    at = 2 * np.array(cells)[:, None] + 1 + (PLACES * turn * [1, 1, -1]).astype(int)
    elements = index[at[..., 0], at[..., 1], at[..., 2]]
    faces = elements[[c[2] == 0 for c in cells]][:, TOP]
    corner = index[::2, ::2, 0].ravel()
    hat = np.full(keep.sum(), -1)
    hat[corner] = np.arange(len(corner))
    hat_a, hat_b = (v.ravel() for v in np.meshgrid(along, across, indexing="ij"))
    inner = (i > 0) & (i < len(a) - 1) & (j > 0) & (j < len(b) - 1) & (k < len(t) - 1)
    own = np.flatnonzero(inner[keep])
    free = (3 * own[:, None] + np.arange(3)).ravel()
    column = np.clip(i[keep] - 1, 0, len(a) - 3)
    height = (top[::2, ::2] - met.origin) @ met.axes[2]
    return Block(
        nodes,
        elements,
        faces,
        hat[faces[:, :4]],
        hat_a,
        hat_b,
        free,
        column[free // 3],
        (along, across, float(deep[-1])),
        height,
    )


@dataclass(frozen=True, eq=False)
class Overlaid:
    """Fine elements' hats `inside` the contact, by place in the tangent plane; gap and lever are means under them."""

    compliance: Array  # (h, h) mm/N
    whole: Array  # (h, h) without the block
    least: float  # eigenvalue of the joint problem, scaled to 1 where block and tooth have nothing in common
    gap: Array  # (h,) mm
    lever: Array
    area: Array  # mm2
    a: Array
    b: Array


def overlaid(met: Meeting, whole: Tooth, made: Block, inside: Array) -> Overlaid:
    """Both meshes together."""
    top = _Top.of(made)
    load, area = pressed(made.nodes, made.faces, made.number, len(made.a), 1.0)
    own = (load / area).tocsc()[:, inside]
    far = (top.on(whole, len(made.a)) / area).tocsc()[:, inside]
    coupling, matrix = _joined(met, whole, made)
    used = np.unique(np.concatenate([coupling.nonzero()[1], far.nonzero()[0]]))
    used = used[np.isin(used, whole.free)]
    chosen = sparse.coo_array(
        (np.ones(len(used)), (used, np.arange(len(used)))), shape=(far.shape[0], len(used))
    )
    lower = factored(_answered(matrix, whole.place, chosen.tocsr()[whole.free]))
    columns = sparse.hstack([own[made.free], coupling[made.free][:, used]]).tocsr()
    matrix = stiffness(made.nodes, made.elements, STEEL)[made.free][:, made.free]
    near = _answered(matrix, made.place, columns)
    h = len(inside)
    far = far[used].toarray()
    alone = lower.T @ far
    right = lower.T @ (far - near[h:, :h])
    joint = np.eye(len(used)) - lower.T @ near[h:, h:] @ lower
    least = float(eigvalsh(joint, subset_by_index=[0, 0])[0])
    moved = lower_solved(factored(joint), right)
    gap, lever = (m[inside] / area[inside] for m in top.means(met, made))
    return Overlaid(
        near[:h, :h] + moved.T @ moved,
        alone.T @ alone,
        least,
        gap,
        lever,
        area[inside],
        made.a[inside],
        made.b[inside],
    )


@dataclass(frozen=True, eq=False)
class _Top:
    """Gauss points of the block's upper face: f faces of q points."""

    point: Array  # (f, q, 3)
    normal: Array  # (f, q, 3) outward, times the area
    number: Array  # (f, 4)
    share: Array  # (q, 4) of the four corners' hats

    @classmethod
    def of(cls, made: Block) -> _Top:
        x, w = np.polynomial.legendre.leggauss(4)
        at = np.stack([v.ravel() for v in np.meshgrid(x, x, indexing="ij")], axis=1)
        corner = made.nodes[made.faces]
        point, by_x, by_y = (np.einsum("qk,fkd->fqd", v, corner) for v in shapes(at))
        normal = np.outer(w, w).ravel()[:, None] * np.cross(by_x, by_y)
        return cls(point, normal, made.number, bilinear(at))

    def on(self, whole: Tooth, count: int) -> Any:
        """Load (3n, hats) on the whole tooth of unit pressure under each hat."""
        element, at = located(whole, self.point.reshape(-1, 3))
        value = shape_values(at).reshape(*self.point.shape[:2], 20)
        force = -np.einsum("qc,fqk,fqd->fqckd", self.share, value, self.normal, optimize=True)
        dof = 3 * whole.elements[element].reshape(value.shape)[..., None] + np.arange(3)
        rows = np.broadcast_to(dof[:, :, None], force.shape).ravel()
        hats = np.broadcast_to(self.number[:, None, :, None, None], force.shape).ravel()
        shape = (3 * len(whole.nodes), count)
        return sparse.coo_array((force.ravel(), (rows, hats)), shape=shape).tocsc()

    def means(self, met: Meeting, made: Block) -> list[Array]:
        """Integrals (hats,) of gap and lever under each hat, mm3."""
        plane = (
            np.einsum("fc,qc->fq", v[self.number], self.share).ravel() for v in (made.a, made.b)
        )
        surface = met.surface(*plane)
        gap = surface.gap
        size = np.linalg.norm(self.normal, axis=-1)
        found = []
        for values in (np.where(np.isfinite(gap), gap, 1.0), surface.levers[0]):
            under = np.einsum("fq,qc,fq->fc", size, self.share, values.reshape(size.shape))
            found.append(np.bincount(self.number.ravel(), under.ravel(), minlength=len(made.a)))
        return found


@dataclass(frozen=True, eq=False)
class _Slopes:
    """Gradients of shape functions at points of integration, as operators on the values at nodes."""

    by: tuple[Any, Any, Any]  # (points, nodes) each

    @classmethod
    def of(cls, gradient: Array, nodes: Array, count: int) -> _Slopes:
        """From gradients (m, 3, 20) at m points in elements with these nodes (m, 20) of `count`."""
        ends, shape = 20 * np.arange(len(nodes) + 1), (len(nodes), count)
        first, second, third = (
            sparse.csr_array((gradient[:, d].ravel(), nodes.ravel(), ends), shape=shape)
            for d in range(3)
        )
        return cls((first, second, third))

    def energy(self, volume: Array, other: _Slopes) -> Any:
        """Stiffness (3 own nodes, 3 other nodes), N/mm, over points of these volumes (m,)."""
        weighed = [(one * volume[:, None]).T.tocsr() for one in self.by]
        met = [[one @ two for two in other.by] for one in weighed]
        lam, mu = STEEL.lame
        trace = met[0][0] + met[1][1] + met[2][2]
        total: Any = None
        for d, e in product(range(3), repeat=2):
            part = lam * met[d][e] + mu * met[e][d] + (mu * trace if d == e else 0.0 * trace)
            there = np.zeros((3, 3))
            there[d, e] = 1.0
            turned = sparse.kron(part, sparse.csr_array(there), format="csr")
            total = turned if total is None else total + turned
        return total


def _joined(met: Meeting, whole: Tooth, made: Block) -> tuple[Any, Any]:
    """Stiffness between block and tooth, and the tooth's own where both are integrated at the same points.

    Within the block these are the block's; what it leaves of the tooth's elements is filled with small cells.
    So the joint energy is a sum of squares.
    """
    points, weights = gauss(3)
    places = made.nodes[made.elements]
    slope, volume = gradients(places, shape_gradients(points))
    at = np.einsum("qk,mkd->mqd", shape_values(points), places).reshape(-1, 3)
    element, local = located(whole, at)
    turn = shape_gradients(local)
    far = np.linalg.solve(
        np.einsum("mdk,mkx->mdx", turn, whole.nodes[whole.elements[element]]), turn
    )
    size = (volume * weights).ravel()
    on_block = _Slopes.of(
        slope.reshape(-1, 3, 20), np.repeat(made.elements, len(points), axis=0), len(made.nodes)
    )
    on_tooth = _Slopes.of(far, whole.elements[element], len(whole.nodes))
    coupling = on_block.energy(size, on_tooth)
    touched = whole.elements[np.unique(element)]
    points, weights = gauss(2)
    share = (np.arange(CELLS) * 2.0 + 1.0) / CELLS - 1.0
    points = (np.array(list(product(share, repeat=3)))[:, None] + points / CELLS).reshape(-1, 3)
    slope, volume = gradients(whole.nodes[touched], shape_gradients(points))
    at = np.einsum("qk,mkd->mqd", shape_values(points), whole.nodes[touched])
    left = ~made.holds(met, at.reshape(-1, 3))
    size_left = (volume * np.tile(weights, CELLS**3) / CELLS**3).ravel()[left]
    beside = _Slopes.of(
        slope.reshape(-1, 3, 20)[left],
        np.repeat(touched, len(points), axis=0)[left],
        len(whole.nodes),
    )
    own = on_tooth.energy(size, on_tooth) + beside.energy(size_left, beside)
    free = whole.free
    before = stiffness(whole.nodes, touched, STEEL)[free][:, free]
    return coupling, whole.matrix - before + own.tocsr()[free][:, free]
