"""Make up the content of an HTML page that has all that a page can show."""

from __future__ import annotations

import io
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure as Drawing
from PIL import Image

from reports import wording
from reports.analysis import derive
from reports.content import (
    Code,
    Column,
    Document,
    Figure,
    Gallery,
    Matrix,
    Panel,
    Picture,
    Section,
    Square,
    Table,
    Text,
)
from reports.drawing import canvas, charts, style
from reports.reading import load

EVIL = '</script><b title="x">&\u2028'  # a name that a surface or a plugin may have
SHOWN = '</script><b title="x">&\\u2028'  # the same name on the page: what cannot be seen is written as an escape


def picture(name: str, shade: int) -> Picture:
    """Make a picture of 2 × 2 pixels, each repeated 60 × 60 times."""
    pixels = np.full((2, 2, 3), shade, np.uint8)
    pixels[0, 1] = (250, 10, 10)
    made = io.BytesIO()
    Image.fromarray(pixels.repeat(60, 0).repeat(60, 1)).save(made, "PNG")
    return Picture(name, made.getvalue(), f"{name} of {EVIL}")


def drawing() -> str:
    """Draw a line of two variants of newton, and a point of ray_march."""
    with matplotlib.rc_context(canvas.RC):
        drawn = Drawing(figsize=(3, 2))
        axes = drawn.subplots()
        axes.plot([1, 2], [1, 2], marker="o", ms=9, gid=canvas.series("newton", "newton[EPSILON=0.001]", "newton, 2"))
        axes.plot([1], [2], marker="s", ms=9, gid=canvas.series("ray_march", "ray_march"))
        return canvas.svg(drawn)


def made(run: Path) -> tuple[Document, dict[str, style.Mark]]:
    """Make a document that has all that a page can show, of the rows of `run`, and the marks of its methods."""
    loaded = load.load(run)
    frame = derive.derive(loaded.frame, loaded.plan.peaks)
    frame = frame.assign(surface_title=frame["surface_title"].replace("Torus", f"Torus {EVIL}"))
    explorer = charts.explorer(frame)
    number = Column("wide\nnumber", lambda value: f"{value} " * 9, numeric=True, over="both")
    rows = [(f"row {i} {EVIL}", (7 * i) % 5 + i / 10, (1000, 9, 80)[i % 3], f"{i} " * 30) for i in range(6)]
    whole = Column("count", wording.count, numeric=True, over="both")
    table = Table((Column("name"), number, whole, Column("text")), rows, "A table.", "Told.")
    squares = tuple(Square(f"{i}", color, f"note {i} {EVIL}") for i, color in enumerate(("#0072B2", "#f0e442", "")))
    lines = [("of a kind", ()), ("newton", (*squares, Square("none"))), ("ray_march", squares[::-1] + squares[:1])]
    matrix = Matrix(tuple("abcd"), lines, "A matrix.", "Colours.", "method", {"#0072B2": "good", "#f0e442": "bad"})
    panels = tuple(
        Panel(f"{name} {EVIL}", (picture(f"{name} drawn", 40 * i), picture(f"{name} error", 40 * i + 9)), "a note")
        for i, name in enumerate(("newton, 2", "newton, 3", "_odd#"))
    )
    card = (("error", "fastest"), ("10⁻³", "newton"))
    hero = Panel("large", (picture("large", 90),), "one note\nanother note", card, {"#0072B2": "a miss"})
    heroic = Gallery((hero, *panels), "Heroic.", hero=True, across=3)
    legend = Figure("legend", drawing(), "a legend")
    figure = Figure("figure", drawing(), "a drawing", "Drawn.", "A line and a point.")
    summary = Section("Summary", (Text("The answer.", strong=True), Code("firsthit run quick --runs " + "x" * 200)))
    sections = (
        Section(f"Tables {EVIL}", (table, matrix), name="Tables"),
        Section("Drawings", (figure, Gallery(panels, "Pictures.", legend), heroic)),
        Section("Folded", (), (table,)),
        Section("Long", tuple(Text("word " * 120) for _ in range(8)), (table,)),
    )
    marks = style.marks(["newton", "ray_march", "_odd#", "null"])
    return Document(f"A page of {EVIL}", "under it", summary, sections, explorer), marks
