"""Exact points of a tooth's flanks and fillets that no spline was made from, to hold a solid against."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.flank import Side, Tooth

from ._strips import Span

Array = np.ndarray[Any, Any]
INSET = 0.02  # share of a face that is left out at its borders


@dataclass(frozen=True)
class Probe:
    """Points (n, 3) mm of one kind of face, the member's own hand, by ``Flank.at`` alone."""

    name: str  # "concave fillet", "convex flank"
    points: Array


def probes(tooth: Tooth, spans: tuple[Span, ...], count: int = 15) -> tuple[Probe, ...]:
    """So many by so many points a face, even along it and across; those of a left-hand member's tooth at angle zero."""
    inner = np.linspace(INSET, 1.0 - INSET, count)
    turns: dict[Side, float] = {"concave": 0.0, "convex": tooth.convex_turn}
    found: list[Probe] = []
    for span in spans:
        distance = span.start + (span.end - span.start) * inner
        for strip in span.strips:
            side: Side | None = next((s for s in turns if strip.name.startswith(s)), None)
            if side is None:
                continue
            flank = tooth.flank(side)
            point = strip.at(inner, inner)[0]
            height = flank.cone.cone_distance_height(
                point[..., 2], np.hypot(point[..., 0], point[..., 1])
            )[1]
            seen = flank.at_cone(np.broadcast_to(distance[:, None], height.shape), height)
            angle = turns[side] * (-1.0 if flank.mirrored else 1.0)
            cosine, sine = np.cos(angle), np.sin(angle)
            turn = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
            found.append(Probe(strip.name, (seen.position @ turn)[np.isfinite(seen.s)]))
    return tuple(found)
