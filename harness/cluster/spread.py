"""Spread chunks of work that needs no device over the cores of a cluster; a Spread of harness.spreading."""

from __future__ import annotations

import hashlib
import math
import pickle
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from harness.cluster import admission
from harness.cluster.engine import ANSWER_SECONDS, Engine
from harness.cluster.holder import CORES, answer
from harness.contract import FirsthitError
from harness.spreading import Spread

LOOK_SECONDS = 0.25  # between two looks whether the cluster is still there
TRIES = 5  # in a row that find nothing, after which work is given up
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
        failed = 0  # tries in a row that found nothing, while the scheduler was there
        while len(found) < len(tasks):
            if not self._engine.waited(self._engine.cores):
                told = f"no worker that takes work of the oracle came within {self._engine.patience:.0f} s"
                raise FirsthitError(f"{told}; `firsthit worker` starts them, but for --cores 0", exit_code=3)
            client, before = self._engine.client, len(found)
            problem = self._try(client, tasks, found)
            failed = failed + 1 if problem and client is self._engine.client and len(found) == before else 0
            if failed == TRIES:
                told = f"the cluster did not take work of the oracle {TRIES} times; the last time: {problem}"
                raise FirsthitError(told, exit_code=3)
            if problem:
                self._engine.look_again()
        return [found[place] for place in range(len(tasks))]

    def _try(self, client: Any, tasks: Sequence[bytes], found: dict[int, Any]) -> str | None:
        """Add the answers that are not `found` yet; where some were lost on the way, return what Dask said of that.

        Raises what a task raised.
        """
        from dask.distributed import KilledWorker

        raised: BaseException | None = None
        try:
            futures = {}
            for place, task in enumerate(tasks):
                if place not in found:
                    name = f"firsthit-answer-{hashlib.sha256(task).hexdigest()[:32]}"
                    futures[place] = client.submit(answer, task, key=name, resources={CORES: 1})
            for place, future in futures.items():
                if not self._ended(client, future):
                    return None
                if future.status == "error":
                    raised = future.exception(timeout=ANSWER_SECONDS)
                    break
                found[place] = pickle.loads(future.result(timeout=ANSWER_SECONDS))
        except Exception as error:  # what Dask raises where the scheduler was lost, or a worker with its answer
            self._engine.check()
            return f"{type(error).__name__}: {error}"
        if isinstance(raised, KilledWorker):
            raise FirsthitError("each worker that took this work of the oracle was lost", exit_code=3)
        if raised is not None:
            raise raised
        return None

    def _ended(self, client: Any, future: Any) -> bool:
        """Wait for a task; return False where the cluster that had it was lost."""
        from dask.distributed import TimeoutError as Late

        while future.status == "pending":
            try:
                future.exception(timeout=LOOK_SECONDS)
            except (Late, TimeoutError):
                self._engine.check()
                if client is not self._engine.client or not self._engine.cores():
                    return False
        return True

    def _result(self, said: Any, function: Callable[[C], A], chunk: C) -> A:
        if said[0] == "raised":
            raise FirsthitError(said[1], exit_code=said[2])
        if said[0] == "other":  # a worker of other code, which joined a moment ago
            return function(chunk)
        result: A = said[1]
        return result
