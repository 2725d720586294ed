"""The cradle machines by name, behind one interface: dials, both translations, motion, table of dials."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from . import _gleason_106, _gleason_122, _gleason_463
from ._cradle_machine import Matrix, Workpiece
from ._dials import Dial, check, increments, ranges, rounded
from ._settings import MachineSettings
from ._tilt_head import TILT_HEAD, TiltHeadDials


@dataclass(frozen=True)
class Machine:
    """One machine: what its dials are, and what they mean."""

    name: str
    dials: type[Any]
    table: Mapping[str, Dial]
    to_basic: Callable[[Any, Workpiece], MachineSettings]
    from_basic: Callable[[MachineSettings, Workpiece], Any]
    pose: Callable[[Any, Workpiece, float, float], Matrix]
    constants: Any = None  # of the machine, or a stand-in where each machine has its own
    needs_constants: bool = False  # whether a workpiece must bring them

    @property
    def ranges(self) -> dict[str, tuple[float, float]]:
        """Least and greatest reading of each dial, mm, rad or teeth."""
        return ranges(self.table)

    @property
    def increments(self) -> dict[str, float]:
        """Step of each dial that has one, mm or rad."""
        return increments(self.table)

    def rounded(self, dials: Any) -> Any:
        """The same dials on their increments."""
        return rounded(dials, self.table)

    def check(self, dials: Any, path: str = "settings") -> None:
        """Raise a `DesignError` for every dial out of its range."""
        check(dials, self.table, path)


MACHINES: dict[str, Machine] = {
    machine.name: machine
    for machine in (
        Machine(
            _gleason_106.NAME,
            TiltHeadDials,
            TILT_HEAD,
            _gleason_106.to_basic,
            _gleason_106.from_basic,
            _gleason_106.pose,
            _gleason_106.GLEASON_106,
        ),
        Machine(
            _gleason_122.NAME,
            TiltHeadDials,
            TILT_HEAD,
            _gleason_122.to_basic,
            _gleason_122.from_basic,
            _gleason_122.pose,
            _gleason_122.GLEASON_122,
        ),
        Machine(
            _gleason_463.NAME,
            _gleason_463.Gleason463Dials,
            _gleason_463.DIALS_463,
            _gleason_463.to_basic,
            _gleason_463.from_basic,
            _gleason_463.pose,
            _gleason_463.STAND_IN_463,
            needs_constants=True,
        ),
    )
}


def constants_of(name: str, given: Mapping[str, Any] | None) -> Any:
    """What a machine has of its own: as the file gives it (mm), else the registry's, or a stand-in."""
    if given is None or name != _gleason_463.NAME:
        return MACHINES[name].constants
    cams = {int(number): _gleason_463.Cam463(**cam) for number, cam in given["cams"].items()}
    return _gleason_463.Gleason463Constants(given["swivel_offset"], cams)
