"""What the cells of the pages share: a terminal, tables, the keys of a design file, a pattern."""

from __future__ import annotations

import contextlib
import io
import json
import shlex
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from IPython.display import Markdown

from hypoid.cli import main
from hypoid.io import json_schema

WIDTH = 90  # characters that stand side by side on a page
COLOURS = {"drive": "#0072B2", "coast": "#D55E00"}  # told apart by colour-blind eyes, too


def sh(line: str, *, lines: int | None = None, status: int = 0) -> None:
    """Run a command line of the program and show what a terminal would show."""
    text = io.StringIO()
    with contextlib.redirect_stdout(text), contextlib.redirect_stderr(text):
        ended = main(shlex.split(line)[1:])
    shown = [one for long in text.getvalue().rstrip().splitlines() for one in _folded(long)]
    if lines is not None and len(shown) > lines:
        shown = [*shown[:lines], "..."]
    print("\n".join([f"$ {line}", *shown, f"(exit status {ended})"]))
    assert ended == status, f"{line}: status {ended}, the page says {status}"


def _folded(line: str) -> list[str]:
    """A line of words as a terminal breaks it; the rows of tables stay whole."""
    line = line.rstrip()
    if len(line) <= WIDTH or "  " in line.strip():
        return [line]
    return textwrap.wrap(line, WIDTH, subsequent_indent=" " * 12)


def table(
    head: Sequence[str], rows: Iterable[Sequence[object]], *, words: bool = False
) -> Markdown:
    """A table whose first column holds names; the others numbers, or words."""
    rule = "---|" if words else "--:|"
    lines = ["| " + " | ".join(head) + " |", "|---|" + rule * (len(head) - 1)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return Markdown("\n".join(lines))


def assumed(pair: Any) -> Markdown:
    """What a design file or the program assumed, with the reason."""
    rows = [(f"`{a.value}`", a.reason.replace("|", "/")) for a in pair.assumed]
    return table(("value", "reason"), rows, words=True)


def keys(kind: str, *, without: tuple[str, ...] = ()) -> Markdown:
    """Every key of one kind of design file as a line of it, from the program's own JSON Schema."""
    tables = json_schema()["$defs"]
    rows: list[Sequence[str]] = []
    for heading, of_table in _tables(tables, tables[kind]):
        if not heading.strip("[]`").startswith(without):
            rows += [(f"**{heading}**", "", ""), *of_table]
    return table(("line", "expected", "default"), rows, words=True)


def _tables(
    tables: dict[str, Any], one: dict[str, Any], path: str = "", mark: str = "[]"
) -> Iterator[tuple[str, list[Sequence[str]]]]:
    """The heading of each table with its keys: example, what is expected, default."""
    own: list[Sequence[str]] = []
    inner: list[tuple[str, str, str]] = []
    for name, entry in one["properties"].items():
        of, brackets, more = _table_of(entry)
        if of is not None:
            inner.append((of, f"{path}.{name}{more}".strip("."), brackets))
            continue
        needed, default = name in one.get("required", []), entry.get("default")
        shown = "–" if needed else "none" if default is None else f"`{json.dumps(default)}`"
        example = json.dumps(entry.get("examples", [""])[0], ensure_ascii=False)
        own.append((f"`{name} = {example}`", entry.get("description", ""), shown))
    if own:
        half = len(mark) // 2
        yield f"`{mark[:half]}{path}{mark[half:]}`" if path else "at the top", own
    for of, where, brackets in inner:
        yield from _tables(tables, tables[of], where, brackets)


def _table_of(entry: dict[str, Any]) -> tuple[str | None, str, str]:
    """Name of the table that an entry stands for, if any; its brackets; how its path goes on."""
    for one in [entry, *entry.get("anyOf", []), *entry.get("allOf", [])]:
        for at, brackets, more in (
            (one, "[]", ""),
            (one.get("items"), "[[]]", ""),
            (one.get("additionalProperties"), "[]", ".23"),
        ):
            if isinstance(at, dict) and "$ref" in at:
                return at["$ref"].rsplit("/", 1)[1], brackets, more
    return None, "", ""


def draw_pattern(axes: Any, contact: Any, title: str = "") -> None:
    """Pattern and path of a contact on the pinion's tooth, between toe, heel, tip and root."""
    from hypoid.contact import pattern

    flank, marked = contact.pinion_flank, pattern(contact)
    colour, grey = COLOURS[contact.direction], "#8a8f98"
    distance = np.broadcast_to(marked.distance, marked.gap.shape)
    within = np.where(np.isfinite(marked.gap), marked.gap, 1.0)
    levels = [-1.0, marked.thickness]
    axes.contourf(distance, marked.height, within, levels=levels, colors=[colour], alpha=0.45)
    axes.plot(*contact.path, color="black", lw=1.2)
    ends = np.array([flank.toe, flank.heel])
    tip, root = flank.tip.at(ends), flank.root.at(ends)
    axes.plot([*ends, *ends[::-1], ends[0]], [*tip, *root[::-1], tip[0]], color=grey, lw=0.9)
    middle = ends.mean()
    for x, y, word, way in (
        (middle, flank.tip.at(middle), "tip", (0, 3)),
        (middle, flank.root.at(middle), "root", (0, -11)),
        (ends[0], 0.5 * (tip[0] + root[0]), "toe", (-8, 0)),
        (ends[1], 0.5 * (tip[1] + root[1]), "heel", (8, 0)),
    ):
        turn = 90 if word in ("toe", "heel") else 0
        style = {"ha": "center", "va": "center" if turn else "bottom", "rotation": turn}
        axes.annotate(word, (x, y), xytext=way, textcoords="offset points", fontsize=8, **style)
    width, low, high = ends[1] - ends[0], min(root), max(tip)
    axes.set_xlim(ends[0] - 0.14 * width, ends[1] + 0.14 * width)
    axes.set_ylim(low - 0.16 * (high - low), high + 0.14 * (high - low))
    axes.set(xlabel="S [mm]", ylabel="H [mm]", title=title or f"{contact.direction}: {flank.name}")
