"""Offer the devices of a cluster to a run, and give each of them cells, one group of cells at a time."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field

from harness.cluster import admission
from harness.cluster.engine import Engine
from harness.cluster.executor import ClusterExecutor
from harness.cluster.naming import Named, named
from harness.cluster.places import Place
from harness.contract import DeviceInfo, FirsthitError
from harness.devices.executor import LocalExecutor
from harness.devices.host import Host
from harness.experiment.config import BudgetChoice
from harness.experiment.plan import Planned
from harness.running.fastest import Tried
from harness.running.fleet import Work
from harness.running.runner import together
from harness.stopping import Stopped

LOOK_SECONDS = 0.5  # between two looks for workers that came meanwhile
END_SECONDS = 30.0  # for threads to end once they are told to
SETTLE_SECONDS = 3.0  # without a new worker, after which a cluster is taken as it is
ANY = ("all", "any", "fastest")  # words of configs that name no device


@dataclass(eq=False)
class _Work:
    """Hold what is left to do, and what went wrong."""

    queues: dict[str, deque[list[Planned]]]
    errors: list[BaseException] = field(default_factory=list)
    threads: dict[threading.Thread, str] = field(default_factory=dict)  # those that run, with their devices
    lock: threading.Lock = field(default_factory=threading.Lock)

    def next(self, name: str) -> list[Planned] | None:
        """Take the next group of a device's cells; None where there is none."""
        with self.lock:
            return self.queues[name].popleft() if self.queues[name] and not self.errors else None

    def running(self) -> dict[threading.Thread, str]:
        """Return the threads that run now."""
        self.threads = {thread: name for thread, name in self.threads.items() if thread.is_alive()}
        return self.threads


class ClusterFleet:
    """Offer the devices of the cluster that an engine watches; a Fleet of harness.running.

    `patience` are the seconds for which devices are waited for at the start; `expected` are the names of those that are
    known to come. `to_do` tells people what to do where none comes.
    """

    def __init__(self, engine: Engine, patience: float, expected: Collection[str] = (), to_do: str = "") -> None:
        self.engine, self._patience, self._expected = engine, patience, frozenset(expected)
        self._to_do = to_do or f"on each machine that is to take part run `firsthit worker {engine.address}`"
        self._named = Named()

    @property
    def hosts(self) -> Mapping[str, Host]:
        return self._named.hosts

    @property
    def tried(self) -> Mapping[str, Tried]:
        return self._named.tried

    def devices(self, wanted: Collection[str]) -> list[DeviceInfo]:
        """Find the devices of the cluster, once those that are wanted by name, or at least one, are there.

        Raises FirsthitError with exit code 3 where no device comes, or where a name stands for several.
        """
        try:
            self.engine.waited(lambda: self._complete(wanted), self._patience)
        except Stopped:
            raise self.engine.problem or Stopped(2) from None
        places = self.engine.places()
        if not places:
            told = f"no worker with a device came to the scheduler {self.engine.address} within {self._patience:.0f} s"
            raise FirsthitError(f"{told}; {self._to_do}", exit_code=3)
        self._named = named(places, wanted)
        return [info for info, _ in self._named.tried.values()]

    def _complete(self, wanted: Collection[str]) -> bool:
        """Tell whether the devices that are wanted are there and, where names do not say, no more have come lately."""
        places = self.engine.places()
        there = {name for place in places for name in (place.device, f"{place.device}@{place.machine}")}
        expected = self._expected or {name for name in wanted if name not in ANY}
        if not places or not expected <= there:
            return False
        return bool(self._expected) or self.engine.settled(SETTLE_SECONDS)

    def run(self, planned: Sequence[Planned], budget: BudgetChoice, work: Work) -> None:
        """Run cells as Fleet.run does, in a thread for each place that there is, or comes, for cells that are left."""
        idle = [one for one in planned if one.skip is not None or one.failure is not None]
        if idle:
            work(LocalExecutor(budget.timeout, budget.memory), idle, {})  # rows of cells that take no step
        left: dict[str, list[Planned]] = {}
        for one in planned:
            if one.skip is None and one.failure is None:
                left.setdefault(one.cell.device, []).append(one)
        doing = _Work({name: deque(together(cells)) for name, cells in left.items()})
        try:
            while not doing.errors and (doing.running() or any(doing.queues.values())):
                self.engine.check()
                for name, queue in doing.queues.items():
                    if queue:
                        self._start(doing, name, budget, work)
                for thread in list(doing.threads):
                    thread.join(LOOK_SECONDS / max(1, len(doing.threads)))
        except Stopped:
            if not self.engine.problem:
                raise
        finally:
            if doing.errors or doing.running():
                self.engine.stop()
                for thread in list(doing.threads):
                    thread.join(END_SECONDS)
        if self.engine.problem:
            raise self.engine.problem
        if doing.errors:
            raise doing.errors[0]

    def _start(self, doing: _Work, name: str, budget: BudgetChoice, work: Work) -> None:
        """Start a thread for each free place of a device, and one that waits where there is none and nobody waits."""
        wanted = self._named.wanted(name)
        while place := self.engine.take(wanted):
            self._thread(doing, name, place, wanted, budget, work)
        if name not in doing.running().values():
            self._thread(doing, name, None, wanted, budget, work)

    def _thread(
        self,
        doing: _Work,
        name: str,
        place: Place | None,
        wanted: Callable[[Place], bool],
        budget: BudgetChoice,
        work: Work,
    ) -> None:
        executor = ClusterExecutor(self.engine, name, place, wanted, budget.timeout, budget.memory)

        def run() -> None:
            try:
                with admission.beside():
                    try:
                        while cells := doing.next(name):
                            work(executor, cells, executor.where)
                    finally:
                        executor.close()
            except BaseException as error:
                with doing.lock:
                    doing.errors.append(error)

        thread = threading.Thread(target=run, name=f"cells of {name}", daemon=True)
        doing.threads[thread] = name
        thread.start()
