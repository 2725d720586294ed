"""What a design file becomes: two members with their flanks, and how they are mounted. Frozen."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal, TypeAlias

from hypoid.blank import MemberBlank, PairBlank
from hypoid.cutter import CycloPalloidHead, FaceHobHead, FaceMillHead, TriAcHead
from hypoid.flank import Flank, Side, Tooth
from hypoid.machine import SummarySheet, to_sheet

Head: TypeAlias = FaceHobHead | FaceMillHead | TriAcHead | CycloPalloidHead
Direction = Literal["drive", "coast"]


@dataclass(frozen=True, eq=False)
class Member:
    """A gear: its blank, the heads that cut it and its two active flanks."""

    blank: MemberBlank
    heads: Mapping[Side, Head]  # one and the same where one head cuts both flanks
    concave: Flank
    convex: Flank
    # Turn that puts the convex flank into its slot, rad (left hand): zero where one setting cuts both.
    stock_turn: float = 0.0
    bore: float | None = None  # radius, mm, where the design gives it
    mounting_distance: float | None = None  # mm, crossing point to back face
    tip_rounding: float = 0.0  # mm, radius between flank and top land
    held: Literal["bore", "back"] | None = None  # face that does not move on its shaft
    # (6, 6) N/mm, N, N mm/rad of shaft and bearings, see `hypoid.design.bearing_compliance`; None: rigid
    bearing_stiffness: tuple[tuple[float, ...], ...] | None = None

    @cached_property
    def tooth(self) -> Tooth:
        """The tooth between two slots, as it is cut."""
        return Tooth(self.concave, self.convex, self.teeth, self.stock_turn)

    @property
    def head(self) -> Head:
        """The head that cuts the concave flank, and in most methods the convex one, too."""
        return self.heads["concave"]

    @property
    def name(self) -> str:
        return self.blank.name

    @property
    def teeth(self) -> int:
        return self.blank.teeth

    def flank(self, side: Side) -> Flank:
        return self.concave if side == "concave" else self.convex

    def sheet(self, side: Side) -> SummarySheet:
        """Settings of one flank as on a summary sheet (signs of the 2022 paper)."""
        return to_sheet(self.flank(side).settings, self.blank.pitch_apex_beyond_crossing_point)


@dataclass(frozen=True)
class Assumption:
    """A value that the source does not give, and why it was chosen."""

    value: str
    reason: str


@dataclass(frozen=True, eq=False)
class GearPair:
    """A spiral bevel or hypoid pair."""

    title: str
    source: str
    assumed: tuple[Assumption, ...]
    blank: PairBlank
    pinion: Member
    wheel: Member
    marking_thickness: float  # mm, of the virtual marking compound
    # By machine: what the user's own has of its own, as the design file gives it (mm).
    machine_constants: Mapping[str, Mapping[str, Any]] = field(
        default_factory=dict[str, Mapping[str, Any]]
    )

    @property
    def ratio(self) -> float:
        """z1/z2: the wheel's turn per pinion turn."""
        return self.pinion.teeth / self.wheel.teeth

    def mates(self, direction: Direction) -> tuple[Flank, Flank]:
        """Pinion and wheel flank that touch: drive = pinion concave with wheel convex."""
        if direction == "drive":
            return self.pinion.concave, self.wheel.convex
        return self.pinion.convex, self.wheel.concave

    @property
    def faults(self) -> tuple[str, ...]:
        """What is wrong with the pair before its flanks meet: its blank, and undercut."""
        undercut = (_undercut(flank) for flank in self.flanks() if not flank.generated)
        return (*(fault.value for fault in self.blank.faults), *undercut)

    def flanks(self) -> Iterator[Flank]:
        for member in (self.pinion, self.wheel):
            yield member.concave
            yield member.convex


def _undercut(flank: Flank) -> str:
    if flank.cut_away == ("toprem",):
        return (
            f"The {flank.name} flank is undercut: somewhere between toe and heel its Toprem is cut away "
            "and the fillet meets the flank; see the tooth's sections, or use a shorter Toprem, "
            "a smaller dedendum or a greater pressure angle."
        )
    return (
        f"The {flank.name} flank is undercut or cannot be generated between toe and heel; "
        "raise the pressure angle, lower the dedendum or use more teeth."
    )
