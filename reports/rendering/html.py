"""Render content as one HTML page that needs no network and no other file, so that it works from file://.

Drawings are the same SVG as in the PDF. The ids of their series, which drawing.canvas.series writes, become data
attributes here, by which the page's script names the variant under the pointer and fades all methods but one.
"""

from __future__ import annotations

import base64
import html
import itertools
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from reports.content import Block, Code, Column, Document, Figure, Gallery, Matrix, Panel, Picture, Section, Table, Text
from reports.drawing.canvas import SERIES
from reports.drawing.style import Mark

HERE = Path(__file__).parent
_ID = re.compile(r'\bid="([^"]+)"')
_REFERENCE = re.compile(r'(url\(#|href="#)([^")]+)')
_NAMED = re.compile(f'<g id="{re.escape(SERIES)}([^"]*)"')


def write_html(document: Document, marks: Mapping[str, Mark], path: Path) -> None:
    """Write `document` as the file `path`; a click on a method of `marks` fades the others.

    Raises OSError where the file cannot be written.
    """
    path.write_text(page(document, marks), encoding="utf-8", errors="replace")


def page(document: Document, marks: Mapping[str, Mark]) -> str:
    """Return the page of `document` as HTML; a click on a method of `marks` fades the others."""
    sections = [document.summary, *document.sections]
    links = "".join(f'<li><a href="#s{i}">{_e(section.title)}</a></li>' for i, section in enumerate(sections))
    chips = "".join(
        f'<button class="chip" data-method="{_e(name)}" aria-pressed="false" style="--own:{mark.color}">'
        f"{_e(name)}</button>"
        for name, mark in marks.items()
    )
    body = "".join(f'<section id="s{i}">{_section(section, i)}</section>' for i, section in enumerate(sections))
    template = (HERE / "page.html").read_text(encoding="utf-8")
    parts = {
        "title": _e(document.title),
        "subtitle": _e(document.subtitle),
        "style": (HERE / "page.css").read_text(encoding="utf-8"),
        "script": (HERE / "page.js").read_text(encoding="utf-8"),
        "links": links,
        "chips": chips,
        "body": body,
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], template)


def _e(text: str) -> str:
    """Escape a text for HTML."""
    return html.escape(text, quote=True)


def _section(section: Section, number: int) -> str:
    """Write a section as HTML; `number` is in the ids within it."""
    every = [*section.blocks, *section.details]
    blocks = [_block(block, f"b{number}-{i}") for i, block in enumerate(every)]
    shown, folded = "".join(blocks[: len(section.blocks)]), "".join(blocks[len(section.blocks) :])
    details = f"<details><summary>Every figure</summary>{folded}</details>" if folded else ""
    return f"<h2>{_e(section.title)}</h2>{shown}{details}"


def _block(block: Block, name: str) -> str:
    """Write a block as HTML; `name` begins the ids within it."""
    match block:
        case Text():
            told = _e(block.text)
            return f'<p class="strong">{told}</p>' if block.strong else f"<p>{told}</p>"
        case Code():
            return f"<pre><code>{_e(block.text)}</code></pre>"
        case Table():
            return _table(block)
        case Matrix():
            return _matrix(block)
        case Figure():
            return _figure(block, name)
        case Gallery():
            return _gallery(block, name)


def _caption(title: str, caption: str) -> str:
    """Write title and caption of a figure; "" without either."""
    return f"<strong>{_e(title)}</strong> {_e(caption)}" if title or caption else ""


def _table(table: Table) -> str:
    """Write a table whose cells have their values beside their texts, so that numbers sort as numbers."""
    over = [(name, len(list(own))) for name, own in itertools.groupby(table.columns, key=lambda column: column.over)]
    groups = "".join(f'<th class="over" colspan="{span}" scope="colgroup">{_e(name)}</th>' for name, span in over)
    titles = "".join(
        f'<th scope="col" class="{"n" if c.numeric else ""}"><button class="sort">{_e(c.title)}</button></th>'
        for c in table.columns
    )
    titled = any(column.title for column in table.columns)
    head = f"<thead>{f'<tr>{groups}</tr>' if len(over) > 1 else ''}<tr>{titles}</tr></thead>" if titled else ""
    rows = "".join(f"<tr>{_cells(table.columns, row)}</tr>" for row in table.rows)
    filtered = titled and len(table.rows) > 3
    box = '<input class="filter" type="search" placeholder="filter rows" aria-label="filter rows">' if filtered else ""
    shown = '<span class="count"></span>' if filtered else ""
    return (
        f'<figure class="table"><figcaption>{_caption(table.title, table.caption)}</figcaption>{box}{shown}'
        f'<div class="scroll"><table>{head}<tbody>{rows}</tbody></table></div></figure>'
    )


