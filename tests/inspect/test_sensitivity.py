"""How a flank answers to a dial: n . dr/dp at fixed parameters, against three things that know nothing of it."""

from __future__ import annotations

from math import tan

import mpmath
import numpy as np
import pytest
from independent import carried
from inspection import EVERY, NAMES

from hypoid.inspect import Response

BASIC = ("radial_distance", "cradle_angle", "machine_root_angle", "sliding_base", "blank_offset",
         "machine_center_to_back", "tilt_angle", "ratio_of_roll", "helical_motion")  # fmt: skip


def flat(parts):
    return np.concatenate(list(parts.values()))


@pytest.mark.parametrize(("name", "member"), EVERY)
def test_every_dial_and_blade_agrees_with_cutting_anew(bench, name, member):
    """Central differences of the exact flank along nominal normals, no parameter held fixed."""
    for response in bench(name, member).responses:
        own = response.setup.adjustments
        some = [n for n in own if not n.startswith("motions.") or n.endswith(".2")]
        J = response.sensitivity(some)
        for k, n in enumerate(some):
            dial = own[n]
            h = 0.02 * dial.reach
            if dial.value - h < dial.low:  # a dial at its end: second-order differences from there
                at = [flat(response.cut({n: s * h})) for s in (0, 1, 2)]
                slope = (4 * at[1] - at[2] - 3 * at[0]) / (2 * h)
            else:
                slope = (flat(response.cut({n: h})) - flat(response.cut({n: -h}))) / (2 * h)
            scale = np.abs(slope).max() * dial.reach
            assert np.abs(J[:, k] - slope).max() * dial.reach < 1e-3 * scale + 1e-9, n


@pytest.mark.parametrize("setting", BASIC)
def test_basic_settings_agree_with_the_chain_in_forty_digits(bench, setting, forty_digits):
    """d/dp of the plain chain (corrected 2005 paper) at fixed (s, theta, phi), along the flank's normal."""
    one = bench("gonzalez-fuentes-2022", "pinion")
    from dataclasses import replace

    from hypoid.inspect import setups

    setup = setups(one.pair, "pinion", None, "basic")[0]
    response = Response(setup, one.grid)
    sign = -1.0 if setting == "blank_offset" else 1.0  # the sheet's sign
    column = response.sensitivity([setting])[:45, 0]
    nodes = one.grid.flanks["concave"]
    (group,) = nodes.groups
    flank = nodes.flank
    piece = flank.pieces["flank"]
    for k in (0, 8, 22, 36, 44):
        s = float(nodes.points.s[k])
        edge = [
            p + s * t for p, t in zip(piece.start, piece.tangent, strict=True)
        ]  # a straight edge
        theta, phi = float(group.theta[k]), float(group.phi[k])
        value = mpmath.mpf(getattr(flank.settings, setting))

        def along(p, k=k, edge=edge, theta=theta, phi=phi):
            moved = replace(flank.settings, **{setting: p})
            r = carried(
                moved,
                [mpmath.mpf(float(e)) for e in edge],
                mpmath.mpf(theta),
                mpmath.mpf(phi),
                mpmath,
            )
            return sum(mpmath.mpf(float(n)) * x for n, x in zip(nodes.own[1][k], r, strict=True))

        exact = float(mpmath.diff(along, value))
        assert sign * column[k] == pytest.approx(exact, rel=1e-9, abs=1e-11)


@pytest.mark.parametrize("name", NAMES)
def test_the_linear_answer_is_off_by_second_order_only(bench, name):
    """Halve the step and the difference from cutting anew falls to a quarter."""
    response = bench(name, "pinion").responses[0]
    J = response.sensitivity(["machine_root_angle"])[:, 0]

    def off(h):
        return np.abs(flat(response.cut({"machine_root_angle": h})) - J * h).max()

    assert off(2e-3) / off(1e-3) == pytest.approx(4.0, rel=0.05)


@pytest.mark.parametrize(("name", "member"), EVERY)
def test_quick_cutting_is_the_pair_built_anew(bench, name, member):
    """What corrections are judged by is the flank that the generator cuts from the moved dials, at the same places."""
    one = bench(name, member)
    for response in one.responses:
        setup = response.setup
        steps = {n: 0.3 * setup.adjustments[n].reach for n in setup.defaults}
        quick = response.cut(steps)
        for side in setup.sides:
            nodes = one.grid.flanks[side]
            cut = nodes.points.position * nodes.flank.hand + quick[side][:, None] * nodes.own[1]
            radius = np.hypot(cut[:, 0], cut[:, 1])
            again = setup.recut(side, steps).at(cut[:, 2], radius)
            assert again.ok.all() or (again.status <= 1).all()
            assert np.abs(again.position * nodes.flank.hand - cut).max() < 1e-8


def test_sliding_base_and_point_radius_do_the_same_to_a_straight_blades_flank(bench):
    """dr_p = -/+ tan(psi) dE_s leaves the flank as it is (notes on lin1996, exact null directions)."""
    for response in bench("lin-tsay-fong-1996", "pinion").responses:
        side = response.setup.sides[0]
        blade = response.setup.adjustments[f"{side}.blade_angle"].value
        base, radius = response.sensitivity(["sliding_base", f"{side}.point_radius"]).T
        ratio = base @ radius / (radius @ radius)
        assert abs(ratio) == pytest.approx(tan(blade), rel=1e-9)
        assert np.abs(base - ratio * radius).max() < 1e-10


def test_cradle_angle_is_a_turn_of_the_part_under_a_plain_roll(bench):
    """Exact null direction with the index (notes on lin1996)."""
    one = bench("gonzalez-fuentes-2022", "wheel")
    (response,) = one.responses
    column = response.sensitivity(["cradle_angle"])[:, 0]
    lever = np.concatenate([one.grid.flanks[s].lever for s in response.setup.sides])
    turn = lever @ column / (lever @ lever)
    assert np.abs(column - turn * lever).max() < 1e-9 * np.abs(column).max()
