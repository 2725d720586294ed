"""Summary sheets: what their keys mean, and every fault of a bad one, each with an example that works."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from math import radians
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sheets import GRINDER, ON_122, ON_463, SHEET, Changes, parsed, problems, repaired, sheet

from hypoid.design import SummarySheetSpec
from hypoid.geometry import DesignError
from hypoid.io import example_files, parse_spec


def test_a_key_of_a_flank_goes_before_its_members() -> None:
    spec = parsed(
        {
            "pinion.settings.tilt_angle": "1 deg",
            "pinion.convex.settings": {"tilt_angle": "2 deg", "sliding_base": "0.1 mm"},
            "pinion.convex.blade.edge_radius": "0.5 mm",
        }
    )
    concave, convex = spec.pinion.concave, spec.pinion.convex
    assert [f.dials["tilt_angle"] for f in (concave, convex)] == [radians(1), radians(2)]
    assert [f.dials["sliding_base"] for f in (concave, convex)] == [0.0, 0.1]
    assert [f.blade.edge_radius for f in (concave, convex)] == [0.6, 0.5]
    assert "settings.tilt_angle" in convex.at_flank - concave.at_flank


def test_backlash_of_flanks_cut_one_by_one_is_told_as_assumed() -> None:
    """0.15 mm where nothing is given; nothing at all where each slot is cut at once."""
    apart: Changes = {"pinion.convex.settings": {"sliding_base": "0.1 mm"}}
    paths = [[a.value for a in s.assumed] for s in (parsed(), parsed(apart))]
    assert ["pair.normal_backlash" in p for p in paths] == [False, True]
    assert (parsed().normal_backlash, parsed(apart).normal_backlash) == (None, 0.15)
    given: Changes = {**apart, "pair.normal_backlash": "0.1 mm"}
    assert parsed(given).normal_backlash == pytest.approx(0.1)
    assert "pair.normal_backlash" not in [a.value for a in parsed(given).assumed]


def test_inches_and_millimetres_may_stand_in_one_file() -> None:
    inches: Changes = {
        "pinion.cutter.diameter": "9.8425196850393704 in",
        "pinion.settings.radial_distance": "12.841 cm",
        "pinion.blank.face_width": '0.98425196850393704"',
    }
    one, other = parsed(), parsed(inches)
    assert other.pinion.concave.blade.point_radius == pytest.approx(126.2, rel=1e-15)
    assert other.pinion.blank.face_width == pytest.approx(25.0, rel=1e-15)
    assert other.pinion.concave.dials["radial_distance"] == pytest.approx(128.41, rel=1e-15)
    assert other.wheel == one.wheel


@pytest.mark.parametrize(
    ("terms", "plain"),
    [
        ({"roll_2c": 0.01}, (-0.01 / 2,)),
        ({"roll_6d": 0.02}, (0.0, -0.02 / 6)),
        ({"roll_2c": 0.01, "roll_24e": -0.3}, (-0.01 / 2, 0.0, 0.3 / 24)),
        ({"roll_120f": 1.2}, (0.0, 0.0, 0.0, -1.2 / 120)),
    ],
)
def test_roll_terms_are_derivatives(terms: dict[str, float], plain: tuple[float, ...]) -> None:
    """work = R_a (q - C q**2 - D q**3 - E q**4 - F q**5), 2C = 2! C, 6D = 3! D and so on."""
    spec = parsed({f"pinion.settings.{name}": value for name, value in terms.items()})
    assert spec.pinion.concave.dials["modified_roll"] == pytest.approx(plain, rel=1e-15)


def test_motions_have_the_unit_of_their_order() -> None:
    motions = {"sliding_base": ["1 mm/deg", "1 mm/deg^2", "0.1 in/rad^3"], "tilt_angle": [0.1]}
    spec = parsed({"wheel.settings.motions": motions})
    found = spec.wheel.convex.dials["motions"]
    assert found["sliding_base"] == pytest.approx((1 / radians(1), 1 / radians(1) ** 2, 2.54))
    assert found["tilt_angle"] == (0.1,)


def test_point_width_point_diameters_and_single_sides() -> None:
    spread = parsed().pinion
    assert [f.blade.point_radius for f in (spread.concave, spread.convex)] == [126.2, 123.8]
    assert spread.concave.blade.land == 1.2
    single = parsed(
        {
            "pinion.cutter": {"type": "face-mill", "height": "12 mm"},
            "pinion.concave.blade.point_diameter": "252.4 mm",
            "pinion.convex.blade.point_diameter": "247.6 mm",
        }
    ).pinion
    for alone, of_both in ((single.concave, spread.concave), (single.convex, spread.convex)):
        assert alone.blade == replace(of_both.blade, land=None, height=12.0)


def test_profile_toprem_and_flankrem() -> None:
    arc = {"profile": "circular-arc", "radius": "500 mm", "reference_height": "4 mm"}
    bow = {"profile": "parabola", "coefficient": "0.002 /mm", "reference_height": "4 mm"}
    spec = parsed(
        {
            "pinion.concave.blade": {
                "angle": "19 deg", **arc, "toprem": {"angle": "2 deg", "height": "2.2 mm"}
            },
            "pinion.convex.blade": {
                "angle": "21 deg", **bow, "flankrem": {"coefficient": "4 /m", "height": "6 mm"}
            },
            "wheel.blade.flankrem": {"angle": "2 deg", "height": "6 mm"},
        }
    )  # fmt: skip
    concave, convex = spec.pinion.concave.blade, spec.pinion.convex.blade
    assert (concave.curve, concave.curve_radius, concave.reference_height) == (
        "circular-arc", 500.0, 4.0
    )  # fmt: skip
    assert concave.toprem == (radians(2), 2.2)
    assert (convex.curve, convex.curve_coefficient) == ("parabola", 0.002)
    assert convex.flankrem == pytest.approx((6.0, 0.0, 0.004))
    assert spec.wheel.convex.blade.flankrem == (6.0, radians(2), 0.0)


def test_crown_says_as_much_as_cone_distance_and_addendum() -> None:
    """Lin, Tsay & Fong 1996, Table 1, by crown: the heel's tip lies 3.85 mm above the pitch cone."""
    file = next(f for f in example_files() if f.stem == "lin-tsay-fong-1996")
    spec = parse_spec(file.read_text(encoding="utf-8"))
    assert isinstance(spec, SummarySheetSpec)
    assert spec.pinion.blank.outer_cone_distance == pytest.approx(161.69, abs=0.01)
    assert spec.pinion.blank.outer_addendum == pytest.approx(3.90, abs=0.01)


