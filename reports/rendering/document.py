"""Render content as PDF. The template reads the report as JSON and files, so that no text is parsed as markup."""

from __future__ import annotations

import itertools
import json
import shutil
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path
from typing import Any

import matplotlib
import typst

from harness import escaping
from harness.results.writing import temporary_folder
from reports.content import Block, Code, Document, Figure, Gallery, Matrix, Section, Square, Table, Text
from reports.drawing import shades

HERE = Path(__file__).parent
REPORT, ONE_PAGE = "report.typ", "one_page.typ"  # templates; both read blocks.typ
PIXELS_PER_INCH = 144  # of a page that is a picture


def write_pdf(document: Document, folder: Path, pdf: Path, created: str, appendix: bool = False) -> None:
    """Write `document` as the file `pdf`; the template's inputs go into `folder`, which must not exist yet.

    With `appendix` the details of all sections are at its end. `created` becomes the PDF's date if it is one by ISO
    8601, so that the same run gives the same bytes. Raises ValueError where two figures or pictures of one name differ,
    and OSError where a file cannot be written.
    """
    folder.mkdir()
    _lay_out(document, folder, REPORT, appendix)
    typst.compile(folder / REPORT, output=pdf, timestamp=_timestamp(created), **_settings(folder))


def write_page(document: Document, path: Path, created: str) -> None:
    """Write the summary of `document` as one page, as a PDF or, where `path` ends so, as a PNG.

    `created` is as for `write_pdf`, and so is what is raised.
    """
    form = "png" if path.suffix.lower() == ".png" else "pdf"
    with temporary_folder("firsthit-page") as folder:
        _lay_out(document, folder, ONE_PAGE)
        told: dict[str, Any] = {"ppi": PIXELS_PER_INCH} if form == "png" else {"timestamp": _timestamp(created)}
        settings = {**_settings(folder), **told, "format": form, "sys_inputs": {"form": form}}
        path.write_bytes(typst.compile(folder / ONE_PAGE, **settings))


def _lay_out(document: Document, folder: Path, template: str, appendix: bool = False) -> None:
    """Put into `folder` what a template reads: its own files, the document as JSON, and the pictures."""
    detailed = [section for section in document.sections if section.details] if appendix else []
    for file in (template, "blocks.typ"):
        shutil.copy(HERE / file, folder)
    data = {
        "title": document.title,
        "subtitle": document.subtitle,
        "summary": _section(document.summary, document.summary.blocks, folder),
        "sections": [_section(section, section.blocks, folder) for section in document.sections if section.blocks],
        "appendix": [_section(section, section.details, folder) for section in detailed],
    }
    (folder / "report.json").write_text(json.dumps(escaping.every(data), ensure_ascii=False), encoding="utf-8")


def _settings(folder: Path) -> dict[str, Any]:
    """Return what both templates are compiled with: fonts of the package alone, for the same pages on every machine."""
    fonts = [Path(matplotlib.get_data_path()) / "fonts" / "ttf"]
    return {"root": folder, "font_paths": fonts, "ignore_system_fonts": True}


def _timestamp(created: str) -> int | None:
    """Return the date `created`, by ISO 8601, as seconds since 1970; None where the text is no such date."""
    try:
        return int(datetime.fromisoformat(created).timestamp())
    except ValueError:
        return None


def _section(section: Section, blocks: Sequence[Block], folder: Path) -> dict[str, Any]:
    """Return a section with these of its blocks as the template reads it; its pictures go into `folder`."""
    return {
        "title": section.title,
        "name": section.name or section.title,
        "own_page": section.own_page,
        "blocks": [_block(block, folder) for block in blocks],
    }


def _block(block: Block, folder: Path) -> dict[str, Any]:
    """Return a block as the template reads it; its pictures go into `folder`."""
    match block:
        case Text():
            return {"kind": "text", "text": block.text, "strong": block.strong}
        case Code():
            return {"kind": "code", "text": block.text, "language": block.language}
        case Table():
            return _table(block)
        case Matrix():
            return _matrix(block)
        case Figure():
            return _figure(block, folder)
        case Gallery():
            return _gallery(block, folder)


def _table(table: Table) -> dict[str, Any]:
    """Return a table as the template reads it; a grouping value that repeats the row above is left blank."""
    rows = []
    above: tuple[Any, ...] = ()
    for row in table.rows:
        printed = [column.show(value) for column, value in zip(table.columns, row, strict=True)]
        same = 0
        while same < table.group and row[: same + 1] == above[: same + 1]:
            same += 1
        cells = ["" if i < same else cell for i, cell in enumerate(printed)]
        rows.append({"cells": cells, "opens": same < table.group})
        above = row
    return {
        "kind": "table",
        "columns": [{"title": c.title, "numeric": c.numeric, "stretch": c.stretch} for c in table.columns],
        "headings": [
            {"title": over, "span": len(list(columns))}
            for over, columns in itertools.groupby(table.columns, key=lambda column: column.over)
        ],
        "rows": rows,
        "title": table.title,
        "caption": table.caption,
    }


def _matrix(matrix: Matrix) -> dict[str, Any]:
    """Return a matrix as the template reads it."""
    rows = [
        {
            "heading": heading,
            "squares": [_square(square) for square in squares],
        }
        for heading, squares in matrix.rows
    ]
    return {
        "kind": "matrix",
        "columns": list(matrix.columns),
        "rows": rows,
        "corner": matrix.corner,
        "key": [{"color": color, "text": text} for color, text in matrix.key.items()],
        "title": matrix.title,
        "caption": matrix.caption,
    }


def _square(square: Square) -> dict[str, Any]:
    """Return a square of a matrix as the template reads it."""
    ink = shades.ink(square.color) if square.color else None
    return {"text": square.text, "color": square.color or None, "ink": ink, "strong": square.strong}


def _figure(figure: Figure, folder: Path) -> dict[str, Any]:
    """Return a figure as the template reads it; its drawing goes into `folder`. Raises ValueError as `_write` does."""
    file = f"{figure.name}.svg"
    _write(folder / file, figure.svg.encode())
    told = {"title": figure.title, "caption": figure.caption, "description": figure.description}
    return {"kind": "figure", "file": file, **told}


def _write(path: Path, made: bytes) -> None:
    """Write a picture's file. Raises ValueError where another picture of the report has this name."""
    if path.exists() and path.read_bytes() != made:
        raise ValueError(f"two figures of one report are named {path.stem}")
    path.write_bytes(made)


def _gallery(gallery: Gallery, folder: Path) -> dict[str, Any]:
    """Return a gallery as the template reads it; its pictures go into `folder`. Raises ValueError as `_write` does."""
    panels = []
    for panel in gallery.panels:
        for picture in panel.pictures:
            _write(folder / f"{picture.name}.png", picture.png)
        pictures = [{"file": f"{picture.name}.png", "description": picture.description} for picture in panel.pictures]
        told = {"title": panel.title, "note": panel.note, "lines": [list(line) for line in panel.lines]}
        key = [{"color": color, "text": text} for color, text in panel.key.items()]
        panels.append({**told, "key": key, "pictures": pictures})
    legend = None if gallery.legend is None else _figure(gallery.legend, folder)
    shape = {"across": gallery.across, "hero": gallery.hero}
    return {"kind": "gallery", "panels": panels, "legend": legend, "caption": gallery.caption, **shape}
