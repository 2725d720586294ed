"""The cam of the No. 463 against the cam itself: a profile in 40 digits, rolled between two straight guides.

`Contact` knows only the profile (7), where cam and guides stand (10), (11), and that they touch: neither
(18) nor (24) nor a derivative of them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import acos, asin, pi, radians, sin
from typing import Any

import jax
import jax.numpy as jnp
import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hypoid.machine import Cam, cam_roll
from hypoid.machine._cam import cradle_limits, uniform_limit

CAMS = {
    "No. 23": Cam(381.0, 70.302, 0.0, radians(5 + 10 / 60), 10 / 27),
    "No. 29": Cam(381.0, 56.439, 0.0, radians(-40 / 60), 9 / 28),
    "raised": Cam(381.0, 70.302, 4.0, radians(-8.0), 10 / 27),
    "lowered": Cam(300.0, 80.0, -25.0, radians(12.0), 0.4),
    "larger than C": Cam(50.0, 90.0, 10.0, radians(20.0), 1.3),
}
OF_CAMS = pytest.mark.parametrize("cam", CAMS.values(), ids=CAMS.keys())
WIDE = 500.0  # mm, a half breadth with which no cam here has a cusp; the motion does not know it
FIELDS = ["angle", *Cam.__dataclass_fields__]


@dataclass(frozen=True)
class Contact:
    """A constant-breadth cam between the parallel guides of the swivel."""

    cam: Cam
    half_breadth: float = WIDE

    def profile(self, alpha: Any, side: int = 1) -> tuple[Any, Any]:
        """Point of the cam's flank on one side [lin1996, (7); a with its sign]."""
        c, r = mp.mpf(self.cam.swivel_offset), mp.mpf(self.cam.pitch_radius)
        turn, whole = -c / r * alpha, (c + r) / r * alpha
        a, arm = side * self.half_breadth, (c + r) * mp.cos(alpha)
        x = a * mp.cos(turn) + arm * mp.sin(turn) + c * mp.sin(whole)
        return x, a * mp.sin(turn) - arm * mp.cos(turn) + c * mp.cos(whole)

    @cached_property
    def ends(self) -> tuple[Any, Any]:
        """Parameters of the profile between which it is the cam's right flank, top to bottom.

        From the cusp, or where its normal has turned by a quarter, to where it meets the other flank.
        """
        c, r = mp.mpf(self.cam.swivel_offset), mp.mpf(self.cam.pitch_radius)
        quarter, sine = mp.pi / 2 * min(1, r / c), self.half_breadth * c / abs(c * c - r * r)
        top = bottom = min(quarter, mp.asin(sine)) if sine < 1 else quarter
        if self.profile(bottom)[0] < 0:
            ends = (0, bottom)
            bottom = mp.findroot(lambda a: self.profile(a)[0], ends, solver="anderson", tol=1e-34)
        return -top, bottom

    def touch(self, shaft: Any, angle: Any, side: int = 1) -> tuple[Any, Any, int]:
        """How far the cam stands through a guide (mm), with which parameter and flank [(10), (11)]."""
        c = mp.mpf(self.cam.swivel_offset)
        normal = angle - self.cam.guide_angle  # of the right guide, against x
        nx, ny = side * mp.cos(normal), side * mp.sin(normal)

        def outward(alpha: Any, flank: int) -> Any:
            x, y = self.profile(alpha, flank)
            y = y - self.cam.setting
            cosine, sine = mp.cos(shaft), mp.sin(shaft)
            return nx * (x * cosine - y * sine) + ny * (x * sine + y * cosine)

        def most(flank: int) -> tuple[Any, Any, int]:
            """Where a flank reaches out most: within it, else at an end."""
            h = mp.mpf("1e-14")
            low, high = ((1 - h) * end for end in sorted(flank * end for end in self.ends))

            def slope(alpha: Any) -> Any:
                return (outward(alpha + h, flank) - outward(alpha - h, flank)) / h

            alpha = max(low, high, key=lambda a: outward(a, flank))
            if slope(low) > 0 > slope(high):
                alpha = mp.findroot(slope, (low, high), solver="anderson", tol=1e-24, maxsteps=99)
            return outward(alpha, flank), alpha, flank

        reach, alpha, flank = max(most(1), most(-1))
        swivel = c * mp.sin(angle), c - c * mp.cos(angle)  # its centre, from the input shaft's
        guide = nx * swivel[0] + ny * swivel[1] + self.half_breadth
        return reach - guide, alpha, flank

    def shaft(self, angle: Any) -> Any:
        """Input shaft angle at which the cam touches the right guide."""
        turn = mp.mpf(self.cam.swivel_offset) / self.cam.pitch_radius
        ends = [angle - self.cam.guide_angle + s * turn * self.ends[1] for s in (-1, 1)]
        root = {"solver": "anderson", "tol": 1e-34, "maxsteps": 99}
        return mp.findroot(lambda shaft: self.touch(shaft, angle)[0], ends, **root)

    def work(self, angle: Any) -> tuple[Any, Any]:
        """Work roll from the centre of roll, where the shaft stands at minus the guide angle, and its rate."""
        h = mp.mpf("1e-9")
        ahead, behind = (
            self.cam.index_ratio * (self.shaft(angle + d) + self.cam.guide_angle) for d in (h, -h)
        )
        return (ahead + behind) / 2, (ahead - behind) / (2 * h)  # errors 1e-18


