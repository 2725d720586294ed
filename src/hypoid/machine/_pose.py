"""The generator of one flank as a tree of numbers, and where its axes stand at a cradle angle.

Roll and sliding base are powers of the cradle angle for every flank. The other axes rarely move:
their powers are there only where they do, so that a machine at rest costs nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import jax
import jax.numpy as jnp

from hypoid.geometry import Batch, Scalar, Vector, once, polynomial, sine_cosine, turn_z

from ._cam import Cam, cam_roll
from ._settings import ORDERS, MachineSettings

Rotation = tuple[Vector, Vector, Vector]  # by rows


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Axes:
    """Axes that move with the cradle: powers of phi from phi**0 to phi**6, mm and rad."""

    radial_distance: Batch
    tilt_angle: Batch
    swivel_angle: Batch
    blank_offset: Batch
    machine_root_angle: Batch
    machine_center_to_back: Batch


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Generator:
    """What the kinematics of one flank needs of its settings: a tree of numbers, all traced.

    Poses are those at cradle angle zero.
    """

    centre: Vector  # cutter centre in the cradle frame, mm
    head: Rotation  # from the cutter frame to the cradle frame
    cradle_angle: Scalar
    blank_offset: Scalar
    root_sine: Scalar
    root_cosine: Scalar
    machine_center_to_back: Scalar
    sliding_base: Batch  # powers from phi**0 to phi**6, mm
    roll: Batch  # W as powers from phi to phi**6: R_a, R_a c2, ..., R_a c6
    blade_ratio: Scalar  # R_b
    cutter_lead: Scalar
    cam: Cam | None
    axes: Axes | None
    # Whether the cam stands on its nominal seat (a plain zero, not a traced one): closed, no search.
    seated: bool = field(default=False, metadata={"static": True})


def generator(settings: MachineSettings, *, axes_move: bool | None = None) -> Generator:
    """The generator of a flank from its basic settings (any of which may be traced).

    ``axes_move`` says whether axes beside roll and sliding base move; None looks at their motions,
    which cannot be done where those are traced.
    """
    number = jnp.asarray

    def powers(first: Scalar, more: Sequence[float]) -> Batch:
        return number([first, *more, *[0.0] * (ORDERS - len(more))])

    if axes_move is None:
        axes_move = bool(set(settings.motions.moved()) - {"sliding_base"})
    axes = None
    if axes_move:
        names = Axes.__dataclass_fields__
        axes = Axes(
            **{n: powers(getattr(settings, n), getattr(settings.motions, n)) for n in names}
        )
    roll = settings.ratio_of_roll * powers(1.0, settings.modified_roll)[:ORDERS]
    if settings.cam is not None:  # its first power, where closed forms begin
        roll = number([cam_roll(settings.cam, number(0.0))[1], *[0.0] * (ORDERS - 1)])
    turn = jnp.pi / 2 - settings.cradle_angle + settings.swivel_angle
    return Generator(
        centre=_centre(settings.radial_distance, settings.cradle_angle),
        head=_head(
            jnp.sin(turn), jnp.cos(turn), jnp.sin(settings.tilt_angle), jnp.cos(settings.tilt_angle)
        ),
        cradle_angle=number(settings.cradle_angle),
        blank_offset=number(settings.blank_offset),
        root_sine=jnp.sin(settings.machine_root_angle),
        root_cosine=jnp.cos(settings.machine_root_angle),
        machine_center_to_back=number(settings.machine_center_to_back),
        sliding_base=powers(settings.sliding_base, settings.sliding_motion),
        roll=roll,
        blade_ratio=number(settings.roll_to_blade_ratio),
        cutter_lead=number(settings.cutter_lead),
        cam=settings.cam,
        seated=_seated(settings.cam),
        axes=axes,
    )


def _seated(cam: Cam | None) -> bool:
    return cam is not None and isinstance(cam.setting, float) and cam.setting == 0.0


def _centre(radial: Scalar, cradle_angle: Scalar) -> Vector:
    c, s = jnp.cos(cradle_angle), jnp.sin(cradle_angle)
    return radial * c, -radial * s, 0.0 * c


def _head(st: Scalar, ct: Scalar, si: Scalar, ci: Scalar) -> Rotation:
    """Rotation of the head from sines and cosines of its turn about the cradle's axis and its tilt."""
    zero = 0.0 * ct * ci
    return (
        (ct * ci, -st + zero, ct * si),
        (st * ci, ct + zero, st * si),
        (-si + zero, zero, ci + zero),
    )


