"""The blank of a pair: pitch cones, depths, face and root cones, widths and end values."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import cos, sin
from typing import Literal

from ._cones import FaceAndRootCones
from ._depths import MeanDepths
from ._pitch_cones import PitchCones
from ._thickness import MIN_TOP_LAND, ToothThickness, TopLand

Hand = Literal["left", "right"]
Name = Literal["pinion", "wheel"]


class BlankFault(Enum):
    """A blank that can be computed but not used; the value says what to do."""

    POINTED_PINION = (
        "The pinion teeth are pointed or nearly so; lower the depth factor or raise the "
        "mean addendum factor of the wheel."
    )
    POINTED_WHEEL = (
        "The wheel teeth are pointed or nearly so; lower the depth factor or the mean addendum "
        "factor of the wheel."
    )
    NEAR_LIMIT_PRESSURE_ANGLE = (
        "A pressure angle lies within 5 deg of the limit pressure angle, where the flanks lose "
        "contact; change the cutter radius or the pressure angle."
    )


@dataclass(frozen=True)
class MemberBlank:
    """One member's blank; mm and rad. Axial positions are on the member's axis, apex to heel,
    from the crossing point; an apex "beyond crossing" by t lies at z = -t.
    """

    name: Name
    teeth: int
    hand: Hand
    pitch_angle: float  # delta
    mean_spiral_angle: float  # beta_m
    mean_pitch_diameter: float  # d_m
    outer_pitch_diameter: float  # d_e
    inner_pitch_diameter: float  # d_i
    mean_cone_distance: float  # R_m
    outer_cone_distance: float  # R_e
    inner_cone_distance: float  # R_i
    face_width: float  # b
    outer_face_width: float  # b_e, mean point to heel
    inner_face_width: float  # b_i, mean point to toe
    pitch_apex_beyond_crossing_point: float  # t_z
    face_apex_beyond_crossing_point: float  # t_zF
    root_apex_beyond_crossing_point: float  # t_zR
    mean_addendum: float  # h_am
    mean_dedendum: float  # h_fm
    outer_addendum: float  # h_ae
    outer_dedendum: float  # h_fe
    inner_addendum: float  # h_ai
    inner_dedendum: float  # h_fi
    face_angle: float  # delta_a
    root_angle: float  # delta_f
    outer_spiral_angle: float | None  # beta_e
    inner_spiral_angle: float | None  # beta_i
    thickness: ToothThickness | None  # None, as below, where a given blank does not say
    top_land: TopLand | None

    @property
    def addendum_angle(self) -> float:
        """theta_a, rad."""
        return self.face_angle - self.pitch_angle

    @property
    def dedendum_angle(self) -> float:
        """theta_f, rad."""
        return self.pitch_angle - self.root_angle

    @property
    def outer_tip_diameter(self) -> float:
        """d_ae, mm (ISO 23509, (220))."""
        return self.outer_pitch_diameter + 2.0 * self.outer_addendum * cos(self.pitch_angle)

    @property
    def outer_root_diameter(self) -> float:
        """d_fe, mm."""
        return self.outer_pitch_diameter - 2.0 * self.outer_dedendum * cos(self.pitch_angle)

    @property
    def inner_tip_diameter(self) -> float:
        """d_ai, mm."""
        return self.inner_pitch_diameter + 2.0 * self.inner_addendum * cos(self.pitch_angle)

    @property
    def inner_root_diameter(self) -> float:
        """d_fi, mm."""
        return self.inner_pitch_diameter - 2.0 * self.inner_dedendum * cos(self.pitch_angle)

    @property
    def mean_point_position(self) -> float:
        """Axial position t_zm of the mean point, mm (ISO 23509, (131))."""
        axial = self.mean_cone_distance * cos(self.pitch_angle)
        return axial - self.pitch_apex_beyond_crossing_point

    @property
    def outer_crown_position(self) -> float:
        """Axial position t_xo of the outer tip, mm (ISO 23509, (224))."""
        return self.position(self.outer_cone_distance, self.outer_addendum)[0]

    @property
    def inner_crown_position(self) -> float:
        """Axial position t_xi of the inner tip, mm (ISO 23509, (225))."""
        return self.position(self.inner_cone_distance, self.inner_addendum)[0]

    @property
    def axial_section(self) -> tuple[tuple[float, float], ...]:
        """Corners (z, rho), mm, of the toothed zone: toe root, toe tip, heel tip, heel root."""
        return (
            self.position(self.inner_cone_distance, -self.inner_dedendum),
            self.position(self.inner_cone_distance, self.inner_addendum),
            self.position(self.outer_cone_distance, self.outer_addendum),
            self.position(self.outer_cone_distance, -self.outer_dedendum),
        )

    def position(self, cone_distance: float, height: float) -> tuple[float, float]:
        """(z, rho), mm, at (S, H): cone distance along the pitch cone, height towards the tip."""
        sin_delta, cos_delta = sin(self.pitch_angle), cos(self.pitch_angle)
        z = cone_distance * cos_delta - height * sin_delta
        rho = cone_distance * sin_delta + height * cos_delta
        return z - self.pitch_apex_beyond_crossing_point, rho


@dataclass(frozen=True)
class OuterPinionReading:
    """One reading of the pinion's heel: where ISO 23509, clause 7.5, has a_p, or a instead; mm."""

    source: str
    pitch_plane_offset: float  # what stands for a_p
    outer_cone_distance: float  # R_e1
    outer_pitch_diameter: float  # d_e1


