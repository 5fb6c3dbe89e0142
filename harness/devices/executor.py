"""Run steps of cells on devices: here, in one local worker process for each device.

A worker that dies, hangs, holds too much memory or answers nonsense is ended, and started again for the next step. A
device that cannot be opened again is given up after a few tries, so that it does not cost each further cell a minute.
What the runner and all others need of an executor is `harness.devices.steps.Executor`; harness.cluster has another one,
which takes steps to machines of a cluster.
"""

from __future__ import annotations

import subprocess
import threading
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from harness import memory
from harness.contract import CellStatus, DeviceInfo, Program
from harness.devices import serving
from harness.devices.interface import Timing
from harness.devices.messages import Answer, Check, Checked, Frame, Warmed
from harness.devices.probes import Probes
from harness.hosting.process import explained

if TYPE_CHECKING:
    from harness.devices.fingerprint import Fingerprint

START_SECONDS = 60.0  # for a worker to start and a driver to load
STOP_SECONDS = 0.5  # for a worker to end by itself once its connection is closed
REOPENINGS = 3  # tries in a row to open a device again, after which it is given up
DURING = {  # when a worker died, as people are told; steps of cells are told by their names
    "find": "while devices were looked for",
    "reopen": "while it was opened",
    "probe": "while its arithmetic and clock were tried",
    "fingerprint": "while its fingerprint was taken",
}


class CellError(Exception):
    """Report that a step of one cell went wrong; `status` is failed, timeout or crashed."""

    def __init__(self, status: CellStatus, reason: str) -> None:
        super().__init__(reason)
        self.status = status


@dataclass(eq=False)
class _Process:
    process: subprocess.Popen[bytes]
    connection: Connection
    watch: memory.Watch
    late: bool = False  # it was killed since it had not answered in time

    def end_late(self) -> None:
        self.late = True
        self.watch.kill()


