"""`hypoid report`."""

from __future__ import annotations

from pathlib import Path

from hypoid.geometry import DesignError, Problem

from ._options import AsJson, DesignPath, Output
from ._output import report_faults, say, write_json


def report(
    file: DesignPath,
    /,
    *,
    output: Output = Path("report.html"),
    json: AsJson = False,
) -> int:
    """Everything about a pair in one HTML file that needs no network."""
    from hypoid import read

    pair = read(file)
    if output.is_dir() or not output.parent.is_dir():
        expected = "a file in a folder that exists"
        raise DesignError([Problem("--output", str(output), expected, "-o report.html")])
    from hypoid.report import terminal_progress, write_report

    with terminal_progress() as progress:
        summary = write_report(pair, output, progress)
    faults = list(summary.faults)
    if json:
        write_json({"report": str(output), "faults": faults})
    say(f"The report is {output}.")
    return report_faults(faults)
