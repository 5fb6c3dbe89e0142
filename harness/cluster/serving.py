"""Run a Dask worker with named resources: `python -m harness.cluster.serving WORKER HANDLE`, from the supervisor only.

Dask's nanny watches the worker's process and starts it again where it ends. When the scheduler has gone, the worker
ends, and its nanny with it. A worker that hangs then is ended here, since only the worker hears of it. So is one that
hangs for a minute. The supervisor starts this process again, and the worker waits for a scheduler at the same address.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import os
import sys
import threading
import time
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from harness.cluster.holder import MACHINE
from harness.hosting import process

HUNG = 4  # exit code
HANG_SECONDS = 60.0  # without a sign of life of the worker's process
GONE_SECONDS = 5.0  # for a worker to end by itself once its scheduler has gone
# Python's own process, which outlives one that is killed and frees its semaphores, need not tell people so
LEAKED = "ignore:resource_tracker:UserWarning"
PRELOAD = "harness.cluster.serving"  # its dask_setup, in the worker's process
QUIET = {  # what Dask does by itself in a worker, 100 times a second, 50 times and 2: a timed step would hear it
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.system-monitor.interval": "5s",
}


def dask_setup(_worker: Any) -> None:
    """End the worker's process with its nanny's; Dask calls this where the worker starts."""
    process.die_with_parent()
    hush()


def hush() -> None:
    """Let loggers that get a level of their own where Dask is imported write as little as the rest of it."""
    for name in ("distributed.client", "tornado.application"):
        logging.getLogger(name).setLevel(logging.getLogger("distributed").level)


async def serve(address: str, name: str, resources: dict[str, float], machine: str, asked: Connection) -> int:
    """Serve the scheduler at an address until it, or the worker's nanny, has ended, or the other end of `asked`.

    Returns the exit code: 0, or HUNG where the worker does not answer. What is left of it then has to be killed.
    """
    os.environ[MACHINE] = machine
    import dask
    from distributed import Nanny

    hush()
    dask.config.set(QUIET)  # the nanny hands it to the worker
    stated: dict[str, Any] = {"name": name, "resources": resources, "preload": [PRELOAD]}
    nanny = Nanny(address, nthreads=1, memory_limit=0, dashboard=False, **stated)
    loop, told = asyncio.get_running_loop(), asyncio.Event()
    threading.Thread(target=_listen, args=(asked, loop, told), daemon=True).start()
    closed, hangs = asyncio.create_task(told.wait()), asyncio.create_task(_hangs(nanny))
    done, _ = await asyncio.wait([closed, hangs, asyncio.create_task(_served(nanny))], return_when="FIRST_COMPLETED")
    if closed in done:
        await nanny.close()
    for end in done:
        end.result()  # which raises what kept Dask from starting the worker
    return HUNG if hangs in done else 0


async def _served(nanny: Any) -> None:
    """Start the worker, and return when its nanny has ended, or a while after the scheduler has gone."""
    await nanny
    ends = [asyncio.create_task(nanny.finished()), asyncio.create_task(_abandoned(nanny))]
    await asyncio.wait(ends, return_when=asyncio.FIRST_COMPLETED)


async def _abandoned(nanny: Any) -> None:
    """Return a while after the scheduler has gone: it has closed a connection on which it never says anything."""
    with contextlib.suppress(OSError):
        await (await nanny.rpc.connect(nanny.scheduler.address)).read()
    await asyncio.sleep(GONE_SECONDS)


async def _hangs(nanny: Any) -> None:
    """Return once the worker's process gave no sign of life for HANG_SECONDS, as where it hangs while it starts.

    Nobody else notices that: for the scheduler it is not there yet. A sign of life is an answer, and before it is ready
    to answer, since many that start at once may take minutes, time that it had on a processor.
    """
    heard, worked = time.monotonic(), 0
    while time.monotonic() - heard < HANG_SECONDS:
        await asyncio.sleep(HANG_SECONDS / 12)
        if nanny.process is None:
            alive = True
        elif nanny.worker_address:
            alive = await _answers(nanny)
        else:
            before, worked = worked, _ticks(nanny.process.pid)
            alive = worked != before
        if alive:
            heard = time.monotonic()


async def _answers(nanny: Any) -> bool:
    with contextlib.suppress(OSError, TimeoutError):
        await asyncio.wait_for(nanny.rpc(nanny.worker_address).identity(), HANG_SECONDS / 4)
        return True
    return False


def _ticks(pid: int) -> int:
    """Return the time that a process has had on processors so far, in the system's ticks; 0 where nothing tells it."""
    with contextlib.suppress(OSError):
        fields = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
        return int(fields[11]) + int(fields[12])
    return 0


def _listen(asked: Connection, loop: asyncio.AbstractEventLoop, told: asyncio.Event) -> None:
    """Tell when the other end of a connection is closed."""
    with contextlib.suppress(OSError, EOFError):
        asked.recv_bytes()
    loop.call_soon_threadsafe(told.set)


def main(stated: str, handle: str) -> None:
    """Run the worker that `stated` says as JSON, with the names of serve's parameters, until `handle` is closed.

    Exits with 1 where Dask cannot start it, as where its process is killed while it starts; the supervisor tells that.
    """
    process.die_with_parent()
    sys.warnoptions.append(LEAKED)
    try:
        code = asyncio.run(serve(**json.loads(stated), asked=Connection(int(handle))))
    except Exception as error:  # whatever Dask raises
        while error.__cause__ is not None:  # the last one says only that it could not be started
            error = error.__cause__  # type: ignore[assignment]
        sys.exit(f"firsthit: a worker could not be started: {type(error).__name__}: {error}")
    os._exit(code)  # Python would wait for a worker that hangs; it is killed with this process


if __name__ == "__main__":
    main(*sys.argv[1:])
