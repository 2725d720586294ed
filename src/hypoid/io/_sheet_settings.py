"""Which dials each machine has, what each method needs of them, and what is wrong with a flank's."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hypoid.geometry import Problem

from ._document import MEMBERS, Document, did_you_mean, left_out, line, shown, table_at
from ._keys import keys_of
from ._merged import SIDES, Merged, merged
from ._sheet_dials import ROLL_TERMS, SheetSettings
from ._sheet_file import MachineTable


@dataclass(frozen=True)
class Dials:
    """Keys of one machine: those it cannot do without, and the rest."""

    needed: tuple[str, ...]
    # What the program puts in where the file says nothing, as the file would write it.
    defaults: dict[str, str]
    more: tuple[str, ...] = ()  # without a value there is no such motion

    @property
    def all(self) -> tuple[str, ...]:
        return (*self.needed, *self.defaults, *self.more)


_SLIDES = {"machine_center_to_back": "0 mm", "sliding_base": "0 mm", "blank_offset": "0 mm"}
_TILT_HEAD = Dials(
    (
        "eccentric_angle", "cradle_angle", "swivel_angle", "cutter_spindle_rotation_angle",
        "machine_root_angle",
    ),
    _SLIDES,
    ("ratio_gears", "helical_gears", "helical_direction"),
)  # fmt: skip
DIALS: dict[str, Dials] = {
    "basic": Dials(
        ("radial_distance", "cradle_angle", "machine_root_angle"),
        {"tilt_angle": "0 deg", "swivel_angle": "0 deg", **_SLIDES},
        (
            "ratio_of_roll", "helical_motion", "modified_roll", *ROLL_TERMS, "cutter_lead",
            "motions",
        ),
    ),
    "gleason-106": _TILT_HEAD,
    "gleason-122": _TILT_HEAD,
    "gleason-463": Dials(
        (
            "eccentric_angle", "cradle_angle", "machine_root_angle", "cam_number", "cam_setting",
            "cam_guide_angle", "index_gears", "index_interval",
        ),
        _SLIDES,
    ),
}  # fmt: skip

_TILTING = ("basic", "gleason-106", "gleason-122")
MACHINES_FOR: dict[str, tuple[str, ...]] = {
    "generated": tuple(DIALS),
    "formate": _TILTING,
    "helixform": ("basic",),
    "modified-roll": ("basic", "gleason-463"),
    "tilt": _TILTING,
    "duplex": tuple(DIALS),
    "helical-duplex": _TILTING,
}
FORM_CUT = ("formate", "helixform")
DUPLEX = ("duplex", "helical-duplex")
_ROLLING = (
    "ratio_of_roll", "modified_roll", *ROLL_TERMS, "helical_motion", "motions", "ratio_gears",
    "helical_gears", "helical_direction",
)  # fmt: skip


def settings_of(document: Document, member: str, side: str) -> Merged:
    """The settings of a flank, its own and its member's."""
    return merged(document, member, side, "settings", SheetSettings)


def settings_rules(document: Document, own: Merged) -> Iterator[Problem]:
    """Everything that is wrong with the settings of one flank."""
    method, machine = own.word("method"), own.word("machine") or "basic"
    if not method:
        yield own.wanted("method", "how this flank is cut: one of " + ", ".join(MACHINES_FOR))
    if machine not in DIALS:
        return  # named already, key by key
    if method in MACHINES_FOR and machine not in MACHINES_FOR[method]:
        can = ", ".join(MACHINES_FOR[method])
        expected = f'a machine that can do method = "{method}": {can}'
        example = f'machine = "{MACHINES_FOR[method][0]}"'
        yield Problem(own.path("machine"), shown(machine), expected, example)
        return  # which dials there should be is open
    yield from _dials(own, machine)
    if machine == "gleason-463":
        yield from _cam(document, own)
    if method in MACHINES_FOR:
        yield from _roll(own, method, machine)
        yield from _method(own, method, machine)


