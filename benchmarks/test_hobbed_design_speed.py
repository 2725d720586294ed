"""Speed of designs on Tri-Ac heads; run with `make bench`. Target: a complete pair under 5 s, warm."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from hypoid.design import HobbedRequest, build, design_hobbed
from hypoid.io import read_spec
from hypoid.pair import GearPair

BLANK = Path(__file__).parents[1] / "examples" / "blanks" / "vimercati-piazza-2005.toml"


def complete(request: HobbedRequest) -> GearPair:
    """Blank, wheel, both pinion flanks, and the pair that the written sheet makes."""
    return build(design_hobbed(request).spec)


@pytest.mark.parametrize("wheel", ["formate", "generated"])
def test_complete_face_hobbed_pair_from_its_blank(benchmark: Any, wheel: Any) -> None:
    request = read_spec(BLANK)
    assert isinstance(request, HobbedRequest)
    request = replace(request, wheel_method=wheel)
    complete(request)
    pair = benchmark.pedantic(complete, (request,), rounds=5)
    assert pair.pinion.concave.settings == pair.pinion.convex.settings
    assert benchmark.stats.stats.min < 5.0
