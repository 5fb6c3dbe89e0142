"""Keep the Dask workers of this machine running: one for each device, and one for each core that takes other work."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

from harness.cluster.holder import CORES
from harness.cluster.serving import HUNG
from harness.hosting import process

AGAIN_SECONDS = 1.0  # before a worker that ended is started again
END_SECONDS = 5.0  # for workers to end by themselves
STEADY_SECONDS = 60.0  # a worker that ran so long did not end for the same reason as the one before
# A session of its own makes a group of all that a worker starts, also of what it started when it was killed
STARTED: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "start_new_session": True}


@dataclass(eq=False)
class _Worker:
    """Hold what is to run, and the process that runs it; None between two."""

    name: str
    resources: dict[str, float]
    running: tuple[subprocess.Popen[bytes], Connection] | None = None
    since: float = 0.0
    told: bool = False


class Supervisor:
    """Run a Dask worker for each of the `devices`, and `cores` more, for the scheduler at `address`.

    `machine` is this machine's name. `tell` hears of each worker that ends. Nothing runs before `look` is called, nor
    after `close`.
    """

    def __init__(
        self, address: str, devices: Sequence[str], cores: int, machine: str, tell: Callable[[str], None]
    ) -> None:
        self._address, self._machine, self._tell = address, machine, tell
        named = [_Worker(f"{device}@{machine}", {device: 1.0}) for device in devices]
        self._workers = named + [_Worker(f"core {n}@{machine}", {CORES: 1.0}) for n in range(1, cores + 1)]

    def look(self) -> None:
        """Start each worker that does not run. Raises FirsthitError where one cannot be started."""
        for worker in self._workers:
            if worker.running and worker.running[0].poll() is None:
                worker.told = worker.told and time.monotonic() - worker.since < STEADY_SECONDS
                continue
            if worker.running:
                self._ended(worker, worker.running[0].returncode)
            if time.monotonic() - worker.since >= AGAIN_SECONDS:
                self._start(worker)

    def close(self) -> None:
        """End all workers."""
        running = [worker.running for worker in self._workers if worker.running]
        for _, connection in running:
            connection.close()  # which tells the process to end
        end = time.monotonic() + END_SECONDS
        for started, _ in running:
            with contextlib.suppress(subprocess.TimeoutExpired):
                started.wait(max(0.0, end - time.monotonic()))
            _kill_group(started)
            started.wait()
        for worker in self._workers:
            worker.running = None

    def _start(self, worker: _Worker) -> None:
        stated = {"address": self._address, "machine": self._machine}
        text = json.dumps({"name": worker.name, "resources": worker.resources, **stated})
        worker.running = process.start("harness.cluster.serving", [text], f"the worker {worker.name}", STARTED)
        worker.since = time.monotonic()

    def _ended(self, worker: _Worker, code: int) -> None:
        assert worker.running
        worker.running[1].close()
        _kill_group(worker.running[0])
        worker.running = None
        if not worker.told:
            worker.told = True
            why = {0: "its scheduler has gone", HUNG: "it did not answer"}.get(code, f"exit code {code}")
            self._tell(f"the worker {worker.name} has ended ({why}); started again, it waits for {self._address}")


def _kill_group(started: subprocess.Popen[bytes]) -> None:
    """Kill a process and all that it started, as far as they are there."""
    if hasattr(os, "killpg"):
        with contextlib.suppress(OSError):
            os.killpg(started.pid, signal.SIGKILL)
    started.kill()
