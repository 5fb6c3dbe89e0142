"""Print what commands show: plain aligned tables, what goes on, and warnings about rows."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from harness.contract import plural
from harness.escaping import one_line
from harness.terminal import SCREEN, fitting, is_live, padded, size, width

if TYPE_CHECKING:
    from harness.results.store import Row

Tell = Callable[[str], None]
SHOWN_SECONDS = 2.0  # of a step, before its live line says how long it takes
PRIOR = 0.3  # of the estimated seconds that the first cells must take before they change the estimate much
UNFINISHED = ("failed", "timeout", "crashed")


def table(header: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Return a table as text, in aligned columns two spaces apart; each row is one line, whatever its texts hold."""
    cells = [[one_line(str(cell)) for cell in row] for row in (header, *rows)]
    widths = [max(map(width, column)) for column in zip(*cells, strict=True)]
    return "\n".join("  ".join(map(padded, row, widths)).rstrip() for row in cells)


def duration(seconds: float) -> str:
    """Return a duration as text: 1:05 or 2:03:04."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


class _Steps:
    """Hold what goes on now, and since when."""

    def __init__(self, what: str) -> None:
        self.now, self._since = what, time.monotonic()

    def tell(self, what: str) -> None:
        """Say what goes on from now on; "" where something is to be printed."""
        self.now, self._since = what, time.monotonic()
        if not what:
            SCREEN.show(self.lines)  # which clears the line at once

    def lines(self) -> list[str]:
        """Return the line that says it, with the seconds that it has taken so far."""
        if not self.now:
            return []
        seconds = int(time.monotonic() - self._since)
        took = f" ({seconds} s)" if seconds >= SHOWN_SECONDS and is_live(sys.stderr) else ""
        return [f"firsthit: {self.now}{took}"]


@contextlib.contextmanager
def doing(what: str) -> Iterator[Tell]:
    """Say what goes on while the block runs, at once; the block may tell more: `with doing("x") as tell: tell("y")`.

    On a terminal it is one live line, which is gone afterwards; elsewhere it is a line now and then.
    """
    SCREEN.begin(f"firsthit: {what}")
    with _showing(_Steps(what)) as tell:
        yield tell


@contextlib.contextmanager
def working() -> Iterator[Tell]:
    """Say what goes on while a block runs, as `doing` does, but for a block that may take no longer than a moment.

    Nothing is said at once; `tell("")` clears the live line, before something is printed.
    """
    with _showing(_Steps("")) as tell:
        yield tell


@contextlib.contextmanager
def _showing(steps: _Steps) -> Iterator[Tell]:
    before = SCREEN.show(steps.lines)
    try:
        yield steps.tell
    finally:
        SCREEN.show(before)


def outcome(row: Row) -> str:
    """Say how a cell ended: its median time and what is to be known of it, or its status and the reason."""
    if not row["time"]:
        return f"{row['status']}: {row['reason'].splitlines()[0]}" if row["reason"] else str(row["status"])
    warnings = [text.partition(":")[0] for text in row["time"]["warnings"]]
    return ", ".join([f"{row['time']['median_ms']:.3g} ms", *warnings])


class Progress:
    """Show how many cells are done, the current cell of each device, and the time left.

    On a terminal these are live lines, and above them stays a line for each finished cell; elsewhere, only that line,
    which also tells the time. Skipped cells have a line on a verbose screen, since they are a plan's and not a run's.
    """

    def __init__(self, total: int, estimate: float, devices: Mapping[str, int]) -> None:
        self._total, self._estimate, self._of = total, estimate, devices
        self._done, self._done_on = 0, dict.fromkeys(devices, 0)
        self._now = ""
        self._told: set[str] = set()  # what was said of cells so far; a reason is said once
        self._start = time.perf_counter()
        self._shown = False

    def __call__(self, slot: str, row: Row | None) -> None:
        """Show that a cell is the current one, if `row` is None, or that it has ended with this row."""
        if row is None:
            self._now = slot
            if not self._shown:
                self._shown = True
                SCREEN.show(self.lines)
            return
        self._done += 1
        device = _device(slot)
        self._done_on[device] = self._done_on.get(device, 0) + 1
        if row["status"] != "skipped" or SCREEN.level == "verbose":
            SCREEN.say(self._ended(slot, device, row), colour="red" if row["status"] in UNFINISHED else "")
        if self._done >= self._total:
            self.pause()

    def pause(self) -> None:
        """Clear the live lines, until the next cell."""
        if self._shown:
            self._shown = False
            SCREEN.show(None)

    def lines(self) -> list[str]:
        """Return the live lines: the whole, and each device where there are several."""
        head = self._head()
        if len(self._of) < 2 or not is_live(sys.stderr):
            return [f"{head} {self._now}"]
        widest, current = max(map(width, self._of)), _device(self._now)
        counts = {name: f"[{self._done_on[name]}/{of}]" for name, of in self._of.items()}
        room = max(map(width, counts.values()))
        lines = [f"  {padded(name, widest)} {padded(told, room)}" for name, told in counts.items()]
        at = list(self._of).index(current) if current in self._of else None
        if at is not None:
            lines[at] += f" {self._now.removesuffix(current).rstrip()}"
        return [head.rstrip(":"), *lines]

    def _ended(self, slot: str, device: str, row: Row) -> str:
        told = outcome(row)
        if row["reason"] and told in self._told:
            told = f"{row['status']}, as above"
        self._told.add(told)
        if not is_live(sys.stderr):
            return one_line(f"{self._head()} {slot}: {told}")
        cell = f"[{self._done}/{self._total}] {slot.removesuffix(device).rstrip()}"  # the live line tells the time
        return fitting(one_line(cell), size(sys.stderr)[0] - 1, f" {one_line(f'{device}: {told}')}")

    def _head(self) -> str:
        elapsed = time.perf_counter() - self._start
        left = _left(elapsed, self._estimate, self._done / self._total if self._total else 1.0)
        return f"[{self._done}/{self._total}] {duration(elapsed)}, about {duration(left)} left:"


def _device(slot: str) -> str:
    """Return the name of the device in a cell's slot, which ends with it."""
    return slot.rpartition(" ")[2]


