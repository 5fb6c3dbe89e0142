"""Read what a report says of a method: its page (the docstring of method.py), its knobs and claims.

A page is a title line, a paragraph that says what the method does, and parts that begin with a bold name. A part holds
text, points that begin with "- ", and tables:

    what was tried                            measured          kept
    ----------------------------------------  ----------------  ----
    blocks of 8 steps instead of one step     5.8 times faster  yes
    blocks of 4 pixels by 4 for the 16 rays   1.03 to 1.07      no
      of a vector

A rule of dashes marks the columns: each begins where its dashes begin. The line above the rule names them. A table ends
at an empty line. A line that leaves the last column empty goes on with the row above it.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError
from harness.plugins import BUILT_IN, Plugin
from harness.stated import read_file

_PART = re.compile(r"^\*\*(.+?)\*\*", re.MULTILINE)
_RULE = re.compile(r" *--+(?: +--+)+")


def card(plugin: Plugin) -> dict[str, Any]:
    """Return what a report needs, JSON-able.

    label: how people write the method's name
    title, summary: the page's first line, and what stands between it and the first part
    source: the part Source, or the method's own `source`
    doc: the other parts' text by name, a line for each paragraph and point
    tables: part, header and rows of each table, in the page's order
    parameters, claims: of the method
    outside: the folder of a method from outside the project, else None
    """
    method = plugin.method
    text = _docstring(plugin.folder / "method.py")
    title, _, rest = text.partition("\n")
    summary, *pieces = _PART.split(rest)
    doc, tables = {}, []
    for part, body in zip(pieces[::2], pieces[1::2], strict=True):
        said, found = _parted(body)
        doc[part] = _folded(said)
        tables += [{"part": part} | table for table in found]
    return {
        "label": method.label,
        "title": title,
        "summary": _folded(summary),
        "source": doc.pop("Source", method.source),
        "doc": {part: said for part, said in doc.items() if said},
        "tables": tables,
        "parameters": [
            {"name": p.name, "default": p.default, "meaning": p.meaning, "printed": p.printed}
            for p in method.parameters
        ],
        "claims": sorted(method.claims),
        "outside": None if plugin.folder.is_relative_to(BUILT_IN) else str(plugin.folder),
    }


def _docstring(path: Path) -> str:
    """Return the docstring of a method.py; "" where it has none, or cannot be read, as a method that is not loaded."""
    try:
        return ast.get_docstring(ast.parse(read_file(path))) or ""
    except (FirsthitError, SyntaxError, ValueError, RecursionError, MemoryError):
        return ""


def _parted(body: str) -> tuple[str, list[dict[str, Any]]]:
    """Return a part's text without its tables, and the tables: header and rows."""
    lines = body.split("\n")
    said: list[str] = []
    tables = []
    while lines:
        line = lines.pop(0)
        if not said or not _RULE.fullmatch(line):
            said.append(line)
            continue
        starts = [dashes.start() for dashes in re.finditer("-+", line)]
        rows = []
        while lines and lines[0].strip():
            rows.append(_cells(lines.pop(0), starts))
        tables.append({"header": _cells(said.pop(), starts), "rows": _joined(rows)})
    return "\n".join(said), tables


def _cells(line: str, starts: list[int]) -> list[str]:
    """Cut a table's line into cells, which begin at the columns `starts`."""
    return [line[a:b].strip() for a, b in zip(starts, [*starts[1:], None], strict=True)]


def _joined(lines: list[list[str]]) -> list[list[str]]:
    """Return rows from the lines of a table: a line that fills the last column begins a row."""
    rows: list[list[str]] = []
    for cells in lines:
        if cells[-1] or not rows:
            rows.append(cells)
        else:
            rows[-1] = [f"{above} {below}".strip() for above, below in zip(rows[-1], cells, strict=True)]
    return rows


def _folded(text: str) -> str:
    """Return one line for each paragraph and one for each point of a list; a point's line starts with "- "."""
    pieces = re.split(r"\n\s*\n|\n(?=- )", text)
    return "\n".join(" ".join(piece.split()) for piece in pieces if piece.strip()).lstrip(" ,.:;")
