"""Tri-Ac blades and head against the 2005 paper, with its notes' corrections, in 30 digits."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace
from math import cos, degrees, inf, pi, radians, sin, tan
from typing import Any

import mpmath
import numpy as np
import pytest
from tri_ac import (
    PINION,
    PINION_HEAD,
    SHAPES,
    TOPREM,
    WHEEL,
    WHEEL_HEAD,
    PaperBlade,
    appendix_a,
)

from hypoid.cutter import (
    Blade,
    EdgePiece,
    FaceHobHead,
    TriAcBlade,
    TriAcHead,
    edge_point,
)
from hypoid.machine import MachineSettings, chain

mpf = mpmath.mpf
OUTER, INNER = PINION_HEAD.outer, PINION_HEAD.inner


@pytest.fixture(autouse=True)
def thirty_digits() -> Iterator[None]:
    with mpmath.workdps(30):
        yield


def head_of(**changes: Any) -> TriAcHead:
    outer, inner = (replace(blade, **changes) for blade in (OUTER, INNER))
    return replace(PINION_HEAD, outer=outer, inner=inner)


def start_in_paper(pieces: dict[str, EdgePiece], name: str) -> float:
    """The paper's s where a piece begins (land: where it ends)."""
    if name in ("land", "fillet"):
        return 0.0
    before = itertools.takewhile(lambda key: key != name, pieces)
    return sum(float(pieces[k].high) - float(pieces[k].low) for k in before if k != "land")


def along(piece: EdgePiece, count: int = 9) -> np.ndarray[Any, Any]:
    """Edge parameters within a piece, its ends included."""
    return np.linspace(float(piece.low), float(piece.high), count)


def unturned(head: TriAcHead, name: Any) -> dict[str, EdgePiece]:
    """Pieces of a blade before the inner one is turned to its place."""
    phase = 0.0 if name == "outer" else 2.0 * pi / head.blade_groups - head.following
    return {key: piece.turned(phase) for key, piece in head.pieces(name).items()}


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("name", ["outer", "inner"])
def test_edge_is_that_of_the_paper(name: Any, shape: str) -> None:
    """(2.a)-(2.d) with items 4-7 of the notes: every piece, every reading of L_T, both signs."""
    head = head_of(**SHAPES[shape])
    paper, pieces = PaperBlade(head.blade(name)), unturned(head, name)
    assert list(pieces) == [
        key for key in ("land", "fillet", "toprem", "flank") if key != "toprem" or paper.tau
    ]
    for key, piece in pieces.items():
        s = along(piece)
        points = np.stack(np.broadcast_arrays(*edge_point(piece, s)[0]), axis=-1)
        origin = start_in_paper(pieces, key) - (0.0 if key == "land" else float(piece.low))
        for length, point in zip(s, points, strict=True):
            expected = paper.head(mpf(float(length + origin)))
            assert max(abs(e - p) for e, p in zip(expected, point, strict=True)) < 2e-13


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("name", ["outer", "inner"])
def test_auxiliary_values(name: Any, shape: str) -> None:
    """alpha_t, delta, gamma, H, L1, L2 and x_R: the closed forms against a search (items 4-6)."""
    blade = head_of(**SHAPES[shape]).blade(name)
    paper, outline = PaperBlade(blade), blade.outline(1.0)
    first, second = paper.lengths
    assert abs(paper.alpha - blade.profile_angle) < 1e-15
    assert abs(paper.delta - blade.kink_angle) < 1e-14
    assert abs(paper.kink(paper.delta) - blade.flank_start) < 1e-14
    assert abs(paper.gamma * mpf(blade.edge_radius) - first) < 1e-28
    assert abs(first - outline[1].high) < 1e-14
    assert abs(paper.upper * paper.x_r - blade.tip) < 1e-14
    straight = outline[2].high - outline[2].low if blade.toprem else 0.0
    assert abs(second - straight) < 1e-13
    s = blade.outline(1.0)[-1].at(0.0)  # P
    assert [s.x, s.z + blade.height] == pytest.approx([0.0, 0.0], abs=1e-14)
    assert s.lean == pytest.approx(blade.profile_angle, abs=1e-15)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("name", ["outer", "inner"])
