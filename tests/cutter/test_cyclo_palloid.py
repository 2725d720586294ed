"""Two-part head: what setting the parts apart changes (lengthwise crowning) and what it does not."""

from __future__ import annotations

from dataclasses import replace
from math import cos, degrees, pi, sin, sqrt, tan
from typing import Any

import mpmath
import numpy as np
import pytest
from conftest import TABLE_1

from hypoid.cutter import CycloPalloidHead, FaceHobHead, edge_point, lengthwise_radius
from hypoid.design import build
from hypoid.flank import Flank, Side, best_way, cut_flank, flank_angles
from hypoid.geometry import DesignError
from hypoid.pair import GearPair, Member

Array = np.ndarray[Any, Any]
SIDES: tuple[Side, Side] = ("concave", "convex")
ECCENTRICITY = 4.0  # mm
FLANKS = [(m, s) for m in ("pinion", "wheel") for s in SIDES]


def blade_of(side: Side) -> Any:
    return "outer" if side == "concave" else "inner"


def recut(member: Member, side: Side, eccentricity: float, share: float = 0.5) -> Flank:
    """A flank of the 2022 pair as a two-part head cuts it."""
    flank, name = member.flank(side), blade_of(side)
    assert isinstance(member.head, FaceHobHead)
    head = CycloPalloidHead(member.head, eccentricity, share)
    settings = flank.settings
    phase = settings.cradle_angle - member.blank.mean_spiral_angle + member.head.slope_angle
    at = head.setting(name, settings.radial_distance, settings.cradle_angle, phase)
    settings = replace(settings, radial_distance=at.radial_distance, cradle_angle=at.cradle_angle)
    return cut_flank(
        flank.member,
        side,
        settings,
        {key: piece.turned(at.turn) for key, piece in head.pieces(name).items()},
        flank.cone,
        mirrored=flank.mirrored,
        theta_start=flank.theta_start,
        toe=flank.toe,
        heel=flank.heel,
        tip=flank.tip,
        root=flank.root,
        way=best_way(settings, revolution=False),
    )


def test_no_eccentricity_is_the_cyclo_cut_head(paper_pair: GearPair) -> None:
    """Bit for bit: pieces, settings, no crowning."""
    plain = paper_pair.pinion.head
    assert isinstance(plain, FaceHobHead)
    head = CycloPalloidHead(plain, 0.0)
    for name in ("outer", "inner"):
        assert head.part(name) is plain
        assert head.pieces(name) == plain.pieces(name)
        assert head.shift(name) == (0.0, 0.0)
        at = head.setting(name, 108.966409, 0.83, 0.2)
        assert (at.radial_distance, at.cradle_angle, at.turn) == (108.966409, 0.83, 0.2)
    assert head.crowning(130.0, 0.7) == 0.0
    assert head.faults() == []


@pytest.mark.parametrize("name", ["outer", "inner"])
def test_parts_meet_at_the_pitch_point_in_one_front_plane(paper_pair: GearPair, name: Any) -> None:
    """The shifted part's blade is the plain head's own, whatever the eccentricity."""
    plain = paper_pair.pinion.head
    assert isinstance(plain, FaceHobHead)
    for eccentricity, share in ((ECCENTRICITY, 0.5), (-9.0, 1.0), (7.0, 0.0)):
        head = CycloPalloidHead(plain, eccentricity, share)
        # as the blade passes P on the x axis: the inner one pi/z0 later
        turn = 0.0 if name == "outer" else pi / plain.blade_groups
        shift = np.array([*head.shift(name), 0.0])
        for key, piece in plain.pieces(name).items():
            moved, still = head.pieces(name)[key].turned(turn), piece.turned(turn)
            for s in np.linspace(float(still.low), float(still.high), 5):
                ours, slope = edge_point(moved, np.float64(s))
                theirs, other = edge_point(still, np.float64(s))
                assert np.array(ours) + shift == pytest.approx(np.array(theirs), abs=1e-12)
                assert np.array(slope) == pytest.approx(np.array(other), abs=1e-14)


def test_axes_stand_apart_by_the_eccentricity(paper_pair: GearPair) -> None:
    plain = paper_pair.pinion.head
    assert isinstance(plain, FaceHobHead)
    head = CycloPalloidHead(plain, ECCENTRICITY, 0.3)
    apart = np.subtract(head.shift("inner"), head.shift("outer"))
    assert np.hypot(*apart) == pytest.approx(ECCENTRICITY, rel=1e-14)
    for name in ("outer", "inner"):  # module and blade groups: the base radius stays
        part = head.part(name)
        base = plain.radius * sin(plain.slope_angle)
        assert part.radius * sin(part.slope_angle) == pytest.approx(base, rel=1e-14)
    assert head.part("outer").radius > plain.radius > head.part("inner").radius


