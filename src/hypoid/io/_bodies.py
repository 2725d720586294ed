"""What carries the teeth, from either kind of design file."""

from __future__ import annotations

from hypoid.design import BodySpec

from ._design_file import DesignFile
from ._sheet_file import SummarySheetFile


def bodies_of(file: DesignFile | SummarySheetFile) -> dict[str, BodySpec]:
    """By member."""
    return {
        name: BodySpec(
            member.body.bore_diameter,
            member.body.mounting_distance,
            member.body.tip_rounding,
            member.support.held,
            None if (rows := member.support.stiffness) is None else tuple(map(tuple, rows)),
        )
        for name, member in (("pinion", file.pinion), ("wheel", file.wheel))
    }
