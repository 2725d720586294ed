"""The page itself: one HTML text with its style, figures and the 3D view inside."""

from __future__ import annotations

from html import escape

_STYLE = """
:root{--ink:#222831;--soft:#5b6270;--line:#d5dae2;--bad:#b3401a;--good:#0b6e4f}
*{box-sizing:border-box}body{font:15px/1.5 system-ui,sans-serif;color:var(--ink);margin:0;background:#f4f6f9}
main{max-width:1080px;margin:0 auto;padding:24px 28px;background:#fff}
h1{margin:.2em 0;font-size:1.9em}h2{margin:1.8em 0 .5em;border-bottom:2px solid var(--line);padding-bottom:.2em}
p.note,figcaption{color:var(--soft);font-size:.9em;margin:.4em 0}
figure{margin:1em 0}figure svg,figure img{width:100%;height:auto}
table{border-collapse:collapse;font-size:.88em;margin:.6em 0;font-variant-numeric:tabular-nums}
th,td{padding:.22em .7em;border-bottom:1px solid var(--line);text-align:right}
th:first-child{text-align:left;font-weight:500}thead th{font-weight:600;border-bottom:2px solid var(--line)}
.side{display:flex;gap:36px;flex-wrap:wrap;align-items:flex-start}
.box{border:1px solid var(--line);border-left:6px solid var(--good);padding:.6em 1.1em;margin:1em 0;border-radius:4px}
.box.bad{border-left-color:var(--bad)}.box li{margin:.25em 0}
nav a{margin-right:1.1em;color:#0072B2;text-decoration:none;font-size:.9em}
#scene{height:560px}.print-only{display:none}
@media print{body{background:#fff}main{max-width:none;padding:0}nav,#scene{display:none}
.print-only{display:block}figure,table{break-inside:avoid}h2{break-after:avoid}}
"""


def section(title: str, *parts: str) -> str:
    """A titled section; its anchor is the title in lower case."""
    anchor = title.lower().replace(" ", "-")
    return f'<section id="{anchor}"><h2>{escape(title)}</h2>{"".join(parts)}</section>'


def drawing(svg: str, caption: str) -> str:
    """A figure with what it says and how far to trust it."""
    return f"<figure>{svg}<figcaption>{escape(caption)}</figcaption></figure>"


def note(text: str) -> str:
    return f'<p class="note">{escape(text)}</p>'


def box(title: str, lines: list[str], bad: bool) -> str:
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    kind = "box bad" if bad else "box"
    return f'<div class="{kind}"><strong>{escape(title)}</strong><ul>{items}</ul></div>'


def page(title: str, source: str, sections: list[tuple[str, str]]) -> str:
    """The whole HTML text from (title, body) sections, in order."""
    links = "".join(
        f'<a href="#{t.lower().replace(" ", "-")}">{escape(t)}</a>' for t, _ in sections
    )
    body = "".join(section(t, html) for t, html in sections)
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head><body><main>"
        f'<h1>{escape(title)}</h1><p class="note">{escape(source)}</p><nav>{links}</nav>'
        f"{body}</main></body></html>\n"
    )
