"""Render content as one HTML page that needs no network and no other file, so that it works from file://."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from harness.escaping import data
from harness.escaping import html as escaped
from reports.content import Document, Section
from reports.drawing import markers
from reports.drawing.style import Mark
from reports.rendering import html_blocks, html_explorer

HERE = Path(__file__).parent
EXPLORER = "explore"  # the id of the explorer's section


def write_html(
    document: Document,
    marks: Mapping[str, Mark],
    path: Path,
    labels: Mapping[str, str] | None = None,
    library: str = "",
) -> None:
    """Write `document` as the file `path`; see `page`. Raises OSError where the file cannot be written."""
    path.write_text(page(document, marks, labels, library), encoding="utf-8", errors="replace")


def page(
    document: Document, marks: Mapping[str, Mark], labels: Mapping[str, str] | None = None, library: str = ""
) -> str:
    """Return the page of `document` as HTML.

    A click on a method of `marks` fades the others; `labels` has the methods' written names. `library` is the script
    that draws the explorer's charts, as rendering.bundle.library returns it. Without it there is no explorer.
    """
    explorer = document.explorer if library else None
    sections = [(f"s{i}", section) for i, section in enumerate((document.summary, *document.sections))]
    written = [
        (name, section.name or section.title, _section(section, name.replace("s", "b"))) for name, section in sections
    ]
    if explorer is not None:
        written.insert(1, (EXPLORER, html_explorer.TITLE, html_explorer.explorer(explorer)))
    scripts = ["page.js", *(("charts.js", "explorer.js") if explorer is not None else ())]
    parts = {
        "title": escaped(document.title),
        "subtitle": escaped(document.subtitle),
        "style": _file("page.css"),
        "contents": _contents([(name, title) for name, title, _ in written]),
        "chips": _chips(marks, labels or {}) if marks else "",
        "body": "".join(f'<section id="{name}">{body}</section>' for name, _, body in written),
        "library": f"<script>{library}</script>" if explorer is not None else "",
        "script": "".join(map(_file, scripts)),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], _file("page.html"))


def _contents(sections: Sequence[tuple[str, str]]) -> str:
    """Write links to the sections, each an id and a title; "" where there is only one."""
    links = "".join(f'<li><a href="#{name}">{escaped(title)}</a></li>' for name, title in sections)
    folded = f"<details open><summary>Contents</summary><ul>{links}</ul></details>"
    return f'<nav aria-label="contents">{folded}</nav>' if len(sections) > 1 else ""


def _file(name: str) -> str:
    return (HERE / name).read_text(encoding="utf-8")


def _section(section: Section, name: str) -> str:
    """Write what a section has; `name` begins the ids within it."""
    every = [*section.blocks, *section.details]
    blocks = [html_blocks.block(block, f"{name}-{i}") for i, block in enumerate(every)]
    shown, folded = "".join(blocks[: len(section.blocks)]), "".join(blocks[len(section.blocks) :])
    heading = f"<h2>{escaped(section.title)}</h2>"
    if folded and not shown:
        return f'<details class="every"><summary>{heading}</summary>{folded}</details>'
    details = f'<details class="every"><summary>Every figure</summary>{folded}</details>' if folded else ""
    return f"{heading}{shown}{details}"


def _chips(marks: Mapping[str, Mark], labels: Mapping[str, str]) -> str:
    """Write a button for each method, with its mark, and what the scripts have to know of the methods."""
    outlines = {name: markers.outline(mark) for name, mark in marks.items()}
    told = {
        name: {"label": labels.get(name, name), "color": mark.color, "shape": outlines[name]}
        for name, mark in marks.items()
    }
    buttons = "".join(
        f'<button type="button" class="chip" data-method="{escaped(name)}" aria-pressed="false">'
        f'<svg viewBox="-1.4 -1.4 2.8 2.8" aria-hidden="true"><path d="{one["shape"]}" fill="{one["color"]}" '
        f'stroke="{one["color"]}" stroke-width="0.4"/></svg>{escaped(one["label"])}</button>'
        for name, one in told.items()
    )
    return (
        '<div id="chips" role="group" aria-label="methods: choose some, and the others fade" hidden>'
        f'{buttons}<button type="button" id="everyone" hidden>all methods</button></div>{data("methods", told)}'
    )
