"""A blank that is given, not designed: the numbers of a drawing or a paper's table.

Pitch angles and cone distances are taken as they stand; how nearly the two pitch cones then touch
is kept in ``PairBlank.tangency_residual``. What the numbers do not say (thickness, top land, end
spiral angles) is None.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, pi, sin, tan

from hypoid.geometry import DesignError, Problem

from ._blank import Hand, MemberBlank, Name, PairBlank
from ._pitch_cones import PitchCones, pitch_cones, tangency


@dataclass(frozen=True)
class GivenBlank:
    """One member's blank as a drawing gives it; mm and rad."""

    pitch_angle: float
    outer_cone_distance: float
    face_width: float
    mean_spiral_angle: float
    outer_addendum: float
    face_angle: float
    outer_dedendum: float | None = None  # None, with root_angle: as the cutter cuts
    root_angle: float | None = None
    outer_face_width: float | None = None  # mean point to heel; None: half the face width

    @property
    def outer_share(self) -> float:
        """Face width from the mean point to the heel, mm."""
        return 0.5 * self.face_width if self.outer_face_width is None else self.outer_face_width

    @property
    def mean_cone_distance(self) -> float:
        """Cone distance of the mean point, mm."""
        return self.outer_cone_distance - self.outer_share


def crown_point(
    outside_diameter: float, pitch_apex_to_crown: float, pitch_angle: float
) -> tuple[float, float]:
    """Outer cone distance and outer addendum, mm, of a heel tip given by its place on the blank."""
    z, rho = pitch_apex_to_crown, 0.5 * outside_diameter
    c, s = cos(pitch_angle), sin(pitch_angle)
    return z * c + rho * s, rho * c - z * s


def given_pair_blank(
    *,
    shaft_angle: float,
    offset: float,
    teeth: tuple[int, int],
    pinion: GivenBlank,
    wheel: GivenBlank,
    pinion_hand: Hand,
) -> PairBlank:
    """Blank of a pair from both members' numbers; mm and rad.

    Raises
    ------
    DesignError
        With every number that leaves no blank.
    """
    problems = [*_faults("pinion", pinion), *_faults("wheel", wheel)]
    if problems:
        raise DesignError(problems)
    radius, mate = (one.mean_cone_distance * sin(one.pitch_angle) for one in (wheel, pinion))
    # The pitch point lies on both cones (ISO 23509, (113) and (114)).
    reach = radius + mate * cos(wheel.pitch_angle) / cos(pinion.pitch_angle)
    reach *= min(1.0, cos(pinion.pitch_angle) / sin(shaft_angle))
    if not abs(offset) < reach:
        expected = f"less than {reach:.4g} mm: no pitch point lies on both cones"
        raise DesignError(
            [Problem("pair.offset", f"{offset:g} mm", expected, f'offset = "{0.2 * reach:.3g} mm"')]
        )
    cones = pitch_cones(
        shaft_angle=shaft_angle,
        offset=offset,
        teeth=teeth,
        pinion_pitch_angle=pinion.pitch_angle,
        wheel_pitch_angle=wheel.pitch_angle,
        pinion_spiral_angle=pinion.mean_spiral_angle,
        wheel_spiral_angle=wheel.mean_spiral_angle,
        pinion_mean_radius=mate,
        wheel_mean_radius=radius,
    )
    opposite: Hand = "right" if pinion_hand == "left" else "left"
    outer_diameter = 2.0 * wheel.outer_cone_distance * sin(wheel.pitch_angle)
    touching = tangency(shaft_angle, wheel.pitch_angle, cones.wheel_azimuth)
    return PairBlank(
        shaft_angle=shaft_angle,
        offset=offset,
        mean_normal_module=cones.mean_normal_module,
        outer_transverse_module=outer_diameter / teeth[1],
        limit_pressure_angle=cones.limit_pressure_angle,
        slope_angle=0.0,
        pressure_angle=None,
        working_depth=None,
        clearance=None,
        cones=cones,
        depths=None,
        face_and_root=None,
        pinion=_member("pinion", teeth[0], pinion_hand, pinion, cones),
        wheel=_member("wheel", teeth[1], opposite, wheel, cones),
        outer_pinion_readings=None,
        ratio_residual=None,
        alignment_residual=None,
        tangency_residual=pinion.pitch_angle - touching.pinion_pitch_angle,
    )


