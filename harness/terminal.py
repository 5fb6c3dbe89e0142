"""Write to standard error: lines that stay and, where it is a terminal, live lines below them that are written anew.

Live lines end where the terminal ends, and the cursor waits at the beginning of the first of them. So whatever width
they were written at and whatever the terminal has made of them since, clearing from the cursor onwards clears them all.
"""

from __future__ import annotations

import contextlib
import os
import re
import sys
import threading
import time
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Literal, TextIO

CLEAR = "\r\x1b[J"  # from the first live line to the end of the screen
NEWLINE = "\r\n"
PLAIN = re.compile("[ -~\n…–×→≤]*")  # what can be seen as it stands, in the words of our own
NO_WRAP, WRAP = "\x1b[?7l", "\x1b[?7h"  # a line is cut where the terminal ends, whose width may not be known
LIVE_SECONDS = 0.2  # between two states of live lines
FIRST_SECONDS, NEXT_SECONDS = 2.0, 10.0  # before the first plain line of what goes on, and between two
USUAL = 80, 24  # columns and rows of a terminal that does not say how large it is
COLOURS = {"red": "31", "yellow": "33"}

Level = Literal["quiet", "normal", "verbose"]
Source = Callable[[], Sequence[str]]  # the lines that say what goes on now


def width(text: str) -> int:
    """Return how many columns of a terminal a text takes: marks that combine take none, wide characters two."""
    return sum(map(_columns, text))


def _columns(character: str) -> int:
    if unicodedata.category(character) in ("Mn", "Me", "Cf"):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1


def cut(text: str, columns: int) -> str:
    """Return a text, of which `…` stands for what does not fit into so many columns."""
    if width(text) <= columns:
        return text
    kept, room = [], columns - 1
    for character in text:
        room -= _columns(character)
        if room < 0:
            break
        kept.append(character)
    return "".join(kept) + "…" * (columns > 0)


