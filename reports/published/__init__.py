"""Hold the papers' tables as they print them, in a CSV file for each.

The first line of a file is its citation, after a #.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

FOLDER = Path(__file__).parent


@dataclass(frozen=True)
class Published:
    """Hold one table of a paper; a row maps the names of the file's columns to the texts printed."""

    name: str
    citation: str
    rows: tuple[dict[str, str], ...]

    def number(self, column: str, **where: str | int) -> float | None:
        """Return the figure in `column` of the one row whose cells `where` states; None unless exactly one has them.

        Raises KeyError where the file lacks a column, and ValueError where the cell holds no number.
        """
        found = [row for row in self.rows if all(row[name] == str(value) for name, value in where.items())]
        return float(found[0][column]) if len(found) == 1 else None


@cache
def table(name: str) -> Published:
    """Read the table in NAME.csv. Raises FileNotFoundError where there is none."""
    first, *lines = (FOLDER / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    return Published(name, first.removeprefix("#").strip(), tuple(csv.DictReader(lines)))
