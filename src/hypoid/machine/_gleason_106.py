"""Gleason No. 106 hypoid generator: a tilted head (`_tilt_head`, where the signs stand), own constants."""

from __future__ import annotations

from ._cradle_machine import Matrix, Workpiece
from ._settings import MachineSettings
from ._tilt_head import INCH, TiltHeadConstants, TiltHeadDials
from ._tilt_head import from_basic as _from_basic
from ._tilt_head import pose as _pose
from ._tilt_head import to_basic as _to_basic

NAME = "gleason-106"
# L and the helical constant per inch and radian [tsay1993, nomenclature and below (21)]
GLEASON_106 = TiltHeadConstants("No. 106", eccentric=3.0 * INCH, helical=0.083075889 * INCH)


def to_basic(dials: TiltHeadDials, work: Workpiece) -> MachineSettings:
    """Basic settings of the dials of a No. 106."""
    return _to_basic(dials, work, _constants(work))


def from_basic(settings: MachineSettings, work: Workpiece) -> TiltHeadDials:
    """Dials of a No. 106 for basic settings; a `DesignError` says what it cannot set."""
    return _from_basic(settings, work, _constants(work))


def pose(dials: TiltHeadDials, work: Workpiece, theta: float, phi: float) -> Matrix:
    """The mechanism's motion in the frames of `chain`, 4 x 4, mm."""
    return _pose(dials, work, _constants(work), theta, phi)


def _constants(work: Workpiece) -> TiltHeadConstants:
    return work.constants or GLEASON_106
