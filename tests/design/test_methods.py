"""Every method by name on every machine that can do it, from a design file's text to the surface."""

from __future__ import annotations

from functools import cache
from math import degrees, factorial, hypot, radians, tan
from typing import Any

import numpy as np
import pytest
from sheets import CAM_463, GRINDER, TILT_106, TILT_122, Changes, built

from hypoid.cli._settings import settings_tables
from hypoid.flank import Flank, flank_angles
from hypoid.machine import Motions, chain
from hypoid.pair import GearPair

HELICAL = {"gleason-122": [41, 71, 73, 84], "gleason-106": [88, 57, 97, 79]}
TILTED = {"gleason-122": "22 deg 50 min", "gleason-106": "246 deg 39 min"}
TILT_HEAD = ("generated", "formate", "tilt", "duplex", "helical-duplex")


def on_tilt_head(method: str, dials: dict[str, Any]) -> dict[str, Any]:
    """A member's settings on a No. 106 or No. 122."""
    dials = {"method": method, **dials}
    if method == "formate":
        del dials["ratio_gears"]
    if method == "tilt":
        swivel = TILTED[dials["machine"]]
        dials |= {"cutter_spindle_rotation_angle": "1 deg 56 min", "swivel_angle": swivel}
    if method == "helical-duplex":
        dials |= {"helical_gears": HELICAL[dials["machine"]], "helical_direction": -1}
    return dials


ON_WHEEL_463 = CAM_463 | {
    "cradle_angle": "325 deg 32 min", "machine_root_angle": "21 deg 18 min", "cam_number": 29,
    "cam_setting": "74.33 mm", "cam_guide_angle": "0 deg", "index_gears": [42, 70, 45, 84],
    "index_interval": 9,
}  # fmt: skip
PAIRS: dict[str, Changes] = {
    **{
        f"{method} on 122 and 106": {
            "pinion.settings": on_tilt_head(method, TILT_122),
            "wheel.settings": on_tilt_head(method, TILT_106),
        }
        for method in TILT_HEAD
    },
    "modified-roll and duplex on 463": {
        "pinion.settings": {"method": "modified-roll", **CAM_463},
        "wheel.settings": {"method": "duplex", **ON_WHEEL_463},
        "machine.gleason-463": GRINDER,
    },
    "modified-roll on basic, generated on 463": {
        "pinion.settings.method": "modified-roll",
        "pinion.settings.roll_2c": -0.03,
        "wheel.settings": {"method": "generated", **ON_WHEEL_463},
        "machine.gleason-463": GRINDER,
    },
    "helixform and generated on basic": {
        "pinion.settings": {
            "method": "helixform", "radial_distance": "128.41 mm", "cradle_angle": "52 deg 53 min",
            "machine_root_angle": "20 deg 26 min", "cutter_lead": "0.8 mm/rad",
        },
    },
}  # fmt: skip


@cache
def pair_of(name: str) -> GearPair:
    return built(PAIRS[name])


def position(flank: Flank) -> Any:
    distance = np.linspace(flank.toe, flank.heel, 5)
    return flank.at_cone(*np.meshgrid(distance, [-2.0, 0.0, 3.0])).position


def as_basic(printed: dict[str, Any], method: str) -> dict[str, Any]:
    """Settings of a basic machine from what `hypoid settings --json` prints of a flank."""
    units = {"_mm_per_rad": " mm/rad", "_mm": " mm", "_deg": " deg"}
    settings: dict[str, Any] = {"method": method, "machine": "basic"}
    for name, value in printed.items():
        end = next((end for end in units if name.endswith(end)), "")
        if name not in ("roll_to_blade_ratio", "generated", "work_roll") and value not in (0.0, []):
            settings[name.removesuffix(end)] = f"{value!r}{units[end]}" if end else value
    return settings


def basic_of(pair: GearPair, method: str) -> GearPair:
    """The same pair from its printed basic settings, flank by flank unless both share them."""
    changes: dict[str, Any] = {}
    for member, sides in settings_tables(pair).items():
        settings = {side: as_basic(printed, method) for side, printed in sides.items()}
        assert settings["concave"] == settings["convex"]
        changes[f"{member}.settings"] = settings["concave"]
    return built(changes)


@pytest.mark.parametrize("name", PAIRS)
def test_every_method_cuts_its_flanks(name: str) -> None:
    pair = pair_of(name)
    assert pair.faults == ()
    for flank in pair.flanks():
        found = flank_angles(flank)
        assert degrees(found.pressure) == pytest.approx(20.0, abs=3.0)
        assert degrees(found.spiral) == pytest.approx(35.0, abs=3.0)
        assert np.isfinite(position(flank)).all()


