"""`hypoid report`."""

from __future__ import annotations

from pathlib import Path

from hypoid.geometry import DesignError, Problem

from ._load_options import LoadOptions, computed, request
from ._options import AsJson, DesignPath, Output
from ._output import report_faults, say, write_json

USUAL = LoadOptions()


def report(
    file: DesignPath,
    /,
    *,
    output: Output = Path("report.html"),
    under_load: LoadOptions = USUAL,
    json: AsJson = False,
) -> int:
    """Everything about a pair in one HTML file that needs no network; with --torque, what it does under load, too.

    The other options are of the loaded contact (see `hypoid load`) and mean nothing without a torque.
    """
    asked = request(under_load) if under_load.torque else None
    from hypoid import read

    pair = read(file)
    if output.is_dir() or not output.parent.is_dir():
        expected = "a file in a folder that exists"
        raise DesignError([Problem("--output", str(output), expected, "-o report.html")])
    from hypoid.report import Loaded, terminal_progress, write_report

    with terminal_progress() as progress:
        loaded = None
        if asked is not None:
            found = computed(pair, asked, progress)
            loaded = Loaded(found.loaded, found.stress, found.assumed)
        summary = write_report(pair, output, progress, loaded)
    faults = list(summary.faults)
    if json:
        write_json({"report": str(output), "faults": faults})
    say(f"The report is {output}.")
    return report_faults(faults)