def _matrix(matrix: Matrix) -> str:
    """Write a matrix as a table; what a square's note says is told under the pointer, and read aloud."""
    head = "".join(f'<th scope="col">{_e(name)}</th>' for name in matrix.columns)
    body = "".join(
        f'<tr><th scope="row">{_e(heading)}</th>'
        + "".join(
            f'<td style="background:{square.color or "none"}" title="{_e(square.note)}">{_e(square.text)}</td>'
            for square in squares
        )
        + "</tr>"
        for heading, squares in matrix.rows
    )
    return (
        f'<figure class="matrix"><figcaption>{_caption(matrix.title, matrix.caption)}</figcaption><div class="scroll">'
        f'<table><thead><tr><th scope="col">{_e(matrix.corner)}</th>{head}</tr></thead><tbody>{body}</tbody></table>'
        "</div></figure>"
    )


def _cells(columns: Sequence[Column], row: tuple[Any, ...]) -> str:
    """Write the cells of one row, each with its value if that is a number."""
    cells = []
    for column, value in zip(columns, row, strict=True):
        number = not isinstance(value, str | bool) and not pd.isna(value)
        key = f' data-v="{float(value)!r}"' if number else ""
        kind = ' class="n"' if column.numeric else ""
        cells.append(f"<td{kind}{key}>{_e(column.show(value))}</td>")
    return "".join(cells)


def _figure(figure: Figure, name: str) -> str:
    """Write a figure as HTML; `name` begins the ids within its drawing."""
    return (
        f'<figure class="drawing" role="img" aria-label="{_e(figure.description)}">{_svg(figure.svg, name)}'
        f"<figcaption>{_caption(figure.title, figure.caption)}</figcaption></figure>"
    )


def _svg(svg: str, name: str) -> str:
    """Return a drawing as a part of the page: `name` begins its ids, and its series become data attributes."""
    own = svg[svg.index("<svg") :]
    own = _NAMED.sub(lambda found: f'<g class="series" data-series="{found[1]}"', own)
    own = _ID.sub(rf'id="{name}-\1"', own)
    return _REFERENCE.sub(rf"\1{name}-\2", own)


def _picture(picture: Picture) -> str:
    """Write a picture as an HTML image that holds its bytes."""
    data = base64.b64encode(picture.png).decode()
    return f'<img alt="{_e(picture.description)}" src="data:image/png;base64,{data}">'


def _panel(panel: Panel) -> str:
    """Write a panel as HTML: its title, its pictures, its lines, its note and what colours mean."""
    pictures = "".join(_picture(picture) for picture in panel.pictures)
    lines = "".join(f"<tr>{''.join(f'<td>{_e(cell)}</td>' for cell in line)}</tr>" for line in panel.lines)
    key = "".join(
        f'<span class="key"><span style="background:{color}">&nbsp;&nbsp;</span> {_e(text)}</span> '
        for color, text in panel.key.items()
    )
    note = "<br>".join(_e(line) for line in panel.note.split("\n"))
    return (
        f'<div class="panel" data-title="{_e(panel.title)}"><strong>{_e(panel.title)}</strong>'
        f'<div class="pictures">{pictures}</div>{f"<table>{lines}</table>" if lines else ""}'
        f"<small>{key}{note}</small></div>"
    )


def _gallery(gallery: Gallery, name: str) -> str:
    """Write the panels, and before them a comparison of two pictures by a slider, which the script fills."""
    legend = "" if gallery.legend is None else _svg(gallery.legend.svg, name)
    compare = (
        '<div class="compare"><label>left <select class="left"></select></label> '
        '<label>right <select class="right"></select></label>'
        '<div class="stack"><img class="under" alt=""><img class="above" alt=""><div class="edge"></div></div>'
        '<input class="slider" type="range" min="0" max="100" value="50" aria-label="where left ends and right begins">'
        "</div>"
    )
    panels = "".join(_panel(panel) for panel in gallery.panels)
    return (
        f'<figure class="gallery">{legend}<figcaption>{_e(gallery.caption)}</figcaption>{compare}'
        f'<details open><summary>All pictures</summary><div class="panels">{panels}</div></details></figure>'
    )
