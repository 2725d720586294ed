"""The quantity parser: what engineers write, and what must never pass in silence."""

from math import degrees, isclose, radians

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hypoid.io import Kind, QuantityError, parse


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("55 mm", "length", 55.0),
        ("0.254mm", "length", 0.254),
        ("9.075 in", "length", 230.505),
        ('9.075"', "length", 230.505),
        ("5' 3\"", "length", 1600.2),
        ("6.5 µm", "length", 0.0065),
        ("6.5 um", "length", 0.0065),
        ("-1e-2 m", "length", -10.0),
        ("12 deg 30 min", "angle", radians(12.5)),
        ("12 deg 30' 36\"", "angle", radians(12.51)),
        ("12°30'", "angle", radians(12.5)),
        ("12° 30′ 36″", "angle", radians(12.51)),
        ("12 deg 30' 36''", "angle", radians(12.51)),
        ("-12 deg 30 min", "angle", radians(-12.5)),
        ("−0.5 rad", "angle", -0.5),
        ("3600 arcsec", "angle", radians(1.0)),
        ("0.004 /mm", "per_length", 0.004),
        ("0.1016 1/in", "per_length", 0.004),
        ("0.1 mm/rad", "length_per_angle", 0.1),
        ("1 mm/deg", "length_per_angle", degrees(1.0)),
        ("110 N m", "torque", 110e3),
        ("110 N·m", "torque", 110e3),
        ("110Nm", "torque", 110e3),
        ("110 N*mm", "torque", 110.0),
        ("206 GPa", "stress", 206e3),
        ("30 ksi", "stress", 206.8427),
    ],
)
def test_reads_what_engineers_write(text: str, kind: Kind, value: float) -> None:
    assert parse(text, kind) == pytest.approx(value, rel=1e-7)


@pytest.mark.parametrize(
    ("given_text", "kind"),
    [
        ("", "length"),
        ("mm", "length"),
        ("nan mm", "length"),
        ("inf mm", "length"),
        ("1e999 mm", "length"),
        ("12,5 mm", "length"),
        ("12 deg", "length"),
        ("12 mmm", "length"),
        ("12 mm 5", "length"),
        ("5 mm 3 mm", "length"),
        ("12 mm", "angle"),
        ("12 deg 60 min", "angle"),
        ("30 min 12 deg", "angle"),
        ("12.5 deg 30 min", "angle"),
        ("12 deg -30 min", "angle"),
        ("--12 deg", "angle"),
        (12.0, "angle"),
        (float("nan"), "angle"),
        (True, "length"),
        (None, "length"),
        (["1 mm"], "length"),
    ],
)
def test_refuses_and_gives_an_example_that_works(given_text: object, kind: Kind) -> None:
    with pytest.raises(QuantityError) as caught:
        parse(given_text, kind)
    parse(caught.value.example, kind)


@pytest.mark.parametrize(("bare", "fix"), [("55", "55 mm"), (55, "55 mm"), (-0.5, "-0.5 mm")])
def test_bare_number_is_shown_with_its_unit(bare: object, fix: str) -> None:
    with pytest.raises(QuantityError) as caught:
        parse(bare, "length")
    assert caught.value.example == fix


@given(
    whole=st.integers(0, 359),
    minutes=st.integers(0, 59),
    seconds=st.floats(0, 59.999),
    negative=st.booleans(),
)
def test_sign_holds_for_the_whole_angle(
    whole: int, minutes: int, seconds: float, negative: bool
) -> None:
    text = f"{'-' if negative else ''}{whole} deg {minutes} min {seconds:.6f} sec"
    value = radians(whole + minutes / 60 + round(seconds, 6) / 3600)
    assert isclose(parse(text, "angle"), -value if negative else value, abs_tol=1e-12)


@given(st.floats(-1e9, 1e9).filter(lambda x: abs(x) > 1e-9))
def test_every_finite_number_with_a_unit_reads_back(x: float) -> None:
    assert parse(f"{x!r} mm", "length") == x
    assert isclose(parse(f"{x!r} in", "length"), 25.4 * x, rel_tol=1e-15)


@given(st.text())
def test_any_text_is_a_quantity_or_a_quantity_error(text: str) -> None:
    for kind in ("length", "angle", "torque"):
        try:
            parse(text, kind)
        except QuantityError as error:
            parse(error.example, kind)
