"""Know a cluster: which workers it has, which were lost, and whether its scheduler is there.

One thread looks at the scheduler again and again, and tells those who wait. A worker that is new is asked what it has.
One that is not listed any more, or whose signs of life have not changed for SILENT_SECONDS, counts as lost; Dask is
asked to start a silent one again. Where the scheduler does not answer, all workers count as lost until it is back.

Steps and answers go straight to and from the workers where this process reaches all of them, since the way through the
scheduler is longer. Where it does not reach one, as behind a firewall, all goes through the scheduler.
"""

from __future__ import annotations

import asyncio
import contextlib
import pickle
import signal
import threading
import time
import uuid
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from typing import Any

from harness.cluster.holder import CORES, FIND_SECONDS, Announced, announce, code, different
from harness.cluster.places import Place, places_of
from harness.contract import FirsthitError
from harness.devices.interface import INSTALL
from harness.stopping import Stopped

LOOK_SECONDS = 0.5  # between two looks at the scheduler
ANSWER_SECONDS = 30.0  # for the scheduler to answer
REACH_SECONDS = 3.0  # for a worker to answer this process without the scheduler
SILENT_SECONDS = 30.0  # without a sign of life, after which a worker counts as lost
SIGNS = 2  # of life, before a worker that lost a step is given another one: the first may be older than the loss
PATIENCE_SECONDS = 120.0  # for which a lost device or scheduler is waited for


@dataclass(eq=False)
class _Worker:
    """Hold what is known of a Dask worker: what it has, once it has said so, and its last sign of life."""

    asked: Any  # the future of its announcement
    seen: Any = None
    since: float = 0.0
    announced: Announced | None = None
    places: tuple[Place, ...] = ()
    cores: float = 0.0
    silent: bool = False
    reached: bool | None = None  # whether it answers this process without the scheduler; None: not tried
    doubted: int = 0  # signs of life that are still to come before its devices are lent again


