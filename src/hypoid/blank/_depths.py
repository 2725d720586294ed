"""Tooth depths at the mean point and at both ends: ISO 23509, clauses 7.3 and 7.7."""

from __future__ import annotations

from dataclasses import dataclass
from math import tan


@dataclass(frozen=True)
class DepthFactors:
    """Tooth data of type I, in mean normal modules (ISO 23509, table 3)."""

    addendum: float  # k_hap
    dedendum: float  # k_hfp
    profile_shift: float  # x_hm1, positive when the pinion has the longer addendum


@dataclass(frozen=True)
class MeanDepths:
    """Depths at the mean point, mm; pairs are (pinion, wheel)."""

    working_depth: float  # h_mw
    clearance: float  # c
    whole_depth: float  # h_m
    addendum: tuple[float, float]  # h_am1, h_am2
    dedendum: tuple[float, float]  # h_fm1, h_fm2


@dataclass(frozen=True)
class EndDepths:
    """Depths of one member at heel and toe, mm."""

    outer_addendum: float  # h_ae
    outer_dedendum: float  # h_fe
    inner_addendum: float  # h_ai
    inner_dedendum: float  # h_fi


def depth_factors(
    *, mean_addendum_factor: float, depth_factor: float, clearance_factor: float
) -> DepthFactors:
    """Type I factors from type II: c_ham, k_d, k_c (ISO 23509, table 4)."""
    return DepthFactors(
        addendum=0.5 * depth_factor,
        dedendum=depth_factor * (clearance_factor + 0.5),
        profile_shift=depth_factor * (0.5 - mean_addendum_factor),
    )


def mean_depths(mean_normal_module: float, factors: DepthFactors) -> MeanDepths:
    """Depths at the mean point, mm (ISO 23509, (132)-(139)); m_mn in mm."""
    m_mn, k_hap, k_hfp, x = (
        mean_normal_module,
        factors.addendum,
        factors.dedendum,
        factors.profile_shift,
    )
    return MeanDepths(
        working_depth=2.0 * m_mn * k_hap,
        clearance=m_mn * (k_hfp - k_hap),
        whole_depth=m_mn * (k_hap + k_hfp),
        addendum=(m_mn * (k_hap + x), m_mn * (k_hap - x)),
        dedendum=(m_mn * (k_hfp - x), m_mn * (k_hfp + x)),
    )


def end_depths(
    *,
    mean_addendum: float,
    mean_dedendum: float,
    addendum_angle: float,
    dedendum_angle: float,
    outer_face_width: float,
    inner_face_width: float,
) -> EndDepths:
    """Depths at heel and toe of one member, mm (ISO 23509, (195)-(202)).

    `outer_face_width` (b_e) runs from the mean point to the heel, `inner_face_width` (b_i) to the
    toe, both along the pitch cone, mm; theta_a and theta_f in rad.
    """
    tan_a, tan_f = tan(addendum_angle), tan(dedendum_angle)
    return EndDepths(
        outer_addendum=mean_addendum + outer_face_width * tan_a,
        outer_dedendum=mean_dedendum + outer_face_width * tan_f,
        inner_addendum=mean_addendum - inner_face_width * tan_a,
        inner_dedendum=mean_dedendum - inner_face_width * tan_f,
    )
