"""Print what the engine of a cluster costs: throughput of 8 workers over one, and overhead of a cell.

    python -m tests.benchmarks.cluster

The device sleeps in each step, so that only the engine works. The scheduler and each worker are processes of their own,
on this machine: the engine's work for all of them is done by its cores.
"""

from __future__ import annotations

import contextlib
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.cluster.engine import Engine
from harness.cluster.executor import ClusterExecutor
from harness.cluster.fleet import ClusterFleet
from harness.devices.steps import Executor
from harness.experiment.plan import Planned
from tests.campaigns.cluster import Scheduler
from tests.sleeping_device import INFO, SleepingExecutor, until, watched

CELLS = 160
STEP_SECONDS = 0.05
STEPS = 10  # of a cell: a check, a frame that is warmed, and 8 samples


class _Cell:
    """Stand for a cell that is timed alone; the fleet reads no more of it."""

    skip = failure = None

    def __init__(self, number: int) -> None:
        self.cell, self.device, self.together = self, INFO.name, str(number)


def _work(executor: Executor, cells: Sequence[Planned], where: dict[str, Any]) -> None:
    """Take the steps of cells as a runner does, and nothing else."""
    del where
    check: Any = SimpleNamespace(rays=range(16))
    frame: Any = None
    for cell in cells:
        key = cell.cell.together
        executor.check(INFO.name, check)
        executor.warm(INFO.name, key, frame)
        executor.expect([(key, 1)] * (STEPS - 2))
        for _ in range(STEPS - 2):
            executor.sample(INFO.name, key, frame, 1)
        executor.release(INFO.name, key)


@contextlib.contextmanager
def cluster(workers: int, step: float) -> Iterator[Engine]:
    """Start a scheduler and so many workers, each as if on a machine of its own; a step takes `step` seconds."""
    scheduler, started = Scheduler(), []
    try:
        for number in range(workers):
            what = {INFO.name: 1.0, f"on#lab{number}": 1.0}
            code = f"from tests.sleeping_device import serve; serve({scheduler.address!r}, {what}, {step})"
            started.append(subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL))
        with watched(scheduler.address) as engine:
            until(lambda: len(engine.places()) == workers, 300.0)
            yield engine
    finally:
        scheduler.end()
        for worker in started:
            worker.kill()
            worker.wait()


class _Budget:
    timeout, memory = 60.0, 0.5


def seconds(workers: int, cells: int, step: float) -> float:
    """Return how long so many cells take on so many workers."""
    with cluster(workers, step) as engine:
        fleet, budget = ClusterFleet(engine, 60.0), _Budget()
        fleet.devices(["all"])
        planned: list[Any] = [_Cell(number) for number in range(cells)]
        start = time.perf_counter()
        fleet.run(planned, budget, _work)  # type: ignore[arg-type]
        return time.perf_counter() - start


def overhead(cells: int) -> NDArray[np.float64]:
    """Return the quartiles of the seconds that cells take longer through the engine than at the device itself: [3]."""
    with cluster(1, 0.0) as engine:
        place = engine.take(lambda _: True)
        there, here = ClusterExecutor(engine, INFO.name, place, lambda _: True, 60.0, 0.5), SleepingExecutor(60.0)
        SleepingExecutor.seconds = 0.0
        planned: list[Any] = [_Cell(number) for number in range(cells + 1)]
        spent = np.zeros((cells + 1, 2))
        for number, cell in enumerate(planned):
            for column, executor in enumerate((there, here)):
                start = time.perf_counter()
                _work(executor, [cell], {})  # type: ignore[arg-type]
                spent[number, column] = time.perf_counter() - start
        there.close()
        more = spent[1:, 0] - spent[1:, 1]  # in the first cell the process that holds the device is started
        return np.asarray(np.percentile(more, (25, 50, 75)))


def main() -> None:
    """Print both figures."""
    one, eight = seconds(1, CELLS // 8, STEP_SECONDS), seconds(8, CELLS, STEP_SECONDS)
    told = f"{STEPS} steps of {STEP_SECONDS * 1e3:.0f} ms a cell"
    print(f"throughput of 8 workers over one: {8 * one / eight:.2f} ({told}; wanted 7.5)")
    low, median, high = 1e3 * overhead(200)
    spread = f"the middle half of 200 cells {low:.1f} to {high:.1f}"
    print(f"overhead of the engine: {median:.1f} ms a cell of {STEPS} steps, {spread} (wanted below 20)")


if __name__ == "__main__":
    main()
