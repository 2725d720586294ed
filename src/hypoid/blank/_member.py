"""One member's blank from what both members share: end values, thickness, top land."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

from hypoid.geometry import DesignError, Problem

from ._blank import Hand, MemberBlank, Name
from ._cones import FaceAndRootCones
from ._depths import DepthFactors, MeanDepths, end_depths
from ._face_width import FaceWidth
from ._pitch_cones import PitchCones
from ._spiral_angles import CrownGearTooth, EndSpiralAngles
from ._thickness import TopLand, mean_normal_thickness, tooth_thickness, top_land


@dataclass(frozen=True)
class MemberBuilder:
    """What both members share; makes one `MemberBlank` at a time."""

    cones: PitchCones
    depths: MeanDepths
    face_root: FaceAndRootCones
    factors: DepthFactors
    spirals: EndSpiralAngles
    tooth: CrownGearTooth
    pressure_angle: float  # rad
    thickness_factors: tuple[float, float] = (0.0, 0.0)  # x_sm1, x_sm2, backlash taken off

    def member(self, name: Name, hand: Hand, face: FaceWidth) -> MemberBlank:
        """Blank of one member with its face width."""
        i = 0 if name == "pinion" else 1
        cones, face_root = self.cones, self.face_root
        delta = (cones.pinion_pitch_angle, cones.wheel_pitch_angle)[i]
        beta = (cones.pinion_spiral_angle, cones.wheel_spiral_angle)[i]
        r_m = (cones.pinion_mean_radius, cones.wheel_mean_radius)[i]
        big_r = (cones.pinion_mean_cone_distance, cones.wheel_mean_cone_distance)[i]
        apex = (cones.pinion_apex_beyond_crossing, cones.wheel_apex_beyond_crossing)[i]
        outer, inner = big_r + face.outer, big_r - face.inner
        ends = end_depths(
            mean_addendum=self.depths.addendum[i],
            mean_dedendum=self.depths.dedendum[i],
            addendum_angle=face_root.addendum_angle[i],
            dedendum_angle=face_root.dedendum_angle[i],
            outer_face_width=face.outer,
            inner_face_width=face.inner,
        )
        inner_diameter = 2.0 * inner * sin(delta)
        if inner_diameter <= 2.0 * ends.inner_dedendum * cos(delta):
            raise DesignError([_toe_problem(name, face, ends.inner_dedendum, inner * sin(delta))])
        s_mn = mean_normal_thickness(
            cones.mean_normal_module,
            thickness_factor=self.thickness_factors[i],
            profile_shift=self.factors.profile_shift * (1.0, -1.0)[i],
            pressure_angle=self.pressure_angle,
        )
        return MemberBlank(
            name=name,
            teeth=cones.teeth[i],
            hand=hand,
            pitch_angle=delta,
            mean_spiral_angle=beta,
            mean_pitch_diameter=2.0 * r_m,
            outer_pitch_diameter=2.0 * outer * sin(delta),
            inner_pitch_diameter=inner_diameter,
            mean_cone_distance=big_r,
            outer_cone_distance=outer,
            inner_cone_distance=inner,
            face_width=face.width,
            outer_face_width=face.outer,
            inner_face_width=face.inner,
            pitch_apex_beyond_crossing_point=apex,
            face_apex_beyond_crossing_point=face_root.face_apex_beyond_crossing[i],
            root_apex_beyond_crossing_point=face_root.root_apex_beyond_crossing[i],
            mean_addendum=self.depths.addendum[i],
            mean_dedendum=self.depths.dedendum[i],
            outer_addendum=ends.outer_addendum,
            outer_dedendum=ends.outer_dedendum,
            inner_addendum=ends.inner_addendum,
            inner_dedendum=ends.inner_dedendum,
            face_angle=face_root.face_angle[i],
            root_angle=face_root.root_angle[i],
            outer_spiral_angle=self.spirals.outer[i],
            inner_spiral_angle=self.spirals.inner[i],
            thickness=tooth_thickness(
                s_mn,
                pitch_angle=delta,
                spiral_angle=beta,
                mean_pitch_diameter=2.0 * r_m,
                mean_addendum=self.depths.addendum[i],
                pressure_angle=self.pressure_angle,
            ),
            top_land=TopLand(
                outer=self._top_land(i, outer * sin(delta), ends.outer_addendum, s_mn, "outer"),
                mean=self._top_land(i, r_m, self.depths.addendum[i], s_mn, "mean"),
                inner=self._top_land(i, inner * sin(delta), ends.inner_addendum, s_mn, "inner"),
            ),
        )

    def _top_land(self, i: int, radius: float, addendum: float, s_mn: float, place: str) -> float:
        """Top land of member i at heel, mean point or toe, its thickness scaled as the pitch is."""
        cones, spirals = self.cones, self.spirals
        mean = cones.wheel_mean_cone_distance
        if place == "mean":
            beta, crown = (cones.pinion_spiral_angle, cones.wheel_spiral_angle)[i], mean
        else:
            beta = (spirals.outer if place == "outer" else spirals.inner)[i]
            edge = (
                spirals.pinion_outer_boundary if place == "outer" else spirals.pinion_inner_boundary
            )
            crown = edge if i == 0 else radius / sin(cones.wheel_pitch_angle)
        pitch = crown * cos(self.tooth.spiral_angle(crown))
        mean_pitch = mean * cos(cones.wheel_spiral_angle)
        return top_land(
            s_mn * pitch / mean_pitch,
            pitch_radius=radius,
            pitch_angle=(cones.pinion_pitch_angle, cones.wheel_pitch_angle)[i],
            spiral_angle=beta,
            addendum=addendum,
            pressure_angle=self.pressure_angle,
        )


def _toe_problem(name: Name, face: FaceWidth, dedendum: float, radius: float) -> Problem:
    """The teeth are cut through the axis at the toe."""
    return Problem(
        "wheel.face_width",
        f"a {name} face width of {face.width:g} mm",
        f"a toe whose root stays outside the {name} axis (pitch radius there {radius:.4g} mm, "
        f"dedendum {dedendum:.4g} mm); narrow the face or lower blank.depth_factor",
        '"35 mm"',
    )
