"""Pinion face width by the four methods: ISO 23509, clause 7.5, (154)-(173).

Each method is a value (a frozen dataclass with `widths`), so that a caller picks one.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, cos, floor, sin, sqrt, tan
from typing import Protocol

from ._cones import FaceAndRootCones
from ._depths import MeanDepths
from ._pitch_cones import PitchCones


@dataclass(frozen=True)
class FaceWidth:
    """Face width of one member, split at the mean point; mm along the pitch cone."""

    width: float  # b
    outer: float  # b_e, mean point to heel
    inner: float  # b_i, mean point to toe


class PinionFaceWidth(Protocol):
    """A way to give the pinion its face width."""

    def widths(self, cones: PitchCones, wheel: FaceWidth) -> FaceWidth:
        """Face width of the pinion that covers the wheel's, mm."""
        ...


def split_face_width(width: float, outer_share: float = 0.5) -> FaceWidth:
    """Split a face width at the mean point; `outer_share` is c_be2."""
    outer = outer_share * width
    return FaceWidth(width, outer, width - outer)


@dataclass(frozen=True)
class EqualFaceWidth:
    """Method 0, no offset: b1 = b2 (154), (155)."""

    def widths(self, cones: PitchCones, wheel: FaceWidth) -> FaceWidth:
        """Face width of the pinion, mm."""
        return wheel


@dataclass(frozen=True)
class GleasonFaceWidth:
    """Method 1: the pinion reaches to both ends of the wheel in the pitch plane (159)-(167)."""

    depths: MeanDepths
    face_and_root: FaceAndRootCones

    def widths(self, cones: PitchCones, wheel: FaceWidth) -> FaceWidth:
        """Face width of the pinion, mm."""
        u = cones.gear_ratio
        delta1, delta2 = cones.pinion_pitch_angle, cones.wheel_pitch_angle
        zeta_mp = abs(cones.offset_angle_pitch_plane)
        theta_a1 = self.face_and_root.addendum_angle[0]
        delta_a1 = self.face_and_root.face_angle[0]
        zeta_r = abs(self.face_and_root.root_plane_offset_angle)
        h_am1, h_fm2 = self.depths.addendum[0], self.depths.dedendum[1]
        lead = atan(  # lambda'
            sin(zeta_mp) * cos(delta2) / (u * cos(delta1) + cos(delta2) * cos(zeta_mp))
        )
        along = wheel.width * cos(lead) / cos(zeta_mp - lead)  # b_reri1
        extra = self.depths.working_depth * sin(zeta_r) * (1.0 - 1.0 / u)
        rise = (h_fm2 - self.depths.clearance) * sin(delta1)
        tilt = cos(delta_a1) / cos(theta_a1)
        c_be2 = wheel.outer / wheel.width
        outer_gap = c_be2 * along * tilt + extra - rise  # g_xe
        inner_gap = (1.0 - c_be2) * along * tilt + extra + rise  # g_xi
        outer = (outer_gap + h_am1 * sin(delta1)) / tilt
        inner = (inner_gap - h_am1 * sin(delta1)) / (cos(delta1) - tan(theta_a1) * sin(delta1))
        return FaceWidth(outer + inner, outer, inner)


@dataclass(frozen=True)
class OerlikonFaceWidth:
    """Method 2: b1 = b2 (1 + tan^2 zeta_mp)."""

    def widths(self, cones: PitchCones, wheel: FaceWidth) -> FaceWidth:
        """Face width of the pinion, mm."""
        width = wheel.width * (1.0 + tan(cones.offset_angle_pitch_plane) ** 2)
        return split_face_width(width, wheel.outer / wheel.width)


@dataclass(frozen=True)
class KlingelnbergFaceWidth:
    """Method 3: the wheel's ends projected on the pinion generatrix, rounded up to whole mm.

    `pitch_plane_offset` stands for a_p where a source reads it otherwise: the 2022 paper's R_e1
    and d_e1 follow with the offset a itself.
    """

    pitch_plane_offset: float | None = None

    def widths(self, cones: PitchCones, wheel: FaceWidth) -> FaceWidth:
        """Face width of the pinion, mm."""
        a_p = self.pitch_plane_offset
        if a_p is None:
            a_p = cones.pitch_plane_offset
        middle = cones.wheel_mean_cone_distance
        along_outer = sqrt((middle + wheel.outer) ** 2 - a_p**2)
        along_middle = sqrt(middle**2 - a_p**2)
        along_inner = sqrt((middle - wheel.inner) ** 2 - a_p**2)
        projected = along_outer - along_inner  # b_p1
        margin = 3.0 * cones.mean_normal_module * abs(tan(cones.offset_angle_pitch_plane))
        width = float(floor(projected + margin + 1.0))
        inner = along_middle - along_inner + 0.5 * (width - projected)  # b_1A + b_x
        return FaceWidth(width, width - inner, inner)
