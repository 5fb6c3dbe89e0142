"""Render blocks of content as HTML: texts, drawings and galleries of pictures.

Drawings are the same SVG as in the PDF. The ids of their series, which drawing.canvas.series writes, become data
attributes here, by which the page's script names the variant under the pointer and fades other methods.
"""

from __future__ import annotations

import re

from reports.content import Block, Code, Figure, Gallery, Matrix, Panel, Picture, Table, Text
from reports.drawing.canvas import SERIES
from reports.rendering import html_tables, pictures
from reports.rendering.escaping import data, escaped

_ID = re.compile(r'\bid="([^"]+)"')
_REFERENCE = re.compile(r'(url\(#|href="#)([^")]+)')
_NAMED = re.compile(f'<g id="{re.escape(SERIES)}([^"]*)"')


def block(of: Block, name: str, live: bool) -> str:
    """Write a block as HTML; `name` begins the ids within it. With `live` a figure shows its chart, if it has one."""
    match of:
        case Text():
            told = escaped(of.text)
            return f'<p class="strong">{told}</p>' if of.strong else f"<p>{told}</p>"
        case Code():
            return f'<pre tabindex="0"><code>{escaped(of.text)}</code></pre>'
        case Table():
            return html_tables.table(of)
        case Matrix():
            return html_tables.matrix(of)
        case Figure():
            return _figure(of, name, live)
        case Gallery():
            return _gallery(of, name)


def _figure(figure: Figure, name: str, live: bool) -> str:
    """Write a figure: its chart where it has one, and its drawing for paper and for readers without script."""
    drawing = f'<div class="drawn" role="img" aria-label="{escaped(figure.description)}">{_svg(figure.svg, name)}</div>'
    chart = ""
    if live and figure.chart is not None:
        told = f'role="img" aria-label="{escaped(figure.description)}"'
        chart = f'{data(f"{name}-chart", figure.chart)}<div class="chart" data-chart="{name}-chart" {told}></div>'
    caption = html_tables.caption(figure.title, figure.caption)
    return f'<figure class="drawing">{chart}{drawing}<figcaption>{caption}</figcaption></figure>'


def _svg(svg: str, name: str) -> str:
    """Return a drawing as a part of the page: `name` begins its ids, and its series become data attributes."""
    own = svg[svg.index("<svg") :]
    own = _NAMED.sub(lambda found: f'<g class="series" data-series="{found[1]}"', own)
    own = _ID.sub(rf'id="{name}-\1"', own)
    return _REFERENCE.sub(rf"\1{name}-\2", own)


def _picture(picture: Picture) -> str:
    """Write a picture as an HTML image that holds its bytes."""
    address, width, height = pictures.held(picture.png)
    size = f'width="{width}" height="{height}"'
    return f'<img alt="{escaped(picture.description)}" {size} decoding="async" src="{address}">'


def _panel(panel: Panel) -> str:
    """Write a panel: its title, its pictures, its lines, what its colours mean, and its note."""
    images = "".join(_picture(picture) for picture in panel.pictures)
    lines = "".join(f"<tr>{''.join(f'<td>{escaped(cell)}</td>' for cell in line)}</tr>" for line in panel.lines)
    key = "".join(
        f'<span class="key"><span style="background:{color}">&nbsp;&nbsp;</span> {escaped(text)}</span> '
        for color, text in panel.key.items()
    )
    note = "<br>".join(escaped(line) for line in panel.note.split("\n"))
    return (
        f'<div class="panel" data-title="{escaped(panel.title)}"><strong>{escaped(panel.title)}</strong>'
        f'<div class="pictures">{images}</div>{f"<table>{lines}</table>" if lines else ""}'
        f"<small>{key}{note}</small></div>"
    )


def _gallery(gallery: Gallery, name: str) -> str:
    """Write the panels, and before them a comparison of two pictures by a slider, which the script fills."""
    legend = "" if gallery.legend is None else f'<div class="legend">{_svg(gallery.legend.svg, name)}</div>'
    compare = (
        '<div class="compare" hidden><label>left <select class="left"></select></label> '
        '<label>right <select class="right"></select></label>'
        '<div class="stack"><img class="under" alt=""><img class="above" alt=""><div class="edge"></div></div>'
        '<input class="slider" type="range" min="0" max="100" value="50" aria-label="where left ends and right begins">'
        "</div>"
    )
    across = f' style="--across:{gallery.across}"' if gallery.across else ""
    kind = "panels hero" if gallery.hero else "panels"
    panels = "".join(_panel(panel) for panel in gallery.panels)
    return (
        f'<figure class="gallery">{legend}<figcaption>{escaped(gallery.caption)}</figcaption>'
        f'<div class="{kind}"{across}>{panels}</div>'
        f'<details class="sliding" open><summary>Compare two pictures by a slider</summary>{compare}</details></figure>'
    )