def test_what_the_program_puts_in_is_told_once() -> None:
    told = {a.value: a.reason for a in parsed({"pinion.blade.edge_radius": None}).assumed}
    assert "default is 0 mm" in told["pinion.blade.edge_radius"]
    assert "default is 0 deg" in told["wheel.settings.tilt_angle"]
    assert not [path for path in told if "concave" in path]
    one = {"pinion.blade.edge_radius": None, "pinion.convex.blade.edge_radius": "1 mm"}
    assert "pinion.concave.blade.edge_radius" in {a.value for a in parsed(one).assumed}


HELIXFORM = {**SHEET["pinion"]["settings"], "method": "helixform", "ratio_of_roll": None}
BAD: list[tuple[Changes, str, str, str]] = [
    # a fault of one key: number, unit, kind, range
    ({"pinion.teeth": 0}, "pinion.teeth", "0", "from 1"),
    ({"pinion.teeth": 27.0}, "pinion.teeth", "27.0", "whole number"),
    ({"wheel.teeth": 26}, "wheel.teeth", "26", "at least as many teeth"),
    ({"wheel.hand": "right"}, "wheel.hand", '"right"', "opposite"),
    ({"pair.offset": 5}, "pair.offset", "5", "a length with its unit"),
    ({"pair.offset": float("inf")}, "pair.offset", "inf", "a length with its unit"),
    ({"pair.offset": "1e6 mm"}, "pair.offset", '"1e6 mm"', "up to 100 m"),
    ({"pair.shaft_angle": "45 mm"}, "pair.shaft_angle", '"45 mm"', "an angle with its unit"),
    ({"wheel.blank.face_width": -5}, "wheel.blank.face_width", "-5", "above 0"),
    ({"wheel.blank.face_width": "nan mm"}, "wheel.blank.face_width", '"nan mm"', "above 0"),
    ({"wheel.blank.face_width": "162 mm"}, "wheel.blank.face_width", '"162 mm"', "161.69 mm"),
    ({"wheel.blank.face_angle": "89 deg"}, "wheel.blank.face_angle", '"89 deg"', "within 30 deg"),
    ({"wheel.blank.outer_addendum": "90 mm"}, "wheel.blank.outer_addendum", '"90 mm"', "half"),
    ({"wheel.blank.root_angle": "21 deg"}, "wheel.blank.outer_dedendum", "nothing", "or neither"),
    ({"wheel.concave.blade.angle": "95 deg"}, "wheel.concave.blade.angle", '"95 deg"', "60 deg"),
    ({"wheel.cutter.type": "face-hob"}, "wheel.cutter.type", '"face-hob"', '"face-mill"'),
    ({"wheel.cutter.point_width": "10 in"}, "wheel.cutter.point_width", '"10 in"', "250 mm"),
    ({"wheel.settings.ratio_of_roll": float("nan")}, "wheel.settings.ratio_of_roll", "nan", "above 0"),
    ({"wheel.settings.cradle_angle": "400 deg"}, "wheel.settings.cradle_angle", '"400 deg"', "360"),
    ({"wheel.settings.modified_roll": [1e300]}, "wheel.settings.modified_roll", "[1e+300]", "1000"),
    ({"wheel.settings.method": ["tilt"]}, "wheel.settings.method", '["tilt"]', '"generated"'),
    ({"wheel.settings.machine": "phoenix"}, "wheel.settings.machine", '"phoenix"', "gleason-463"),
    ({"wheel.settings.machine": {}}, "wheel.settings.machine", "{}", "gleason-463"),
    # tables
    ({"pinion": "x"}, "pinion", '"x"', "a table"),
    ({"pinion": [{"teeth": 6}]}, "pinion", "[{teeth = 6}]", "a table"),
    ({"pinion": [[1]], "wheel": 3}, "pinion", "[[1]]", "one table, [pinion]"),
    ({"pinion.blank": [3]}, "pinion.blank", "[3]", "a table"),
    ({"pinion.settings": "x"}, "pinion.settings", '"x"', "a table"),
    ({"wheel.cutter": None}, "wheel.cutter", "nothing", "diameter and point_width"),
    ({"wheel.blank": None}, "wheel.blank", "nothing", "a table"),
    ({"wheel": None}, "wheel", "nothing", "a table"),
    ({"pair": None}, "pair", "nothing", "a table"),
    ({"pinion.bade": {}}, "pinion.bade", "an unknown key", "did you mean blade?"),
    # keys that go together
    ({"wheel.cutter.point_width": None}, "wheel.cutter.point_width", "nothing", "or neither"),
    ({"wheel.blade.point_diameter": "250 mm"}, "wheel.blade.point_diameter", '"250 mm"', "nothing:"),
    ({"wheel.blade.radius": "800 mm"}, "wheel.blade.radius", '"800 mm"', 'profile = "straight"'),
    ({"wheel.blade.flankrem": {"height": "6 mm"}}, "wheel.blade.flankrem",
     '{height = "6 mm"}', "one of them"),
    ({"wheel.blank.outer_addendum": None}, "wheel.blank.outer_addendum", "nothing", "either"),
    ({"wheel.blank.outside_diameter": "133 mm"}, "wheel.blank.outside_diameter", "both", "not both"),
    # methods and machines
    ({"wheel.settings.method": None}, "wheel.settings.method", "nothing", "helical-duplex"),
    ({"wheel.settings.ratio_of_roll": None}, "wheel.settings.ratio_of_roll", "nothing", "rolls"),
    ({"wheel.settings.method": "formate"}, "wheel.settings.ratio_of_roll", "2.5656", "stands still"),
    ({"wheel.settings.method": "tilt"}, "wheel.settings.tilt_angle", "nothing", "other than 0"),
    ({"wheel.settings.method": "modified-roll"}, "wheel.settings.modified_roll", "nothing", "roll_2c"),
    ({"wheel.settings.method": "helical-duplex"}, "wheel.settings.helical_motion", "nothing", "not 0"),
    ({"wheel.settings.cutter_lead": "1 mm/rad"}, "wheel.settings.cutter_lead",
     '"1 mm/rad"', "helixform"),
    ({"pinion.settings": {k: v for k, v in HELIXFORM.items() if v}}, "pinion.settings.cutter_lead",
     "nothing", "other than 0"),
    ({"wheel.settings.method": "duplex", "wheel.convex.settings": {"sliding_base": "1 mm"}},
     "wheel.convex.settings.sliding_base", '"1 mm"', "both flanks at once"),
    ({"wheel.settings.modified_roll": [0.1], "wheel.settings.roll_2c": 0.1},
     "wheel.settings.modified_roll", "both of them", "either"),
    ({"wheel.settings.motions": {"sliding_base": ["1 mm/rad", "2 mm/rad"]}},
     "wheel.settings.motions.sliding_base", '["1 mm/rad", "2 mm/rad"]', "for order 2"),
    ({"wheel.settings.motions": {"tilt_angle": ["1 deg"]}},
     "wheel.settings.motions.tilt_angle", '["1 deg"]', "plain numbers"),
    ({"pinion.settings": {"method": "modified-roll", **ON_122["pinion.settings"]},
      "pinion.settings.method": "modified-roll"}, "pinion.settings.machine", '"gleason-122"',
     "basic, gleason-463"),
    ({**ON_122, "pinion.settings.tilt_angle": "1 deg"}, "pinion.settings.tilt_angle", '"1 deg"',
     "no such dial"),
    ({**ON_122, "pinion.settings.swivel_angle": None}, "pinion.settings.swivel_angle", "nothing",
     'a dial of machine = "gleason-122"'),
    ({**ON_122, "pinion.settings.ratio_gears": [1, 2, 3]}, "pinion.settings.ratio_gears",
     "[1, 2, 3]", "four whole numbers"),
    ({**ON_122, "pinion.settings.helical_direction": -1}, "pinion.settings.helical_direction", "-1",
     "without helical_gears"),
    ({**ON_463, "pinion.settings.helical_gears": [52, 66, 82, 49]}, "pinion.settings.helical_gears",
     "[52, 66, 82, 49]", "no such dial"),
    ({"pinion.settings": ON_463["pinion.settings"]}, "machine.gleason-463", "nothing",
     "swivel_offset"),
    ({**ON_463, "machine.gleason-463.cams.23a": GRINDER["cams"]["23"]},
     "machine.gleason-463.cams.23a", "a name", "cam number"),
    ({**ON_463, "pinion.settings.cam_number": 24}, "pinion.settings.cam_number", "24", "23, 29"),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "path", "given_text", "expected"), BAD)
