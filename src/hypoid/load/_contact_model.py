"""Both members as finite elements at one meshing position: a model for another program's contact, and its answer.

It stands beside `loaded_contact` to check it: nothing of that method but a first guess of rotation and pairs goes
into the model. Frame: the pinion's own, in its hand, turned with it to the position; mm, rad, N.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hypoid.contact import Misalignment, Sampling, UnloadedContact, to_pinion, unloaded_contact
from hypoid.flank import Side
from hypoid.geometry import DesignError, Problem
from hypoid.pair import Direction, GearPair, Member
from hypoid.solid import HexMesh, SplitMesh, face_nodes, hex_mesh

from ._bricks import stiffness
from ._compliance import Elements, Support, ToothCompliance
from ._contact_finer import finer_under
from ._hats import Hats, _knots, shapes
from ._material import STEEL, Material
from ._meeting import meeting
from ._patch import Patch
from ._position import Teeth, position_contact
from ._setup import MESHES, pair_compliance
from ._superelement import Progress

Array = np.ndarray[Any, Any]
PER_PITCH, PAIRS = 40, 9  # of the unloaded contact that places the wheel
LEAST = 0.01  # of the torque: what a pair bears that must be in the sector
BESIDE = 1  # teeth beyond the pairs in contact, either way
SURFACE = 1e-3  # mm: elements along the face are added until faces lie so near to the exact flank
MOST = 4  # times as many, at most


@dataclass(frozen=True)
class TeethInContact:
    """Faces of one tooth pair that may touch."""

    pair: int  # stands this many pitches behind pair 0
    pinion_faces: Array  # (n, 2) element and face of the pinion's mesh
    wheel_faces: Array


@dataclass(frozen=True, eq=False)
class ContactModel:
    """A sector of both members' teeth just touching without load, and what is to happen to it."""

    gears: GearPair
    direction: Direction
    torque: float  # N mm on the pinion
    position: float  # pinion angle, rad
    made_of: Material
    pinion: HexMesh  # turned by whole pitches only
    wheel: HexMesh  # in its own frame
    wheel_nodes: Array  # (n, 3) where they stand, in the pinion's frame
    pairs: tuple[TeethInContact, ...]
    held: tuple[
        Array, Array
    ]  # nodes of the pinion's hub, which turns as a rigid body, and of the wheel's
    turn: int  # +1 or -1: the sense about z in which the torque turns the pinion
    guess: float  # rad: about how far it turns
    elements: tuple[Elements, Elements]  # as they came out
    hats: Hats  # of a wheel tooth, on these elements
    split: tuple[SplitMesh | None, SplitMesh | None]  # of pinion and wheel, where some are split
    surface_error: tuple[float, float]  # mm, most by which faces stand off the exact flanks


@dataclass(frozen=True, eq=False)
class PairAnswer:
    """What one tooth pair carries."""

    pair: int
    share: float  # of the torque
    force: float  # N
    max_pressure: float  # MPa, at the contact's own points
    hats: Array  # (columns, rows) N on the wheel's load hats
    column_force: Array  # (columns,) N from toe to heel

    @property
    def touching(self) -> bool:
        return self.force > 0.0


@dataclass(frozen=True, eq=False)
class ContactAnswer:
    """Another program's answer to a `ContactModel`."""

    rotation: float  # rad, of the pinion beyond the unloaded contact
    torque: float  # N mm about the pinion's axis, by the reaction
    pairs: tuple[PairAnswer, ...]  # touching ones
    distance: Array  # (columns,) S of the hats' columns on the wheel, mm
    balance: float  # what the contact's moments miss of the torque, as a share

    def line_load(self, pair: int) -> Array:
        """Force (columns,) N per mm of the wheel's face width, toe to heel."""
        found = next(p for p in self.pairs if p.pair == pair)
        return found.column_force / hat_widths(self.distance)


def hat_widths(distance: Array) -> Array:
    """Face width (columns,), mm, that belongs to each column of hats."""
    steps = np.diff(distance)
    return 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps))


