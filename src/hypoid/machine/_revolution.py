"""Face milling: the tool is a surface of revolution, so meshing is closed in the cutter's turn.

At a cradle angle the tool moves against the work by one screw (V, Omega), seen from the cutter
frame. A point of the meridian (rho, z) with normal (n_r, n_z), turned by t about the cutter axis,
has n . v = n_r (V_x cos t + V_y sin t) + n_z V_z + m (Omega_y cos t - Omega_x sin t), where
m = z n_r - rho n_z: closed in t for any motions, and linear along a straight edge.
"""

from __future__ import annotations

from hypoid.cutter import EdgePiece, edge_point
from hypoid.geometry import Batch, Vector, add, once, sine_cosine, turn_z

from ._generator import Meshing, Placed, solve_trigonometric, to_member, velocity
from ._pose import Generator, Pose, pose, rotated_back


def _screw(at: Pose) -> tuple[Vector, Vector]:
    """Velocity of the cutter's centre and turn rate, against the work, per rad of cradle; cutter frame."""
    r = turn_z(at.cosine, at.sine, at.centre)
    q = (r[0], r[1] + at.blank_offset, r[2] - at.sliding_base)
    spin: Vector = (-at.roll_rate * at.root_cosine, 0.0, 1.0 - at.roll_rate * at.root_sine)
    drift = None
    if at.rates is not None:
        drift = turn_z(at.cosine, at.sine, at.rates.centre)
        own = turn_z(at.cosine, at.sine, at.rates.spin)
        spin = add(spin, (own[0], own[1] + at.rates.machine_root_angle, own[2]))

    def to_cutter(v: Vector) -> Vector:
        return rotated_back(at.head, turn_z(at.cosine, -at.sine, v))

    return to_cutter(velocity(at, r, q, drift)), to_cutter(spin)


def mesh_cutter(
    gen: Generator, piece: EdgePiece, s: Batch, phi: Batch, branch: Batch | float
) -> tuple[Placed, Meshing]:
    """Points where an edge meshes at given cradle angles, with the turn t = -theta found in closed form."""
    at = pose(gen, phi)
    v, spin = once(_screw(at))
    point, tangent = edge_point(piece, s)
    rho, z, n_r, n_z = point[0], point[2], tangent[2], -tangent[0]
    m = z * n_r - rho * n_z
    a, b = n_r * v[0] + m * spin[1], n_r * v[1] - m * spin[0]
    mesh = solve_trigonometric(a, b, n_z * v[2], branch)
    x = (rho * mesh.cosine, rho * mesh.sine, z)
    normal = (n_r * mesh.cosine, n_r * mesh.sine, n_z)
    x, y, z = at.to_machine(x)
    r = turn_z(at.cosine, at.sine, at.centre)
    q = (r[0] + x, r[1] + y + at.blank_offset, r[2] + z - at.sliding_base)
    return to_member(at, q, at.to_machine(normal), at.roll, phi), mesh


def mesh_straight(gen: Generator, piece: EdgePiece, theta: Batch, phi: Batch) -> Batch:
    """Edge parameter s, mm, where a straight edge meshes at given cutter turn and cradle angle."""
    v, spin = _screw(pose(gen, phi))
    sine, c = sine_cosine(theta)
    d = -sine
    (rho, _, z), (t_r, _, t_z) = piece.start, piece.tangent
    n_r, n_z = t_z, -t_r
    along = v[0] * c + v[1] * d
    swing = spin[1] * c - spin[0] * d
    start = n_r * along + n_z * v[2] + (z * n_r - rho * n_z) * swing
    return -start / ((t_z * n_r - t_r * n_z) * swing)
