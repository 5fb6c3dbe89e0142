"""Make the page of a recommendation, which people pass on: question, answer, picture, errors, and the runners-up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from harness.results.writing import replacing
from reports import wording
from reports.content import Block, Code, Column, Document, Gallery, Panel, Picture, Section, Table, Text
from reports.drawing import images, plots
from reports.reading import arrays
from reports.rendering import document, html

EDGE = 4  # rows of pixels that are left above and below what is seen
PICTURES = "What it draws, and the error of every pixel"
LEGEND = (
    "Dark blue to yellow is |t − t*| in the surface's units, of rays that hit the right root. Bright colours are rays "
    "that are answered wrongly, paler where they graze the surface or f drowns in its own rounding."
)


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
    """Show what was drawn, and beside it the error of every pixel, without rows of pixels that show nothing."""
    read = arrays.read(path)
    seen = np.flatnonzero((~np.isnan(read.shade) | (read.wrong > 0)).any(axis=1))
    rows = slice(max(0, seen[0] - EDGE), seen[-1] + 1 + EDGE) if len(seen) else slice(None)
    scale = images.scale_of([read])
    pictures = (
        Picture("picture", images.png(images.shaded(read)[rows]), "The surface as the recommended variant draws it"),
        Picture("errors", images.png(images.error_map(read, scale)[rows]), "The error of each pixel of the picture"),
    )
    return Gallery((Panel(PICTURES, pictures, told),), LEGEND, plots.error_legend(*scale))


def _table(page: Recommended) -> Table:
    columns = (
        Column("method"),
        Column("the variant that\ncame farthest", stretch=2),
        Column("time", numeric=True),
        Column("largest\nerror", wording.error, numeric=True),
        Column("how far it came, and why no farther", stretch=6),
    )
    rows = [(o.method, o.variant, _times(o), o.error, o.why) for o in page.others]
    return Table(columns, rows, "All methods, the best first.", page.notes)


def _times(of: RunnerUp) -> str:
    return f"{wording.factor(of.times)}{'*' if of.early and of.times is not None else ''}"
