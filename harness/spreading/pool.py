"""Answer chunks in worker processes of this machine: one for each core, all from one command.

Workers are started when the first chunk is handed out, and not before: many commands have less work than a start takes.
They wait between two maps without doing anything. Each thread of the pool lends a worker, sends it a chunk and waits
for its answer, so that whoever is done first takes the next one.

A signal may raise in `map` between any two steps of Python. So threads are started, chunks handed to them and answers
taken by single steps of C. The locks of `threading` and concurrent.futures would stay taken, or be released twice.

A worker that dies costs its chunk a second try, in another worker. A worker may hold its part of the memory that the
pool may hold together, half of the machine's; beyond it, it is ended, and the command says so.
"""

from __future__ import annotations

import _thread
import contextlib
import math
import pickle
import queue
import subprocess
import threading
import time
from collections.abc import Callable, Iterator, Sequence
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

    function: Callable[[Any], Any]
    stopped: bool = False
    workers: set[_Worker] = field(default_factory=set)
    done: queue.SimpleQueue[tuple[int, Any, BaseException | None]] = field(default_factory=queue.SimpleQueue)


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
        self._todo: queue.SimpleQueue[tuple[_Batch, int, Any] | None] = queue.SimpleQueue()
        self._started = self._threads = 0  # of threads: how many `map` started, and how many have begun to work
        self._left: queue.SimpleQueue[None] = queue.SimpleQueue()  # has one for each that has ended
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
        batch = _Batch(function)
        answers: dict[int, A] = {}
        try:
            while self._started < self._jobs:
                _thread.start_new_thread(self._work, ())
                self._started += 1
            for place, chunk in enumerate(chunks):
                self._todo.put((batch, place, chunk))
            while len(answers) < len(chunks):
                place, answer, error = batch.done.get()
                if error is not None:
                    raise error
                answers[place] = answer
            return [answers[place] for place in range(len(chunks))]
        except BaseException:
            self._stop(batch)
            raise

    def close(self) -> None:
        """End all workers."""
        with self._lock:
            running, self._running, self._idle, self._closed = self._running, set(), [], True
            threads = self._threads
        for worker in running:
            worker.process.kill()
        for _ in range(threads):
            self._todo.put(None)
        for _ in range(threads):
            self._left.get()
        for worker in running:
            worker.ended()

    def _work(self) -> None:
        """Answer chunks until the pool is closed; those of a map that was stopped are left."""
        with self._lock:
            if self._closed:
                return
            self._threads += 1
        while (task := self._todo.get()) is not None:
            batch, place, chunk = task
            if batch.stopped or self._closed:
                continue
            try:
                batch.done.put((place, self._answer(batch, chunk), None))
            except BaseException as error:
                batch.done.put((place, None, error))
        self._left.put(None)

    def _stop(self, batch: _Batch) -> None:
        """End the workers that work for a batch, so that nothing is left of it."""
        with self._lock:
            batch.stopped = True
            for worker in batch.workers:
                worker.process.kill()
        while batch.workers:  # until its threads have them back; no lock is waited for, as told above
            time.sleep(0.001)

    def _answer(self, batch: _Batch, chunk: Any) -> Any:
        """Return what a worker makes of a chunk; another one is asked where the first is lost."""
        task = pickle.dumps((batch.function, chunk), pickle.HIGHEST_PROTOCOL)
        lost: list[str] = []
        while len(lost) < TRIES:
            worker, usable = self._lent(batch), True
            try:
                return worker.answer(task)
            except _Lost as error:
                usable = False
                lost.append(str(error))
                if batch.stopped:
                    raise
            finally:
                self._back(batch, worker, usable)
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
