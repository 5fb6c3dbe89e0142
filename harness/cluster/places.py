"""Hold a place where steps run: a device that a Dask worker holds."""

from __future__ import annotations

import contextlib
import pickle
import uuid
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from harness.cluster.holder import Announced, Holder
from harness.contract import CellStatus, DeviceInfo
from harness.devices.executor import CellError
from harness.devices.host import Host
from harness.devices.probes import Probes

LOOK_SECONDS = 0.25  # between two looks whether the worker is still there
ANSWER_SECONDS = 30.0  # for what has ended to be fetched


class Lost(Exception):
    """Report that a worker was lost while it took a step; the message says how, as "its worker has gone"."""


class Cold(Exception):
    """Report that the frame that is to be timed is not kept ready by the worker."""


@dataclass(eq=False)
class Place:
    """Hold a device of a worker.

    address: the worker's, as Dask knows it
    device: the name that the device has on its machine
    gone: how the worker was lost; None while it is there
    busy: somebody has taken it
    """

    address: str
    machine: str
    device: str
    info: DeviceInfo
    probes: Probes | None
    host: Host
    gone: str | None = None
    busy: bool = False

    @property
    def software(self) -> bool:
        """Tell whether the device computes on its machine's processor."""
        return self.info.resident is None


def places_of(address: str, announced: Announced) -> list[Place]:
    """List the places that a worker offers."""
    return [
        Place(address, announced.machine, info.name, info, probes, announced.host) for info, probes in announced.devices
    ]


@dataclass(eq=False)
class Hold:
    """Hold a place for a time, with a process there that holds the device.

    connect: returns the Dask client as it is now
    stop: raises what ends the command, once it is to end
    """

    place: Place
    timeout: float
    share: float
    connect: Callable[[], Any]
    stop: Callable[[], None]
    _actor: Any = field(default=None, init=False)
    _future: Any = field(default=None, init=False)

    def step(self, operation: str, device: str, arguments: tuple[Any, ...], released: list[str]) -> Any:
        """Take a step there and return its result. Raises CellError as executors do, Cold, and Lost."""
        request = pickle.dumps((operation, (device, *arguments), self.place.software, released), -1)
        said = pickle.loads(self._waited(lambda: self._held().step(request)))
        if said[0] == "ok":
            return said[1]
        if said[0] == "cold":
            raise Cold
        raise CellError(CellStatus(said[1]), said[2])

    def close(self) -> None:
        """End the process there, as far as the worker can be reached."""
        if self._actor is not None and self.place.gone is None:
            with contextlib.suppress(Lost):
                self._waited(self._actor.close)
        self._actor = self._future = None

    def _held(self) -> Any:
        """Return the actor that holds the device, which is made there when this is first called."""
        if self._actor is None:
            name, where = f"firsthit-holder-{uuid.uuid4().hex}", [self.place.address]
            options: dict[str, Any] = {"key": name, "workers": where, "actor": True, "pure": False}
            self._future = self.connect().submit(Holder, self.timeout, self.share, **options)
            self._actor = self._waited(lambda: self._future)
        return self._actor

    def _waited(self, begun: Callable[[], Any]) -> Any:
        """Return the result of what was begun, or raise Lost once the worker is not there any more."""
        from dask.distributed import TimeoutError as Late

        try:
            future = begun()
            while True:
                pending = getattr(future, "status", "pending") == "pending"  # else what it found is on its way
                try:
                    return future.result(timeout=LOOK_SECONDS if pending else ANSWER_SECONDS)
                except (Late, TimeoutError):
                    self.stop()
                    if self.place.gone is not None:
                        raise Lost(self.place.gone) from None
                    if self._future and self._future.status not in ("pending", "finished"):  # nothing will be answered
                        raise Lost(f"its worker does not hold the device any more ({self._future.status})") from None
        except (Lost, CellError):
            raise
        except Exception as error:  # what the connection, the scheduler and Dask raise where something is lost
            raise Lost(self.place.gone or f"its worker does not answer ({type(error).__name__}: {error})") from None