@pytest.mark.parametrize("name", ["outer", "inner"])
def test_setting_moves_the_axis_by_the_shift(paper_pair: GearPair, name: Any) -> None:
    """On the cradle, and blades keep their direction there."""
    plain = paper_pair.pinion.head
    assert isinstance(plain, FaceHobHead)
    head, radial, q, turn = CycloPalloidHead(plain, ECCENTRICITY), 109.0, 0.83, 0.2

    def on_cradle(v: complex, angle: float) -> complex:
        return v * np.exp(1j * (pi / 2 - angle))

    at = head.setting(name, radial, q, turn)
    before, after = (
        r * np.exp(-1j * a) for r, a in ((radial, q), (at.radial_distance, at.cradle_angle))
    )
    shift = complex(*head.shift(name)) * np.exp(1j * turn)
    assert after - before == pytest.approx(on_cradle(shift, q), abs=1e-12)
    for key, piece in plain.pieces(name).items():
        ours = head.pieces(name)[key].turned(at.turn).tangent
        theirs = piece.turned(turn).tangent
        assert on_cradle(complex(*ours[:2]), at.cradle_angle) == pytest.approx(
            on_cradle(complex(*theirs[:2]), q), abs=1e-14
        )


def iso_radius(radius: float, slope: float, distance: float, spiral: float) -> float:
    """rho_mbeta of ISO 23509, (37)-(39) of the notes."""
    lam = pi / 2 - spiral + slope
    rho = sqrt(distance**2 + radius**2 - 2.0 * distance * radius * cos(lam))
    share = radius * sin(slope) / (distance * cos(spiral))  # z0/z_crown
    eta = np.arccos(distance * cos(spiral) / rho * (1.0 + share))
    both = tan(spiral) + tan(eta)
    return distance * cos(spiral) * (tan(spiral) + tan(eta) / (1.0 + tan(slope) * both))


CURVES = [(100.0, 0.068, 132.8, 0.7), (76.0, 0.329, 107.1, 0.5), (125.0, 0.0, 149.0, 0.61)]


@pytest.mark.parametrize(("radius", "slope", "distance", "spiral"), CURVES)
def test_lengthwise_radius_is_that_of_the_traced_epicycloid(
    radius: float, slope: float, distance: float, spiral: float, forty_digits: None
) -> None:
    """The plain trace differentiated twice, and the standard's formula."""
    value = lengthwise_radius(radius, slope, distance, spiral)
    r, nu, big, beta = (mpmath.mpf(v) for v in (radius, slope, distance, spiral))
    k = r * mpmath.sin(nu) / (big * mpmath.cos(beta))
    point, tangent = mpmath.mpc(big), mpmath.expj(beta)  # crown gear axis at the origin
    inward = mpmath.mpc(0, 1) * tangent  # P to the foot of the cutter axis on the front plane
    centre = point + r * mpmath.cos(nu) * inward + r * mpmath.sin(nu) * tangent

    def trace(turn: Any) -> Any:  # in the crown gear, which turns back by k per turn of the cutter
        return (centre + (point - centre) * mpmath.expj(turn)) * mpmath.expj(k * turn)

    first, second = mpmath.diff(trace, 0), mpmath.diff(trace, 0, 2)
    cross = mpmath.im(mpmath.conj(first) * second)
    assert abs(mpmath.im(first * mpmath.conj(tangent))) < 1e-12  # along the tooth, at spiral beta
    assert value == pytest.approx(float(abs(first) ** 3 / abs(cross)), rel=1e-12)
    if slope:
        assert value == pytest.approx(iso_radius(radius, slope, distance, spiral), rel=1e-12)
    else:
        assert value == pytest.approx(radius, rel=1e-14)


@pytest.mark.parametrize(("name", "side"), FLANKS)
def test_pressure_and_spiral_angle_stay(paper_pair: GearPair, name: str, side: Side) -> None:
    """At the mean point, both members, to the last digits; and the mean point stays where it was."""
    member: Member = getattr(paper_pair, name)
    middle = member.blank.mean_cone_distance
    before, after = member.flank(side), recut(member, side, ECCENTRICITY)
    angles = [flank_angles(flank, middle) for flank in (before, after)]
    assert degrees(angles[1].pressure - angles[0].pressure) == pytest.approx(0.0, abs=1e-9)
    assert degrees(angles[1].spiral - angles[0].spiral) == pytest.approx(0.0, abs=1e-9)
    places = [flank.at_cone([middle], [0.0]).position for flank in (before, after)]
    assert places[1] == pytest.approx(places[0], abs=1e-9)


