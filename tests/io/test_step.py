"""STEP solids as the CAD kernel reads them back: valid, closed, as exact as they say, of the right volume."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hypoid
from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.geometry import DesignError
from hypoid.io import _occ, _step, parse_spec, write_step
from hypoid.pair import GearPair, Member
from hypoid.solid import Body, _pieces, body, probes, tooth_splines

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
MEMBERS = [(path.stem, name) for path in EXAMPLES for name in ("pinion", "wheel")]
UM = 1e-3

kernel = pytest.mark.skipif(not _occ.available(), reason='needs the extra "cad"')


@lru_cache
def pair_of(example: str) -> GearPair:
    return hypoid.read(EXAMPLES[0].parent / f"{example}.toml")


def member_of(example: str, name: str) -> Member:
    return getattr(pair_of(example), name)


@lru_cache
def volume_and_height(member: Member, ring: Body) -> tuple[float, float]:
    """Volume (mm³) of the whole gear and its centre's z, by the plain tooth grid: no spline, no kernel.

    Places (S, H) are turned and shifted ones of (z, rho), so dz drho = dS dH, and over a slot's outline
    in (angle, H) the integral of f(H) is that of -F(H) d(angle) around it (Green), F a primitive of f.
    """
    tooth, flank = member.tooth, member.concave
    grid = tooth.grid(65, 81, 33)
    cone = flank.cone
    sine, cosine, apex = float(cone.sine), float(cone.cosine), float(cone.apex_beyond)
    toe, heel = flank.toe, flank.heel
    share = (grid.distance - toe) / (heel - toe)
    base = ring.base_height[0] * (1.0 - share) + ring.base_height[1] * share
    moments = np.zeros((2, len(grid.distance)))
    for k, s in enumerate(grid.distance):
        radius, z = np.poly1d([cosine, s * sine]), np.poly1d([-sine, s * cosine - apex])
        concave, convex = grid.concave, grid.convex
        angle = np.concatenate(
            [grid.bottom_angle[k], concave.angle[k], convex.angle[k, ::-1] - tooth.pitch]
        )
        height = np.concatenate([grid.bottom_height[k], concave.height[k], convex.height[k, ::-1]])
        for row, f in enumerate((radius, radius * z)):
            whole = np.polyint(f)
            up = whole(height)
            slot = -0.5 * ((up + np.roll(up, -1)) * (np.roll(angle, -1) - angle)).sum()
            moments[row, k] = tooth.pitch * (whole(grid.tip[k]) - whole(base[k])) - slot
    weights = np.ones(len(share))
    weights[1:-1:2], weights[2:-1:2] = 4.0, 2.0  # Simpson
    teeth = member.teeth * (moments @ weights) * (grid.distance[1] - grid.distance[0]) / 3.0
    z, r = np.array(ring.outline).T
    z2, r2 = np.roll(z, -1), np.roll(r, -1)
    turn = z * r2 - z2 * r
    below = np.array(
        [
            2.0 * pi * (turn * (r + r2)).sum() / 6.0,
            2.0 * pi * (turn * (2 * z * r + z * r2 + z2 * r + 2 * z2 * r2)).sum() / 24.0,
        ]
    )
    volume, first = teeth + below * np.sign(below[0])
    return float(volume), float(first / volume)


@kernel
@pytest.mark.parametrize(("example", "name"), MEMBERS)
def test_one_tooth_of_every_example(example: str, name: str, tmp_path: Path) -> None:
    member = member_of(example, name)
    report = write_step(member, tmp_path / "tooth.step", teeth=1)
    assert report.valid
    assert report.closed
    assert report.faults == ()
    flanks = {f"{f.side} flank" for f in (member.concave, member.convex)}
    fillets = {f"{f.side} fillet" for f in (member.concave, member.convex) if "fillet" in f.pieces}
    assert flanks | fillets <= set(report.deviation)
    assert max(report.deviation[name] for name in flanks) < 0.001 * UM
    assert max(report.deviation.values()) < 0.01 * UM
    assert report.tolerance <= 1e-6
    volume, _ = volume_and_height(member, body(member))
    assert report.volume == pytest.approx(volume / member.teeth, rel=1e-4)


@kernel
@pytest.mark.parametrize(
    ("example", "name"),
    [
        ("gonzalez-fuentes-2022", "pinion"),  # fewest teeth, left hand
        ("gonzalez-fuentes-2022", "wheel"),  # most teeth, right hand
    ],
)
def test_whole_gear(example: str, name: str, tmp_path: Path) -> None:
    member = member_of(example, name)
    report = write_step(member, tmp_path / "gear.step", teeth=None)
    assert report.teeth == member.teeth
    assert report.faults == ()
    assert report.valid
    assert report.closed
    volume, height = volume_and_height(member, body(member))
    assert report.volume == pytest.approx(volume, rel=1e-4)
    assert report.centre == pytest.approx((0.0, 0.0, height), abs=1e-3)
    inertia = np.array(report.inertia)
    assert inertia == pytest.approx(np.diag(np.diag(inertia)), abs=1e-6 * inertia[2, 2])
    assert inertia[0, 0] == pytest.approx(inertia[1, 1], rel=1e-6)
    # a tooth half-way around, and not only the first
    read = _occ.StepFile(tmp_path / "gear.step")
    turn = member.teeth // 2 * member.tooth.pitch
    c, s = np.cos(turn), np.sin(turn)
    splines = tooth_splines(member.tooth)
    for probe in probes(member.tooth, tuple(span.span for span in splines), 3):
        x, y, z = probe.points.T
        turned = np.stack([c * x - s * y, s * x + c * y, z], axis=-1)
        assert read.distances(turned).max() < 0.01 * UM


@kernel
def test_the_other_hand_is_the_mirror_image(
    table_1_spec: ExactFaceHobbedSpec, tmp_path: Path
) -> None:
    left, right = (
        write_step(build(replace(table_1_spec, pinion_hand=hand)).pinion, tmp_path / hand)  # pyright: ignore
        for hand in ("left", "right")
    )
    assert right.faults == ()
    assert right.valid
    assert right.closed
    assert right.volume == pytest.approx(left.volume, rel=1e-7)
    assert right.centre == pytest.approx(np.array(left.centre) * [1.0, -1.0, 1.0], abs=1e-6)


@kernel
def test_some_teeth_weigh_as_many_as_they_are(tmp_path: Path) -> None:
    """Five of six teeth, whose spiral and slots together reach further than once around."""
    member = member_of("gonzalez-fuentes-2022", "pinion")
    one, five = (write_step(member, tmp_path / "x.step", teeth=k) for k in (1, 5))
    assert five.faults == ()
    assert five.valid
    assert five.closed
    assert five.volume == pytest.approx(5 * one.volume, rel=1e-7)


@kernel
def test_bore_and_back_face_are_where_they_are_asked_for(tmp_path: Path) -> None:
    member = member_of("tsay-lin-1993", "wheel")
    usual = body(member)
    plain = write_step(member, tmp_path / "x.step")
    bore, back = usual.bore - 4.0, usual.back + 3.0
    other = write_step(member, tmp_path / "x.step", bore=bore, back=back)
    assert other.valid
    assert other.closed
    rim = usual.heel_base[1]
    more = pi * (usual.bore**2 - bore**2) * (usual.back - usual.front)
    more += pi * (rim**2 - bore**2) * 3.0
    assert other.volume - plain.volume == pytest.approx(more / member.teeth, rel=1e-7)


KINKS = {
    "relief": 'flankrem = { height = "6 mm", coefficient = "0.004 /mm" }',
    "flankrem": 'flankrem = { height = "6 mm", angle = "2 deg" }',
}


@kernel
@pytest.mark.parametrize("name", KINKS)
def test_a_strip_ends_where_the_edge_bends(name: str, tmp_path: Path) -> None:
    """Where a relief begins, and at a kink, below which either piece goes on."""
    text = (EXAMPLES[0].parent / "lin-tsay-fong-1996.toml").read_text(encoding="utf-8")
    for side in ("concave", "convex"):
        table = f"[wheel.{side}.blade]"
        assert table in text
        text = text.replace(table, f"{table}\n{KINKS[name]}")
    spec = parse_spec(text)
    report = write_step(build(spec).wheel, tmp_path / "x.step")
    assert report.valid
    assert report.closed
    assert set(report.deviation) >= {f"concave {name}", f"convex {name}"}
    assert max(report.deviation.values()) < 0.01 * UM
    assert report.tolerance <= 1e-6


@kernel
def test_a_flank_that_cannot_be_told_apart_is_one_face_and_says_how_exact(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(_pieces, "borders", lambda *_: [])
    report = write_step(member_of("lin-tsay-fong-1996", "wheel"), tmp_path / "x.step")
    assert report.valid
    assert report.closed
    assert set(report.deviation) == {"concave flank and fillet", "convex flank and fillet"}
    assert 0.01 * UM < max(report.deviation.values()) < 10 * UM
    assert len(report.faults) == sum(off > 0.1 * UM for off in report.deviation.values())


@kernel
def test_the_file_names_its_part_and_faces_and_nothing_is_said(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "gear.step"
    path.write_text("what stood there before")
    report = write_step(member_of("gonzalez-fuentes-2022", "wheel"), path, teeth=2)
    assert capfd.readouterr() == ("", "")
    text = path.read_text(encoding="ascii")
    assert path.stat().st_size == report.size == report.as_dict()["size_bytes"]
    assert list(tmp_path.iterdir()) == [path]
    assert "AP242" in text
    assert "PRODUCT('wheel, 2 of 73 teeth'" in text
    names = ("concave flank", "convex fillet", "top land", "bottom", "toe", "heel", "bore", "back")
    assert all(f"ADVANCED_FACE('{name}'" in text for name in names)


@kernel
def test_a_solid_that_is_not_written_leaves_what_was_there(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    path = tmp_path / "gear.step"
    path.write_text("what stood there before")

    def fails(*_: Any) -> None:
        raise DesignError([])

    monkeypatch.setattr(_occ, "write", fails)
    with pytest.raises(DesignError):
        write_step(member_of("tsay-lin-1993", "wheel"), path)
    assert path.read_text() == "what stood there before"
    assert list(tmp_path.iterdir()) == [path]


def test_without_the_kernel_one_command_is_named(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(_occ, "available", lambda: False)
    with pytest.raises(DesignError, match=r'pip install "hypoid\[cad\]"'):
        write_step(member_of("gonzalez-fuentes-2022", "wheel"), tmp_path / "x.step")
    assert not list(tmp_path.iterdir())


def test_all_that_is_wrong_is_said_at_once(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(_step._occ, "need_kernel", lambda: None)
    member = member_of("gonzalez-fuentes-2022", "wheel")
    with pytest.raises(DesignError) as caught:
        write_step(member, tmp_path / "no" / "x.step", teeth=74, bore=-1.0, back=0.0)
    assert [p.path.rsplit("/", 1)[-1] for p in caught.value.problems] == [
        "x.step", "teeth", "bore", "back",
    ]  # fmt: skip
