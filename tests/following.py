"""How a contact follows what makes it, by differences with 40 digits of the plain chain, apart from the package.

Conditions and quantities of both members' points are written out in the frame of the blank. Where the
points must stay met, the change of a quantity is Q_p - Q_x C_x^-1 C_p, each slope a central difference.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import mpmath
from independent import Envelope, cross, digits, dot

from hypoid.contact import UnloadedContact
from hypoid.cutter import EdgePiece
from hypoid.flank import Flank, HeldPoints
from hypoid.machine import MachineSettings, Motions

STEP = mpmath.mpf("1e-9")
ORDERS = 6
ERRORS = ("offset", "pinion_axial", "wheel_axial", "shaft_angle")
Name = tuple[str, ...]  # where a parameter stands in the package's tree


def parameters_of(flank: Flank) -> list[Name]:
    """Every parameter of one flank by name: settings, roll, motions, cam, edge."""
    plain = [f.name for f in fields(MachineSettings)]
    for other in ("modified_roll", "motions", "cam", "generated"):
        plain.remove(other)
    names: list[Name] = [("settings", name) for name in plain]
    names += [("roll", str(k)) for k in range(ORDERS - 1)]
    names += [("motions", f.name, str(k)) for f in fields(Motions) for k in range(ORDERS)]
    if flank.settings.cam is not None:
        names += [("cam", f.name) for f in fields(flank.settings.cam)]
    vectors = ("start", "tangent", "metal")
    names += [("edge", name, str(k)) for name in vectors for k in range(3)]
    return names + [("edge", n) for n in ("curvature", "relief", "relief_from", "parabola")]


def moved(
    settings: MachineSettings, piece: EdgePiece, name: Name, by: Any
) -> tuple[MachineSettings, EdgePiece]:
    """Settings and edge with one parameter moved."""

    def row(values: Sequence[Any], k: int) -> tuple[Any, ...]:
        made = [digits(v) for v in values] + [mpmath.mpf(0)] * (ORDERS - len(values))
        made[k] += by
        return tuple(made)

    kind, *where = name
    if kind == "settings":
        return replace(settings, **{where[0]: digits(getattr(settings, where[0])) + by}), piece
    if kind == "roll":
        return replace(settings, modified_roll=row(settings.modified_roll, int(where[0]))), piece
    if kind == "motions":
        motion = row(getattr(settings.motions, where[0]), int(where[1]))
        return replace(settings, motions=replace(settings.motions, **{where[0]: motion})), piece
    if kind == "cam":
        assert settings.cam is not None
        value = digits(getattr(settings.cam, where[0])) + by
        return replace(settings, cam=replace(settings.cam, **{where[0]: value})), piece
    if len(where) == 1:
        return settings, replace(piece, **{where[0]: digits(getattr(piece, where[0])) + by})
    vector = list(getattr(piece, where[0]))
    vector[int(where[1])] = digits(vector[int(where[1])]) + by
    return settings, replace(piece, **{where[0]: tuple(vector)})


@dataclass(frozen=True)
class Seen:
    """A point held to (s, theta, phi), left hand: place, unit normal, and what meshing leaves."""

    point: mpmath.matrix
    normal: mpmath.matrix
    left: Any


@dataclass(frozen=True)
class Held:
    """One held point of one flank."""

    settings: MachineSettings
    piece: EdgePiece
    at: tuple[Any, Any, Any]

    @classmethod
    def of(cls, flank: Flank, held: HeldPoints, k: int) -> Held:
        at = tuple(digits(v[k]) for v in (held.s, held.theta, held.phi))
        return cls(flank.settings, flank.pieces["flank"], at)  # type: ignore[arg-type]

    def seen(self, name: Name | None = None, by: Any = 0, shift: Sequence[Any] = (0, 0, 0)) -> Seen:
        settings, piece = self.settings, self.piece
        if name is not None:
            settings, piece = moved(settings, piece, name, by)
        surface = Envelope(settings, piece)
        s, theta, phi = (a + b for a, b in zip(self.at, shift, strict=True))
        by_s, by_theta, by_phi = surface.tangents(s, theta, phi)
        normal = cross(by_s, by_theta)
        normal = normal / mpmath.norm(normal)
        left = dot(normal, by_phi) if settings.generated else phi
        return Seen(surface.swept(s, theta, phi), normal, left)


Rows = Callable[
    ..., tuple[list[Any], list[Any]]
]  # of (first, second, pinion turn, wheel turn, errors)


@dataclass(frozen=True)
class Following:
    """Two held points and rows of conditions and quantities; how the quantities follow everything."""

    contact: UnloadedContact
    points: tuple[Held, Held]
    pitch: tuple[Held, Held]
    rows: Rows

    @mpmath.workdps(40)
    def slopes(self) -> dict[tuple[str, Name], list[Any]]:
        """Changes of the quantities per unit of every parameter of both flanks, and of the mounting's errors."""
        own = [p.seen() for p in self.points]
        by_x: list[tuple[list[Any], list[Any]]] = []
        for m in (0, 1):
            for k in range(3):
                shift = [STEP if j == k else 0 for j in range(3)]
                ends = [
                    self._looked(own, m, self.points[m].seen(shift=[e * d for d in shift]))
                    for e in (1, -1)
                ]
                by_x.append(_difference(*ends))
        conditions = mpmath.matrix([c for c, _ in by_x]).T
        quantities = mpmath.matrix([q for _, q in by_x]).T
        follow = quantities * conditions**-1

        def total(change: tuple[list[Any], list[Any]]) -> list[Any]:
            return list(mpmath.matrix(change[1]) - follow * mpmath.matrix(change[0]))

        turns = [total(_difference(*(self.rows(*own, *t, (0, 0, 0, 0)) for t in ends))) for ends in
                 (((STEP, 0), (-STEP, 0)), ((0, STEP), (0, -STEP)))]  # fmt: skip
        found: dict[tuple[str, Name], list[Any]] = {}
        for m, member in enumerate(("pinion", "wheel")):
            flank = self.contact.pair.mates(self.contact.direction)[m]
            pitch = _PitchPoint(self.contact, m, self.pitch[m])
            for name in parameters_of(flank):
                ends = [self._looked(own, m, self.points[m].seen(name, e * STEP)) for e in (1, -1)]
                turn = pitch.turn(name)
                own_change = total(_difference(*ends))
                found[member, name] = [
                    a + turn * b for a, b in zip(own_change, turns[m], strict=True)
                ]
        for k, error in enumerate(ERRORS):
            ends = [
                self.rows(*own, 0, 0, tuple(e * STEP if j == k else 0 for j in range(4)))
                for e in (1, -1)
            ]
            found["mounting", (error,)] = total(_difference(*ends))
        return found

    def _looked(self, own: list[Seen], m: int, seen: Seen) -> tuple[list[Any], list[Any]]:
        both = [seen if k == m else o for k, o in enumerate(own)]
        return self.rows(*both, 0, 0, (0, 0, 0, 0))


