"""Random blanks over the practical space, each designed and looked at: the table of the docs.

    python benchmarks/random_blanks.py 320 docs/validation/random-blanks.csv 2

A pair counts as sound where its flanks meet inside at the middle of the mesh, both pinion flanks are
within the tolerance of their targets, and undercut, if there is any, is reported. Every other one ends
with a reason. Each draw has its own seed: the same blanks at every run, and any of them alone.
"""

from __future__ import annotations

import csv
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from math import asin, cos, degrees, radians, sin
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

from hypoid.blank import BlankRequest, TypeII, iso_blank
from hypoid.contact import Sampling, UnloadedContact, to_wheel, unloaded_contact
from hypoid.design import (
    EaseOffTarget,
    ExactFaceHobbedSpec,
    HobbedDesign,
    HobbedRequest,
    MilledRequest,
    StickGrind,
    build,
    design_hobbed,
    design_milled,
)
from hypoid.geometry import DesignError

SEED = 23509
ZEROL = 0.08  # share of spiral angles that are zero
LOOK = Sampling(positions_per_pitch=12, pairs=3, columns=31, rows=15, every_edge=False)
LEADS = 1e-6  # rad by which an edge may lead: less than 0.1 um, and a conjugate pair touches along lines
MILLED = (
    "tilt", "modified-roll", "generated", "helical", "universal", "fixed-setting", "completing",
    "duplex-helical",
)  # fmt: skip
HOBBED = ("tilt", "tilt", "helical", "universal", "modified-roll", "generated", "exact")
TOGETHER = {"completing": "tilt", "duplex-helical": "helical"}
WIDEST = 1.3  # times the standard dedendum angles: ISO 23509, annex C, of a slot that narrows less
UNTILTED = (
    "modified-roll",
    "generated",
)  # with face hobbing their blade radii crown: spacing is free
COARSER = 2.5  # times the tolerance, where one setting serves both flanks
COLUMNS = (
    "number", "process", "wheel", "pinion", "method", "taper", "teeth", "module_mm", "shaft_angle_deg",
    "offset_share", "spiral_deg", "cutter_radius_mm", "residual_um", "tolerance_um", "outcome", "seconds",
)  # fmt: skip


@dataclass(frozen=True)
class Draw:
    """One random blank, in mm and rad."""

    number: int
    hobbed: bool
    wheel: str
    pinion: str
    method: int
    z1: int
    z2: int
    module: float
    shaft_angle: float
    offset: float
    spiral: float
    cutter: float
    face: float
    taper: str
    lean: float  # of the blades of a Tri-Ac head

    @property
    def size(self) -> float:
        """What crownings grow with: 1 at 4 mm."""
        return (self.module / 4.0) ** 0.5

    @property
    def tolerance(self) -> float:
        """Of the ease-off, mm."""
        return 0.008 * max(self.size, 0.5)

    @property
    def target(self) -> EaseOffTarget:
        """Ease-off that is asked of both flanks."""
        return EaseOffTarget(0.015 * self.size, 0.010 * self.size)

    def blank(self, groups: int | None = None) -> BlankRequest:
        """The request of its blank; undercut leaves few teeth less depth."""
        method: Any = self.method
        taper: Any = self.taper
        depth = float(np.interp(self.z2 / self.z1, [4.0, 10.0], [2.0, 1.7]))
        more: Any = {} if groups is None else {"blade_groups": groups}
        return BlankRequest(
            method, self.z1, self.z2, self.shaft_angle, self.offset, self.face, self.cutter,
            self.spiral, wheel_outer_diameter=self.module * self.z2, taper=taper,
            tooth=TypeII(depth_factor=depth), **more,
        )  # fmt: skip


def dedendum_angles(one: Draw) -> float:
    """Sum of both dedendum angles of a draw's blank, rad: on the wheel its addendum angle is the pinion's."""
    wheel = iso_blank(one.blank()).wheel
    return wheel.addendum_angle + wheel.dedendum_angle


