"""Print what commands show: plain aligned tables, a line of progress, and warnings about rows."""

from __future__ import annotations

import contextlib
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from harness.results.store import Row

CLEAR = "\r\x1b[K"  # the line on a terminal
LIVE_SECONDS = 0.2  # between two states of a live line
FIRST_SECONDS, NEXT_SECONDS = 2.0, 10.0  # before the first plain line of what goes on, and between two
WIDEST = 200  # characters of a live line on a terminal that does not say how wide it is


def table(header: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Return a table as text, in aligned columns two spaces apart."""
    cells = [[str(cell) for cell in row] for row in (header, *rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return "\n".join("  ".join(c.ljust(w) for c, w in zip(row, widths, strict=True)).rstrip() for row in cells)


def duration(seconds: float) -> str:
    """Return a duration as text: 1:05 or 2:03:04."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


@contextlib.contextmanager
def doing(what: str) -> Iterator[None]:
    """Say what goes on while the block runs: a live line on a terminal, which is gone afterwards; a line elsewhere."""
    live = sys.stderr.isatty()
    _write(CLEAR + fitting(f"firsthit: {what}") if live else f"firsthit: {what}\n")
    try:
        yield
    finally:
        if live:
            _write(CLEAR)


class Working:
    """Say what goes on while a block runs that takes longer than a moment: `with Working() as tell: tell("step 1")`.

    On a terminal it is one live line, which is gone afterwards; elsewhere it is a line now and then. Another thread
    writes it, so that a step that hangs is named too. `tell("")` clears the live line, before something is printed.
    """

    def __init__(self) -> None:
        self._live = sys.stderr.isatty()
        self._now, self._ended, self._lock = "", threading.Event(), threading.Lock()
        self._thread = threading.Thread(target=self._show, daemon=True)

    def __enter__(self) -> Callable[[str], None]:
        self._thread.start()
        return self._tell

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()
        self._tell("")

    def _tell(self, what: str) -> None:
        with self._lock:
            self._now = what
            if self._live and not what:
                _write(CLEAR)

    def _show(self) -> None:
        shown, pause = "", LIVE_SECONDS if self._live else FIRST_SECONDS
        while not self._ended.wait(pause):
            with self._lock:
                if self._now and self._now != shown:
                    shown = self._now
                    _write(CLEAR + fitting(f"firsthit: {shown}") if self._live else f"firsthit: {shown}\n")
                    pause = LIVE_SECONDS if self._live else NEXT_SECONDS


def fitting(line: str, end: str = "") -> str:
    """Shorten a line to what a terminal shows in one line; `end` always stands at its end.

    A live line that is wider than the terminal could not be cleared.
    """
    room = shutil.get_terminal_size((WIDEST, 24)).columns - 1 - len(end)
    return (line if len(line) <= room else f"{line[: max(room - 1, 0)]}…") + end


def _write(text: str) -> None:
    sys.stderr.write(text)
    sys.stderr.flush()


def outcome(row: Row) -> str:
    """Say how a cell ended: its median time and what is to be known of it, or its status and the reason."""
    if not row["time"]:
        return f"{row['status']}: {row['reason'].splitlines()[0]}" if row["reason"] else str(row["status"])
    warnings = [text.partition(":")[0] for text in row["time"]["warnings"]]
    return ", ".join([f"{row['time']['median_ms']:.3g} ms", *warnings])


class Progress:
    """Show how many cells are done, the current cell, and the time left.

    On a terminal it is one line that is written again and again, and above it a line for each finished cell; elsewhere,
    a line for each finished cell, which also tells the time.
    """

    def __init__(self, total: int, estimate: float) -> None:
        self._total, self._estimate = total, estimate
        self._done = 0
        self._told: set[str] = set()  # what was said of cells so far; a reason is said once
        self._start = time.perf_counter()
        self._live = sys.stderr.isatty()

    def __call__(self, slot: str, row: Row | None) -> None:
        """Show that a cell is the current one, if `row` is None, or that it has ended with this row."""
        elapsed = time.perf_counter() - self._start
        if row is None:
            if self._live:
                _write(CLEAR + fitting(f"{self._head(elapsed)} {slot}"))
            return
        self._done += 1
        told = outcome(row)
        if row["reason"] and told in self._told:
            told = f"{row['status']}, as above"
        self._told.add(told)
        if self._live:  # the live line tells the time
            line = f"[{self._done}/{self._total}] {slot}"
            _write(f"{CLEAR}{line}: {told}\n" if row["reason"] else f"{CLEAR}{fitting(line, f': {told}')}\n")
        else:
            _write(f"{self._head(elapsed)} {slot}: {told}\n")

    def _head(self, elapsed: float) -> str:
        left = elapsed / self._done * (self._total - self._done) if self._done else self._estimate
        return f"[{self._done}/{self._total}] {duration(elapsed)}, about {duration(left)} left:"


def warnings(rows: Sequence[Row]) -> list[str]:
    """Return a line for each kind of warning about the times of `rows`, with the first cell that has it."""
    troubled: dict[str, list[tuple[str, Row]]] = {}
    for row in rows:
        for text in row["time"]["warnings"] if row["time"] else ():
            troubled.setdefault(text.partition(":")[0], []).append((text, row))
    lines = []
    for told in troubled.values():
        text, row = told[0]
        others = f", and {len(told) - 1} more cells like it" if len(told) > 1 else ""
        lines.append(f"{row['slot']}{others}: {text}")
    return lines


def undecided(rows: Sequence[Row]) -> list[str]:
    """Return a line that says how many hits of `rows` the oracle left undecided, or nothing if there are none."""
    found = [row["accuracy"] for row in rows if row["accuracy"] and row["accuracy"]["undecided"]]
    if not found:
        return []
    rays = sum(accuracy["undecided"] for accuracy in found)
    hits = sum(accuracy["truth_hits"] for accuracy in found) + rays
    return [f"the oracle left {rays} of {hits} hits undecided in {len(found)} cells; no accuracy is of them"]
