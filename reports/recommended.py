"""Make the page of a recommendation, which people pass on: question, answer, picture, errors, and the runners-up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from harness.results.writing import replacing
from reports import wording
from reports.content import Block, Code, Column, Document, Gallery, Panel, Picture, Section, Table, Text
from reports.drawing import images, plots
from reports.reading import arrays
from reports.rendering import document, html


@dataclass(frozen=True)
class RunnerUp:
    """Hold what the page says of one method.

    variant: of its variants the one that came farthest
    times: its time over the recommended one's or, where `early`, over the fastest's in a first short timing
    error: its largest error, scene units
    """

    method: str
    variant: str
    times: float | None
    early: bool
    error: float | None
    why: str


@dataclass(frozen=True)
class Recommended:
    """Hold what the page says; texts are plain sentences.

    facts: what is known of the answer: a name and a text each
    arrays: the file of the picture's answers; None where there is no picture
    picture: what the picture shows
    """

    title: str
    subtitle: str
    question: str
    answer: str
    facts: Sequence[tuple[str, str]]
    arrays: Path | None
    picture: str
    others: Sequence[RunnerUp]
    notes: str
    commands: Sequence[tuple[str, str]]


def write(page: Recommended, path: Path, created: str) -> None:
    """Write the page as a PDF, an HTML or a PNG file, by the ending of `path`; it is written whole or not at all.

    `created`, by ISO 8601, becomes the PDF's date. Raises FirsthitError where it cannot be written.
    """
    made = content(page)
    with replacing(path) as temporary:
        if path.suffix.lower() == ".html":
            html.write_html(made, {}, temporary)
        else:
            document.write_page(made, temporary, created)


def content(page: Recommended) -> Document:
    """Return the page's content. Raises ValueError or OSError where the picture's file is damaged."""
    facts = Table((Column(""), Column("", stretch=1)), page.facts, "")
    blocks: list[Block] = [Text(page.question), Text(page.answer, strong=True)]
    if page.arrays is not None:
        blocks.append(_pictures(page.arrays, page.picture))
    blocks += [facts, *([_table(page)] if page.others else [])]
    for name, command in page.commands:
        blocks += [Text(name), Code(command)]
    return Document(page.title, page.subtitle, Section("Recommendation", tuple(blocks)), ())


def _pictures(path: Path, told: str) -> Gallery:
    """Show what was drawn, and beside it the error of every pixel."""
    read = arrays.read(path)
    scale = images.scale_of([read])
    pictures = (
        Picture("picture", images.png(images.shaded(read)), "The surface as the recommended variant draws it"),
        Picture("errors", images.png(images.error_map(read, scale)), "The error of each pixel of the picture"),
    )
    return Gallery(
        (Panel("What it draws, and the error of every pixel", pictures, told),), "", plots.error_legend(*scale)
    )


def _table(page: Recommended) -> Table:
    columns = (
        Column("method"),
        Column("its best variant", stretch=2),
        Column("time", _times, numeric=True),
        Column("largest\nerror", wording.error, numeric=True),
        Column("why it is not recommended", stretch=6),
    )
    rows = [(o.method, o.variant, (o.times, o.early), o.error, o.why) for o in page.others]
    return Table(columns, rows, "The other methods.", page.notes)


def _times(value: tuple[float | None, bool]) -> str:
    times, early = value
    return f"{wording.factor(times)}{'*' if early and times is not None else ''}"