def draw(number: int, random: np.random.Generator) -> Draw:
    """A blank within practice: few teeth with high ratios, offset as the ratio and shaft angle allow."""
    while True:
        ratio = float(np.exp(random.uniform(0.0, np.log(15.0))))
        usual = np.interp(ratio, [1.0, 2.0, 4.0, 6.0, 10.0, 15.0], [20, 15, 11, 9, 7, 6])
        z1 = int(random.integers(max(int(usual) - 2, 5), int(usual) + 4))
        z2 = round(ratio * z1)
        sigma = radians(90.0 if random.random() < 0.6 else random.uniform(60.0, 120.0))
        if z1 / z2 + np.cos(sigma) < 0.12 or z2 < z1:
            continue
        delta2 = float(np.arctan2(sin(sigma), z1 / z2 + np.cos(sigma)))
        module = float(np.exp(random.uniform(0.0, np.log(15.0))))
        de2 = module * z2
        cone = 0.5 * de2 / sin(delta2)
        face = min(random.uniform(0.24, 0.30) * cone, 10.0 * module)
        most = min(0.45, 0.09 * ratio) * (1.0 if abs(sigma - radians(90.0)) < 0.01 else 0.4)
        share = 0.0 if random.random() < 0.25 else random.uniform(0.0, most)
        offset = share * 0.5 * de2
        mean = 0.5 * (de2 - face * sin(delta2))
        turn = asin(min(offset / mean, 0.9))
        spiral = radians(random.uniform(0.0, 45.0)) if random.random() > ZEROL else 0.0
        if degrees(spiral + turn) > 60.0:
            continue
        hobbed = bool(random.random() < 0.2)
        method = 0 if not share else int(random.choice([1, 1, 2, 3]))
        cutter = float(random.uniform(0.75, 1.25)) * (cone - 0.5 * face)
        taper = str(random.choice(["standard", "uniform", "modified"]))
        wheel = "formate" if ratio > 2.5 and random.random() < 0.6 else "generated"
        pinion = str(random.choice(HOBBED if hobbed else MILLED))
        if pinion in TOGETHER:
            taper = "duplex"
        if hobbed:
            taper = "uniform"
        if pinion == "exact":
            wheel, method = "generated", 2
        if pinion == "completing" and wheel == "generated":
            pinion = (
                "duplex-helical"  # without motions one setting does not serve both flanks there
            )
        if pinion in UNTILTED and wheel == "formate" and (hobbed or pinion == "generated"):
            pinion = "tilt"  # a plain roll without tilt is no match for a form-cut wheel
        lean = random.uniform(radians(12.0), radians(22.0))
        one = Draw(
            number, hobbed, wheel, pinion, method,
            z1, z2, module, sigma, offset, spiral, cutter, face, taper, lean,
        )  # fmt: skip
        if pinion in TOGETHER:
            standard = replace(one, taper="standard")
            if dedendum_angles(one) > WIDEST * dedendum_angles(standard):
                return replace(one, pinion=TOGETHER[pinion], taper="modified")
        return one


def milled(one: Draw) -> MilledRequest:
    """The request of a face-milled draw."""
    wheel: Any = one.wheel
    pinion: Any = one.pinion
    return MilledRequest(
        f"random {one.number}", "", (), one.blank(), wheel, pinion, one.target, one.target,
        tolerance=one.tolerance * (COARSER if one.pinion in TOGETHER else 1.0),
    )  # fmt: skip


def tri_ac(one: Draw) -> HobbedRequest:
    """The request of a face-hobbed draw on Tri-Ac heads: both pinion flanks in one setting-up."""
    wheel: Any = one.wheel
    pinion: Any = one.pinion
    normal = 0.85 * one.module * cos(one.spiral)
    groups = max(round(2.0 * one.cutter * sin(one.lean) / normal), 3)
    return HobbedRequest(
        f"random {one.number}", "", (), one.blank(groups), wheel, pinion,
        StickGrind(pinion_curve_radius=None), drive=one.target, coast=one.target,
        tolerance=one.tolerance, equal_spacing=pinion not in UNTILTED,
    )  # fmt: skip


def exact(one: Draw) -> ExactFaceHobbedSpec:
    """The exact face-hobbed pair of a draw."""
    mean = 0.5 * one.module * one.z2 - 0.5 * one.face
    turn = asin(min(one.offset / mean, 0.9))
    return ExactFaceHobbedSpec(
        title=f"random {one.number}", source="", assumed=(), shaft_angle=one.shaft_angle,
        offset=one.offset, pinion_teeth=one.z1, wheel_teeth=one.z2, pinion_hand="left",
        pinion_spiral_angle=one.spiral + 1.1 * turn, wheel_mean_radius=mean, wheel_face_width=one.face,
        mean_addendum_factor=0.35, depth_factor=1.75, clearance_factor=0.125,
        cutter_radius=one.cutter, blade_groups=7, pressure_angle=radians(20.0),
        tip_edge_radius_factor=0.2, tip_relief=None, marking_thickness=0.0065,
    )  # fmt: skip


