"""Where a Toprem is cut away along part of the face: spans end there, and faces stay on the exact surface."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
import pytest

from hypoid.design import build
from hypoid.flank import Flank, Side, Tooth, lowest
from hypoid.io import example_files, parse_spec
from hypoid.solid import tooth_splines

FILE = next(file for file in example_files() if file.stem == "vimercati-piazza-2005")
VANISHES: dict[Side, int] = {"concave": 2, "convex": 1}  # a band near the heel; away near the toe
NEAR = 0.02  # mm along the face, over which the Toprem grows to 0.1 um
UM = 1e-3


LENGTHS = (1.6, 2.0)  # mm, of the Toprem: as in the file, and where it widens on both flanks


@lru_cache
def tooth(length: float = LENGTHS[0]) -> Tooth:
    text, own = FILE.read_text(encoding="utf-8"), 'toprem = { length = "1.6 mm"'
    assert own in text
    return build(parse_spec(text.replace(own, own.replace("1.6", f"{length}")))).pinion.tooth


@lru_cache
def splines(length: float = LENGTHS[0]) -> Any:
    return tooth_splines(tooth(length))


def toprem_seen(flank: Flank, distance: Any) -> Any:
    """Whether the Toprem makes some of the flank at cone distances: ever finer looks at where the fillet ends."""
    fillet, toprem = (flank.cut_pieces.index(name) for name in ("fillet", "toprem"))
    low, high = lowest(flank, distance)[0], np.asarray(flank.tip.at(distance))
    share = np.linspace(0.0, 1.0, 41)[1:]
    seen = np.zeros(len(distance), bool)
    for _ in range(4):
        height = low + np.outer(share, high - low)
        piece = flank.at_cone(np.broadcast_to(distance, height.shape), height).piece
        piece = piece.reshape(height.shape)
        seen |= (piece == toprem).any(axis=0)
        first, every = np.argmax(piece != fillet, axis=0), np.arange(len(distance))
        low, high = np.where(first > 0, height[first - 1, every], low), height[first, every]
    return seen


@pytest.mark.parametrize("side", VANISHES)
def test_spans_end_where_the_toprem_vanishes(side: Side) -> None:
    flank = tooth().flank(side)
    stations = np.array([span.span.start for span in splines()] + [flank.heel])
    before, after = (toprem_seen(flank, stations[1:-1] + step) for step in (-NEAR, NEAR))
    assert (before != after).sum() == VANISHES[side]
    along = np.linspace(flank.toe, flank.heel, 42)[:-1] + 0.3  # away from stations
    changes = np.flatnonzero(np.diff(toprem_seen(flank, along)))
    assert len(changes) == VANISHES[side]
    for k, station in zip(changes, stations[1:-1][before != after], strict=True):
        assert along[k] < station < along[k + 1]


@pytest.mark.parametrize("side", VANISHES)
@pytest.mark.parametrize("length", LENGTHS)
def test_every_face_lies_on_the_surface_that_is_cut(length: float, side: Side) -> None:
    """Against ``at_cone`` at the splines' own places, which knows neither strips nor stations."""
    own = tooth(length)
    flank, turn = own.flank(side), own.convex_turn if side == "convex" else 0.0
    cosine, sine = np.cos(turn), np.sin(turn)
    back = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    inner = np.linspace(0.004, 0.996, 32)
    off: dict[str, float] = {}
    for span in splines(length):
        for patch in span.patches:
            if not patch.strip.name.startswith(side):
                continue
            point = patch(inner, inner) @ back
            seen = flank.at(point[..., 2], np.hypot(point[..., 0], point[..., 1]))
            away = (point.reshape(-1, 3) * flank.hand - seen.position) * seen.normal
            worst = float(np.abs(away.sum(axis=-1)).max())
            off[patch.strip.name] = max(worst, off.get(patch.strip.name, 0.0))
    assert set(off) == {f"{side} {name}" for name in ("fillet", "toprem", "flank")}
    assert off[f"{side} flank"] < 0.001 * UM
    assert max(off.values()) < 0.01 * UM


def test_all_spans_have_the_same_faces_and_share_their_corners() -> None:
    names = [[patch.strip.name for patch in span.patches] for span in splines()]
    assert all(own == names[0] for own in names)
    for first, second in zip(splines()[:-1], splines()[1:], strict=True):
        for one, other in zip(first.patches, second.patches, strict=True):
            ends = [
                p.strip.at(np.array([u]), np.array([0.0, 1.0]))[0]
                for p, u in ((one, 1.0), (other, 0.0))
            ]
            assert np.abs(ends[0] - ends[1]).max() < 0.01 * UM
