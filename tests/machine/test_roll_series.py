"""Modified roll as a series: a cam's own against (18) in 40 digits, closed forms, and the printed numbers."""

from __future__ import annotations

from math import radians
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hypoid.machine import Cam, cam_roll, roll_series
from hypoid.machine._roll_series import cam_of_roll, centre_rates, from_field, to_field

C, R_23, R_29 = 381.0, 70.302, 56.439  # stand-ins of the notes
CAMS = {
    "P-IB": Cam(C, R_23, 0.0, radians(5 + 10 / 60), 10 / 27),
    "P-OB": Cam(C, R_23, 0.0, 0.0, 10 / 27),
    "gear": Cam(C, R_29, 0.0, radians(-40 / 60), 9 / 28),
    "raised": Cam(C, R_23, 4.0, radians(-8.0), 10 / 27),
    "lowered": Cam(300.0, 80.0, -25.0, radians(12.0), 0.4),
}
OF_CAMS = pytest.mark.parametrize("cam", CAMS.values(), ids=CAMS.keys())


def shaft(cam: Cam, cradle: Any) -> Any:
    """Input shaft angle alpha_e at a cradle angle alpha_a, by (18) as printed."""
    c, r, delta = map(mp.mpf, (cam.swivel_offset, cam.pitch_radius, cam.setting))
    phi = mp.mpf(cam.guide_angle)

    def contact(alpha_e: Any) -> Any:
        off = cradle - alpha_e - phi
        turned = mp.sin(phi) + mp.sin(r / c * off) + mp.sin(cradle - phi)
        return c * turned + delta * mp.sin(off)

    near = -phi + (1 + c / (r + delta)) * cradle
    return mp.findroot(contact, (near, near + mp.mpf("1e-3")), tol=1e-70)


@OF_CAMS
def test_roll_series_is_the_taylor_series_of_the_contact(cam: Cam, forty_digits: None) -> None:
    """[lin1996, (18)] to sixth order, to the rounding of a double."""
    with mp.workdps(80):
        taylor = mp.taylor(lambda a: shaft(cam, a), 0, 6)
    series = roll_series(cam)
    assert len(series.modified_roll) == 5
    assert series.ratio_of_roll == pytest.approx(float(taylor[1]) * cam.index_ratio, rel=1e-14)
    for found, wanted in zip(series.modified_roll, taylor[2:], strict=True):
        assert found == pytest.approx(float(wanted / taylor[1]), abs=1e-12, rel=1e-12)


@OF_CAMS
def test_lin_1996_closed_forms_at_the_centre_of_roll(cam: Cam, forty_digits: None) -> None:
    """R = 1 + k cos phi, R' and R'' (notes) are the derivatives of the shaft by the cradle."""
    with mp.workdps(80):
        wanted = [float(mp.diff(lambda a: shaft(cam, a), 0, n)) for n in (1, 2, 3)]
    assert centre_rates(cam) == pytest.approx(wanted, rel=1e-13, abs=1e-13)
    rate, bend, twist = centre_rates(cam)
    field = roll_series(cam).field
    assert field[:2] == pytest.approx((-bend / rate, -twist / rate), rel=1e-12, abs=1e-13)


@pytest.mark.parametrize(
    ("name", "printed"),
    [
        ("P-IB", ("-.0763", ".0068", "-.378")),
        ("P-OB", ("0.0000", "0.0000", "0.0000")),
        ("gear", (".0101", ".0001", ".0507")),
    ],
)
def test_lin_1996_roll_series(name: str, printed: tuple[str, ...]) -> None:
    """2C, 6D and 24E of Table 2 with the stand-in cams (notes), in the machine's own cradle angle."""
    for found, wanted in zip(roll_series(CAMS[name]).field, printed, strict=False):
        half_a_digit = 0.5 * 10.0 ** -len(wanted.split(".")[1])
        assert found == pytest.approx(float(wanted), abs=half_a_digit)


@pytest.mark.parametrize(("name", "ratio"), [("P-OB", 6.420), ("gear", 7.750)])
def test_lin_1996_ratios_of_roll(name: str, ratio: float) -> None:
    """R_a = 6.420 and 7.750 of shaft to cradle (notes; the stand-ins' last digit is 6e-4 of it)."""
    rate = roll_series(CAMS[name]).ratio_of_roll / float(CAMS[name].index_ratio)
    assert rate == pytest.approx(ratio, abs=1e-3)


@OF_CAMS
def test_series_runs_into_the_cam(cam: Cam) -> None:
    """Six orders leave an error of the seventh: half the angle, nearly 2**7 times less."""
    series, errors = roll_series(cam), []
    for angle in (0.2, 0.1, 0.05):
        powers = [0.0, 1.0, *series.modified_roll]
        by_series = series.ratio_of_roll * np.polynomial.polynomial.polyval(angle, powers)
        errors.append(abs(by_series - float(cam_roll(cam, np.float64(angle))[0])))
    if max(errors) > 1e-13:
        assert np.log2(errors[0] / errors[1]) > 6.0
        assert np.log2(errors[1] / errors[2]) > 6.4


def test_fields_names_and_plain_coefficients() -> None:
    """work = c1 (q - C q**2 - D q**3 - E q**4 - F q**5), each with its factorial."""
    plain = (0.03, -0.01, 0.002, -0.0004)
    field = to_field(plain)
    assert field == pytest.approx((-0.06, 0.06, -0.048, 0.048))
    assert from_field(field) == pytest.approx(plain, rel=1e-15)


@settings(max_examples=60, deadline=None)
@given(
    index=st.floats(0.2, 0.6),
    rate=st.floats(2.0, 12.0),
    c2=st.floats(-0.2, 0.2),
    r=st.floats(40, 90),
)
def test_seat_and_guide_give_any_ratio_and_second_order(
    index: float, rate: float, c2: float, r: float
) -> None:
    cam = cam_of_roll(C, r, index, index * rate, c2)
    series = roll_series(cam, 3)
    assert series.ratio_of_roll == pytest.approx(index * rate, rel=1e-13)
    assert series.modified_roll[0] == pytest.approx(c2, abs=1e-13)
