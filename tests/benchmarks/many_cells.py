"""Run many cells on a device, and follow the memory of the main process: `python -m tests.benchmarks.many_cells N`.

The config has N cells or a few more, which are as cheap as a config's options make them: directions of view onto the
sphere by four variants, one pixel each, one ray held against the oracle, one round of one repetition. Programs do not
depend on a view's direction, so that few are compiled. `--device NAME` runs them elsewhere than on opencl:pocl,
`--folder DIR` keeps the run there, so that the same command goes on with it; else it is thrown away.

The run is a process of its own, `firsthit run`. Printed are the cells with a row, the seconds, those of
processor time too, and the peak memory (VmHWM, Linux only) of that process and, apart from it, the sum of the peaks of
the processes that it started. It ends with the exit code of the run. Nothing is asserted.
"""

from __future__ import annotations

import argparse
import contextlib
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from harness.memory import _descendants

CONFIG = """title = "Many cheap cells"
surfaces = ["sphere"]
sizes = [1]
precisions = ["float32"]
devices = ["{device}"]
[[method]]
name = "newton"
parameters = {{ EPSILON = [0.1, 0.01, 0.001, 0.0001] }}
[directions]
count = {count}
[accuracy]
size = 1
max_wrong_share = 1.0
undecided = 1.0
[budget]
seconds = 0.001
interval = 1.0
rounds = 1
repetitions = 1
"""
VARIANTS = 4
LOOK_SECONDS = 0.2  # between two looks at the peaks, which only grow


def _peak(pid: int) -> int:
    """Return the most bytes that a process has held so far; 0 of one that has ended."""
    with contextlib.suppress(OSError):
        if found := re.search(r"VmHWM:\s+(\d+) kB", Path(f"/proc/{pid}/status").read_text()):
            return int(found[1]) * 1024
    return 0


def measure(config: Path, runs: Path) -> tuple[int, float, int, int]:
    """Run a config; return the exit code, the seconds, and the peak bytes of the process and of those it started."""
    command = [sys.executable, "-m", "harness.cli", "run", str(config), "--runs", str(runs), "--yes"]
    began, own, others = time.perf_counter(), 0, dict[int, int]()
    with (runs / "said.txt").open("a") as said, subprocess.Popen(command, stdout=said, stderr=said) as process:
        while process.poll() is None:
            own = max(own, _peak(process.pid))
            for pid in _descendants(process.pid):
                others[pid] = max(others.get(pid, 0), _peak(pid))
            time.sleep(LOOK_SECONDS)
    return process.returncode, time.perf_counter() - began, own, sum(others.values())


def main() -> int:
    """Run what the command line asks for, and print what it took."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cells", type=int, metavar="N")
    parser.add_argument("--device", default="opencl:pocl", metavar="NAME")
    parser.add_argument("--folder", type=Path, metavar="DIR")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="firsthit-bench-") as scratch:
        folder = options.folder or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        config = folder / "many.toml"
        config.write_text(CONFIG.format(device=options.device, count=-(-options.cells // VARIANTS)))
        code, seconds, own, others = measure(config, folder)
        rows = sum(1 for _ in (folder / "many" / "cells").glob("*.json"))
        if code:
            print((folder / "said.txt").read_text()[-2000:], file=sys.stderr)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    busy = used.ru_utime + used.ru_stime
    each = f"{1e3 * seconds / max(rows, 1):.0f} ms a cell, of processor time {1e3 * busy / max(rows, 1):.0f} ms"
    print(f"{rows:,} cells have rows; {seconds:.0f} s, of processor time {busy:.0f} s: {each}")
    print(f"peak memory: {own / 1e6:.0f} MB of the main process; {others / 1e6:.0f} MB of those that it started")
    return code


if __name__ == "__main__":
    sys.exit(main())
