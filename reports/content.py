"""Define what a report consists of, whatever its format: sections of text, code, tables, figures and pictures.

All strings are plain text; a renderer escapes what its format requires. A table's cells keep their values, and their
column formats them, so that a renderer can sort by value.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from reports import wording


@dataclass(frozen=True)
class Text:
    """Hold a paragraph; a `strong` one is set in bold."""

    text: str
    strong: bool = False


@dataclass(frozen=True)
class Code:
    """Hold a text to copy: a command or a config."""

    text: str
    language: str = "sh"


@dataclass(frozen=True)
class Column:
    """Hold a column of a table: its title, and how its values are written.

    A line break in the title marks where a renderer may break it. Adjacent columns with the same `over` share that text
    as a common heading.
    """

    title: str
    show: Callable[[Any], str] = wording.text
    numeric: bool = False
    stretch: int = 0  # this column's part of the width that columns with stretch 0 leave over
    over: str = ""


@dataclass(frozen=True)
class Table:
    """Hold a table: the title says what it is, the caption what to look for in it.

    Rows are sorted into groups by their first `group` columns; a renderer may print a repeated value of these once.
    """

    columns: tuple[Column, ...]
    rows: Sequence[tuple[Any, ...]]
    title: str
    caption: str = ""
    group: int = 0


@dataclass(frozen=True)
class Square:
    """Hold a cell of a Matrix: its text, its colour as "#rrggbb" ("" for none), and what a reader who asks is told."""

    text: str
    color: str = ""
    note: str = ""
    strong: bool = False


@dataclass(frozen=True)
class Matrix:
    """Hold a table of coloured squares, a line for each of `rows`: its heading, and a square for each of `columns`.

    The colours stand for what the squares' texts say too, so that nothing is lost in greyscale. `corner` says what the
    rows' headings are, and `key` what the colours mean: texts by colour. A line without squares is a heading over the
    lines below it.
    """

    columns: tuple[str, ...]
    rows: Sequence[tuple[str, tuple[Square, ...]]]
    title: str
    caption: str = ""
    corner: str = ""
    key: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Figure:
    """Hold a drawing as SVG text. `description` tells readers who cannot see it what it shows."""

    name: str
    svg: str
    description: str
    title: str = ""
    caption: str = ""


@dataclass(frozen=True)
class Picture:
    """Hold an image as a PNG file's bytes. `description` tells readers who cannot see it what it shows."""

    name: str
    png: bytes
    description: str


@dataclass(frozen=True)
class Panel:
    """Hold pictures to be set side by side, with one title above and one note below.

    `lines` are a small table that belongs to the pictures: texts, the first line headings. `key` says what colours in
    the pictures mean: texts by colour. A note may have several paragraphs, each on a line of its own.
    """

    title: str
    pictures: tuple[Picture, ...]
    note: str
    lines: Sequence[tuple[str, ...]] = ()
    key: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Gallery:
    """Hold panels of pictures with one caption, and one legend of their colours if they need one.

    `across` is how many panels a line of a page has; 0 leaves it to the renderer. The first panel of a gallery with a
    `hero` is shown large, with its texts beside it; then come legend and caption, which are of the others, below it.
    """

    panels: tuple[Panel, ...]
    caption: str
    legend: Figure | None = None
    across: int = 0
    hero: bool = False


@dataclass(frozen=True)
class Explorer:
    """Hold points of speed against error, which a reader of the HTML page compares by axes of his own choice.

    columns: the points' values by column, which reports.drawing.charts names; all have the same length
    chart: the Vega-Lite specification of a panel, whose data the page's script gives
    note: which rows are left out; "" for none
    """

    columns: Mapping[str, Sequence[Any]]
    chart: Mapping[str, Any]
    note: str = ""


Block = Text | Code | Table | Matrix | Figure | Gallery


@dataclass(frozen=True)
class Section:
    """Hold a titled part of a report.

    blocks: what everybody reads; a section without any is left out of the PDF
    details: long tables and what else only some look up. The HTML page has them folded, the PDF in its appendix, which
        is made on request
    own_page: the section begins a page of the PDF
    name: what contents call it where its title is too long; "" takes the title
    """

    title: str
    blocks: tuple[Block, ...]
    details: tuple[Block, ...] = ()
    own_page: bool = False
    name: str = ""


@dataclass(frozen=True)
class Document:
    """Hold a whole report."""

    title: str
    subtitle: str
    summary: Section  # the first page; a reader in a hurry reads nothing else
    sections: tuple[Section, ...]
    explorer: Explorer | None = None  # which stands behind the summary, on the HTML page alone
