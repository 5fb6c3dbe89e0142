"""Hold a place where steps run: a device that a Dask worker holds."""

from __future__ import annotations

import asyncio
import contextlib
import pickle
import uuid
from collections.abc import Callable, Coroutine
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Any

from harness.cluster.holder import Announced, Holder
from harness.contract import CellStatus, DeviceInfo
from harness.devices.executor import CellError
from harness.devices.host import Host
from harness.devices.probes import Probes

LOOK_SECONDS = 0.25  # between two looks whether the worker is still there


class Lost(Exception):
    """Report that a worker was lost that was to take a step; the message says how, as "its worker has gone"."""


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
    sent: whether the last step was sent to a worker that, as far as is known, was there
    """

    place: Place
    timeout: float
    share: float
    connect: Callable[[], Any]
    stop: Callable[[], None]
    sent: bool = field(default=False, init=False)
    _made: Any = field(default=None, init=False)  # Dask's future of the actor that holds the device
    _actor: Any = field(default=None, init=False)
    _loop: Any = field(default=None, init=False)  # the client's, where all that is asked is sent

    def step(self, operation: str, device: str, arguments: tuple[Any, ...], released: list[str]) -> Any:
        """Take a step there and return its result. Raises CellError as executors do, Cold, and Lost."""
        self.sent = False
        request = pickle.dumps((operation, (device, *arguments), self.place.software, released), -1)
        said = pickle.loads(self._waited(self._asked(request)))
        if said[0] == "ok":
            return said[1]
        if said[0] == "cold":
            raise Cold
        raise CellError(CellStatus(said[1]), said[2])

    def close(self) -> None:
        """End the process there, as far as the worker can be reached."""
        if self._actor is not None and self.place.gone is None:
            with contextlib.suppress(Lost):
                self._waited(self._closed())
        self._actor = self._made = None

    async def _asked(self, request: bytes) -> Any:
        if self._actor is None:
            self._actor = await self._made
        self.sent = self.place.gone is None
        return await self._actor.step(request)

    async def _closed(self) -> Any:
        return await self._actor.close()

    def _begun(self, asked: Coroutine[Any, Any, Any]) -> Future[Any]:
        """Send what is asked; the process that holds the device is started when this is first called."""
        with contextlib.ExitStack() as undone:
            undone.callback(asked.close)
            if self._made is None:
                client, name = self.connect(), f"firsthit-holder-{uuid.uuid4().hex}"
                options: dict[str, Any] = {"key": name, "workers": [self.place.address], "actor": True, "pure": False}
                self._loop = client.loop.asyncio_loop
                self._made = client.submit(Holder, self.timeout, self.share, **options)
            sent = asyncio.run_coroutine_threadsafe(asked, self._loop)
            undone.pop_all()
        return sent

    def _waited(self, asked: Coroutine[Any, Any, Any]) -> Any:
        """Return the answer to what is asked, or raise Lost once the worker is not there any more."""
        try:
            answer = self._begun(asked)
            try:
                while True:
                    try:
                        return answer.result(LOOK_SECONDS)
                    except TimeoutError:
                        if answer.done():
                            return answer.result()  # which may raise TimeoutError, of Dask's own
                    self.stop()
                    if self.place.gone is not None:
                        raise Lost(self.place.gone)
                    if self._made.status not in ("pending", "finished"):  # Dask does not tell those who wait
                        raise Lost(f"its worker does not hold the device any more ({self._made.status})")
            finally:
                answer.cancel()
        except Lost:
            raise
        except Exception as error:  # what the connection, the scheduler and Dask raise where something is lost
            raise Lost(self.place.gone or f"its worker does not answer ({type(error).__name__}: {error})") from None
