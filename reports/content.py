"""What a report consists of, whatever it is rendered to: sections of text, code, tables, figures and pictures.

Strings are plain text; a renderer escapes what its format needs. Table cells keep their values and are formatted by
their column, so that a renderer can sort by value.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from reports import wording


@dataclass(frozen=True)
class Text:
    text: str
    strong: bool = False


@dataclass(frozen=True)
class Code:
    """Something to copy: a command, a config."""

    text: str
    language: str = "sh"


@dataclass(frozen=True)
class Column:
    """A title may say by a line break where it is to be broken; neighbours with the same `over` share that heading."""

    title: str
    show: Callable[[Any], str] = wording.text
    numeric: bool = False
    stretch: int = 0  # its part of the width that columns of part 0 leave
    over: str = ""


@dataclass(frozen=True)
class Table:
    """The title names the table, the caption says what to see in it.

    `group` leading columns sort the rows into groups: a renderer may print their repeated values once.
    """

    columns: tuple[Column, ...]
    rows: Sequence[tuple[Any, ...]]
    title: str
    caption: str = ""
    group: int = 0


@dataclass(frozen=True)
class Figure:
    """A drawing as SVG text; `description` says to those who cannot see it what it shows."""

    name: str
    svg: str
    description: str
    title: str = ""
    caption: str = ""


@dataclass(frozen=True)
class Picture:
    name: str
    png: bytes
    description: str


@dataclass(frozen=True)
class Panel:
    """Pictures side by side with one title above and one note below."""

    title: str
    pictures: tuple[Picture, ...]
    note: str


@dataclass(frozen=True)
class Gallery:
    panels: tuple[Panel, ...]
    caption: str
    legend: Figure | None = None


Block = Text | Code | Table | Figure | Gallery


@dataclass(frozen=True)
class Section:
    """`wide` sections are set on landscape pages."""

    title: str
    blocks: tuple[Block, ...]
    wide: bool = False


@dataclass(frozen=True)
class Document:
    title: str
    subtitle: str
    summary: Section  # the first page, to stop after
    sections: tuple[Section, ...]
