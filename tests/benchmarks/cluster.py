"""Print what the engine of a cluster costs: throughput of 8 workers over one, and overhead of a cell.

    python -m tests.benchmarks.cluster

The device sleeps in each step, so that only the engine works. Workers are threads of this process, and so is the
scheduler: the engine's work for all of them is done on one core.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

from harness.cluster.executor import ClusterExecutor
from harness.cluster.fleet import ClusterFleet
from harness.devices.steps import Executor
from harness.experiment.plan import Planned
from tests.sleeping_device import INFO, SleepingExecutor, cluster, until

CELLS = 160
STEP_SECONDS = 0.05
STEPS = 10  # of a cell: a check, a frame that is warmed, and 8 samples


class _Cell:
    """Stand for a cell that is timed alone; the fleet reads no more of it."""

    skip = failure = None

    def __init__(self, number: int) -> None:
        self.cell, self.device, self.together = self, INFO.name, str(number)


class _Check:
    rays = range(16)


def _work(executor: Executor, cells: Sequence[Planned], where: dict[str, Any]) -> None:
    """Take the steps of cells as a runner does, and nothing else."""
    del where
    check: Any = _Check()
    frame: Any = None
    for cell in cells:
        key = cell.cell.together
        executor.check(INFO.name, check)
        executor.warm(INFO.name, key, frame)
        for _ in range(STEPS - 2):
            executor.sample(INFO.name, key, frame, 1)
        executor.release(INFO.name, key)


def seconds(workers: int, cells: int) -> float:
    """Return how long so many cells take on so many workers."""
    resources = [{INFO.name: 1.0, f"on#lab{number}": 1.0} for number in range(workers)]
    with cluster(resources) as (_, engine, _told):
        until(lambda: len(engine.places()) == workers)
        fleet = ClusterFleet(engine, 20.0)
        fleet.devices(["all"])
        planned: list[Any] = [_Cell(number) for number in range(cells)]

        class Budget:
            timeout, memory = 60.0, 0.5

        budget: Any = Budget()
        start = time.perf_counter()
        fleet.run(planned, budget, _work)
        return time.perf_counter() - start


def overhead(cells: int) -> float:
    """Return the seconds that a cell takes longer through the engine than at the device itself."""
    with cluster([{INFO.name: 1.0}]) as (_, engine, _told):
        until(lambda: engine.places())
        place = engine.take(lambda _: True)
        there, here = ClusterExecutor(engine, INFO.name, place, lambda _: True, 60.0, 0.5), SleepingExecutor(60.0)
        spent = {}
        planned: list[Any] = [_Cell(number) for number in range(cells)]
        _work(there, planned[:1], {})  # the process that holds the device is started once
        for name, executor in (("there", there), ("here", here)):
            start = time.perf_counter()
            _work(executor, planned, {})  # type: ignore[arg-type]
            spent[name] = time.perf_counter() - start
        there.close()
        return (spent["there"] - spent["here"]) / cells


def main() -> None:
    """Print both figures."""
    SleepingExecutor.seconds = STEP_SECONDS
    one, eight = seconds(1, CELLS // 8), seconds(8, CELLS)
    told = f"{STEPS} steps of {STEP_SECONDS * 1e3:.0f} ms a cell"
    print(f"throughput of 8 workers over one: {8 * one / eight:.2f} ({told}; wanted 7.5)")
    SleepingExecutor.seconds = 0.0
    print(f"overhead of the engine: {1e3 * overhead(50):.1f} ms a cell of {STEPS} steps (wanted below 20)")


if __name__ == "__main__":
    main()
