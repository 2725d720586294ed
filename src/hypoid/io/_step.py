"""STEP files of a tooth, a few teeth or a whole gear: solids of exact surfaces, read back and measured."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from hypoid.geometry import DesignError, Problem
from hypoid.pair import Member
from hypoid.solid import (
    body,
    gear_brep,
    probes,
    ring_problems,
    tooth_problems,
    tooth_splines,
)

from . import _occ
from ._write import write_bytes

CLOSE = 1e-4  # mm: what flanks and fillets may lie off the exact surface


@dataclass(frozen=True)
class StepReport:
    """What a STEP file holds, by the CAD kernel's own reading of it; mm."""

    path: Path
    teeth: int
    faces: int
    valid: bool  # geometry and topology, by the kernel's check
    closed: bool  # one solid, one shell without a free edge
    volume: float  # mm³
    centre: tuple[float, float, float]  # of mass
    inertia: tuple[tuple[float, float, float], ...]  # about the centre, mm⁵
    deviation: Mapping[str, float]  # greatest distance of exact points from each kind of face
    tolerance: float  # greatest of edges and vertices
    size: int  # bytes

    @property
    def faults(self) -> tuple[str, ...]:
        """What is wrong with the solid; nothing, if all is well."""
        said = [] if self.valid else ["The CAD kernel finds the solid invalid."]
        said += [] if self.closed else ["The solid is not closed."]
        said += [] if self.volume > 0.0 else ["The solid is inside out."]
        said += [
            f"The {name} lies {1e3 * off:.2f} um off the exact surface, more than {1e3 * CLOSE:g} um."
            for name, off in self.deviation.items()
            if not off <= CLOSE
        ]
        return tuple(said)

    def as_dict(self) -> dict[str, Any]:
        """The same, as JSON prints it."""
        return {
            "path": str(self.path),
            "teeth": self.teeth,
            "faces": self.faces,
            "valid": self.valid,
            "closed": self.closed,
            "volume_mm3": self.volume,
            "centre_of_mass_mm": list(self.centre),
            "inertia_mm5": [list(row) for row in self.inertia],
            "deviation_um": {name: 1e3 * off for name, off in self.deviation.items()},
            "tolerance_mm": self.tolerance,
            "size_bytes": self.size,
        }


def write_step(
    member: Member,
    path: str | Path,
    *,
    teeth: int | None = 1,
    bore: float | None = None,
    back: float | None = None,
) -> StepReport:
    """Write some teeth of a member (None: all) on its body as a STEP solid (AP242, mm), and measure the file.

    A part of a gear ends at the middles of slots. ``bore`` is a radius, ``back`` the back face's z, mm;
    without them the body has a rim of its own choice. The file stands in the member's frame (design, section 3).
    """
    _occ.need_kernel()
    target, count = Path(path), member.teeth if teeth is None else teeth
    if problems := list(_problems(member, target, count, bore, back)):
        raise DesignError(problems)
    ring = body(member, bore, back)
    splines = tooth_splines(member.tooth)
    if not all(np.isfinite(patch.poles).all() for span in splines for patch in span.patches):
        given = f"a {member.name} with a gap between two pieces of a flank"
        expected = "a tooth that its edges cut from root to tip"
        raise DesignError([Problem("STEP", given, expected, "what `hypoid check` advises")])
    brep = gear_brep(member, splines, ring, count)
    name = f"{member.name}, {count} of {member.teeth} teeth"
    with TemporaryDirectory() as folder:
        made = Path(folder) / "solid.step"
        _occ.write(made, brep, name)
        read = _occ.StepFile(made)
        deviation: dict[str, float] = {}
        for probe in probes(member.tooth, tuple(span.span for span in splines)):
            off = float(read.distances(probe.points).max())
            deviation[probe.name] = max(off, deviation.get(probe.name, 0.0))
        content = made.read_bytes()
    return StepReport(
        path=write_bytes(target, content, "gear.step"),
        teeth=count,
        faces=len(read.faces),
        valid=read.valid,
        closed=read.closed,
        volume=read.volume,
        centre=read.centre,
        inertia=tuple(tuple(row) for row in read.inertia.tolist()),
        deviation=deviation,
        tolerance=read.tolerance,
        size=len(content),
    )


def _problems(
    member: Member, target: Path, teeth: int, bore: float | None, back: float | None
) -> Iterator[Problem]:
    """What keeps a solid from being made, or written, as far as that shows beforehand."""
    if not target.parent.is_dir():
        given = "a place in a folder that does not exist"
        yield Problem(str(target), given, "a file in a folder that exists", "gear.step")
    if wrong := ring_problems(member, teeth, bore, back):
        yield from wrong
        return
    ring = body(member, bore, back)
    yield from tooth_problems(member.tooth.grid(33, 17), member.tooth.pitch, ring, member.name)
    if teeth < member.teeth and not ring.heel_base[0] > ring.toe_base[0]:
        given = f"{teeth} teeth of a {member.name} whose root cone opens towards its back"
        expected = f"all {member.teeth} teeth: between two slots such a body has no sides"
        yield Problem("teeth", given, expected, "all")
