"""Answer chunks in worker processes of this machine: one for each core, all from one command.

Workers are started when the first chunk is handed out, and not before: many commands have less work than a start takes.
They wait between two maps without doing anything. Each thread of the pool lends a worker, sends it a chunk and waits
for its answer, so that whoever is done first takes the next one.

A worker that dies costs its chunk a second try, in another worker. A worker may hold its part of the memory that the
pool may hold together, half of the machine's; beyond it, it is ended, and the command says so.
"""

from __future__ import annotations

import contextlib
import math
import pickle
import subprocess
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent import futures
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from typing import Any, TypeVar

from harness import memory, spreading
from harness.hosting import process
from harness.hosting.cores import cores
from harness.limits import JOBS
from surfaces.model import FirsthitError

STARTING = 1.0  # seconds of work that are worth starting workers: a start was measured at 0.3 s of each core
SENDING = 0.05  # that are worth handing to workers that run
LEAST_MEMORY = 256e6  # bytes that a worker should have; 54 MB were measured with a surface of degree 10
TRIES = 2
STREAMS: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL}

C = TypeVar("C")
A = TypeVar("A")


def usual_jobs() -> int:
    """Return how many workers this machine should have: one for each usable core, if its memory holds as many."""
    whole = memory.of_machine()
    fitting = math.inf if whole is None else memory.SHARE * whole / LEAST_MEMORY
    return max(1, math.floor(min(cores() or 1, JOBS.high, fitting)))


@contextlib.contextmanager
def over(jobs: int | None = None) -> Iterator[None]:
    """Let `jobs` processes take the chunks of this one while the block runs; None: `usual_jobs`, 1: this one alone.

    All have ended when the block has.
    """
    count = usual_jobs() if jobs is None else jobs
    if count == 1:
        with spreading.over(None):
            yield
        return
    pool = Pool(count)
    try:
        with spreading.over(pool):
            yield
    finally:
        pool.close()


class _Lost(Exception):
    """Report that a worker did not answer; the message says what happened to it, as "was killed by signal KILL"."""


@dataclass(eq=False)
class _Batch:
    """Hold what one map has under way."""

    stopped: bool = False
    workers: set[_Worker] = field(default_factory=set)


@dataclass(eq=False)
class _Worker:
    process: subprocess.Popen[bytes]
    connection: Connection
    watch: memory.Watch

    def answer(self, task: bytes) -> Any:
        """Return the answer to a pickled task. Raises _Lost, and what the task's function raised."""
        try:
            self.connection.send_bytes(task)
            memory.answered(self.connection, self.watch, math.inf)
            said = pickle.loads(self.connection.recv_bytes())
        except memory.TooMuch as error:
            raise _Lost(str(error)) from None
        except (EOFError, OSError):
            raise _Lost(process.explained(self.ended())) from None
        if said[0] == "ok":
            return said[1]
        raised: Exception = said[1]
        if not isinstance(raised, FirsthitError):
            raised.add_note(f"in a worker process:\n{said[2]}")
        raise raised

    def ended(self) -> int:
        """End the process, and return its exit code, or minus the number of the signal that ended it."""
        self.connection.close()
        with contextlib.suppress(subprocess.TimeoutExpired):
            return self.process.wait(0.5)
        self.process.kill()
        return self.process.wait()


class Pool:
    """Answer chunks in `jobs` worker processes; a Spread."""

    def __init__(self, jobs: int) -> None:
        self._jobs = jobs
        self._threads = futures.ThreadPoolExecutor(jobs, thread_name_prefix="spreading")
        self._lock = threading.Lock()
        self._idle: list[_Worker] = []
        self._running: set[_Worker] = set()
        self._closed = False

    @property
    def worth_seconds(self) -> float:
        return SENDING if self._running else STARTING

    @property
    def pids(self) -> list[int]:
        """Return the numbers of the processes that run now."""
        return [worker.process.pid for worker in list(self._running)]

    def map(self, function: Callable[[C], A], chunks: Sequence[C]) -> list[A]:
        batch = _Batch()
        todo = [self._threads.submit(self._answer, batch, function, chunk) for chunk in chunks]
        try:
            futures.wait(todo, return_when=futures.FIRST_EXCEPTION)
            for one in todo:  # the first that failed; those behind it may not have begun
                if one.done():
                    one.result()
            return [one.result() for one in todo]
        except BaseException:
            self._stop(batch)
            for one in todo:
                one.cancel()
            futures.wait(todo)
            raise

    def close(self) -> None:
        """End all workers."""
        with self._lock:
            running, self._running, self._idle, self._closed = self._running, set(), [], True
        for worker in running:
            worker.process.kill()
        self._threads.shutdown(cancel_futures=True)
        for worker in running:
            worker.ended()

    def _stop(self, batch: _Batch) -> None:
        """End the workers that work for a batch, so that nothing is left of it."""
        with self._lock:
            batch.stopped = True
            for worker in batch.workers:
                worker.process.kill()

    def _answer(self, batch: _Batch, function: Callable[[C], A], chunk: C) -> A:
        """Return what a worker makes of a chunk; another one is asked where the first is lost."""
        task = pickle.dumps((function, chunk), pickle.HIGHEST_PROTOCOL)
        lost: list[str] = []
        while len(lost) < TRIES:
            worker = self._lent(batch)
            try:
                answered: A = worker.answer(task)
            except _Lost as error:
                lost.append(str(error))
                self._back(batch, worker, usable=False)
                if batch.stopped:
                    raise
            except BaseException:
                self._back(batch, worker)
                raise
            else:
                self._back(batch, worker)
                return answered
        told = lost[0] if lost[0] == lost[1] else f"{lost[0]}, and another one {lost[1]}"
        raise FirsthitError(
            f"a worker process {told}, twice on the same work; try --jobs 1, which starts none, or fewer jobs, which "
            "have more memory each",
            exit_code=3,
        )

    def _lent(self, batch: _Batch) -> _Worker:
        """Take a worker that is idle, or start one. Raises FirsthitError where none can be started."""
        with self._lock:
            alive = [worker for worker in self._idle if worker.process.poll() is None]
            self._running.difference_update(set(self._idle) - set(alive))
            self._idle, worker = alive[:-1], alive[-1] if alive else None
        if worker is None:
            started, connection = process.start("harness.spreading.serving", [], "a worker process", STREAMS)
            worker = _Worker(started, connection, memory.Watch(started.pid, memory.SHARE / self._jobs, alone=True))
        with self._lock:
            self._running.add(worker)
            batch.workers.add(worker)
            if batch.stopped or self._closed:
                worker.process.kill()
        return worker

    def _back(self, batch: _Batch, worker: _Worker, usable: bool = True) -> None:
        """Take a worker back; one that was lost is ended."""
        with self._lock:
            batch.workers.discard(worker)
            if usable and not batch.stopped and worker in self._running:
                self._idle.append(worker)
                return
            self._running.discard(worker)
        worker.process.kill()
        worker.ended()