def test_a_fault_is_told_with_an_example_that_works(
    changes: Changes, path: str, given_text: str, expected: str
) -> None:
    document = sheet(changes)
    found = {p.path: p for p in problems(document)}
    assert found[path].given == given_text
    assert expected in found[path].expected
    assert path not in {p.path for p in problems(repaired(document, found[path]))}


@pytest.mark.parametrize(("changes", "path", "given_text", "expected"), BAD)
def test_no_key_is_told_to_be_wrong_for_what_another_lacks(
    changes: Changes, path: str, given_text: str, expected: str
) -> None:
    found = [p.path for p in problems(sheet(changes))]
    assert found == [path] if "wheel" not in changes else len(found) <= 2


def test_all_faults_at_once_also_those_of_the_machine() -> None:
    document = sheet(
        ON_122,
        {
            "pair.offset": "5",
            "pinion.settings.eccentric_angle": "200 deg",
            "pinion.settings.sliding_base": "500 mm",
            "pinion.concave.blade.angle": None,
            "pinion.convex.blade.angle": None,
            "wheel.hand": "right",
            "wheel.cutter.point_width": "300 mm",
            "assumed": [{"value": "pinion.blank.pich_angle", "reason": "a slip"}],
        },
    )
    found = {p.path: p for p in problems(document)}
    assert found.keys() == {
        "pair.offset",
        "pinion.settings.eccentric_angle",
        "pinion.settings.sliding_base",
        "pinion.blade.angle",
        "wheel.hand",
        "wheel.cutter.point_width",
        "assumed[0].value",
    }
    assert "from -400 mm to 400 mm" in found["pinion.settings.sliding_base"].expected


