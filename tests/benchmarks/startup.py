"""Measure how long commands take to start. `make bench` prints it, beside what they should take on an idle machine.

Every time is of a whole process. They are taken in turns, since a machine's speed drifts, and nothing is asserted.
"""

from __future__ import annotations

import os
import pty
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from harness import ROOT, console

RUNS = 9
QUICK = ("run", "configs/quick.toml")


@dataclass(frozen=True)
class Start:
    """Hold a command and what ends the time of its start.

    That is the end of its process or, if `until` is given, the first output that has `until` in it.
    """

    what: str
    arguments: tuple[str, ...]
    limit: float | None  # seconds; None: none was set
    until: bytes | None = None
    terminal: bool = False


STARTS = (
    Start("firsthit --help", ("--help",), 0.3),
    Start("firsthit list methods", ("list", "methods"), 0.7),
    Start("firsthit devices, once kept", ("devices",), 1.0),
    Start("firsthit run configs/quick.toml, first line", QUICK, 2.0, b"firsthit: "),
    Start("the same on a terminal", QUICK, 2.0, b"firsthit: ", terminal=True),
    Start("until it names cells and devices", QUICK, None, b" cells on "),
)


def seconds_of(start: Start, environment: Mapping[str, str]) -> float:
    """Start the command once, with its results in a folder of its own; return the seconds until it has started.

    Raises RuntimeError where it fails, or ends without the output that is waited for.
    """
    ours, theirs = pty.openpty() if start.terminal else os.pipe()
    with tempfile.TemporaryDirectory(prefix="firsthit-bench-") as folder:
        command = [sys.executable, "-m", "harness.cli", *start.arguments]
        command += ["--runs", folder] if start.arguments[0] == "run" else []
        began = time.perf_counter()
        process = subprocess.Popen(
            command,
            cwd=ROOT,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=theirs,
            stderr=theirs,
            start_new_session=True,
        )
        os.close(theirs)
        try:
            said = _read(ours, start.until)
            if start.until is None:
                process.wait()
            took = time.perf_counter() - began
            if process.poll() or (start.until or b"") not in said:
                raise RuntimeError(f"{start.what} failed:\n{said.decode(errors='replace')}")
            return took
        finally:
            os.close(ours)
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)  # the command and its workers
            process.wait()


def _read(handle: int, until: bytes | None) -> bytes:
    """Read from the file descriptor `handle` until the output holds `until`, or to its end; return what was read."""
    said = b""
    while until is None or until not in said:
        try:
            piece = os.read(handle, 65536)
        except OSError:  # how a terminal ends
            piece = b""
        if not piece:
            break
        said += piece
    return said


def table(starts: Sequence[Start], times: Mapping[str, Sequence[float]]) -> str:
    """Write a line for each start: the median of its times, the slowest, its limit, and whether the median keeps it."""
    rows = []
    for start in starts:
        median, slowest = statistics.median(times[start.what]), max(times[start.what])
        limit = "-" if start.limit is None else f"{start.limit:.1f} s"
        verdict = "-" if start.limit is None else "ok" if median < start.limit else "over"
        rows.append((start.what, f"{median:.2f} s", f"{slowest:.2f} s", limit, verdict))
    return console.table(("start of", "median", "slowest", "limit", ""), rows)


def measure(starts: Sequence[Start], runs: int) -> dict[str, list[float]]:
    """Return the seconds of `runs` starts of each command, by its name.

    The commands start in turns, after one start of each that is not counted. Raises RuntimeError as `seconds_of` does.
    """
    times: dict[str, list[float]] = {start.what: [] for start in starts}
    with tempfile.TemporaryDirectory(prefix="firsthit-bench-", ignore_cleanup_errors=True) as cache:
        environment = os.environ | {"XDG_CACHE_HOME": cache, "PYTHONPATH": str(ROOT)}
        for start in starts:  # the first of each compiles Python, and finds the devices
            seconds_of(start, environment)
        for _ in range(runs):
            for start in starts:
                times[start.what].append(seconds_of(start, environment))
    return times


def main() -> None:
    """Print the start-up times of as many processes as the first argument says, else of RUNS."""
    runs = int(sys.argv[1]) if sys.argv[1:] else RUNS
    load = f", beside other programs: load {os.getloadavg()[0]:.1f}" if os.getloadavg()[0] > 0.5 else ""
    times = measure(STARTS, runs)
    print(f"Start-up times of {runs} processes each, in turns{load}")
    print(table(STARTS, times))


if __name__ == "__main__":
    main()
