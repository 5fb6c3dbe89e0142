"""The papers' tables as they print them, one CSV each. A file's first line, after #, is its citation."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

FOLDER = Path(__file__).parent


@dataclass(frozen=True)
class Published:
    """One table of a paper; every row maps the file's column names to the texts printed."""

    name: str
    citation: str
    rows: tuple[dict[str, str], ...]

    def number(self, column: str, **where: str | int) -> float | None:
        """The figure in `column` of the one row that `where` picks; None where the paper has no such row."""
        found = [row for row in self.rows if all(row[name] == str(value) for name, value in where.items())]
        return float(found[0][column]) if len(found) == 1 else None


@cache
def table(name: str) -> Published:
    """The table in NAME.csv; FileNotFoundError where there is none."""
    first, *lines = (FOLDER / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    return Published(name, first.removeprefix("#").strip(), tuple(csv.DictReader(lines)))


def names() -> tuple[str, ...]:
    return tuple(sorted(path.stem for path in FOLDER.glob("*.csv")))
