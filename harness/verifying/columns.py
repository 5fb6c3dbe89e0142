"""Hold the columns of Parquet parts, which reports read, against the rows that the parts hold."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from harness.results import compaction
from harness.results.parts import KEY, TEXT, Part
from harness.results.store import Row, Store, row_of
from harness.verifying.model import Wrong


@dataclass(frozen=True)
class Group:
    """Name a group of rows of a part whose hash holds."""

    path: Path
    number: int


def groups_of(folder: Path) -> list[Group]:
    """List the groups of rows of a run's parts; the damaged parts are left out, whose columns nobody reads."""
    parts = [part for part in Store(folder).parts.all() if not part.problem]
    return [Group(part.path, number) for part in parts for number in range(len(part.ends))]


def columns_of(group: Group) -> tuple[int, list[tuple[Path, str, Wrong]]]:
    """Return how many rows a group has, and what of its columns does not hold: file, slot and value."""
    stored, wrong = compaction.group(Part(group.path), group.number), list[tuple[Path, str, Wrong]]()
    rows: list[tuple[Row, bytes]] = []
    for key, text in zip(stored.column(KEY).to_pylist(), stored.column(TEXT).to_pylist(), strict=True):
        try:
            rows.append((row_of(text, key), text))
        except (TypeError, ValueError):  # which is told of the row itself
            rows.append(({"key": key}, b""))
    made = compaction.table(rows).select([name for name in stored.schema.names if name != TEXT])
    for name in made.schema.names:
        own, right = stored.column(name), made.column(name)
        if own.type != right.type:
            wrong.append((group.path, "", Wrong(name, str(own.type), str(right.type))))
        elif not own.equals(right):
            pairs = zip(rows, own.to_pylist(), right.to_pylist(), strict=True)
            differing = ((row, one, other) for (row, text), one, other in pairs if text and one != other)
            wrong += [(group.path, row["slot"], Wrong(name, one, other)) for row, one, other in differing]
    return len(rows), wrong
