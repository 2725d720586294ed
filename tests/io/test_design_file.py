"""Design files: the examples as numbers, and every fault of a bad file at once."""

import tomllib
from math import radians
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import tomlkit

from hypoid.geometry import DesignError, Problem
from hypoid.io import example_files, json_schema, parse_spec, read_spec

EXAMPLE = next(f for f in example_files() if f.name == "gonzalez-fuentes-2022.toml")


def edited(**values: Any) -> str:
    """The example's text with keys set, `pair__offset="5 mm"`; a value of None removes the key."""
    document: Any = tomlkit.parse(EXAMPLE.read_text(encoding="utf-8"))
    for path, value in values.items():
        *tables, key = path.split("__")
        table = document
        for name in tables:
            table = table.setdefault(name, tomlkit.table())
        if value is None:
            del table[key]
        else:
            table[key] = value
    return tomlkit.dumps(document)


def problems(**values: Any) -> dict[str, Problem]:
    with pytest.raises(DesignError) as caught:
        parse_spec(edited(**values))
    return {problem.path: problem for problem in caught.value.problems}


def test_example_is_table_1_of_the_2022_paper() -> None:
    spec = read_spec(EXAMPLE)
    assert (spec.pinion_teeth, spec.wheel_teeth, spec.blade_groups) == (6, 73, 5)
    assert (spec.offset, spec.wheel_mean_radius, spec.wheel_face_width) == (55.0, 130.0, 35.0)
    assert spec.cutter_radius == 100.0
    assert spec.shaft_angle == pytest.approx(radians(90))
    assert spec.pinion_spiral_angle == pytest.approx(radians(65))
    assert (spec.mean_addendum_factor, spec.depth_factor, spec.clearance_factor) == (
        0.5,
        1.75,
        0.125,
    )
    assert spec.marking_thickness == 0.0065
    assert spec.tip_relief is None
    assert spec.assumed == ()


def test_relief_example_tells_apart_what_it_assumes() -> None:
    spec = read_spec(EXAMPLE.with_name("gonzalez-fuentes-2022-relief.toml"))
    assert spec.tip_relief is not None
    assert (spec.tip_relief.coefficient, spec.tip_relief.height) == (0.004, 1.5)
    assert (spec.tip_relief.measured_from, spec.tip_relief.flanks) == ("tip", "both")
    assert [a.value for a in spec.assumed] == [
        "cutting.tip_relief.from",
        "cutting.tip_relief.flanks",
    ]


def test_defaults_are_told_as_assumptions() -> None:
    spec = parse_spec(edited(blank__depth_factor=None, contact__marking_thickness=None))
    assert spec.marking_thickness == pytest.approx(6.35e-3)
    assert [a.value for a in spec.assumed] == ["blank.depth_factor", "contact.marking_thickness"]


def test_diameter_may_stand_for_the_radius() -> None:
    text = edited(wheel__mean_pitch_radius=None, wheel__mean_pitch_diameter="260 mm")
    assert parse_spec(text).wheel_mean_radius == 130.0


def test_settings_of_a_flank_go_before_those_of_its_member() -> None:
    spec = parse_spec(
        edited(
            pinion__settings__tilt_angle="1 deg",
            pinion__settings__helical_motion="0.1 mm/rad",
            pinion__convex__settings__tilt_angle="2 deg",
            wheel__concave__settings__modified_roll=[0.0, 0.01],
        )
    )
    assert spec.setting_changes == {
        "pinion.concave": {"tilt_angle": radians(1), "helical_motion": 0.1},
        "pinion.convex": {"tilt_angle": radians(2), "helical_motion": 0.1},
        "wheel.concave": {"modified_roll": (0.0, 0.01)},
    }


@pytest.mark.parametrize(
    ("key", "value", "given_text", "expected"),
    [
        ("pair__offset", 55, "55", "a length with its unit"),
        ("pair__offset", "-1 mm", '"-1 mm"', "0 or more"),
        ("pair__offset", "130 mm", '"130 mm"', "beyond the wheel"),
        ("pair__shaft_angle", "29 deg", '"29 deg"', "30 to 150 deg"),
        ("pair__shaft_angle", "90 mm", '"90 mm"', "an angle with its unit"),
        ("pinion__mean_spiral_angle", "95 deg", '"95 deg"', "below 80 deg"),
        ("pinion__mean_spiral_angle", "80 deg", '"80 deg"', "below 80 deg"),
        ("pinion__hand", "Left", '"Left"', '"left" or "right"'),
        ("pinion__teeth", 0, "0", "from 1"),
        ("pinion__teeth", 6.0, "6.0", "a whole number"),
        ("pinion__teeth", True, "true", "a whole number"),
        ("pinion__teeth", "6", '"6"', "a whole number"),
        ("wheel__teeth", 6, "6", "more teeth than the pinion"),
        ("wheel__teeth", 10**30, str(10**30), "to 1000"),
        ("wheel__face_width", "0 mm", '"0 mm"', "above 0"),
        ("wheel__face_width", "260 mm", '"260 mm"', "less than 260 mm"),
        ("wheel__mean_pitch_radius", None, "nothing", "either"),
        ("wheel__mean_pitch_diameter", "260 mm", "both of them", "either"),
        ("blank__depth_factor", float("nan"), "nan", "a plain number"),
        ("blank__clearance_factor", float("inf"), "inf", "a plain number"),
        ("blank__depth_factor", "1.75", '"1.75"', "a plain number"),
        ("cutting__cutter_radius", "1e400 mm", '"1e400 mm"', "finite"),
        ("cutting__method", "formate", '"formate"', "exact-face-hobbed"),
        ("cutting__blade_groups", None, "nothing", "a whole number"),
        ("cutting__tip_relief", "yes", '"yes"', "a table"),
        ("pinion__concave__settings__modified_roll", [0.1, "x"], '[0.1, "x"]', "plain numbers"),
        ("schema", 2, "2", "the version of this format"),
        ("pair", 3, "3", "a table"),
        ("assumed", [{"value": 3, "reason": "r"}], "3", "the path of a key"),
    ],
)
def test_every_key_names_what_it_wants(
    key: str, value: Any, given_text: str, expected: str
) -> None:
    path = key.replace("__", ".")
    found = problems(**{key: value})
    (problem,) = (p for where, p in found.items() if where.startswith(path.rsplit("_", 1)[0]))
    assert problem.given == given_text
    assert expected in problem.expected
    assert problem.example


