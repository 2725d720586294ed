"""The report's section on the pair under load."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from hypoid.load import LoadCase, LoadedContact, RootStress
from hypoid.pair import Assumption

from ._figures_load import loaded_contact_figure, root_stress_figure
from ._page import drawing, note
from ._style import to_svg
from ._tables import table

PRESSED = (
    "Pressure: the greatest of all positions, cells nearer to a sharp edge than 0.3 mm left out of its scale. "
    "The wheel's lead counts from z1/z2 of the pinion's turn."
)
STRESSED = (
    "Left the fillet below the loaded flank, in the middle the opposite one; right the stress at the cross while its "
    "tooth goes through the mesh."
)


@dataclass(frozen=True)
class Loaded:
    """Loaded contact with the root stress of each torque, and what was assumed for it."""

    contact: LoadedContact
    stress: Sequence[Mapping[str, RootStress]]
    assumed: Sequence[Assumption]

    @property
    def faults(self) -> tuple[str, ...]:
        return tuple(f for case in self.contact.cases for f in case.faults)


def loaded_section(loaded: Loaded) -> str:
    """Figures of the highest torque, a table of all."""
    head = (
        "torque on the pinion [N m]",
        "greatest pressure [MPa]",
        "contact ratio under load",
        "TE under load, peak to peak [urad]",
        "root stress, pinion [MPa]",
        "root stress, wheel [MPa]",
        "edge contact",
    )
    rows = [
        _row(case, stress) for case, stress in zip(loaded.contact.cases, loaded.stress, strict=True)
    ]
    last = loaded.contact.cases[-1].torque, loaded.stress[-1]
    return (
        drawing(to_svg(loaded_contact_figure(loaded.contact)), PRESSED)
        + drawing(to_svg(root_stress_figure(*last)), STRESSED)
        + table(head, rows)
        + "".join(note(f"Assumed {a.value}: {a.reason}") for a in loaded.assumed)
    )


def _row(case: LoadCase, stress: Mapping[str, RootStress]) -> tuple[object, ...]:
    return (
        f"{case.torque * 1e-3:g}",
        f"{case.max_pressure:.0f}",
        f"{case.contact_ratio:.2f}",
        f"{case.peak_to_peak * 1e6:.3g}",
        f"{stress['pinion'].max_principal:.0f}",
        f"{stress['wheel'].max_principal:.0f}",
        "yes" if case.edge_contact else "no",
    )
