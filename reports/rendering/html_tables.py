"""Render tables and matrices as HTML: their cells have headings of rows and columns, and a caption of their own."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from harness.escaping import html as escaped
from reports.content import Column, Matrix, Square, Table
from reports.drawing import shades

ROWS = 1000  # of a table that the page has at most


def caption(title: str, told: str) -> str:
    """Write title and caption of a figure or a table; "" without either."""
    return f"<strong>{escaped(title)}</strong> {escaped(told)}" if title or told else ""


def table(of: Table) -> str:
    """Write a table whose cells have their values beside their texts, so that numbers sort as numbers.

    A table of one row of long texts becomes paragraphs with headings, side by side where the page is wide enough. Of
    more rows than ROWS the first ones are written.
    """
    titled = any(column.title for column in of.columns)
    if titled and len(of.rows) == 1 and not of.title and all(column.stretch for column in of.columns):
        return _paragraphs(of)
    rows = "".join(f"<tr>{_cells(of.columns, row)}" for row in of.rows[:ROWS])
    head = _head(of.columns) if titled else ""
    rest = f"These are the first {ROWS:,} of {len(of.rows):,} rows. " if len(of.rows) > ROWS else ""
    rest += "results.csv has all rows of the run." if rest else ""
    told = caption(of.title, f"{of.caption} {rest}".strip())
    return _boxed("table", of.title, told, f"{head}<tbody>{rows}</tbody>")


def _paragraphs(of: Table) -> str:
    """Write the texts of a table's only row below the headings of their columns."""
    texts = (
        f"<div><h3>{escaped(column.title)}</h3><p>{escaped(column.show(value))}</p></div>"
        for column, value in zip(of.columns, of.rows[0], strict=True)
    )
    return f'<div class="beside">{"".join(texts)}</div>'


def _boxed(kind: str, title: str, told: str, rows: str) -> str:
    """Put the rows of a table into a box of their own, which scrolls sideways where the page is too narrow."""
    heading = f"<caption><div>{told}</div></caption>" if told else ""
    name = f'role="region" aria-label="{escaped(title)}"' if title else 'role="group" aria-label="table"'
    return (
        f'<figure class="{kind}"><div class="scroll" tabindex="0" {name}><table>{heading}{rows}</table></div></figure>'
    )


def _head(columns: Sequence[Column]) -> str:
    """Write the headings: one line, or two where adjacent columns share a heading."""
    over = [(name, len(list(own))) for name, own in itertools.groupby(columns, key=lambda column: column.over)]
    groups = "".join(
        f'<th class="over" colspan="{span}" scope="colgroup">{escaped(name)}</th>'
        if name
        else f'<td class="over" colspan="{span}"></td>'
        for name, span in over
    )
    titles = "".join(f'<th scope="col"{_kind(column)}>{escaped(column.title)}</th>' for column in columns)
    return f"<thead>{f'<tr>{groups}</tr>' if len(over) > 1 else ''}<tr>{titles}</tr></thead>"


def _kind(column: Column) -> str:
    """Return the class of a column's cells.

    Most cells are numbers, and have none; long texts are not squeezed where the page is narrow.
    """
    return "" if column.numeric else " class=long" if column.stretch else " class=t"


def _cells(columns: Sequence[Column], row: tuple[Any, ...]) -> str:
    """Write the cells of one row, the first one as the row's heading.

    A number has its value in six digits beside it where its text says another one, or in another way. End tags, and
    quotes where HTML needs none, are left out: a long report has a hundred thousand cells.
    """
    cells = []
    for i, (column, value) in enumerate(zip(columns, row, strict=True)):
        text = column.show(value)
        number = "" if isinstance(value, str | bool) or pd.isna(value) else f"{float(value):.6g}"
        key = f" data-v={number}" if number and not (column.numeric and number == text) else ""
        tag, scope = ("td", "") if i else ("th", " scope=row")
        cells.append(f"<{tag}{scope}{_kind(column)}{key}>{escaped(text)}")
    return "".join(cells)


def matrix(of: Matrix) -> str:
    """Write a matrix as a table. What a square's note says is shown to who points at it, taps it or reaches it by keys.

    It is in the page as text, so that it is read aloud and found.
    """
    head = "".join(f'<th scope="col">{escaped(name)}</th>' for name in of.columns)
    body = "".join(
        f'<tr><th scope="row">{escaped(heading)}</th>{"".join(map(_square, squares))}</tr>'
        if squares
        else f'</tbody><tbody><tr><th scope="rowgroup" colspan="{1 + len(of.columns)}">{escaped(heading)}</th></tr>'
        for heading, squares in of.rows
    )
    return _boxed(
        "matrix",
        of.title,
        caption(of.title, of.caption) + key(of.key),
        f'<thead><tr><th scope="col">{escaped(of.corner)}</th>{head}</tr></thead>'
        + f"<tbody>{body}</tbody>".replace("<tbody></tbody>", ""),
    )


def key(colors: Mapping[str, str]) -> str:
    """Write what colours mean: a square and a text for each; "" for none."""
    entries = "".join(
        f'<li><span style="background:{escaped(color)}"></span>{escaped(told)}</li>' for color, told in colors.items()
    )
    return f'<ul class="key">{entries}</ul>' if entries else ""


def _square(square: Square) -> str:
    """Write one cell of a matrix."""
    style = f' style="background:{square.color};color:{shades.ink(square.color)}"' if square.color else ""
    text = f"<b>{escaped(square.text)}</b>" if square.strong else escaped(square.text)
    if not square.note:
        return f"<td{style}>{text}</td>"
    note = f'<span class="note">{escaped(square.note)}</span>'
    return f'<td{style}><button type="button" class="square">{text}{note}</button></td>'