def fitting(line: str, columns: int, end: str = "") -> str:
    """Join a line and its end into one that fits into so many columns.

    The end stays whole, as long as it leaves a third of the columns to the line.
    """
    return cut(cut(line, max(columns - width(end), columns // 3)) + end, columns)


def padded(text: str, columns: int) -> str:
    """Return a text with spaces behind it, so that it takes so many columns."""
    return text + " " * (columns - width(text))


def size(stream: TextIO) -> tuple[int, int]:
    """Return columns and rows of a terminal: as it says itself, else by COLUMNS and LINES, else the USUAL ones."""
    try:
        told: tuple[int, int] = os.get_terminal_size(stream.fileno())
    except (OSError, ValueError):  # no terminal, or no file
        told = (0, 0)
    stated = (_number(os.environ.get(name)) for name in ("COLUMNS", "LINES"))
    columns, rows = (a or b or c for a, b, c in zip(told, stated, USUAL, strict=True))
    return columns, rows


def _number(text: str | None) -> int:
    return int(text) if text and text.isdecimal() else 0


def is_live(stream: TextIO) -> bool:
    """Tell whether a stream is a terminal whose cursor can be moved."""
    return stream.isatty() and os.environ.get("TERM") != "dumb"


def is_coloured(stream: TextIO) -> bool:
    """Tell whether to write colours to a stream: NO_COLOR and FORCE_COLOR decide before what the stream is."""
    if os.environ.get("NO_COLOR"):
        return False
    for name in ("FORCE_COLOR", "CLICOLOR_FORCE"):
        if stated := os.environ.get(name):
            return stated != "0"
    return os.environ.get("CLICOLOR") != "0" and is_live(stream)


def painted(text: str, colour: str) -> str:
    """Return a text in a colour of COLOURS, where standard error shows colours."""
    return f"\x1b[{COLOURS[colour]}m{text}\x1b[0m" if is_coloured(sys.stderr) else text


def harmless(text: str) -> str:
    """Return lines of an output as escaping.harmless does, which is imported only where it is needed: help is quick."""
    if PLAIN.fullmatch(text) and "::" not in text and "##" not in text:
        return text
    from harness.escaping import harmless

    return harmless(text)


class Guarded:
    """Stand for a text stream, to which whole lines are written that `escaping.harmless` has passed.

    What the stream's encoding has not is written as Python's escapes. All else is the stream's own.
    """

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream
        self._lock = threading.RLock()
        self._begun = ""  # of a line that has not ended yet

    def write(self, text: str) -> int:
        """Take a text, and write the lines that end in it. Raises OSError where they cannot be written."""
        with self._lock:
            ended, end, self._begun = (self._begun + text).rpartition("\n")
            if end:
                self._pass_on(ended + end)
        return len(text)

    def writelines(self, texts: Iterable[str]) -> None:
        """Take texts as `write` does."""
        for text in texts:
            self.write(text)

    def flush(self) -> None:
        """Write all that was taken. Raises OSError where it cannot be written."""
        with self._lock:
            begun, self._begun = self._begun, ""
            if begun:
                self._pass_on(begun)
            self.stream.flush()

    def _pass_on(self, text: str) -> None:
        told, encoding = harmless(text), self.stream.encoding or "utf-8"
        self.stream.write(told.encode(encoding, "backslashreplace").decode(encoding))

    def __getattr__(self, name: str) -> Any:
        """Return what the stream itself has of this name. Raises AttributeError where it has none."""
        return getattr(self.stream, name)


def unguarded(stream: Any) -> TextIO:
    """Return the stream itself, to write what is a command or moves the cursor by our will."""
    own: TextIO = stream.stream if isinstance(stream, Guarded) else stream
    return own


def command(text: str) -> None:
    """Write commands for a CI server to standard output, whose texts were escaped for it."""
    sys.stdout.flush()
    out = unguarded(sys.stdout)
    out.write(f"{text}\n")
    out.flush()


@contextlib.contextmanager
def guarded() -> Iterator[None]:
    """Guard standard output and standard error while the block runs: no text of anybody is a command there."""
    before = sys.stdout, sys.stderr
    own = [stream if stream is None or isinstance(stream, Guarded) else Guarded(stream) for stream in before]
    sys.stdout, sys.stderr = own
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before


class Screen:
    """Write what commands tell beside their results, and how much of it: `level` says.

    quiet: errors alone; normal: and what goes on, warnings, and how each cell ended; verbose: and all that is known
    """

    def __init__(self) -> None:
        self.level: Level = "normal"
        self._lock = threading.RLock()
        self._source: Source | None = None
        self._drawn: tuple[str, ...] = ()
        self._told, self._when = "", 0.0  # the last plain line of what goes on, and when anything was written
        self._wakes: threading.Event | None = None

    def show(self, source: Source | None) -> Source | None:
        """Show what goes on from now on: the lines that `source` returns, anew every LIVE_SECONDS; None: nothing.

        Returns what was shown before.
        """
        with self._lock:
            before, self._source = self._source, None if self.level == "quiet" else source
            self._when = time.monotonic() - NEXT_SECONDS + FIRST_SECONDS
            self._draw()
        if source and self._wakes is None:
            self._wakes = threading.Event()
            threading.Thread(target=self._tick, daemon=True).start()
        if source and self._wakes:
            self._wakes.set()
        return before

    def say(self, line: str = "", *, error: bool = False, colour: str = "") -> None:
        """Write a line that stays, above the live ones, in a colour of COLOURS; a quiet screen writes errors only."""
        if self.level == "quiet" and not error:
            return
        told = harmless(line)
        with self._lock:
            self._when = time.monotonic()
            self._draw(f"{painted(told, colour) if colour else told}\n")

    def begin(self, line: str) -> None:
        """Write at once what goes on, elsewhere than on a terminal, where `show` does."""
        if not is_live(sys.stderr):
            self._told = line
            self.say(line)

    def _tick(self) -> None:
        """Draw anew for as long as the process runs; another thread does, so that a step that hangs is named too."""
        assert self._wakes
        while True:
            self._wakes.wait()
            time.sleep(LIVE_SECONDS)
            with self._lock:
                if self._source is None:
                    self._wakes.clear()
                    continue
                try:
                    self._draw()
                except (OSError, ValueError):  # nobody reads it any more, which the next line that stays will tell
                    self._source = None

    def _draw(self, stays: str = "") -> None:
        """Write what stays, and the live lines if they have changed; all at once, so that nothing flickers.

        Elsewhere than on a terminal, what goes on is a line now and then that stays.
        """
        if sys.stderr is None:  # the caller closed it before
            return
        live = tuple(harmless(" ".join(line.split("\n"))) for line in self._source()) if self._source else ()
        if not is_live(sys.stderr):
            first = live[0] if live else ""
            if first and first != self._told and time.monotonic() - self._when >= NEXT_SECONDS:
                self._told, self._when = first, time.monotonic()
                stays += f"{first}\n"
            _write(stays)
            return
        columns, rows = size(sys.stderr)
        fitted = tuple(cut(line, columns - 1) for line in live[: max(rows - 1, 1)])
        if not stays and fitted == self._drawn:
            return
        up = f"\x1b[{len(fitted) - 1}A" if len(fitted) > 1 else ""
        drawn = f"{NO_WRAP}{NEWLINE.join(fitted)}{WRAP}{up}\r" if fitted else ""
        _write((CLEAR if self._drawn else "") + stays + drawn)
        self._drawn = fitted


SCREEN = Screen()


def _write(text: str) -> None:
    if text:
        sys.stderr.flush()
        out = unguarded(sys.stderr)
        out.write(text)
        out.flush()