def test_pieces_join_and_only_toprem_kinks(name: Any, shape: str) -> None:
    """C1 at bottom/fillet and fillet/Toprem, a kink of tau in the projection at Toprem/curve (item 5)."""
    blade = head_of(**SHAPES[shape]).blade(name)
    pieces = head_of(**SHAPES[shape]).pieces(name)
    for first, second in itertools.pairwise(blade.outline(1.0)):
        before, after = first.at(first.high), second.at(second.low)
        assert [after.x, after.z] == pytest.approx([before.x, before.z], abs=1e-13)
        kink = blade.toprem.angle if blade.toprem and first.name == "toprem" else 0.0
        assert after.lean - before.lean == pytest.approx(kink, abs=1e-13)
        ends = (
            (edge_point(pieces[first.name], np.float64(first.high))[0]),
            (edge_point(pieces[second.name], np.float64(second.low))[0]),
        )
        assert np.array(ends[1]) == pytest.approx(np.array(ends[0]), abs=1e-12)


@pytest.mark.parametrize("name", ["outer", "inner"])
def test_edge_lies_in_the_rake_plane_ground_on_the_stick(name: Any) -> None:
    """Back in the stick's frame (hook undone): side rake kappa_e to the tool plane, edge at alpha_e in it."""
    head = head_of(toprem=None, rake_angle=radians(12.0), hook_angle=radians(4.42))
    blade, side = head.blade(name), 1.0 if name == "outer" else -1.0
    hook = blade.hook_angle

    def on_stick(v: Any, foot: Any = (0.0, 0.0, 0.0)) -> tuple[Any, Any, Any]:
        """Across, square to the tool plane, and along the stick."""
        x, y, z = (np.asarray(a) - b for a, b in zip(v, foot, strict=True))
        across = (x + 1j * y) * np.exp(1j * blade.eccentric_angle)
        y = across.imag
        return across.real, y * cos(hook) + z * sin(hook), z * cos(hook) - y * sin(hook)

    pieces = unturned(head, name)
    for piece in pieces.values():
        point, tangent = edge_point(piece, along(piece))
        pitch_point = (blade.radius, 0.0, -blade.height)
        for x, y, _ in (on_stick(point, pitch_point), on_stick(tangent)):
            assert y == pytest.approx(-side * x * tan(blade.rake_angle), abs=1e-12)
    x, _, z = on_stick(edge_point(pieces["flank"], np.float64(0.0))[1])
    assert side * x / -z == pytest.approx(tan(blade.blade_angle), abs=1e-14)


def test_blade_angles_of_the_set_give_round_profile_angles() -> None:
    """The notes' gear: 23.0825 and 17.0327 deg in the tool plane are 23 and 17 deg across the tooth."""
    assert degrees(WHEEL_HEAD.outer.profile_angle) == pytest.approx(23.0, abs=5e-5)
    assert degrees(WHEEL_HEAD.inner.profile_angle) == pytest.approx(17.0, abs=5e-5)


def test_the_reading_of_toprem_moves_the_tip() -> None:
    """Notes, item 5: by 3-30 um."""
    for blade in (OUTER, INNER):
        along_flank, axial, straight = (
            replace(blade, toprem=replace(TOPREM, measured=name)).tip  # pyright: ignore
            for name in ("along-flank", "axial", "straight-part")
        )
        moved = np.array([along_flank - axial, axial - straight, along_flank - straight])
        assert ((abs(moved) > 1e-3) & (abs(moved) < 31e-3)).all()


def test_an_unraked_straight_head_is_the_cyclo_cut_head() -> None:
    """Moved by the blade height along its axis, and its inner blade at the same place."""
    angle, height, shank = radians(20.0), 2.97, 4.0
    plain = FaceHobHead(
        100.0,
        5,
        radians(3.9),
        *(Blade(name, angle, height, 1.0, shank, 0.7) for name in ("outer", "inner")),  # pyright: ignore
    )
    head = TriAcHead(
        5,
        *(
            TriAcBlade(name, 100.0, angle, height, 1.0, shank, radians(3.9), land=0.7)  # pyright: ignore
            for name in ("outer", "inner")
        ),
    )
    for name in ("outer", "inner"):
        ours, theirs = unturned(head, name), plain.pieces(name)
        theirs = {k: p.turned(pi / 5 if name == "inner" else 0.0) for k, p in theirs.items()}
        assert list(ours) == list(theirs)
        for key, piece in theirs.items():
            low = float(ours[key].low) - float(piece.low)
            for s in along(piece):
                point, slope = edge_point(ours[key], np.float64(s + low))
                other, other_slope = edge_point(piece, np.float64(s))
                assert np.array(point) + np.array([0.0, 0.0, height]) == pytest.approx(
                    np.array(other), abs=1e-13
                )
                assert np.array(slope) == pytest.approx(np.array(other_slope), abs=1e-14)
    assert head.pieces("inner")["flank"].start[:2] == pytest.approx(
        plain.pieces("inner")["flank"].start[:2], abs=1e-13
    )