def ease_off(
    pair: GearPair, name: str, side: Side, eccentricity: float
) -> tuple[Array, Array, float]:
    """Way along the trace of P in the crown gear and what is missing there, mm; relative curvature.

    At the points that P itself cuts; what is missing is made even, so that no cubic term is left.
    """
    member: Member = getattr(pair, name)
    head = member.head
    assert isinstance(head, FaceHobHead)
    # the crown gear that both members share has the wheel's apex (notes of 2022)
    distance, spiral = pair.wheel.blank.mean_cone_distance, pair.wheel.blank.mean_spiral_angle
    before, after = member.flank(side), recut(member, side, eccentricity)
    turns = np.linspace(-0.12, 0.12, 9)
    point, normal = before.at_cutter(0.0 * turns, before.theta_start + turns)
    found = after.at(point[:, 2], np.hypot(point[:, 0], point[:, 1]))
    missing = ((point - found.position) * normal).sum(axis=1)
    along, base = (head.radius * f(head.slope_angle) for f in (cos, sin))
    k = base / (distance * cos(spiral))
    way = (
        along + k * distance * sin(spiral)
    ) * turns  # speed (1 + k) p of P about the instant centre
    part = CycloPalloidHead(head, eccentricity).part(blade_of(side))
    plain, other = (
        1.0 / lengthwise_radius(h.radius, h.slope_angle, distance, spiral) for h in (head, part)
    )
    return (
        way,
        0.5 * (missing + missing[::-1]),
        plain - other if side == "concave" else other - plain,
    )


@pytest.mark.parametrize(("name", "side"), FLANKS)
@pytest.mark.parametrize("eccentricity", [ECCENTRICITY, -2.0])
def test_ease_off_is_the_parabola_of_the_curvatures(
    paper_pair: GearPair, name: str, side: Side, eccentricity: float
) -> None:
    """Missing normal to the flank: cos(alpha) (1/rho' - 1/rho) way**2/2, all along the face."""
    way, missing, curvature = ease_off(paper_pair, name, side, eccentricity)
    assert curvature * eccentricity > 0.0
    expected = 0.5 * curvature * cos(pi / 9) * way**2
    assert abs(expected[0]) > 5e-3 * abs(eccentricity) / ECCENTRICITY  # 13 um at 4 mm
    assert missing == pytest.approx(expected, rel=6e-3, abs=1e-9)


def test_crowning_is_shared_by_both_flanks_of_a_contact(paper_pair: GearPair) -> None:
    """Drive: pinion concave by its outer part, wheel convex by its inner; coast the other way round."""
    head = paper_pair.pinion.head
    assert isinstance(head, FaceHobHead)
    wheel = paper_pair.wheel.blank
    place = wheel.mean_cone_distance, wheel.mean_spiral_angle
    for mates in (("concave", "convex"), ("convex", "concave")):
        parts = zip(("pinion", "wheel"), mates, strict=True)
        total = sum(ease_off(paper_pair, n, s, ECCENTRICITY)[2] for n, s in parts)  # pyright: ignore
        both = CycloPalloidHead(head, ECCENTRICITY).crowning(*place)
        assert total == pytest.approx(both, rel=1e-12)
    # and hardly depends on which part is moved
    for share in (0.0, 1.0):
        one = CycloPalloidHead(head, ECCENTRICITY, share).crowning(*place)
        assert one == pytest.approx(both, rel=0.1)


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"eccentricity": 500.0}, "eccentricity"),
        ({"eccentricity": -500.0}, "eccentricity"),
        ({"eccentricity": float("nan")}, "eccentricity"),
        ({"outer_share": 1.2}, "outer_share"),
        ({"eccentricity": 99.5, "outer_share": 0.0}, "eccentricity"),
    ],
    ids=repr,
)
def test_faults(paper_pair: GearPair, changes: dict[str, Any], key: str) -> None:
    plain = paper_pair.pinion.head
    assert isinstance(plain, FaceHobHead)
    head = replace(CycloPalloidHead(plain, 2.0), **changes)
    (problem,) = head.faults("pinion.cutter")
    assert problem.path == f"pinion.cutter.{key}"
    with pytest.raises(DesignError):
        head.pieces("inner")
    if key == "eccentricity":
        words = problem.expected.split()
        for limit in (float(words[1]) + 1e-3, float(words[4]) - 1e-3):
            assert replace(head, eccentricity=limit).faults() == []


@pytest.mark.parametrize(("member", "side"), FLANKS)
def test_design_file_sets_the_parts_apart(paper_pair: GearPair, member: str, side: Side) -> None:
    """``cutting.eccentricity`` gives the flanks that the plain pair's settings, moved by hand, give."""
    pair = build(replace(TABLE_1, eccentricity=ECCENTRICITY, outer_share=0.3))
    made = getattr(pair, member).flank(side)
    wanted = recut(getattr(paper_pair, member), side, ECCENTRICITY, 0.3)
    distance, height = np.meshgrid(np.linspace(made.toe, made.heel, 5), [-1.0, 0.0, 1.5])
    ours, theirs = made.at_cone(distance, height), wanted.at_cone(distance, height)
    assert ours.ok.all()
    assert np.abs(ours.position - theirs.position).max() < 1e-10
    assert isinstance(getattr(pair, member).head, CycloPalloidHead)
