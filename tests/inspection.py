"""Every example's pair, its measuring grids and setups, built once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from hypoid.design import Spec, build
from hypoid.inspect import MeasuringGrid, Response, Setup, measuring_grid, setups
from hypoid.io import example_files, read_spec
from hypoid.pair import GearPair

NAMES = ("gonzalez-fuentes-2022", "lin-tsay-fong-1996", "tsay-lin-1993", "vimercati-piazza-2005")
MEMBERS = ("pinion", "wheel")
EVERY = [(name, member) for name in NAMES for member in MEMBERS]


@dataclass(frozen=True, eq=False)
class Bench:
    """A member of an example on the measuring machine and on the one that cuts it."""

    spec: Spec
    pair: GearPair
    grid: MeasuringGrid
    setups: tuple[Setup, ...]

    @property
    def responses(self) -> tuple[Response, ...]:
        return tuple(Response(setup, self.grid) for setup in self.setups)


@lru_cache
def example(name: str) -> tuple[Spec, GearPair]:
    spec = read_spec(next(f for f in example_files() if f.stem == name))
    return spec, build(spec)


@lru_cache
def bench_of(name: str, member: str) -> Bench:
    """A member of an example, by names."""
    spec, pair = example(name)
    grid = measuring_grid(getattr(pair, member))
    return Bench(spec, pair, grid, setups(pair, member, spec))