@dataclass(frozen=True)
class Rates:
    """How the axes move at a cradle angle, per rad of it; cradle frame for centre and spin."""

    centre: Vector
    spin: Vector  # of the head, tilt and swivel together
    blank_offset: Batch
    machine_root_angle: Batch
    machine_center_to_back: Batch


@dataclass(frozen=True)
class Pose:
    """Where the axes stand at a cradle angle, and how they move (None: only roll and base do)."""

    cosine: Batch  # of the cradle angle
    sine: Batch
    centre: Vector
    head: Rotation
    blank_offset: Batch
    root_sine: Batch
    root_cosine: Batch
    machine_center_to_back: Batch
    sliding_base: Batch
    base_rate: Batch
    roll: Batch  # W, rad
    roll_rate: Batch
    rates: Rates | None

    def to_machine(self, v: Vector) -> Vector:
        """A direction of the cutter frame in the machine frame."""
        return turn_z(self.cosine, self.sine, rotated(self.head, v))


def to_work(sine: Batch, cosine: Batch, v: Vector) -> Vector:
    """A direction of the machine frame with the member's axis as z, by the machine root angle."""
    return sine * v[0] - cosine * v[2], v[1], cosine * v[0] + sine * v[2]


def pose(gen: Generator, phi: Batch) -> Pose:
    """The pose of a generator at cradle angles."""
    base, base_rate = _powers(gen.sliding_base, phi)
    if gen.cam is None:
        series, rate = _powers(gen.roll, phi)
        roll, roll_rate = series * phi, rate * phi + series
    else:
        roll, roll_rate = cam_roll(gen.cam, phi, seated=gen.seated)
    at = (gen.centre, gen.head, gen.blank_offset, gen.root_sine, gen.root_cosine)
    back, rates = gen.machine_center_to_back, None
    if gen.axes is not None:
        *at, back, rates = _moving(gen.axes, gen.cradle_angle, phi)
    turn, motion = once((sine_cosine(phi), (base, base_rate, roll, roll_rate)))
    return Pose(turn[1], turn[0], *at, back, *motion, rates)  # pyright: ignore


def _moving(axes: Axes, cradle_angle: Scalar, phi: Batch) -> tuple[object, ...]:
    radial, radial_rate = _powers(axes.radial_distance, phi)
    tilt, tilt_rate = _powers(axes.tilt_angle, phi)
    swivel, swivel_rate = _powers(axes.swivel_angle, phi)
    offset, offset_rate = _powers(axes.blank_offset, phi)
    root, root_rate = _powers(axes.machine_root_angle, phi)
    back, back_rate = _powers(axes.machine_center_to_back, phi)
    c, s = jnp.cos(cradle_angle), jnp.sin(cradle_angle)
    head = _head(*sine_cosine(jnp.pi / 2 - cradle_angle + swivel), *sine_cosine(tilt))
    # tilt turns about the y axis that the swivel has turned, swivel about the cradle's
    spin = (tilt_rate * head[0][1], tilt_rate * head[1][1], swivel_rate)
    drift = (radial_rate * c, -radial_rate * s, 0.0 * phi)
    rates = Rates(drift, spin, offset_rate, root_rate, back_rate)
    return _centre(radial, cradle_angle), head, offset, *sine_cosine(root), back, rates


def _powers(coefficients: Batch, phi: Batch) -> tuple[Batch, Batch]:
    """Value and derivative of c0 + c1 phi + ... at phi."""
    terms = [coefficients[k] for k in range(coefficients.shape[0])]
    slopes = [k * term for k, term in enumerate(terms)][1:]
    return polynomial(terms, phi), polynomial(slopes, phi)


def rotated(rows: Rotation, v: Vector) -> Vector:
    """A vector under a rotation given by rows."""
    x, y, z = v
    return tuple(row[0] * x + row[1] * y + row[2] * z for row in rows)  # type: ignore[return-value]


def rotated_back(rows: Rotation, v: Vector) -> Vector:
    """A vector under the inverse of a rotation given by rows."""
    x, y, z = v
    return tuple(rows[0][k] * x + rows[1][k] * y + rows[2][k] * z for k in range(3))  # type: ignore[return-value]