def range_rules(document: Document) -> Iterator[Problem]:
    """Dials out of their machine's range, as far as they can be read.

    The build tells them as well; here they are told along with other faults. The machines need JAX.
    """
    from hypoid.machine import MACHINES

    for member in MEMBERS:
        for side in SIDES:
            own = settings_of(document, member, side)
            machine = MACHINES.get(own.word("machine"))
            for name, dial in machine.table.items() if machine else ():
                if dial.kind in ("angle", "length"):
                    value = own.number(name, dial.kind)
                    if value is not None and not dial.admits(value):
                        yield own.wanted(name, dial.expected())


def _dials(own: Merged, machine: str) -> Iterator[Problem]:
    """Dials that the machine has not, and those that are missing."""
    dials = DIALS[machine].all
    known = keys_of(SheetSettings)
    for key in own.given():
        if key in known and key not in (*dials, "method", "machine"):
            near = did_you_mean(key, dials)
            expected = f'no such dial: machine = "{machine}" has {", ".join(dials)}{near}'
            given = own.get(key)
            yield Problem(own.path(key), shown(given), expected, left_out(key, given))
    for key in DIALS[machine].needed:
        if key not in own:
            expected = f'{known[key].description}, a dial of machine = "{machine}"'
            yield own.wanted(key, expected)


def _cam(document: Document, own: Merged) -> Iterator[Problem]:
    if not table_at(document, "machine.gleason-463"):
        expected = (
            "swivel_offset and the cams of this very machine: they differ from one to the next"
        )
        example = line(MachineTable, "gleason-463")
        yield Problem("machine.gleason-463", "nothing", expected, example)
    cams = table_at(document, "machine.gleason-463.cams")
    number = own.get("cam_number")
    if cams and isinstance(number, int) and shown(number) not in cams:
        expected = f"a cam that [machine.gleason-463] describes: {', '.join(cams)}"
        example = f"cam_number = {next(iter(cams))}"
        yield Problem(own.path("cam_number"), shown(number), expected, example)


def _roll(own: Merged, method: str, machine: str) -> Iterator[Problem]:
    """How the work turns with the cradle, or that it does not."""
    if method in FORM_CUT:
        for key in _ROLLING:
            if key in own and key in DIALS[machine].all:
                yield own.unwanted(key, f'the cradle stands still in method = "{method}"')
        return
    key = "ratio_of_roll" if machine == "basic" else "ratio_gears"
    if machine != "gleason-463" and key not in own:
        expected = f"{keys_of(SheetSettings)[key].description}: the cradle rolls in this method"
        yield own.wanted(key, expected)
    terms = [term for term in ROLL_TERMS if term in own]
    if machine != "basic":
        return
    if terms and "modified_roll" in own:
        expected = "either modified_roll or " + ", ".join(terms)
        yield Problem(own.path("modified_roll"), "both of them", expected, "roll_2c = 0.0101")
    if method == "modified-roll" and "modified_roll" not in own and not terms:
        expected = "modified_roll, or roll_2c and so on: the coefficients of the modified roll"
        yield own.wanted("modified_roll", expected)


def _method(own: Merged, method: str, machine: str) -> Iterator[Problem]:
    """What else a method needs."""
    basic = machine == "basic"
    if method == "helixform" and not own.number("cutter_lead", "length_per_angle"):
        expected = "a length per angle other than 0: Helixform moves the cutter along its axis"
        yield own.wanted("cutter_lead", expected)
    if method != "helixform" and "cutter_lead" in own and basic:
        yield own.unwanted("cutter_lead", 'only method = "helixform" has a cutter lead')
    if method == "tilt":
        key = "tilt_angle" if basic else "cutter_spindle_rotation_angle"
        if (basic or key in own) and not own.number(key, "angle"):
            yield own.wanted(key, "an angle other than 0: the head is tilted in this method")
    if method == "helical-duplex":
        key = "helical_motion" if basic else "helical_gears"
        slides = isinstance(own.get("motions"), dict) and "sliding_base" in own.get("motions")
        moves = own.number(key, "length_per_angle") or slides if basic else key in own
        if not moves:
            what = keys_of(SheetSettings)[key].description
            yield own.wanted(key, f"{what}, not 0: the sliding base moves in this method")
    if not basic and "helical_direction" in own and "helical_gears" not in own:
        yield own.unwanted("helical_direction", "without helical_gears there is no helical motion")
