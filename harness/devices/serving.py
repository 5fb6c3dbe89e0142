"""Run a worker's process: `python -m harness.devices.serving DEVICE HANDLE`, which only the executor starts.

harness.hosting.process says why it is started as a module.
"""

from __future__ import annotations

import contextlib
import os
import re
import signal
import subprocess
import sys
import threading
from multiprocessing.connection import Connection
from typing import IO, Any

from harness import escaping
from harness.hosting import process

COUNTED = re.compile(rb"(\d+ (warning|error)s?( and \d+ errors?)? generated\.)?")  # what clang says last
LONGEST_LINE = 100_000  # bytes; a longer one is several
STREAMS: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}


def start(device: str) -> tuple[subprocess.Popen[bytes], Connection]:
    """Start the worker that holds `device`; return its process, and our end of the connection to it.

    It reads no input. What drivers write, and kernels that print, is handed on to standard error, but for the lines
    that count the errors of a compiler's log, which is told elsewhere. Raises FirsthitError if none can be started.
    """
    worker, ours = process.start("harness.devices.serving", [device], f"the worker of {device}", STREAMS)
    threading.Thread(target=_hand_on, args=(worker.stdout,), daemon=True).start()
    return worker, ours


def _hand_on(said: IO[bytes]) -> None:
    """Write on standard error what a worker writes, until it ends, without what only counts errors.

    Anybody's kernel may print: nothing in its lines moves a cursor, or is a command of a CI server.
    """
    with said:
        while line := said.readline(LONGEST_LINE):
            if not COUNTED.fullmatch(line.strip()):
                with contextlib.suppress(OSError):
                    os.write(2, escaping.output(line))


def serve(connection: Connection, device: str) -> None:
    """Answer (operation, arguments) until the connection closes.

    An answer is ("ok", result), ("failed", reason) or, where the driver may be at fault, so that another process is to
    take the device, ("broken", reason).
    """
    from harness.contract import FirsthitError
    from harness.devices.interface import BuildError
    from harness.devices.worker import Worker

    worker = Worker(device)
    while True:
        try:
            operation, arguments = connection.recv()
        except (EOFError, ConnectionError):  # a reset: the runner ended without reading the last answer
            return
        try:
            answer = ("ok", getattr(worker, operation)(*arguments))
        except (BuildError, FirsthitError) as error:
            answer = ("failed", str(error))
        except Exception as error:  # a binding may raise anything; only this cell fails
            answer = ("broken", f"{type(error).__name__}: {error}")
        try:
            connection.send(answer)
        except ConnectionError:
            return


def main(device: str, handle: str) -> None:
    """Serve the connection whose end this process was given as `handle`, then end at once.

    Drivers may take long to unload, and some crash when they do; by then everything has been answered.
    """
    process.die_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the runner decides when to stop; so this comes before long imports
    if sys.platform == "win32":
        from multiprocessing.connection import PipeConnection

        serve(PipeConnection(int(handle)), device)
    else:
        serve(Connection(int(handle)), device)
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main(*sys.argv[1:])
