"""Admit work to a machine: a timed step has its device to itself and, on a software device, the whole machine.

Whoever works on a machine says so by locks of the system on two files, in a folder that each process of one user sees
there. So it holds for all that work there, also for several commands that use one cluster, and a process that dies, by
whatever, has left. Who wants to work takes the gate, and then the room, alone or beside others; the gate is given back
once the room is taken, so that nobody who wants to be alone waits for ever while others come and go.
"""

from __future__ import annotations

import contextlib
import os
import re
import tempfile
import threading
import time
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from harness.contract import FirsthitError

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

GATE, ROOM = "gate", "room"
BUSY_SECONDS = 3600.0  # after which who waits for the machine gives up
SHORTEST, LONGEST = 2e-4, 1e-2  # seconds between two tries

_mine = threading.local()


@contextlib.contextmanager
def alone(device: str, whole_machine: bool) -> Iterator[None]:
    """Have a device for this block alone and, with `whole_machine`, all that it shares with others on this machine.

    Raises FirsthitError where the machine was busy for BUSY_SECONDS.
    """
    with contextlib.ExitStack() as held:
        if whole_machine:
            held.enter_context(_room(exclusive=True))
        else:
            held.enter_context(_locked(re.sub(r"[^\w.-]", "_", device), exclusive=True))
        yield


@contextlib.contextmanager
def beside() -> Iterator[None]:
    """Work on this machine in a block, beside others who do, and beside no timed step that needs the whole machine.

    A thread that works already is not counted twice. Raises FirsthitError as `alone` does.
    """
    if getattr(_mine, "room", None) is not None:
        yield
        return
    _enter()
    try:
        yield
    finally:
        _leave()


@contextlib.contextmanager
def away() -> Iterator[None]:
    """Do not work on this machine in a block, within one in which this thread works: it waits for others."""
    works = getattr(_mine, "room", None) is not None
    if works:
        _leave()
    try:
        yield
    finally:
        if works:
            _enter()


def _enter() -> None:
    stack = contextlib.ExitStack()
    stack.enter_context(_room(exclusive=False))
    _mine.room = stack


def _leave() -> None:
    stack, _mine.room = _mine.room, None
    stack.close()


@contextlib.contextmanager
def _room(exclusive: bool) -> Iterator[None]:
    with contextlib.ExitStack() as held:
        with _locked(GATE, exclusive=True):
            held.enter_context(_locked(ROOM, exclusive))
        yield


@contextlib.contextmanager
def _locked(name: str, exclusive: bool) -> Iterator[None]:
    """Hold a lock of this machine's; the system gives it back with the process."""
    if fcntl is None:
        raise FirsthitError("a cluster's machines need locks of files (flock), which this system lacks", exit_code=3)
    file = _opened(name)
    try:
        kind, pause, end = fcntl.LOCK_EX if exclusive else fcntl.LOCK_SH, SHORTEST, time.monotonic() + BUSY_SECONDS
        while True:
            try:
                fcntl.flock(file, kind | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if time.monotonic() > end:
                    where = f"{_folder(tempfile.gettempdir())}/{name}.lock"
                    told = f"other work has had this machine for {BUSY_SECONDS:.0f} s ({where})"
                    raise FirsthitError(told, exit_code=3) from None
                time.sleep(pause)
                pause = min(2.0 * pause, LONGEST)
        yield
    finally:
        os.close(file)


def _opened(name: str) -> int:
    """Open the file of a lock, and make it if it is not there. Raises FirsthitError as _folder does."""
    flags = os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0)
    with contextlib.suppress(FileNotFoundError):
        return os.open(f"{_folder(tempfile.gettempdir())}/{name}.lock", flags, 0o600)
    _folder.cache_clear()  # somebody has tidied the folder away
    return os.open(f"{_folder(tempfile.gettempdir())}/{name}.lock", flags, 0o600)


@cache
def _folder(parent: str) -> Path:
    """Return the folder of this user's locks on this machine. Raises FirsthitError where another user made it.

    It is looked at once: nobody else can change a folder of mode 700, nor replace it where folders are sticky.
    """
    user = os.getuid() if hasattr(os, "getuid") else 0
    folder = Path(parent) / f"firsthit-{user}"
    folder.mkdir(mode=0o700, exist_ok=True)
    if folder.is_symlink() or folder.stat().st_uid != user:
        raise FirsthitError(f"{folder} is not this user's, so that nobody can lock the machine there", exit_code=3)
    return folder