@pytest.mark.parametrize(
    ("text", "path", "expected"),
    [
        ("", "cutting", "or [pinion.blank] and [wheel.blank]"),
        ("[pinion.blnk]", "cutting", "is [pinion.blnk] meant to be [pinion.blank]?"),
        ("[cuting]", "cutting", "is [cuting] meant to be [cutting]?"),
        ("[cutting]\n[wheel.blank]", "cutting", "one of them: [cutting]"),
        ("[[pinion]]\nteeth = 6", "pinion", "one table, [pinion]"),
        ("[pinion.blank]\n" + "a." * 3000 + "a = 1", "pinion.blank.a", "one of pitch_angle"),
        ("[pinion.blank]\npitch_angle = 0x" + "f" * 9000, "pinion.blank.pitch_angle", "an angle"),
        ("[pinion]\nblank = 1\nteeth = 0x" + "f" * 9000, "pinion.teeth", "from 1 to 1000"),
    ],
    ids=lambda text: text[:24],
)
def test_files_that_are_no_sheet(text: str, path: str, expected: str) -> None:
    with pytest.raises(DesignError) as caught:
        parse_spec(text)
    found = {p.path: p for p in caught.value.problems}
    assert expected in found[path].expected


def test_a_good_sheet_is_read_without_jax() -> None:
    """Machines are asked for their dials' ranges only along with other faults."""
    file = next(f for f in example_files() if f.stem == "tsay-lin-1993")
    code = f"import sys; from hypoid.io import read_spec; read_spec({str(file)!r}); sys.exit('jax' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


