"""Do what a Dask worker does for firsthit: say what it has, hold a device, and answer chunks of work.

These functions run in the worker's process. What goes to and fro is pickled here, so that arrays arrive as they were.
"""

from __future__ import annotations

import os
import pickle
import re
import socket
import threading
import weakref
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from harness.cluster import admission
from harness.contract import CellStatus, DeviceInfo, FirsthitError
from harness.devices import kept_answers
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.host import Host, this_host
from harness.devices.interface import INSTALL, Timing, device_named
from harness.results import sources
from harness.running.environment import probed
from harness.running.fastest import Tried

MACHINE = "FIRSTHIT_MACHINE"  # the variable by which `firsthit worker --machine` names the machine
CORES = "cores"  # the resource of workers that take chunks of work which needs no device
FIND_SECONDS = 300.0  # for a driver to load and a device to be probed, beside whatever else this machine does
_telling = threading.Lock()
_told: dict[tuple[str, ...], bytes] = {}


@dataclass(frozen=True, eq=False)
class Announced:
    """Hold what a worker says of itself: its machine, the devices that it holds with what their probes found."""

    machine: str
    host: Host
    devices: tuple[Tried, ...]


def machine() -> str:
    """Return the name of this machine, as people know it and as names of devices can hold it."""
    name = os.environ.get(MACHINE) or socket.gethostname().partition(".")[0]
    return re.sub(r"[^\w.-]", "-", name) or "machine"


def code() -> dict[str, str]:
    """Return the hashes and versions of all that must be the same here and at the client: what rows depend on."""
    return {**sources.hashes("harness/cluster"), **sources.methodology(), **sources.packages()}


def announce(resources: Mapping[str, float]) -> dict[str, Any]:
    """Say what this worker has, where its resources name devices: `code`, and an Announced that is pickled in `said`.

    The devices are found and probed when this is first asked, with the machine to itself; so are those that could not
    be used, each time.
    """
    names = tuple(sorted(name for name in resources if name.partition(":")[0] in INSTALL))
    with _telling:
        said = _told.get(names)
        if said is None:
            tried = tuple(map(_tried, names))
            said = pickle.dumps(Announced(machine(), this_host(), tried))
            if not any(info.problem for info, _ in tried):
                _told[names] = said
    return {"code": code(), "said": said}


def _tried(name: str) -> Tried:
    """Find and probe a device; one that cannot be used says so in its problem."""
    executor = LocalExecutor(FIND_SECONDS)
    try:
        with admission.alone(name, whole_machine=True):
            info = device_named(name, executor.find(name.partition(":")[0]))
            return probed(executor, info, kept_answers.probes_folder())
    except (CellError, FirsthitError) as error:
        return DeviceInfo(name, "", "", "", None, False, "wall", (), problem=str(error)), None
    finally:
        executor.close()


class Holder:
    """Hold devices in processes of their own, and answer steps; a Dask actor."""

    def __init__(self, timeout: float, share: float) -> None:
        self._executor = LocalExecutor(timeout, share)
        weakref.finalize(self, self._executor.kill)  # where the client has gone, and Dask drops this

    def step(self, request: bytes) -> bytes:
        """Take a step, and return what became of it, pickled.

        The request is the operation, its arguments, of which the first is the device, whether it is a software device,
        and the keys of frames to free first. The answer is ("ok", result), ("cold",) where the frame is not kept ready
        that is to be timed first, or ("error", status, reason) for a CellError.
        """
        operation, (device, *arguments), software, released = pickle.loads(request)
        try:
            with admission.alone(device, whole_machine=software):
                for key in released:
                    self._executor.release(device, key)
                if operation == "samples":
                    return pickle.dumps(self._samples(device, *arguments), pickle.HIGHEST_PROTOCOL)
                result = getattr(self._executor, operation)(device, *arguments)
            return pickle.dumps(("ok", result), pickle.HIGHEST_PROTOCOL)
        except CellError as error:
            return pickle.dumps(("error", error.status, str(error)))
        except FirsthitError as error:
            return pickle.dumps(("error", CellStatus.FAILED, str(error)))

    def _samples(self, device: str, wanted: Sequence[tuple[str, int]]) -> tuple[Any, ...]:
        """Take samples, by key and batch, up to the first frame that is not kept ready, or that fails.

        The result of the answer is the timings, and the status and the reason of the one that failed, or None.
        """
        timings: list[Timing] = []
        for key, batch in wanted:
            if not self._executor.holds(key):
                return ("ok", (timings, None)) if timings else ("cold",)
            try:
                timings.append(self._executor.sample(device, key, None, batch))  # type: ignore[arg-type]  # kept here
            except CellError as error:
                return "ok", (timings, (error.status, str(error)))
        return "ok", (timings, None)

    def close(self) -> None:
        """End the processes that hold devices."""
        self._executor.close()


def answer(task: bytes) -> bytes:
    """Answer a chunk of work beside others: take a function and its argument, pickled, and return its result, pickled.

    The result is ("ok", result), ("raised", message, exit code) for a FirsthitError, and ("other", file) where this
    worker runs other code than the client.
    """
    theirs, pickled = pickle.loads(task)
    if differs := different(theirs, code()):
        return pickle.dumps(("other", differs))
    function, argument = pickle.loads(pickled)
    try:
        with admission.beside():
            return pickle.dumps(("ok", function(argument)), pickle.HIGHEST_PROTOCOL)
    except FirsthitError as error:
        return pickle.dumps(("raised", str(error), error.exit_code))


def different(theirs: Mapping[str, str], ours: Mapping[str, str]) -> str | None:
    """Name the first file or package that differs; None where none does."""
    names = sorted(theirs.keys() | ours.keys())
    return next((name for name in names if theirs.get(name) != ours.get(name)), None)
