"""Pack rows into Parquet parts while a run goes on, when many have files of their own (harness.results.compaction)."""

from __future__ import annotations

from typing import Protocol

from harness.contract import plural
from harness.results import compaction
from harness.results.store import Row, Store


class Hears(Protocol):
    """Define what packing tells of, as harness.running.run.Watcher hears it."""

    def told(self, line: str) -> None:
        """Hear what was done beside running cells."""

    def warned(self, line: str) -> None:
        """Hear what the caller should know before the results are used."""

    def cell(self, slot: str, row: Row | None) -> None:
        """Hear which cell is worked on or, with a `row`, that the cell has ended and what its row is."""


class Packing:
    """Pack the rows of one store, now and between cells. Only who holds the folder's lock may make one."""

    def __init__(self, store: Store, hears: Hears) -> None:
        self._store, self._hears, self._files = store, hears, 0
        self._pack()

    def cell(self, slot: str, row: Row | None) -> None:
        """Hear of a cell, as a Watcher does; with a `row` it is stored, and nothing is timed now."""
        self._hears.cell(slot, row)
        self._files += row is not None
        if self._files > compaction.MOST:
            self._pack()

    def _pack(self) -> None:
        done, folder = compaction.compact(self._store.folder), self._store.folder
        if done.reason:
            self._hears.warned(f"{folder}: there are more than {plural(compaction.MOST, 'row')}; {done.reason}")
        if done.rows or done.files:
            self._hears.told(f"{folder}: packed {plural(done.rows, 'row')} into Parquet")
        self._files = 0 if done.reason else len(self._store.files())  # without the package it is said again later