VALUES = st.recursive(
    st.booleans()
    | st.integers()
    | st.floats()
    | st.dates()
    | st.text(st.characters(exclude_categories=("Cs", "Cc")))
    | st.sampled_from(["-1 mm", "1e-9 mm", "9 in", "95 deg", "1e300 deg", "1 mm/rad", "5 /mm"])
    | st.sampled_from(
        ["tilt", "helixform", "gleason-463", "basic", "parabola", [12, 200, 12, 200]]
    ),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(["angle", "23", "blank", "method"]), inner, max_size=3)
    ),
    max_leaves=5,
)


def paths_of(table: Any, before: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    here = [(*before, key) for key in table]
    below = [paths_of(v, (*before, k)) for k, v in table.items() if isinstance(v, dict)]
    return here + [path for paths in below for path in paths]


@settings(
    max_examples=250, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck)
)
@given(st.data())
def test_any_file_is_a_design_or_a_design_error(data: st.DataObject) -> None:
    document = sheet(data.draw(st.sampled_from([{}, ON_122, ON_463])))
    for _ in range(data.draw(st.integers(1, 4))):
        path = data.draw(st.sampled_from(paths_of(document)))
        table = document
        for name in path[:-1]:
            table = table[name]
        key = data.draw(st.sampled_from([path[-1], "machine", "cutting", "toprem", "cams"]))
        table[key] = data.draw(VALUES)
    for problem in problems(document):
        assert all((problem.path, problem.given, problem.expected, problem.example))
