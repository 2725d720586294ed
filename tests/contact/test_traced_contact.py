"""Derivatives of transmission error, path and ease-off by everything that makes a pair, every example.

Once against differences with 40 digits of a plain chain (`following`): every setting, every coefficient
of roll and motions, cam, every number of the blade, every error of mounting. And once the whole way:
settings changed, flanks cut again, contact searched again; two steps each (Richardson).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import jax
import mpmath
import numpy as np
import pytest
from following import ERRORS, Following, Held, Mounted, Name, Seen
from independent import cross, digits

import hypoid
from hypoid.contact import (
    Misalignment,
    Sampling,
    TracedContact,
    ease_off,
    traced_contact,
    unloaded_contact,
)
from hypoid.flank import HeldPoints, held_points, recut
from hypoid.geometry import jitted

EXAMPLES = Path(__file__).parents[2] / "examples"
LOOK = Sampling(positions_per_pitch=12, pairs=3, columns=21, rows=11)
SETTINGS = ("radial_distance", "machine_root_angle", "blank_offset", "tilt_angle")
COAST = ("vimercati-piazza-2005",)  # the others drive
PAIRS = [(f.stem, "coast" if f.stem in COAST else "drive") for f in sorted(EXAMPLES.glob("*.toml"))]
WITH_PATH = [p for p in PAIRS if p[0] != "tsay-lin-1993-as-printed"]  # edges carry all of that one
WHOLE = [("lin-tsay-fong-1996", "drive")]


@cache
def traced(name: str, direction: Any) -> TracedContact:
    pair = hypoid.read(EXAMPLES / f"{name}.toml")
    error = Misalignment(0.02, -0.03, 0.01, 1e-4)  # none of the four slopes at a place of its own
    return traced_contact(unloaded_contact(pair, direction, error, LOOK))


@cache
def everything(name: str, direction: Any) -> tuple[Any, Any]:
    """Transmission error, path and ease-off, and their derivatives by every parameter."""
    one = traced(name, direction)

    def values(p: Any) -> Any:
        return one.transmission_error(p), one.path(p), one.ease_off(p)

    value = values(one.parameters)
    return value, jitted(jax.jacfwd(values))(one.parameters)


# --- 40 digits -------------------------------------------------------------------------------------


def slope(tree: Any, member: str, name: Name, at: tuple[int, ...]) -> float:
    """One derivative out of the package's tree."""
    if member == "mounting":
        return float(tree.misalignment[(*at, ERRORS.index(name[0]))])
    kind, *where = name
    flank = getattr(tree, member)
    if kind == "settings":
        return float(flank.settings[where[0]][at])
    if kind == "roll":
        return float(flank.roll[(*at, int(where[0]))])
    if kind == "motions":
        return float(flank.motions[where[0]][(*at, int(where[1]))])
    value = getattr(getattr(flank, kind), where[0])
    return float(value[int(where[1])][at] if len(where) > 1 else value[at])


def path_slopes(one: TracedContact, k: int) -> dict[tuple[str, Name], list[Any]]:
    """Slopes of lead, S and H at one position of the path."""
    contact, on = one.contact, one.contact.on_path[k]
    mounted, cone = Mounted(contact, float(contact.phi[on])), contact.pinion_flank.cone

    def rows(
        first: Seen, second: Seen, turn: Any, turn2: Any, errors: Sequence[Any]
    ) -> tuple[list[Any], list[Any]]:
        z, rho, angle, normal, _ = mounted.pinion(first, turn, errors)
        lead, turned = mounted.lead(angle, second, turn2)
        q, n = second.point, (second.normal[0], -second.normal[1], second.normal[2])
        c, s = mpmath.cos(turned), mpmath.sin(turned)
        twist = cross(normal, mpmath.matrix([c * n[0] - s * n[1], s * n[0] + c * n[1], n[2]]))
        across = sorted(range(3), key=lambda i: abs(normal[i]))[:2]
        conditions = [z - q[2], rho - mpmath.hypot(q[0], q[1]), *(twist[i] for i in across)]
        own = first.point[2] + digits(cone.apex_beyond), mpmath.hypot(*first.point[:2])
        sine, cosine = digits(cone.sine), digits(cone.cosine)
        place = own[0] * cosine + own[1] * sine, own[1] * cosine - own[0] * sine
        return [*conditions, first.left, second.left], [lead, *place]

    points = contact.points
    pinion = held_points(contact.pinion_flank, points.s1[[on]], points.theta1[[on]])
    wheel = held_points(contact.wheel_flank, points.s2[[on]], points.theta2[[on]])
    return following(one, pinion, wheel, rows).slopes()


def node_slopes(one: TracedContact, k: int) -> dict[tuple[str, Name], list[Any]]:
    """Slopes of the ease-off at one node of the 5 x 9 grid."""
    _, there, moving = one._nodes(5, 9)  # pyright: ignore[reportPrivateUsage]
    i = int(np.flatnonzero(there == k)[0])
    phi = float(moving.phi[i])
    mounted = Mounted(one.contact, phi)

    def rows(
        first: Seen, second: Seen, turn: Any, turn2: Any, errors: Sequence[Any]
    ) -> tuple[list[Any], list[Any]]:
        z, rho, angle, normal, point = mounted.pinion(first, turn, errors)
        lead, _ = mounted.lead(angle, second, turn2)
        own, q = first.point, second.point
        stay = [own[2], mpmath.hypot(own[0], own[1])]
        met = [z - q[2], rho - mpmath.hypot(q[0], q[1])]
        lever = abs(point[0] * normal[1] - point[1] * normal[0])
        return [*stay, *met, first.left, second.left], [-lead * lever]

    def only(held: HeldPoints) -> HeldPoints:
        return replace(held, s=held.s[[i]], theta=held.theta[[i]], phi=held.phi[[i]])

    return following(one, only(moving.pinion), only(moving.wheel), rows).slopes()