def angles_of(cam: Cam, count: int) -> Any:
    """Cradle angles over all of the uniform motion of the wide cam."""
    low, high = cradle_limits(cam, WIDE)
    return low + (high - low) * np.linspace(0.03, 0.97, count)


def shaft_of(cam: Cam, angle: float) -> float:
    """Input shaft angle of `cam_roll`."""
    return float(cam_roll(cam, angle)[0]) / cam.index_ratio - cam.guide_angle


@OF_CAMS
def test_lin_1996_cam_touches_both_guides(cam: Cam, forty_digits: None) -> None:
    """At the shaft angle of `cam_roll`, to 1e-12 mm; constant breadth holds for any seat and guide (notes)."""
    contact = Contact(cam)
    for angle in angles_of(cam, 3):
        shaft = shaft_of(cam, angle)
        for side in (1, -1):
            gap, _, flank = contact.touch(shaft, mp.mpf(angle), side)
            assert abs(gap) < 1e-12
            assert flank == side
            assert abs(contact.touch(shaft + 1e-6, mp.mpf(angle), side)[0]) > 1e-5


@OF_CAMS
def test_work_rolls_as_the_cam_and_at_its_rate(cam: Cam, forty_digits: None) -> None:
    """W and dW/d(angle) against 40-digit contact and its differences."""
    for angle in angles_of(cam, 3):
        work, rate = Contact(cam).work(mp.mpf(angle))
        assert float(cam_roll(cam, angle)[0]) == pytest.approx(float(work), abs=2e-15, rel=2e-15)
        assert float(cam_roll(cam, angle)[1]) == pytest.approx(float(rate), rel=2e-14)


@pytest.mark.parametrize("name", FIELDS)
def test_jax_derivatives_by_every_parameter(name: str, forty_digits: None) -> None:
    """Both outputs, the parameter alone traced and all others plain numbers."""
    cam, angle = CAMS["raised"], 0.21

    def moved(value: Any) -> tuple[Cam, Any]:
        return (cam, value) if name == "angle" else (replace(cam, **{name: value}), angle)

    def exact(value: Any) -> Any:
        at, by = moved(value)
        return mp.matrix(Contact(at).work(mp.mpf(by)))

    value = angle if name == "angle" else getattr(cam, name)
    h = mp.mpf("1e-6") * max(1, abs(value))
    wanted = (exact(mp.mpf(value) + h) - exact(mp.mpf(value) - h)) / (2 * h)
    found = jax.jacfwd(lambda v: jnp.stack(cam_roll(*moved(v))))(value)
    assert np.asarray(found) == pytest.approx([float(w) for w in wanted], rel=1e-10)


@jax.jit
def derivatives(cam: Cam, angles: Any) -> tuple[Any, ...]:
    """W and dW; dW by reverse mode; d2W by reverse over reverse; d2W of the rate by forward mode."""
    first = jax.grad(lambda angle: cam_roll(cam, angle)[0])
    bend = jax.jacfwd(lambda angle: cam_roll(cam, angle)[1])
    return *cam_roll(cam, angles), *(jax.vmap(f)(angles) for f in (first, jax.grad(first), bend))


@OF_CAMS
def test_jax_derivatives_of_any_order_agree(cam: Cam) -> None:
    """Both modes, compiled, and NumPy's own W and dW."""
    angles = angles_of(cam, 7)
    work, rate, first, second, bend = map(np.asarray, derivatives(cam, angles))
    wanted = cam_roll(cam, angles)
    assert work == pytest.approx(wanted[0], abs=1e-14)
    assert rate == pytest.approx(wanted[1], rel=1e-13)
    assert first == pytest.approx(rate, rel=1e-13)
    assert second == pytest.approx(bend, abs=1e-11)


@OF_CAMS
def test_other_guide_angle_mirrors_the_roll(cam: Cam) -> None:
    """Guide and cradle turned the other way, the work turns the other way."""
    angles = angles_of(cam, 9)
    work, rate = cam_roll(cam, angles)
    mirrored = replace(cam, guide_angle=-cam.guide_angle)
    assert cam_roll(mirrored, -angles)[0] == pytest.approx(-work, abs=1e-15)
    assert cam_roll(mirrored, -angles)[1] == pytest.approx(rate, abs=1e-15)


def test_lin_1996_equation_3() -> None:
    """A central cam under straight guides rolls uniformly at (C + r_u)/r_u."""
    cam = replace(CAMS["No. 23"], guide_angle=0.0)
    angles = angles_of(cam, 9)
    ratio = cam.index_ratio * (cam.swivel_offset + cam.pitch_radius) / cam.pitch_radius
    assert cam_roll(cam, angles)[0] == pytest.approx(ratio * angles, abs=1e-14)
    assert cam_roll(cam, angles)[1] == pytest.approx(np.full(9, ratio), rel=1e-13)


