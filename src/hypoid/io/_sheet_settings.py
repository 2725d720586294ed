"""Which dials each machine has, what each method needs of them, and what is wrong with a flank's."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hypoid.geometry import Problem

from ._document import Document, did_you_mean, line, shown, table_at
from ._keys import keys_of
from ._merged import Merged
from ._sheet_file import ROLL_TERMS, SheetSettings


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


def settings_rules(document: Document, own: Merged) -> Iterator[Problem]:
    """Everything that is wrong with the settings of one flank."""
    method, machine = own.get("method"), own.get("machine")
    machine = "basic" if machine is None else machine
    if method is None:
        yield _fault(own, "method", "how this flank is cut: one of " + ", ".join(MACHINES_FOR))
    if machine not in DIALS or (method is not None and method not in MACHINES_FOR):
        return  # named already, key by key
    yield from _dials(own, machine)
    if machine == "gleason-463":
        yield from _cam(document, own)
    if method is None:
        return
    if machine not in MACHINES_FOR[method]:
        can = ", ".join(MACHINES_FOR[method])
        expected = f'a machine that can do method = "{method}": {can}'
        example = f'machine = "{MACHINES_FOR[method][0]}"'
        yield Problem(own.path("machine"), shown(machine), expected, example)
        return
    yield from _roll(own, method, machine)
    yield from _method(own, method, machine)


def _fault(own: Merged, key: str, expected: str) -> Problem:
    return Problem(own.path(key), shown(own.get(key)), expected, line(SheetSettings, key))


def _dials(own: Merged, machine: str) -> Iterator[Problem]:
    """Dials that the machine has not, and those that are missing."""
    dials = DIALS[machine].all
    known = keys_of(SheetSettings)
    for key in own.given():
        if key in known and key not in (*dials, "method", "machine"):
            expected = f'no such dial: machine = "{machine}" has {", ".join(dials)}'
            expected += did_you_mean(key, dials)
            example = line(SheetSettings, DIALS[machine].needed[0])
            yield Problem(own.path(key), shown(own.get(key)), expected, example)
    for key in DIALS[machine].needed:
        if key not in own:
            expected = f'{known[key].description}, a dial of machine = "{machine}"'
            yield _fault(own, key, expected)


def _cam(document: Document, own: Merged) -> Iterator[Problem]:
    cams = table_at(document, "machine.gleason-463.cams")
    number = own.get("cam_number")
    if cams and isinstance(number, int) and str(number) not in cams:
        expected = f"a cam that [machine.gleason-463] describes: {', '.join(cams)}"
        example = f"cam_number = {next(iter(cams))}"
        yield Problem(own.path("cam_number"), str(number), expected, example)


def _roll(own: Merged, method: str, machine: str) -> Iterator[Problem]:
    """How the work turns with the cradle, or that it does not."""
    if method in FORM_CUT:
        for key in _ROLLING:
            if key in own and key in DIALS[machine].all:
                yield _fault(own, key, f'nothing: the cradle stands still in method = "{method}"')
        return
    key = "ratio_of_roll" if machine == "basic" else "ratio_gears"
    if machine != "gleason-463" and key not in own:
        expected = f"{keys_of(SheetSettings)[key].description}: the cradle rolls in this method"
        yield _fault(own, key, expected)
    terms = [term for term in ROLL_TERMS if term in own]
    if terms and "modified_roll" in own and machine == "basic":
        expected = "either modified_roll or " + ", ".join(terms)
        yield Problem(own.path("modified_roll"), "both of them", expected, "roll_2c = 0.0101")
    if (
        method == "modified-roll"
        and machine == "basic"
        and "modified_roll" not in own
        and not terms
    ):
        expected = "modified_roll, or roll_2c and so on: the coefficients of the modified roll"
        yield _fault(own, "modified_roll", expected)


def _method(own: Merged, method: str, machine: str) -> Iterator[Problem]:
    """What else a method needs."""
    basic = machine == "basic"
    if method == "helixform" and not own.number("cutter_lead", "length_per_angle"):
        expected = "a length per angle other than 0: Helixform moves the cutter along its axis"
        yield _fault(own, "cutter_lead", expected)
    if method != "helixform" and "cutter_lead" in own and basic:
        yield _fault(own, "cutter_lead", 'nothing: only method = "helixform" has a cutter lead')
    if method == "tilt":
        key = "tilt_angle" if basic else "cutter_spindle_rotation_angle"
        if (basic or key in own) and not own.number(key, "angle"):
            yield _fault(own, key, "an angle other than 0: the head is tilted in this method")
    if method == "helical-duplex":
        motions = own.get("motions")
        slides = isinstance(motions, dict) and "sliding_base" in motions
        moves = own.number("helical_motion", "length_per_angle") or slides
        key = "helical_motion" if basic else "helical_gears"
        if not (moves if basic else key in own):
            what = keys_of(SheetSettings)[key].description
            yield _fault(own, key, f"{what}, not 0: the sliding base moves in this method")
