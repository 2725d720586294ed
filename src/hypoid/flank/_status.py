"""What can be said of a point that was asked of a flank."""

from __future__ import annotations

from enum import IntEnum


class PointStatus(IntEnum):
    """Status of one point; the message says what to do."""

    OK = 0
    OUTSIDE_BLANK = 1
    SINGULAR = 2
    NOT_CONVERGED = 3

    @property
    def message(self) -> str:
        return _MESSAGES[self]


_MESSAGES = {
    PointStatus.OK: "",
    PointStatus.OUTSIDE_BLANK: "The point lies off the blank: keep between toe and heel, root and tip.",
    PointStatus.SINGULAR: (
        "The edge cannot generate this point (undercut, beyond the singular limit): "
        "raise the pressure angle or lower the dedendum."
    ),
    PointStatus.NOT_CONVERGED: "No surface point was found here: the flank may not reach this place.",
}
