"""The report of a pair: one self-contained HTML file. A leaf: it shows, and computes nothing.

Names that need NumPy, matplotlib or JAX are loaded when first asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._progress import Progress as Progress
from ._progress import terminal_progress as terminal_progress

if TYPE_CHECKING:
    from ._figures_fit import FittedPinion as FittedPinion
    from ._figures_fit import fit_figure as fit_figure
    from ._figures_inspect import correction_image as correction_image
    from ._figures_inspect import topography_image as topography_image
    from ._figures_load import loaded_contact_figure as loaded_contact_figure
    from ._figures_load import root_stress_figure as root_stress_figure
    from ._figures_tooth import tooth_figure as tooth_figure
    from ._loaded import Loaded as Loaded
    from ._report import ReportSummary as ReportSummary
    from ._report import report_html as report_html
    from ._report import write_report as write_report
    from ._style import look as look
    from ._style import to_png as to_png
    from ._style import to_svg as to_svg

_LAZY = {
    **dict.fromkeys(("ReportSummary", "report_html", "write_report"), "_report"),
    **dict.fromkeys(("look", "to_png", "to_svg"), "_style"),
    **dict.fromkeys(("loaded_contact_figure", "root_stress_figure"), "_figures_load"),
    **dict.fromkeys(("FittedPinion", "fit_figure"), "_figures_fit"),
    "Loaded": "_loaded",
    "tooth_figure": "_figures_tooth",
    "correction_image": "_figures_inspect",
    "topography_image": "_figures_inspect",
}


def __getattr__(name: str) -> Any:
    if name in _LAZY:
        return getattr(import_module(f".{_LAZY[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
