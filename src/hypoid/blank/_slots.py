"""Slot widths, blade points and top lands along the face: AGMA 929-B22, clauses 4.1 to 4.5 and 4.7.

Places are given by their cone distance in place of the standard's range variable mu. The spur gear that
stands for the normal section is the standard's, r / (cos delta cos**2 beta); the exact flanks have the
last word.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, asin, cos, pi, sin, sqrt, tan
from typing import Literal

from hypoid.geometry import DesignError, Problem

from ._blank import PairBlank
from ._spiral_angles import CrownGearTooth

Process = Literal["completing", "rough-and-finish"]
BLADE_RESERVE = 0.025  # mm that a completing blade passes the middle of the slot (94), (95)


@dataclass(frozen=True)
class SlotGeometry:
    """What AGMA 929 takes of a pair; mm and rad, pairs are (pinion, wheel)."""

    teeth: tuple[int, int]
    mean_normal_module: float
    pitch_angles: tuple[float, float]
    mean_cone_distances: tuple[float, float]
    outer_cone_distances: tuple[float, float]
    face_widths: tuple[float, float]
    offset_angle: float  # zeta_mp
    dedendum_angles: tuple[float, float]
    addenda: tuple[float, float]  # h_am
    dedenda: tuple[float, float]  # h_fm
    clearance: float
    thicknesses: tuple[float, float]  # s_mn, backlash taken off
    pressure_angles: tuple[float, float]  # of pinion concave (drive) and pinion convex, positive
    tooth: CrownGearTooth
    wheel_generated: bool = True
    wheel_blade_angle: float | None = None  # form-cut wheel: inside blade, alpha_BX2
    rotation_factor: float = 0.0  # k_E: 0 for spread blades, 1 for face hobbing (65)-(68)

    @property
    def pitch(self) -> float:
        """Mean normal circular pitch p_n, mm (50)."""
        return pi * self.mean_normal_module

    @property
    def flare(self) -> float:
        """Widening of a slot per mm of depth: the sum of both pressure angles' tangents."""
        return sum(tan(angle) for angle in self.pressure_angles)

    @property
    def half_angle(self) -> float:
        """Half the included pressure angle, rad (49)."""
        return 0.5 * sum(self.pressure_angles)

    @property
    def inner_cone_distances(self) -> tuple[float, float]:
        """Cone distances of the toes, mm."""
        outer, width = self.outer_cone_distances, self.face_widths
        return outer[0] - width[0], outer[1] - width[1]

    @property
    def pitch_plane_offset(self) -> float:
        """a_p, mm (15)."""
        return self.mean_cone_distances[1] * sin(self.offset_angle)

    def crown(self, pinion_distance: float) -> float:
        """Wheel cone distance of a pinion cone distance, mm (16)."""
        r_m2, along = self.mean_cone_distances[1], pinion_distance - self.mean_cone_distances[0]
        return sqrt(r_m2**2 + along**2 + 2.0 * r_m2 * along * cos(self.offset_angle))

    def pinion_distance(self, crown: float) -> float:
        """Pinion cone distance of a wheel cone distance, mm (55)."""
        r_m1, r_m2 = self.mean_cone_distances
        turn = asin(self.pitch_plane_offset / crown)
        return r_m1 + crown * cos(turn) - r_m2 * cos(self.offset_angle)

    def pinion_spiral(self, crown: float) -> float:
        """Pinion spiral angle at a wheel cone distance, rad (34)."""
        return self.tooth.spiral_angle(crown) + asin(self.pitch_plane_offset / crown)

    def share(self, crown: float, of: float) -> float:
        """Normal pitch at a wheel cone distance over that at another."""
        spiral = self.tooth.spiral_angle
        return crown * cos(spiral(crown)) / (of * cos(spiral(of)))

    @property
    def backlash(self) -> float:
        """Outer normal backlash j_en that the thicknesses leave, mm (51)."""
        r_m2, r_e2 = self.mean_cone_distances[1], self.outer_cone_distances[1]
        return (self.pitch - sum(self.thicknesses)) * self.share(r_e2, r_m2) * cos(self.half_angle)

    def pinion_dedendum(self, crown: float) -> float:
        """Pinion dedendum at a wheel cone distance, mm (58)."""
        along = self.pinion_distance(crown) - self.mean_cone_distances[0]
        return self.dedenda[0] + along * tan(self.dedendum_angles[0])

    def wheel_dedendum(self, crown: float) -> float:
        """Wheel dedendum at a wheel cone distance, mm (59), (60): a form cutter's root is a plane's."""
        along = crown - self.mean_cone_distances[1]
        depth = self.dedenda[1] + along * tan(self.dedendum_angles[1])
        return depth if self.wheel_generated else depth - self.lift(crown)

    def lift(self, crown: float) -> float:
        """What the plane root of a form-cut slot lacks against the root cone, mm (57)."""
        tooth = self.tooth

        def cradle(distance: float) -> float:
            rho, r_c0 = tooth.centre_distance, tooth.cutter_radius
            return acos((distance**2 + rho**2 - r_c0**2) / (2.0 * distance * rho))

        r_m2 = self.mean_cone_distances[1]
        root = self.pitch_angles[1] - self.dedendum_angles[1]
        blade = self.wheel_blade_angle
        tilt = 0.0 if blade is None else blade - self.pressure_angles[0]
        across = (crown - r_m2) ** 2 * tan(tilt)
        bent = across / (2.0 * tooth.cutter_radius * cos(tooth.mean_spiral_angle) ** 2)
        turn = cradle(r_m2) - cradle(crown)
        return bent + crown * sin(turn) ** 2 / (2.0 * tan(root))

    @property
    def mean_wheel_slot(self) -> float:
        """W_m2, mm (64)."""
        middle = self.mean_cone_distances[1]
        depth = self.pinion_dedendum(middle) + self.wheel_dedendum(middle)
        lower = (self.addenda[0] - self.addenda[1]) * tan(self.half_angle)
        return self.pitch - self.thicknesses[1] - 0.5 * depth * self.flare - lower

    def wheel_slot(self, crown: float) -> float:
        """Width of the wheel's slot at its root, mm (72)-(75)."""
        c = self.share(crown, self.mean_cone_distances[1])
        held = self.mean_wheel_slot - 0.5 * self.rotation_factor * self.pitch
        own = self.thicknesses[0] - self.dedenda[1] * self.flare
        return held * (1.0 - c) + c * own + self._play(crown)

    def pinion_slot(self, crown: float) -> float:
        """Width of the pinion's slot at its root at a wheel cone distance, mm (76)."""
        pitch = self.share(crown, self.mean_cone_distances[1]) * self.pitch
        depth = self.pinion_dedendum(crown) + self.wheel_dedendum(crown)
        return pitch - depth * self.flare - self.wheel_slot(crown) + self._play(crown)

    def _play(self, crown: float) -> float:
        """Backlash at a wheel cone distance, in the plane of the normal pitch, mm."""
        at = self.share(crown, self.outer_cone_distances[1])
        return at * self.backlash / cos(self.half_angle)

    @property
    def ends(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Wheel cone distances of toe, mean point and heel: of the pinion, of the wheel; mm."""
        inner, middle, outer = (
            self.inner_cone_distances, self.mean_cone_distances, self.outer_cone_distances,
        )  # fmt: skip
        pinion = self.crown(inner[0]), middle[1], self.crown(outer[0])
        return pinion, (inner[1], middle[1], outer[1])

    @property
    def slots(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Slot widths at toe, mean point and heel, pinion and wheel, mm (77)-(81)."""
        a, b, c = (self.pinion_slot(crown) for crown in self.ends[0])
        d, e, f = (self.wheel_slot(crown) for crown in self.ends[1])
        return (a, b, c), (d, e, f)

    def blade_points(
        self, process: Process = "completing", stock: tuple[float, float] = (0.0, 0.0)
    ) -> tuple[float, float]:
        """Blade points W_B of pinion and wheel, mm (94)-(97).

        Completing: the least that cuts the slot; rough and finish: the greatest that enters it, with
        the stock allowance taken off.
        """
        least = [min(widths) for widths in self.slots]
        if process == "completing":
            return 0.5 * least[0] + BLADE_RESERVE, 0.5 * least[1] + BLADE_RESERVE
        return least[0] - stock[0], least[1] - stock[1]

    def top_lands(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Normal top lands at toe, mean point and heel, pinion and wheel, mm (164)-(182).

        A form-cut wheel's tooth has straight sides (182); its pinion is taken as a generated wheel's,
        since (180) could not be checked.
        """
        a, b, c = (self._pinion_land(crown) for crown in self.ends[0])
        d, e, f = (self._wheel_land(crown) for crown in self.ends[1])
        return (a, b, c), (d, e, f)

    def _pinion_land(self, crown: float) -> float:
        distance, beta = self.pinion_distance(crown), self.pinion_spiral(crown)
        radius = distance * tan(self.pitch_angles[0]) / cos(beta) ** 2
        outer = self.crown(self.outer_cone_distances[0])
        end = self.outer_cone_distances[0] * cos(self.pinion_spiral(outer))
        play = distance * cos(beta) / end * self.backlash / cos(self.half_angle)
        depth = self.wheel_dedendum(crown)
        thickness = depth * self.flare + self.wheel_slot(crown) - play
        return self._land(radius, thickness, depth - self.clearance)

    def _wheel_land(self, crown: float) -> float:
        radius = crown * tan(self.pitch_angles[1]) / cos(self.tooth.spiral_angle(crown)) ** 2
        depth = self.pinion_dedendum(crown)
        thickness = depth * self.flare + self.pinion_slot(crown) - self._play(crown)
        if not self.wheel_generated:
            return thickness - (depth - self.clearance) * self.flare
        return self._land(radius, thickness, depth - self.clearance)

    def _land(self, radius: float, thickness: float, addendum: float) -> float:
        """Top land of involute sides of both pressure angles, mm (173)-(181)."""
        tip, narrowing = radius + addendum, thickness / radius
        for angle in self.pressure_angles:
            at_tip = acos(min(1.0, radius * cos(angle) / tip))
            narrowing += (tan(angle) - angle) - (tan(at_tip) - at_tip)
        return narrowing * tip


def slot_geometry(
    blank: PairBlank,
    tooth: CrownGearTooth,
    *,
    wheel_generated: bool = True,
    wheel_blade_angle: float | None = None,
    rotation_factor: float = 0.0,
) -> SlotGeometry:
    """What AGMA 929 takes, from a designed blank.

    Raises
    ------
    DesignError
        For a blank that is given, not designed: it has no depths and thicknesses.
    """
    depths, one, two = blank.depths, blank.pinion, blank.wheel
    if depths is None or one.thickness is None or two.thickness is None:
        expected = "a blank that the program designs, with its depths and thicknesses"
        raise DesignError([Problem("blank", "a blank as drawn", expected, "[blank]")])
    own = blank.pressure_angles
    angle = blank.pressure_angle or 0.0
    return SlotGeometry(
        teeth=blank.cones.teeth,
        mean_normal_module=blank.mean_normal_module,
        pitch_angles=(one.pitch_angle, two.pitch_angle),
        mean_cone_distances=(one.mean_cone_distance, two.mean_cone_distance),
        outer_cone_distances=(one.outer_cone_distance, two.outer_cone_distance),
        face_widths=(one.face_width, two.face_width),
        offset_angle=blank.cones.offset_angle_pitch_plane,
        dedendum_angles=(one.dedendum_angle, two.dedendum_angle),
        addenda=depths.addendum,
        dedenda=depths.dedendum,
        clearance=depths.clearance,
        thicknesses=(one.thickness.mean_normal, two.thickness.mean_normal),
        pressure_angles=(angle, angle) if own is None else (own.drive, own.coast),
        tooth=tooth,
        wheel_generated=wheel_generated,
        wheel_blade_angle=wheel_blade_angle,
        rotation_factor=rotation_factor,
    )