@pytest.mark.parametrize("method", TILT_HEAD)
def test_dials_and_their_printed_basic_settings_are_one_surface(method: str) -> None:
    pair = pair_of(f"{method} on 122 and 106")
    for dialled, basic in zip(pair.flanks(), basic_of(pair, method).flanks(), strict=True):
        assert np.abs(position(dialled) - position(basic)).max() < 1e-9


def test_printed_series_of_a_cam_as_2c_6d_24e_120f_is_nearly_its_surface() -> None:
    """2C = -2! c2, 6D = -3! c3, ...; a wrong sign or factorial of any moves the pinion by 0.15 um or more."""
    pair = pair_of("modified-roll and duplex on 463")
    changes: dict[str, Any] = {}
    for member, sides in settings_tables(pair).items():
        settings = as_basic(sides["concave"], "modified-roll")
        series = enumerate(settings.pop("modified_roll")[:4], start=2)
        names = ("roll_2c", "roll_6d", "roll_24e", "roll_120f")
        settings |= {names[n - 2]: -factorial(n) * c for n, c in series}
        changes[f"{member}.settings"] = settings
    for dialled, basic in zip(pair.flanks(), built(changes).flanks(), strict=True):
        left = 2e-5 if dialled.member == "pinion" else 2e-4  # the wheel's cam stands further out
        assert np.abs(position(dialled) - position(basic)).max() < left


def test_no_two_methods_are_one_surface() -> None:
    places = [position(pair_of(name).pinion.concave) for name in PAIRS]
    places.pop(3)  # duplex is a plain generated flank, cut with its mate
    for k, place in enumerate(places):
        assert all(np.abs(place - other).max() > 1e-3 for other in places[:k])


@pytest.mark.parametrize(
    "name", [n for n in PAIRS if "duplex" in n or n.startswith("generated on")]
)
def test_one_setting_and_one_head_cut_both_flanks(name: str) -> None:
    wheel = pair_of(name).wheel
    assert wheel.concave.settings == wheel.convex.settings
    assert wheel.heads["concave"] is wheel.heads["convex"]


def test_formate_is_the_cutter_itself_and_the_cradle_stands_still() -> None:
    """Points of the flank, back in the cutter frame, lie on the cone of the blade's edge."""
    pair = pair_of("formate on 122 and 106")
    for flank in pair.flanks():
        settings = flank.settings
        assert not settings.generated
        assert np.array_equal(chain(settings, 0.3, 0.0), chain(settings, 0.3, 0.4))
        points = position(flank) * ([1.0, -1.0, 1.0] if flank.mirrored else 1.0)
        back = np.linalg.inv(chain(settings, 0.0, 0.0))
        side, angle = (1.0, 19.0) if flank.side == "concave" else (-1.0, 21.0)
        for x, y, z, _ in (back @ [*point, 1.0] for point in points):
            cone = 125.0 + side * (1.2 - z * tan(radians(angle)))
            assert hypot(x, y) == pytest.approx(cone, abs=1e-9)


def test_motions_of_every_axis_reach_the_chain() -> None:
    """The sheet's blank offset has the other sign than the chain's."""
    pair = built(
        {
            "pinion.settings.motions": {
                "radial_distance": ["1 mm/rad", "300 um/rad^2"],
                "tilt_angle": [0.02],
                "swivel_angle": [0.03, 0.01],
                "blank_offset": ["0.5 mm/rad", "-0.4 mm/rad^2"],
                "machine_root_angle": [0.02, 0.0, 0.01],
                "machine_center_to_back": ["0.6 mm/rad"],
                "sliding_base": ["0.3 mm/rad", "0.8 mm/rad^2", "-0.2 mm/rad^3"],
            }
        }
    )
    for flank in (pair.pinion.concave, pair.pinion.convex):
        assert np.isfinite(position(flank)).all()
        assert flank.settings.motions == Motions(
            radial_distance=(1.0, 0.3),
            tilt_angle=(0.02,),
            swivel_angle=(0.03, 0.01),
            blank_offset=(-0.5, 0.4),
            machine_root_angle=(0.02, 0.0, 0.01),
            machine_center_to_back=(0.6,),
            sliding_base=(0.3, 0.8, -0.2),
        )


def test_half_a_turn_of_the_spindle_tilts_by_twice_the_wedge() -> None:
    """sin(i/2) = sin(15 deg) sin(psi_t/2): no dial reads a tilt beyond 30 deg."""
    half = {"pinion.settings.cutter_spindle_rotation_angle": "180 deg"}
    settings = built(PAIRS["tilt on 122 and 106"], half).pinion.concave.settings
    assert degrees(settings.tilt_angle) == pytest.approx(30.0, abs=1e-12)
