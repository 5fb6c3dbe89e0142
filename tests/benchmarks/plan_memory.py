"""Measure what a plan of 20,160 cells takes: `python -m tests.benchmarks.plan_memory [VIEWS]`.

The config has the catalog's surfaces, two methods, two sizes and VIEWS directions (140 without it) on opencl:pocl,
which need not be here. It is planned in a process of its own, as a run plans it and then with nothing shared
between cells; printed are the cells, the seconds of processor time, the megabytes that the plan added to the
process's peak, and that peak. Nothing is asserted.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Any
from unittest.mock import patch

from harness.contract import DeviceInfo, Program
from harness.experiment import plan, reading
from harness.experiment.kinds.shared import Shared
from harness.plugins import find_methods

VIEWS = 140
CONFIG = """title = "many views"
surfaces = ["all"]
sizes = [16, 32]
devices = ["opencl:pocl"]
method = [{{ name = "newton" }}, {{ name = "sphere_tracing" }}]
[directions]
count = {views}
"""
DEVICE = DeviceInfo("opencl:pocl", "made up", "d", "c", 2, True, "wall", ())


class Alone(Shared):
    """Make everything anew for each cell, as if plans had nothing to share."""

    def once(self, what: Hashable, make: Callable[[], Any]) -> Any:
        del what
        return make()

    def program(self, program: Program) -> Program:
        return program


def _one(how: str, views: str) -> None:
    """Plan once in this process, and print the cells, the seconds and the bytes."""
    catalog = find_methods()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "many.toml")
        path.write_text(CONFIG.format(views=views))
        experiment = reading.load(path, catalog)
    before, began = _peak(), time.process_time()
    with patch.object(plan, "Shared", Shared if how == "shared" else Alone):
        planned = plan.plan(experiment, catalog, [DEVICE])
    print(len(planned), time.process_time() - began, _peak() - before, _peak())


def _peak() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def measure(how: str, views: int) -> tuple[int, float, float, float]:
    """Plan in a process of its own.

    Returns the cells, the seconds of processor time, the bytes that the plan added to the process's peak, and the peak.
    """
    command = [sys.executable, "-m", "tests.benchmarks.plan_memory", "--one", how, str(views)]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    return int(told[0]), float(told[1]), float(told[2]), float(told[3])


def main(views: int) -> None:
    """Measure both, and print a line for each."""
    for how in ("shared", "alone"):
        cells, seconds, held, peak = measure(how, views)
        print(
            f"{cells:,} cells planned, {how}: {held / 1e6:.0f} MB of a peak of {peak / 1e6:.0f} MB, {seconds:.1f} s",
            flush=True,
        )


if __name__ == "__main__":
    _one(*sys.argv[2:]) if sys.argv[1:2] == ["--one"] else main(int(sys.argv[1]) if sys.argv[1:] else VIEWS)