ANY_CAM = st.builds(
    lambda c, turn, share, guide, ratio: Cam(c, c / turn, share * c / turn, guide, ratio),
    st.floats(100.0, 600.0),
    st.floats(0.3, 10.0),
    st.floats(-0.98, 0.98),
    st.floats(-0.7, 0.7),
    st.floats(0.1, 2.0),
)


@settings(max_examples=200, deadline=None)
@given(cam=ANY_CAM)
def test_lin_1996_equations_24_and_25_hold_up_to_the_limits(cam: Cam) -> None:
    """The root is the one that grows from the centre of roll, whatever the seat: no other is met."""
    low, high = cradle_limits(cam)
    angles = low + (high - low) * np.linspace(0.01, 0.99, 99)
    work, rate = cam_roll(cam, angles)
    turn, share = cam.swivel_offset / cam.pitch_radius, cam.setting / cam.swivel_offset
    alpha = (work / cam.index_ratio - angles) / turn
    assert np.abs(alpha).max() <= acos(abs(share) * turn) + 1e-12
    sine = share * np.sin(turn * alpha) + np.sin(alpha) - sin(cam.guide_angle)
    assert sine == pytest.approx(np.sin(angles - cam.guide_angle), abs=1e-13)
    assert (np.diff(work) > 0.0).all()
    assert (rate > 0.0).all()


@pytest.mark.parametrize("half_breadth", [15.0, 40.0, 90.0, 500.0])
@OF_CAMS
def test_lin_1996_equation_9(cam: Cam, half_breadth: float, forty_digits: None) -> None:
    """Up to |alpha| = asin(a C/|r_u^2 - C^2|) (notes, item 4) neither flank has a cusp; there one has.

    If the flanks of (7) meet before, that is the limit: a point on the cam's own axis.
    """
    contact, limit = Contact(cam, half_breadth), uniform_limit(cam, half_breadth)
    turn, h = cam.swivel_offset / mp.mpf(cam.pitch_radius), mp.mpf("1e-15")

    def radius(alpha: Any, side: int) -> Any:
        """Of curvature: travel along the flank for a turn of its normal by -C alpha/r_u."""
        (x1, y1), (x0, y0) = contact.profile(alpha + h, side), contact.profile(alpha - h, side)
        along = -mp.sin(turn * alpha), -mp.cos(turn * alpha)
        return side * ((x1 - x0) * along[0] + (y1 - y0) * along[1]) / (2 * h * turn)

    for share in np.linspace(-0.999, 0.999, 21):
        assert min(radius(share * limit, side) for side in (1, -1)) > 0.0
        assert contact.profile(share * limit)[0] > 0.0
    sine = half_breadth * cam.swivel_offset / abs(cam.pitch_radius**2 - cam.swivel_offset**2)
    cusps = sine < 1.0 and limit == pytest.approx(asin(sine), rel=1e-14)
    meets = abs(contact.profile(limit)[0]) < 1e-12
    widest = limit == pytest.approx(pi / 2, abs=1e-15)  # where the guide stands across
    assert cusps + meets + widest == 1
    if cusps:
        ends = [radius(side * limit, of) for side in (1, -1) for of in (1, -1)]
        assert min(abs(r) for r in ends) < 1e-11


@pytest.mark.parametrize("half_breadth", [15.0, 90.0])
@pytest.mark.parametrize("name", ["No. 23", "raised", "lowered"])
def test_limits_of_the_cradle_by_contact(
    name: str, half_breadth: float, forty_digits: None
) -> None:
    """At both ends the guide touches the cusp or the corner; of the corner it lets go beyond."""
    cam, limit = CAMS[name], uniform_limit(CAMS[name], half_breadth)
    for side, end in zip((-1, 1), cradle_limits(cam, half_breadth), strict=True):
        shaft = Contact(cam).shaft(mp.mpf(end))  # the motion does not know the breadth
        touching = Contact(cam).touch(shaft, mp.mpf(end))[1]
        assert float(touching) == pytest.approx(side * limit, abs=1e-13)
        if half_breadth == 90.0:
            for share, held in ((0.999, True), (1.01, False)):
                at, angle = Contact(cam, 90.0), mp.mpf(share * end)
                gaps = [at.touch(shaft_of(cam, share * end), angle, of)[0] for of in (1, -1)]
                assert (max(abs(gap) for gap in gaps) < 1e-12) == held


def test_a_cam_on_its_seat_is_closed() -> None:
    """(24) with delta = 0: the parameter is an arcsine, in NumPy and in JAX, to rounding."""
    for guide in (0.0, radians(5.0), radians(-3.0)):
        cam = Cam(381.0, 70.302, 0.0, guide, 10 / 27)
        angle = np.linspace(-0.2, 0.2, 41)
        for at in (angle, jnp.asarray(angle)):
            closed = cam_roll(cam, at, seated=True)
            for one, other in zip(closed, cam_roll(cam, at), strict=True):
                assert np.asarray(one) == pytest.approx(np.asarray(other), abs=1e-14)