class Engine:
    """Watch a cluster, and lend its devices.

    problem: why the cluster is given up; None while it is not

    `connect` makes a Dask client, or raises OSError where the scheduler does not answer. `address` is what people call
    the cluster. `tell` hears of what is lost and comes back. A lost device, and a lost scheduler, is waited for
    `patience` seconds.
    """

    def __init__(
        self,
        connect: Callable[[], Any],
        address: str,
        tell: Callable[[str], None],
        patience: float = PATIENCE_SECONDS,
    ) -> None:
        self._connect, self.address, self._tell, self.patience = connect, address, tell, patience
        self._client = connect()
        self._changed = threading.Condition()
        self._workers: dict[str, _Worker] = {}
        self._ours = code()
        self._up: float | None = time.monotonic()  # since when the scheduler answers; None while it does not
        self.problem: FirsthitError | None = None
        self._stopped = False
        self._told: set[str] = set()
        self._last_change = time.monotonic()
        self._begun = self._looked = 0  # looks at the scheduler: how many began, and which one ended last
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Let the cluster go; its workers stay as they are."""
        self.stop()
        self._ended.set()
        self._thread.join(ANSWER_SECONDS)
        with contextlib.suppress(Exception):
            self._client.close(timeout=2)

    def stop(self) -> None:
        """Let all who wait raise Stopped."""
        with self._changed:
            self._stopped = True
            self._changed.notify_all()

    def check(self) -> None:
        """Raise Stopped once the command is to end, or the scheduler is given up, which is a `problem`."""
        if self._stopped or self.problem:
            raise Stopped(signal.SIGINT)

    @property
    def client(self) -> Any:
        """Return the Dask client as it is now."""
        return self._client

    @property
    def ours(self) -> dict[str, str]:
        """Return what must be the same at each worker, as `holder.code` does."""
        return self._ours

    def places(self) -> list[Place]:
        """List the places that are there now, each device of a machine once."""
        with self._changed:
            return list(self._listed())

    def cores(self) -> float:
        """Count the cores that take chunks of work."""
        with self._changed:
            return sum(worker.cores for worker in self._workers.values() if worker.announced and not worker.silent)

    def waited(self, found: Callable[[], Any], seconds: float | None = None) -> Any:
        """Return what `found` returns, once that is true; None where it was not for `seconds`, else for the patience.

        While the scheduler does not answer, the time does not pass. While a worker finds and probes its devices, which
        takes its time on a busy machine, FIND_SECONDS more are waited. Raises as `check` does.
        """
        limit = self.patience if seconds is None else seconds
        since = time.monotonic()
        with self._changed:
            while True:
                self.check()
                if answer := found():
                    return answer
                if self._up is None:
                    since = time.monotonic()
                elif time.monotonic() - max(since, self._up) > limit + FIND_SECONDS * self.asking():
                    return None
                self._changed.wait(LOOK_SECONDS)

    def settled(self, seconds: float) -> bool:
        """Tell whether no worker came or went for some seconds, and each has said what it has."""
        with self._changed:
            return not self.asking() and time.monotonic() - self._last_change >= seconds

    def asking(self) -> bool:
        """Tell whether a worker has been asked what it has, and has not said so yet: it finds and probes devices."""
        with self._changed:
            return any(worker.asked is not None and not worker.silent for worker in self._workers.values())

    def take(self, wanted: Callable[[Place], bool]) -> Place | None:
        """Take a free place that is wanted; None where there is none now."""
        with self._changed:
            for place in self._listed():
                if not place.busy and wanted(place):
                    place.busy = True
                    return place
            return None

    def give_back(self, place: Place) -> None:
        """Give back a place that was taken."""
        with self._changed:
            place.busy = False
            self._changed.notify_all()

    def look_again(self, place: Place | None = None) -> None:
        """Return once a look at the scheduler has ended that began after this, or a place is known to be lost.

        The worker of the place is doubted: its devices are lent again after SIGNS signs of life. So what failed a
        moment ago is not tried again with a worker that has gone. Raises as `check` does.
        """
        with self._changed:
            if place is not None and (worker := self._workers.get(place.address)):
                worker.doubted, worker.reached = SIGNS, None
            begun = self._begun
            while self._looked <= begun and (place is None or place.gone is None):
                self.check()
                self._changed.wait(LOOK_SECONDS)

    def _listed(self) -> Iterator[Place]:
        """Yield the places that are there. Of two workers with one device of a machine, one counts."""
        there = [place for worker in self._workers.values() if not worker.doubted for place in worker.places]
        usable = [place for place in there if place.gone is None and not place.info.problem]
        seen = set()
        for place in sorted(usable, key=lambda place: not place.busy):
            name = place.machine, place.device
            if name not in seen:
                seen.add(name)
                yield place

    def _watch(self) -> None:
        while not self._ended.wait(LOOK_SECONDS):
            try:
                self._begun += 1
                told = self._client.sync(self._client.scheduler.identity, callback_timeout=ANSWER_SECONDS)
                if self._client.status != "running":  # it would keep what is submitted until it is connected, if ever
                    raise OSError(f"the client is {self._client.status}")
                self._seen(told["workers"])
            except Exception as error:  # whatever a connection that was lost raises, and one that is half made
                if not self._ended.is_set():
                    self._reconnect(error)

    def _seen(self, listed: dict[str, dict[str, Any]]) -> None:
        """Take over what the scheduler says of its workers."""
        now = time.monotonic()
        with self._changed:
            if self._workers.keys() != listed.keys():
                self._last_change = now
            for address in self._workers.keys() - listed.keys():
                self._lose(self._workers.pop(address), "its worker has gone")
            for address, told in listed.items():
                worker = self._workers.get(address)
                if worker is None or (worker.silent and told["last_seen"] != worker.seen):  # it is new, or is back
                    worker = self._workers[address] = _Worker(self._asked(address, told["resources"]))
                if told["last_seen"] != worker.seen:
                    worker.seen, worker.since = told["last_seen"], now
                    worker.doubted = max(0, worker.doubted - 1)
                elif now - worker.since > SILENT_SECONDS and not worker.silent:
                    worker.silent = True
                    self._lose(worker, f"its worker gave no sign of life for {SILENT_SECONDS:.0f} s")
                    worker.places = ()
                    threading.Thread(target=self._restart, args=(address,), daemon=True).start()
            heard = {address: one for address, one in self._workers.items() if one.asked and one.asked.done()}
            self._reach(heard.keys())
            for address, worker in heard.items():
                self._hear(address, worker, listed[address])
            self._looked = self._begun
            self._changed.notify_all()

    def _asked(self, address: str, resources: dict[str, float]) -> Any:
        """Ask a worker what it has; None where it has nothing for us."""
        if not any(name == CORES or name.partition(":")[0] in INSTALL for name in resources):
            return None
        options = {"workers": [address], "pure": False, "key": f"firsthit-announce-{uuid.uuid4().hex}", "retries": 0}
        return self._client.submit(announce, dict(resources), **options)

    def _reach(self, heard: Collection[str]) -> None:
        """Let Dask go straight to the workers where this process reaches all of them, those that are `heard` too."""
        there = {a: one for a, one in self._workers.items() if (one.announced or a in heard) and not one.silent}
        there = {address: worker for address, worker in there.items() if not worker.doubted}
        for address, worker in there.items():
            if worker.reached is None and all(other.reached is not False for other in there.values()):
                worker.reached = self._reaches(address)
        self._client.direct_to_workers = all(worker.reached for worker in there.values())

    def _reaches(self, address: str) -> bool:
        """Tell whether a worker answers this process without the scheduler."""

        async def asked() -> None:
            await asyncio.wait_for(self._client.rpc(address).identity(), REACH_SECONDS)

        with contextlib.suppress(Exception):  # whatever a connection raises that cannot be made
            self._client.sync(asked)
            return True
        return False

    def _hear(self, address: str, worker: _Worker, told: dict[str, Any]) -> None:
        """Take over what a worker has said of itself. One of other code counts as not there, and that is told."""
        future, worker.asked = worker.asked, None
        try:
            said = future.result(timeout=ANSWER_SECONDS)
        except Exception as error:  # whatever its Python, its packages or its firsthit raise
            if future.status != "error":  # its answer was lost on the way
                worker.asked = self._asked(address, told["resources"])
                return
            why = f"it cannot say what it has: {type(error).__name__}: {error}"
            self._say(f"the worker {told['name']} is left out: {why}")
            return
        if differs := different(self._ours, said["code"]):
            why = f"it runs other code than this command: {differs}"
            self._say(f"the worker {told['name']} is left out: {why}")
            return
        worker.announced = pickle.loads(said["said"])
        worker.places = tuple(places_of(address, worker.announced))
        worker.cores = told["resources"].get(CORES, 0.0)
        for place in worker.places:
            if place.info.problem:
                self._say(f"{place.device} of {place.machine} cannot be used: {place.info.problem}")

    def _lose(self, worker: _Worker, how: str) -> None:
        for place in worker.places:
            place.gone = f"{how} ({place.device} of {place.machine})"

    def _restart(self, address: str) -> None:
        with contextlib.suppress(Exception):  # of a worker without a nanny, or one that went in the meantime
            self._client.restart_workers([address], timeout=SILENT_SECONDS, raise_for_error=False)

    def _say(self, line: str) -> None:
        if line not in self._told:
            self._told.add(line)
            self._tell(line)

    def _reconnect(self, error: Exception) -> None:
        """Wait for the scheduler, and connect anew; give it up where it does not come back in time."""
        with self._changed:
            self._up = None
            for worker in self._workers.values():
                self._lose(worker, "the scheduler has gone")
            self._workers.clear()
            self._changed.notify_all()
        self._tell(f"the scheduler {self.address} does not answer ({type(error).__name__}); waiting for it")
        with contextlib.suppress(Exception):
            self._client.close(timeout=2)
        end = time.monotonic() + self.patience
        while not self._ended.is_set():
            try:
                self._client = self._connect()
                break
            except Exception:  # OSError for the most part; a scheduler that just begins or ends makes Dask raise others
                if time.monotonic() > end:
                    self._give_up()
                    return
                self._ended.wait(LOOK_SECONDS)
        with self._changed:
            self._up = time.monotonic()
            self._changed.notify_all()
        self._tell(f"the scheduler {self.address} is back; going on")

    def _give_up(self) -> None:
        told = (
            f"the scheduler {self.address} did not come back within {self.patience:.0f} s; finished cells are kept, "
            "and the same command goes on from there once a scheduler runs at that address"
        )
        with self._changed:
            self.problem = FirsthitError(told, exit_code=3)
            self._changed.notify_all()
        self._ended.set()