def outcome(one: Draw) -> tuple[str, float, float]:
    """What became of a draw in words, its greatest residual and tolerance, um."""
    residual = tolerance = float("nan")
    reported: list[str] = []
    try:
        if one.pinion == "exact":
            pair = build(exact(one))
        else:
            made = design_hobbed(tri_ac(one)) if one.hobbed else design_milled(milled(one))
            fits = [made.fit] if isinstance(made, HobbedDesign) else made.fits.values()
            residual = 1e3 * max(fit.largest for fit in fits)
            tolerance = 1e3 * made.request.tolerance
            if residual > tolerance:
                told = next(fault for fault in made.faults if "target ease-off" in fault)
                return f"residual: {told}", residual, tolerance
            reported = list(made.faults)
            pair = build(made.spec)
    except DesignError as error:
        first = error.problems[0]
        return (
            f"refused: {first.path}: {first.given}; expected {first.expected}",
            residual,
            tolerance,
        )
    faults = [*pair.faults, *reported]
    for direction in ("drive", "coast"):
        contact = unloaded_contact(pair, direction, sampling=LOOK)
        quarter, middle = LOOK.positions_per_pitch // 4, len(contact.phi) // 2
        if not any(inside(contact, k) for k in range(middle - quarter, middle + quarter + 1)):
            words = "; ".join([f"{leading(contact, middle)} leads", *faults])
            return f"{direction}: no contact inside at the middle ({words})", residual, tolerance
    return ("sound" if not faults else f"sound; reported: {faults[0]}"), residual, tolerance


def inside(contact: UnloadedContact, at: int) -> bool:
    """Whether flanks touch within their outlines at a position: no edge leads what lies inside."""
    leads = contact.leads[at].reshape(LOOK.rows, LOOK.columns)
    best = float(leads[1:-1, 1:-1].max())
    return bool(contact.interior[at]) or best > float(contact.curve[at]) - LEADS


def leading(contact: UnloadedContact, at: int) -> str:
    """The edge nearest to the node that leads, by its member."""
    node = int(contact.leads[at].argmax())
    point = contact.nodes.point[:, [node]]
    seen = []
    for flank, (x, y, z) in (
        (contact.pinion_flank, point),
        (contact.wheel_flank, to_wheel(contact.mount, contact.phi[at], tuple(point))),
    ):
        distance, height = flank.cone.cone_distance_height(z, np.hypot(x, y))
        low = flank.active_chart.bounds(distance)[0]
        seen += [
            (float(flank.tip.at(distance)[0] - height[0]), f"the {flank.member}'s tip"),
            (float(distance[0] - flank.toe), f"the {flank.member}'s toe"),
            (float(flank.heel - distance[0]), f"the {flank.member}'s heel"),
            (float(height[0] - low[0]), f"the lower end of the {flank.member}'s flank"),
        ]
    return min(seen)[1]


def row(number: int) -> list[Any]:
    """One line of the table."""
    one = draw(number, np.random.default_rng([SEED, number]))
    start = time.process_time()
    words, residual, tolerance = outcome(one)
    taken = time.process_time() - start
    return [
        number, "face-hobbed" if one.hobbed else "face-milled",
        one.wheel, one.pinion, one.method, one.taper, f"{one.z1}/{one.z2}",
        f"{one.module:.2f}", f"{degrees(one.shaft_angle):.1f}",
        f"{one.offset / (0.5 * one.module * one.z2):.3f}", f"{degrees(one.spiral):.1f}",
        f"{one.cutter:.1f}", f"{residual:.2f}", f"{tolerance:.2f}", words, f"{taken:.1f}",
    ]  # fmt: skip


def main(count: int, target: Path, workers: int) -> None:
    """Design so many blanks and write the table."""
    sound = 0
    with (
        target.open("w", newline="", encoding="utf-8") as file,
        ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool,
    ):
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        for line in pool.map(row, range(1, count + 1)):
            sound += line[-2].startswith("sound")
            table.writerow(line)
            file.flush()
    print(f"{sound} of {count} sound ({100.0 * sound / count:.1f} %)")


if __name__ == "__main__":
    main(int(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 1)
