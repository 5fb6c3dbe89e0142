"""Render blocks of content as HTML: texts, drawings and galleries of pictures.

Drawings are the same SVG as in the PDF. The ids of their series, which drawing.canvas.series writes, become data
attributes here, by which the page's script names the variant under the pointer and fades other methods.
"""

from __future__ import annotations

import re

from harness.escaping import html as escaped
from reports.content import Block, Code, Figure, Gallery, Matrix, Panel, Picture, Table, Text
from reports.drawing.canvas import SERIES
from reports.rendering import html_tables, pictures

_TAG = re.compile(r"<[^>]*>")  # not what stands between tags, which may look like attributes
_ID = re.compile(r'\s?\bid="([^"]+)"')
_REFERENCE = re.compile(r'(url\(#|href="#)([^")]+)')
_SLIDER = (
    '<details class="sliding" open hidden><summary>Compare two pictures by a slider</summary><div class="compare">'
    '<label>left <select class="left"></select></label> <label>right <select class="right"></select></label>'
    '<div class="stack"><img class="under" alt=""><img class="above" alt=""><div class="edge"></div></div>'
    '<input class="slider" type="range" min="0" max="100" value="50" aria-label="where left ends and right begins">'
    "</div></details>"
)
_UNSEEN = re.compile(r"<metadata>.*?</metadata>|<!--.*?-->", re.DOTALL)
_PATH = re.compile(r'\bd="[^"]*"')
_PLACE = re.compile(r'\b[xy]="[-\d.]+"')
_UNTURNED = re.compile(r' transform="rotate\(-?0 [-\d. ]+\)"')
_DIGITS = re.compile(r"(\.\d\d)\d+")
_WIDTH = re.compile(r'<svg(\s[^>]*?)width="([\d.]+pt)"')
_NAMED = re.compile(f'<g id="{re.escape(SERIES)}([^"]*)"')


def block(of: Block, name: str) -> str:
    """Write a block as HTML; `name` begins the ids within it."""
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
            return _figure(of, name)
        case Gallery():
            return _gallery(of, name)


def _figure(figure: Figure, name: str) -> str:
    """Write a figure: its drawing above its caption."""
    caption = html_tables.caption(figure.title, figure.caption)
    return f'<figure class="drawing">{_drawn(figure, name, "drawn")}<figcaption>{caption}</figcaption></figure>'


def _drawn(figure: Figure, name: str, kind: str) -> str:
    """Write a figure's drawing as a picture with a description, in a box of the class `kind`."""
    told = escaped(figure.description)
    return f'<div class="{kind}" role="img" aria-label="{told}">{_svg(figure.svg, name)}</div>'


def _svg(svg: str, name: str) -> str:
    """Return a drawing as a part of the page: `name` begins its ids, and its series become data attributes.

    What no browser shows is left out, with the ids that nothing refers to; places have hundredths of a point.
    """
    own = _UNSEEN.sub("", svg[svg.index("<svg") :])
    own = re.sub(r">\s+<", "><", own)
    meant = {found[2] for tag in _TAG.findall(own) for found in _REFERENCE.finditer(tag)}

    def place(tag: re.Match[str]) -> str:
        told = _UNTURNED.sub("", tag[0])
        for places in (_PATH, _PLACE):
            told = places.sub(lambda found: _DIGITS.sub(r"\1", found[0]), told)
        told = _NAMED.sub(lambda found: f'<g class="series" data-series="{found[1]}"', told)
        told = _ID.sub(lambda found: f' id="{name}-{found[1]}"' if found[1] in meant else "", told)
        return _REFERENCE.sub(rf"\1{name}-\2", told)

    own = _TAG.sub(place, own)
    return _WIDTH.sub(lambda found: f'<svg style="--own:{found[2]}"{found[1]} ', own, count=1)


def _picture(picture: Picture) -> str:
    """Write a picture as an HTML image that holds its bytes."""
    address, width, height = pictures.held(picture.png)
    size = f'width="{width}" height="{height}"'
    return f'<img alt="{escaped(picture.description)}" {size} decoding="async" src="{address}">'


def _panel(panel: Panel) -> str:
    """Write a panel: its title, its pictures and its texts, which stand beside the pictures where there are many."""
    images = "".join(_picture(picture) for picture in panel.pictures)
    notes = "".join(f"<small>{escaped(note)}</small>" for note in panel.note.split("\n") if note)
    kind = "panel card" if panel.lines else "panel"
    return (
        f'<div class="{kind}" data-title="{escaped(panel.title)}"><strong>{escaped(panel.title)}</strong>'
        f'<div class="pictures">{images}</div>'
        f'<div class="told">{_lines(panel)}{notes}{html_tables.key(panel.key)}</div></div>'
    )


def _lines(panel: Panel) -> str:
    """Write a panel's small table; "" where it has none."""
    if not panel.lines:
        return ""
    first, *rest = panel.lines
    head = "".join(f'<th scope="col">{escaped(cell)}</th>' for cell in first)
    rows = "".join(
        f'<tr><th scope="row">{escaped(name)}</th>{"".join(f"<td>{escaped(cell)}</td>" for cell in cells)}</tr>'
        for name, *cells in rest
    )
    hidden = f'<caption class="unseen">{escaped(panel.title)}</caption>'
    return f'<table class="lines">{hidden}<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>'


def _gallery(gallery: Gallery, name: str) -> str:
    """Write the panels, and behind them a comparison of two pictures by a slider, which the script fills.

    A hero stands first and large; the legend and the caption are of the others. Pictures with a legend of errors show
    one surface in one view, and only those are compared.
    """
    legend = "" if gallery.legend is None else _drawn(gallery.legend, name, "legend")
    slider = "" if gallery.legend is None else _SLIDER
    across = f' style="--across:{gallery.across}"' if gallery.across else ""
    panels = [_panel(panel) for panel in gallery.panels]
    heroes = 1 if gallery.hero else 0
    hero = f'<div class="hero">{panels[0]}</div>' if heroes and panels else ""
    return (
        f'<figure class="gallery">{hero}{legend}<figcaption>{escaped(gallery.caption)}</figcaption>'
        f'<div class="panels"{across}>{"".join(panels[heroes:])}</div>{slider}</figure>'
    )
