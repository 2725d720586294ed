"""A pair on a physical machine: its dials, and what setting them to their increments does to the flanks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hypoid.flank import Deviation, Flank, deviation, recut, roll_range
from hypoid.geometry import DesignError, Problem
from hypoid.machine import MACHINES, AxisTable, Machine, Workpiece, axis_table, constants_of
from hypoid.pair import GearPair, Member


@dataclass(frozen=True)
class Dialled:
    """One flank on one machine."""

    flank: Flank
    dials: Any  # exact; mm, rad and teeth
    rounded: Any  # on the dials' increments
    deviation: Deviation  # of the flank that the rounded dials cut


def machine_named(name: str) -> Machine:
    """A machine by name; DesignError if there is none."""
    if name not in MACHINES:
        known = ", ".join(["basic", *MACHINES, "six-axis"])
        raise DesignError([Problem("--machine", name, f"one of {known}", "--machine gleason-122")])
    return MACHINES[name]


def dialled(pair: GearPair, machine: str) -> tuple[Dialled, ...]:
    """The four flanks of a pair on a machine.

    Raises
    ------
    DesignError
        With everything that the settings ask for and the machine cannot do.
    """
    on, problems, done = machine_named(machine), [], []
    constants = constants_of(machine, pair.machine_constants.get(machine))
    for member in (pair.pinion, pair.wheel):
        for flank in (member.concave, member.convex):
            try:
                done.append(_dialled(on, constants, member, flank))
            except DesignError as error:
                problems += error.problems
    if problems:
        raise DesignError(problems)
    return tuple(done)


def _dialled(machine: Machine, constants: Any, member: Member, flank: Flank) -> Dialled:
    path = f"{member.name}.{flank.side}.settings"
    work = Workpiece(member.teeth, member.blank.hand, constants, path)
    dials = machine.from_basic(flank.settings, work)
    rounded = machine.rounded(dials)
    cut = recut(flank, machine.to_basic(rounded, work))
    return Dialled(flank, dials, rounded, deviation(flank, cut))


def axis_tables(pair: GearPair, positions: int) -> list[tuple[Flank, AxisTable]]:
    """Six-axis tables of the four flanks over the roll that cuts them, in so many positions.

    Raises
    ------
    DesignError
        For fewer than two positions.
    """
    if positions < 2:
        given = Problem("--positions", str(positions), "at least 2", "--positions 21")
        raise DesignError([given])
    tables: list[tuple[Flank, AxisTable]] = []
    for flank in pair.flanks():
        low, high = roll_range(flank)
        roll = np.linspace(low, high, positions)
        tables.append((flank, axis_table(flank.settings, roll)))
    return tables