def _left(elapsed: float, estimate: float, done: float) -> float:
    """Estimate the seconds left after a share of the cells is done: by the estimate first, by what they took later.

    Cells that are compared end together, so that the first of them comes late, and says little of the others.
    """
    if estimate <= 0.0:
        return elapsed * (1.0 - done) / done if done else 0.0
    return estimate * (1.0 - done) * (PRIOR * estimate + elapsed) / (PRIOR * estimate + done * estimate)


def warnings(rows: Sequence[Row]) -> list[str]:
    """Return a line for each kind of warning about the times of `rows`, with the first cell that has it."""
    troubled: dict[str, list[tuple[str, str]]] = {}
    for row in rows:
        for text in row["time"]["warnings"] if row["time"] else ():
            troubled.setdefault(text.partition(":")[0], []).append((text, row["slot"]))
    lines = []
    for told in troubled.values():
        text, slot = told[0]
        others = f", and {plural(len(told) - 1, 'more cell')} like it" if len(told) > 1 else ""
        lines.append(f"{slot}{others}: {text}")
    return lines


def undecided(rows: Sequence[Row]) -> list[str]:
    """Return a line that says how many hits of `rows` the oracle left undecided, or nothing if there are none."""
    found = [row["accuracy"] for row in rows if row["accuracy"] and row["accuracy"]["undecided"]]
    if not found:
        return []
    rays = sum(accuracy["undecided"] for accuracy in found)
    hits = sum(accuracy["truth_hits"] for accuracy in found) + rays
    left = f"{rays} of {plural(hits, 'hit')} undecided in {plural(len(found), 'cell')}"
    return [f"the oracle left {left}; no accuracy is of them"]