@dataclass(frozen=True)
class OuterPinionReadings:
    """Both readings of R_e1 and d_e1. The blank itself uses `conforming`."""

    conforming: OuterPinionReading  # a_p = R_m2 sin zeta_mp, as in the standard
    printed_2022: OuterPinionReading  # the offset a for a_p, as Table 2 of the 2022 paper


@dataclass(frozen=True)
class FlankPressureAngles:
    """Normal pressure angles at P by side, rad: pinion concave with wheel convex is the drive side."""

    drive: float  # alpha_nD, generated
    coast: float  # alpha_nC
    limit: float  # alpha_lim

    @property
    def effective(self) -> tuple[float, float]:
        """alpha_eD, alpha_eC: what is left above the limit pressure angle (ISO 23509, (119), (120))."""
        return self.drive - self.limit, self.coast + self.limit


@dataclass(frozen=True)
class PairBlank:
    """Blanks of a pair; mm and rad."""

    shaft_angle: float
    offset: float
    mean_normal_module: float  # m_mn
    outer_transverse_module: float  # m_et2, m_ot in the 2022 paper
    limit_pressure_angle: float  # alpha_lim, ISO sign
    slope_angle: float  # nu
    pressure_angle: float | None  # nominal, both sides
    working_depth: float | None  # h_mw
    clearance: float | None  # c
    cones: PitchCones
    depths: MeanDepths | None
    face_and_root: FaceAndRootCones | None
    pinion: MemberBlank
    wheel: MemberBlank
    outer_pinion_readings: OuterPinionReadings | None
    ratio_residual: float | None  # mm, condition (1) over z1 + z2
    alignment_residual: float | None  # condition (2) over R_m1 R_m2
    tangency_residual: float = 0.0  # rad, by which the pinion's pitch angle misses tangency
    pressure_angles: FlankPressureAngles | None = None  # None: both are `pressure_angle`

    @property
    def faults(self) -> tuple[BlankFault, ...]:
        """What makes the blank unusable although it computes; empty when nothing does."""
        found: list[BlankFault] = []
        least = MIN_TOP_LAND * self.mean_normal_module
        lands = self.pinion.top_land, self.wheel.top_land
        if lands[0] is not None and lands[0].least < least:
            found.append(BlankFault.POINTED_PINION)
        if lands[1] is not None and lands[1].least < least:
            found.append(BlankFault.POINTED_WHEEL)
        if self.pressure_angles is not None:
            effective = min(self.pressure_angles.effective)
        elif self.pressure_angle is not None:
            effective = self.pressure_angle - abs(self.limit_pressure_angle)
        else:
            effective = NEAR_LIMIT
        if effective < NEAR_LIMIT:
            found.append(BlankFault.NEAR_LIMIT_PRESSURE_ANGLE)
        return tuple(found)


NEAR_LIMIT = 0.08726646259971647  # rad, 5 deg
