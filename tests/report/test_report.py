"""The report: one file, nothing fetched, every section, and a fault is named, not hidden."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from hypoid.contact import Sampling, unloaded_contact
from hypoid.design import ExactFaceHobbedSpec, build
from hypoid.pair import GearPair
from hypoid.report import report_html, write_report

SECTIONS = (
    "What was found", "Blank", "Cutter", "Machine settings", "Tooth surfaces",
    "Tooth", "Contact pattern",
    "Motion", "Ease-off", "Misalignment drive", "Misalignment coast", "In mesh",
)  # fmt: skip


class Fetched(HTMLParser):
    """What a browser would fetch: sources and links that leave the file."""

    def __init__(self) -> None:
        super().__init__()
        self.outside: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            away = value is not None and not value.startswith(("#", "data:"))
            if name in ("src", "href") and away and tag not in ("use", "a"):
                self.outside.append(f"{tag} {value}")


@pytest.fixture(scope="module")
def made(relief_pair: GearPair) -> tuple[str, Any, list[str]]:
    seen: list[str] = []
    text, summary = report_html(relief_pair, lambda what, _done, _total: seen.append(what))
    return text, summary, seen


def test_nothing_is_fetched(made: Any) -> None:
    parser = Fetched()
    parser.feed(made[0])
    assert parser.outside == []
    assert len(made[0]) < 16e6


def test_every_section_is_there_and_no_number_is_missing(made: Any) -> None:
    text, summary, seen = made
    titles = re.findall(r"<h2>(.*?)</h2>", text)
    assert tuple(titles) == SECTIONS
    assert not re.search(r"<td>(nan|inf)</td>", text)
    assert summary.faults == ()
    assert seen[-1] == "done"
    assert text.count("<svg") >= 7


def test_a_report_is_written_whole_or_not_at_all(
    tmp_path: Path, paper_pair: GearPair, monkeypatch: pytest.MonkeyPatch
) -> None:
    import hypoid.report._report as module

    monkeypatch.setattr(module, "report_html", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        write_report(paper_pair, tmp_path / "report.html")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_an_undercut_design_still_gives_a_report_that_names_it(
    table_1_spec: ExactFaceHobbedSpec,
) -> None:
    pair = build(replace(table_1_spec, depth_factor=2.9, tip_edge_radius_factor=0.1))
    assert not all(flank.generated for flank in pair.flanks())
    assert len(unloaded_contact(pair, "drive", None, Sampling(10)).phi)
    text, summary = report_html(pair)
    assert any("undercut" in fault for fault in summary.faults)
    assert "Faults" in text
