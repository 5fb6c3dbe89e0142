"""Print what goes on while cells are run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager

from harness import console
from harness.contract import plural
from harness.results.store import Row
from harness.running.failures import failure_of, mistakes
from harness.running.run import Run, Watcher
from harness.terminal import SCREEN


class Printer(Watcher):
    """Prints what a run does: progress and warnings on standard error, results on standard output."""

    def __init__(self) -> None:
        self._progress = console.Progress(0, 0.0, {})
        self._wrong: set[str] = set()
        if SCREEN.level == "verbose":
            self.hears_builds = lambda slot, message: SCREEN.say(f"{slot}: {message}")

    def doing(self, what: str) -> AbstractContextManager[console.Tell]:
        return console.doing(what)

    def told(self, line: str) -> None:
        self._progress.pause()
        if SCREEN.level != "quiet":
            print(line)

    def warned(self, line: str) -> None:
        SCREEN.say(f"firsthit: {line}")

    def wrong(self, line: str) -> None:
        self._wrong.add(line)
        SCREEN.say(f"firsthit: {line}", error=True)

    def starts(self, cells: int, seconds: float, devices: Mapping[str, int]) -> None:
        self._progress.pause()
        self._progress = console.Progress(cells, seconds, devices)

    def cell(self, slot: str, row: Row | None) -> None:
        self._progress(slot, row and self._once(row))

    def failed(self, rows: Sequence[Row]) -> None:
        self._progress.pause()
        for paragraph in mistakes(map(failure_of, map(self._once, rows)), "cells"):
            SCREEN.say(paragraph, error=True)

    def _once(self, row: Row) -> Row:
        """Return a row that has no reason that was told as a warning before anything ran."""
        return row | {"reason": "its method cannot be used, as told above"} if row["reason"] in self._wrong else row

    def ended(self, part: Run) -> None:
        self._progress.pause()
        if SCREEN.level == "verbose":
            for row in part.reused:
                SCREEN.say(f"reused: {row['slot']}: {console.outcome(row)}")
        told = ", ".join(f"{count} {status}" for status, count in part.counts.items() if count)
        if told:
            print(f"{part.folder}: {plural(len(part.rows), 'cell')} run, {len(part.reused)} reused; {told}")
        for line in (*console.undecided(part.rows + part.reused), *console.warnings(part.rows)):
            self.warned(line)