def with_root_line(blank: MemberBlank, mean_dedendum: float, root_angle: float) -> MemberBlank:
    """The same blank with the root cone that its cutters make (mm, rad)."""
    slope = tan(blank.pitch_angle - root_angle)
    outer, inner = blank.outer_face_width, blank.inner_face_width
    return replace(
        blank,
        mean_dedendum=mean_dedendum,
        outer_dedendum=mean_dedendum + slope * outer,
        inner_dedendum=mean_dedendum - slope * inner,
        root_angle=root_angle,
        root_apex_beyond_crossing_point=_apex(blank, -mean_dedendum, root_angle),
    )


def _member(
    name: Name, teeth: int, hand: Hand, given: GivenBlank, cones: PitchCones
) -> MemberBlank:
    first = name == "pinion"
    delta, distance, outer = given.pitch_angle, given.mean_cone_distance, given.outer_share
    inner = given.face_width - outer
    taper = tan(given.face_angle - delta)
    addendum = given.outer_addendum - taper * outer
    nothing = float("nan")  # until the cutters say
    blank = MemberBlank(
        name=name,
        teeth=teeth,
        hand=hand,
        pitch_angle=delta,
        mean_spiral_angle=given.mean_spiral_angle,
        mean_pitch_diameter=2.0 * distance * sin(delta),
        outer_pitch_diameter=2.0 * given.outer_cone_distance * sin(delta),
        inner_pitch_diameter=2.0 * (distance - inner) * sin(delta),
        mean_cone_distance=distance,
        outer_cone_distance=given.outer_cone_distance,
        inner_cone_distance=distance - inner,
        face_width=given.face_width,
        outer_face_width=outer,
        inner_face_width=inner,
        pitch_apex_beyond_crossing_point=(
            cones.pinion_apex_beyond_crossing if first else cones.wheel_apex_beyond_crossing
        ),
        face_apex_beyond_crossing_point=nothing,
        root_apex_beyond_crossing_point=nothing,
        mean_addendum=addendum,
        mean_dedendum=nothing,
        outer_addendum=given.outer_addendum,
        outer_dedendum=nothing,
        inner_addendum=addendum - taper * inner,
        inner_dedendum=nothing,
        face_angle=given.face_angle,
        root_angle=nothing,
        outer_spiral_angle=None,
        inner_spiral_angle=None,
        thickness=None,
        top_land=None,
    )
    apex = _apex(blank, addendum, given.face_angle)
    blank = replace(blank, face_apex_beyond_crossing_point=apex)
    if given.outer_dedendum is None or given.root_angle is None:
        return blank
    mean = given.outer_dedendum - tan(delta - given.root_angle) * outer
    return with_root_line(blank, mean, given.root_angle)


def _apex(blank: MemberBlank, height: float, angle: float) -> float:
    """How far beyond the crossing point a cone through (R_m, height) has its apex, mm."""
    z, rho = blank.position(blank.mean_cone_distance, height)
    return rho / tan(angle) - z


def _faults(name: Name, given: GivenBlank) -> list[Problem]:
    found: list[Problem] = []

    def wrong(key: str, shown: str, expected: str, example: str) -> None:
        found.append(Problem(f"{name}.blank.{key}", shown, expected, f'{key} = "{example}"'))

    if not 0.0 < given.pitch_angle < pi / 2:
        shown = f"{given.pitch_angle * 180 / pi:.6g} deg"
        wrong("pitch_angle", shown, "an angle between 0 and 90 deg", "22 deg 4 min")
    if not 0.0 < given.face_width < given.outer_cone_distance:
        wrong(
            "face_width",
            f"{given.face_width:g} mm",
            f"a face narrower than the outer cone distance of {given.outer_cone_distance:.5g} mm",
            f"{0.3 * given.outer_cone_distance:.3g} mm",
        )
    elif not 0.0 < given.outer_share < given.face_width:
        wrong(
            "outer_face_width",
            f"{given.outer_share:g} mm",
            f"less than the face width of {given.face_width:g} mm: the mean point lies on the face",
            f"{0.5 * given.face_width:.3g} mm",
        )
    return found
