"""Run a worker of the pool: `python -m harness.spreading.serving HANDLE`, which only the pool starts.

harness.hosting.process says why it is started as a module.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import pickle
import queue
import signal
import sys
import threading
import traceback
from multiprocessing.connection import Connection
from typing import Any

from harness.hosting import process

THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")  # each core has a worker of its own
TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3  # as malloc.h of glibc numbers them
KEPT_BYTES = 2**25  # the most that glibc takes for the second


def receive(connection: Connection, tasks: queue.SimpleQueue[bytes]) -> None:
    """Take tasks from the pool, and end this process at once when the pool is gone, whatever it computes.

    The command may have been killed; where the system does not end its children, this does.
    """
    while True:
        try:
            tasks.put(connection.recv_bytes())
        except (EOFError, OSError):
            os._exit(0)


def answer(task: bytes) -> bytes:
    """Return ("ok", result) or ("raised", error), pickled, for a pickled (function, chunk)."""
    try:
        function, chunk = pickle.loads(task)
        return pickle.dumps(("ok", function(chunk)), pickle.HIGHEST_PROTOCOL)
    except Exception as error:
        told = "".join(traceback.format_exception(error))
        try:
            pickled = pickle.dumps(("raised", error, told))
            pickle.loads(pickled)
            return pickled
        except Exception:  # it holds what cannot be sent
            return pickle.dumps(("raised", RuntimeError(f"{type(error).__name__}: {error}"), told))


def keep_freed_memory() -> None:
    """Let the C library keep the memory of arrays that were freed, if it can be told to, as glibc can.

    A chunk frees all of its arrays. Their memory would go back to the system and come again, page by page, with the
    next chunk: of rays of degree 10 this took a third of a worker's time.
    """
    with contextlib.suppress(OSError, AttributeError, TypeError):
        library = ctypes.CDLL(None)
        for setting in (MMAP_THRESHOLD, TRIM_THRESHOLD):
            library.mallopt(setting, KEPT_BYTES)


def main(handle: str) -> None:
    """Answer tasks until the connection closes whose end this process was given as `handle`."""
    process.die_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the command decides when to stop
    keep_freed_memory()
    os.environ.update(dict.fromkeys(THREADS, "1"))  # before numpy is imported
    connection: Any
    if sys.platform == "win32":
        from multiprocessing.connection import PipeConnection

        connection = PipeConnection(int(handle))
    else:
        connection = Connection(int(handle))
    tasks: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=receive, args=(connection, tasks), daemon=True).start()
    while True:
        answered = answer(tasks.get())
        try:
            connection.send_bytes(answered)
        except OSError:
            os._exit(0)


if __name__ == "__main__":
    main(*sys.argv[1:])
