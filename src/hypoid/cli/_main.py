"""`hypoid COMMAND FILE`: finds the command, and turns every way it can end into an exit status."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from cyclopts import App, CycloptsError

from hypoid.geometry import DesignError, Problem

from ._output import BAD_INPUT, report_problems, say

# Each in its own module, imported when it is called for.
_COMMANDS = {
    "check": "Whether a design is sound, and what it assumes.",
    "design": "From blank and target to cutters and settings: a complete, commented design file.",
    "blank": "Pitch cones, tooth depths, face and root cones of both members.",
    "settings": "Basic machine settings of the four flanks, as on a summary sheet.",
    "flank": "Points and normals of one flank on a grid, to CSV or JSON.",
    "contact": "Unloaded contact of both directions: path, transmission error, contact ratio.",
    "inspect": "Nominal grids for a measuring machine, and what a measured member deviates by.",
    "correct": "New machine settings from a measured member, and the contact that they make.",
    "load": "Loaded contact per torque: pressure, load sharing, transmission error, root stress.",
    "stress": "Stress in both root fillets over the mesh cycle, per torque.",
    "export": "Teeth with their body for CAD, printing, viewing and analysis: STL, GLB, STEP, INP and more.",
    "report": "One HTML file with everything above, drawn.",
    "examples": "The design files that ship with the program.",
}
_INTERRUPTED = 130
_EPILOGUE = (
    "Exit status: 0 done; 1 computed, but the design has a fault that the message names; "
    "2 bad input."
)


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command line and return its exit status."""
    words = list(sys.argv[1:] if argv is None else argv)
    as_json = "--json" in words
    try:
        status = _app()(words, exit_on_error=False, print_error=False)
        sys.stdout.flush()
        return status or 0
    except CycloptsError as error:
        given = f"`hypoid {' '.join(words)}`"
        report_problems([Problem("command line", given, str(error), "`hypoid --help`")], as_json)
        return BAD_INPUT
    except DesignError as error:
        report_problems(error.problems, as_json)
        return BAD_INPUT
    except KeyboardInterrupt:
        say("Interrupted.")
        return _INTERRUPTED
    except BrokenPipeError:  # the reader, `head` say, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def _app() -> App:
    from hypoid import __version__

    app = App(
        name="hypoid",
        help="Spiral bevel and hypoid gears: from the blank to the contact of the tooth surfaces.",
        help_epilogue=_EPILOGUE,
        version=__version__,
        result_action="return_value",
        suppress_keyboard_interrupt=False,
    )
    for name, words in _COMMANDS.items():
        app.command(f"hypoid.cli._{name}:{name}", name=name, help=words)
    return app
