"""How figures look: sizes, colours that colour-blind readers tell apart, and the way to SVG."""

from __future__ import annotations

import io
from contextlib import AbstractContextManager
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

# Okabe & Ito's colours
BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILION, PURPLE, GREY = "#0072B2", "#D55E00", "#CC79A7", "#8a8f98"
PINION, WHEEL = BLUE, ORANGE  # one colour a member, all through the report
DRIVE, COAST = GREEN, PURPLE
STEEL = "#e9ecf1"
MAP = "cividis"
WIDTH = 10.4  # in, of a full-width figure

_RC: dict[Any, Any] = {
    "svg.fonttype": "none",
    "svg.hashsalt": "hypoid",
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#5b6270",
    "axes.linewidth": 0.7,
    "axes.labelcolor": "#222831",
    "xtick.color": "#5b6270",
    "ytick.color": "#5b6270",
    "xtick.labelcolor": "#222831",
    "ytick.labelcolor": "#222831",
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "lines.linewidth": 1.4,
    "mathtext.fontset": "dejavusans",
}


def look() -> AbstractContextManager[None]:
    """Within this context, figures are made and drawn in the report's style."""
    return rc_context(_RC)


def figure(height: float, width: float = WIDTH) -> Figure:
    """An empty figure (in), with no global state behind it."""
    return Figure(figsize=(width, height), layout="constrained")


def to_svg(drawn: Figure) -> str:
    """A figure as an SVG element, without its XML head."""
    buffer = io.StringIO()
    drawn.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    text = buffer.getvalue()
    return text[text.index("<svg") :]


def to_png(drawn: Figure, dpi: int = 130) -> bytes:
    """A figure as a PNG file's bytes."""
    buffer = io.BytesIO()
    drawn.savefig(buffer, format="png", dpi=dpi)
    return buffer.getvalue()


def plain(axes: Axes) -> None:
    """Drawing to scale, without a frame: for parts rather than curves."""
    axes.set_aspect("equal")
    axes.axis("off")


def dimension(
    axes: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    text: str,
    *,
    colour: str = "#444b57",
    offset: tuple[float, float] = (0.0, 5.0),
) -> None:
    """A dimension line with arrows at both ends and its value, placed off the middle by points."""
    arrow = {"arrowstyle": "<->", "color": colour, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", start, end, arrowprops=arrow)
    middle = (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1]))
    axes.annotate(
        text,
        middle,
        xytext=offset,
        textcoords="offset points",
        ha="center",
        va="center",
        fontsize=7.5,
        color=colour,
    )