def contact_model(
    pair: GearPair,
    direction: Direction,
    torque: float,
    *,
    position: float = 0.0,
    teeth: int | None = None,
    made_of: Material = STEEL,
    elements: Elements | None = None,
    finer: int = 1,
    supports: tuple[Support, Support] | None = None,
    misalignment: Misalignment | None = None,
    compliance: tuple[ToothCompliance, ToothCompliance] | None = None,
    progress: Progress = lambda *_: None,
) -> ContactModel:
    """A sector of `teeth` of both members at a pinion angle (rad, within a pitch of zero) under a torque, N mm.

    Without `teeth` one more either way than the pairs in contact, as `loaded_contact` finds them with `compliance`
    (coarse where not given). A member of which more than half would be asked for is taken whole: free cuts beside a
    loaded tooth give way. `elements` (the coarse ones by default) count as everywhere, but where the faces would stand
    off the exact flank by more than a micrometre there are more along the face. Where pairs bear, `finer` smaller ones
    stand for each across the flank's height, see `finer_under`. Raises DesignError, with the number needed where
    `teeth` are too few.
    """
    _check(pair, torque, position, teeth, finer)
    unloaded = unloaded_contact(
        pair, direction, misalignment, Sampling(positions_per_pitch=PER_PITCH, pairs=PAIRS)
    )
    known = compliance or pair_compliance(pair, direction, made_of, MESHES["coarse"], progress)
    guess, reach = _expected(unloaded, torque, position, known)
    first, last = min(reach), max(reach)
    needed = last - first + 1
    count = needed + 2 * BESIDE if teeth is None else teeth
    most = pair.wheel.teeth
    if count < min(needed, most):
        expected = f"at least {needed}: pairs {first} to {last} bear load here"
        raise DesignError([Problem("teeth", str(count), expected, f"{needed + 2 * BESIDE}")])
    sense = round(float(unloaded.mount.sense))
    sizes = elements or MESHES["coarse"]
    flanks = pair.mates(direction)
    made: list[tuple[HexMesh, Elements, float]] = []
    for member, flank in zip((pair.pinion, pair.wheel), flanks, strict=True):
        whole = 2 * count > member.teeth
        made.append(_mesh(member, flank.side, member.teeth if whole else count, sizes))
    pinion, wheel = (mesh for mesh, _, _ in made)
    hands = tuple(round(float(np.asarray(flank.hand)[1])) for flank in flanks)
    centre = [
        _centre(mesh, h * sense, first, last) for (mesh, _, _), h in zip(made, hands, strict=True)
    ]
    pinion = replace(
        pinion, nodes=_turned(pinion.nodes, hands[0] * sense * centre[0] * pinion.pitch)
    )
    faces = [
        _faces_by_pair(mesh, flank.side, h * sense, c)
        for mesh, flank, h, c in zip((pinion, wheel), flanks, hands, centre, strict=True)
    ]
    hats, _ = _knots(
        wheel.nodes,
        face_nodes(wheel.elements, faces[1][first])[:, :4],
        pair.wheel.concave.cone,
    )
    parts: list[SplitMesh | None] = [None, None]
    if finer > 1:
        for i, (mesh, flank) in enumerate(zip((pinion, wheel), flanks, strict=True)):
            ends = {k: by_member[i] for k, by_member in reach.items()}
            divided, small = finer_under(mesh, flank, faces[i], ends, finer)
            faces[i] = _faces_by_pair(divided.mesh, flank.side, hands[i] * sense, centre[i]) | small
            parts[i] = divided
        pinion, wheel = (part.mesh for part in parts if part is not None)
    placed = _placed(unloaded, position, wheel.nodes, sense * centre[1] * wheel.pitch)
    facing = [k for k in range(-(PAIRS // 2), PAIRS // 2 + 1) if k in faces[0] and k in faces[1]]
    facing = [k for k in facing if np.isfinite(_lead(unloaded, position, k))]
    ways = supports or (Support(), Support())
    held = [
        np.unique(np.concatenate([mesh.node_sets[name] for name in way.faces(member)]))
        for mesh, way, member in zip((pinion, wheel), ways, (pair.pinion, pair.wheel), strict=True)
    ]
    return ContactModel(
        gears=pair,
        direction=direction,
        torque=torque,
        position=position,
        made_of=made_of,
        pinion=pinion,
        wheel=wheel,
        wheel_nodes=placed,
        pairs=tuple(TeethInContact(k, faces[0][k], faces[1][k]) for k in facing),
        held=(held[0], held[1]),
        turn=-sense * hands[0],  # drive turns a left-hand pinion backwards, see `Mounting`
        guess=guess,
        elements=(made[0][1], made[1][1]),
        hats=hats,
        split=(parts[0], parts[1]),
        surface_error=(made[0][2], made[1][2]),
    )


def contact_answer(
    model: ContactModel,
    wheel_moved: Array,
    rotation: float,
    torque: float,
    loads: Mapping[int, tuple[float, float]],
    peaks: Mapping[int, float],
) -> ContactAnswer:
    """What an analysis says, in the terms of `loaded_contact`.

    `wheel_moved` (n, 3) mm are the wheel's displacements; `rotation` and `torque` count about z; `loads` are, by pair,
    the moment about z (N mm) of its contact on the pinion and the size of its normal force (N), `peaks` its greatest
    pressure (MPa). Forces on the wheel's hats come from displacements and stiffness, not from contact output.
    """
    matrix = stiffness(model.wheel_nodes, model.wheel.elements, model.made_of)
    force = (matrix @ wheel_moved.ravel()).reshape(-1, 3)
    found: list[PairAnswer] = []
    for met in model.pairs:
        moment, normal = loads[met.pair]
        if normal > 0.0:
            on = _on_hats(model, met, force)
            size = np.linalg.norm(on, axis=1) * np.sign(on @ on.sum(axis=0))
            grid = size.reshape(model.hats.height.shape)
            share = -model.turn * moment / model.torque
            peak = peaks.get(met.pair, 0.0)
            found.append(PairAnswer(met.pair, share, normal, peak, grid, grid.sum(axis=1)))
    return ContactAnswer(
        rotation=model.turn * rotation,
        torque=model.turn * torque,
        pairs=tuple(found),
        distance=model.hats.distance,
        balance=sum(p.share for p in found) - 1.0,
    )


def _on_hats(model: ContactModel, met: TeethInContact, force: Array) -> Array:
    """Forces (hats, 3) on the load hats of the wheel tooth of a pair, of nodal forces (n, 3)."""
    mesh, split = model.wheel, model.split[1]
    nodes = np.unique(face_nodes(mesh.elements, met.wheel_faces))
    if split is not None:  # nodes that hang on others pass on inner forces
        nodes = np.setdiff1d(nodes, split.hung)
    x, y, z = mesh.nodes[nodes].T
    place = model.gears.wheel.concave.cone.cone_distance_height(z, np.hypot(x, y))
    return model.hats.weights(*(np.asarray(v) for v in place)).T @ force[nodes]


def _check(pair: GearPair, torque: float, position: float, teeth: int | None, finer: int) -> None:
    problems: list[Problem] = []
    if not (torque > 0.0 and np.isfinite(torque)):
        expected = "more than 0; the other way round it is the other direction"
        problems.append(Problem("torque", f"{torque * 1e-3:g} N m", expected, '--torque "110 N m"'))
    pitch = 2.0 * np.pi / pair.pinion.teeth
    if not abs(position) <= pitch:
        expected = (
            f"within a pinion pitch of 0, {np.degrees(pitch):g} deg: positions repeat from there on"
        )
        given = f"{np.degrees(position):g} deg"
        problems.append(Problem("position", given, expected, '--position "0 deg"'))
    if teeth is not None and teeth < 1:
        problems.append(Problem("teeth", str(teeth), "1 or more", "--teeth 5"))
    if finer < 1:
        problems.append(Problem("finer", str(finer), "1 or more", "--finer 4"))
    if problems:
        raise DesignError(problems)


def _expected(
    unloaded: UnloadedContact,
    torque: float,
    position: float,
    compliance: tuple[ToothCompliance, ToothCompliance],
) -> tuple[float, dict[int, tuple[tuple[float, float], tuple[float, float]]]]:
    """Rotation, and by pair in contact the cone distances on pinion and wheel between which it touches.

    As a loaded contact at the nearest position has them.
    """
    teeth = Teeth(*compliance, round(float(unloaded.mount.sense)))
    at = int(np.abs(unloaded.phi - position).argmin())
    half = PAIRS // 2
    meetings = [m for k in range(-half, half + 1) if (m := meeting(unloaded, at, k)) is not None]
    found = position_contact(meetings, teeth, torque)
    loaded = {
        p.meeting.pair: _reach(p, found.solution.force[part] > 0.0)
        for p, part in zip(found.patches, found.parts, strict=True)
        if p.pinion_lever @ found.solution.force[part] > LEAST * torque
    }
    if not loaded:
        given = f"{torque * 1e-3:g} N m at {np.degrees(position):g} deg"
        raise DesignError([Problem("torque", given, found.outcome.value, '--torque "30 N m"')])
    return found.solution.rotation, loaded


def _reach(p: Patch, touching: Array) -> tuple[tuple[float, float], tuple[float, float]]:
    one, other = (distance[touching] for distance, _ in (p.pinion_place, p.wheel_place))
    return (float(one.min()), float(one.max())), (float(other.min()), float(other.max()))


def _mesh(
    member: Member, side: Side, teeth: int, sizes: Elements
) -> tuple[HexMesh, Elements, float]:
    """Teeth whose faces stand off the exact flank by no more than `SURFACE`, and by how much they do, mm."""
    along = sizes.along
    while True:
        counts = replace(sizes, along=along).counts()
        one = hex_mesh(member, teeth=1, quadratic=True, **counts)  # pyright: ignore[reportArgumentType]
        error = _surface_error(one, member, side)
        if error <= SURFACE or along >= MOST * sizes.along:
            break
        # a face through three points a way misses the third power of its length
        more = int(np.ceil(along * (error / SURFACE) ** (1.0 / 3.0)))
        along = min(max(more, along + 1), MOST * sizes.along)
    if teeth > 1:
        one = hex_mesh(member, teeth=teeth, quadratic=True, **counts)  # pyright: ignore[reportArgumentType]
    return one, replace(sizes, along=along), error


def _surface_error(mesh: HexMesh, member: Member, side: Side) -> float:
    """How far the faces stand off the exact flank at their 3 x 3 Gauss points, mm."""
    x = np.sqrt(0.6) * np.array([-1.0, 0.0, 1.0])
    value, _, _ = shapes(np.stack([v.ravel() for v in np.meshgrid(x, x, indexing="ij")], axis=1))
    place = np.einsum("qk,fkd->fqd", value, mesh.nodes[mesh.face_nodes(f"{side}_flank")])
    place = place.reshape(-1, 3)
    exact = member.flank(side).at(place[:, 2], np.hypot(place[:, 0], place[:, 1]))
    off = ((exact.position - place) * exact.normal).sum(axis=1)
    return float(np.abs(off[exact.ok]).max())


def _centre(mesh: HexMesh, sense: int, first: int, last: int) -> int:
    """The pair whose tooth is the mesh's middle one: pairs from first to last as far from its ends as may be."""

    def room(centre: int) -> int:
        at = mesh.teeth // 2 + sense * (np.array([first, last]) - centre)
        return int(min(at.min(), mesh.teeth - 1 - at.max()))

    return max(range(first, last + 1), key=room)


def _faces_by_pair(mesh: HexMesh, side: Side, sense: int, centre: int) -> dict[int, Array]:
    """The faces of a flank by the pair that they belong to; on a whole gear by several pairs."""
    faces = mesh.face_sets[f"{side}_flank"]
    tooth = mesh.tooth[faces[:, 0]]
    found: dict[int, Array] = {}
    for pair in range(-(PAIRS // 2), PAIRS // 2 + 1):
        at = mesh.teeth // 2 + sense * (pair - centre)
        if mesh.whole:
            at %= mesh.teeth
        if 0 <= at < mesh.teeth:
            found[pair] = faces[tooth == at]
    return found


def _lead(unloaded: UnloadedContact, position: float, pair: int) -> float:
    """Lead (rad) that a pair asks of the wheel at a pinion angle: a cubic through the nearest positions."""
    shift = pair * unloaded.sampling.positions_per_pitch
    at = int(np.abs(unloaded.phi - position).argmin())
    near = [
        i for i in range(at - 2, at + 3)
        if 0 <= i - shift < len(unloaded.curve) and np.isfinite(unloaded.curve[i - shift])
    ]  # fmt: skip
    if at not in near:
        return -np.inf
    step = unloaded.phi[at + 1] - unloaded.phi[at]
    x = np.array([i - at for i in near], dtype=float)
    line = np.polynomial.polynomial.polyfit(
        x, unloaded.curve[np.array(near) - shift], min(3, len(x) - 1)
    )
    return float(np.polynomial.polynomial.polyval((position - unloaded.phi[at]) / step, line))


def _placed(unloaded: UnloadedContact, position: float, nodes: Array, ahead: float) -> Array:
    """The wheel's nodes (n, 3) in the pinion's frame and hand, just touching; `ahead` turns them first, left hand."""
    mount = unloaded.mount
    leads = [_lead(unloaded, position, k) for k in range(-(PAIRS // 2), PAIRS // 2 + 1)]
    travel = max(leads) + float(mount.wheel_zero) + float(mount.ratio) * position
    left = _turned(nodes * unloaded.wheel_flank.hand, ahead - float(mount.sense) * travel)
    own = to_pinion(mount, np.full(len(nodes), position), left)
    return own * unloaded.pinion_flank.hand


def _turned(nodes: Array, angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = nodes.T
    return np.stack([c * x - s * y, s * x + c * y, z], axis=-1)
