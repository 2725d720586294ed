"""What a summary sheet gives: blank, cutters and machine settings of every flank, in mm and rad."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from hypoid.blank import GivenBlank

from ._spec import Assumption, BodySpec, Hand

Method = Literal[
    "generated", "formate", "helixform", "modified-roll", "tilt", "duplex", "helical-duplex"
]
Curve = Literal["straight", "circular-arc", "parabola"]
TopremReading = Literal["along-flank", "axial", "straight-part"]


@dataclass(frozen=True)
class BladeSpec:
    """One blade of a face-mill cutter, or one side of a cup-shaped wheel."""

    point_radius: float  # where the extended edge meets the plane of the tips
    angle: float
    edge_radius: float = 0.0
    land: float | None = None  # half the point width; None: the cutter cuts one side alone
    height: float | None = None  # along the axis; None: as long as the tooth needs
    curve: Curve = "straight"
    curve_radius: float = 0.0  # circular-arc: positive crowns the tooth
    curve_coefficient: float = 0.0  # parabola, 1/mm
    reference_height: float = 0.0  # above the tips, where a curved blade has its angle
    toprem: tuple[float, float] | None = None  # angle, height
    flankrem: tuple[float, float, float] | None = None  # height, angle, coefficient


@dataclass(frozen=True)
class StickBladeSpec:
    """One stick blade of a face-hob head."""

    radius: float  # of the pitch point about the cutter's axis
    angle: float  # ground in the tool plane
    edge_radius: float = 0.0
    height: float | None = None  # along the axis, from tip to shank; None: as the tooth needs
    reference_height: float = 0.0  # of the pitch point above the tip
    curve_radius: float = 0.0  # positive crowns the tooth; 0: a straight edge
    eccentric_angle: float = 0.0
    hook_angle: float = 0.0
    side_rake_angle: float = 0.0
    toprem: tuple[float, float, TopremReading] | None = None  # angle, length, how it counts


@dataclass(frozen=True)
class FlankSpec:
    """How one flank is cut."""

    method: Method
    machine: str  # "basic", or a physical machine by name
    dials: Mapping[str, Any]  # that machine's dials by name: numbers, tooth counts, motions
    blade: BladeSpec | StickBladeSpec
    # Keys that the file gives at the flank, as "blade.angle"; all others stand at its member.
    at_flank: frozenset[str] = frozenset()


@dataclass(frozen=True)
class MemberSpec:
    """One member of a summary-sheet design."""

    teeth: int
    hand: Hand
    blank: GivenBlank
    concave: FlankSpec
    convex: FlankSpec
    blade_groups: int | None = None  # of a face-hob head; None: face milled
    spacing: float | None = None  # turn from an outer to its inner blade, rad; None: even


def cut_apart(member: MemberSpec) -> bool:
    """Whether each flank has its own cutter or settings, so that no cut makes the whole slot."""
    sides = member.concave, member.convex
    alone = any(isinstance(f.blade, BladeSpec) and f.blade.land is None for f in sides)
    return alone or dict(sides[0].dials) != dict(sides[1].dials)


@dataclass(frozen=True)
class SummarySheetSpec:
    """A pair whose blanks, cutters and settings are all given."""

    title: str
    source: str
    assumed: tuple[Assumption, ...]
    shaft_angle: float
    offset: float
    pinion: MemberSpec
    wheel: MemberSpec
    marking_thickness: float  # mm, of the virtual marking compound
    normal_backlash: float | None = None  # mm at the mean point, where flanks are cut one by one
    # By machine: what each machine of its kind has its own of, as the file gives it.
    machine_constants: Mapping[str, Mapping[str, Any]] = field(
        default_factory=dict[str, Mapping[str, Any]]
    )
    bodies: Mapping[str, BodySpec] = field(default_factory=dict[str, BodySpec])  # by member
