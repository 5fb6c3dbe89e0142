"""Run steps of cells on devices: here, in one local worker process for each device.

A worker that dies or hangs is ended, and started again for the next step. The runner needs no more of an executor than
the methods of LocalExecutor, so that another executor may send cells elsewhere.
"""

from __future__ import annotations

import signal
import subprocess
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from harness.contract import CellStatus, DeviceInfo, Program
from harness.devices import serving
from harness.devices.interface import Timing
from harness.devices.messages import Answer, Check, Checked, Frame, Warmed
from harness.devices.probes import Probes

if TYPE_CHECKING:
    from harness.devices.fingerprint import Fingerprint

START_SECONDS = 60.0  # for a worker to start and a driver to load
STOP_SECONDS = 0.5  # for a worker to end by itself once its connection is closed


class CellError(Exception):
    """Report that a step of one cell went wrong; `status` is failed, timeout or crashed."""

    def __init__(self, status: CellStatus, reason: str) -> None:
        super().__init__(reason)
        self.status = status


@dataclass(eq=False)
class _Process:
    process: subprocess.Popen[bytes]
    connection: Connection


class LocalExecutor:
    """Run steps in worker processes on this machine.

    One step runs at a time, since software devices share the processor's cores. A step may take `timeout` seconds; in a
    new worker it has START_SECONDS more. A step raises CellError if it fails, takes too long, or ends its worker.
    """

    def __init__(self, timeout: float) -> None:
        self._timeout = timeout
        self._processes: dict[str, _Process] = {}
        self._warm: dict[str, str] = {}  # frame key → device whose worker holds it

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

    def sample(self, device: str, key: str, frame: Frame, batch: int) -> Timing:
        """Time one repetition: `batch` runs of the frame that is kept under `key`.

        If its worker has been restarted since, the frame is warmed again first. Raises CellError if either fails.
        """
        if key not in self._warm:
            self.warm(device, key, frame)
        timing: Timing = self._call(device, "sample", key, batch)
        return timing

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
            self._processes[device] = _Process(*serving.start(device))
        return self._processes[device]

    def _stop(self, device: str) -> int:
        """End a worker, by force if it does not end within STOP_SECONDS.

        Returns its exit code, or minus the number of the signal that ended it.
        """
        stopped = self._processes.pop(device)
        self._warm = {key: holder for key, holder in self._warm.items() if holder != device}
        stopped.connection.close()
        try:
            return stopped.process.wait(STOP_SECONDS)
        except subprocess.TimeoutExpired:
            stopped.process.kill()
            return stopped.process.wait()

    def _call(self, device: str, operation: str, *arguments: Any) -> Any:
        """Ask the worker of `device` for an operation, and return its result.

        The worker is started if none runs. Raises CellError if the operation fails, takes too long or ends the worker.
        """
        fresh = device not in self._processes
        worker = self._start(device)
        limit = self._timeout + (START_SECONDS if fresh else 0.0)
        try:
            worker.connection.send((operation, arguments))
            if not worker.connection.poll(limit):
                self._stop(device)
                raise CellError(CellStatus.TIMEOUT, f"{operation} took longer than {self._timeout:g} s; killed")
            outcome, result = worker.connection.recv()
        except (EOFError, OSError):
            code = self._stop(device)
            raise CellError(CellStatus.CRASHED, f"the worker died during {operation}: {_explain(code)}") from None
        if outcome == "failed":
            raise CellError(CellStatus.FAILED, result)
        return result


def _explain(exit_code: int) -> str:
    if exit_code < 0:
        return f"signal {signal.Signals(-exit_code).name}"
    return f"exit code {exit_code}"
