"""Print what goes on while cells are run."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import AbstractContextManager

from harness import console
from harness.results.store import Row
from harness.running.failures import failure_of, mistakes
from harness.running.run import Run, Watcher


class Printer(Watcher):
    """Prints what a run does: progress and warnings on standard error, results on standard output."""

    def __init__(self) -> None:
        self._progress = console.Progress(0, 0.0)

    def doing(self, what: str) -> AbstractContextManager[None]:
        return console.doing(what)

    def told(self, line: str) -> None:
        print(line)

    def warned(self, line: str) -> None:
        print(f"firsthit: {line}", file=sys.stderr)

    def starts(self, cells: int, seconds: float) -> None:
        self._progress = console.Progress(cells, seconds)

    def cell(self, slot: str, row: Row | None) -> None:
        self._progress(slot, row)

    def failed(self, rows: Sequence[Row]) -> None:
        for paragraph in mistakes(map(failure_of, rows), "cells"):
            print(paragraph, file=sys.stderr)

    def ended(self, part: Run) -> None:
        told = ", ".join(f"{count} {status}" for status, count in part.counts.items() if count)
        if told:
            print(f"{part.folder}: {len(part.rows)} cells run, {len(part.reused)} reused; {told}")
        for line in (*console.undecided((*part.rows, *part.reused)), *console.warnings(part.rows)):
            self.warned(line)
