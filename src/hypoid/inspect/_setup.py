"""A setting-up of the machine: the flanks it cuts, its dials and blades, and what each step of them cuts.

Where one setting-up cuts both flanks (duplex, face hobbing), its dials move both.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, Literal

import numpy as np

from hypoid.cutter import EdgePiece, FaceHobHead, FaceMillHead, TriAcHead
from hypoid.design import Spec, SummarySheetSpec, machine_named
from hypoid.flank import SIDES, Flank, Side, recut
from hypoid.geometry import DesignError, Problem
from hypoid.machine import (
    MachineSettings,
    Motions,
    SummarySheet,
    Workpiece,
    constants_of,
    from_sheet,
    to_sheet,
)
from hypoid.pair import GearPair, Member

Kind = Literal["length", "angle", "ratio", "coefficient"]
MINUTE, HUNDREDTH = math.radians(1.0 / 60.0), 0.01
ROLLS = {"ratio_of_roll": "ratio_gears", "helical_motion": "helical_gears"}
# What can be ground or set of a head's blades, and what the head calls it.
BLADE_FIELDS: Mapping[type, Mapping[str, str]] = {
    FaceMillHead: {"blade_angle": "angle", "point_radius": "point_radius"},
    FaceHobHead: {"blade_angle": "pressure_angle"},
    TriAcHead: {"blade_angle": "blade_angle", "blade_radius": "radius"},
}
FREE_BY_DEFAULT = (
    "radial_distance", "eccentric_angle", "cradle_angle", "machine_root_angle", "sliding_base",
    "machine_center_to_back", "blank_offset", "ratio_of_roll", "cam_guide_angle",
)  # fmt: skip


@dataclass(frozen=True)
class Adjustment:
    """One thing that a shop can set: reading now, bounds and increment; mm, rad or a plain number.

    ``reach`` is a change that a correction may plausibly want: it scales what is compared with the noise.
    """

    name: str
    kind: Kind
    value: float
    low: float
    high: float
    increment: float  # 0: none
    reach: float


@dataclass(frozen=True, eq=False)
class Setup:
    """One setting-up of one machine for one or both flanks of a member."""

    member: Member
    sides: tuple[Side, ...]
    machine: str  # "basic" or a physical machine
    dials: Any  # a SummarySheet, or that machine's dials
    work: Workpiece
    adjustments: Mapping[str, Adjustment]

    @property
    def name(self) -> str:
        return f"{self.member.name} {' and '.join(self.sides)}"

    @property
    def defaults(self) -> tuple[str, ...]:
        """What is free where nothing is said: dials that move, no blades, no added motions."""
        return tuple(n for n in self.adjustments if n in FREE_BY_DEFAULT)

    def settings(self, steps: Mapping[str, float]) -> MachineSettings:
        """Basic settings with the dials moved by steps (mm, rad), not rounded."""
        own = {n: s for n, s in steps.items() if s and not n.startswith(SIDES)}
        if self.machine == "basic":
            sheet = moved_sheet(self.dials, own)
            return replace(
                from_sheet(sheet, self.member.blank.pitch_apex_beyond_crossing_point),
                generated=self.dials.generated,
            )
        dials = {n: getattr(self.dials, n) + s for n, s in own.items() if n not in ROLLS}
        settings = machine_named(self.machine).to_basic(replace(self.dials, **dials), self.work)
        rolls = {n: getattr(settings, n) + s for n, s in own.items() if n in ROLLS}
        return replace(settings, generated=self._nominal.generated, **rolls)

    @property
    def _nominal(self) -> MachineSettings:
        return self.member.flank(self.sides[0]).settings

    def pieces(self, side: Side, steps: Mapping[str, float]) -> Mapping[str, EdgePiece]:
        """Edge pieces of a flank with its blade moved by steps (mm, rad)."""
        flank = self.member.flank(side)
        own = {n.split(".")[1]: s for n, s in steps.items() if s and n.startswith(f"{side}.")}
        if not own:
            return flank.pieces
        name = "outer" if side == "concave" else "inner"
        head: Any = self.member.heads[side]
        blade = getattr(head, name)
        changes = {
            (f := BLADE_FIELDS[type(head)][n]): getattr(blade, f) + s for n, s in own.items()
        }
        new = replace(head, **{name: replace(blade, **changes)}).pieces(name)
        (x, y, _), (u, v, _) = head.pieces(name)["flank"].start, flank.pieces["flank"].start
        turn = math.atan2(v, u) - math.atan2(y, x)
        top = flank.cut_pieces[0]
        made = {n: piece.turned(turn) for n, piece in new.items()}
        return {**made, top: replace(made[top], high=flank.pieces[top].high)}

    def recut(self, side: Side, steps: Mapping[str, float]) -> Flank:
        """The flank that the moved dials and blades cut, anew by the exact generator."""
        flank = replace(self.member.flank(side), pieces=self.pieces(side, steps))
        return recut(flank, self.settings(steps))

    def dials_after(self, total: Mapping[str, float]) -> Any:
        """The machine's dials after steps (its own dataclass, or a sheet); gears are the nearest there are.

        Raises
        ------
        DesignError
            Where the machine cannot be set so.
        """
        own = {n: s for n, s in total.items() if s and not n.startswith(SIDES)}
        if self.machine == "basic":
            return moved_sheet(self.dials, own)
        moved = {n: getattr(self.dials, n) + s for n, s in own.items() if n not in ROLLS}
        dials = replace(self.dials, **moved)
        wanted = [gears for n, gears in ROLLS.items() if n in own]
        if not wanted:
            return dials
        new = machine_named(self.machine).from_basic(self.settings(total), self.work)
        return replace(dials, **{gears: getattr(new, gears) for gears in wanted})

    def on_gears(self, total: Mapping[str, float]) -> dict[str, float]:
        """Steps of rolls that the nearest change gears really make, by name; none where no roll is stepped."""
        rolls = [n for n in ROLLS if total.get(n)]
        if self.machine == "basic" or not rolls:
            return {}
        made = machine_named(self.machine).to_basic(self.dials_after(total), self.work)
        return {n: float(getattr(made, n)) - self.adjustments[n].value for n in rolls}


def recut_pair(pair: GearPair, changes: list[tuple[Setup, Mapping[str, float]]]) -> GearPair:
    """The pair with the flanks of these setups cut anew after their steps."""
    for setup, steps in changes:
        name = setup.member.name
        member: Member = getattr(pair, name)
        made: dict[str, Any] = {side: setup.recut(side, steps) for side in setup.sides}
        pair = replace(pair, **{name: replace(member, **made)})
    return pair


def setups(
    pair: GearPair, member: str, spec: Spec | None = None, machine: str | None = None
) -> tuple[Setup, ...]:
    """How a member of a pair ("pinion" or "wheel") is set up: once for both flanks, or once for each.

    With the pair's spec, on the sheet's own machine and dials; else, or on another ``machine``, by what
    that machine's dials give for the flanks' settings.

    Raises
    ------
    DesignError
        For an unknown machine, or settings that it cannot do.
    """
    of: Member = pair.pinion if member == "pinion" else pair.wheel
    one = of.concave.settings == of.convex.settings and of.heads["concave"] is of.heads["convex"]
    groups: tuple[tuple[Side, ...], ...] = (SIDES,) if one else tuple((side,) for side in SIDES)
    return tuple(_setup(pair, of, sides, spec, machine) for sides in groups)


def _setup(
    pair: GearPair, member: Member, sides: tuple[Side, ...], spec: Spec | None, machine: str | None
) -> Setup:
    own = None
    if isinstance(spec, SummarySheetSpec):
        of = spec.pinion if member.name == "pinion" else spec.wheel
        own = of.concave if sides[0] == "concave" else of.convex
    name = machine or (own.machine if own else "basic")
    constants = None if name == "basic" else constants_of(name, pair.machine_constants.get(name))
    path = f"{member.name}.{sides[0]}.settings"
    work = Workpiece(member.teeth, member.blank.hand, constants, path)
    settings = member.flank(sides[0]).settings
    if name == "basic":
        dials: Any = to_sheet(settings, member.blank.pitch_apex_beyond_crossing_point)
        found = _basic_adjustments(dials)
    else:
        on = machine_named(name)
        exact = own is not None and own.machine == name
        dials = on.dials(**own.dials) if exact and own else on.from_basic(settings, work)
        found = _machine_adjustments(on.table, dials, on.to_basic(dials, work))
    for side in sides:
        found += _blade_adjustments(member, side)
    return Setup(member, sides, name, dials, work, {a.name: a for a in found})


def _basic_adjustments(sheet: SummarySheet) -> list[Adjustment]:
    """Every number of a sheet, its roll coefficients and motions; the ratio of roll on no increment."""
    found: list[Adjustment] = []
    for name in (
        "radial_distance", "blank_offset", "machine_center_to_back", "sliding_base",
        "cradle_angle", "machine_root_angle", "tilt_angle", "swivel_angle",
    ):  # fmt: skip
        found.append(_plain(name, getattr(sheet, name), name.endswith("angle")))
    if not sheet.generated:
        return found
    inf = math.inf
    if sheet.cam is None:
        ratio = sheet.ratio_of_roll
        found.append(Adjustment("ratio_of_roll", "ratio", ratio, -inf, inf, 0.0, 1e-3 * abs(ratio)))
        found += [
            Adjustment(f"modified_roll.{n}", "coefficient", _at(sheet.modified_roll, n - 2), -inf, inf, 0.0, 0.01)
            for n in range(2, 7)
        ]  # fmt: skip
    moves = sheet.helical_motion
    found.append(Adjustment("helical_motion", "coefficient", moves, -inf, inf, 0.0, 0.5))
    for motion in fields(Motions):
        angle = motion.name.endswith("angle")
        found += [
            Adjustment(
                f"motions.{motion.name}.{n}",
                "coefficient",
                _at(getattr(sheet.motions, motion.name), n - 1),
                -inf,
                inf,
                0.0,
                0.01 if angle else 1.0,
            )
            for n in range(1, 7)
        ]
    return found


def _machine_adjustments(table: Any, dials: Any, settings: MachineSettings) -> list[Adjustment]:
    found: list[Adjustment] = []
    for name, dial in table.items():
        if dial.kind not in ("angle", "length"):
            continue
        low, high = (-math.inf, math.inf) if dial.cyclic else (dial.low, dial.high)
        reach = {"cam_guide_angle": math.radians(1.0), "cam_setting": 1.0}.get(name)
        made = _plain(name, getattr(dials, name), dial.kind == "angle", reach)
        found.append(replace(made, low=low, high=high, increment=dial.increment))
    for name, gears in ROLLS.items():
        if getattr(dials, gears, ()):
            value = float(getattr(settings, name))
            found.append(
                Adjustment(name, "ratio", value, -math.inf, math.inf, 0.0, 1e-3 * abs(value))
            )
    return found


def _blade_adjustments(member: Member, side: Side) -> list[Adjustment]:
    head: Any = member.heads[side]
    names = BLADE_FIELDS.get(type(head), {})
    blade: Any = getattr(head, "outer" if side == "concave" else "inner") if names else None
    return [
        Adjustment(f"{side}.{n}", "angle", getattr(blade, f), -math.inf, math.inf, MINUTE, math.radians(0.1))
        if n == "blade_angle"
        else Adjustment(f"{side}.{n}", "length", getattr(blade, f), 0.0, math.inf, HUNDREDTH, 0.2)
        for n, f in names.items()
    ]  # fmt: skip


def _plain(name: str, value: float, angle: bool, reach: float | None = None) -> Adjustment:
    kind: Kind = "angle" if angle else "length"
    step = MINUTE if angle else HUNDREDTH
    usual = math.radians(0.15) if angle else 0.2
    return Adjustment(name, kind, float(value), -math.inf, math.inf, step, reach or usual)


def _at(values: Any, index: int) -> float:
    return float(values[index]) if index < len(values) else 0.0


def moved_sheet(sheet: SummarySheet, steps: Mapping[str, float]) -> SummarySheet:
    plain: dict[str, Any] = {}
    roll = np.array([*sheet.modified_roll, *[0.0] * 5][:5])
    motions: dict[str, Any] = {}
    for name, step in steps.items():
        first, *more = name.split(".")
        if first == "modified_roll":
            roll[int(more[0]) - 2] += step
        elif first == "motions":
            held = motions.setdefault(more[0], [*getattr(sheet.motions, more[0]), *[0.0] * 6][:6])
            held[int(more[1]) - 1] += step
        else:
            plain[name] = getattr(sheet, name) + step
    if roll.any():
        plain["modified_roll"] = tuple(float(c) for c in roll)
    if motions:
        plain["motions"] = replace(sheet.motions, **{n: tuple(c) for n, c in motions.items()})
    return replace(sheet, **plain)


def chosen(setup: Setup, names: Any) -> tuple[str, ...]:
    """Names of what is free, checked; the defaults where none are given.

    Raises
    ------
    DesignError
        With every name that the setup does not have.
    """
    if not names:
        return setup.defaults
    known = ", ".join(n for n in setup.adjustments if not n.startswith("motions."))
    wrong = [
        Problem("--free", name, f"one of {known} (motions as motions.sliding_base.2)", "--free cradle_angle")
        for name in names
        if name not in setup.adjustments
    ]  # fmt: skip
    if wrong:
        raise DesignError(wrong)
    return tuple(dict.fromkeys(names))