class LocalExecutor:
    """Run steps in worker processes on this machine.

    One step runs at a time, since software devices share the processor's cores. A step may take `timeout` seconds; in a
    new worker it has START_SECONDS more. A worker and its children may hold `share` of the machine's memory. A step
    raises CellError if it fails, takes too long or too much memory, or ends its worker.

    A worker that takes the place of one that was lost opens its device first. Where REOPENINGS of them in a row cannot,
    the device is given up: each further step raises CellError at once.
    """

    moves = 0  # a worker that takes the place of another one is on the same machine

    def __init__(self, timeout: float, share: float = memory.SHARE) -> None:
        self._timeout, self._share = timeout, share
        self._processes: dict[str, _Process] = {}
        self._warm: dict[str, str] = {}  # frame key → device whose worker holds it
        self._lost: set[str] = set()  # devices whose last worker was lost
        self._unopened: Counter[str] = Counter()  # by device: openings that failed, in a row
        self._given_up: dict[str, str] = {}  # device → why

    def find(self, backend: str) -> list[DeviceInfo]:
        """Find every device of a backend, in the worker that is named after it."""
        found: list[DeviceInfo] = self._call(backend, "find")
        return found

    def running_files(self, device: str) -> list[Path] | None:
        """Return the files whose code the worker of `device` has loaded: Python, bindings, drivers and their compilers.

        Returns None if the worker is gone, or if the system does not say; Linux does.
        """
        if device not in self._processes:
            return None
        try:
            text = Path(f"/proc/{self._processes[device].process.pid}/maps").read_text(encoding="utf-8")
        except (OSError, ValueError):
            return None
        mapped = (line.split(maxsplit=5) for line in text.splitlines())  # addresses, rights, offset, device, node, path
        return sorted({Path(fields[5]) for fields in mapped if len(fields) == 6 and "x" in fields[1]})

    def probe(self, device: str) -> Probes:
        """Probe a device's arithmetic and clock, as harness.devices.probes does. Raises CellError if that fails."""
        probes: Probes = self._call(device, "probe")
        return probes

    def fingerprint(self, device: str) -> Fingerprint:
        """Take the fingerprint of a device, as harness.devices.fingerprint does. Raises CellError if that fails."""
        found: Fingerprint = self._call(device, "fingerprint")
        return found

    def build(self, device: str, program: Program) -> float:
        """Compile a program, and return the milliseconds that it took. Raises CellError if that fails."""
        compile_ms: float = self._call(device, "build", program)
        return compile_ms

    def builds(self, device: str) -> list[str]:
        """Return a line for each program that a device has built since this was last asked, with its compiler's words.

        Returns [] where no worker holds the device.
        """
        found: list[str] = self._call(device, "builds") if device in self._processes else []
        return found

    def check(self, device: str, check: Check[Answer]) -> Checked[Answer]:
        """Build a check's programs and run it. Raises CellError if that fails, or if two runs answer differently."""
        checked: Checked[Answer] = self._call(device, "check", check)
        return checked

    def warm(self, device: str, key: str, frame: Frame) -> Warmed:
        """Build a frame and keep it under `key`, ready for `sample`. Raises CellError if that fails."""
        warmed: Warmed = self._call(device, "warm", key, frame)
        self._warm[key] = device
        return warmed

    def expect(self, samples: Sequence[tuple[str, int]]) -> None:
        """Do nothing: a sample is taken when it is asked for."""

    def sample(self, device: str, key: str, frame: Frame, batch: int) -> Timing:
        """Time one repetition: `batch` runs of the frame that is kept under `key`.

        If its worker has been restarted since, the frame is warmed again first. Raises CellError if either fails.
        """
        if key not in self._warm:
            self.warm(device, key, frame)
        timing: Timing = self._call(device, "sample", key, batch)
        return timing

    def holds(self, key: str) -> bool:
        """Tell whether a frame is kept ready under `key`."""
        return key in self._warm

    def release(self, device: str, key: str) -> None:
        """Free what the frame under `key` holds on its device; do nothing if no frame is kept there.

        Raises CellError if that fails.
        """
        if self._warm.pop(key, None):
            self._call(device, "release", key)

    def close(self) -> None:
        """End all workers."""
        for device in list(self._processes):
            self._stop(device)

    def kill(self) -> None:
        """Kill all workers, from any thread; a step that is under way in another thread raises CellError."""
        for worker in list(self._processes.values()):
            worker.process.kill()

    def _start(self, device: str) -> _Process:
        if device not in self._processes:
            process, connection = serving.start(device)
            self._processes[device] = _Process(process, connection, memory.Watch(process.pid, self._share))
        return self._processes[device]

    def _stop(self, device: str, at_once: bool = False) -> int:
        """End a worker, by force if it does not end within STOP_SECONDS or, `at_once`, without waiting.

        Returns its exit code, or minus the number of the signal that ended it.
        """
        stopped = self._processes.pop(device)
        self._warm = {key: holder for key, holder in self._warm.items() if holder != device}
        stopped.connection.close()
        if at_once:
            stopped.watch.kill()
        try:
            return stopped.process.wait(STOP_SECONDS)
        except subprocess.TimeoutExpired:
            stopped.watch.kill()
            return stopped.process.wait()

    def _lose(self, device: str, at_once: bool = False) -> int:
        """End a worker that did what it must not, as `_stop` does; its successor opens the device first."""
        self._lost.add(device)
        return self._stop(device, at_once)

    def _call(self, device: str, operation: str, *arguments: Any) -> Any:
        """Ask the worker of `device` for an operation, and return its result.

        The worker is started if none runs. Raises CellError if the operation fails, takes too long or too much memory,
        ends the worker, or if the device has been given up.
        """
        fresh = device not in self._processes
        if fresh and device in self._lost and operation != "find":
            self._reopen(device)
            fresh = False
        return self._ask(device, operation, arguments, self._timeout, START_SECONDS if fresh else 0.0)

    def _reopen(self, device: str) -> None:
        """Start a worker in the place of a lost one, and open its device. Raises CellError where that fails."""
        if device in self._given_up:
            raise CellError(CellStatus.FAILED, self._given_up[device])
        try:
            self._ask(device, "reopen", (), START_SECONDS, 0.0)
        except CellError as error:
            if device in self._processes:
                self._lose(device)
            self._unopened[device] += 1
            if self._unopened[device] >= REOPENINGS:
                tries = f"its worker was lost, and {REOPENINGS} times in a row it could not be opened again"
                self._given_up[device] = f"not tried: {device} was given up, since {tries}; the last time: {error}"
            reason = f"{device} could not be opened again after its worker was lost: {error}"
            raise CellError(error.status, reason) from None
        del self._unopened[device]
        self._lost.discard(device)

    def _ask(self, device: str, operation: str, arguments: tuple[Any, ...], seconds: float, more: float) -> Any:
        """Send an operation to a worker and return its result; it has `seconds`, and `more` to start."""
        worker = self._start(device)
        # A worker that is stopped in the middle of a message would let this process wait for the rest of it for ever
        late = threading.Timer(seconds + more + STOP_SECONDS, worker.end_late)
        late.daemon = True
        late.start()
        try:
            worker.connection.send((operation, arguments))
            if not memory.answered(worker.connection, worker.watch, seconds + more):
                self._lose(device, at_once=True)
                raise CellError(CellStatus.TIMEOUT, f"{operation} took longer than {seconds:g} s; killed")
            outcome, result = worker.connection.recv()
        except memory.TooMuch as error:
            self._lose(device, at_once=True)
            raise CellError(CellStatus.CRASHED, f"{operation} {error}; killed") from None
        except (EOFError, OSError):
            code = self._lose(device)
            if worker.late:
                reason = f"{operation} took longer than {seconds:g} s, and its answer did not come whole; killed"
                raise CellError(CellStatus.TIMEOUT, reason) from None
            when = DURING.get(operation, f"during {operation}")
            raise CellError(CellStatus.CRASHED, f"the worker {explained(code)} {when}") from None
        except CellError:
            raise
        except Exception as error:  # what is unpickled may raise anything
            self._lose(device, at_once=True)
            told = f"the worker's answer to {operation} is damaged ({type(error).__name__}: {error}); killed"
            raise CellError(CellStatus.CRASHED, told) from None
        finally:
            late.cancel()
        if outcome == "ok":
            return result
        if outcome == "broken":
            self._lose(device)
        raise CellError(CellStatus.FAILED, str(result))
