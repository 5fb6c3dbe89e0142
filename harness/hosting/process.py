"""Start a process that runs a module of ours, with a connection to it; it dies with this process.

It is started as a module and not by multiprocessing, which would run the caller's script once more in each process. A
script without a main guard, or a notebook, would then start processes of its own, or fail.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any


def start(module: str, arguments: list[str], what: str, streams: dict[str, Any]) -> tuple[Any, Connection]:
    """Start `module` with `arguments` and the handle of its end of a connection; return the process, and our end.

    The process looks for modules where this process does (`sys.path`), so that it runs the same harness. `streams` are
    options of Popen. `what` names the process where none can be started, for which FirsthitError is raised.
    """
    ours, theirs = Pipe()
    handle = theirs.fileno()
    options = ["-P", *(["-S"] if sys.flags.no_site else [])]  # -P: no module is taken from the current folder
    command = [sys.executable, *options, "-m", module, *arguments, str(handle)]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(path for path in sys.path if isinstance(path, str))}
    try:
        if sys.platform == "win32":
            os.set_handle_inheritable(handle, True)
            return subprocess.Popen(command, env=environment, close_fds=False, **streams), ours
        with _not_interrupted():
            return subprocess.Popen(command, env=environment, pass_fds=[handle], **streams), ours
    except OSError as error:
        from harness.contract import FirsthitError

        ours.close()
        raise FirsthitError(f"cannot start {sys.executable} as {what}: {error}", exit_code=3) from None
    finally:
        theirs.close()


@contextlib.contextmanager
def _not_interrupted() -> Iterator[None]:
    """Keep what stops a command from a process that the block starts, and from nothing else.

    A shell or a closed terminal sends it to all of the command's processes. The command alone decides when they end:
    one that ended first would look as if it had crashed.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ())
    try:
        # One that came just before is raised here, after which this thread would stay deaf
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM, signal.SIGHUP})
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def explained(exit_code: int) -> str:
    """Say how a process ended, by its exit code or minus the number of the signal that ended it."""
    if exit_code < 0:
        return f"was killed by signal {signal.Signals(-exit_code).name.removeprefix('SIG')}"
    return f"ended with exit code {exit_code}"


def die_with_parent() -> None:
    """End this process when its parent ends, and before it where memory runs out; only Linux can do so."""
    if sys.platform == "linux":
        pr_set_pdeathsig = 1
        with contextlib.suppress(OSError):
            ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)
        with contextlib.suppress(OSError):
            Path("/proc/self/oom_score_adj").write_text("1000", encoding="ascii")
