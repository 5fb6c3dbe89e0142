"""What the commands print: plain aligned tables, and one line of progress."""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence

from harness.results.store import Row


def table(header: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Aligned columns, two spaces apart."""
    cells = [[str(cell) for cell in row] for row in (header, *rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return "\n".join("  ".join(c.ljust(w) for c, w in zip(row, widths, strict=True)).rstrip() for row in cells)


def duration(seconds: float) -> str:
    """1:05 or 2:03:04."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


def outcome(row: Row) -> str:
    """Say how a cell ended: its median time and what is to be known of it, or its status and the reason."""
    if not row["time"]:
        return f"{row['status']}: {row['reason']}" if row["reason"] else str(row["status"])
    warnings = [text.partition(":")[0] for text in row["time"]["warnings"]]
    return ", ".join([f"{row['time']['median_ms']:.3g} ms", *warnings])


class Progress:
    """Cells done, the current one, the time left: one live line on a terminal, a line per finished cell elsewhere."""

    def __init__(self, total: int, estimate: float) -> None:
        self._total, self._estimate = total, estimate
        self._done = 0
        self._start = time.perf_counter()
        self._live = sys.stderr.isatty()

    def __call__(self, slot: str, row: Row | None) -> None:
        """`row` is the cell's finished row; None while it is only the current one."""
        elapsed = time.perf_counter() - self._start
        if row is None:
            if self._live:
                self._write(f"\r\x1b[K{self._head(elapsed)} {slot}"[:200])
            return
        self._done += 1
        line = f"{self._head(elapsed)} {slot}: {outcome(row)}"
        self._write(f"\r\x1b[K{line}\n" if self._live else f"{line}\n")

    def _head(self, elapsed: float) -> str:
        left = elapsed / self._done * (self._total - self._done) if self._done else self._estimate
        return f"[{self._done}/{self._total}] {duration(elapsed)}, about {duration(left)} left:"

    @staticmethod
    def _write(text: str) -> None:
        sys.stderr.write(text)
        sys.stderr.flush()


def warnings(rows: Sequence[Row]) -> list[str]:
    """What is to be known of the times of `rows` before they are believed, a line for each kind of trouble."""
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
    """How many hits the oracle left undecided that no accuracy of `rows` is of, if any."""
    found = [row["accuracy"] for row in rows if row["accuracy"] and row["accuracy"]["undecided"]]
    if not found:
        return []
    rays = sum(accuracy["undecided"] for accuracy in found)
    hits = sum(accuracy["truth_hits"] for accuracy in found) + rays
    return [f"the oracle left {rays} of {hits} hits undecided in {len(found)} cells; no accuracy is of them"]
