"""Write the figures and tables of a run as files for a paper, each with the words that go below it."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import matplotlib

from harness import escaping
from reports.content import Table
from reports.for_papers import column, latex
from reports.for_papers.figures import plates
from reports.for_papers.model import Plate, Tabled
from reports.for_papers.tables import tables
from reports.material import Material

FIGURES = ("svg", "pdf", "png")
TABLES = ("latex", "csv", "markdown")
DPI = 600  # of a figure as PNG
_UNDATED: Mapping[str, Mapping[str, None]] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {}}


def write_figures(material: Material, forms: Sequence[str], folder: Path) -> list[Plate]:
    """Write each figure in these of FIGURES, each picture as PNG, and their captions, into `folder`; return them.

    Raises OSError where a file cannot be written.
    """
    made = plates(material)
    for plate in made:
        if plate.draw is None:
            (folder / f"{plate.name}.png").write_bytes(plate.png)
            continue
        drawing = plate.draw()
        with matplotlib.rc_context(column.SETTINGS):
            for form in forms:
                drawing.savefig(folder / f"{plate.name}.{form}", dpi=DPI, metadata=dict(_UNDATED[form]))
    _write_captions(made, lambda one: latex.figure_float(one, "figures"), folder)
    return made


def write_tables(material: Material, forms: Sequence[str], folder: Path) -> list[Tabled]:
    """Write each table in these of TABLES, and their captions, into `folder`; return them.

    Raises OSError where a file cannot be written.
    """
    made = tables(material)
    for form in forms:
        ending, write = _WRITERS[form]
        for tabled in made:
            (folder / f"{tabled.name}{ending}").write_text(write(tabled), encoding="utf-8")
    _write_captions(made, lambda one: latex.table_float(one, "tables"), folder)
    return made


def example(figures: Sequence[Plate], tabled: Sequence[Tabled]) -> str:
    """Return a LaTeX document that takes in all of these, from the folders figures and tables beside it."""
    floats = [latex.table_float(one, "tables") for one in tabled]
    return latex.example([*floats, *(latex.figure_float(one, "figures") for one in figures)])


def _write_captions(made: Sequence[Plate] | Sequence[Tabled], of: Callable[..., str], folder: Path) -> None:
    """Write captions.md, for any use, and captions.tex, a float for each to copy, into `folder`."""
    lines = [f"## {one.name}\n\n**{escaping.markdown(one.title)}** {escaping.markdown(one.caption)}\n" for one in made]
    (folder / "captions.md").write_text("\n".join(lines), encoding="utf-8")
    floats = "\n".join(of(one) for one in made)
    (folder / "captions.tex").write_text(floats, encoding="utf-8")


def _csv(tabled: Tabled) -> str:
    """Return a table as CSV: a line of headings, and values as they are, not rounded."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([escaping.cell(heading) for heading in _headings(tabled.table)])
    writer.writerows([[_value(value) for value in row] for row in tabled.table.rows])
    return text.getvalue()


def _value(value: object) -> object:
    """Return a value as CSV holds it: nothing for a missing one, and no formula of a spreadsheet for a text."""
    if isinstance(value, str):
        return escaping.cell(value)
    return "" if value is None or value != value else value


def _markdown(tabled: Tabled) -> str:
    """Return a table as Markdown, numbers to the right."""
    columns = tabled.table.columns
    lines = [
        [escaping.markdown(title) for title in _headings(tabled.table)],
        ["---:" if column.numeric else "---" for column in columns],
    ]
    for i, row in enumerate(tabled.table.rows):
        cells = [value if isinstance(value, str) else c.show(value) for c, value in zip(columns, row, strict=True)]
        cells = [escaping.markdown(cell) for cell in cells]
        lines.append([f"**{cell}**" if i in tabled.strong else cell for cell in cells])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _headings(table: Table) -> list[str]:
    """Return the columns' titles, each after the heading that it shares."""
    return [f"{c.over} {c.title}".strip() for c in table.columns]


_WRITERS: Mapping[str, tuple[str, Callable[[Tabled], str]]] = {
    "latex": (".tex", latex.table),
    "csv": (".csv", _csv),
    "markdown": (".md", _markdown),
}
