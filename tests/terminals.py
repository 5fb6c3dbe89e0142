"""Play commands on a pseudo terminal, and see what a person would: all lines, also those that scrolled off."""

from __future__ import annotations

import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import termios
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pyte

ROOT = Path(__file__).parents[1]
RESIZED = re.compile(rb"\x1b\]2;columns=(\d+)\x07")  # what a script writes once it has set another width
OWN = ("COLUMNS", "LINES", "NO_COLOR", "FORCE_COLOR", "CLICOLOR", "CLICOLOR_FORCE")


@dataclass(frozen=True)
class Played:
    """Hold how a command ended, what it wrote, and every line that stayed; empty lines at the end are left out."""

    code: int
    raw: bytes
    lines: list[str]
    out: str


def play(
    arguments: Sequence[str],
    columns: int,
    rows: int = 24,
    *,
    emulated: int = 80,
    piped: bool = False,
    interrupt: bytes | None = None,
    **environment: str,
) -> Played:
    """Run Python with these arguments on a terminal of `columns`; 0: it does not say how wide it is, and `emulated` is.

    With `piped` its standard output is no terminal. Once it has written `interrupt`, Ctrl-C is typed.
    """
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", rows if columns else 0, columns, 0, 0))
    base = {name: value for name, value in os.environ.items() if name not in OWN}
    process = subprocess.Popen(
        [sys.executable, *arguments],
        cwd=ROOT,
        env=base | {"PYTHONPATH": str(ROOT), "TERM": "xterm"} | environment,
        stdin=theirs,
        stdout=subprocess.PIPE if piped else theirs,
        stderr=theirs,
        preexec_fn=lambda: (os.setsid(), fcntl.ioctl(2, termios.TIOCSCTTY, 0)),
    )
    os.close(theirs)
    raw = _read(ours, process, interrupt)
    out = process.stdout.read().decode() if process.stdout else ""
    return Played(process.wait(), raw, shown(raw, columns or emulated, rows), out)


def _read(ours: int, process: subprocess.Popen[bytes], interrupt: bytes | None) -> bytes:
    raw = b""
    while True:
        if not select.select([ours], [], [], 60.0)[0]:
            os.killpg(process.pid, signal.SIGKILL)
            raise AssertionError(f"nothing for a minute, after {raw[-200:]!r}")
        try:
            more = os.read(ours, 65536)
        except OSError:  # the other side is closed
            return raw
        if not more:
            return raw
        raw += more
        if interrupt and interrupt in raw:
            os.write(ours, b"\x03")
            interrupt = None


def shown(raw: bytes, columns: int, rows: int = 24) -> list[str]:
    """Return every line that a terminal of this size shows in the end, those that scrolled off it first."""
    screen = pyte.HistoryScreen(columns, rows, history=10_000)
    stream = pyte.ByteStream(screen)
    first, *resized = RESIZED.split(raw)
    stream.feed(first)
    for wide, part in zip(resized[::2], resized[1::2], strict=True):
        screen.resize(rows, int(wide))
        stream.feed(part)
    above = ["".join(line[x].data for x in sorted(line)) for line in screen.history.top]
    lines = [line.rstrip() for line in (*above, *screen.display)]
    while lines and not lines[-1]:
        lines.pop()
    return lines