def test_unknown_keys_are_named_with_their_nearest() -> None:
    found = problems(pair__ofset="5 mm", wheels={}, wheel__colour="red")
    assert "did you mean offset?" in found["pair.ofset"].expected
    assert found["pair.ofset"].example == 'offset = "55 mm"'
    assert "did you mean wheel?" in found["wheels"].expected
    assert "one of settings" in found["wheel.colour"].expected


def test_all_faults_at_once_also_between_keys() -> None:
    found = problems(
        pair__shaft_angle=90,
        pair__offset="500 mm",
        pinion__mean_spiral_angle="95 deg",
        wheel__teeth=3,
        wheel__hand="right",
        cutting__pressure_angle="20",
    )
    assert found.keys() == {
        "pair.shaft_angle",
        "pair.offset",
        "pinion.mean_spiral_angle",
        "wheel.teeth",
        "wheel.hand",
        "cutting.pressure_angle",
    }


def test_examples_in_messages_are_lines_of_toml() -> None:
    for problem in problems(pair=None, pinion__teeth="x", cutting__tip_relief=1).values():
        assert tomllib.loads(problem.example)


@pytest.mark.parametrize(
    ("content", "given_text"),
    [
        (b"teeth = ", "not TOML"),
        (b"x = " + b"[" * 20000, "not TOML"),
        (b"x = " + b"9" * 5000, "not TOML"),
        (b"\xff\xfe\x00", "not UTF-8"),
    ],
)
def test_file_that_is_no_toml(tmp_path: Path, content: bytes, given_text: str) -> None:
    path = tmp_path / "design.toml"
    path.write_bytes(content)
    with pytest.raises(DesignError) as caught:
        read_spec(path)
    (problem,) = caught.value.problems
    assert given_text in problem.given
    assert problem.path == str(path)


def test_toml_faults_come_with_line_and_column(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"line 2, column"):
        parse_spec("a = 1\nb = ?\n")


@pytest.mark.parametrize(
    ("name", "given_text"), [("", "a folder"), ("no.toml", "no file"), ("\0", "cannot")]
)
def test_path_that_is_no_file(tmp_path: Path, name: str, given_text: str) -> None:
    with pytest.raises(DesignError, match=given_text):
        read_spec(f"{tmp_path}/{name}")


def test_byte_order_mark_and_windows_lines_are_read(tmp_path: Path) -> None:
    path = tmp_path / "design.toml"
    path.write_bytes(b"\xef\xbb\xbf" + EXAMPLE.read_bytes().replace(b"\n", b"\r\n"))
    assert read_spec(path) == read_spec(EXAMPLE)


def test_json_schema_accepts_every_example_and_refuses_a_slip() -> None:
    schema = json_schema()
    for file in example_files():
        document = tomllib.loads(file.read_text(encoding="utf-8"))
        jsonschema.validate(document, schema)
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(document | {"pinnion": {}}, schema)
    assert schema["$defs"]["Pair"]["properties"]["offset"]["type"] == "string"


STIFF = [
    [float(2e5 if i == j and i < 3 else 1e9 if i == j and i < 5 else 0.0) for j in range(6)]
    for i in range(6)
]


def test_a_member_held_on_bearings() -> None:
    spec = parse_spec(
        edited(
            pinion__support__held="back",
            pinion__support__stiffness=STIFF,
            wheel__body__tip_rounding="0.2 mm",
        )
    )
    pinion, wheel = spec.bodies["pinion"], spec.bodies["wheel"]
    assert pinion.held == "back"
    assert pinion.stiffness == tuple(tuple(row) for row in STIFF)
    assert (wheel.held, wheel.stiffness, wheel.tip_rounding) == (None, None, 0.2)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda k: k[:5], "6 rows of 6"),
        (lambda k: [[*k[0][:4], 1e6, 0.0], *k[1:]], "not symmetric"),
        (lambda k: [[0.0] * 6, *k[1:]], "nothing holds"),
        (lambda k: "stiff", "6 rows of 6"),
    ],
)
def test_what_is_no_stiffness_is_told_with_the_reason(change: Any, words: str) -> None:
    found = problems(wheel__support__stiffness=change(STIFF), pinion__support__held="rim")
    problem = found["wheel.support.stiffness"]
    assert words in problem.expected
    assert "N mm/rad" in problem.expected
    assert parse_spec(edited(wheel__support=tomlkit.parse(problem.example)))  # it works
    assert found["pinion.support.held"].given == '"rim"'
