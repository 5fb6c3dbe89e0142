"""End a command by a signal as Ctrl-C ends it: what it holds is released, and it tells what it keeps.

The exit code is the one that a shell tells of a process which the signal ended: 128 and the signal's number.
"""

from __future__ import annotations

import contextlib
import os
import signal
import threading
import time
from collections.abc import Iterator
from types import FrameType

SIGNALS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
TWICE = 0.5  # seconds: a second signal that comes sooner is the same one, which make, timeout or uv hand on
_asked: list[int] = []


class Stopped(KeyboardInterrupt):
    """Report that a signal asks the command to end."""

    def __init__(self, number: int) -> None:
        super().__init__(signal.Signals(number).name)
        self.number = number


def code_of(error: KeyboardInterrupt) -> int:
    """Return the exit code of a command that was stopped."""
    return 128 + (error.number if isinstance(error, Stopped) else signal.SIGINT)


@contextlib.contextmanager
def stoppable() -> Iterator[None]:
    """Raise Stopped in the block where SIGINT, SIGTERM or SIGHUP comes, and end the process at once at the second one.

    A signal that the caller ignores, as `nohup` does, or handles itself stays so. Does nothing outside the main thread.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    usual = (signal.SIG_DFL, signal.default_int_handler)
    before = {number: handler for number in SIGNALS if (handler := signal.getsignal(number)) in usual}
    reads, writes = os.pipe()
    os.set_blocking(writes, False)
    former = signal.set_wakeup_fd(writes, warn_on_full_buffer=False)
    threading.Thread(target=_listen, args=(reads, frozenset(before)), daemon=True).start()
    for number in before:
        signal.signal(number, _stop)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(former)
        os.close(writes)
        _asked.clear()


def asked() -> Stopped | None:
    """Return what `stoppable` raised for a signal that came since its block began; None if none came."""
    return Stopped(_asked[0]) if _asked else None


def _stop(number: int, _: FrameType | None) -> None:
    if not _asked:
        _asked.append(number)
        raise Stopped(number)


def _listen(pipe: int, numbers: frozenset[int]) -> None:
    """End the process at a second signal; a thread does, since the main one may be in a library that takes long.

    Worker processes end when the connection to this one does.
    """
    first = None
    try:
        while got := os.read(pipe, 1):
            if got[0] not in numbers:
                continue
            now = time.monotonic()
            if first is None:
                first = now
            elif now - first > TWICE:
                os._exit(128 + got[0])
    finally:
        os.close(pipe)
