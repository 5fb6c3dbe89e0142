"""Spread chunks of work that needs no device over the cores of a cluster; a Spread of harness.spreading."""

from __future__ import annotations

import hashlib
import math
import pickle
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from harness.cluster import admission
from harness.cluster.engine import Engine
from harness.cluster.holder import CORES, answer
from harness.contract import FirsthitError
from harness.spreading import Spread

LOOK_SECONDS = 0.25
WORTH_SECONDS = 0.2  # of one core's work that are worth sending
C = TypeVar("C")
A = TypeVar("A")


class ClusterSpread:
    """Hand chunks to the workers of a cluster that take work which needs no device.

    Where the cluster has none, `here` takes them: processes of this machine, or nobody.
    """

    def __init__(self, engine: Engine, here: Spread | None) -> None:
        self._engine, self._here = engine, here

    @property
    def worth_seconds(self) -> float:
        if self._engine.cores():
            return WORTH_SECONDS
        return self._here.worth_seconds if self._here else math.inf

    def map(self, function: Callable[[C], A], chunks: Sequence[C]) -> list[A]:
        """Return what a function of one of our modules makes of each chunk, in their order.

        Chunks that several threads ask for at the same time are answered once. A chunk whose worker is lost goes to
        another one. Raises FirsthitError where none comes, and what of this kind the function raises.
        """
        if self._here and not self._engine.cores():
            return self._here.map(function, chunks)
        tasks = [pickle.dumps((self._engine.ours, pickle.dumps((function, chunk), -1)), -1) for chunk in chunks]
        with admission.away():
            said = self._answers(tasks)
        return [self._result(one, function, chunk) for one, chunk in zip(said, chunks, strict=True)]

    def _answers(self, tasks: Sequence[bytes]) -> list[Any]:
        found: dict[int, Any] = {}
        while len(found) < len(tasks):
            if not self._engine.waited(self._engine.cores):
                told = f"no worker that takes work of the oracle came within {self._engine.patience:.0f} s"
                raise FirsthitError(f"{told}; `firsthit worker` starts them, but for --cores 0", exit_code=3)
            self._try(tasks, found)
        return [found[place] for place in range(len(tasks))]

    def _try(self, tasks: Sequence[bytes], found: dict[int, Any]) -> None:
        """Add the answers that are not `found` yet; some are missing where the scheduler was lost."""
        from dask.distributed import TimeoutError as Late
        from dask.distributed import wait

        left = [place for place in range(len(tasks)) if place not in found]
        names = {place: f"firsthit-answer-{hashlib.sha256(tasks[place]).hexdigest()[:32]}" for place in left}
        try:
            client = self._engine.client
            futures = {
                place: client.submit(answer, tasks[place], key=names[place], resources={CORES: 1}) for place in left
            }
            while True:
                try:
                    wait(list(futures.values()), timeout=LOOK_SECONDS)  # type: ignore[no-untyped-call]
                    break
                except (Late, TimeoutError):
                    self._engine.check()
                    if client is not self._engine.client or not self._engine.cores():
                        break
            for place, future in futures.items():
                if future.status == "finished":
                    found[place] = pickle.loads(future.result(timeout=LOOK_SECONDS))
                elif future.status == "error":
                    raise future.exception()
        except (OSError, Late, TimeoutError):  # the scheduler was lost
            self._engine.check()

    def _result(self, said: Any, function: Callable[[C], A], chunk: C) -> A:
        if said[0] == "raised":
            raise FirsthitError(said[1], exit_code=said[2])
        if said[0] == "other":  # a worker of other code, which joined a moment ago
            return function(chunk)
        result: A = said[1]
        return result