def following(one: TracedContact, pinion: HeldPoints, wheel: HeldPoints, rows: Any) -> Following:
    contact, cones = one.contact, one.contact.pair.blank.cones
    flanks = contact.pinion_flank, contact.wheel_flank
    distances = cones.pinion_mean_cone_distance, cones.wheel_mean_cone_distance
    pitch = tuple(
        Held.of(f, held_points(f, *f.parameters([d], [0.0])[:2]), 0)
        for f, d in zip(flanks, distances, strict=True)
    )
    points = Held.of(flanks[0], pinion, 0), Held.of(flanks[1], wheel, 0)
    return Following(contact, points, pitch, rows)  # type: ignore[arg-type]


def close(exact: float, found: float, size: float) -> bool:
    return abs(exact - found) <= 1e-8 * abs(exact) + 1e-11 * size


@pytest.mark.parametrize(("name", "direction"), WITH_PATH)
def test_every_slope_of_transmission_error_and_path(name: str, direction: str) -> None:
    one, (_, (error, path, _)) = traced(name, direction), everything(name, direction)
    zero = int(np.argmin(np.abs(one.pinion_angle)))
    k = zero - 2 if zero >= 2 else zero + 2
    here, there = path_slopes(one, k), path_slopes(one, zero)
    assert len(here) > 100
    size = max(abs(float(v[0])) for v in here.values())
    spread = max(abs(float(v[1])) for v in here.values())
    for (member, which), (lead, *place) in here.items():
        exact = float(lead - there[member, which][0])
        assert close(exact, slope(error, member, which, (k,)), size), (member, which)
        for i in (0, 1):
            found = slope(path, member, which, (k, i))
            assert close(float(place[i]), found, 1e3 * spread), (member, which, i)


@pytest.mark.parametrize(("name", "direction"), PAIRS)
def test_every_slope_of_the_ease_off(name: str, direction: str) -> None:
    one, ((_, _, value), (*_, slopes)) = traced(name, direction), everything(name, direction)
    there = np.flatnonzero(np.isfinite(np.asarray(value).ravel()))
    assert len(there) > 15
    k = int(there[len(there) // 3])
    found = node_slopes(one, k)
    size = max(abs(float(v[0])) for v in found.values())
    for (member, which), (exact,) in found.items():
        got = slope(slopes, member, which, divmod(k, 9))
        assert close(float(exact), got, size), (member, which)


# --- the whole way ---------------------------------------------------------------------------------


def changed(one: TracedContact, setting: str, step: float) -> Any:
    """Contact of the pair whose pinion flank is cut again with a setting moved."""
    contact = one.contact
    flank = contact.pinion_flank
    settings = replace(flank.settings, **{setting: getattr(flank.settings, setting) + step})
    pinion = replace(contact.pair.pinion, **{flank.side: recut(flank, settings)})
    pair = replace(contact.pair, pinion=pinion)
    return unloaded_contact(pair, contact.direction, contact.misalignment, LOOK)


def lead(one: TracedContact, contact: Any) -> np.ndarray:
    values = contact.points.lead[one.contact.on_path]
    return values - values[np.argmin(np.abs(one.pinion_angle))]


def richardson(of: Any, step: float) -> np.ndarray:
    coarse, fine = ((of(h) - of(-h)) / (2.0 * h) for h in (2.0 * step, step))
    return (4.0 * fine - coarse) / 3.0


@pytest.mark.parametrize(("name", "direction"), PAIRS)
def test_values_are_those_of_the_contact(name: str, direction: str) -> None:
    one, (value, _) = traced(name, direction), everything(name, direction)
    error, path, gaps = (np.asarray(v) for v in value)
    if (name, direction) in WITH_PATH:
        assert np.abs(error - lead(one, one.contact)).max() < 1e-13
        assert np.abs(path - np.stack(one.contact.path, axis=1)).max() < 1e-8
    else:
        assert not error.size
        assert not path.size
    i, j = np.linspace(0, 10, 5).round().astype(int), np.linspace(0, 20, 9).round().astype(int)
    seen = ease_off(one.contact).value[i][:, j]
    there = np.isfinite(gaps)
    assert there.mean() > 0.35
    assert np.abs(gaps - seen)[there].max() < 1e-9


@pytest.mark.parametrize(("name", "direction"), WHOLE)
def test_transmission_error_by_settings(name: str, direction: str) -> None:
    one, (_, (slopes, _, _)) = traced(name, direction), everything(name, direction)
    for setting in SETTINGS:
        exact = np.asarray(slopes.pinion.settings[setting])
        seen = richardson(lambda h, s=setting: lead(one, changed(one, s, h)), 2e-4)
        there = np.isfinite(seen)
        size = float(np.abs(seen[there]).max())
        assert np.abs(exact - seen)[there].max() < 1e-5 * size + 1e-9, setting


@pytest.mark.parametrize(("name", "direction"), WHOLE)
def test_transmission_error_by_misalignment(name: str, direction: Any) -> None:
    one, (_, (slopes, _, _)) = traced(name, direction), everything(name, direction)
    own = one.contact.misalignment
    for k, error in enumerate(ERRORS):

        def at(step: float, error: str = error) -> np.ndarray:
            mounted = replace(own, **{error: getattr(own, error) + step})
            return lead(one, unloaded_contact(one.contact.pair, direction, mounted, LOOK))

        seen = richardson(at, 1e-4)
        there = np.isfinite(seen)
        size = float(np.abs(seen[there]).max())
        exact = np.asarray(slopes.misalignment)[:, k]
        assert np.abs(exact - seen)[there].max() < 1e-5 * size + 1e-9, error