def _difference(
    after: tuple[list[Any], list[Any]], before: tuple[list[Any], list[Any]]
) -> tuple[list[Any], list[Any]]:
    return tuple(
        [(a - b) / (2 * STEP) for a, b in zip(x, y, strict=True)]
        for x, y in zip(after, before, strict=True)
    )  # type: ignore[return-value]


class _PitchPoint:
    """How the angle of a flank's mean point about its axis follows a parameter."""

    def __init__(self, contact: UnloadedContact, m: int, held: Held) -> None:
        self._held = held
        self._cone = contact.pair.mates(contact.direction)[m].cone
        slopes = []
        for k in range(3):
            shift = [STEP if j == k else 0 for j in range(3)]
            ends = [self._looked(held.seen(shift=[e * d for d in shift])) for e in (1, -1)]
            slopes.append([(a - b) / (2 * STEP) for a, b in zip(*ends, strict=True)])
        slopes = mpmath.matrix(slopes).T
        self._follow = slopes[3, :] * slopes[:3, :] ** -1

    def _looked(self, seen: Seen) -> list[Any]:
        """Cone distance, height, what meshing leaves; then the angle."""
        x, y, z = seen.point
        along, rho = z + digits(self._cone.apex_beyond), mpmath.hypot(x, y)
        sine, cosine = digits(self._cone.sine), digits(self._cone.cosine)
        return [
            along * cosine + rho * sine,
            rho * cosine - along * sine,
            seen.left,
            mpmath.atan2(y, x),
        ]

    def turn(self, name: Name) -> Any:
        ends = [self._looked(self._held.seen(name, e * STEP)) for e in (1, -1)]
        *left, angle = [(a - b) / (2 * STEP) for a, b in zip(*ends, strict=True)]
        return angle - (self._follow * mpmath.matrix(left))[0]


# --- both members in the frame of the blank --------------------------------------------------------


@dataclass(frozen=True)
class Mounted:
    """The canonical pair at one pinion angle, written out (`hypoid.blank`'s frame)."""

    contact: UnloadedContact
    phi: float

    def pinion(self, seen: Seen, turn: Any, errors: Sequence[Any]) -> tuple[Any, ...]:
        """z, rho, angle (rad), normal (3) and point of a pinion point; ``turn`` of its pitch point beside its own."""
        contact, cones = self.contact, self.contact.pair.blank.cones
        own = contact.misalignment
        sigma = digits(cones.shaft_angle + own.shaft_angle) + errors[3]
        axis = mpmath.matrix([mpmath.sin(sigma), 0, mpmath.cos(sigma)])
        x1 = mpmath.matrix([-mpmath.cos(sigma), 0, mpmath.sin(sigma)])
        y1 = cross(axis, x1)
        angle = (
            digits(contact.mount.pinion_zero)
            - turn
            - digits(contact.mount.sense) * digits(self.phi)
        )
        c, s = mpmath.cos(angle), mpmath.sin(angle)

        def placed(v: Any) -> mpmath.matrix:
            a, b = c * v[0] - s * v[1], s * v[0] + c * v[1]
            return a * x1 + b * y1 + v[2] * axis

        out = digits(own.pinion_axial) + errors[1]
        foot = mpmath.matrix([0, digits(cones.offset + own.offset) + errors[0], 0]) + out * axis
        point, normal = placed(seen.point) + foot, placed(seen.normal)
        z = point[2] - digits(own.wheel_axial) - errors[2]
        return z, mpmath.hypot(point[0], point[1]), mpmath.atan2(point[1], point[0]), normal, point

    def lead(self, angle: Any, seen: Seen, turn: Any) -> tuple[Any, Any]:
        """Lead of the wheel where its held point stands at an angle, and the turn that takes it there."""
        sense = digits(self.contact.mount.sense)
        turned = angle - mpmath.atan2(-seen.point[1], seen.point[0])  # a right-hand member
        zero = sense * digits(self.contact.mount.wheel_zero) + turn
        return sense * (turned - zero) - digits(self.contact.mount.ratio) * digits(self.phi), turned
