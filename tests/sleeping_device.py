"""A cluster in this process, of workers whose device only sleeps and answers: for tests and benchmarks."""

from __future__ import annotations

import asyncio
import contextlib
import os
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

from harness.cluster import holder, starting
from harness.cluster.engine import Engine
from harness.cluster.holder import Announced
from harness.cluster.serving import QUIET
from harness.contract import DeviceInfo, Hits, RayStatus
from harness.devices.executor import CellError
from harness.devices.host import Host
from harness.devices.interface import Timing
from harness.devices.messages import Checked, Warmed

INFO = DeviceInfo("opencl:sleeping", "Sleeping", "test", "1", None, True, "wall", (), resident=1)
HOST = Host("a processor", 2, {})
SECONDS = 0.02  # of each step


class SleepingExecutor:
    """Do as LocalExecutor does, with a device that sleeps in each step, and remember each step in `steps`."""

    steps: ClassVar[list[tuple[str, str]]] = []
    seconds = SECONDS
    fails: ClassVar[dict[str, CellError]] = {}  # by operation, once each

    def __init__(self, timeout: float, share: float = 0.5) -> None:
        del timeout, share
        self._kept: set[str] = set()

    def _step(self, operation: str, device: str) -> None:
        self.steps.append((operation, device))
        time.sleep(self.seconds)
        if operation in self.fails:
            raise self.fails.pop(operation)

    def check(self, device: str, check: Any) -> Checked[Any]:
        self._step("check", device)
        count = len(check.rays)
        return Checked(Hits(np.full(count, np.nan), np.full(count, RayStatus.MISS, np.uint8), np.ones(count, int)), 1.0)

    def warm(self, device: str, key: str, frame: Any) -> Warmed:
        del frame
        self._step("warm", device)
        self._kept.add(key)
        return Warmed(1.0, 0.1, 0.1, 1)

    def expect(self, samples: Any) -> None:
        del samples

    def holds(self, key: str) -> bool:
        return key in self._kept

    def sample(self, device: str, key: str, frame: Any, batch: int) -> Timing:
        del key, frame, batch
        self._step("sample", device)
        return Timing(1.0, None)

    def builds(self, device: str) -> list[str]:
        del device
        return []

    def release(self, device: str, key: str) -> None:
        del device
        self._kept.discard(key)

    def close(self) -> None:
        self._kept.clear()

    def kill(self) -> None:
        self.close()


def announce(resources: Any) -> dict[str, Any]:
    """Say what a worker has, without looking: its resources name its machine too, as `opencl:sleeping#lab1`."""
    import pickle

    machine = next((name.partition("#")[2] for name in resources if "#" in name), "lab1")
    devices = tuple((INFO, None) for name in resources if name.startswith("opencl:"))
    return {"code": holder.code(), "said": pickle.dumps(Announced(machine, HOST, devices))}


def serve(address: str, resources: dict[str, float], seconds: float) -> None:
    """Run a worker with these resources in this process, whose device sleeps for so long, until its scheduler ends."""
    os.environ.setdefault(starting.LOGGING, "critical")
    import dask
    from dask.distributed import Worker

    async def served() -> None:
        async with Worker(address, resources=resources, nthreads=1, dashboard=False) as worker:
            await worker.finished()

    SleepingExecutor.seconds = seconds
    with _patched() as patched, dask.config.set(QUIET):
        patched.setattr(holder.admission, "alone", lambda *_, **__: contextlib.nullcontext())  # as on 8 machines
        asyncio.run(served())


@contextlib.contextmanager
def _patched() -> Iterator[pytest.MonkeyPatch]:
    """Let devices sleep, and lock the machine elsewhere than other workers and runs do, for a block."""
    with tempfile.TemporaryDirectory() as locks, pytest.MonkeyPatch.context() as patched:
        patched.setattr(holder, "LocalExecutor", SleepingExecutor)
        patched.setattr(holder.admission, "_folder", lambda _: Path(locks))
        patched.setattr("harness.cluster.engine.announce", announce)
        yield patched


@contextlib.contextmanager
def watched(address: str) -> Iterator[Engine]:
    """Watch the cluster of a scheduler whose workers `serve`."""
    os.environ.setdefault(starting.LOGGING, "critical")
    from dask.distributed import Client

    with _patched():
        engine = Engine(lambda: Client(address, timeout=30), address, lambda _: None)
        try:
            yield engine
        finally:
            engine.close()


@contextlib.contextmanager
def cluster(workers: Sequence[dict[str, float]], patience: float = 20.0) -> Iterator[tuple[Any, Engine, list[str]]]:
    """Run a scheduler and workers with these resources in this process.

    Yields Dask's cluster, with `add` to add a worker and `workers_of_test`, the engine, and what it tells.
    """
    os.environ.setdefault(starting.LOGGING, "critical")
    import dask
    from dask.distributed import Client, LocalCluster, Worker

    told: list[str] = []
    soon = {"distributed.comm.timeouts.connect": "1s"}  # for who ends a cluster whose scheduler has ended
    with _patched() as patched, dask.config.set(QUIET | soon):
        patched.setattr(holder.admission, "alone", lambda *_, **__: contextlib.nullcontext())
        patched.setattr("harness.cluster.engine.LOOK_SECONDS", 0.05)
        with LocalCluster(n_workers=0, processes=False, dashboard_address=":0") as made:
            made.workers_of_test = []

            async def add(resources: dict[str, float]) -> Any:
                return await Worker(made.scheduler_address, resources=resources, nthreads=1, dashboard=False)

            made.add = lambda resources: made.workers_of_test.append(made.sync(add, resources))
            for resources in workers:
                made.add(resources)
            engine = Engine(lambda: Client(made.scheduler_address, timeout=10), "test:1", told.append, patience)
            try:
                yield made, engine, told
            finally:
                engine.close()
                for worker in made.workers_of_test:
                    made.sync(worker.close, timeout=2)


def until(holds: Any, seconds: float = 30.0) -> None:
    """Wait until something holds. Raises AssertionError where it does not come to it."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "it did not come to it in time"
        time.sleep(0.01)


def config(folder: Path, devices: str = "all", surfaces: str = '"sphere", "torus"') -> Path:
    """Write a config whose cells are wrong everywhere, and timed nevertheless."""
    path = folder / "t.toml"
    path.write_text(
        f"""title = "t"
surfaces = [{surfaces}]
sizes = [8]
devices = ["{devices}"]
stages = ["rays"]
[[method]]
name = "newton"
[[method]]
name = "null"
[accuracy]
size = 4
max_wrong_share = 1.0
[budget]
seconds = 0.05
rounds = 2
repetitions = 3
"""
    )
    return path