@pytest.mark.parametrize(
    ("head", "settings"), [(WHEEL_HEAD, WHEEL), (PINION_HEAD, PINION)], ids=["Formate", "generated"]
)
def test_pieces_and_chain_are_the_papers_matrices(
    head: TriAcHead, settings: MachineSettings
) -> None:
    """(3) with the corrected (A.2), (A.4), (A.7): tilt, swivel, both indexing motions, 1e-11 mm."""
    rng = np.random.default_rng(3)
    for name in ("outer", "inner"):
        paper, pieces = PaperBlade(head.blade(name)), head.pieces(name)  # pyright: ignore
        phase = 0.0 if name == "outer" else head.following - 2.0 * pi / head.blade_groups
        for key, piece in pieces.items():
            s, theta, phi = (float(rng.uniform(a, b)) for a, b in ((0, 1), (-1, 1), (-0.6, 0.6)))
            s = float(piece.low) + s * (float(piece.high) - float(piece.low))
            point = [float(v) for v in edge_point(piece, np.float64(s))[0]]
            ours = chain(settings, theta, phi) @ np.array([*point, 1.0])
            origin = start_in_paper(pieces, key) - (0.0 if key == "land" else float(piece.low))
            # a blade that stands at an angle in the head is the same blade after that turn
            edge = mpmath.matrix([*paper.head(mpf(s + origin)), 1])
            placed = appendix_a(replace(settings, roll_to_blade_ratio=0.0), theta - phase, phi)
            work = mpf(settings.roll_to_blade_ratio) * mpf(theta)
            c, e = mpmath.cos(work), mpmath.sin(work)
            x, y, z, _ = placed * edge
            expected = [c * x + e * y, c * y - e * x, z]
            assert max(abs(a - b) for a, b in zip(expected, ours[:3], strict=True)) < 1e-11
            if name == "outer":
                whole = appendix_a(settings, theta, phi) * edge
                assert max(abs(a - b) for a, b in zip(whole, expected, strict=False)) < 1e-25


def test_positive_hook_sends_the_tip_ahead() -> None:
    """Rising theta moves the blade along -y_t; the tip is ahead of P by h_f tan(Gamma_b) there."""
    head = head_of(rake_angle=0.0)
    fillet, turn = head.pieces("outer")["fillet"], OUTER.eccentric_angle
    x, y, _ = (float(v) for v in edge_point(fillet, np.float64(0.0))[0])
    ahead = -((x - OUTER.radius) * sin(turn) + y * cos(turn))
    assert ahead == pytest.approx(OUTER.height * tan(OUTER.hook_angle), abs=1e-12)


def test_slot_widths_of_an_equal_head() -> None:
    """Equal radii and half a group: half the normal pitch; the tips take their share of it."""
    blades = [
        TriAcBlade(name, 100.0, radians(20.0), 3.0, 0.0, 4.0, radians(4.0))  # pyright: ignore
        for name in ("outer", "inner")
    ]
    head = TriAcHead(5, *blades)
    assert head.pitch_slot == pytest.approx(pi / 5 * 100.0 * sin(radians(4.0)), rel=1e-14)
    assert head.tip_slot == pytest.approx(head.pitch_slot - 6.0 * tan(radians(20.0)), rel=1e-13)
    land = head.pieces("outer")["land"]
    assert float(land.high) - float(land.low) == pytest.approx(0.5 * head.tip_slot, rel=1e-13)


def test_straight_either_way() -> None:
    """A curve radius of 0 or infinite is one straight edge."""
    a, b = (head_of(curve_radius=value).pieces("outer") for value in (0.0, inf))
    assert a == b
