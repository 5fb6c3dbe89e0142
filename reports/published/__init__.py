"""The papers' tables as they print them, a CSV file for each. A file's first line is its citation, after a #."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

FOLDER = Path(__file__).parent


@dataclass(frozen=True)
class Published:
    """One table of a paper; a row has the texts printed, by the names of the file's columns."""

    name: str
    citation: str
    rows: tuple[dict[str, str], ...]

    def number(self, column: str, **where: str | int) -> float | None:
        """Return the figure in `column` of the one row whose cells `where` states; None unless exactly one has them."""
        found = [row for row in self.rows if all(row[name] == str(value) for name, value in where.items())]
        return float(found[0][column]) if len(found) == 1 else None


@cache
def table(name: str) -> Published:
    """Read the table in NAME.csv; a FileNotFoundError where there is none."""
    first, *lines = (FOLDER / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    return Published(name, first.removeprefix("#").strip(), tuple(csv.DictReader(lines)))
