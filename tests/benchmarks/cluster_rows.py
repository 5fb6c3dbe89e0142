"""Run a config here and on a cluster of this machine's devices, and compare the rows of both to the last digit.

    python -m tests.benchmarks.cluster_rows [CONFIG]

The cluster is a scheduler of Dask, and `firsthit worker` with a process for each device and one for a core. What
neither a clock nor the order of a queue decides must be the same: status, identity, answers ray by ray, errors,
evaluations. CONFIG is quick by default.
"""

from __future__ import annotations

import signal
import sys
import tempfile
import time
from pathlib import Path

from tests.campaigns import frame, processes
from tests.campaigns.cluster import Scheduler
from tests.campaigns.frame import Fell
from tests.campaigns.processes import Command

LONGEST = 3600.0  # seconds of a run


def _ran(folder: Path, config: str, runs: str, *more: str) -> tuple[float, str]:
    """Run the config into a folder of runs; return how many seconds it took, and what it told."""
    start = time.monotonic()
    code, told = Command(folder, ("run", config, "--runs", runs, *more)).ended(LONGEST)
    if code != 0:
        raise Fell(f"the run into {runs} ended with {code}: {told[-2000:]}")
    return time.monotonic() - start, told


def main(config: str = "quick") -> None:
    """Run both, compare them, and print how many rows and values were held against each other."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which what a shell runs in the background ignores
    given = str(Path(config).resolve()) if Path(config).exists() else config
    with tempfile.TemporaryDirectory(prefix="firsthit-rows-") as made:
        folder = Path(made, "work")
        folder.mkdir()
        try:
            here = _ran(folder, given, "here")[0]
            scheduler = Scheduler()
            workers = Command(folder, ("worker", scheduler.address, "--cores", "1"))
            there = _ran(folder, given, "there", "--cluster", scheduler.address)[0]
            workers.process.send_signal(signal.SIGINT)
            workers.ended()
            one, other = (processes.facts(folder / runs) for runs in ("here", "there"))
            processes.check_same(other, one)
        finally:
            while frame.ENDINGS:
                frame.ENDINGS.pop()()
    devices = sorted({row["device"] for row in one.values()})
    print(f"{config}: {len(one)} rows on {', '.join(devices)}, here and on a cluster: the same but for times and lanes")
    print(f"here {here:.0f} s, on a cluster of one machine {there:.0f} s")


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except Fell as error:
        sys.exit(str(error))
