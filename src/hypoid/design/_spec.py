"""What is asked of the program: a design file's content as numbers, in mm and rad."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

Hand = Literal["left", "right"]
SettingValue = float | tuple[float, ...]


@dataclass(frozen=True)
class Assumption:
    """A value that the source does not give, and why it was chosen; told apart in every output."""

    value: str  # path in the design file
    reason: str


@dataclass(frozen=True)
class TipRelief:
    """Parabolic relief of the blade near its root, which relieves the tip of the tooth."""

    coefficient: float  # 1/mm, a_tr: depth of relief per square of distance along the edge
    height: float  # mm, h_tr
    measured_from: Literal["tip", "pitch"]  # where h_tr starts; the 2022 paper does not say
    flanks: Literal["drive", "coast", "both"]


@dataclass(frozen=True)
class BodySpec:
    """What carries a member's teeth, as far as it is given; mm."""

    bore_diameter: float | None = None
    mounting_distance: float | None = None  # crossing point to back face, along the axis
    tip_rounding: float = 0.0  # radius between flank and top land
    held: Literal["bore", "back"] | None = None  # face that does not move on its shaft
    # Shaft and bearings, see `bearing_compliance`; N/mm, N, N mm/rad. None: rigid.
    stiffness: tuple[tuple[float, ...], ...] | None = None


@dataclass(frozen=True)
class ExactFaceHobbedSpec:
    """A pair to be cut by the exact system of generation (Gonzalez-Perez & Fuentes-Aznar 2022)."""

    title: str
    source: str
    assumed: tuple[Assumption, ...]
    shaft_angle: float  # rad, Sigma
    offset: float  # mm, a
    pinion_teeth: int  # z1
    wheel_teeth: int  # z2
    pinion_hand: Hand
    pinion_spiral_angle: float  # rad, beta_m1
    wheel_mean_radius: float  # mm, r_m2
    wheel_face_width: float  # mm, b2
    mean_addendum_factor: float  # c_ham
    depth_factor: float  # k_d
    clearance_factor: float  # k_c
    cutter_radius: float  # mm, r_c0
    blade_groups: int  # z0
    pressure_angle: float  # rad, of both blades
    tip_edge_radius_factor: float  # r_t / m_mn
    tip_relief: TipRelief | None
    marking_thickness: float  # mm, of the virtual marking compound
    # Between the axes of the outer and the inner blades of a two-part head (Cyclo-Palloid), mm, and
    # how much of it moves the outer ones.
    eccentricity: float = 0.0
    outer_share: float = 0.5
    # By flank, "pinion.concave" and so on: the settings that the file gives, in mm and rad, by
    # their field's names; the program designs the rest.
    setting_changes: Mapping[str, Mapping[str, SettingValue]] = field(
        default_factory=dict[str, Mapping[str, SettingValue]]
    )
    bodies: Mapping[str, BodySpec] = field(default_factory=dict[str, BodySpec])  # by member
